// The FIFOs of a chain: what is added to them, and what starts when.
#pragma once

#include "base/simulated_time.h"
#include "emulator/models/slim/chain/chain_state.h"
#include "emulator/models/slim/motor/jobs.h"
#include "emulator/models/slim/rules/errors.h"

namespace understudy::emulator::models::slim {

/// Returns true if the module's FIFO accepts no more commands.
bool is_full(const ChainState& chain, int module);
/// Adds a job to the FIFOs of all its modules, and starts what can start.
Error enqueue(ChainState& chain, Job job);
/// Returns a job of one module, to be enqueued.
Job job_of(int module, Job job);
/// Starts all commands that can start; they begin at that tick. Call it after everything that may have let
/// one start.
void serve(ChainState& chain, Tick begin_at);

}  // namespace understudy::emulator::models::slim
