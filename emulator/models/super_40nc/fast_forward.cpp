// Runs many ticks in one step while a SUPER-40NC only counts: the PLC has settled, no step program is
// running, and the axes encounter nothing.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/simulated_time.h"
#include "emulator/device/clear_travel.h"
#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/axis/ownership.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/programs/program_machine.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "emulator/models/super_40nc/rows/terminals.h"
#include "motion/axis.h"

namespace understudy::emulator::models::super_40nc {

/// Ticks in which signals change are run in full, and a PLC that reads moving values scans in each tick.
bool Super40nc::output_moves(int /*terminal*/) const { return false; }

Tick Super40nc::next_timed_tick(Tick done) const {
  const Tick next = std::min(parts_.axes.pins.next_end_of_erc(done), parts_.ground.next_signal_tick(done));
  return std::min(next, std::max(done + 1, state_.logo_at));
}

Tick Super40nc::next_active_tick(Tick done) const {
  const Counters& counters = parts_.axes.counters;
  const bool scans = parts_.programs.plc_scans();  // fast_forward_to() runs them in bulk
  if (scans || state_.touched || inputs_changed() || parts_.programs.are_busy() ||
      parts_.commands.has_errors_for_a_scan()) {
    return done + 1;
  }
  for (int number = 0; number < kAxisCount; ++number) {
    if (!counters.is_quiet(number)) return done + 1;
  }
  return next_timed_tick(done);
}

Tick Super40nc::next_event_tick(Tick done, Tick limit, const ClearTravel& ahead) const {
  if (state_.touched || inputs_changed() || parts_.programs.are_busy() ||
      parts_.commands.has_errors_for_a_scan() || state_.path.engaged ||
      input(kWheelTerminal) != state_.wheel_edges || parts_.axes.pins.has_chip_pins()) {
    return done + 1;
  }
  const Counters& counters = parts_.axes.counters;
  const bool moves = std::any_of(state_.chips.begin(), state_.chips.end(),
                                 [](const motion::Axis& chip) { return chip.moving(); });
  Tick last = std::min(limit, next_timed_tick(done) - 1);
  if (const Tick scans = parts_.programs.quiet_scans(moves); scans < last - done) last = done + scans;
  for (int number = 0; number < kAxisCount && last > done; ++number) {
    const motion::Axis& motor = chips().chip(number);
    const AxisState& state = chips().axis(number);
    if (counters.is_quiet(number)) continue;
    if (state.masked || motor.homing.active() || state.compares_by_tick != 0 ||
        state.holder == Activity::wheel || counters.acts_each_tick(number)) {
      return done + 1;
    }
    PulseRoom room = ahead.room(number);
    if (motor.inverted) room = {.min = -room.max, .max = -room.min};
    last = motor.quiet_until(done + 1, last, chips().environment(number),
                             {.low = motor.travel_pulses + room.min, .high = motor.travel_pulses + room.max});
  }
  return last + 1;
}

void Super40nc::fast_forward_to(Tick done, Tick tick, const ClearTravel& ahead,
                                std::span<std::int64_t> pulses) {
  state_.has_ticked = true;
  parts_.programs.fast_forward(done, tick);
  Counters& counters = parts_.axes.counters;
  for (int number = 0; number < kAxisCount; ++number) {
    const auto n = static_cast<std::size_t>(number);
    motion::Axis& motor = parts_.axes.chips.chip(number);
    if (counters.is_quiet(number)) continue;
    AxisState& state = parts_.axes.chips.axis(number);
    const std::int64_t travel_before = motor.travel_pulses;
    const std::int64_t before_last = tick - 1 > done ? motor.fast_forward_to(tick - 1) : 0;
    const std::int64_t travel_at_last = motor.travel_pulses;
    state.sent_pulses = motor.step(tick, parts_.axes.chips.environment(number));
    state.followed_pulses = motor.travel_pulses - travel_at_last;
    counters.count(number, {.pulses = motor.travel_pulses - travel_before,
                            .backlash = motor.backlash_sent - state.backlash_seen});
    pulses[n] += before_last + state.sent_pulses;
    if (ahead.has_encoder(number)) counters.set_encoder(number, ahead.encoder_counts(number, pulses[n]));
  }
}

}  // namespace understudy::emulator::models::super_40nc
