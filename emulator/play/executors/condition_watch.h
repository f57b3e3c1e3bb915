// Waits for a condition, and ends World::advance_to() at the tick in which the condition is true.
#pragma once

#include "emulator/play/executors/executor.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

class ConditionWatch final : public world::TickWatcher {
 public:
  ConditionWatch(world::World& of, const Awaited& what) : world_(of), awaited_(what) {
    world_.add_watcher(*this);
  }
  ~ConditionWatch() override { world_.remove_watcher(*this); }
  ConditionWatch(const ConditionWatch&) = delete;
  ConditionWatch& operator=(const ConditionWatch&) = delete;

  void on_tick(Tick) override {
    look();
    if (is_met_) world_.stop_here();
  }
  void look() { is_met_ = is_met_ || awaited_.is_met(world_); }
  Tick next_poll(Tick done) const override {
    return awaited_.next_poll ? awaited_.next_poll(done) : done + 1;
  }
  bool is_met() const { return is_met_; }

 private:
  world::World& world_;
  const Awaited& awaited_;
  bool is_met_ = false;
};

}  // namespace understudy::emulator::play
