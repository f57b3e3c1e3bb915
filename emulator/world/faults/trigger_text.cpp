#include "emulator/world/faults/trigger_text.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/world/faults/field_values.h"
#include "emulator/world/faults/trigger.h"
#include "emulator/world/names/names.h"

namespace understudy::emulator::world {

namespace {

constexpr std::int64_t kMany = 1'000'000'000'000;

struct NumberRow {
  std::string_view name;
  std::int64_t FaultTrigger::*field;
  std::int64_t lowest = 0;  // smaller values mean that the field is not set
  std::int64_t highest = 0;
};
constexpr std::array<NumberRow, 5> kNumbers{{
    {"function", &FaultTrigger::function, 0, 255},
    {"station", &FaultTrigger::station, 0, 247},
    {"every", &FaultTrigger::every, 1, kMany},
    {"times", &FaultTrigger::times, 1, kMany},
    {"seed", &FaultTrigger::seed, 0, INT64_MAX},
}};

struct TimeRow {
  std::string_view name;
  SimTime FaultTrigger::*field;
  SimTime shortest;
  SimTime unset;
};
constexpr std::array<TimeRow, 4> kTimes{{
    {"at", &FaultTrigger::at, SimTime{0}, SimTime{-1}},
    {"from", &FaultTrigger::from, SimTime{0}, SimTime{0}},
    {"to", &FaultTrigger::to, SimTime{1}, kForever},
    {"for", &FaultTrigger::lasts, SimTime{1}, SimTime{0}},
}};

constexpr std::size_t kLongestCondition = 2000;  // the limit of expressions

std::string hexadecimal(std::int64_t address) {
  return "0x" + hex_text({static_cast<std::uint8_t>(address >> 8), static_cast<std::uint8_t>(address)});
}

}  // namespace

std::vector<std::string> trigger_fields() {
  std::vector<std::string> names{"nth", "address", "when", "chance"};
  for (const NumberRow& row : kNumbers) names.emplace_back(row.name);
  for (const TimeRow& row : kTimes) names.emplace_back(row.name);
  return names;
}

bool set_trigger_field(FaultTrigger& trigger, std::string_view name, const std::string& text) {
  for (const NumberRow& row : kNumbers) {
    if (row.name != name) continue;
    trigger.*row.field = field_number(name, text, row.lowest, row.highest);
    return true;
  }
  for (const TimeRow& row : kTimes) {
    if (row.name != name) continue;
    trigger.*row.field = field_duration(name, text, row.shortest);
    return true;
  }
  if (name == "address") {
    std::tie(trigger.first_address, trigger.last_address) = field_span(name, text, 0, 0xFFFF);
  } else if (name == "nth") {
    std::tie(trigger.first_nth, trigger.last_nth) = field_span(name, text, 1, kMany);
    if (text.ends_with("..")) trigger.last_nth = kNever;
  } else if (name == "chance") {
    trigger.chance = field_chance(name, text);
  } else if (name == "when") {
    if (text.empty() || text.size() > kLongestCondition) {
      throw NameError("when: " + quoted(text) + " is not valid; expected a condition of at most " +
                      std::to_string(kLongestCondition) + " bytes");
    }
    trigger.when = text;
  } else {
    return false;
  }
  return true;
}

void validate_trigger(const FaultTrigger& trigger) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw NameError(what);
  };
  const bool is_moment = trigger.at >= SimTime{0};
  const bool has_span = trigger.from > SimTime{0} || trigger.to != kForever;
  require(!is_moment || !has_span, "at: cannot be combined with from and to; expected one or the other");
  require(!is_moment || trigger.times == 0, "at: happens only once; expected it without times");
  require(trigger.from < trigger.to, "to: is not after from; expected a later time");
  require(trigger.seed < 0 || trigger.chance != 0, "seed: has no effect without chance; expected both");
}

std::vector<std::pair<std::string, std::string>> fields_of(const FaultTrigger& trigger) {
  std::vector<std::pair<std::string, std::string>> fields;
  for (const NumberRow& row : kNumbers) {
    const std::int64_t number = trigger.*row.field;
    if (number >= row.lowest) fields.emplace_back(row.name, std::to_string(number));
  }
  for (const TimeRow& row : kTimes) {
    if (trigger.*row.field != row.unset) fields.emplace_back(row.name, format_duration(trigger.*row.field));
  }
  if (trigger.first_address >= 0) {
    std::string text = hexadecimal(trigger.first_address);
    if (trigger.last_address != trigger.first_address) text += ".." + hexadecimal(trigger.last_address);
    fields.emplace_back("address", text);
  }
  if (trigger.first_nth != 1 || trigger.last_nth != kNever) {
    std::string text = std::to_string(trigger.first_nth);
    if (trigger.last_nth != trigger.first_nth) text += "..";
    if (trigger.last_nth != trigger.first_nth && trigger.last_nth != kNever)
      text += std::to_string(trigger.last_nth);
    fields.emplace_back("nth", text);
  }
  if (!trigger.when.empty()) fields.emplace_back("when", trigger.when);
  if (trigger.chance != 0) fields.emplace_back("chance", chance_text(trigger.chance));
  return fields;
}

}  // namespace understudy::emulator::world
