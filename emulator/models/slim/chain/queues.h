// The FIFOs of a chain: adds commands to them, and starts the commands that can start.
#pragma once

#include "base/simulated_time.h"
#include "emulator/models/slim/chain/chain_state.h"
#include "emulator/models/slim/motor/jobs.h"
#include "emulator/models/slim/rules/errors.h"

namespace understudy::emulator::models::slim {

/// Returns true if there is no room for another command in the module's FIFO.
bool is_full(const ChainState& chain, int module);
/// Adds a job to the FIFOs of all its modules, and starts all jobs that can start.
Error enqueue(ChainState& chain, Job job);
/// Returns a job for one module, ready to be enqueued.
Job job_of(int module, Job job);
/// Starts all commands that can start. They begin at tick `begin_at`. Call this after everything that may
/// allow a command to start.
void serve(ChainState& chain, Tick begin_at);

}  // namespace understudy::emulator::models::slim
