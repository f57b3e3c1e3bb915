// The chip's CLR, LTC and ERC (D9x04 to D9x06, D9x09, D9x27, D9x50).
#include "emulator/models/super_40nc/axis/chip_pins.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "emulator/models/super_40nc/rows/terminals.h"
#include "interpreter/super_40nc/error.h"

namespace understudy::emulator::models::super_40nc {

namespace {

/// D9x06: from 12 us to 104 ms, in whole ticks. The last one lasts until the next start.
constexpr std::array<Tick, 8> kErcTicks{1, 1, 1, 2, 13, 52, 104, kNever};

}  // namespace

void ChipPins::see_pins() {
  if (!has_chip_pins()) return;
  for (int number = 0; number < kAxisCount; ++number) {
    for (const ChipPin pin : {kClearPin, kLatchPin}) {
      const bool is_on = input(chip_pin_of(number, pin)) != 0;
      if (is_on == pin_seen(number, pin)) continue;
      if (ground_.state().has_ticked) {
        pin_changes(number, pin, is_on, chip_speed(number));
      } else {
        see(number, pin, is_on);
      }
    }
  }
}

void ChipPins::see(int axis, ChipPin pin, bool is_on) {
  (pin == kClearPin ? axes_.clears_seen : axes_.latches_seen)[static_cast<std::size_t>(axis)] = is_on;
}

void ChipPins::pin_changes(int axis, ChipPin pin, bool is_on, std::int64_t speed) {
  see(axis, pin, is_on);
  if (pin == kLatchPin) {
    if (is_on && registers().of(stored_x(d9x::kLatchOfCounters), axis) == 0)
      counters_.take_latch(axis, chip(axis).travel_pulses, speed);
    return;
  }
  const Value mode = registers().of(stored_x(d9x::kClrSignal), axis);
  if (mode == (is_on ? kAtOn : kAtOff) || holds_cleared(axis)) clear_by_pin(axis);
  const bool has_level = mode == kWhileOn || mode == kWhileOff;
  if (has_level) parameters_.apply_axis_parameters(axis, 0);  // comparators do not react to a held counter
}

void ChipPins::hold_cleared() {
  if (!has_chip_pins()) return;
  for (int number = 0; number < kAxisCount; ++number) {
    if (holds_cleared(number)) clear_by_pin(number);
  }
}

void ChipPins::clear_by_pin(int axis) {
  const std::int32_t mask = registers().raw(stored_x(d9x::kClrResetC), axis);
  for (int which = 0; which < static_cast<int>(kCounters); ++which) {
    if (is_bit(mask, which) && counter(axis, which) != 0) parameters_.set_counter(axis, which, 0);
  }
}

void ChipPins::give_erc(int axis) {
  if (!has_chip_pins()) return;
  const Tick ticks = kErcTicks[static_cast<std::size_t>(registers().of(stored_x(d9x::kErcSignal), axis))];
  axes_.erc_until[static_cast<std::size_t>(axis)] = ticks == kNever ? kNever : now() + 1 + ticks;
}

/// After a stop without a ramp, outputs ERC, which clears the drive's deviation counter.
void ChipPins::give_erc_behind(int axis, Code code) {
  const Settings settings = registers();
  const bool is_limit = code == Code::limit_positive || code == Code::limit_negative;
  const bool at_once = (is_limit && !settings.is_on(stored_x(d9x::kOtStop), axis)) ||
                       (code == Code::alarm && !settings.is_on(stored_x(d9x::kAlmStop), axis)) ||
                       code == Code::emergency_input;
  if (at_once && settings.is_on(stored_x(d9x::kElAlmErc), axis)) give_erc(axis);
}

Tick ChipPins::next_end_of_erc(Tick done) const {
  Tick next = kNever;
  for (const Tick until : axes_.erc_until) {
    if (until > done) next = std::min(next, until);
  }
  return next;
}

}  // namespace understudy::emulator::models::super_40nc
