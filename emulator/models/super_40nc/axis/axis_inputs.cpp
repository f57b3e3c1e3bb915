#include "emulator/models/super_40nc/axis/axis_inputs.h"

#include <cstddef>
#include <optional>
#include <utility>

#include "emulator/device/machine_edges.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "emulator/models/super_40nc/rows/terminals.h"
#include "motion/encoder_line.h"
#include "motion/environment.h"

namespace understudy::emulator::models::super_40nc {

Value AxisInputs::limit_logic(int axis, int direction) const {
  if (!has_limit_copies())
    return registers().of(direction > 0 ? stored_x(d9x::kPlusOtSignal) : stored_x(d9x::kMinusOtSignal), axis);
  return registers().of(direction > 0 ? stored_d(d8x::kPlusLimitPort) : stored_d(d8x::kMinusLimitPort), axis);
}

void AxisInputs::update_environment(int axis_number) {
  const Settings settings = registers();
  // Returns the level of an active limit, or nothing if the limit is not in use.
  const auto limit_level = [&](int direction) -> std::optional<bool> {
    const Value how = limit_logic(axis_number, direction);
    return how == 0 ? std::nullopt : std::optional(how == 1);
  };
  struct Function {
    int input;
    motion::Signal signal;
    std::optional<bool> active_level;
  };
  // MRK searches for its mark on a limit input, even if the input is used as a limit.
  const Rest& rest = axis(axis_number).rest;
  const auto limit_of_line = [&](int direction) {
    const std::optional<bool> level = limit_level(direction);
    return rest.limits_count ? level.value_or(true) : level;
  };
  const auto limit_or_mark = [&](int direction) {
    const bool is_mark = rest.kind == RestKind::mark && rest.marks_positive == (direction > 0);
    return is_mark ? std::optional(true) : limit_of_line(direction);
  };
  const bool dog_level = !settings.is_on(stored_x(d9x::kOrgLogic), axis_number);
  const int dog =
      chose(option("dog_inputs", "x0_x3_x6_x9")) ? dog_input(axis_number) : kFirstDogTerminal + axis_number;
  const Function functions[] = {
      {limit_plus_input(axis_number), motion::Signal::limit_plus, limit_or_mark(+1)},
      {limit_minus_input(axis_number), motion::Signal::limit_minus, limit_or_mark(-1)},
      {dog, motion::Signal::home, dog_level},
      {dog, motion::Signal::mark, dog_level},  // used for latches
      {pin_of(axis_number, kIndexPin), motion::Signal::index, true},
      {pin_of(axis_number, kAlarmPin), motion::Signal::alarm, true},
      {pin_of(axis_number, kInPositionPin), motion::Signal::in_position, true}};
  const MachineEdges edges = edges_of(axis_number);
  motion::Environment seen;
  for (const Function& function : functions) {
    if (!function.active_level) continue;
    if (const MachineEdges::Span* const span = edges.span_of(function.input)) {
      const bool is_inside = span->level_inside == *function.active_level;
      (is_inside ? seen.add(function.signal, span->first, span->last, span->slack)
                 : seen.add_outside(function.signal, span->first, span->last, span->slack));
    } else if (edges.index.period != 0 && edges.index.input == function.input) {
      const MachineEdges::Index& index = edges.index;
      const bool is_inside = index.level_inside == *function.active_level;
      seen.index_period = index.period;
      seen.index_at = is_inside ? index.at : index.at + index.width;
      seen.index_width = is_inside ? index.width : index.period - index.width;
      seen.index_from = index.first;
      seen.index_to = index.last;
    } else {
      seen.set_steady(function.signal, (input(function.input) != 0) == *function.active_level);
    }
  }
  seen.encoder = edges.encoder.as<motion::EncoderLine>();
  seen.encoder.turned = settings.is_on(stored_x(d9x::kEncoderDirection), axis_number);
  seen.version = environment(axis_number).version;
  if (seen == environment(axis_number)) return;
  ++seen.version;
  environment(axis_number) = seen;
}

/// A signal that is ON at power-up does not count as an edge of the contact that shows it.
void AxisInputs::see_first_signals() {
  if (ground_.state().has_ticked) return;
  for (int number = 0; number < kAxisCount; ++number) {
    chip(number).signals = environment(number).at(chip(number).travel_pulses, chip(number).signals);
  }
}

MachineEdges AxisInputs::edges_of(int axis) const {
  const MachineEdges& reported = edges_[static_cast<std::size_t>(axis)];
  return chip(axis).inverted ? reported.reversed() : reported;
}

std::optional<MachineEdges::Span> AxisInputs::span_of(int axis, int input) const {
  const MachineEdges edges = edges_of(axis);
  const MachineEdges::Span* const span = edges.span_of(input);
  return span == nullptr ? std::nullopt : std::optional(*span);
}

void AxisInputs::set_edges(int axis, const MachineEdges& edges) {
  edges_[static_cast<std::size_t>(axis)] = edges;
  // A restored state already includes these signals, but not the inputs that have changed since the last
  // tick.
  if (!std::exchange(is_restored_[static_cast<std::size_t>(axis)], false)) update_environment(axis);
}

}  // namespace understudy::emulator::models::super_40nc
