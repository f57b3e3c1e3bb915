// Reads steps in which time passes, or which check values: wait, advance, assert, always, never, end, reset,
// host, say.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/play/reading/step_readers.h"
#include "emulator/play/reading/step_schemas.h"
#include "emulator/play/reading/steps_reader.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/expression/tokens.h"
#include "emulator/world/expression/tolerance.h"

namespace understudy::emulator::play {

namespace {

SimTime read_some_time(const world::YamlFields& field) {
  const SimTime time = field.duration();
  if (time <= SimTime{0}) field.fail("takes no time; expected a duration above 0");
  return time;
}

world::Tolerance read_takes(const world::YamlFields& field, SimTime within) {
  try {
    world::Tolerance takes = world::parse_tolerance(field.text(), world::Unit::nanoseconds);
    if (takes.low && *takes.low > world::Number(within.count())) {
      field.fail("is longer than `within`, " + format_duration(within) + "; expected a shorter time");
    }
    return takes;
  } catch (const world::ExpressionError& error) {
    field.fail(error.what());
  }
}

void read_span(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value,
               bool never) {
  SpanStep span{.expression = {}, .never = never, .name = {}};
  reader.attempt([&] {
    if (value.is_map()) value.require_keys(kSpanKeys);
  });
  reader.attempt([&] {
    span.expression = reader.trial().changing_condition(value.is_map() ? value.at("what") : value);
  });
  const bool is_named = value.is_map() && value.has("name");
  span.name = is_named ? value.at("name").text() : world::on_one_line(span.expression);
  if (reader.has_failed()) return;
  auto& open = reader.story().spans;
  if (std::find(open.begin(), open.end(), span.name) != open.end()) {
    value.fail(quoted(span.name) + " is already active; expected another name, or an `end` first");
  }
  open.push_back(span.name);
  const std::string text = (never ? "never " : "always ") + world::on_one_line(span.expression);
  reader.add(step, text, std::move(span));
}

constexpr SimTime kShortestPoll = kTickLength;

}  // namespace

void read_wait(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  reader.attempt([&] { value.require_keys(kWaitKeys); });
  WaitStep wait;
  std::string text;
  const bool has_condition =
      reader.attempt([&] { wait.until = reader.trial().changing_condition(value.at("until")); });
  const bool has_time = reader.attempt([&] { wait.within = read_some_time(value.at("within")); });
  text = "wait until " + world::on_one_line(wait.until) + " within " + format_duration(wait.within);
  reader.attempt([&] {
    const auto takes = value.find("takes");
    if (!takes || !has_time) return;
    wait.takes = read_takes(*takes, wait.within);
    text += ", takes " + wait.takes->text;
  });
  reader.attempt([&] {
    const auto poll = value.find("poll");
    if (!poll) return;
    wait.poll = read_some_time(*poll);
    if (*wait.poll < kShortestPoll) {
      poll->fail(format_duration(*wait.poll) + " is shorter than any request; expected 1ms or more");
    }
    text += ", polled every " + format_duration(*wait.poll);
  });
  reader.attempt([&] {
    const auto via = value.find(kViaKey.key);
    if (via && !value.has("poll"))
      via->fail("has no effect without `poll`, because only `poll` reads over a line; expected both");
    if (!has_condition || !value.has("poll")) return;
    const std::vector<std::size_t> devices = reader.trial().require_registers_only(value.at("until"));
    if (!via) return;
    wait.via = reader.trial().line_of_all(*via, devices);
    text += " via " + via->text();
  });
  reader.add(step, text, std::move(wait));
}

void read_advance(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  const SimTime by = read_some_time(value);
  reader.add(step, "advance " + format_duration(by), AdvanceStep{by});
}

void read_assert(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  AssertStep truths;
  const auto fields = value.is_list() ? value.elements() : std::vector<world::YamlFields>{value};
  if (fields.empty()) value.fail("is empty; expected a condition");
  std::string text = "assert";
  for (const world::YamlFields& field : fields) {
    reader.attempt([&] {
      truths.expressions.push_back(reader.trial().condition(field));
      text += (truths.expressions.size() == 1 ? " " : "; ") + world::on_one_line(truths.expressions.back());
    });
  }
  reader.add(step, text, std::move(truths));
}

void read_always(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  read_span(reader, step, value, false);
}

void read_never(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  read_span(reader, step, value, true);
}

void read_end(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  const std::string name = world::on_one_line(value.text());
  auto& open = reader.story().spans;
  const auto it = std::find(open.begin(), open.end(), name);
  if (it == open.end()) {
    value.fail("no active `always` or `never` is called " + quoted(name) + suggestion(name, open));
  }
  open.erase(it);
  reader.add(step, "end " + name, EndSpanStep{name});
}

void read_reset(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  if (value.text() != "peaks") value.fail(quoted(value.text()) + " cannot be reset; expected peaks");
  reader.add(step, "reset peaks", ResetPeaksStep{});
}

void read_say(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  const std::string text = world::on_one_line(value.text());
  reader.add(step, "say " + text, SayStep{text});
}

void read_host(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  if (!value.is_map()) {
    if (value.text() != kHostWords[0])
      value.fail(quoted(value.text()) + " is unknown; expected stop, or { exits: 0, within: 30s }");
    constexpr SimTime kLongestStop = std::chrono::seconds(10);
    return reader.add(step, "host stop", CommandEndStep{.stops = true, .within = kLongestStop});
  }
  reader.attempt([&] { value.require_keys(kHostKeys); });
  CommandEndStep end;
  reader.attempt([&] { end.within = read_some_time(value.at("within")); });
  reader.attempt([&] {
    if (value.has("exits")) end.exits = static_cast<int>(value.at("exits").integer(kExitCodeSchema));
  });
  reader.add(step, "host exits " + std::to_string(end.exits) + " within " + format_duration(end.within), end);
}

}  // namespace understudy::emulator::play
