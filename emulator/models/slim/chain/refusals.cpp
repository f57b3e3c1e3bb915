#include "emulator/models/slim/chain/refusals.h"

#include <algorithm>

#include "emulator/models/slim/chain/chain_state.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "emulator/models/slim/rules/pauses.h"

namespace understudy::emulator::models::slim {

Error refusal(const ChainState& chain, int module) {
  const bool is_module = module >= 0 && module < kModules;
  return is_module && chain.modules[at(module)].linked ? Error::none : Error::not_linked;
}

Error refusal_of_motion(const ChainState& chain, int module, InPause what) {
  if (const Error why = refusal(chain, module); why != Error::none) return why;
  const PauseResult result = pause_result(chain.options, chain.pauses_of(module), what);
  if (result.outcome == PauseOutcome::is_refused) return Error::paused;
  // A jog is not queued, so HON and HOFF that wait in the queue do not concern it.
  const motion::Axis& axis = chain.axes[at(module)];
  const bool servo = what == InPause::jog ? axis.servo_on : chain.modules[at(module)].servo_expected(axis);
  return servo ? Error::none : Error::servo_off;
}

Error refusal_by_number(const ChainState& chain, int module, InPause what) {
  if (const Error why = refusal(chain, module); why != Error::none) return why;
  const bool has_letter = std::ranges::find(chain.map, module) != chain.map.end();
  if (module != 0 && has_letter) return Error::axis;
  return refusal_of_motion(chain, module, what);
}

Error refusal_of_home(const ChainState& chain, int module) {
  return chain.options.reserves_moves_only() ? refusal_of_motion(chain, module)
                                             : refusal_by_number(chain, module);
}

Error refusal_of_jog(const ChainState& chain, int module) {
  const Error why = chain.options.reserves_moves_only() ? refusal_of_motion(chain, module, InPause::jog)
                                                        : refusal_by_number(chain, module, InPause::jog);
  if (why != Error::none) return why;
  const Module& mine = chain.modules[at(module)];
  if (!mine.busy() || mine.jogs_or_pushes()) return Error::none;
  if (!chain.options.chose(option("jog_while_moving", "ends_the_move"))) return Error::not_allowed;
  // An HON that is still waiting would also be dropped.
  return chain.axes[at(module)].servo_on ? Error::none : Error::servo_off;
}

}  // namespace understudy::emulator::models::slim
