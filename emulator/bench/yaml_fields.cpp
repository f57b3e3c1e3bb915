#include "emulator/bench/yaml_fields.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "emulator/bench/yaml_document.h"
#include "emulator/one_line.h"
#include "emulator/parse_integer.h"
#include "emulator/register_map/register_map.h"
#include "emulator/suggestion.h"

namespace understudy::emulator {

YamlFields YamlFields::parse(const std::string& text, const std::string& file, const std::string& what,
                             const std::string& expected) {
  const YAML::Node document = parse_yaml(text, file, what);
  if (!document.IsMap())
    throw FileError({file, 1, 1}, what + ": the file is not a map; expected " + expected);
  YamlFields root(file, document, what);
  root.is_root_ = true;
  return root;
}

YamlFields::YamlFields(std::string file, const YAML::Node& node, std::string field)
    : file_(std::move(file)), node_(std::make_shared<const YAML::Node>(node)), field_(std::move(field)) {}

YamlFields::YamlFields(const YamlFields& parent, const YAML::Node& node, const std::string& field)
    : YamlFields(parent.file_, node, field) {
  rule_ = parent.rule_;
}

int YamlFields::line() const { return node_->Mark().line + 1; }

FilePlace YamlFields::place() const { return {file_, line(), node_->Mark().column + 1}; }

std::string YamlFields::folder() const { return std::filesystem::path(file_).parent_path().string(); }

void YamlFields::fail(const std::string& what) const { throw FileError(place(), field_ + ": " + what); }

YamlFields YamlFields::with_rule(const ScalarRule* rule) const {
  YamlFields same = *this;
  same.rule_ = rule;
  return same;
}

bool YamlFields::is_map() const { return node_->IsMap(); }
bool YamlFields::is_list() const { return node_->IsSequence(); }
bool YamlFields::is_scalar() const { return node_->IsScalar(); }

std::string YamlFields::read_scalar(const YAML::Node& node) const {
  const std::string& written = node.Scalar();
  if (rule_ == nullptr) return written;
  try {
    return rule_->apply(written);
  } catch (const FileError&) {
    throw;
  } catch (const std::runtime_error& error) {
    YamlFields(*this, node, field_).fail(error.what());
  }
}

void YamlFields::demand_map() const {
  std::set<std::string> seen;
  for (const auto& [key, value] : entries()) {
    if (!seen.insert(key).second) value.fail("is given twice; expected it once");
  }
}

void YamlFields::demand_keys(std::span<const KeyRow> known) const {
  demand_map();
  for (const auto& [key, value] : entries()) {
    const auto is_it = [&key = key](const KeyRow& row) { return row.key == key; };
    if (std::any_of(known.begin(), known.end(), is_it)) continue;
    std::vector<std::string> names;
    std::string list;
    for (const KeyRow& row : known) {
      names.emplace_back(row.key);
      list += (list.empty() ? "" : ", ") + names.back();
    }
    const auto nearest = near_word(key, names);
    value.fail("is no key here; expected one of " + list +
               (nearest ? " (the nearest is '" + *nearest + "')" : ""));
  }
}

std::optional<YamlFields> YamlFields::find(std::string_view key) const {
  if (!is_map()) return std::nullopt;
  for (const auto& entry : *node_) {
    if (entry.first.IsScalar() && read_scalar(entry.first) == key) {
      return YamlFields(*this, entry.second, field_of(std::string(key)));
    }
  }
  return std::nullopt;
}

YamlFields YamlFields::at(std::string_view key) const {
  if (!is_map()) fail("expected a map, as in `key: value`");
  auto value = find(key);
  if (!value) fail(emulator::quoted(key) + " is missing; expected it here");
  return *std::move(value);
}

std::vector<std::pair<std::string, YamlFields>> YamlFields::entries() const {
  std::vector<std::pair<std::string, YamlFields>> all;
  if (!is_map()) fail("expected a map, as in `key: value`");
  for (const auto& entry : *node_) {
    if (!entry.first.IsScalar()) fail("a key is not a word; expected `key: value`");
    const std::string key = read_scalar(entry.first);
    all.emplace_back(key, YamlFields(*this, entry.second, field_of(key)));
  }
  return all;
}

std::vector<YamlFields> YamlFields::elements() const {
  if (!is_list()) fail("expected a list, as in `[ a, b ]`");
  std::vector<YamlFields> all;
  for (std::size_t i = 0; i < node_->size(); ++i) {
    all.push_back(YamlFields(*this, (*node_)[i], field_ + "[" + std::to_string(i) + "]"));
  }
  return all;
}

std::string YamlFields::text() const {
  if (!is_scalar()) fail("expected a word or a number");
  return read_scalar(*node_);
}

std::string YamlFields::path() const {
  const std::string written = text();
  if (written.empty()) fail("is empty; expected a path");
  return (std::filesystem::path(folder()) / written).lexically_normal().string();
}

std::int64_t YamlFields::integer(std::int64_t lowest, std::int64_t highest) const {
  const std::string digits = text();
  const auto value = parse_integer(digits);
  if (!value || *value < lowest || *value > highest) {
    fail(emulator::quoted(digits) + " is not possible; expected a whole number from " +
         std::to_string(lowest) + " to " + std::to_string(highest));
  }
  return *value;
}

bool YamlFields::on_or_off() const {
  const std::string word = text();
  const bool on = word == "on" || word == "true" || word == "1";
  if (!on && word != "off" && word != "false" && word != "0")
    fail(emulator::quoted(word) + " is neither; expected on or off");
  return on;
}

SimTime YamlFields::duration() const {
  const std::string written = text();
  const auto duration = parse_duration(written);
  if (!duration) fail(emulator::quoted(written) + " is no duration; expected one such as 250ms");
  return *duration;
}

Tick YamlFields::ticks() const {
  const std::string written = text();
  const auto duration = parse_duration(written);
  if (!duration || *duration % kTickLength != SimTime{0}) {
    fail(emulator::quoted(written) + " is no duration of whole milliseconds; expected one such as 120ms");
  }
  return *duration / kTickLength;
}

}  // namespace understudy::emulator
