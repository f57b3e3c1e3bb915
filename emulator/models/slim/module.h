// One module of the chain: a motor with its own units, speeds, outputs and FIFO. The axis itself and its
// surroundings lie beside the others' (chain.h), because coordinated motion takes them as arrays.
#pragma once

#include <array>
#include <cstdint>

#include "emulator/models/slim/chain_options.h"
#include "emulator/models/slim/errors.h"
#include "emulator/models/slim/fifo.h"
#include "emulator/models/slim/jobs.h"
#include "emulator/models/slim/outputs.h"
#include "motion/move.h"
#include "motion/unit_scale.h"

namespace understudy::emulator::models::slim {

inline constexpr int kModules = 8;
inline constexpr int kOutputs = 4;
inline constexpr std::size_t kFifoLength = 32;
inline constexpr int kFullAnalog = 1000;

/// FU: the unit of VM, VJ and, a second, of VA.
enum class SpeedUnit : std::uint8_t { rpm = 0, rps = 1 };

struct ModuleSettings {
  motion::UnitScale scale{};  // PN45 pulses are PN46 user units
  std::int32_t pulses_per_revolution = 10'000;
  SpeedUnit speed_unit = SpeedUnit::rpm;
  double working_speed = 1000;               // VM, > 0
  double jog_speed = 100;                    // VJ; < 0 swaps JGF and JGR; 0: moving, but no pulse
  double acceleration = 10'000;              // VA, > 0
  double path_acceleration_units_s2 = 1000;  // PR2, > 0
  double path_speed_units_s = 100;           // PR3, > 0
  double smooth_corner_deg = 0;              // PR7; module 0's counts
  double line_speed_units_s = 100;           // PR4, > 0, if lines of two axes use it

  bool operator==(const ModuleSettings&) const = default;
};

/// What a module's axis is doing.
enum class Activity : std::uint8_t {
  idle,
  move,  // the FIFO's head
  home,  // the FIFO's head
  jog,
  thrust,
  group,     // coordinated
  stopping,  // slowing down from something that was discarded
};

struct Module {
  ModuleSettings settings;
  bool linked = false;
  bool homed = false;
  Activity activity = Activity::idle;
  std::int8_t jog_way = 0;         // of the jog that runs
  std::int8_t next_jog_way = 0;    // begins when what runs has stopped, or ...
  std::int32_t next_thrust = 0;    // ... this
  std::int8_t held_jog_way = 0;    // goes on when the pause is over, or ...
  std::int32_t held_thrust = 0;    // ... this
  bool analog_speed = false;       // AVM
  bool starved = false;            // slowed down because AVM gives no speed
  std::int16_t analog = 0;         // 0 .. kFullAnalog
  std::int32_t thrust = 0;         // FT's number, while it pushes
  std::int64_t zero_pulses = 0;    // travel where the coordinate is 0
  double place_units = 0;          // at rest: what was commanded, of which travel is the rounding
  std::int64_t sent_pulses = 0;    // of the last tick, as they come out
  Error late_error = Error::none;  // what a queued command met when its turn came
  std::array<Output, kOutputs> outputs{};
  std::array<PositionTrigger, 2> triggers{};
  Fifo<Job, kFifoLength> fifo;

  bool operator==(const Module&) const = default;

  /// A jog or thrust that a pause has stopped.
  bool holds_jog() const { return held_jog_way != 0 || held_thrust != 0; }

  /// Half away from zero.
  std::int64_t pulses_of(double units) const;
  double units_of(std::int64_t pulses) const;
  /// Whether a coordinate stays where pulses can be counted.
  bool reaches(double units) const;

  /// 0 .. 1: what AVM leaves of VM and VJ.
  double analog_factor() const;
  motion::SpeedLaw working_law(const ChainOptions& options) const;
  /// With a top speed of 0 where VJ is.
  motion::SpeedLaw jog_law(const ChainOptions& options) const;
};

}  // namespace understudy::emulator::models::slim
