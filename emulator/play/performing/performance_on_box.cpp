#include "emulator/play/performing/performance_on_box.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/files/file_error.h"
#include "base/files/passing_file.h"
#include "base/simulated_time.h"
#include "emulator/device/program_error.h"
#include "emulator/play/executors/executor.h"
#include "emulator/play/executors/real_box.h"
#include "emulator/play/performing/asking_on_box.h"
#include "emulator/play/performing/performance.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/requests.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/expression/tokens.h"
#include "emulator/world/names/level.h"
#include "emulator/world/names/names.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

namespace {

std::string place_text(const Step& step) { return step.file + ":" + std::to_string(step.line); }

}  // namespace

// --- steps ---------------------------------------------------------------------------------------

struct StepOnBox {
  using OnBox = Performance::OnBox;
  OnBox& on_box;
  const Step& step;

  void operator()(const WriteStep& what) const { on_box.use_line(what); }
  void operator()(const CommandStep& what) const { on_box.use_line(what); }
  void operator()(const SendStep& what) const { on_box.use_line(what); }
  void operator()(const TextStep& what) const { on_box.use_line(what); }
  void operator()(const ExpectStep& what) const { on_box.expect(what); }
  void operator()(const WaitStep& what) const { on_box.wait(what); }
  void operator()(const AdvanceStep& what) const { on_box.let_time_pass(what.by); }
  void operator()(const AssertStep& what) const { on_box.check(what); }
  void operator()(const SpanStep& what) const { on_box.open(step, what); }
  void operator()(const EndSpanStep& what) const {
    std::erase_if(on_box.spans_, [&](const auto& span) { return span.name == what.name; });
  }
  void operator()(const SayStep&) const {}
  void operator()(const ResetPeaksStep&) const {}

  void operator()(const InputStep& what) const {
    for (const world::InputSetup& input : what.inputs) on_box.act(on_box.words_of_input(input));
    rehearse(what);
  }
  void operator()(const TurnStep& what) const {
    for (const world::Fault& turn : what.turns) on_box.act(words_of_fault("turn", turn));
    rehearse(what);
  }
  void operator()(const InjectStep& what) const {
    std::vector<std::string> words = words_of_fault("inject", what.fault);
    words.push_back("name=" + what.name);
    on_box.act(words);
    rehearse(what);
  }
  void operator()(const ClearStep& what) const {
    on_box.act({"clear", what.name.empty() ? "all" : what.name});
    rehearse(what);
  }
  void operator()(const PowerStep& what) const {
    for (const auto& [device, to] : what.devices) {
      const char* const word = to == PowerStep::To::on ? "on" : to == PowerStep::To::off ? "off" : "cycle";
      on_box.act({"power", on_box.device_name(device), word});
    }
    rehearse(what);
  }
  void operator()(const ProgramStep& what) const {
    if (what.refused) throw OnBox::Skip("whether a program is refused cannot be observed", true);
    on_box.load(what.device, what.file, what.text);
    rehearse(what);
  }

  void operator()(const MemoryStep&) const {
    throw OnBox::Skip("the memory cannot be accessed over the line", false);
  }
  void operator()(const CommandEndStep&) const {
    throw OnBox::Skip("no command runs with the scenario", true);
  }
  void operator()(const SnapshotStep&) const { throw OnBox::Skip("the state cannot be saved", false); }
  void operator()(const RestoreStep&) const { throw OnBox::Skip("time cannot go back", true); }
  void operator()(const ForkStep&) const { throw OnBox::Skip("time cannot go back", false); }

 private:
  /// In a rehearsal, the world replaces the machine.
  void rehearse(const auto& what) const {
    if (on_box.box_.is_rehearsal()) on_box.performance_.perform(what);
  }

  std::vector<std::string> words_of_fault(const std::string& verb, const world::Fault& fault) const {
    const world::FaultText text =
        world::fault_text(on_box.performance_.world_observers_->world.known(), fault);
    std::vector<std::string> words{verb};
    if (verb != text.kind) words.push_back(text.kind);
    words.push_back(text.place);
    for (const auto& [name, value] : text.fields) words.push_back(name + "=" + value);
    return words;
  }
};

std::optional<Failure> Performance::OnBox::play(const Step& step) {
  performance_.skipped_ = cut_;
  if (!cut_.empty()) return std::nullopt;
  return attempt(&step, [&] {
    std::visit(StepOnBox{*this, step}, step.what);
    check_spans();
  });
}

std::optional<Failure> Performance::OnBox::attempt(const Step* step, const std::function<void()>& act) {
  try {
    act();
  } catch (const Skip& skip) {
    performance_.skipped_ = skip.what();
    if (skip.cuts) cut(step, skip.what());
  } catch (const NotAllowed& refused) {
    performance_.skipped_ = refused.what();
    cut(step, refused.what());
  } catch (const BeyondEnvelope& refused) {
    return fail(StepError(refused.what()));
  } catch (const RigFailed& error) {
    return fail(StepError(error.what()));
  } catch (const StepError& error) {
    if (!box_.only_plans()) return fail(error);
  } catch (const world::ExpressionError& error) {
    return fail(StepError(error.what()));
  } catch (const world::ArithmeticError& error) {
    return fail(StepError(error.what()));
  } catch (const world::NameError& error) {
    return fail(StepError(error.what()));
  } catch (const ProgramError& error) {
    return fail(StepError(in_text(error.first())));
  } catch (const FileError& error) {
    return fail(StepError(error.what()));
  }
  return std::nullopt;
}

/// Sends the stop command before reporting the failure.
Failure Performance::OnBox::fail(const StepError& error) {
  const SimTime at = performance_.executor_->now();
  std::vector<std::string> frames = box_.last_frames();
  box_.stop();
  return {.at = at,
          .what = error.what(),
          .expected = error.expected,
          .came = error.came,
          .details = error.details,
          .frames = std::move(frames)};
}

void Performance::OnBox::cut(const Step* step, const std::string& why) {
  cut_ = step != nullptr ? "it follows " + place_text(*step) + ", which was skipped" : why;
}

// --- the line ------------------------------------------------------------------------------------

std::string Performance::OnBox::device_name(std::size_t device) const {
  return performance_.bench_.devices[device].settings.name;
}

void Performance::OnBox::require_reachable(std::size_t line) {
  if (const auto why = box_.why_unreachable(line)) throw Skip(*why, true);
}
void Performance::OnBox::require_reachable(std::size_t device, const Via& via) {
  if (performance_.lines_[device].empty()) throw Skip(device_name(device) + " is not on a line", true);
  require_reachable(via.value_or(performance_.lines_[device].front()));
}

void Performance::OnBox::use_line(const WriteStep& step) {
  for (const WriteStep::Entry& entry : step.entries) require_reachable(entry.target.device, step.via);
  performance_.perform(step);
  due_ = performance_.executor_->now();
}
void Performance::OnBox::use_line(const CommandStep& step) {
  for (const CommandStep::Entry& entry : step.entries) require_reachable(entry.device, step.via);
  performance_.perform(step);
  due_ = performance_.executor_->now();
}
void Performance::OnBox::use_line(const SendStep& step) {
  require_reachable(step.line);
  performance_.perform(step);
  due_ = performance_.executor_->now();
}
void Performance::OnBox::use_line(const TextStep& step) {
  require_reachable(step.line);
  performance_.perform(step);
  due_ = performance_.executor_->now();
}

/// Performs a step that only reads values, on which later steps do not depend.
void Performance::OnBox::look(const std::function<void()>& at) {
  try {
    at();
  } catch (const Skip& skip) {
    throw Skip(skip.what(), false);
  }
}

/// A value that changes while it is being read cannot be compared, because the exact moment of reading is
/// unknown.
void Performance::OnBox::expect(const ExpectStep& step) {
  for (const ExpectStep::Entry& entry : step.entries)
    if (!entry.target.is_value) require_reachable(entry.target.device, step.via);
  try {
    look([&] { performance_.perform(step); });
  } catch (const StepError& first) {
    if (!step.answer.is_good()) throw;
    std::string second;
    try {
      performance_.perform(step);
    } catch (const StepError& again) {
      second = again.came;
    }
    if (second == first.came) throw;
    throw Skip(
        "it changes while it is read: " + first.came + ", then " + (second.empty() ? "as expected" : second),
        false);
  }
  due_ = performance_.executor_->now();
}

world::Number Performance::OnBox::value_of(const std::string& text) {
  Asking asking(*this, {});
  const world::Expression expression = asking.parse(text);
  asking.ask(expression);
  return world::evaluate(expression, asking.names());
}

void Performance::OnBox::check(const AssertStep& step) {
  std::vector<std::string> untrue;
  std::vector<std::string> explained;
  for (const std::string& text : step.expressions) {
    Asking asking(*this, {});
    const world::Expression expression = asking.parse(text);
    look([&] { asking.ask(expression); });
    if (world::is_true(expression, asking.names())) continue;
    const std::string first = world::explain(expression, asking.names());
    asking.ask(expression);
    const std::string second = world::explain(expression, asking.names());
    if (first != second) throw Skip("it changes while it is read: " + first + ", then " + second, false);
    untrue.push_back(world::to_text(expression));
    explained.push_back(second);
  }
  if (untrue.empty()) return;
  throw StepError("'" + untrue.front() + "' does not hold", untrue.front(), explained.front(),
                  {explained.begin() + 1, explained.end()});
}

void Performance::OnBox::open(const Step& at, const SpanStep& step) {
  Asking asking(*this, {});
  const world::Expression condition = asking.parse(step.expression);
  look([&] { asking.ask(condition); });
  spans_.push_back({.name = step.name.empty() ? world::to_text(condition) : step.name,
                    .expression = step.expression,
                    .is_never = step.never,
                    .place = place_text(at)});
}

/// Checks the open spans. A violation between two checks is not noticed.
void Performance::OnBox::check_spans() {
  for (const Span& span : spans_) {
    Asking asking(*this, {});
    const world::Expression condition = asking.parse(span.expression);
    asking.ask(condition);
    if (world::is_true(condition, asking.names()) != span.is_never) continue;
    const std::string what = (span.is_never ? "never '" : "always '") + span.name + "' (" + span.place + ")";
    throw StepError(what + " did not hold", what, world::explain(condition, asking.names()));
  }
}

// --- time ----------------------------------------------------------------------------------------

void Performance::OnBox::let_time_pass(SimTime by) {
  performance_.moment_in(by);  // throws if there is no such moment
  due_ += by;
  const SimTime now = performance_.executor_->now();
  if (due_ > now) performance_.executor_->advance(due_ - now);
}

void Performance::OnBox::wait(const WaitStep& step) {
  Asking asking(*this, step.via);
  const world::Expression condition = asking.parse(step.until);
  Executor& executor = *performance_.executor_;
  const SimTime deadline = performance_.moment_in(step.within);
  const Moment write = box_.last_write();
  SimTime not_yet = write.latest;  // the last time at which the condition was not true
  bool is_first = true;
  while (true) {
    const SimTime asked = executor.now();
    asking.ask(condition);
    const SimTime reported = executor.now();
    if (world::is_true(condition, asking.names())) {
      const SimTime min = is_first ? SimTime{0} : std::max(not_yet - write.latest, SimTime{0});
      const SimTime max = reported - write.earliest;
      due_ = is_first ? reported : (not_yet + reported) / 2;
      if (!step.takes) return;
      const bool is_too_early = step.takes->low && world::Number(max.count()) < *step.takes->low;
      const bool is_too_late = step.takes->high && world::Number(min.count()) > *step.takes->high;
      if (!is_too_early && !is_too_late) return;
      const std::string took = "between " + format_duration(min) + " and " + format_duration(max);
      throw StepError("took " + took + "; expected " + step.takes->text,
                      "'" + world::on_one_line(step.until) + "' after " + step.takes->text,
                      "it became true after " + took);
    }
    check_spans();
    is_first = false;
    not_yet = asked;
    if (asked > deadline) break;
    if (step.poll && reported < asked + *step.poll) executor.advance(asked + *step.poll - reported);
    if (executor.now() == asked) executor.advance(std::chrono::milliseconds(1));
  }
  const std::string text = world::to_text(condition);
  throw StepError("'" + text + "' did not become true within " + format_duration(step.within),
                  text + " within " + format_duration(step.within),
                  world::explain(condition, asking.names()));
}

// --- the surroundings ----------------------------------------------------------------------------

void Performance::OnBox::act(const std::vector<std::string>& words) {
  if (const auto why = box_.act(words)) throw Skip(*why, true);
  due_ = performance_.executor_->now();
}

/// A rig loads files, so a program that the scenario contains becomes one while it is loaded.
void Performance::OnBox::load(std::size_t device, const std::string& file, const std::string& text) {
  if (!file.empty() || box_.is_rehearsal()) {
    act({"program", device_name(device), file.empty() ? "a program of the scenario" : file});
    return;
  }
  const PassingFile passing("understudy-program", text);
  act({"program", device_name(device), passing.path()});
}

std::optional<Failure> Performance::OnBox::begin() {
  return attempt(nullptr, [&] {
    for (std::size_t device = 0; device < performance_.bench_.devices.size(); ++device) set_up(device);
    due_ = performance_.executor_->now();
  });
}

/// The scenario begins after power-up, which only a rig can perform, and with the values that the bench sets.
void Performance::OnBox::set_up(std::size_t device) {
  const DeviceSettings& settings = performance_.bench_.devices[device].settings;
  const Model& model = *performance_.bench_.devices[device].model;
  const Firmware firmware = settings.firmware != 0 ? settings.firmware : model.firmwares.back();
  if (performance_.lines_[device].empty()) return;
  if (box_.why_unreachable(performance_.lines_[device].front())) return;
  if (box_.is_bare()) {
    box_.act({"factory", settings.name, "optional"});
    set_up_surroundings(device);
  }
  box_.act({"power", settings.name, "cycle", "optional"});
  for (const auto& [name, value] : settings.set) {
    const std::string full = settings.name + "." + name;
    const auto place = find_register(model, name, firmware);
    const bool is_known =
        place && place->place.row->access != Access::write && value_of(full) == world::Number(value);
    if (is_known) continue;
    WriteStep write;
    write.entries.push_back(
        {.target = {.device = device, .name = full, .place = place}, .value = std::to_string(value)});
    performance_.perform(write);
  }
  for (const auto& [name, value] : settings.assignments) {
    const world::Number wanted = world::finite_number(value);
    if (value_of(settings.name + "." + name) == wanted) continue;
    performance_.executor_->send_text(performance_.lines_[device].front(),
                                      name + "=" + world::number_text(wanted));
  }
}

/// Switches and inputs come before power-up, as on the bench.
void Performance::OnBox::set_up_surroundings(std::size_t device) {
  const DeviceSettings& settings = performance_.bench_.devices[device].settings;
  for (const auto& [name, is_on] : settings.dip)
    act({"input", settings.name + "." + name, is_on ? "on" : "off"});
  for (const world::InputSetup& input : performance_.bench_.inputs)
    if (input.device == device) act(words_of_input(input));
  if (!settings.program.empty()) load(device, settings.program_name, settings.program);
}

std::vector<std::string> Performance::OnBox::words_of_input(const world::InputSetup& input) const {
  const world::KnownDevice& known = performance_.world_observers_->world.known()[input.device];
  const TerminalRow& row = known.model->terminals[static_cast<std::size_t>(input.terminal)];
  return {"input", known.name + "." + std::string(row.name), world::level_text(row, input.level)};
}

}  // namespace understudy::emulator::play
