// The chip's CLR, LTC and ERC (D9x04 to D9x06, D9x09, D9x27, D9x50).
#include "emulator/models/super_40nc/axis/chip_pins.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
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

/// D9x06: from 12 us to 104 ms, in whole ticks; the last one stays until the next start.
constexpr std::array<Tick, 8> kErcTicks{1, 1, 1, 2, 13, 52, 104, kNever};
/// The modes of D9x09.
enum ClearMode : std::uint8_t { kAtOn, kAtOff, kWhileOn, kWhileOff };

}  // namespace

void ChipPins::see_pins() {
  if (!has_chip_pins()) return;
  for (int number = 0; number < kAxisCount; ++number) {
    const auto n = static_cast<std::size_t>(number);
    const bool clears = input(chip_pin_of(number, kClearPin)) != 0;
    const auto mode = registers().of(kept_x(d9x::kClrSignal), number);
    const bool has_edge = clears != axes_.clears_seen[n] && ground_.state().has_ticked;
    if (has_edge && mode == (clears ? kAtOn : kAtOff)) clear_by_pin(number);
    axes_.clears_seen[n] = clears;
    const bool latches = input(chip_pin_of(number, kLatchPin)) != 0;
    const bool rises = latches && !axes_.latches_seen[n] && ground_.state().has_ticked;
    if (rises && registers().of(kept_x(d9x::kLatchOfCounters), number) == 0)
      counters_.take_latch(number, chip(number).travel_pulses);
    axes_.latches_seen[n] = latches;
  }
}

/// Clears at the end of each tick while the level lasts.
void ChipPins::hold_cleared() {
  if (!has_chip_pins()) return;
  for (int number = 0; number < kAxisCount; ++number) {
    const bool is_on = axes_.clears_seen[static_cast<std::size_t>(number)];
    if (registers().of(kept_x(d9x::kClrSignal), number) == (is_on ? kWhileOn : kWhileOff))
      clear_by_pin(number);
  }
}

/// Clears the counters in the mask D9x27.
void ChipPins::clear_by_pin(int axis) {
  const std::int32_t mask = registers().raw(kept_x(d9x::kClrResetC), axis);
  for (int which = 0; which < static_cast<int>(kCounters); ++which) {
    if (is_bit(mask, which) && counter(axis, which) != 0) parameters_.set_counter(axis, which, 0);
  }
}

void ChipPins::give_erc(int axis) {
  if (!has_chip_pins()) return;
  const Tick ticks = kErcTicks[static_cast<std::size_t>(registers().of(kept_x(d9x::kErcSignal), axis))];
  axes_.erc_until[static_cast<std::size_t>(axis)] = ticks == kNever ? kNever : now() + 1 + ticks;
}

/// Gives ERC, which clears the drive's deviation counter, after a stop without a ramp.
void ChipPins::give_erc_behind(int axis, Code code) {
  const Settings settings = registers();
  const bool is_limit = code == Code::limit_positive || code == Code::limit_negative;
  const bool at_once = (is_limit && !settings.is_on(kept_x(d9x::kOtStop), axis)) ||
                       (code == Code::alarm && !settings.is_on(kept_x(d9x::kAlmStop), axis)) ||
                       code == Code::emergency_input;
  if (at_once && settings.is_on(kept_x(d9x::kElAlmErc), axis)) give_erc(axis);
}

Tick ChipPins::next_end_of_erc(Tick done) const {
  Tick next = kNever;
  for (const Tick until : axes_.erc_until) {
    if (until > done) next = std::min(next, until);
  }
  return next;
}

}  // namespace understudy::emulator::models::super_40nc
