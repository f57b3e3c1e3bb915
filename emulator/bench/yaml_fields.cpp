#include "emulator/bench/yaml_fields.h"

#include <algorithm>
#include <set>

#include "emulator/bench/bench_file.h"
#include "emulator/parse_integer.h"
#include "emulator/register_map/register_map.h"

namespace understudy::emulator {

void YamlFields::fail(const std::string& what) const {
  throw BenchError(file_ + ":" + std::to_string(node_.Mark().line + 1) + ": " + field_ + ": " + what);
}

void YamlFields::demand_map(std::initializer_list<std::string_view> known) const {
  if (!node_.IsMap()) fail("expected a map, as in `key: value`");
  std::vector<std::string> names(known.begin(), known.end());
  std::set<std::string> seen;
  for (const auto& [key, value] : entries()) {
    if (!seen.insert(key).second) value.fail("is given twice; expected it once");
    if (names.empty() || std::find(names.begin(), names.end(), key) != names.end()) continue;
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    value.fail("is no key here; expected one of " + list + " (the nearest is '" + nearest_word(key, names) +
               "')");
  }
}

bool YamlFields::has(std::string_view key) const {
  const YAML::Node& node = node_;
  return node.IsMap() && static_cast<bool>(node[std::string(key)]);
}

YamlFields YamlFields::at(std::string_view key) const {
  const YAML::Node& node = node_;
  if (!node.IsMap()) fail("expected a map, as in `key: value`");
  const YAML::Node value = node[std::string(key)];
  if (!value) fail("'" + std::string(key) + "' is missing; expected it here");
  return {file_, value, field_ == "bench" ? std::string(key) : field_ + "." + std::string(key)};
}

std::vector<std::pair<std::string, YamlFields>> YamlFields::entries() const {
  std::vector<std::pair<std::string, YamlFields>> all;
  if (!node_.IsMap()) fail("expected a map, as in `key: value`");
  for (const auto& entry : node_) {
    if (!entry.first.IsScalar()) fail("a key is not a word; expected `key: value`");
    const std::string key = entry.first.Scalar();
    all.emplace_back(key, YamlFields(file_, entry.second, field_ == "bench" ? key : field_ + "." + key));
  }
  return all;
}

std::vector<YamlFields> YamlFields::elements() const {
  if (!node_.IsSequence()) fail("expected a list, as in `[ a, b ]`");
  std::vector<YamlFields> all;
  for (std::size_t i = 0; i < node_.size(); ++i) {
    all.emplace_back(file_, node_[i], field_ + "[" + std::to_string(i) + "]");
  }
  return all;
}

std::string YamlFields::text() const {
  if (!node_.IsScalar()) fail("expected a word or a number");
  return node_.Scalar();
}

std::int64_t YamlFields::integer(std::int64_t lowest, std::int64_t highest) const {
  const std::string digits = text();
  const auto value = parse_integer(digits);
  if (!value || *value < lowest || *value > highest) {
    fail("'" + digits + "' is not possible; expected a whole number from " + std::to_string(lowest) + " to " +
         std::to_string(highest));
  }
  return *value;
}

bool YamlFields::on_or_off() const {
  const std::string word = text();
  const bool on = word == "on" || word == "true" || word == "1";
  if (!on && word != "off" && word != "false" && word != "0")
    fail("'" + word + "' is neither; expected on or off");
  return on;
}

Tick YamlFields::ticks() const {
  const auto duration = parse_duration(text());
  if (!duration || *duration < SimTime{0} || *duration % kTickLength != SimTime{0}) {
    fail("'" + text() + "' is no duration of whole milliseconds; expected one such as 120ms");
  }
  return *duration / kTickLength;
}

}  // namespace understudy::emulator
