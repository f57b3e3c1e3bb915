// Pausing, continuing, discarding and stopping a whole chain, according to the table in rules/pauses.h.
#pragma once

#include "emulator/models/slim/chain/chain_state.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/pauses.h"

namespace understudy::emulator::models::slim {

/// Executes PZ, REDO, CLR BUF, TAPZ, TAREDO, TAUPZ and TASTOP, and applies the effect of T0's RESET on
/// pauses.
Error steer(ChainState& chain, InPause what);

}  // namespace understudy::emulator::models::slim
