// A tick of the motion chip: the motors, then what their events bring about.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <tuple>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/clear_travel.h"
#include "emulator/models/rs_m8194h/axis_settings.h"
#include "emulator/models/rs_m8194h/axis_unit.h"
#include "emulator/models/rs_m8194h/module.h"
#include "emulator/models/rs_m8194h/options.h"
#include "emulator/models/rs_m8194h/state.h"
#include "emulator/models/rs_m8194h/terminals.h"
#include "emulator/models/rs_m8194h/transitions.h"
#include "motion/axis.h"
#include "motion/coordinated.h"
#include "motion/encoder_line.h"
#include "motion/move.h"
#include "motion/profile.h"
#include "motion/pulse_drive.h"
#include "motion/shared_tick.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

/// Triggers nearer than 10 us to the last one are left out: 100 of them fit into a tick (7.4.12).
constexpr std::int64_t kMaxTriggersOfATick = 100;

}  // namespace

void Module::step_axes(Tick tick) {
  std::array<std::int64_t, kAxes> pulses{};
  motion::Coordinated& together = state_.paths.together;
  std::uint32_t singles = 0;
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!together.takes(a)) singles |= mask_of(a);
  }
  const bool was_engaged = together.engaged;
  motion::step_together(
      {.tick = tick, .axes = state_.motors, .environment = state_.environment, .pulses = pulses}, singles,
      &together, this);
  if (was_engaged && !state_.loaded.empty()) {
    const auto done = std::min(state_.loaded.size(), static_cast<std::size_t>(together.run.completed()));
    state_.loaded.erase(state_.loaded.begin(), state_.loaded.begin() + static_cast<std::ptrdiff_t>(done));
  }
  for (std::size_t a = 0; a < kAxes; ++a) {
    state_.units[a].sent_pulses = pulses[a];
    if (!machine_.axis.ring_folds && is_beyond_ring(state_.units[a])) {
      enter_ring(state_.units[a], state_.motors[a]);
      if (!is_beyond_ring(state_.units[a])) rearm(a);
    }
    // It may be back before the path stands.
    if (state_.motors[a].slowing && together.takes(a))
      state_.units[a].met |= error_of(state_.motors[a].cause);
  }
}

/// A path that has ended in this tick.
void Module::on_path_end(bool was_full) {
  Paths& paths = state_.paths;
  const bool in_stream = paths.together.engaged && paths.runs == Paths::Runs::stream;
  const bool has_room = in_stream && paths.open && paths.together.run.queued() < 2;
  if (machine_.a_segment_may_come_sets_rint && was_full && has_room) state_.rint |= bit_of(Rint::stream);
  // The last segment has begun.
  const bool is_last = machine_.last_ramp_is_in_last_segment && in_stream && !paths.open &&
                       paths.together.run.open() && paths.together.run.queued() < 2;
  if (is_last) paths.together.run.set_open(false, now());
  if (paths.together.engaged || paths.runs == Paths::Runs::nothing) return;
  const bool starved =
      paths.runs == Paths::Runs::stream && paths.open && paths.together.cause == motion::Cause::arrived;
  const bool is_broken_off = paths.runs == Paths::Runs::stream &&
                             paths.together.cause != motion::Cause::arrived &&
                             (paths.open || !state_.loaded.empty());
  if (starved) state_.rint |= bit_of(Rint::stream);
  if (is_broken_off) break_off_stream();
  paths.open = starved;
  paths.runs = Paths::Runs::nothing;
}

/// C-STA and C-END of a path, for its axis1.
void Module::on_path_speed(Tick tick) {
  if (!machine_.paths_have_c_sta) return;
  Paths& paths = state_.paths;
  const motion::Sample along = paths.together.engaged ? paths.together.run.sample(tick) : motion::Sample{};
  const bool is_constant = along.speed_u_s > 0 && along.acceleration_u_s2 == 0;
  const std::int8_t first = paths.together.axis_of[0];
  if (is_constant == (paths.constant_axis >= 0) || (is_constant && first < 0)) return;
  const auto tell = [&](motion::Event event) {
    check_factors(static_cast<std::size_t>(paths.constant_axis), motion::bit(event), tick);
  };
  if (is_constant) {
    paths.constant_axis = first;
    tell(motion::Event::constant_started);
  } else {
    tell(motion::Event::constant_ended);
    paths.constant_axis = motion::Coordinated::kNone;
  }
}

void Module::note_factor(std::size_t axis, Factor factor) {
  state_.factor_axes[static_cast<std::size_t>(factor)] |= mask_of(axis);
}

void Module::mark_isr(std::size_t axis, std::uint8_t source, Tick tick) {
  const auto is_same = [&](const IsrMark& mark) { return mark.axis == axis && mark.source == source; };
  const bool is_lost = !options_.isr_requests_are_counted || state_.marks.size() >= kMaxMarks;
  if (is_lost && std::any_of(state_.marks.begin(), state_.marks.end(), is_same)) return;
  IsrMark made{.tick = tick, .axis = static_cast<std::uint8_t>(axis), .source = source};
  const bool needs_number = options_.isrs_are_bound_at_the_event || options_.isrs_go_by_number;
  if (needs_number) made.number = static_cast<std::uint8_t>(isr_of(made));
  const auto& enabled = state_.enabled;
  const auto turn_of = [&](const IsrMark& mark) {
    return std::find(enabled.begin(), enabled.end(), name_of_source(mark.axis, mark.source)) -
           enabled.begin();
  };
  const auto is_before = [&](const IsrMark& one, const IsrMark& other) {
    if (options_.isrs_go_by_enabling) {
      return std::tuple(one.tick, turn_of(one), one) < std::tuple(other.tick, turn_of(other), other);
    }
    if (options_.isrs_go_by_number) {
      return std::tie(one.tick, one.number, one.axis, one.source) <
             std::tie(other.tick, other.number, other.axis, other.source);
    }
    if (!options_.isrs_go_by_factor) return one < other;
    return std::tie(one.tick, one.source, one.axis) < std::tie(other.tick, other.source, other.axis);
  };
  state_.marks.insert(std::upper_bound(state_.marks.begin(), state_.marks.end(), made, is_before), made);
}

void Module::note_enabled(std::size_t axis, std::uint8_t source, bool is_on) {
  std::erase(state_.enabled, name_of_source(axis, source));
  if (is_on) state_.enabled.push_back(name_of_source(axis, source));
}

/// V has changed: a T-shaped drive goes on at the new one, an S-shaped one keeps its own (7.1).
void Module::change_speed(std::size_t axis, motion::Instant at) {
  const AxisUnit& unit = state_.units[axis];
  const bool keeps_its_own =
      kNormalShapes[unit.speed.mode].s_curve && chose(option("speed_change_in_s", "the_next_drive"));
  if (activity(axis) != Activity::single || keeps_its_own) return;
  motion::Axis& motor = state_.motors[axis];
  // The ramps are those of the drive.
  motion::SpeedLaw law = motor.law;
  const double wanted = law_of(axis).top_speed_u_s;
  law.start_speed_u_s = std::min(law.start_speed_u_s, wanted);
  law.top_speed_u_s = wanted;
  motor.change_speed(law, at);
  if (state_.units[axis].external_free_ns != 0) {
    const double left_s = motor.drive.profile.duration_s - motor.drive.elapsed_s(at);
    const auto at_ns = time_of(at.tick).count() + static_cast<std::int64_t>(at.after_s * 1e9);
    state_.units[axis].external_free_ns = after(at_ns, left_s);
  }
}

void Module::give_pulse(std::size_t axis, Tick tick, std::int64_t pulses) {
  // SET_OUT knows X and Y (7.3.9).
  if (axis >= static_cast<std::size_t>(kOuts)) return;
  // Whole ticks of PulseWidth; shorter pulses are counted only.
  static constexpr std::array<Tick, 8> kWidths{0, 0, 0, 0, 1, 2, 10, 20};
  OutSettings& out = state_.units[axis].out;
  out.pulses += pulses;
  out.pulse_until = tick + kWidths[out.width_code % kWidths.size()];
}

/// What the counter that LINE_SCAN's Type names has counted: a ring comes round in it, and it may be set.
std::int64_t Module::scan_travel(std::size_t axis) const {
  const motion::Axis& motor = state_.motors[axis];
  if (state_.scans[axis].type < 2) return motor.travel_pulses;
  const motion::EncoderLine& encoder = state_.environment[axis].encoder;
  return encoder.is_known() ? encoder.at(motor.travel_pulses) : encoder_travel(state_.units[axis], motor);
}

std::int64_t Module::scan_spacing(const LineScan& scan) const {
  const bool is_as_printed = machine_.pitch_is_distance && scan.pitch > 0;
  return std::max<std::int64_t>(std::abs(std::int64_t{scan.pitch}) + (is_as_printed ? 0 : 1), 1);
}

/// C+ is where the next trigger would have been.
void Module::end_scan(std::size_t axis) {
  LineScan& scan = state_.scans[axis];
  if (chose(option("scan_comparator", "the_next_trigger"))) {
    const std::int64_t direction = scan_travel(axis) < scan.begin ? -1 : +1;
    const std::int64_t next = scan.begin + direction * (scan.triggered + 1) * scan_spacing(scan);
    const AxisUnit& unit = state_.units[axis];
    const motion::Counter& counter = scan.type >= 2 ? unit.encoder : unit.logic;
    state_.units[axis].compare[0] = {.value = static_cast<std::int32_t>(counter.at(next)),
                                     .source = static_cast<std::uint8_t>(scan.type >= 2 ? 1 : 0)};
  }
  const bool lasts = chose(option("scan_setting_lasts", "until_the_next_setting"));
  if (!lasts && chose(option("scan_output", "that_of_set_out_which_comes_back"))) {
    state_.units[axis].out.level = scan.level_before;
    state_.units[axis].out.width_code = scan.width_before;
  }
  scan = lasts ? LineScan{.set = true,
                          .type = scan.type,
                          .pitch = scan.pitch,
                          .level_before = scan.level_before,
                          .width_before = scan.width_before}
               : LineScan{};
  rearm(axis);
}

void Module::begin_scans(AxisMask axes) {
  if (axes == 0) return;
  state_.rint &= static_cast<std::uint8_t>(~bit_of(Rint::line_scan));
  state_.scanning |= axes;
}

void Module::step_scans(Tick tick) {
  if (state_.scanning == 0) return;
  bool runs = false;
  for (std::size_t a = 0; a < kAxes; ++a) {
    LineScan& scan = state_.scans[a];
    if (!scan.running) continue;
    const std::int64_t passed = std::abs(scan_travel(a) - scan.begin) / scan_spacing(scan);
    if (passed > scan.triggered) {
      const std::int64_t most = machine_.all_scan_triggers_are_given ? INT64_MAX : kMaxTriggersOfATick;
      const std::int64_t given = std::min(passed - scan.triggered, most);
      give_pulse(a, tick, given);
      scan.triggered = passed;
    }
    // An encoder that does not go along tells of the last pulses a tick later.
    const AxisUnit& unit = state_.units[a];
    const bool lags = scan.type >= 2 && unit.has_encoder && !state_.environment[a].encoder.is_known() &&
                      unit.sent_pulses != 0;
    if (!is_driving(a) && !lags) end_scan(a);
    runs = runs || scan.running;
  }
  if (!runs && (driving() & state_.scanning) == 0) {
    state_.scanning = 0;
    state_.rint |= bit_of(Rint::line_scan);
  }
}

// --- many ticks at once ------------------------------------------------------------------------------------

Tick Module::next_event_tick(Tick done, Tick most, const ClearTravel& ahead) const {
  const bool is_simple = !state_.touched && state_.marks.empty() && state_.scanning == 0 &&
                         !state_.paths.together.engaged && state_.steps_left == options_.steps_a_tick;
  if (!is_simple || is_resetting() || state_.execution.is_alive() || !state_.queued_triggers.empty())
    return done + 1;
  Tick last = std::min(most, state_.eeprom.next_active_tick() - 1);
  if (state_.unscanned || state_.sent != state_.outputs) last = std::min(last, next_scan(done) - 1);
  for (std::size_t a = 0; a < kAxes && last > done; ++a) {
    const AxisUnit& unit = state_.units[a];
    const bool may_enter_ring = is_beyond_ring(unit) && state_.motors[a].moving();
    if (is_filtering(unit) || may_enter_ring) return done + 1;
    if (unit.out.pulse_until > done) last = std::min(last, unit.out.pulse_until - 1);
    if (unit.held_drive.what != Drive::What::none && !unit.held) return done + 1;
    const motion::Axis& motor = state_.motors[a];
    const PulseRoom room = ahead.room(static_cast<int>(a));
    last =
        motor.quiet_until(done + 1, last, state_.environment[a],
                          {.low = motor.travel_pulses + room.least, .high = motor.travel_pulses + room.most});
  }
  // What waits in the FIFO waits for an axis to stand.
  if (!state_.held_paths.empty() && driving() == 0) return done + 1;
  if (!state_.fifo.waiting.empty() && driving() == 0) return done + 1;
  return last + 1;
}

void Module::fast_forward_to(Tick tick, const ClearTravel& ahead, std::span<std::int64_t> pulses) {
  for (std::size_t a = 0; a < kAxes; ++a) {
    motion::Axis& motor = state_.motors[a];
    pulses[a] += motor.fast_forward_to(tick - 1);
    state_.units[a].sent_pulses = motor.step(tick, state_.environment[a]);
    pulses[a] += state_.units[a].sent_pulses;
    const auto axis = static_cast<int>(a);
    if (ahead.has_encoder(axis)) set_encoder(a, ahead.encoder_counts(axis, pulses[a]));
  }
}

}  // namespace understudy::emulator::models::rs_m8194h
