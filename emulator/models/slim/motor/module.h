// A module of the chain: a motor with its own units, speeds, outputs and FIFO. The axis itself and its
// environment are stored together with those of the other modules (chain/chain_state.h), because coordinated
// motion uses arrays.
#pragma once

#include <array>
#include <cstdint>

#include "emulator/models/slim/motor/fifo.h"
#include "emulator/models/slim/motor/jobs.h"
#include "emulator/models/slim/motor/outputs.h"
#include "emulator/models/slim/rules/chain_options.h"
#include "emulator/models/slim/rules/errors.h"
#include "motion/axis.h"
#include "motion/move.h"
#include "motion/unit_scale.h"

namespace understudy::emulator::models::slim {

inline constexpr int kModules = 8;
inline constexpr int kOutputs = 4;
inline constexpr std::size_t kFifoLength = 32;
inline constexpr int kFullAnalog = 1000;
/// No machine has speeds or accelerations outside these limits, and they may be impossible to plan. (The
/// lower limit is 1e-6 as a 32-bit real.)
inline constexpr double kMinSpeed = 1e-6F;
inline constexpr double kMaxSpeed = 1e9;

/// FU: the unit of VM and VJ. VA is in this unit per second.
enum class SpeedUnit : std::uint8_t { rpm = 0, rps = 1 };

struct ModuleSettings {
  motion::UnitScale scale{};  // PN45 pulses = PN46 user units
  std::int32_t pulses_per_revolution = 10'000;
  SpeedUnit speed_unit = SpeedUnit::rpm;
  double working_speed = 1000;               // VM, > 0
  double jog_speed = 100;                    // VJ; < 0 swaps JGF and JGR; 0: moves without pulses
  double acceleration = 10'000;              // VA, > 0
  double path_acceleration_units_s2 = 1000;  // PR2, > 0
  double path_speed_units_s = 100;           // PR3, > 0
  double smooth_corner_deg = 0;              // PR7; only that of module 0 is used
  double line_speed_units_s = 100;           // PR4, > 0, if lines of two axes use it

  bool operator==(const ModuleSettings&) const = default;
};

/// What a module's axis is doing.
enum class Activity : std::uint8_t {
  idle,
  move,  // the head of the FIFO
  home,  // the head of the FIFO
  jog,
  thrust,
  group,     // coordinated motion
  stopping,  // slowing down after its motion was discarded
};

struct Module {
  ModuleSettings settings;
  bool linked = false;
  bool homed = false;
  Activity activity = Activity::idle;
  std::int8_t jog_direction = 0;       // the direction of the running jog
  std::int8_t next_jog_direction = 0;  // the jog that begins when the running motion has stopped
  std::int32_t next_thrust = 0;        // the thrust that begins then
  std::int8_t held_jog_direction = 0;  // the jog that continues after the pause
  std::int32_t held_thrust = 0;        // the thrust that continues then
  bool analog_speed = false;           // AVM
  bool starved = false;                // slowed down because AVM specifies no speed
  std::int16_t analog = 0;             // 0 .. kFullAnalog
  std::int32_t thrust = 0;             // FT's operand during thrust; otherwise 0
  std::int64_t zero_pulses = 0;        // travel at which the coordinate is 0
  double place_units = 0;              // at rest, the commanded coordinate, which the travel rounds
  std::int64_t sent_pulses = 0;        // pulses sent in the last tick, with sign
  Error late_error = Error::none;      // the error of a queued command when it reached the head
  std::array<Output, kOutputs> outputs{};
  std::array<PositionTrigger, 2> triggers{};
  Fifo<Job, kFifoLength> fifo;

  bool operator==(const Module&) const = default;

  /// Returns true if a pause has stopped a jog or thrust.
  bool holds_jog() const { return held_jog_direction != 0 || held_thrust != 0; }
  bool jogs_or_pushes() const { return activity == Activity::jog || activity == Activity::thrust; }
  /// Returns true if the module is active, or a command is waiting for it.
  bool busy() const { return activity != Activity::idle || !fifo.empty() || holds_jog(); }
  /// Returns the activity of the module, even if it is paused.
  Activity activity_or_held() const;

  // ---- With its axis
  double coordinate(const motion::Axis& axis) const { return units_of(axis.travel_pulses - zero_pulses); }
  /// Both functions return the state after all commands in the FIFO. `number` is the module's own.
  bool servo_expected(const motion::Axis& axis) const;
  double end_expected(int number, const motion::Axis& axis) const;

  /// Converts to pulses, rounded half away from zero.
  std::int64_t pulses_of(double units) const;
  double units_of(std::int64_t pulses) const;
  /// Returns true if the coordinate can be counted.
  bool reaches(double units) const;

  /// Returns the factor that AVM applies to VM and VJ, 0 .. 1.
  double analog_factor() const;
  motion::SpeedLaw working_law(const ChainOptions& options) const;
  /// Returns the law of a jog. If VJ is 0, its top speed is 0.
  motion::SpeedLaw jog_law(const ChainOptions& options) const;
};

}  // namespace understudy::emulator::models::slim
