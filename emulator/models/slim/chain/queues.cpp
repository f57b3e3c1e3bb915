#include "emulator/models/slim/chain/queues.h"

#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/slim/chain/chain_state.h"
#include "emulator/models/slim/chain/paths.h"
#include "emulator/models/slim/motor/jobs.h"
#include "emulator/models/slim/motor/jogs.h"
#include "emulator/models/slim/motor/marks.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/motor/motor.h"
#include "emulator/models/slim/motor/moves.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "motion/axis.h"

namespace understudy::emulator::models::slim {

bool is_full(const ChainState& chain, int module) {
  return chain.modules[at(module)].fifo.size() >=
         static_cast<std::size_t>(chain.options.number(numbers("buffer_length")));
}

Job job_of(int module, Job job) {
  job.module_of[0] = static_cast<std::int8_t>(module);
  return job;
}

Error enqueue(ChainState& chain, Job job) {
  for (const std::int8_t module : job.module_of) {
    if (module >= 0 && is_full(chain, module)) return Error::buffer_full;
  }
  for (const std::int8_t module : job.module_of) {
    if (module < 0 || !chain.options.chose(option("thrust_end", "a_move_too")) || !job.moves()) continue;
    if (chain.modules[at(module)].activity == Activity::thrust) stop_jog(chain.motor(module));
  }
  job.number = ++chain.last_number;
  for (const std::int8_t module : job.module_of) {
    if (module >= 0) chain.modules[at(module)].fifo.push(job);
  }
  serve(chain, chain.now + 1);
  return Error::none;
}

namespace {

/// Starts or executes the head of the module's FIFO, if it can. Returns true if FIFOs have changed.
bool serve_head(ChainState& chain, int module, Tick begin_at) {
  Module& mine = chain.modules[at(module)];
  if (mine.fifo.empty()) return false;
  const bool head_runs =
      mine.activity == Activity::move || mine.activity == Activity::home || mine.activity == Activity::group;
  if (head_runs) return false;
  const Motor motor = chain.motor(module);
  const Job& head = mine.fifo[0];
  switch (head.kind) {
    case Job::Kind::output: carry_out(motor, head.output, begin_at); break;
    case Job::Kind::servo:
      if (!head.servo_on) {
        cut_motion(motor, motion::Cause::servo_off);
        take_off(mine, MarkEvent::servo_off);
      }
      motor.axis.switch_servo(head.servo_on);
      break;
    case Job::Kind::set_coordinate:
      if (mine.activity != Activity::idle || mine.holds_jog()) return false;
      set_coordinate(motor, head.units[0]);
      break;
    case Job::Kind::move: return free_to_move(chain, module) && start_move(motor, begin_at);
    case Job::Kind::home: return free_to_move(chain, module) && start_home(motor, begin_at);
    case Job::Kind::line:
    case Job::Kind::arc:
    case Job::Kind::spiral: return start_group(chain, module, begin_at);
  }
  mine.fifo.pop();
  return true;
}

}  // namespace

void serve(ChainState& chain, Tick begin_at) {
  bool again = true;
  while (again) {
    again = false;
    for (int module = 0; module < kModules; ++module) again = serve_head(chain, module, begin_at) || again;
  }
  for (Group& group : chain.groups) {
    if (group.motion.engaged) extend_group(chain, group);
  }
}

}  // namespace understudy::emulator::models::slim
