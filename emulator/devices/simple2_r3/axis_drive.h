// One axis of Simple2-R3: what it does in each of its modes. Positions, homing, limits and following are
// motion/'s; velocity mode is counted here as the firmware counts it, in whole numbers at 2 kHz.
#pragma once

#include <array>
#include <cstdint>

#include "emulator/simulated_time.h"
#include "motion/axis.h"

namespace understudy::emulator::simple2_r3 {

/// Aaxis_Mode, Baxis_Mode.
enum class Mode : std::uint8_t { position = 0, velocity = 1, pwm = 2, sync = 3 };

/// Whose trigger register reads 1.
enum class Command : std::uint8_t { none, incremental, absolute, homing };

struct AxisState {
  motion::Axis motor;
  motion::Surroundings signals;  // the inputs that the motor meets, by their functions
  Mode mode = Mode::position;
  Command command = Command::none;
  bool homed = false;
  std::int32_t coordinate_pulses = 0;
  std::int64_t pulses_this_tick = 0;  // as they leave the device: after DIR_Polarity
  Tick alarm_clear_until = 0;         // the first tick at which ACLR is over

  std::int64_t target_urpm = 0;  // of velocity mode, 1000 a mRPM
  std::int64_t speed_urpm = 0;
  std::int64_t velocity_phase = 0;  // of the pulse being made, in 1 / kVelocityPhase

  std::uint8_t pwm_percent = 0;

  std::int64_t encoder_counts = 0;    // as the plant has them
  std::int64_t encoder_preset = 0;    // what a write to ENCx added
  std::int64_t encoder_followed = 0;  // counts that sync mode has taken
  // For ENCx_RPM: the counts at the ends of the last ticks, in a ring by tick, and when they last changed.
  static constexpr Tick kSpeedWindow = 100;
  std::array<std::int64_t, kSpeedWindow + 1> encoder_history{};
  Tick encoder_changed = -kSpeedWindow;

  bool operator==(const AxisState&) const = default;
};

inline constexpr std::int64_t kMaxPulseRate_pps = 100'000;  // appendix B

/// A velocity of 1 uRPM at 1 pulse a revolution makes one pulse in so many steps of 0.5 ms.
inline constexpr std::int64_t kVelocityPhase = 60'000'000LL * 2000;

/// What of the registers a tick of an axis looks at.
struct DriveSettings {
  std::uint32_t pulses_per_revolution = 1;
  std::uint32_t velocity_step_urpm = 1;  // the change of speed in 0.5 ms
  bool encoder_reversed = false;
};

/// One tick: the pulses in the commanded sense.
std::int64_t step_drive(AxisState& axis, const DriveSettings& settings, Tick tick);

/// The encoder's count at the end of a tick, for its speed.
void remember_encoder(AxisState& axis, Tick tick);

/// Velocity mode towards `target_mrpm`, from the present speed if it runs already.
/// What it is refused for, nothing has changed then.
motion::Cause run_velocity(AxisState& axis, std::int64_t target_mrpm);
/// Follows the encoder from now on.
motion::Cause follow_encoder(AxisState& axis, const motion::Follower& by);

/// PWM mode at once, 0 to 100 percent. What it is refused for, nothing has changed then.
motion::Cause output_pwm(AxisState& axis, std::uint8_t percent);

/// Nothing is output any more; the mode is position mode.
void stop_drive(AxisState& axis);

/// Counts a minute's revolutions over the last 100 ms, within 16 bits with a sign.
std::int64_t encoder_rpm(const AxisState& axis, Tick now, std::uint32_t counts_per_revolution, bool reversed);

/// In the commanded sense, at the end of tick `now`.
double speed_pps(const AxisState& axis, Tick now, std::uint32_t pulses_per_revolution);

/// STATUS bits 4 and 5.
bool is_moving(const AxisState& axis);

/// The first tick after `done` at which it may change by itself.
Tick next_active_tick(const AxisState& axis, Tick done);

}  // namespace understudy::emulator::simple2_r3
