// The tick, and when there need not be one.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/simulated_time.h"
#include "emulator/device/clear_travel.h"
#include "emulator/models/slim/chain.h"
#include "emulator/models/slim/module.h"
#include "emulator/models/slim/outputs.h"
#include "emulator/models/slim/rules/errors.h"
#include "motion/axis.h"
#include "motion/coordinated.h"
#include "motion/shared_tick.h"

namespace understudy::emulator::models::slim {

void Chain::step(Tick tick) {
  now_ = tick;
  step_groups();
  step_axes(tick);
  // What follows begins at the end of what was: no tick is lost between two commands.
  for (int module = 0; module < kModules; ++module) after_motion(module, tick);
  for (const Module& each : modules_) {
    if (each.fifo.empty()) continue;
    serve(tick);
    break;
  }
}

/// Places that switch outputs do so in the order in which they are passed.
void Chain::step_motion(std::uint32_t singles, motion::Coordinated* path, std::span<std::int64_t> pulses) {
  class Owner final : public motion::EdgeOwner {
   public:
    explicit Owner(Chain& chain) : chain_(chain) {}
    void at_edge(motion::SharedTick&, std::size_t axis, motion::Events events) override {
      chain_.meet_triggers(static_cast<int>(axis), events);
    }

   private:
    Chain& chain_;
  };
  Owner owner(*this);
  motion::step_together({.tick = now_, .axes = axes_, .environment = environment_, .pulses = pulses}, singles,
                        path, &owner);
}

void Chain::step_groups() {
  std::array<std::int64_t, kModules> pulses{};
  for (Group& group : groups_) {
    motion::Coordinated& motion = group.motion;
    if (!motion.engaged) continue;
    step_motion(0, &motion, pulses);
    const int done = std::min<int>(motion.run.completed(), group.paths);
    for (std::size_t i = 0; i < motion.axis_of.size(); ++i) {
      if (motion.axis_of[i] < 0) continue;
      Module& mine = modules_[at(motion.axis_of[i])];
      mine.sent_pulses = pulses[at(motion.axis_of[i])];
      for (int path = 0; path < done; ++path) {
        mine.place_units = mine.fifo[0].ends[i];
        mine.fifo.pop();
      }
    }
    group.paths = static_cast<std::uint8_t>(group.paths - done);
  }
}

/// The axis met nothing in the last tick, and nothing has changed for it since.
bool Chain::undisturbed(int module) const {
  const motion::Axis& axis = axes_[at(module)];
  return axis.events == 0 && !axis.must_recheck && environment_[at(module)].version == axis.seen_version;
}

void Chain::step_axes(Tick tick) {
  for (int module = 0; module < kModules; ++module) {
    Module& mine = modules_[at(module)];
    if (mine.activity == Activity::group) continue;
    motion::Axis& axis = axes_[at(module)];
    const bool idle = !axis.moving() && undisturbed(module);
    mine.sent_pulses = 0;
    if (idle) continue;
    std::array<std::int64_t, kModules> pulses{};
    step_motion(1U << module, nullptr, pulses);
    mine.sent_pulses = pulses[at(module)];
  }
  for (Group& group : groups_) {
    // Only now, so that its modules had one tick each.
    const bool was_running = group.motion.axis_of[0] >= 0;
    if (was_running && !group.motion.engaged) release_group(group, tick);
  }
}

/// If what the module was doing has come to its end, what that means.
void Chain::after_motion(int module, Tick begin_at) {
  Module& mine = modules_[at(module)];
  const motion::Axis& axis = axes_[at(module)];
  if (mine.activity == Activity::idle || mine.activity == Activity::group || axis.moving()) return;
  const Activity was = mine.activity;
  if (was == Activity::jog && mine.starved) {
    mine.place_units = coordinate(module);
    return;  // goes on when AVM gives a speed
  }
  mine.activity = Activity::idle;
  mine.place_units = coordinate(module);
  switch (was) {
    case Activity::move:
      if (axis.cause == motion::Cause::arrived) {
        mine.place_units = mine.fifo[0].ends[0];
        mine.fifo.pop();
      } else if (axis.cause != motion::Cause::stopped) {
        drop_head(module, Error::not_allowed);
      }  // else it is paused, and goes on from here
      break;
    case Activity::home:
      if (axis.cause == motion::Cause::arrived) {
        home_found(module);
      } else if (axis.cause != motion::Cause::stopped) {
        drop_head(module, Error::not_allowed);
      }
      break;
    case Activity::jog:
    case Activity::thrust:
      mine.jog_direction = 0;
      mine.thrust = 0;
      begin_next(module, begin_at);
      break;
    case Activity::stopping: begin_next(module, begin_at); break;
    case Activity::idle:
    case Activity::group: break;
  }
}

/// It does nothing of itself but what its axis does.
bool Chain::waits(int module) const {
  const Module& mine = modules_[at(module)];
  const motion::Axis& axis = axes_[at(module)];
  return mine.activity == Activity::idle || mine.activity == Activity::group ||
         axis.task == motion::Task::hanging || (mine.starved && !axis.moving());
}

/// Not engaged, or paused and at rest.
bool Chain::stands(const Group& group, Tick done) const {
  const motion::PathRun& run = group.motion.run;
  // What was completed is of the last tick only.
  return !group.motion.engaged || (run.paused() && run.at_rest(done) && run.completed() == 0 &&
                                   group.motion.slowing_for == motion::Cause::none);
}

Tick Chain::next_active_tick(Tick done) const {
  for (const Group& group : groups_) {
    if (!stands(group, done)) return done + 1;
  }
  Tick next = kNever;
  for (int module = 0; module < kModules; ++module) {
    const Module& mine = modules_[at(module)];
    if (!waits(module)) return done + 1;
    // What the axis met and sent is of the last tick only. A path may end without a pulse in its last tick.
    if (!undisturbed(module) || mine.sent_pulses != 0) next = std::min(next, done + 1);
    for (const Output& output : mine.outputs) next = std::min(next, output.next_change(done));
  }
  return next;
}

Tick Chain::next_event_tick(Tick done, Tick most, const ClearTravel& ahead) const {
  for (const Group& group : groups_) {
    if (!stands(group, done)) return done + 1;
  }
  Tick last = most;
  for (int module = 0; module < kModules && last > done; ++module) {
    const Module& mine = modules_[at(module)];
    const motion::Axis& axis = axes_[at(module)];
    if (mine.activity == Activity::group) {
      if (!undisturbed(module) || mine.sent_pulses != 0) return done + 1;
    } else {
      if (!waits(module) && !axis.moving()) return done + 1;
      const PulseRoom room = ahead.room(module);
      const std::int64_t at_pulses = axis.travel_pulses;
      last = axis.quiet_until(done + 1, last, environment_[at(module)],
                              {.low = at_pulses + room.least, .high = at_pulses + room.most});
    }
    for (const Output& output : mine.outputs) last = std::min(last, output.next_change(done) - 1);
  }
  return last + 1;
}

void Chain::fast_forward_to(Tick tick, std::span<std::int64_t> pulses) {
  now_ = tick;
  for (int module = 0; module < kModules; ++module) {
    Module& mine = modules_[at(module)];
    if (mine.activity == Activity::group) continue;
    motion::Axis& axis = axes_[at(module)];
    pulses[at(module)] += axis.fast_forward_to(tick - 1);
    mine.sent_pulses = axis.step(tick, environment_[at(module)]);
    pulses[at(module)] += mine.sent_pulses;
    if (mine.starved && !axis.moving()) mine.place_units = coordinate(module);
  }
}

}  // namespace understudy::emulator::models::slim
