#include "interpreter/super_40nc/state_fields.h"
#include <cstddef>

#include "base/state/state_error.h"
#include "interpreter/super_40nc/events.h"
#include "interpreter/super_40nc/step_programs.h"

namespace understudy {

void StateOf<interpreter::super_40nc::StepState>::check(const Value& state) {
  using interpreter::super_40nc::Phase;
  require_reach(state.left_ms);
  require_state(state.left_ms >= 0, "a wait is negative");
  const bool can_resume = state.resumes != Phase::idle && state.resumes < Phase::paused;
  require_state(can_resume, "a program cannot resume in this phase");
  constexpr std::size_t kMaxCalls = 4096;
  require_state(state.calls.size() <= kMaxCalls, "there are too many calls");
}

}  // namespace understudy
