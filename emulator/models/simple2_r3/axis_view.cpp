#include "emulator/models/simple2_r3/axis_view.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/device/clear_travel.h"
#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/options.h"
#include "emulator/models/simple2_r3/transition_tables.h"
#include "emulator/models/simple2_r3/transitions.h"
#include "motion/axis.h"
#include "motion/following.h"
#include "motion/ramp.h"

namespace understudy::emulator::models::simple2_r3 {

bool AxisView::servo_matters() const {
  return !chose(option("servo_unassigned", "no_effect")) || signals().assigned(slots().servo_output_assigned);
}

bool AxisView::lacks_ready() const {
  return chose(option("ready_gates", "yes")) && signals().assigned(slots().ready_assigned) &&
         !signals().ready(number_);
}

bool AxisView::is_refused_as_too_fast(std::int64_t milli_rpm) const {
  if (!chose(option("pulse_rate_cap", "command_dropped"))) return false;
  const std::int64_t size = milli_rpm < 0 ? -milli_rpm : milli_rpm;
  return size * resolution() > kMaxPulseRate_pps * 60'000;
}

Phase AxisView::phase_met(Event event) const {
  const bool needs_servo = has(transitions::kCommands, event) &&
                           !(has(transitions::kDuties, event) && chose(transitions::kPwmNeedsNoServo));
  return needs_servo && lacks_servo() ? Phase::servo_off : phase_of(state(), now());
}

Outcome AxisView::reaction(Event event) const {
  const Phase phase = phase_met(event);
  note(phase, event);
  const Transition* row = reaction_row(activity(state()), phase, event);
  if (row == nullptr) return Outcome::continues;
  for (const OtherOutcome& other : {row->other, row->another}) {
    if (other.exists && chose(other.chosen)) return other.outcome;
  }
  return row->outcome;
}

void AxisView::note(Phase phase, Event event) const {
  setup_.device.decisions().meet(kReactions, reaction_state(activity(state()), phase),
                                 static_cast<std::size_t>(event));
}

Event AxisView::event_by_direction(int direction, Event towards, Event away) const {
  const motion::Cause why_not = state().motor.forbidden(direction);
  const bool into = why_not == motion::Cause::limit_plus || why_not == motion::Cause::limit_minus;
  return into ? towards : away;
}

motion::SpeedLaw AxisView::law_of(std::uint32_t speed_rpm, std::uint32_t acceleration_10ms,
                                  std::uint32_t deceleration_10ms) const {
  // A time of 0 counts as 1 (appendix A), which is 10 ms unless a choice makes it shorter.
  const double min_s = chose(option("least_ramp", "1ms"))     ? 0.001
                       : chose(option("least_ramp", "500us")) ? 0.0005
                                                              : 0.01;
  const auto by_time = [&](std::uint32_t time_10ms) {
    return motion::RampLaw::by_time(time_10ms == 0 ? min_s : time_10ms / 100.0);
  };
  const double speed_pps = static_cast<double>(speed_rpm) * resolution() / 60.0;
  return {.top_speed_u_s = std::min(speed_pps, static_cast<double>(kMaxPulseRate_pps)),
          .up = by_time(acceleration_10ms),
          .down = by_time(deceleration_10ms)};
}

double AxisView::speed_pps() const {
  const double speed = simple2_r3::speed_pps(state(), now(), resolution_in_velocity());
  return (reversed() ? -speed : speed) + 0.0;  // 0 has no sign
}

double AxisView::speed_of_pulses() const {
  const double speed_pps = simple2_r3::speed_pps(state(), now(), resolution_in_velocity());
  const bool is_free = state().motor.forbidden(speed_pps < 0 ? -1 : +1) == motion::Cause::none;
  return is_free ? speed_pps : 0;
}

motion::Follower AxisView::sync_follower() const {
  const std::int64_t of_axis = resolution();
  const auto pps = [&](std::uint32_t rpm) {
    return std::clamp<std::int64_t>(rpm * of_axis / 60, 1, kMaxPulseRate_pps);
  };
  const auto& image = view_.image;
  SyncSettings sync{.numerator = image[slots().sync_numerator],
                    .denominator = std::max<std::int64_t>(image[slots().sync_denominator], 1),
                    .top_speed_pps = pps(image[slots().sync_speed]),
                    .catches_up = chose(option("sync_lost_pulses", "caught_up"))};
  if (chose(option("sync_ratio", "revolutions"))) {
    sync.numerator *= of_axis;
    sync.denominator *= std::max<std::int64_t>(image[slots().encoder_resolution], 1);
  }
  // The slope per 5 ms; 0 means no limit.
  const std::uint32_t slope = image[slots().sync_slope];
  if (slope != 0)
    sync.slope_pps =
        chose(option("sync_slope", "pulses")) ? std::int64_t{slope} * 1000 / kSyncPeriod : pps(slope);
  return follower_by(sync);
}

SkipContext AxisView::skip_context(Tick done, const ClearTravel& ahead) const {
  return {.done = done,
          .settings = drive_settings(),
          .reversed = reversed(),
          .encoder_reversed = encoder_reversed(),
          .axis = number_,
          .ahead = &ahead};
}

}  // namespace understudy::emulator::models::simple2_r3
