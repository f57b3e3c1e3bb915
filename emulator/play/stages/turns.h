// Gives the world to one of two threads at a time: to the one that runs it, and to the scenario's. So the
// scenario acts at an exact moment of simulated time, in every run at the same one.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>

#include "base/simulated_time.h"
#include "emulator/play/stages/tick_look.h"
#include "emulator/serve/host_time/companion.h"

namespace understudy::emulator::play {

class Turns final : public serve::Companion {
 public:
  // --- the thread that runs the world
  void act(SimTime now) override;
  std::optional<SimTime> next_act() const override;
  /// The scenario is to end: its wait is over.
  void give_up();
  /// The world is not run any more, so the scenario may act on it at any time.
  void leave();

  // --- the scenario's thread
  /// Waits for the first turn.
  void begin();
  /// Gives the turn away until simulated time is `end`, or the look has found what it looks for, or the
  /// scenario is given up.
  void wait_until(SimTime end, const TickLook* look = nullptr);
  /// The scenario acts no more.
  void finish();

  bool is_given_up() const;

 private:
  enum class Whose : std::uint8_t { world, scenario };

  void wait_for_turn(std::unique_lock<std::mutex>& lock);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Whose turn_ = Whose::world;
  std::optional<SimTime> end_ = SimTime{0};  // of the scenario's wait; nothing after finish()
  const TickLook* look_ = nullptr;
  bool is_given_up_ = false;
  bool is_left_ = false;
};

}  // namespace understudy::emulator::play
