// A read-only view of one axis, including everything that follows from its registers, signals and choices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/simulated_time.h"
#include "emulator/device/clear_travel.h"
#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/axis_slots.h"
#include "emulator/models/simple2_r3/setup.h"
#include "emulator/models/simple2_r3/signals.h"
#include "emulator/models/simple2_r3/state.h"
#include "emulator/models/simple2_r3/transitions.h"
#include "motion/following.h"
#include "motion/ramp.h"

namespace understudy::emulator::models::simple2_r3 {

class AxisView {
 public:
  AxisView(const State& state, const Setup& setup, int number)
      : view_(state), setup_(setup), number_(number) {}

  const AxisState& state() const { return view_.axes[index()]; }
  const AxisSlots& slots() const { return kAxisSlots[index()]; }
  bool alarm() const { return signals().alarm(number_); }

  /// Returns the pulses per revolution. The result is never 0, because callers divide by it. The register may
  /// contain any value, because a host can write half of it alone.
  std::uint32_t resolution() const;
  std::uint32_t velocity_step_urpm() const;
  /// Returns true if DIR_Polarity reverses the pulses.
  bool reversed() const { return view_.image[slots().direction_polarity] != 0; }
  bool encoder_reversed() const { return view_.image[slots().encoder_polarity] != 0; }
  /// These return the pulses that the device sends.
  std::int64_t sent(std::int64_t commanded) const { return reversed() ? -commanded : commanded; }
  double speed_pps() const;
  std::int64_t pulses_to_come() const { return sent(state().motor.pulses_to_come()); }
  /// Returns the coordinate after these pulses.
  std::int32_t coordinate_after(std::int64_t commanded) const;

  DriveSettings drive_settings() const;
  SkipContext skip_context(Tick done, const ClearTravel& ahead) const;

 protected:
  int number() const { return number_; }
  std::size_t index() const { return static_cast<std::size_t>(number_); }
  Signals signals() const { return {view_, setup_}; }
  bool chose(const Option& option) const { return setup_.chose(option); }
  Tick now() const { return setup_.now(); }

  /// Returns true if SVOFF has any effect.
  bool servo_matters() const;
  /// Returns true if the servo is off, and that has an effect.
  bool lacks_servo() const { return !state().motor.servo_on && servo_matters(); }
  /// Returns true if commands need Ready, and it is missing.
  bool lacks_ready() const;
  bool is_refused_as_too_fast(std::int64_t milli_rpm) const;
  /// Returns the reaction of the axis to an event, in its present state and with the selected options.
  Outcome reaction(Event event) const;
  /// Returns the phase in which the axis meets the event.
  Phase phase_met(Event event) const;
  // Say why a command has no effect (axis_reasons.cpp): in its cell of the transitions, if `outcome` is one
  // without effect; or for the reasons that come before them.
  void tell(Event event, Outcome outcome) const;
  void tell_not_ready(Event event) const;
  void tell_too_fast(Event event) const;
  void tell_no_home() const;
  void tell_clears_already() const;
  void tell_refused(Event event) const;
  /// Notes that the axis, in its present activity, meets the event (device/decisions.h).
  void note(Phase phase, Event event) const;
  /// Returns `towards` if an active limit forbids this direction, otherwise `away`.
  Event event_by_direction(int direction, Event towards, Event away) const;
  /// Returns the speed law of a position move, which appendix A and the 100 kHz limit determine.
  motion::SpeedLaw law_of(std::uint32_t speed_rpm, std::uint32_t acceleration_10ms,
                          std::uint32_t deceleration_10ms) const;
  /// Returns the speed in velocity and sync mode, with the sign of the axis's direction, or 0 if a limit
  /// blocks the axis.
  double speed_of_pulses() const;
  motion::Follower sync_follower() const;
  /// Returns the count of the encoder that sync mode follows.
  std::int64_t followed_count() const {
    return view_.axes[setup_.sync_follows_other ? 1 - index() : index()].encoder_counts;
  }

  const Setup& setup() const { return setup_; }

 private:
  /// Returns the resolution in velocity mode: the present value, or the value at the last velocity command.
  std::uint32_t resolution_in_velocity() const {
    return setup_.velocity_settings_latched ? state().velocity_resolution : resolution();
  }

  void say(std::string_view effect, std::string_view why) const;
  std::string phase_words(Phase phase) const;
  std::optional<std::size_t> deciding_choice(const Transition& row) const;

  const State& view_;
  const Setup& setup_;
  const int number_;
};

inline std::uint32_t AxisView::resolution() const {
  const std::uint32_t written = view_.image[slots().resolution];
  return written == 0 ? 1 : written < 0x8000'0000U ? written : 0x8000'0000U;
}

inline std::uint32_t AxisView::velocity_step_urpm() const {
  const std::uint32_t written = view_.image[slots().velocity_acceleration];
  return setup_.velocity_unit_urpm * (written == 0 ? 1 : written);
}

// Called for each axis in every tick. Because there are two callers, the compiler would not inline it
// automatically.
[[gnu::always_inline]] inline DriveSettings AxisView::drive_settings() const {
  DriveSettings settings{.encoder_counts = followed_count(),
                         .stops_with_encoder = setup_.stops_with_encoder,
                         .pulses_by_speed_before = setup_.velocity_pulses_first};
  if (state().mode == Mode::velocity) {
    settings.pulses_per_revolution = resolution_in_velocity();
    settings.velocity_step_urpm =
        setup_.velocity_settings_latched ? state().velocity_step_urpm : velocity_step_urpm();
  }
  return settings;
}

inline std::int32_t AxisView::coordinate_after(std::int64_t commanded) const {
  const std::int64_t counted = setup_.quirk_coordinate_counts_physical_sense ? sent(commanded) : commanded;
  const std::int64_t sum = state().coordinate_pulses + counted;
  if (setup_.coordinate_saturates && sum != static_cast<std::int32_t>(sum)) {
    return sum < 0 ? INT32_MIN : INT32_MAX;
  }
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(sum));
}

}  // namespace understudy::emulator::models::simple2_r3
