// Performs steps in which time passes, or which check values without using the line.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/register_map/row.h"
#include "emulator/play/executors/real_executor.h"
#include "emulator/play/performing/performance.h"
#include "emulator/play/performing/watches.h"
#include "emulator/play/scenario/requests.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/expression/tokens.h"
#include "emulator/world/names/names.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

namespace {

/// The registers in a condition, with the values that a host has read.
class PolledRegisters final : public world::NameResolver, public world::ValueSource {
 public:
  explicit PolledRegisters(const world::KnownDevices& known) : known_(known) {}

  world::NamedNumber resolve(std::string_view name) const override {
    const world::RegisterName found = world::find_register(known_, name);
    targets_.push_back({.device = found.device, .name = std::string(name), .place = found.place});
    return {static_cast<std::int32_t>(targets_.size() - 1), world::Unit::none};
  }
  world::Number value(std::int32_t handle) const override {
    const auto i = static_cast<std::size_t>(handle);
    return number_of(targets_[i], values[i]).value_or(0);
  }

  const std::vector<Target>& targets() const { return targets_; }
  std::vector<Value> values;

 private:
  world::KnownDevices known_;
  mutable std::vector<Target> targets_;
};

std::string place_of(const Step& step) { return step.file + ":" + std::to_string(step.line); }

}  // namespace

void Performance::pass_time(SimTime until) {
  bool has_spans = false;
  executor_->with_world([&](world::World&) { has_spans = !world_observers_->spans.is_empty(); });
  if (has_spans) {
    executor_->run_until(
        {.is_met = [this](world::World&) { return world_observers_->spans.violation().has_value(); },
         .next_poll = [this](Tick done) { return world_observers_->spans.next_poll(done); }},
        until);
    throw_if_broken();
  } else if (until > executor_->now()) {
    executor_->advance(until - executor_->now());
  }
}

SimTime Performance::moment_in(SimTime duration) {
  const SimTime rest = std::max(kHorizon - executor_->now(), SimTime{0});
  if (duration <= rest) return executor_->now() + duration;
  throw StepError(format_duration(duration) +
                  " from now is beyond the end of simulated time; expected at most " + format_duration(rest));
}

void Performance::perform(const AdvanceStep& step) { pass_time(moment_in(step.by)); }

// --- waiting -----------------------------------------------------------------------------------

/// Returns the tick from which the last write takes effect.
Tick Performance::last_write() {
  const Tick tick = executor_->tick_of_last_write();
  return tick != 0 ? tick : last_write_;
}

/// Begins to watch a condition. If it becomes true while the reply to a write is still on the line, this
/// counts as after the write.
void Performance::begin_history(const std::string& condition, const ConditionHistory::State& past) {
  executor_->with_world([&](world::World& world) {
    const auto [history, is_new] = world_observers_->histories.try_emplace(
        condition, world::parse_expression(condition, world_observers_->probes), world_observers_->probes);
    if (!is_new) return;
    history->second.restore(past);
    world.add_watcher(history->second);
  });
}

void Performance::end_histories() {
  if (world_observers_->histories.empty()) return;
  executor_->with_world([&](world::World& world) {
    for (auto& [condition, history] : world_observers_->histories) world.remove_watcher(history);
    world_observers_->histories.clear();
  });
}

void Performance::perform(const WaitStep& step) {
  const Tick begin = last_write();
  const Tick came_true = step.poll ? poll_for(step) : wait_for(step);
  if (!step.takes) return;
  const SimTime took = time_of(came_true - begin);
  if (step.takes->holds(world::Number(took.count()))) return;
  throw StepError("took " + format_duration(took) + "; expected " + step.takes->text,
                  "'" + world::on_one_line(step.until) + "' after " + step.takes->text,
                  "it became true after " + format_duration(took));
}

Tick Performance::wait_for(const WaitStep& step) {
  const SimTime deadline = moment_in(step.within);
  const Tick earliest = last_write();
  std::optional<Tick> came_true;
  world::Expression condition;
  executor_->with_world([&](world::World&) {
    condition = world::parse_expression(step.until, world_observers_->probes);
    if (const auto history = world_observers_->histories.find(step.until);
        history != world_observers_->histories.end()) {
      came_true = history->second.first_from(earliest);
    }
  });
  if (came_true) return *came_true;
  std::optional<std::string> no_result;
  const auto is_over = [&](world::World&) {
    try {
      return world_observers_->spans.violation() || world::is_true(condition, world_observers_->probes);
    } catch (const std::runtime_error& error) {
      no_result = error.what();
      return true;
    }
  };
  const auto next_poll = [&](Tick done) {
    return std::min(world_observers_->probes.next_change(condition, done),
                    world_observers_->spans.next_poll(done));
  };
  const bool is_met = executor_->run_until({.is_met = is_over, .next_poll = next_poll}, deadline);
  throw_if_broken();
  if (no_result) throw StepError(*no_result);
  if (is_met) return std::max(tick_at(executor_->now()), earliest);
  std::string explained;
  executor_->with_world(
      [&](world::World&) { explained = world::explain(condition, world_observers_->probes); });
  const std::string text = world::to_text(condition);
  throw StepError("'" + text + "' did not become true within " + format_duration(step.within),
                  text + " within " + format_duration(step.within), explained);
}

Tick Performance::poll_for(const WaitStep& step) {
  world::KnownDevices known;
  executor_->with_world([&](world::World& world) { known = world.known(); });
  PolledRegisters registers(known);
  const world::Expression condition = world::parse_expression(step.until, registers);
  const SimTime deadline = moment_in(step.within);
  for (SimTime round = executor_->now();; round = std::max(round + *step.poll, executor_->now())) {
    if (round >= deadline) break;
    pass_time(round);
    registers.values.clear();
    std::vector<bool> low_word_first;
    words_of_all(registers.targets(), low_word_first);
    const auto words = read_over_line(registers.targets(), {}, step.via);
    throw_if_broken();
    for (std::size_t i = 0; i < words.size(); ++i) {
      registers.values.push_back(value_in(registers.targets()[i], words[i], low_word_first[i]));
    }
    if (world::is_true(condition, registers)) return std::max(tick_at(executor_->now()), last_write());
  }
  const std::string text = world::to_text(condition);
  throw StepError("'" + text + "' did not become true within " + format_duration(step.within) +
                      ", polled every " + format_duration(*step.poll),
                  text + " within " + format_duration(step.within), world::explain(condition, registers));
}

// --- assertions --------------------------------------------------------------------------------

void Performance::perform(const AssertStep& step) {
  std::vector<std::string> untrue;
  std::vector<std::string> explained;
  executor_->with_world([&](world::World&) {
    for (const std::string& text : step.expressions) {
      const world::Expression expression = world::parse_expression(text, world_observers_->probes);
      if (world::is_true(expression, world_observers_->probes)) continue;
      untrue.push_back(world::to_text(expression));
      explained.push_back(world::explain(expression, world_observers_->probes));
    }
  });
  if (untrue.empty()) return;
  throw StepError("'" + untrue.front() + "' does not hold", untrue.front(), explained.front(),
                  {explained.begin() + 1, explained.end()});
}

void Performance::perform(const SpanStep& step) {
  executor_->with_world([&](world::World& world) {
    world::Expression condition = world::parse_expression(step.expression, world_observers_->probes);
    if (world_observers_->spans.is_empty()) world.add_watcher(world_observers_->spans);
    world_observers_->spans.open({.name = step.name.empty() ? world::to_text(condition) : step.name,
                                  .condition = std::move(condition),
                                  .is_never = step.never,
                                  .place = place_of(*step_)});
  });
}

void Performance::perform(const EndSpanStep& step) {
  bool was_open = false;
  executor_->with_world([&](world::World& world) {
    was_open = world_observers_->spans.close(step.name);
    if (world_observers_->spans.is_empty()) world.remove_watcher(world_observers_->spans);
  });
  if (!was_open)
    throw StepError("no `always` or `never` called '" + step.name +
                    "' is active; expected one that is active");
}

void Performance::perform(const ResetPeaksStep&) {
  executor_->with_world([&](world::World&) { world_observers_->peaks.reset(); });
}

/// Waits for the end of the command. Returns false if it has not ended by the deadline.
bool Performance::wait_for_command(SimTime deadline) {
  const auto is_over = [&](world::World&) {
    return world_observers_->spans.violation() || command_->exit_code();
  };
  // In simulated time, a command ends between two ticks.
  const auto next_poll = [&](Tick done) {
    return command_->exit_code() ? done + 1 : world_observers_->spans.next_poll(done);
  };
  const bool has_ended = executor_->run_until({.is_met = is_over, .next_poll = next_poll}, deadline);
  throw_if_broken();
  return has_ended;
}

std::optional<Failure> Performance::finish_with_command() {
  try {
    wait_for_command(kForever);
  } catch (const StepError& error) {
    return explain_failure(error);
  } catch (const ExecutionAborted&) {  // the clock or the command was stopped: all steps have ended
  }
  return std::nullopt;
}

void Performance::perform(const CommandEndStep& step) {
  if (command_ == nullptr) {
    throw StepError("no command runs alongside this scenario; expected `understudy exec " + step_->file +
                    " -- COMMAND`");
  }
  if (step.stops) executor_->with_world([&](world::World&) { command_->stop(); });
  const bool has_ended = wait_for_command(moment_in(step.within));
  const std::string expected = "exit code " + std::to_string(step.exits);
  if (!has_ended) {
    throw StepError("the command did not end within " + format_duration(step.within),
                    expected + " within " + format_duration(step.within), "it is still running");
  }
  int code = 0;
  executor_->with_world([&](world::World&) { code = *command_->exit_code(); });
  if (step.stops || code == step.exits) return;
  throw StepError(
      "the command ended with exit code " + std::to_string(code) + "; expected " + std::to_string(step.exits),
      expected, "exit code " + std::to_string(code));
}

}  // namespace understudy::emulator::play
