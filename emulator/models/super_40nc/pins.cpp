// Terminals that are fitted only by choice: DOG_X, Vin1 and SVON_X on, and the chip's CLR, LTC and ERC (D9x04
// to D9x06, D9x09, D9x27, D9x50).
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/models/super_40nc/axis_state.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/names.h"
#include "emulator/models/super_40nc/options.h"
#include "emulator/models/super_40nc/registers.h"
#include "emulator/models/super_40nc/row_words.h"
#include "emulator/models/super_40nc/settings.h"
#include "emulator/models/super_40nc/terminals.h"
#include "motion/unit_scale.h"

namespace understudy::emulator::models::super_40nc {

namespace {

/// D9x06: from 12 us to 104 ms, in whole ticks; the last one stays until the next start.
constexpr std::array<Tick, 8> kErcTicks{1, 1, 1, 2, 13, 52, 104, kNever};
/// The modes of D9x09.
enum ClearMode : std::uint8_t { kAtOn, kAtOff, kWhileOn, kWhileOff };

}  // namespace

bool Super40nc::has_terminal(int terminal) const {
  if (terminal < kFirstDogTerminal) return true;
  if (terminal < kFirstVoltageIn) return chose(option("dog_inputs", "terminals_of_their_own"));
  if (terminal < kFirstServoTerminal) return has_voltage_inputs();
  if (terminal < kFirstChipPin) return chose(option("servo_on", "an_output_per_axis"));
  return has_chip_pins();
}

std::int32_t Super40nc::analog_counts(int number) const {
  if (!has_voltage_inputs()) return input(kFirstAnalogIn + number);
  const std::int32_t full = chose(option("analog_counts", "5_v")) ? kMaxMillivoltsIn : kMaxMillivolts;
  const std::int32_t millivolts = std::min(input(kFirstVoltageIn + number), full);
  return (millivolts * kMaxAnalogCount + full / 2) / full;
}

void Super40nc::see_pins() {
  if (!has_chip_pins()) return;
  for (int number = 0; number < kAxisCount; ++number) {
    const auto n = static_cast<std::size_t>(number);
    const bool clears = input(chip_pin_of(number, kClearPin)) != 0;
    const auto mode = registers().of(kept_x(d9x::kClrSignal), number);
    const bool has_edge = clears != state_.clears_seen[n] && state_.has_ticked;
    if (has_edge && mode == (clears ? kAtOn : kAtOff)) clear_by_pin(number);
    state_.clears_seen[n] = clears;
    const bool latches = input(chip_pin_of(number, kLatchPin)) != 0;
    const bool rises = latches && !state_.latches_seen[n] && state_.has_ticked;
    if (rises && registers().of(kept_x(d9x::kLatchOfCounters), number) == 0)
      take_latch(number, chip(number).travel_pulses);
    state_.latches_seen[n] = latches;
  }
}

/// Clears at the end of each tick while the level lasts.
void Super40nc::hold_cleared() {
  if (!has_chip_pins()) return;
  for (int number = 0; number < kAxisCount; ++number) {
    const bool is_on = state_.clears_seen[static_cast<std::size_t>(number)];
    if (registers().of(kept_x(d9x::kClrSignal), number) == (is_on ? kWhileOn : kWhileOff))
      clear_by_pin(number);
  }
}

/// Clears the counters in the mask D9x27.
void Super40nc::clear_by_pin(int axis) {
  const std::int32_t mask = registers().raw(kept_x(d9x::kClrResetC), axis);
  for (int which = 0; which < static_cast<int>(kCounters); ++which) {
    if ((mask >> which & 1) != 0 && counter(axis, which) != 0) set_counter(axis, which, 0);
  }
}

void Super40nc::give_erc(int axis) {
  if (!has_chip_pins()) return;
  const Tick ticks = kErcTicks[static_cast<std::size_t>(registers().of(kept_x(d9x::kErcSignal), axis))];
  state_.erc_until[static_cast<std::size_t>(axis)] = ticks == kNever ? kNever : now() + 1 + ticks;
}

/// Gives ERC, which clears the drive's deviation counter, after a stop without a ramp.
void Super40nc::give_erc_behind(int axis, Code code) {
  const Settings settings = registers();
  const bool is_limit = code == Code::limit_positive || code == Code::limit_negative;
  const bool at_once = (is_limit && !settings.is_on(kept_x(d9x::kOtStop), axis)) ||
                       (code == Code::alarm && !settings.is_on(kept_x(d9x::kAlmStop), axis)) ||
                       code == Code::emergency_input;
  if (at_once && settings.is_on(kept_x(d9x::kElAlmErc), axis)) give_erc(axis);
}

/// If D8x17 is a counter of its own, another CMX or CDV leaves it unchanged.
void Super40nc::keep_display(int axis_number) {
  AxisState& state = axis(axis_number);
  const motion::UnitScale scale = registers().scale(axis_number);
  const motion::UnitScale before = std::exchange(state.scale_seen, scale);
  if (before == scale || !chose(option("positions_model", "a_counter_that_keeps_its_value"))) return;
  const std::int64_t pulses = machine_pulses(axis_number);
  state.offset_lu += before.to_units(pulses).value_or(0) - scale.to_units(pulses).value_or(0);
}

}  // namespace understudy::emulator::models::super_40nc
