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
#include "emulator/device/machine_ahead.h"
#include "emulator/models/rs_m8194h/axis_settings.h"
#include "emulator/models/rs_m8194h/axis_unit.h"
#include "emulator/models/rs_m8194h/device.h"
#include "emulator/models/rs_m8194h/meetings.h"
#include "emulator/models/rs_m8194h/options.h"
#include "emulator/models/rs_m8194h/state.h"
#include "emulator/models/rs_m8194h/terminals.h"
#include "motion/axis.h"
#include "motion/coordinated.h"
#include "motion/move.h"
#include "motion/profile.h"
#include "motion/synchronous.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

/// The events that are factors of interrupts, in the order of nINT (7.3.12).
constexpr std::array<motion::Event, kIsrFactors> kFactorEvents{motion::Event::pulse,
                                                               motion::Event::comparator_3,
                                                               motion::Event::comparator_2,
                                                               motion::Event::comparator_1,
                                                               motion::Event::comparator_0,
                                                               motion::Event::constant_ended,
                                                               motion::Event::constant_started,
                                                               motion::Event::ended};

/// Triggers nearer than 10 us to the last one are left out: 100 of them fit into a tick (7.4.12).
constexpr std::int64_t kMostTriggersOfATick = 100;

bool is_endless(motion::SyncAction::Drive drive) {
  using Action = motion::SyncAction::Drive;
  return drive == Action::endless_plus || drive == Action::endless_minus;
}

bool starts_something(motion::SyncAction::Drive drive) {
  using Action = motion::SyncAction::Drive;
  return drive == Action::fixed_plus || drive == Action::fixed_minus || is_endless(drive);
}

}  // namespace

void RsM8194h::step_axes(Tick tick) {
  std::array<std::int64_t, kAxes> pulses{};
  motion::Coordinated& together = state_.paths.together;
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (state_.units[a].has_encoder) heed_encoder(a, tick);
  }
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!together.takes(a)) pulses[a] = state_.motors[a].step(tick, state_.here[a]);
  }
  const bool was_engaged = together.engaged;
  together.step(tick, state_.motors, state_.here, pulses);
  if (was_engaged && !state_.loaded.empty()) {
    const auto done = std::min(state_.loaded.size(), static_cast<std::size_t>(together.run.completed()));
    state_.loaded.erase(state_.loaded.begin(), state_.loaded.begin() + static_cast<std::ptrdiff_t>(done));
  }
  for (std::size_t a = 0; a < kAxes; ++a) {
    state_.units[a].sent_pulses = pulses[a];
    if (!machine_.axis.ring_folds && is_beyond_ring(state_.units[a])) {
      enter_ring(state_.units[a], state_.motors[a]);
      if (!is_beyond_ring(state_.units[a])) look_again(a);
    }
    // It may be back before the path stands.
    if (state_.motors[a].slowing && together.takes(a))
      state_.units[a].met |= error_of(state_.motors[a].cause);
  }
}

/// A soft limit on a bench's encoder, which is told of a pulse in the tick behind it: an axis may have turned
/// round since.
void RsM8194h::heed_encoder(std::size_t axis, Tick tick) {
  motion::Axis& motor = state_.motors[axis];
  AxisUnit& unit = state_.units[axis];
  const bool is_watched =
      motor.moving() && !motor.slowing && (!motor.homing.active() || machine_.axis.homing_heeds_soft_limits);
  if (!is_watched) return;
  constexpr int kBeyond = 1;
  motion::Cause why = soft_limit_by_encoder(unit, motor, static_cast<int>(motor.drive.direction), kBeyond);
  if (why == motion::Cause::none) {
    const int came = unit.sent_pulses < 0 ? -1 : unit.sent_pulses > 0 ? +1 : 0;
    why = soft_limit_by_encoder(unit, motor, came, kBeyond);
  }
  if (why == motion::Cause::none) return;
  const bool slows = machine_.axis.at_soft_limit == motion::Reaction::slow_down;
  motion::Coordinated& together = state_.paths.together;
  if (together.takes(axis)) {
    unit.met |= error_of(why);
    if (slows) slow_path(tick - 1, why);
    if (!slows) together.stop(state_.motors, why);
  } else if (slows) {
    motor.slow_down(tick - 1, why);
  } else {
    motor.stop(why);
  }
}

/// A path that has ended in this tick.
void RsM8194h::heed_path_end(bool was_full) {
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
  paths.let_go = paths.axes;
  // D-END comes in the next tick; who sees that it stands sees why.
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (has(paths.axes, a)) note_end_of_path(a);
  }
  paths.runs = Paths::Runs::nothing;
}

/// C-STA and C-END of a path, for its axis1.
void RsM8194h::heed_path_speed(Tick tick) {
  if (!machine_.paths_have_c_sta) return;
  Paths& paths = state_.paths;
  const motion::Sample along = paths.together.engaged ? paths.together.run.sample(tick) : motion::Sample{};
  const bool is_constant = along.speed_u_s > 0 && along.acceleration_u_s2 == 0;
  const std::int8_t first = paths.together.axis_of[0];
  if (is_constant == (paths.constant_axis >= 0) || (is_constant && first < 0)) return;
  const auto tell = [&](motion::Event event) {
    state_.motors[static_cast<std::size_t>(paths.constant_axis)].events |= motion::bit(event);
  };
  if (is_constant) {
    paths.constant_axis = first;
    tell(motion::Event::constant_started);
  } else {
    tell(motion::Event::constant_ended);
    paths.constant_axis = motion::Coordinated::kNone;
  }
}

void RsM8194h::note_factor(std::size_t axis, Factor factor) {
  state_.factor_axes[static_cast<std::size_t>(factor)] |= mask_of(axis);
}

void RsM8194h::mark_isr(std::size_t axis, std::uint8_t source, Tick tick) {
  const auto is_same = [&](const IsrMark& mark) { return mark.axis == axis && mark.source == source; };
  const bool is_lost = !options_.isr_requests_are_counted || state_.marks.size() >= kMostMarks;
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

void RsM8194h::note_enabled(std::size_t axis, std::uint8_t source, bool is_on) {
  std::erase(state_.enabled, name_of_source(axis, source));
  if (is_on) state_.enabled.push_back(name_of_source(axis, source));
}

void RsM8194h::heed_factors(std::size_t axis, Tick tick) {
  const AxisUnit& unit = state_.units[axis];
  const bool is_noted_always = chose(option("factors_noted", "enabled_ones"));
  for (std::size_t i = 0; i < kIsrFactors; ++i) {
    const bool is_asked = (unit.factors >> i & 1) != 0;
    if ((state_.motors[axis].events & motion::bit(kFactorEvents[i])) == 0) continue;
    if (is_asked && (is_noted_always || state_.interrupts)) note_factor(axis, static_cast<Factor>(i));
    if (machine_.all_factors_are_noted) note_factor(axis, static_cast<Factor>(i));
    if (!is_asked || !state_.interrupts) continue;
    constexpr std::int64_t kMost = kMostMarks;
    const bool is_counted = machine_.each_pulse_is_an_event && kFactorEvents[i] == motion::Event::pulse;
    const std::int64_t times = is_counted ? std::min(std::abs(unit.sent_pulses), kMost) : 1;
    for (std::int64_t k = 0; k < times; ++k) mark_isr(axis, static_cast<std::uint8_t>(i), tick);
  }
}

void RsM8194h::act_on_events(Tick tick) {
  bool any_fires = false;
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (state_.motors[a].events == 0) continue;
    heed_factors(a, tick);
    any_fires = any_fires || (state_.motors[a].events & state_.sync.triggers[a].factors) != 0;
  }
  if (any_fires) act_together(tick);
}

/// Synchronous actions (7.3): the kernel latches, presets and drives; what is the firmware's is done here.
void RsM8194h::act_together(Tick tick) {
  motion::SyncTable acting = state_.sync;
  std::array<bool, kAxes> slows_path{};
  std::array<bool, kAxes> stops_path{};
  std::array<bool, kAxes> begins{};
  for (std::size_t a = 0; a < kAxes; ++a) {
    using Action = motion::SyncAction::Drive;
    motion::SyncAction& action = acting.actions[a];
    acting.speeds[a] = law_of(a);
    // Latches and presets are of the moment of the event; EP counts the pulses where there is no encoder.
    action.latch_command = action.latch_encoder = true;
    const bool on_path = state_.paths.together.takes(a);
    slows_path[a] = on_path && action.drive == Action::slow_down;
    stops_path[a] = on_path && action.drive == Action::stop_at_once;
    const bool sets_speed = action.preset == motion::SyncAction::Preset::speed && action.preset_value > 0;
    const bool has_no_speed = !sets_speed && lacks_speed(a, Drive::What::fixed);
    const bool is_void =
        starts_something(action.drive) && (has_no_speed || may_start(a, Starter::external) != Start::starts);
    if (is_void || on_path) action.drive = Action::none;
    begins[a] = starts_something(action.drive);
  }
  const auto order = machine_.sync_goes_by_moment ? motion::SyncOrder::by_moment : motion::SyncOrder::by_axis;
  const motion::SyncOutcome outcome = motion::act(acting, state_.motors, tick, order);
  state_.sync.distance_pulses = acting.distance_pulses;

  const bool shows_trigger = chose(option("sync_mask", "the_trigger_axis"));
  AxisMask acted = 0;
  for (std::size_t t = 0; t < kAxes; ++t) {
    if (outcome.fired[t] != 0) acted |= state_.sync.triggers[t].activates;
  }
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!has(acted, a)) continue;
    if (begins[a]) {
      take_off(a, WayOut::other_drive);
      state_.units[a].began_pulses = state_.motors[a].travel_pulses;
    }
    AxisUnit& unit = state_.units[a];
    const motion::SyncAction& action = state_.sync.actions[a];
    const motion::SyncTable::Latch& latch = acting.latches[a];
    const std::int64_t encoder = unit.has_encoder ? latch.encoder_pulses : latch.travel_pulses;
    if (action.latch_command || action.latch_encoder) {
      unit.latched = static_cast<std::int32_t>(action.latch_encoder ? unit.encoder.at(encoder)
                                                                    : unit.logic.at(latch.travel_pulses));
    }
    const auto preset = static_cast<std::int32_t>(action.preset_value);
    const bool ring_folds = machine_.axis.ring_folds;
    if (has(outcome.presets_command, a))
      set_count(unit.logic, unit.basic, preset, latch.travel_pulses, ring_folds);
    if (has(outcome.presets_encoder, a)) set_count(unit.encoder, unit.basic, preset, encoder, ring_folds);
    // Of an endless drive it is void (7.3.1).
    if (action.preset == motion::SyncAction::Preset::speed && preset > 0 && !is_endless(action.drive)) {
      unit.speed.drive_pps = static_cast<std::uint32_t>(preset);
      if (!starts_something(action.drive)) change_speed(a);
    }
    if (slows_path[a]) slow_path(tick);
    if (stops_path[a]) state_.paths.together.stop(state_.motors);
    if (slows_path[a] || stops_path[a]) break_off_stream();
    if (has(outcome.outputs, a)) give_pulse(a, tick);
    if (has(outcome.interrupts, a)) {
      for (std::size_t t = 0; t < kAxes; ++t) {
        const bool fired = outcome.fired[t] != 0 && has(state_.sync.triggers[t].activates, a);
        if (fired) note_factor(shows_trigger ? t : a, Factor::synchronous);
      }
      if (state_.interrupts) mark_isr(a, IsrMark::kSynchronous, tick);
    }
    look_again(a);
  }
}

/// V has changed: a T-shaped drive goes on at the new one, an S-shaped one keeps its own (7.1).
void RsM8194h::change_speed(std::size_t axis) {
  const AxisUnit& unit = state_.units[axis];
  const bool keeps_its_own =
      kNormalShapes[unit.speed.mode].s_curve && chose(option("speed_change_in_s", "the_next_drive"));
  if (going(axis) != Going::single || keeps_its_own) return;
  motion::Axis& motor = state_.motors[axis];
  // The ramps are those of the drive.
  motion::SpeedLaw law = motor.law;
  const double wanted = law_of(axis).top_speed_u_s;
  law.start_speed_u_s = std::min(law.start_speed_u_s, wanted);
  law.top_speed_u_s = wanted;
  motor.change_speed(law, now());
  if (state_.units[axis].external_free_ns != 0) {
    const double left_s = motor.drive.profile.duration_s - motor.drive.elapsed_s(now());
    state_.units[axis].external_free_ns = after(time_of(now()).count(), left_s);
  }
}

void RsM8194h::give_pulse(std::size_t axis, Tick tick, std::int64_t pulses) {
  // SET_OUT knows X and Y (7.3.9).
  if (axis >= static_cast<std::size_t>(kOuts)) return;
  // Whole ticks of PulseWidth; shorter pulses are counted only.
  static constexpr std::array<Tick, 8> kWidths{0, 0, 0, 0, 1, 2, 10, 20};
  OutSettings& out = state_.units[axis].out;
  out.pulses += pulses;
  out.pulse_until = tick + kWidths[out.width_code % kWidths.size()];
}

/// What the counter that LINE_SCAN's Type names has counted: a ring comes round in it, and it may be set.
std::int64_t RsM8194h::scan_travel(std::size_t axis) const {
  const motion::Axis& motor = state_.motors[axis];
  return state_.scans[axis].type >= 2 ? encoder_travel(state_.units[axis], motor) : motor.travel_pulses;
}

std::int64_t RsM8194h::scan_spacing(const LineScan& scan) const {
  const bool is_as_printed = machine_.pitch_is_distance && scan.pitch > 0;
  return std::max<std::int64_t>(std::abs(std::int64_t{scan.pitch}) + (is_as_printed ? 0 : 1), 1);
}

/// C+ is where the next trigger would have been.
void RsM8194h::end_scan(std::size_t axis) {
  LineScan& scan = state_.scans[axis];
  if (chose(option("scan_comparator", "the_next_trigger"))) {
    const std::int64_t way = scan_travel(axis) < scan.begin ? -1 : +1;
    const std::int64_t next = scan.begin + way * (scan.triggered + 1) * scan_spacing(scan);
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
  look_again(axis);
}

void RsM8194h::begin_scans(AxisMask axes) {
  if (axes == 0) return;
  state_.rint &= static_cast<std::uint8_t>(~bit_of(Rint::line_scan));
  state_.scanning |= axes;
}

void RsM8194h::step_scans(Tick tick) {
  if (state_.scanning == 0) return;
  bool runs = false;
  for (std::size_t a = 0; a < kAxes; ++a) {
    LineScan& scan = state_.scans[a];
    if (!scan.running) continue;
    const std::int64_t passed = std::abs(scan_travel(a) - scan.begin) / scan_spacing(scan);
    if (passed > scan.triggered) {
      const std::int64_t most = machine_.all_scan_triggers_are_given ? INT64_MAX : kMostTriggersOfATick;
      const std::int64_t given = std::min(passed - scan.triggered, most);
      give_pulse(a, tick, given);
      scan.triggered = passed;
    }
    // An encoder tells of the last pulses a tick later.
    const AxisUnit& unit = state_.units[a];
    const bool lags = scan.type >= 2 && unit.has_encoder && unit.sent_pulses != 0;
    if (!is_driving(a) && !lags) end_scan(a);
    runs = runs || scan.running;
  }
  if (!runs && (driving() & state_.scanning) == 0) {
    state_.scanning = 0;
    state_.rint |= bit_of(Rint::line_scan);
  }
}

// --- many ticks at once ------------------------------------------------------------------------------------

Tick RsM8194h::next_event_tick(Tick done, Tick most, const MachineAhead& ahead) const {
  const bool is_simple = !inputs_changed() && !state_.touched && state_.marks.empty() &&
                         state_.scanning == 0 && !state_.paths.together.engaged && state_.paths.let_go == 0 &&
                         state_.steps_left == options_.steps_a_tick;
  if (!is_simple || is_resetting() || state_.execution.is_alive() || !state_.queued_triggers.empty())
    return done + 1;
  Tick last = std::min(most, state_.eeprom.next_active_tick() - 1);
  if (state_.unscanned || state_.sent != state_.outputs) last = std::min(last, next_scan(done) - 1);
  for (std::size_t a = 0; a < kAxes && last > done; ++a) {
    const AxisUnit& unit = state_.units[a];
    const bool may_enter_ring = is_beyond_ring(unit) && state_.motors[a].moving();
    if (heeds_encoder(unit, state_.motors[a]) || is_filtering(unit) || may_enter_ring) return done + 1;
    if (unit.out.pulse_until > done) last = std::min(last, unit.out.pulse_until - 1);
    if (unit.held_drive.what != Drive::What::none && !unit.held) return done + 1;
    const motion::Axis& motor = state_.motors[a];
    const PulseRoom room = ahead.room(static_cast<int>(a));
    last =
        motor.quiet_until(done + 1, last, state_.here[a],
                          {.low = motor.travel_pulses + room.least, .high = motor.travel_pulses + room.most});
  }
  // What waits in the FIFO waits for an axis to stand.
  if (!state_.held_paths.empty() && driving() == 0) return done + 1;
  if (!state_.fifo.waiting.empty() && driving() == 0) return done + 1;
  return last + 1;
}

void RsM8194h::cross_to(Tick, Tick tick, const MachineAhead& ahead, std::span<std::int64_t> pulses) {
  for (std::size_t a = 0; a < kAxes; ++a) {
    motion::Axis& motor = state_.motors[a];
    pulses[a] += motor.cross_to(tick - 1);
    state_.units[a].sent_pulses = motor.step(tick, state_.here[a]);
    pulses[a] += state_.units[a].sent_pulses;
    const auto axis = static_cast<int>(a);
    if (ahead.has_encoder(axis)) set_encoder(axis, ahead.encoder_counts(axis, pulses[a]));
  }
}

}  // namespace understudy::emulator::models::rs_m8194h
