// Coordinated motion: commands of several modules at the heads of their FIFOs, up to three at a time.
#pragma once

#include <cstddef>

#include "base/simulated_time.h"
#include "emulator/models/slim/chain/chain_state.h"
#include "emulator/models/slim/motor/jobs.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/rules/chain_options.h"
#include "motion/axis.h"
#include "motion/path.h"

namespace understudy::emulator::models::slim {

/// Returns the module's settings whose speed and acceleration a path uses.
const ModuleSettings& path_settings(const ChainState& chain, const Job& job);
/// Returns true if the job's speed is PR4 rather than PR3.
bool goes_by_line_speed(const ChainOptions& options, const Job& job);
double path_speed(const ChainOptions& options, const Job& job, const ModuleSettings& settings);
/// Returns true if its modules can count all positions of the path; for an arc, of its whole circle.
bool within_reach(const ChainState& chain, const Job& job, const motion::Path& path);
bool is_refused_as_empty(const ChainOptions& options, const motion::Path& path);

/// Returns true if no pause holds the module and it has nothing to do.
bool free_to_move(const ChainState& chain, int module);
/// Starts the path at the head of the module's FIFO, if it is at the head of all FIFOs that it is in and all
/// its modules are free. Returns true if FIFOs have changed.
bool start_group(ChainState& chain, int module, Tick begin_at);
/// Gives a running path the commands that follow it without a stop, so it need not slow down.
void extend_group(ChainState& chain, Group& group);

/// Drops the commands whose paths the group has completed. It has just been stepped.
void drop_completed(ChainState& chain, Group& group);
/// Releases the modules of a group that has ended, and drops what is left of its commands.
void release_group(ChainState& chain, Group& group, Tick begin_at);

/// Stops the pulses of the module, and of all modules that share its path, at once. The running command is
/// dropped.
void cut(ChainState& chain, int module, motion::Cause why);
/// Slows down or ends the module's activity, because its FIFO is about to be dropped.
void slow_for_discard(ChainState& chain, int module);

}  // namespace understudy::emulator::models::slim
