// One axis of Simple2-R3, in all of its modes. motion/ implements positions, homing, limits and following.
// Velocity mode is calculated here in the same way as in the firmware, with integers at 2 kHz.
#pragma once

#include <array>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/device/clear_travel.h"
#include "emulator/models/simple2_r3/transitions.h"
#include "motion/axis.h"
#include "motion/homing_tables.h"

namespace understudy::emulator::models::simple2_r3 {

/// The values of Aaxis_Mode and Baxis_Mode.
enum class Mode : std::uint8_t { position = 0, velocity = 1, pwm = 2, sync = 3 };

/// The command whose trigger register reads 1.
enum class Command : std::uint8_t { none, incremental, absolute, homing };

/// The members that a tick needs are adjacent: the beginning of `motor` occupies two cache lines, and the
/// members from `mode` to the beginning of `signals` occupy one (a test checks this). With many devices,
/// every further line costs time.
struct alignas(64) AxisState {
  motion::Axis motor;

  alignas(64) Mode mode = Mode::position;
  Command command = Command::none;
  bool homed = false;
  bool has_own_speed = false;  // the running move uses Speed, AccTime and DecTime of the axis
  bool by_trigger = false;     // the trigger register started it
  bool cut_short = false;      // the last move or homing was cut short
  bool alarm_latched = false;  // used if a choice keeps the alarm after its input goes off
  std::uint8_t pwm_percent = 0;
  std::int32_t coordinate_pulses = 0;
  // The value at the last velocity command, for the choice that latches it.
  std::uint32_t velocity_step_urpm = 1;
  std::int64_t pulses_this_tick = 0;  // pulses that the device sends, after applying DIR_Polarity
  Tick alarm_clear_until = 0;         // first tick after the end of ACLR
  std::int64_t encoder_raw = 0;       // the encoder count that the plant reports
  std::int64_t encoder_counts = 0;    // counts since power-up, each counted with the polarity of its time
  // For ENCx_RPM: when the counts last changed.
  static constexpr Tick kSpeedWindow = 100;
  Tick encoder_changed = -kSpeedWindow;
  motion::Environment signals;  // inputs that affect the motor, by function

  // The targets of velocity and PWM mode. While a limit or an alarm forbids a target, the target either waits
  // or is set to 0 (transitions.h).
  std::int64_t target_urpm = 0;  // 1000 uRPM = 1 mRPM
  std::int64_t speed_urpm = 0;
  std::int64_t velocity_phase = 0;        // phase of the current pulse, in 1 / kVelocityPhase
  std::uint32_t velocity_resolution = 1;  // latched like velocity_step_urpm

  std::int64_t encoder_preset = 0;    // added by writes to ENCx
  std::int64_t encoder_followed = 0;  // counts that sync mode has already used
  // For ENCx_RPM: the counts at the ends of the last ticks, in a ring buffer indexed by tick.
  std::array<std::int64_t, kSpeedWindow + 1> encoder_history{};

  bool operator==(const AxisState&) const = default;
};

inline constexpr std::int64_t kMaxPulseRate_pps = 100'000;  // appendix B
inline constexpr int kSyncPeriod = 5;                       // ticks: 200 Hz (appendix B)

/// A velocity of 1 uRPM with 1 pulse per revolution results in one pulse per this many steps of 0.5 ms.
inline constexpr std::int64_t kVelocityPhase = 60'000'000LL * 2000;

/// The register values that a tick of an axis needs.
struct DriveSettings {
  std::uint32_t pulses_per_revolution = 1;
  std::uint32_t velocity_step_urpm = 1;  // the change of speed per 0.5 ms
  std::int64_t encoder_counts = 0;       // the count of the encoder that sync mode follows
  bool stops_with_encoder = false;       // in sync mode, ignoring its slope
  bool pulses_by_speed_before = false;   // in velocity mode, the pulses of a step precede its change of speed
};

/// Runs one tick. Returns the pulses in the commanded direction.
std::int64_t step_drive(AxisState& axis, const DriveSettings& settings, Tick tick);

/// Records the encoder count at the end of a tick, for measuring its speed.
void remember_encoder(AxisState& axis, Tick tick);
/// Returns the index of a tick in AxisState::encoder_history.
inline std::size_t ring_place(Tick tick) {
  constexpr Tick kPlaces = AxisState::kSpeedWindow + 1;
  return static_cast<std::size_t>((tick + kPlaces) % kPlaces);
}
/// Prefetches the memory that a tick needs.
void prefetch(const AxisState& axis, Tick tick);

/// These return what the axis is doing, in which direction (0: none) and in which phase. They ignore
/// servo_off, which the caller must check.
Activity activity(const AxisState& axis);
int heading(const AxisState& axis);
Phase phase_of(const AxisState& axis, Tick now);

/// Runs velocity mode towards `target_mrpm`, from the present speed if it is already running. For this and
/// the next two functions, the caller must check with transitions.h whether they are allowed.
void run_velocity(AxisState& axis, std::int64_t target_mrpm);
/// Runs at the wanted velocity, if nothing forbids it.
void resume_velocity(AxisState& axis);
/// Sends no further pulses. The axis continues towards its target as soon as that is allowed.
void halt_velocity(AxisState& axis);
/// From now on, follows an encoder whose present count is `counts`.
void follow_encoder(AxisState& axis, const motion::Follower& by, std::int64_t counts);
/// Continues to follow, including remainders, after anything that stopped the motor.
void keep_following(AxisState& axis);

/// Switches to PWM mode immediately, with 0 to 100 percent.
void output_pwm(AxisState& axis, std::uint8_t percent);
/// Returns the duty cycle at the output: 0 while an alarm forbids it.
std::uint8_t pwm_duty(const AxisState& axis);

/// Stops all output and returns to position mode.
void stop_drive(AxisState& axis);

/// Returns the device's count when the plant's encoder is at `raw`.
std::int64_t counts_at(const AxisState& axis, std::int64_t raw, bool reversed);
/// Updates the count: the plant's encoder is at `raw` now.
void count_encoder(AxisState& axis, std::int64_t raw, bool reversed);

/// Returns a homing program that searches for the switch only once, in either direction, slows down there,
/// and stays.
motion::HomingProgram homing_to_first_edge(const motion::Simple2Homing& how);

/// Returns the signed remaining distance of the running position move; at speed 0, this is the whole
/// distance. Returns 0 for a move that is being stopped, and for homing.
std::int64_t remaining_pulses(const AxisState& axis);

/// Keeps the target coordinate of the running move after the coordinate has changed by `pulses`.
void keep_target(AxisState& axis, std::int64_t pulses, Tick now);

/// The settings for following an encoder.
struct SyncSettings {
  std::int64_t numerator = 1;  // pulses = counts * numerator / denominator
  std::int64_t denominator = 1;
  std::int64_t top_speed_pps = 0;
  std::int64_t slope_pps = 0;  // per 5 ms; 0: no limit
  bool catches_up = false;
};
motion::Follower follower_by(SyncSettings settings);

/// The settings for measuring the speed of an encoder.
struct SpeedMeter {
  Tick window = AxisState::kSpeedWindow;  // at most kSpeedWindow
  std::uint32_t counts_per_revolution = 1;
  bool wraps = false;  // true: wraps beyond 16 bits; false: saturates
};

/// Returns the speed over the last ticks in revolutions per minute, as a signed 16-bit value.
std::int64_t encoder_rpm(const AxisState& axis, Tick now, const SpeedMeter& meter);

/// Returns the speed in the commanded direction, at the end of tick `now`.
double speed_pps(const AxisState& axis, Tick now, std::uint32_t pulses_per_revolution);

/// Returns true if the axis is in velocity mode and itself generates pulses.
bool runs_velocity(const AxisState& axis);
/// Returns the speed that velocity mode will reach: the target, reduced by limits and the pulse rate.
std::int64_t final_urpm(const AxisState& axis, const DriveSettings& settings);

/// Returns the axis's moving bit of STATUS (4 or 5).
bool is_moving(const AxisState& axis);

/// Returns the first tick after `done` in which the axis may change without a command.
Tick next_active_tick(const AxisState& axis, Tick done);

// --- many ticks in one step: axis_fast_forward.cpp ------------------------------------------------------

/// The conditions for fast-forwarding an axis.
struct SkipContext {
  Tick done = 0;  // the last completed tick
  DriveSettings settings;
  bool reversed = false;          // DIR_Polarity
  bool encoder_reversed = false;  // the encoder's polarity
  int axis = 0;
  const ClearTravel* ahead = nullptr;
};

/// Returns the last tick, up to `limit`, until which the axis only continues, or skip_context.done if the
/// next tick is not quiet.
Tick quiet_until(const AxisState& axis, const SkipContext& skip_context, Tick limit);
/// Advances the axis to `tick`. Returns the pulses in the commanded direction.
std::int64_t fast_forward(AxisState& axis, const SkipContext& skip_context, Tick tick);

}  // namespace understudy::emulator::models::simple2_r3
