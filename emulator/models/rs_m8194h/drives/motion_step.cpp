#include "emulator/models/rs_m8194h/drives/motion_step.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/simulated_time.h"
#include "emulator/device/clear_travel.h"
#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/chip/paths.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "motion/axis.h"
#include "motion/coordinated.h"
#include "motion/profile.h"
#include "motion/shared_tick.h"

namespace understudy::emulator::models::rs_m8194h {

void MotionStep::step(Tick tick) {
  const bool was_full = chip_.paths().together.engaged && chip_.paths().together.run.queued() > 1;
  step_axes(tick);
  on_path_speed(tick);
  streams_.on_path_end(was_full);
  for (std::size_t a = 0; a < kAxes; ++a) {
    // The input only stops a motion that it has started.
    if (!chip_.motor(a).moving()) chip_.unit(a).external.running = 0;
    if (chip_.unit(a).paused_drive.what != Drive::What::none) drives_.check_paused(a);
  }
  external_.start_waiting();
  scans_.step(tick);
}

void MotionStep::step_axes(Tick tick) {
  std::array<std::int64_t, kAxes> pulses{};
  motion::Coordinated& together = chip_.paths().together;
  std::uint32_t singles = 0;
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!together.takes(a)) singles |= mask_of(a);
  }
  const bool was_engaged = together.engaged;
  motion::step_together({.tick = tick,
                         .axes = chip_.state().motors,
                         .environment = chip_.state().environment,
                         .pulses = pulses},
                        singles, &together, &edges_);
  if (was_engaged) streams_.forget_done();
  for (std::size_t a = 0; a < kAxes; ++a) {
    chip_.unit(a).sent_pulses = pulses[a];
    if (!machine_options().axis.ring_folds && is_beyond_ring(chip_.unit(a))) {
      enter_ring(chip_.unit(a), chip_.motor(a));
      if (!is_beyond_ring(chip_.unit(a))) chip_.rearm(a);
    }
    // The signal may go off before the path stops.
    if (chip_.motor(a).slowing && together.takes(a)) chip_.unit(a).met |= error_of(chip_.motor(a).cause);
  }
}

/// Handles C-STA and C-END of a path. They belong to its axis1.
void MotionStep::on_path_speed(Tick tick) {
  if (!machine_options().paths_have_c_sta) return;
  Paths& paths = chip_.paths();
  const motion::Sample along = paths.together.engaged ? paths.together.run.sample(tick) : motion::Sample{};
  const bool is_constant = along.speed_u_s > 0 && along.acceleration_u_s2 == 0;
  const std::int8_t first = paths.together.axis_of[0];
  if (is_constant == (paths.constant_axis >= 0) || (is_constant && first < 0)) return;
  const auto record = [&](motion::Event event) {
    interrupts_.check_factors(static_cast<std::size_t>(paths.constant_axis), motion::bit(event), tick);
  };
  if (is_constant) {
    paths.constant_axis = first;
    record(motion::Event::constant_started);
  } else {
    record(motion::Event::constant_ended);
    paths.constant_axis = motion::Coordinated::kNone;
  }
}

void MotionStep::fast_forward_to(Tick tick, const ClearTravel& ahead, std::span<std::int64_t> pulses) {
  for (std::size_t a = 0; a < kAxes; ++a) {
    motion::Axis& motor = chip_.motor(a);
    pulses[a] += motor.fast_forward_to(tick - 1);
    chip_.unit(a).sent_pulses = motor.step(tick, chip_.environment(a));
    pulses[a] += chip_.unit(a).sent_pulses;
    const auto axis = static_cast<int>(a);
    if (ahead.has_encoder(axis)) chip_.set_encoder(a, ahead.encoder_counts(axis, pulses[a]));
  }
}

// --- many ticks at once ------------------------------------------------------------------------------------

bool MotionStep::rests() const {
  for (std::size_t a = 0; a < kAxes; ++a) {
    const motion::Axis& motor = chip_.motor(a);
    const AxisUnit& unit = chip_.unit(a);
    if (motor.moving() || motor.must_recheck || motor.events != 0 || motor.events_between != 0) return false;
    if (unit.sent_pulses != 0 || chip_.environment(a).version != motor.seen_version) return false;
    if (chip_.is_filtering(a)) return false;
    if (unit.held_drive.what != Drive::What::none && !unit.held) return false;
    if (chip_.scan(a).running) return false;
  }
  return !scans_.is_open() && !chip_.paths().together.engaged && streams_.held().empty();
}

Tick MotionStep::quiet_until(Tick done, Tick last, const ClearTravel& ahead) const {
  if (scans_.is_open() || chip_.paths().together.engaged) return done;
  for (std::size_t a = 0; a < kAxes && last > done; ++a) {
    const AxisUnit& unit = chip_.unit(a);
    const motion::Axis& motor = chip_.motor(a);
    const bool may_enter_ring = is_beyond_ring(unit) && motor.moving();
    if (chip_.is_filtering(a) || may_enter_ring) return done;
    if (unit.out.pulse_until > done) last = std::min(last, unit.out.pulse_until - 1);
    if (unit.held_drive.what != Drive::What::none && !unit.held) return done;
    const PulseRoom room = ahead.room(static_cast<int>(a));
    last = motor.quiet_until(done + 1, last, chip_.environment(a),
                             {.low = motor.travel_pulses + room.min, .high = motor.travel_pulses + room.max});
  }
  // Held paths are waiting for an axis to stop.
  return streams_.held().empty() || chip_.driving() != 0 ? last : done;
}

}  // namespace understudy::emulator::models::rs_m8194h
