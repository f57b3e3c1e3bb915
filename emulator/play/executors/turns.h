// Gives the world to one of two threads at a time: the thread that runs it, or the scenario's thread.
// Therefore, the scenario acts at exact moments of simulated time, which are the same in every run.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>

#include "base/simulated_time.h"
#include "emulator/play/executors/condition_watch.h"
#include "emulator/serve/host_time/simulated_task.h"

namespace understudy::emulator::play {

class Turns final : public serve::SimulatedTask {
 public:
  // --- called by the thread that runs the world ----------------------------------------------------
  void act(SimTime now) override;
  std::optional<SimTime> next_act() const override;
  /// Gives up the scenario. Its wait ends at the next act().
  void give_up();
  /// Called when the world has stopped running. The scenario may then act on it at any time.
  void leave();

  // --- called by the scenario's thread -------------------------------------------------------------
  /// Waits for the first turn.
  void begin();
  /// Passes on the turn until simulated time reaches `end`, the watch finds its condition, or the scenario is
  /// given up.
  void wait_until(SimTime end, ConditionWatch* watch = nullptr);
  /// Called when the scenario will not act any more.
  void finish();

  bool is_given_up() const;

 private:
  enum class Whose : std::uint8_t { world, scenario };

  void wait_for_turn(std::unique_lock<std::mutex>& lock);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Whose turn_ = Whose::world;
  /// When the scenario's wait ends; nothing after finish(). kForever: it is waiting until the host ends.
  std::optional<SimTime> end_ = SimTime{0};
  ConditionWatch* watch_ = nullptr;
  bool is_given_up_ = false;
  bool is_left_ = false;
};

}  // namespace understudy::emulator::play
