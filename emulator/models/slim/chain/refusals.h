// Why a command is refused before anything has changed.
#pragma once

#include "emulator/models/slim/chain/chain_state.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/pauses.h"

namespace understudy::emulator::models::slim {

/// Of any command: not_linked.
Error refusal(const ChainState& chain, int module);
/// Of a motion of a module that is known by a letter, or by its number.
Error refusal_of_motion(const ChainState& chain, int module, InPause what = InPause::motion);
Error refusal_by_number(const ChainState& chain, int module, InPause what = InPause::motion);
/// Of a homing.
Error refusal_of_home(const ChainState& chain, int module);
/// Of a jog or thrust.
Error refusal_of_jog(const ChainState& chain, int module);

}  // namespace understudy::emulator::models::slim
