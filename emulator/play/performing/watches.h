// Watches a world in every tick while a scenario runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/probe/probes.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

/// Checks the open spans of `always` and `never`. An expression without a result also violates its span.
class SpanWatch final : public world::TickWatcher {
 public:
  struct Span {
    std::string name;
    world::Expression condition;
    bool is_never = false;
    std::string place;  // "feed.yaml:12", where the span was opened
  };
  struct Violation {
    SimTime at{0};
    std::string what;       // "never 'feeder.A.pulses > 10' (feed.yaml:12)"
    std::string explained;  // the condition with its values
    std::vector<std::string> state;
  };

  /// `describe` returns the state around a violation. All arguments must outlive this object.
  SpanWatch(const world::World& world, const world::Probes& values,
            std::vector<std::string> (*describe)(const world::World&))
      : world_(world), values_(values), describe_(describe) {}

  void on_tick(Tick tick) override;
  Tick next_poll(Tick done) const override;
  void open(Span span) { spans_.push_back(std::move(span)); }
  /// Returns false if no span with that name is open.
  bool close(const std::string& name);

  bool is_empty() const { return spans_.empty(); }
  /// Returns the first violation, after which nothing is checked.
  const std::optional<Violation>& violation() const { return violation_; }

  const std::vector<Span>& save() const { return spans_; }
  void restore(const std::vector<Span>& spans) { spans_ = spans; }

 private:
  const world::World& world_;
  const world::Probes& values_;
  std::vector<std::string> (*describe_)(const world::World&);
  std::vector<Span> spans_;
  std::optional<Violation> violation_;
};

/// Records the ticks in which a condition was true, beginning when this object is added to the world.
class ConditionHistory final : public world::TickWatcher {
 public:
  /// The observations so far.
  struct State {
    std::vector<Tick> changes;  // true from the first one on, false from the second one on, and so on
    Tick last = 0;
  };

  /// `values` must outlive this object.
  ConditionHistory(world::Expression condition, const world::Probes& values)
      : condition_(std::move(condition)), values_(values) {}

  void on_tick(Tick tick) override;
  Tick next_poll(Tick done) const override { return values_.next_change(condition_, done); }
  /// Returns the first tick, from `begin` on, in which the condition was true.
  std::optional<Tick> first_from(Tick begin) const;

  const State& save() const { return state_; }
  void restore(const State& state) { state_ = state; }

 private:
  world::Expression condition_;
  const world::Probes& values_;
  State state_;
};

}  // namespace understudy::emulator::play
