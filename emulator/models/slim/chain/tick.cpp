// Runs the ticks of the chain, and determines which ticks can be skipped.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/simulated_time.h"
#include "emulator/device/clear_travel.h"
#include "emulator/models/slim/chain/chain.h"
#include "emulator/models/slim/chain/chain_state.h"
#include "emulator/models/slim/chain/paths.h"
#include "emulator/models/slim/chain/queues.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/motor/motor.h"
#include "emulator/models/slim/motor/moves.h"
#include "emulator/models/slim/motor/outputs.h"
#include "motion/axis.h"
#include "motion/coordinated.h"
#include "motion/path_run.h"
#include "motion/shared_tick.h"

namespace understudy::emulator::models::slim {

namespace {

using Pulses = std::array<std::int64_t, kModules>;

/// Switches outputs at their positions, in the order in which the axes pass the positions.
class TriggerOwner final : public motion::EdgeOwner {
 public:
  explicit TriggerOwner(ChainState& chain) : chain_(chain) {}
  void at_edge(motion::SharedTick&, std::size_t axis, motion::Events events) override {
    pass_triggers(chain_.motor(static_cast<int>(axis)), events);
  }

 private:
  ChainState& chain_;
};

void step_motion(ChainState& chain, std::uint32_t singles, motion::Coordinated* path, Pulses& pulses) {
  TriggerOwner owner(chain);
  motion::step_together(
      {.tick = chain.now, .axes = chain.axes, .environment = chain.environment, .pulses = pulses}, singles,
      path, &owner);
}

void step_groups(ChainState& chain) {
  Pulses pulses{};
  for (Group& group : chain.groups) {
    if (!group.motion.engaged) continue;
    step_motion(chain, 0, &group.motion, pulses);
    for (const std::int8_t member : group.motion.axis_of) {
      if (member >= 0) chain.modules[at(member)].sent_pulses = pulses[at(member)];
    }
    drop_completed(chain, group);
  }
}

/// Returns true if the axis encountered nothing in the last tick, and nothing has changed for it since.
bool is_undisturbed(const ChainState& chain, int module) {
  const motion::Axis& axis = chain.axes[at(module)];
  return axis.events == 0 && !axis.must_recheck && chain.environment[at(module)].version == axis.seen_version;
}

void step_axes(ChainState& chain) {
  for (int module = 0; module < kModules; ++module) {
    Module& mine = chain.modules[at(module)];
    if (mine.activity == Activity::group) continue;
    const bool is_idle = !chain.axes[at(module)].moving() && is_undisturbed(chain, module);
    mine.sent_pulses = 0;
    if (is_idle) continue;
    Pulses pulses{};
    step_motion(chain, 1U << module, nullptr, pulses);
    mine.sent_pulses = pulses[at(module)];
  }
}

/// Returns true if nothing happens to the module except through its axis or group.
bool waits(const ChainState& chain, int module) {
  const Module& mine = chain.modules[at(module)];
  const motion::Axis& axis = chain.axes[at(module)];
  return mine.activity == Activity::idle || mine.activity == Activity::group ||
         axis.task == motion::Task::hanging || (mine.starved && !axis.moving());
}

/// Returns true if the group is not engaged, or paused and at rest.
bool stands(const Group& group, Tick done) {
  const motion::PathRun& run = group.motion.run;
  // Completed paths count only for the last tick.
  return !group.motion.engaged || (run.paused() && run.at_rest(done) && run.completed() == 0 &&
                                   group.motion.slowing_for == motion::Cause::none);
}

bool all_groups_stand(const ChainState& chain, Tick done) {
  return std::all_of(chain.groups.begin(), chain.groups.end(),
                     [&](const Group& group) { return stands(group, done); });
}

}  // namespace

void Chain::step(Tick tick) {
  state_.now = tick;
  step_groups(state_);
  step_axes(state_);
  // Groups are released only now, so that their modules have had one tick each.
  for (Group& group : state_.groups) {
    const bool was_running = group.motion.axis_of[0] >= 0;
    if (was_running && !group.motion.engaged) release_group(state_, group, tick);
  }
  // The next command begins where the previous one ended, so no tick is lost between them.
  for (int module = 0; module < kModules; ++module) after_motion(state_.motor(module), tick);
  const bool has_jobs = std::any_of(state_.modules.begin(), state_.modules.end(),
                                    [](const Module& module) { return !module.fifo.empty(); });
  if (has_jobs) serve(state_, tick);
}

Tick Chain::next_active_tick(Tick done) const {
  if (!all_groups_stand(state_, done)) return done + 1;
  Tick next = kNever;
  for (int module = 0; module < kModules; ++module) {
    const Module& mine = module_at(module);
    if (!waits(state_, module)) return done + 1;
    // Events and pulses are those of the last tick only. A path may end without a pulse in its last tick.
    if (!is_undisturbed(state_, module) || mine.sent_pulses != 0) next = std::min(next, done + 1);
    for (const Output& output : mine.outputs) next = std::min(next, output.next_change(done));
  }
  return next;
}

Tick Chain::next_event_tick(Tick done, Tick limit, const ClearTravel& ahead) const {
  if (!all_groups_stand(state_, done)) return done + 1;
  Tick last = limit;
  for (int module = 0; module < kModules && last > done; ++module) {
    const Module& mine = module_at(module);
    const motion::Axis& axis = state_.axes[at(module)];
    if (mine.activity == Activity::group) {
      if (!is_undisturbed(state_, module) || mine.sent_pulses != 0) return done + 1;
    } else {
      if (!waits(state_, module) && !axis.moving()) return done + 1;
      const PulseRoom room = ahead.room(module);
      const std::int64_t at_pulses = axis.travel_pulses;
      last = axis.quiet_until(done + 1, last, state_.environment[at(module)],
                              {.low = at_pulses + room.min, .high = at_pulses + room.max});
    }
    for (const Output& output : mine.outputs) last = std::min(last, output.next_change(done) - 1);
  }
  return last + 1;
}

void Chain::fast_forward_to(Tick tick, std::span<std::int64_t> pulses) {
  state_.now = tick;
  for (int module = 0; module < kModules; ++module) {
    Module& mine = state_.modules[at(module)];
    if (mine.activity == Activity::group) continue;
    motion::Axis& axis = state_.axes[at(module)];
    pulses[at(module)] += axis.fast_forward_to(tick - 1);
    mine.sent_pulses = axis.step(tick, state_.environment[at(module)]);
    pulses[at(module)] += mine.sent_pulses;
    if (mine.starved && !axis.moving()) mine.place_units = coordinate(module);
  }
}

}  // namespace understudy::emulator::models::slim
