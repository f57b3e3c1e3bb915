#include "emulator/models/slim/chain/stops.h"

#include <cstddef>
#include <cstdint>

#include "emulator/models/slim/chain/chain_state.h"
#include "emulator/models/slim/chain/paths.h"
#include "emulator/models/slim/chain/queues.h"
#include "emulator/models/slim/motor/jobs.h"
#include "emulator/models/slim/motor/jogs.h"
#include "emulator/models/slim/motor/marks.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/motor/motor.h"
#include "emulator/models/slim/motor/moves.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "emulator/models/slim/rules/pauses.h"
#include "motion/axis.h"

namespace understudy::emulator::models::slim {

namespace {

void hold(ChainState& chain) {
  for (Group& group : chain.groups) {
    if (group.motion.engaged && chain.held(group)) group.motion.run.pause(chain.now);
  }
  for (int module = 0; module < kModules; ++module) {
    if (chain.held(module)) hold_motion(chain.motor(module));
  }
  serve(chain, chain.now + 1);  // starts outputs that were waiting for the end of a jog
}

void release(ChainState& chain) {
  for (Group& group : chain.groups) {
    const bool continues =
        group.motion.engaged && group.motion.slowing_for == motion::Cause::none && !chain.held(group);
    if (continues) group.motion.run.resume(chain.now);
  }
  for (int module = 0; module < kModules; ++module) {
    if (!chain.held(module)) resume_motion(chain.motor(module));
  }
  serve(chain, chain.now + 1);
}

/// Discards everything, or only what PZ has paused.
void give_up(ChainState& chain, bool in_scope_only) {
  const auto is_meant = [&](int module) { return !in_scope_only || chain.in_pause_scope(module); };
  for (int module = 0; module < kModules; ++module) {
    if (!is_meant(module)) continue;
    stop_jog(chain.motor(module));
    slow_for_discard(chain, module);
  }
  for (int module = 0; module < kModules; ++module) {
    if (is_meant(module)) forget_queue(chain, module);
  }
  serve(chain, chain.now + 1);  // starts commands in other FIFOs that were waiting for a dropped command
}

/// Discards waiting commands, but not those in progress.
void clear_waiting(ChainState& chain) {
  for (Group& group : chain.groups) {
    if (!group.motion.engaged || group.paths == 0 || !chain.in_pause_scope(group)) continue;
    group.paths = static_cast<std::uint8_t>(group.motion.run.shorten(chain.now));
    if (group.paths == 0) continue;
    const Job& last = chain.modules[at(group.motion.axis_of[0])].fifo[group.paths - 1U];
    for (std::size_t i = 0; i < last.ends.size(); ++i) {
      group.end[static_cast<Eigen::Index>(i)] = last.ends[i];
    }
  }
  for (int module = 0; module < kModules; ++module) {
    if (!chain.in_pause_scope(module)) continue;
    const Module& mine = chain.modules[at(module)];
    const Group* group = chain.group_of(module);
    const bool is_half_done =
        chain.options.chose(pauses::kOnlyWhatWaits) && !mine.fifo.empty() && mine.fifo[0].begun;
    const bool head_runs = mine.activity == Activity::move || mine.activity == Activity::home || is_half_done;
    forget_queue(chain, module, group != nullptr ? group->paths : head_runs ? 1 : 0);
  }
  serve(chain, chain.now + 1);
}

void stop_all(ChainState& chain) {
  for (int module = 0; module < kModules; ++module) cut(chain, module, motion::Cause::stopped);
  const bool servo_too = chain.options.chose(option("emergency_stop", "nothing_queued_not_paused_servo_off"));
  for (int module = 0; module < kModules; ++module) {
    Module& mine = chain.modules[at(module)];
    mine.fifo.truncate(0);
    stop_outputs(chain.motor(module));
    if (!servo_too || !mine.linked) continue;
    take_off(mine, MarkEvent::servo_off);
    chain.axes[at(module)].switch_servo(false);
  }
}

}  // namespace

Error steer(ChainState& chain, InPause what) {
  const Pauses now = pauses_of(chain.queues_paused, chain.paused);
  const PauseResult result = pause_result(chain.options, now, what);
  chain.queues_paused = has_pz(result.left);
  chain.paused = has_tapz(result.left);
  switch (result.outcome) {
    case PauseOutcome::slows_down: hold(chain); break;
    case PauseOutcome::continues: release(chain); break;
    case PauseOutcome::gives_up: give_up(chain, what == InPause::clear_buffer); break;
    case PauseOutcome::clears: clear_waiting(chain); break;
    case PauseOutcome::stops: stop_all(chain); break;
    case PauseOutcome::in_vain:
      return chain.options.chose(option("ineffective_pause", "error_3")) ? Error::not_allowed : Error::none;
    case PauseOutcome::resets:
    case PauseOutcome::is_taken:
    case PauseOutcome::waits:
    case PauseOutcome::is_refused: break;  // the caller handles it
  }
  return Error::none;
}

}  // namespace understudy::emulator::models::slim
