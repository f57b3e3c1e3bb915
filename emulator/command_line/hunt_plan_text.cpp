#include "emulator/command_line/hunt_plan_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/hunt/course.h"
#include "emulator/play/reading/hunt_plan.h"
#include "emulator/play/reading/variation.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::command_line {

namespace {

using Json = nlohmann::ordered_json;
using When = play::Disturbance::When;

constexpr std::uint64_t kMaxValues = 1000;  // the most listed values of a range

/// Converts a step to JSON, and counts its drawn values.
Json json_of(const world::YamlFields& node, std::size_t& drawn) {
  if (node.is_map() && (node.has("between") || node.has("one_of"))) return {{"drawn", drawn++}};
  if (node.is_map()) {
    Json object = Json::object();
    for (const auto& [key, value] : node.entries()) object[key] = json_of(value, drawn);
    return object;
  }
  if (node.is_list()) {
    Json list = Json::array();
    for (const world::YamlFields& element : node.elements()) list.push_back(json_of(element, drawn));
    return list;
  }
  return node.text();
}

Json values_of(const play::Variation& variation) {
  Json values = Json::array();
  const std::uint64_t last = variation.places() - 1;
  const std::uint64_t count = variation.has_list() ? last + 1 : std::min(kMaxValues, last + 1);
  for (std::uint64_t i = 0; i < count; ++i) {
    // The product may overflow; the quotient and the remainder do not.
    const std::uint64_t gaps = std::max<std::uint64_t>(count - 1, 1);
    values.push_back(variation.value_at(last / gaps * i + last % gaps * i / gaps));
  }
  return values;
}

/// Returns the word for a moment: the key of a fault's trigger, or "here" for a step.
std::string_view word_of(When when, bool has_end) {
  switch (when) {
    case When::at: return has_end ? "at" : "from";
    case When::nth: return "nth";
    default: return "here";
  }
}

}  // namespace

std::string plan_text(const play::HuntPlan& plan, const hunt::Undisturbed& undisturbed) {
  Json may = Json::array();
  for (const play::HuntPlan::Entry& entry : plan.entries()) {
    std::size_t drawn = 0;
    Json one{{"step", json_of(entry.step, drawn)}, {"values", Json::array()}, {"times", entry.max}};
    for (const play::Variation& variation : entry.values) one["values"].push_back(values_of(variation));
    one["moments"] = Json::array();
    const bool is_gathered = entry.within.count() >= 0;  // such a fault has a time
    for (const When when : is_gathered ? std::vector{When::at} : entry.ways)
      one["moments"].push_back(word_of(when, entry.has_end));
    const hunt::Window window = hunt::window_of(entry, undisturbed);
    one["from_ns"] = window.low.count();
    one["to_ns"] = window.high.count();
    if (is_gathered) one["within_ns"] = entry.within.count();
    may.push_back(std::move(one));
  }
  return Json{{"requests", undisturbed.requests}, {"may", std::move(may)}}.dump() + "\n";
}

}  // namespace understudy::emulator::command_line
