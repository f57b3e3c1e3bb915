// Determines why a command is refused, before anything has changed.
#pragma once

#include "emulator/models/slim/chain/chain_state.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/pauses.h"

namespace understudy::emulator::models::slim {

/// Returns the refusal that applies to all commands: not_linked.
Error refusal(const ChainState& chain, int module);
/// These return why a motion of a module, given by its letter or its number, is refused.
Error refusal_of_motion(const ChainState& chain, int module, InPause what = InPause::motion);
Error refusal_by_number(const ChainState& chain, int module, InPause what = InPause::motion);
/// Returns why a homing is refused.
Error refusal_of_home(const ChainState& chain, int module);
/// Returns why a jog or a thrust is refused.
Error refusal_of_jog(const ChainState& chain, int module);

}  // namespace understudy::emulator::models::slim
