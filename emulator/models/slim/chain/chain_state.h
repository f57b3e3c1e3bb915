// The state of a chain: its modules, the assigned letters, coordinated motions, and pauses. Each part of the
// chain is a header with functions on this state, and uses only the parts above it in this list:
//
//   chain_state.h   modules held by a pause, modules on a path; jobs that are dropped from all FIFOs
//   paths.h         coordinated motion
//   queues.h        the FIFOs: adding commands, and starting them
//   stops.h         pauses, what ends them, stops
//   refusals.h      why a command is refused
//   settings.h      VM, VJ, PR2 ...
//   chain.h         the commands, the values to query, the tick
//
// Below them are the parts of one module (motor/motor.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/slim/motor/jobs.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/motor/motor.h"
#include "emulator/models/slim/rules/chain_options.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/pauses.h"
#include "motion/axis.h"
#include "motion/coordinated.h"
#include "motion/environment.h"
#include "motion/path_run.h"

namespace understudy::emulator::models::slim {

/// Modules 0 .. 5 can be coordinated.
inline constexpr int kMappable = 6;

constexpr std::size_t at(int module) { return static_cast<std::size_t>(module); }

/// A coordinated motion. Its paths are the first jobs in its modules' FIFOs, one after another.
struct Group {
  motion::Coordinated motion;
  std::uint8_t paths = 0;                     // how many of the first jobs in the FIFOs are its paths
  motion::Point end = motion::Point::Zero();  // end of the last path

  bool operator==(const Group&) const = default;
};

struct ChainState {
  ChainOptions options;
  std::array<Module, kModules> modules{};
  std::array<motion::Axis, kModules> axes{};
  std::array<motion::Environment, kModules> environment{};
  std::array<Group, kMappable / 2> groups{};
  std::array<std::int8_t, kLetters> map{kNoModule, kNoModule, kNoModule, kNoModule};
  ContinuousPath continuous = ContinuousPath::off;
  bool paused = false;         // by TAPZ
  bool queues_paused = false;  // by PZ
  std::uint64_t last_number = 0;
  Tick now = 0;

  bool operator==(const ChainState&) const = default;

  Motor motor(int module) {
    return {modules[at(module)], axes[at(module)], environment[at(module)], options, now};
  }

  /// Returns true if PZ applies to the module, or to a module in the group.
  bool in_pause_scope(int module) const { return module == 0 || !options.chose(option("pause_scope", "t0")); }
  bool in_pause_scope(const Group& group) const;
  /// Returns the pauses that apply to a module or a group: TAPZ, and PZ within its scope.
  Pauses pauses_of(const auto& what) const {
    return slim::pauses_of(queues_paused && in_pause_scope(what), paused);
  }
  bool held(const auto& what) const { return pauses_of(what) != Pauses::none; }

  /// Returns the group that the module is in, or null.
  Group* group_of(int module);
  const Group* group_of(int module) const;
};

/// Drops a job from all FIFOs.
void drop_job(ChainState& chain, std::uint64_t number);
/// Drops the job at the head of the module's FIFO from all FIFOs, and records the error for the module.
void drop_head(ChainState& chain, int module, Error why);
/// Drops all jobs in the module's FIFO, except the first `kept`, from all FIFOs.
void forget_queue(ChainState& chain, int module, std::size_t kept = 0);

}  // namespace understudy::emulator::models::slim
