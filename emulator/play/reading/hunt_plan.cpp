#include "emulator/play/reading/hunt_plan.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/files/file_error.h"
#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/play/reading/hunt_schema.h"
#include "emulator/play/reading/step_readers.h"
#include "emulator/play/reading/steps_reader.h"
#include "emulator/play/reading/variation.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"
#include "emulator/world/faults/fault.h"

namespace understudy::emulator::play {

namespace {

using When = Disturbance::When;

constexpr std::string_view kInject = "inject";

/// The fields of a fault that determine when it takes effect. A fault without them is assigned a moment.
constexpr std::array<std::string_view, 7> kMoments{"at", "nth", "from", "to", "when", "every", "chance"};

bool is_drawn(const world::YamlFields& field) {
  return field.is_map() && (field.has("between") || field.has("one_of"));
}

/// Replaces the drawn values in a step with texts, in the order in which they are written.
template <typename TextOf>
world::YamlFields drawn_step(const world::YamlFields& step, const TextOf& text_of) {
  std::size_t number = 0;
  return step.settled([&](const world::YamlFields& field) -> std::optional<std::string> {
    if (!is_drawn(field)) return std::nullopt;
    return text_of(field, number++);
  });
}

/// Returns the key that sets the moment of a fault.
std::string_view key_of(When when, bool has_end) {
  if (when == When::nth) return "nth";
  return has_end ? "at" : "from";
}

std::string text_of_moment(const Disturbance& disturbance) {
  return disturbance.when == When::nth ? std::to_string(disturbance.moment)
                                       : format_duration(SimTime(disturbance.moment));
}

/// Returns the value of a step's only key.
world::YamlFields only_value(const world::YamlFields& step) { return step.entries().front().second; }

}  // namespace

HuntPlan::HuntPlan(const world::YamlFields& hunt, const world::YamlFields& head,
                   std::vector<WrittenStep> steps, StepsReader& reader)
    : head_(head.settled()), steps_(std::move(steps)), last_(steps_.size() - 1) {
  world::Diagnostics all;
  all.require([&] {
    all.attempt([&] { hunt.require_keys(kHuntKeys); });
    all.attempt([&] {
      if (const auto from = hunt.find("from")) first_ = step_called(*from) + 1;
    });
    all.attempt([&] {
      if (const auto to = hunt.find("to")) last_ = step_called(*to);
    });
    all.attempt([&] {
      if (last_ >= first_) return;
      first_ = 0;
      last_ = steps_.size() - 1;  // so that the entries can be read
      hunt.at(hunt.has("to") ? "to" : "from")
          .fail("leaves no step between `from` and `to`; expected `from` before `to`");
    });
    all.attempt([&] { read_spans(hunt, reader); });
    all.attempt([&] {
      const world::YamlFields may = hunt.at("may");
      const auto entries = may.elements();
      if (entries.empty()) may.fail("is empty; expected an entry such as `- inject: { drop: feeder }`");
      for (const world::YamlFields& entry : entries) all.attempt([&] { read_entry(entry, reader); });
    });
  });
}

/// Finds a `say` step by its text. Returns its number.
std::size_t HuntPlan::step_called(const world::YamlFields& field) const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const auto say = steps_[i].fields.find("say");
    if (!say) continue;
    names.push_back(say->text());
    if (names.back() == field.text()) return i;
  }
  field.fail(quoted(field.text()) + " is not the text of a `say` step" +
             (names.empty() ? "; expected `- say: " + field.text() + "` among the steps"
                            : suggestion(field.text(), names)));
}

void HuntPlan::read_spans(const world::YamlFields& hunt, StepsReader& reader) {
  const auto add = [&](const world::YamlFields& field, const char* key) {
    spans_.push_back(field.settled().under(key));
    reader.read_apart(spans_.back());
  };
  for (const char* const key : {"never", "always"}) {
    const auto field = hunt.find(key);
    if (!field) continue;
    if (!field->is_list()) {
      add(*field, key);
      continue;
    }
    for (const world::YamlFields& element : field->elements()) add(element, key);
  }
  if (const auto within = hunt.find("within")) {
    read_within(*within);
    const std::string over = "time > " + within->text();
    add(within->settled([&](const world::YamlFields&) { return over; }), "never");
  }
}

void HuntPlan::read_entry(const world::YamlFields& field, StepsReader& reader) {
  field.require_keys(kMayKeys);
  std::optional<std::string> kind;
  for (const auto& [key, value] : field.entries()) {
    const auto row = std::find_if(kMayKeys.begin(), kMayKeys.begin() + kDisturbingSteps,
                                  [&its_key = key](const world::Key& known) { return known.key == its_key; });
    if (row == kMayKeys.begin() + kDisturbingSteps) continue;
    if (kind) value.fail("is a second step in one entry; expected `- ` before it");
    kind = key;
  }
  if (!kind) field.fail("has no step; expected one such as `inject: { drop: feeder }`");
  static constexpr std::array<std::string_view, 4> kBeside{"times", "within", "from", "to"};
  Entry entry{
      .step = field.without(kBeside).settled(), .values = {}, .first = first_, .last = last_, .ways = {}};
  if (const auto times = field.find("times"))
    entry.max = static_cast<std::size_t>(times->integer(kMaxTimesSchema));
  if (const auto within = field.find("within")) entry.within = read_within(*within);
  if (const auto from = field.find("from")) entry.first = std::max(first_, step_called(*from) + 1);
  if (const auto to = field.find("to")) entry.last = std::min(last_, step_called(*to));
  if (entry.last < entry.first)
    field.fail("leaves no step between its `from` and `to` and those of the hunt; expected at least one");
  if (only_value(entry.step).is_map() && only_value(entry.step).has("name"))
    only_value(entry.step)
        .at("name")
        .fail("cannot be used, because the fault may occur several times; expected no name");
  drawn_step(entry.step, [&](const world::YamlFields& drawn, std::size_t) {
    entry.values.emplace_back(drawn, "", 0, false);
    return std::string("0");
  });
  read_ways(entry, reader);
  if (entry.within >= SimTime{0} && entry.ways.front() != When::at) {
    field.at("within").fail(
        "needs a fault that waits for a time; expected an `inject` without `nth`, `at` and so on");
  }
  check_values(entry, reader);
  entries_.push_back(std::move(entry));
}

/// Determines which moments an entry may have. The command of a `host` step runs while the scenario waits in
/// that step, so a disturbance before the step waits for its moment.
void HuntPlan::read_ways(Entry& entry, StepsReader& reader) {
  entry.at_step = entry.first;
  entry.ways = {When::here};
  if (entry.step.entries().front().first == kInject) return read_ways_of_fault(entry, reader);
  for (std::size_t i = entry.first; i <= entry.last; ++i) {
    if (!steps_[i].fields.has("host") || steps_[i].continues) continue;
    entry.at_step = i;
    entry.ways = {When::late};
    return;
  }
}

void HuntPlan::read_ways_of_fault(Entry& entry, StepsReader& reader) {
  const world::YamlFields fault = only_value(entry.step);
  if (!fault.is_map()) return;
  if (std::any_of(kMoments.begin(), kMoments.end(), [&](std::string_view key) { return fault.has(key); }))
    return;
  const Steps steps = reader.read_apart(drawn_step(
      entry.step, [&](const world::YamlFields&, std::size_t i) { return entry.values[i].value_at(0); }));
  const world::Fault::Kind kind = std::get<InjectStep>(steps.front().what).fault.kind;
  entry.has_end = fault.has("for") || world::is_done_at_once(kind);
  const bool is_about_messages =
      world::is_of_frames(kind) || fault.has("function") || fault.has("station") || fault.has("address");
  entry.ways = {When::nth};
  if (is_about_messages) return;
  entries_.push_back(entry);
  const std::size_t number = entries_.size() - 1;
  Disturbance sample{.entry = number, .when = When::nth, .moment = 1, .values = {}};
  sample.values.assign(entry.values.size(), 0);
  const world::YamlFields step = step_of(sample);
  entries_.pop_back();
  try {
    reader.read_apart(step);
    entry.ways = {When::at, When::nth};
  } catch (const FileError&) {
    entry.ways = {When::at};  // some faults cannot wait for a message
  }
}

/// Reads the step with both ends of its ranges, and with each value in its lists.
void HuntPlan::check_values(const Entry& entry, StepsReader& reader) const {
  const auto read_with = [&](std::size_t which, std::uint64_t place) {
    reader.read_apart(drawn_step(entry.step, [&](const world::YamlFields&, std::size_t i) {
      return entry.values[i].value_at(i == which ? place : 0);
    }));
  };
  read_with(0, 0);
  for (std::size_t i = 0; i < entry.values.size(); ++i) {
    const Variation& value = entry.values[i];
    for (std::uint64_t place = 1; place < value.places() && value.has_list(); ++place) read_with(i, place);
    if (!value.has_list()) read_with(i, value.places() - 1);
  }
}

world::YamlFields HuntPlan::step_of(const Disturbance& disturbance) const {
  const Entry& entry = entries_[disturbance.entry];
  world::YamlFields step = drawn_step(entry.step, [&](const world::YamlFields&, std::size_t i) {
    return entry.values[i].value_at(disturbance.values[i]);
  });
  if (disturbance.when == When::here || disturbance.when == When::late) return step;
  const std::string key(key_of(disturbance.when, entry.has_end));
  return only_value(step).with_entry(key, text_of_moment(disturbance)).under(std::string(kInject));
}

std::vector<world::YamlFields> HuntPlan::steps_of(const Disturbance& disturbance) const {
  std::vector<world::YamlFields> steps;
  if (disturbance.when == When::late) {
    constexpr SimTime kMore = std::chrono::seconds(1);  // for a wait that begins at that moment
    const SimTime moment(disturbance.moment);
    const std::string text = "{ wait: { until: time >= " + format_duration(moment) +
                             ", within: " + format_duration(moment + kMore) + " } }";
    steps.push_back(world::YamlFields::parse(text, head_.file(), "hunt", "a step"));
  }
  steps.push_back(step_of(disturbance));
  return steps;
}

}  // namespace understudy::emulator::play
