#include "emulator/play/performing/performance.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/files/file_error.h"
#include "base/simulated_time.h"
#include "emulator/device/program_error.h"
#include "emulator/play/executors/executor.h"
#include "emulator/play/executors/real_box.h"
#include "emulator/play/performing/performance_on_box.h"
#include "emulator/play/performing/state_text.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/expression/tokens.h"
#include "emulator/world/names/names.h"
#include "emulator/world/outcome_hash.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

namespace {

constexpr std::size_t kFramesReported = 10;

/// Returns true if an expression needs a value that must be watched in every tick from the beginning.
bool names_peaks(const Steps& steps);

struct NamesPeaks {
  static bool in(const std::string& expression) { return expression.find("greatest_") != std::string::npos; }
  bool operator()(const WriteStep& step) const {
    return std::any_of(step.entries.begin(), step.entries.end(),
                       [](const WriteStep::Entry& entry) { return in(entry.value); });
  }
  bool operator()(const WaitStep& step) const { return in(step.until); }
  bool operator()(const AssertStep& step) const {
    return std::any_of(step.expressions.begin(), step.expressions.end(), in);
  }
  bool operator()(const SpanStep& step) const { return in(step.expression); }
  bool operator()(const ForkStep& step) const {
    return std::any_of(step.branches.begin(), step.branches.end(),
                       [](const ForkStep::Branch& branch) { return names_peaks(branch.steps); });
  }
  bool operator()(const auto&) const { return false; }
};

bool names_peaks(const Steps& steps) {
  return std::any_of(steps.begin(), steps.end(),
                     [](const Step& step) { return std::visit(NamesPeaks{}, step.what); });
}

/// Returns true if a step advances time or sets it back.
struct MovesTime {
  bool operator()(const WriteStep&) const { return true; }
  bool operator()(const CommandStep&) const { return true; }
  bool operator()(const ExpectStep&) const { return true; }
  bool operator()(const SendStep&) const { return true; }
  bool operator()(const TextStep&) const { return true; }
  bool operator()(const WaitStep&) const { return true; }
  bool operator()(const AdvanceStep&) const { return true; }
  bool operator()(const RestoreStep&) const { return true; }
  bool operator()(const auto&) const { return false; }
};
bool moves_time(const Step& step) { return std::visit(MovesTime{}, step.what); }

/// Adds the conditions for which these steps or their branches wait before anything else changes the time.
void add_awaited(std::span<const Step> steps, std::vector<std::string>& conditions) {
  for (const Step& step : steps) {
    if (const auto* const wait = std::get_if<WaitStep>(&step.what); wait != nullptr && !wait->poll) {
      conditions.push_back(wait->until);
    }
    if (const auto* const fork = std::get_if<ForkStep>(&step.what)) {
      for (const ForkStep::Branch& branch : fork->branches) add_awaited(branch.steps, conditions);
    }
    if (moves_time(step)) return;
  }
}

}  // namespace

Performance::WorldObservers::WorldObservers(world::World& of, bool with_hash)
    : world(of),
      peaks(of),
      probes(of, &peaks),
      spans(of, probes, state_text),
      frames(of),
      hash(with_hash ? std::make_unique<world::OutcomeHash>(of) : nullptr) {}

Performance::Performance(const Scenario& scenario, std::unique_ptr<Executor> executor, bool with_hash,
                         HostCommand* command)
    : executor_(std::move(executor)),
      command_(command),
      bench_(scenario.bench),
      lines_(scenario.bench.devices.size()) {
  for (std::size_t i = 0; i < bench_.lines.size(); ++i) {
    for (const world::StationSetup& station : bench_.lines[i].stations) lines_[station.device].push_back(i);
  }
  keeps_peaks_ = names_peaks(scenario.steps);
  executor_->with_world([&](world::World& world) {
    world_observers_ = std::make_unique<WorldObservers>(world, with_hash);
    if (keeps_peaks_)
      world.add_watcher(world_observers_->peaks);  // must come before the watchers that need peaks
  });
  if (RealBox* const box = executor_->box()) on_box_ = std::make_unique<OnBox>(*this, *box);
}

Performance::~Performance() {
  on_box_.reset();
  executor_->with_world([&](world::World& world) {
    world.remove_watcher(world_observers_->peaks);
    world.remove_watcher(world_observers_->spans);
    for (auto& [condition, history] : world_observers_->histories) world.remove_watcher(history);
    world_observers_.reset();
  });
}

std::optional<Failure> Performance::play(std::span<const Step> steps) {
  const Step& step = steps.front();
  step_ = &step;
  if (on_box_) return on_box_->play(step);
  try {
    const bool may_write =
        std::holds_alternative<WriteStep>(step.what) || std::holds_alternative<CommandStep>(step.what) ||
        std::holds_alternative<SendStep>(step.what) || std::holds_alternative<TextStep>(step.what);
    if (may_write) {
      std::vector<std::string> awaited;
      add_awaited(steps.subspan(1), awaited);
      end_histories();
      for (const std::string& condition : awaited) begin_history(condition);
    }
    std::visit([this](const auto& what) { perform(what); }, step.what);
    if (!may_write && moves_time(step)) end_histories();
    throw_if_broken();
    return std::nullopt;
  } catch (const StepError& error) {
    return explain_failure(error);
  } catch (const world::ExpressionError& error) {
    return explain_failure(StepError(error.what()));
  } catch (const world::NameError& error) {
    return explain_failure(StepError(error.what()));
  } catch (const ProgramError& error) {
    return explain_failure(StepError(in_text(error.first())));
  } catch (const FileError& error) {
    return explain_failure(StepError(error.what()));
  }
}

std::optional<Failure> Performance::begin_on_box() { return on_box_->begin(); }

void Performance::begin_step_now() {
  if (on_box_) on_box_->begin_step_now();
}

world::Number Performance::present_value(const std::string& expression) {
  if (on_box_) return on_box_->value_of(expression);
  world::Number value;
  executor_->with_world([&](world::World&) {
    value = world::evaluate(world::parse_expression(expression, world_observers_->probes),
                            world_observers_->probes);
  });
  return value;
}

void Performance::throw_if_broken() {
  bool is_broken = false;
  executor_->with_world([&](world::World&) { is_broken = world_observers_->spans.violation().has_value(); });
  if (is_broken) throw StepError("");  // explain_failure() finds the reason
}

Failure Performance::explain_failure(const StepError& error) {
  Failure failure{
      .what = error.what(), .expected = error.expected, .came = error.came, .details = error.details};
  executor_->with_world([&](world::World& world) {
    failure.frames = world_observers_->frames.last(kFramesReported);
    // A violated span takes precedence, because it was violated before anything else failed.
    if (const auto& violation = world_observers_->spans.violation()) {
      failure.at = violation->at;
      failure.what = violation->what + " did not hold at " + format_duration(violation->at);
      failure.expected = violation->what;
      failure.came = violation->explained;
      failure.details.clear();
      failure.state = violation->state;
    } else {
      failure.at = world.now();
      failure.state = state_text(world);
    }
  });
  return failure;
}

Performance::Checkpoint Performance::save() {
  Checkpoint checkpoint;
  checkpoint.faults = faults_;
  checkpoint.last_write = last_write();
  checkpoint.quiet_since = executor_->quiet_since();
  executor_->with_world([&](world::World& world) {
    checkpoint.world = world::save(world);
    checkpoint.spans = world_observers_->spans.save();
    checkpoint.peaks = world_observers_->peaks.save();
    for (const auto& [condition, history] : world_observers_->histories) {
      checkpoint.histories[condition] = history.save();
    }
    if (world_observers_->hash) checkpoint.hash = world_observers_->hash->value();
  });
  return checkpoint;
}

void Performance::restore(const Checkpoint& checkpoint) {
  faults_ = checkpoint.faults;
  last_write_ = checkpoint.last_write;
  executor_->with_world([&](world::World& world) {
    world::restore(world, checkpoint.world);
    world.remove_watcher(world_observers_->spans);
    if (!checkpoint.spans.empty()) world.add_watcher(world_observers_->spans);
    std::vector<SpanWatch::Span> spans = checkpoint.spans;
    for (SpanWatch::Span& span : spans) {
      // The condition is parsed again, because its handles belong to the probes of another performance.
      span.condition = world::parse_expression(span.condition.text, world_observers_->probes);
    }
    world_observers_->spans.restore(spans);
    world_observers_->peaks.restore(checkpoint.peaks);
    world_observers_->frames.restart();
    if (world_observers_->hash) world_observers_->hash->restore(checkpoint.hash);
  });
  executor_->set_quiet_since(checkpoint.quiet_since);
  end_histories();
  for (const auto& [condition, past] : checkpoint.histories) begin_history(condition, past);
}

std::uint64_t Performance::outcome_hash() {
  std::uint64_t hash = 0;
  executor_->with_world([&](world::World&) {
    if (world_observers_->hash) hash = world_observers_->hash->value();
  });
  return hash;
}

}  // namespace understudy::emulator::play
