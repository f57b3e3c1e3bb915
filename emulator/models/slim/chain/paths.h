// Coordinated motion: commands for several modules at the heads of their FIFOs. Up to three run at a time.
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

/// Returns the settings of the module whose speed and acceleration the path uses.
const ModuleSettings& path_settings(const ChainState& chain, const Job& job);
/// Returns true if the job's speed is PR4, and false if it is PR3.
bool goes_by_line_speed(const ChainOptions& options, const Job& job);
double path_speed(const ChainOptions& options, const Job& job, const ModuleSettings& settings);
/// Returns true if the modules can count to all positions on the path; for an arc, to all positions on its
/// circle.
bool within_reach(const ChainState& chain, const Job& job, const motion::Path& path);
bool is_refused_as_empty(const ChainOptions& options, const motion::Path& path);

/// Returns true if the module is not paused and has nothing to do.
bool free_to_move(const ChainState& chain, int module);
/// Starts the path at the head of the module's FIFO, if it is at the head of all its FIFOs and all its
/// modules are free. Returns true if FIFOs have changed.
bool start_group(ChainState& chain, int module, Tick begin_at);
/// Appends to a running path the commands that follow it without a stop, so that it need not slow down.
void extend_group(ChainState& chain, Group& group);

/// Called after the group was stepped. Drops the commands whose paths are complete.
void drop_completed(ChainState& chain, Group& group);
/// Releases the modules of a group that has ended, and drops the rest of its commands.
void release_group(ChainState& chain, Group& group, Tick begin_at);

/// Immediately stops the pulses of the module and of all modules on the same path. The running command is
/// dropped.
void cut(ChainState& chain, int module, motion::Cause why);
/// Slows down or ends the module's activity because its FIFO is about to be dropped.
void slow_for_discard(ChainState& chain, int module);

}  // namespace understudy::emulator::models::slim
