// One axis of Simple2-R3: what it does in each of its modes. Positions, homing, limits and following are
// motion/'s; velocity mode is counted here as the firmware counts it, in whole numbers at 2 kHz.
#pragma once

#include <array>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/simple2_r3/reactions.h"
#include "motion/axis.h"
#include "motion/homing_tables.h"

namespace understudy::emulator::models::simple2_r3 {

/// Aaxis_Mode, Baxis_Mode.
enum class Mode : std::uint8_t { position = 0, velocity = 1, pwm = 2, sync = 3 };

/// Whose trigger register reads 1.
enum class Command : std::uint8_t { none, incremental, absolute, homing };

/// What a tick needs lies side by side: the beginning of `motor` on two cache lines, and one line from `mode`
/// to the beginning of `signals` (a test checks this). With many devices every further line costs time.
struct alignas(64) AxisState {
  motion::Axis motor;

  alignas(64) Mode mode = Mode::position;
  Command command = Command::none;
  bool homed = false;
  bool has_own_speed = false;  // the move that runs was started with Speed, AccTime and DecTime of the axis
  bool by_trigger = false;     // ... and by the trigger register itself
  bool cut_short = false;      // the last move or homing was cut short
  bool alarm_latched = false;  // if a choice makes the alarm outlast its input
  std::uint8_t pwm_percent = 0;
  std::int32_t coordinate_pulses = 0;
  std::uint32_t velocity_step_urpm =
      1;                              // as the last velocity command found it, for the choice that wants this
  std::int64_t pulses_this_tick = 0;  // as they leave the device: after DIR_Polarity
  Tick alarm_clear_until = 0;         // the first tick at which ACLR is over
  std::int64_t encoder_raw = 0;       // as the plant has it
  std::int64_t encoder_counts = 0;    // since power-up, each by the polarity of its moment
  // For ENCx_RPM: when the counts last changed.
  static constexpr Tick kSpeedWindow = 100;
  Tick encoder_changed = -kSpeedWindow;
  motion::Surroundings signals;  // the inputs that the motor meets, by their functions

  // What velocity and PWM mode are to do. While a limit or an alarm forbids it, it waits; what does not wait
  // is set to 0 then (reactions.h).
  std::int64_t target_urpm = 0;  // 1000 a mRPM
  std::int64_t speed_urpm = 0;
  std::int64_t velocity_phase = 0;        // of the pulse being made, in 1 / kVelocityPhase
  std::uint32_t velocity_resolution = 1;  // as velocity_step_urpm

  std::int64_t encoder_preset = 0;    // what a write to ENCx added
  std::int64_t encoder_followed = 0;  // counts that sync mode has taken
  // For ENCx_RPM: the counts at the ends of the last ticks, in a ring by tick.
  std::array<std::int64_t, kSpeedWindow + 1> encoder_history{};

  bool operator==(const AxisState&) const = default;
};

inline constexpr std::int64_t kMaxPulseRate_pps = 100'000;  // appendix B
inline constexpr int kSyncPeriod = 5;                       // ticks: 200 Hz (appendix B)

/// A velocity of 1 uRPM at 1 pulse a revolution makes one pulse in this many steps of 0.5 ms.
inline constexpr std::int64_t kVelocityPhase = 60'000'000LL * 2000;

/// The register values that one axis tick depends on.
struct DriveSettings {
  std::uint32_t pulses_per_revolution = 1;
  std::uint32_t velocity_step_urpm = 1;  // the change of speed in 0.5 ms
  std::int64_t encoder_counts = 0;       // of the encoder that sync mode follows
  bool stops_with_encoder = false;       // sync mode, without its slope
  bool pulses_by_speed_before = false;   // in velocity mode a step's pulses come before its change of speed
};

/// One tick: the pulses in the commanded sense.
std::int64_t step_drive(AxisState& axis, const DriveSettings& settings, Tick tick);

/// The encoder's count at the end of a tick, for its speed.
void remember_encoder(AxisState& axis, Tick tick);
/// Asks for the memory that a tick needs.
void prefetch(const AxisState& axis, Tick tick);

/// What it does, which way (0: none) and in which phase; the caller knows about servo_off.
Doing doing(const AxisState& axis);
int heading(const AxisState& axis);
Phase phase_of(const AxisState& axis, Tick now);

/// Velocity mode towards `target_mrpm`, from the present speed if it runs already. The caller asks
/// reactions.h whether it may; so for the two below.
void run_velocity(AxisState& axis, std::int64_t target_mrpm);
/// Runs at the wanted velocity, if nothing forbids it.
void resume_velocity(AxisState& axis);
/// No pulses from now on; it goes on with what is wanted as soon as that is allowed.
void halt_velocity(AxisState& axis);
/// Follows an encoder that stands at `counts`, from now on.
void follow_encoder(AxisState& axis, const motion::Follower& by, std::int64_t counts);
/// Goes on following, remainders included, whatever stopped the motor.
void keep_following(AxisState& axis);

/// PWM mode at once, 0 to 100 percent.
void output_pwm(AxisState& axis, std::uint8_t percent);
/// The duty at the output: 0 while an alarm forbids it.
std::uint8_t pwm_duty(const AxisState& axis);

/// Stops all output; the mode becomes position mode.
void stop_drive(AxisState& axis);

/// The plant's encoder stands at `raw` now.
void count_encoder(AxisState& axis, std::int64_t raw, bool reversed);

/// Homing that looks for the switch only once, in either direction, slows down there, and stays.
motion::HomingProgram homing_to_first_edge(const motion::Simple2Homing& how);

/// How far the running position move still has to go, signed; at speed 0 that is all of it. 0 for what is
/// being stopped, and for homing.
std::int64_t remaining_pulses(const AxisState& axis);

/// The running move goes on to the same coordinate, although that is `pulses` farther from now on.
void keep_target(AxisState& axis, std::int64_t pulses, Tick now);

/// How pulses follow an encoder.
struct SyncSettings {
  std::int64_t numerator = 1;  // pulses = counts * numerator / denominator
  std::int64_t denominator = 1;
  std::int64_t top_speed_pps = 0;
  std::int64_t slope_pps = 0;  // for each 5 ms; 0: without bound
  bool catches_up = false;
};
motion::Follower follower_by(SyncSettings settings);

/// How an encoder's speed is measured.
struct SpeedMeter {
  Tick window = AxisState::kSpeedWindow;  // at most that
  std::uint32_t counts_per_revolution = 1;
  bool wraps = false;  // wraps beyond 16 bits; otherwise it stays at their limit
};

/// Counts a minute's revolutions over the last ticks, as 16 bits with a sign.
std::int64_t encoder_rpm(const AxisState& axis, Tick now, const SpeedMeter& meter);

/// In the commanded sense, at the end of tick `now`.
double speed_pps(const AxisState& axis, Tick now, std::uint32_t pulses_per_revolution);

/// STATUS bits 4 and 5.
bool is_moving(const AxisState& axis);

/// The first tick after `done` at which it may change by itself.
Tick next_active_tick(const AxisState& axis, Tick done);

}  // namespace understudy::emulator::models::simple2_r3
