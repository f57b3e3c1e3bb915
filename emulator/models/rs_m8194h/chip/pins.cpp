// Handles the inputs of the axes: their filters, and the signals and limits of the motors.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/simulated_time.h"
#include "emulator/device/machine_edges.h"
#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/chip/chip.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "emulator/models/rs_m8194h/rows/terminals.h"
#include "motion/axis.h"
#include "motion/encoder_line.h"
#include "motion/environment.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

/// The delay of a filter in whole ticks, by FLn. Delays below 1.024 ms count as no delay (3.14).
constexpr std::array<Tick, 8> kFilterTicks{0, 0, 0, 1, 2, 4, 8, 16};
/// The bit of FEn that filters a pin, in the order of Pin.
constexpr std::array<std::uint8_t, kPinsOfAxis> kFilterBits{0, 0, 0, 0, 1, 4, 3, 3, 2, 2};

Tick filter_ticks(const AxisUnit& unit, int pin, const MachineOptions& options) {
  const bool filters =
      options.filters_delay && (unit.basic.filtered >> kFilterBits[static_cast<std::size_t>(pin)] & 1) != 0;
  if (!filters) return 0;
  return std::max<Tick>(kFilterTicks[unit.basic.filter_time], options.short_filters_take_a_tick ? 1 : 0);
}

/// A pin, and the motor signal that it controls.
struct PinFunction {
  Pin pin;
  motion::Signal signal;
};
constexpr PinFunction kFunctions[] = {
    {Pin::limit_plus, motion::Signal::limit_plus},
    {Pin::limit_minus, motion::Signal::limit_minus},
    {Pin::near_home, motion::Signal::near_home},
    {Pin::home, motion::Signal::home},
    {Pin::index, motion::Signal::index},
    {Pin::in3, motion::Signal::mark},
    {Pin::in_position, motion::Signal::in_position},
    {Pin::alarm, motion::Signal::alarm},
};

/// Returns true if a pin is active while on, false if it is active while off, or nothing if it is ignored.
std::optional<bool> active_while_on(const BasicSettings& basic, Pin pin, const MachineOptions& options) {
  switch (pin) {
    case Pin::limit_plus: return basic.forward_limit_level == 0;
    case Pin::limit_minus: return basic.reverse_limit_level == 0;
    case Pin::near_home: return basic.near_home_level == 0;
    case Pin::home: return basic.home_level == 0;
    case Pin::index: return basic.index_level == 0;
    case Pin::in3: return options.in3_rises_when_it_closes;  // otherwise the line level: high while off
    case Pin::in_position: return basic.in_position_level == 0;
    case Pin::alarm: return basic.alarm ? std::optional(basic.alarm_level == 0) : std::nullopt;
    case Pin::external_plus:
    case Pin::external_minus: break;
  }
  return std::nullopt;
}

}  // namespace

bool Chip::is_filtered(std::size_t axis, Pin pin) const {
  return filter_ticks(state_.units[axis], static_cast<int>(pin), machine_options()) > 0;
}

bool Chip::is_filtering(std::size_t axis) const {
  const AxisUnit& unit = state_.units[axis];
  return unit.pins.raw != unit.pins.passed || unit.emergency != state_.emergency_input;
}

void Chip::pass_pins(Tick tick) {
  for (std::size_t a = 0; a < kAxes; ++a) {
    AxisUnit& unit = state_.units[a];
    for (int i = 0; i < kPinsOfAxis; ++i) {
      const auto pin = static_cast<Pin>(i);
      const std::int32_t level = input(terminal(a, pin));
      // Counted inputs change with each edge.
      const bool is_counted = pin == Pin::external_plus || pin == Pin::external_minus;
      const bool is_on = is_counted ? (level & 1) != 0 : level != 0;
      const std::uint16_t bit = bit_of(pin);
      if (((unit.pins.raw & bit) != 0) != is_on) {
        unit.pins.raw ^= bit;
        unit.pins.since[static_cast<std::size_t>(i)] = tick;
      }
      const bool differs = ((unit.pins.raw ^ unit.pins.passed) & bit) != 0;
      if (differs &&
          tick - unit.pins.since[static_cast<std::size_t>(i)] >= filter_ticks(unit, i, machine_options())) {
        unit.pins.passed ^= bit;
      }
    }
  }
  const bool is_emergency = (input(kEmergencyPin) != 0) != machine_options().emergency_while_off;
  if (is_emergency != state_.emergency_input) state_.emergency_since = tick;
  state_.emergency_input = is_emergency;
  // For EMG, each axis uses its own filter for limits and home.
  for (AxisUnit& unit : state_.units) {
    const Tick delay = filter_ticks(unit, static_cast<int>(Pin::limit_plus), machine_options());
    if (tick - state_.emergency_since >= delay) unit.emergency = is_emergency;
  }
  state_.holds_back = false;
  for (std::size_t a = 0; a < kAxes; ++a) state_.holds_back = state_.holds_back || is_filtering(a);
}

void Chip::pass_all_pins() {
  for (AxisUnit& unit : state_.units) {
    unit.pins.passed = unit.pins.raw;
    unit.emergency = state_.emergency_input;
  }
  state_.holds_back = false;
}

/// Sets the motor's zones for inputs that depend on the position, and the levels of all other inputs.
void Chip::update_environment(std::size_t axis) {
  const AxisUnit& unit = state_.units[axis];
  const MachineEdges& edges = (*edges_)[axis];
  motion::Environment found;
  for (const PinFunction& function : kFunctions) {
    const auto active = active_while_on(unit.basic, function.pin, machine_options());
    if (!active) continue;
    const int number = terminal(axis, function.pin);
    const bool delays = is_filtered(axis, function.pin);
    if (const MachineEdges::Span* const span = delays ? nullptr : edges.span_of(number)) {
      const bool is_inside = span->level_inside == *active;
      (is_inside ? found.add(function.signal, span->first, span->last, span->slack)
                 : found.add_outside(function.signal, span->first, span->last, span->slack));
    } else if (!delays && edges.index.period != 0 && edges.index.input == number) {
      const MachineEdges::Index& index = edges.index;
      const bool is_inside = index.level_inside == *active;
      found.index_period = index.period;
      found.index_at = is_inside ? index.at : index.at + index.width;
      found.index_width = is_inside ? index.width : index.period - index.width;
      found.index_from = index.first;
      found.index_to = index.last;
    } else {
      found.set_steady(function.signal, ((unit.pins.passed & bit_of(function.pin)) != 0) == *active);
    }
  }
  found.set_steady(motion::Signal::emergency, unit.emergency);
  auto machine = edges.encoder.as<motion::EncoderLine>();
  machine.factor = machine_options().edges_per_encoder_count;
  if (machine.is_known()) found.encoder = encoder_line(unit, machine);
  motion::Environment& environment = state_.environment[axis];
  found.version = environment.version;
  if (found == environment) return;
  ++found.version;
  environment = found;
}

void Chip::rearm(std::size_t axis) {
  const AxisUnit& unit = state_.units[axis];
  motion::Events asked = state_.sync.triggers[axis].factors;
  for (std::size_t i = 0; i < kIsrFactors; ++i) {
    const bool is_asked = machine_options().all_factors_are_noted || (unit.factors >> i & 1) != 0;
    if (is_asked) asked |= motion::bit(kFactorEvents[i]);
  }
  // A scan uses only C+ (7.4.12).
  const LineScan& scan = state_.scans[axis];
  constexpr motion::Events kOfPlus =
      motion::bit(motion::Event::comparator_0) | motion::bit(motion::Event::comparator_1);
  if (scan.set) asked &= static_cast<motion::Events>(~kOfPlus);
  arm(unit, state_.motors[axis], asked, machine_options().axis);
  update_environment(axis);
}

void Chip::rearm_all() {
  for (std::size_t a = 0; a < kAxes; ++a) rearm(a);
}

void Chip::set_edges(std::size_t axis, const MachineEdges& edges) {
  (*edges_)[axis] = edges;
  update_environment(axis);
}

}  // namespace understudy::emulator::models::rs_m8194h
