// Watches for an awaited condition, and ends World::advance_to() at the tick at which it is true.
#pragma once

#include "emulator/play/stages/executor.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

class TickLook final : public world::TickWatcher {
 public:
  TickLook(world::World& of, const Awaited& what) : world_(of), awaited_(what) { world_.add_watcher(*this); }
  ~TickLook() override { world_.remove_watcher(*this); }
  TickLook(const TickLook&) = delete;
  TickLook& operator=(const TickLook&) = delete;

  void on_tick(Tick) override {
    is_there_ = is_there_ || awaited_.is_there(world_);
    if (is_there_) world_.stop_here();
  }
  Tick next_look(Tick done) const override {
    return awaited_.next_look ? awaited_.next_look(done) : done + 1;
  }
  bool is_there() const { return is_there_; }

 private:
  world::World& world_;
  const Awaited& awaited_;
  bool is_there_ = false;
};

}  // namespace understudy::emulator::play
