// One axis of Simple2-R3, in each of its modes. motion/ provides positions, homing, limits and following;
// velocity mode is counted here as the firmware counts it, in whole numbers at 2 kHz.
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

/// The members that a tick needs are adjacent: the beginning of `motor` occupies two cache lines, and
/// everything from `mode` to the beginning of `signals` one line (a test checks this). With many devices,
/// every further line costs time.
struct alignas(64) AxisState {
  motion::Axis motor;

  alignas(64) Mode mode = Mode::position;
  Command command = Command::none;
  bool homed = false;
  bool has_own_speed = false;  // the running move was started with Speed, AccTime and DecTime of the axis
  bool by_trigger = false;     // the trigger register itself started it
  bool cut_short = false;      // the last move or homing was cut short
  bool alarm_latched = false;  // used if a choice makes the alarm outlast its input
  std::uint8_t pwm_percent = 0;
  std::int32_t coordinate_pulses = 0;
  // The value at the last velocity command, for the choice that latches it.
  std::uint32_t velocity_step_urpm = 1;
  std::int64_t pulses_this_tick = 0;  // the pulses as they leave the device, after DIR_Polarity
  Tick alarm_clear_until = 0;         // first tick after the end of ACLR
  std::int64_t encoder_raw = 0;       // the encoder as the plant reports it
  std::int64_t encoder_counts = 0;    // counts since power-up, each with the polarity at its time
  // For ENCx_RPM: when the counts last changed.
  static constexpr Tick kSpeedWindow = 100;
  Tick encoder_changed = -kSpeedWindow;
  motion::Environment signals;  // inputs that affect the motor, by their functions

  // The targets of velocity and PWM mode. A target waits while a limit or an alarm forbids it; a target that
  // does not wait is set to 0 (transitions.h).
  std::int64_t target_urpm = 0;  // 1000 uRPM are 1 mRPM
  std::int64_t speed_urpm = 0;
  std::int64_t velocity_phase = 0;        // phase of the current pulse, in 1 / kVelocityPhase
  std::uint32_t velocity_resolution = 1;  // latched like velocity_step_urpm

  std::int64_t encoder_preset = 0;    // added by writes to ENCx
  std::int64_t encoder_followed = 0;  // counts that sync mode has used
  // For ENCx_RPM: the counts at the ends of the last ticks, in a ring indexed by tick.
  std::array<std::int64_t, kSpeedWindow + 1> encoder_history{};

  bool operator==(const AxisState&) const = default;
};

inline constexpr std::int64_t kMaxPulseRate_pps = 100'000;  // appendix B
inline constexpr int kSyncPeriod = 5;                       // ticks: 200 Hz (appendix B)

/// A velocity of 1 uRPM at 1 pulse per revolution makes one pulse in this many steps of 0.5 ms.
inline constexpr std::int64_t kVelocityPhase = 60'000'000LL * 2000;

/// The register values that one axis tick depends on.
struct DriveSettings {
  std::uint32_t pulses_per_revolution = 1;
  std::uint32_t velocity_step_urpm = 1;  // the change of speed in 0.5 ms
  std::int64_t encoder_counts = 0;       // the counts of the encoder that sync mode follows
  bool stops_with_encoder = false;       // in sync mode, ignoring its slope
  bool pulses_by_speed_before = false;   // in velocity mode a step's pulses come before its change of speed
};

/// Runs one tick. Returns the pulses in the commanded direction.
std::int64_t step_drive(AxisState& axis, const DriveSettings& settings, Tick tick);

/// Stores the encoder's count at the end of a tick, for its speed.
void remember_encoder(AxisState& axis, Tick tick);
/// Returns the index of a tick in AxisState::encoder_history.
inline std::size_t ring_place(Tick tick) {
  constexpr Tick kPlaces = AxisState::kSpeedWindow + 1;
  return static_cast<std::size_t>((tick + kPlaces) % kPlaces);
}
/// Prefetches the memory that a tick needs.
void prefetch(const AxisState& axis, Tick tick);

/// Return what the axis does, in which direction (0: none) and in which phase. The caller checks servo_off.
Activity activity(const AxisState& axis);
int heading(const AxisState& axis);
Phase phase_of(const AxisState& axis, Tick now);

/// Runs velocity mode towards `target_mrpm`, from the present speed if it is already running. The caller
/// checks with transitions.h whether it may; likewise for the next two functions.
void run_velocity(AxisState& axis, std::int64_t target_mrpm);
/// Runs at the wanted velocity, if nothing forbids it.
void resume_velocity(AxisState& axis);
/// Sends no pulses from now on. The axis continues towards its target as soon as that is allowed.
void halt_velocity(AxisState& axis);
/// Follows an encoder that is at `counts`, from now on.
void follow_encoder(AxisState& axis, const motion::Follower& by, std::int64_t counts);
/// Continues to follow, remainders included, whatever stopped the motor.
void keep_following(AxisState& axis);

/// Enters PWM mode at once, at 0 to 100 percent.
void output_pwm(AxisState& axis, std::uint8_t percent);
/// Returns the duty at the output: 0 while an alarm forbids it.
std::uint8_t pwm_duty(const AxisState& axis);

/// Stops all output and returns to position mode.
void stop_drive(AxisState& axis);

/// Returns the counts for a plant's encoder at `raw`.
std::int64_t counts_at(const AxisState& axis, std::int64_t raw, bool reversed);
/// Counts the plant's encoder, which is at `raw` now.
void count_encoder(AxisState& axis, std::int64_t raw, bool reversed);

/// Returns a homing that looks for the switch only once, in either direction, slows down there, and stays.
motion::HomingProgram homing_to_first_edge(const motion::Simple2Homing& how);

/// Returns how far the running position move still has to go, signed; at speed 0 that is the whole distance.
/// Returns 0 for a move that is being stopped, and for homing.
std::int64_t remaining_pulses(const AxisState& axis);

/// Keeps the running move's target coordinate, after the coordinate has grown by `pulses`.
void keep_target(AxisState& axis, std::int64_t pulses, Tick now);

/// The settings by which pulses follow an encoder.
struct SyncSettings {
  std::int64_t numerator = 1;  // pulses = counts * numerator / denominator
  std::int64_t denominator = 1;
  std::int64_t top_speed_pps = 0;
  std::int64_t slope_pps = 0;  // for each 5 ms; 0: no limit
  bool catches_up = false;
};
motion::Follower follower_by(SyncSettings settings);

/// The settings by which an encoder's speed is measured.
struct SpeedMeter {
  Tick window = AxisState::kSpeedWindow;  // at most kSpeedWindow
  std::uint32_t counts_per_revolution = 1;
  bool wraps = false;  // true: wraps beyond 16 bits; false: stays at their limits
};

/// Returns the revolutions per minute over the last ticks, as a signed 16-bit value.
std::int64_t encoder_rpm(const AxisState& axis, Tick now, const SpeedMeter& meter);

/// Returns the speed in the commanded direction, at the end of tick `now`.
double speed_pps(const AxisState& axis, Tick now, std::uint32_t pulses_per_revolution);

/// Returns true in velocity mode if the axis itself generates pulses.
bool runs_velocity(const AxisState& axis);
/// Returns the speed that velocity mode will reach: the target, restricted by limits and pulse rate.
std::int64_t final_urpm(const AxisState& axis, const DriveSettings& settings);

/// Returns the axis's moving bit of STATUS (4 or 5).
bool is_moving(const AxisState& axis);

/// Returns the first tick after `done` at which the axis may change without a command.
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

/// Returns the last tick, up to `limit`, through which the axis merely continues, or skip_context.done if the
/// next tick is not quiet.
Tick quiet_until(const AxisState& axis, const SkipContext& skip_context, Tick limit);
/// Brings the axis to `tick`. Returns the pulses, in the commanded direction.
std::int64_t fast_forward(AxisState& axis, const SkipContext& skip_context, Tick tick);

}  // namespace understudy::emulator::models::simple2_r3
