// Records the values of several names in each tick around the moment at which a condition becomes true, like
// a single shot of an oscilloscope. While it records, the world skips only ticks in which nothing changes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "emulator/world/expression/expression.h"
#include "emulator/world/probe/probes.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

struct ScopeSetup {
  static constexpr std::size_t kMaxNames = 16;
  static constexpr Tick kMaxTicks = 10'000;  // the maximum number before the trigger, and after it

  std::vector<std::string> names;
  std::string condition;  // empty: triggers immediately
  Tick before = 1'000;
  Tick after = 1'000;
};

class Scope final : private TickWatcher {
 public:
  enum class State : std::uint8_t { armed, triggered, done };

  /// Throws NameError or ExpressionError.
  Scope(World& world, ScopeSetup setup);
  ~Scope() override;
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;

  /// Called after the world was put into another state. Drops earlier samples, because they did not lead to
  /// that state. Does nothing if the scope is done.
  void restart();

  const ScopeSetup& setup() const { return setup_; }
  State state() const { return state_; }
  /// Return the tick of the first sample, and the number of samples.
  Tick first_tick() const { return next_tick_ - static_cast<Tick>(count_); }
  std::size_t count() const { return count_; }
  /// Call this only after the trigger.
  Tick trigger_tick() const { return trigger_tick_; }
  /// If the scope ended because the condition has no result, returns the reason; otherwise returns an empty
  /// text.
  const std::string& diagnostic() const { return diagnostic_; }
  /// Returns the value of a name `place` samples after the first one. Values of a device without power are 0.
  double sample(std::size_t name, std::size_t place) const;

 private:
  void on_tick(Tick tick) override;
  Tick next_poll(Tick done) const override;
  void on_rest(Tick last) override;
  void push(Tick tick);
  bool is_met();
  void end();

  World& world_;
  ScopeSetup setup_;
  Probes probes_;
  Expression condition_;
  std::vector<std::int32_t> handles_;
  std::vector<double> present_;
  std::vector<double> ring_;  // one row of values per tick
  std::size_t rows_ = 0;      // how many rows fit
  std::size_t count_ = 0;
  Tick next_tick_ = 0;
  State state_ = State::armed;
  Tick trigger_tick_ = 0;
  bool is_watching_ = true;
  std::string diagnostic_;
};

}  // namespace understudy::emulator::world
