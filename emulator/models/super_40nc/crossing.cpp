// Many ticks in one step, while a SUPER-40NC only counts: the PLC has settled, no step program runs, and axes
// meet nothing.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/clear_travel.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis_state.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/names.h"
#include "emulator/models/super_40nc/ownership.h"
#include "emulator/models/super_40nc/program_machine.h"
#include "emulator/models/super_40nc/registers.h"
#include "emulator/models/super_40nc/row_words.h"
#include "emulator/models/super_40nc/settings.h"
#include "emulator/models/super_40nc/terminals.h"
#include "interpreter/super_40nc/operand.h"
#include "interpreter/super_40nc/plc.h"
#include "motion/axis.h"

namespace understudy::emulator::models::super_40nc {

namespace {

/// Returns true if COUNTER4 or the comparators 4 and 5 latch at the end of a tick: such ticks are run.
bool latches_by_comparator(const Settings& settings, int axis) {
  return settings.of(kept_x(d9x::kLatchOfCounters), axis) >= 2;
}

}  // namespace

/// Returns the ticks in which the PLC needs no scan, if nothing that it reads changes.
Tick Super40nc::quiet_scans(bool moves) const {
  if (ladder_->is_empty() || !state_.plc.runs) return kNever;
  return moves && watched_.some_move ? 0 : state_.plc_quiet_scans;
}

/// Signals have ticks of their own, and a PLC that reads moving values scans in each tick.
bool Super40nc::output_moves(int /*terminal*/) const { return false; }

bool Super40nc::scans_in(Tick tick) const {
  const bool is_one_of_them = options_.scan_ms <= 1 || tick % options_.scan_ms == 0;
  return is_one_of_them && tick >= state_.flash_until;
}

/// A scan that has changed nothing is the same again until something that it reads changes. Writes by hosts
/// and step programs are noted (touched, programs_are_busy()); other values are checked in each tick that is
/// run. In skipped ticks only moving values change, as their rows say (Varies).
void Super40nc::find_what_plc_watches() {
  using language::Letter;
  watched_.places.clear();
  watched_.some_move = false;
  for (const language::Operand& read : ladder_->reads()) {
    Place place;
    if (read.letter == Letter::x) {
      place = at(Table::discrete, static_cast<std::uint16_t>(read.number));
    } else if (read.letter == Letter::y) {  // signals come and go
      place = at(Table::coil, static_cast<std::uint16_t>(read.number));
    } else if (is_special(read)) {
      place = read.letter == Letter::m ? at(Table::coil, relay_address(read.number))
                                       : at(Table::holding, data_address(read.number));
    }
    if (!place) continue;
    place.part = Place::Part::whole;
    watched_.places.push_back(place);
    watched_.some_move |= place.row->moves();
  }
}

void Super40nc::note_what_plc_sees() {
  watched_.seen.resize(watched_.places.size());
  for (std::size_t i = 0; i < watched_.places.size(); ++i)
    watched_.seen[i] = read_value(*this, watched_.places[i]);
}

/// Checks at the end of a tick whether the PLC must scan.
void Super40nc::wake_plc_by_what_changed() {
  const bool sleeps = !ladder_->is_empty() && state_.plc.runs && state_.plc_quiet_scans > 0;
  if (!sleeps) return;
  bool is_as_seen = watched_.seen.size() == watched_.places.size();  // else the ladder has been replaced
  for (std::size_t i = 0; is_as_seen && i < watched_.places.size(); ++i)
    is_as_seen = read_value(*this, watched_.places[i]) == watched_.seen[i];
  if (!is_as_seen) state_.plc_quiet_scans = 0;
}

bool Super40nc::is_quiet(int axis_number) const {
  const motion::Axis& motor = chip(axis_number);
  const AxisState& state = axis(axis_number);
  return !motor.moving() && !motor.must_recheck && motor.events == 0 && motor.events_between == 0 &&
         !counts_a_clock(axis_number) && state.sent_pulses == 0 && state.followed_pulses == 0 &&
         environment(axis_number).version == motor.seen_version;
}

Tick Super40nc::next_active_tick(Tick done) const {
  const bool scans = !ladder_->is_empty() && state_.plc.runs;  // scans are skipped in bulk, not left out
  if (scans || state_.touched || inputs_changed() || programs_are_busy() || has_errors_for_a_scan()) {
    return done + 1;
  }
  for (int number = 0; number < kAxisCount; ++number) {
    if (!is_quiet(number)) return done + 1;
  }
  return next_timed_tick(done);
}

Tick Super40nc::next_event_tick(Tick done, Tick most, const ClearTravel& ahead) const {
  if (state_.touched || inputs_changed() || programs_are_busy() || has_errors_for_a_scan() ||
      state_.path.engaged || input(kWheelTerminal) != state_.wheel_edges || has_chip_pins()) {
    return done + 1;
  }
  const bool moves = std::any_of(state_.chips.begin(), state_.chips.end(),
                                 [](const motion::Axis& chip) { return chip.moving(); });
  Tick last = std::min(most, next_timed_tick(done) - 1);
  if (const Tick scans = quiet_scans(moves); scans < last - done) last = done + scans;
  for (int number = 0; number < kAxisCount && last > done; ++number) {
    const motion::Axis& motor = chip(number);
    const AxisState& state = axis(number);
    if (is_quiet(number)) continue;
    if (counts_a_clock(number) || state.masked || motor.homing.active() || state.compares_by_tick != 0 ||
        state.holder == Activity::wheel || latches_by_comparator(registers(), number)) {
      return done + 1;
    }
    PulseRoom room = ahead.room(number);
    if (motor.inverted) room = {.least = -room.most, .most = -room.least};
    last =
        motor.quiet_until(done + 1, last, environment(number),
                          {.low = motor.travel_pulses + room.least, .high = motor.travel_pulses + room.most});
  }
  return last + 1;
}

void Super40nc::fast_forward_to(Tick done, Tick tick, const ClearTravel& ahead,
                                std::span<std::int64_t> pulses) {
  const Tick ticks = tick - done;
  state_.has_ticked = true;
  if (!ladder_->is_empty() && state_.plc.runs) {
    ProgramMachine machine(*this);
    language::cross(state_.plc, *ladder_, machine, ticks, options_);
    if (state_.plc_quiet_scans != kNever) state_.plc_quiet_scans -= ticks;
  }
  for (int number = 0; number < kAxisCount; ++number) {
    const auto n = static_cast<std::size_t>(number);
    motion::Axis& motor = chip(number);
    if (is_quiet(number)) continue;
    AxisState& state = axis(number);
    const std::int64_t travel_before = motor.travel_pulses;
    const std::int64_t before_last = tick - 1 > done ? motor.fast_forward_to(tick - 1) : 0;
    const std::int64_t travel_at_last = motor.travel_pulses;
    state.sent_pulses = motor.step(tick, environment(number));
    state.followed_pulses = motor.travel_pulses - travel_at_last;
    count(number, travel_before, 0);
    pulses[n] += before_last + state.sent_pulses;
    if (ahead.has_encoder(number)) set_encoder(number, ahead.encoder_counts(number, pulses[n]));
  }
}

}  // namespace understudy::emulator::models::super_40nc
