#include "emulator/world/bench_file/yaml_fields.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/file_error.h"
#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "base/text/suggestion.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/schema.h"
#include "emulator/world/bench_file/yaml_document.h"

namespace understudy::emulator::world {

YamlFields YamlFields::parse(const std::string& text, const std::string& file, const std::string& what,
                             const std::string& expected) {
  const ContentKind kind = content_of(text);
  if (kind < ContentKind::bench) {
    throw FileError({file, 1, 1}, what + ": is " + std::string(name_of(kind)) + "; expected " + expected);
  }
  std::shared_ptr<const YamlNode> document = parse_yaml(text, file, what);
  if (document->kind != YamlNode::Kind::map)
    throw FileError({file, 1, 1}, what + ": the file is not a map; expected " + expected);
  YamlFields root(std::make_shared<const std::string>(file), std::move(document), what);
  root.is_root_ = true;
  return root;
}

YamlFields::YamlFields(std::shared_ptr<const std::string> file, std::shared_ptr<const YamlNode> node,
                       std::string field)
    : file_(std::move(file)), node_(std::move(node)), field_(std::move(field)) {}

YamlFields YamlFields::part(const YamlNode& node, std::string field) const {
  YamlFields part(file_, {node_, &node}, std::move(field));
  part.rule_ = rule_;
  return part;
}

int YamlFields::line() const { return node_->line + 1; }

FilePlace YamlFields::place() const { return {*file_, line(), node_->column + 1}; }

InlineText YamlFields::inline_text() const {
  const bool has_lines = node_->text_line > 0;
  return {.place = place(),
          .field = field_,
          .first_line = has_lines ? node_->text_line + 1 : 0,
          .indentation = node_->text_column};
}

std::string YamlFields::folder() const { return std::filesystem::path(*file_).parent_path().string(); }

void YamlFields::fail(const std::string& what) const { throw FileError(place(), field_ + ": " + what); }

YamlFields YamlFields::with_rule(const ScalarRule* rule) const {
  YamlFields same = *this;
  same.rule_ = rule;
  return same;
}

namespace {

/// Owns the nodes of a joined map, and the documents to which its parts belong.
struct JoinedNodes {
  std::shared_ptr<const YamlNode> own;
  std::shared_ptr<const YamlNode> defaults;
  std::vector<std::unique_ptr<YamlNode>> made{};

  YamlNode& make(const YamlNode& like) {
    YamlNode& node = *made.emplace_back(std::make_unique<YamlNode>());
    node = {.kind = YamlNode::Kind::map, .line = like.line, .column = like.column};
    return node;
  }
};

const YamlNode* value_in(const YamlNode& map, const YamlNode& key) {
  for (std::size_t i = 0; i + 1 < map.parts.size(); i += 2) {
    const YamlNode& name = *map.parts[i];
    if (name.kind == YamlNode::Kind::scalar && name.scalar == key.scalar) return map.parts[i + 1];
  }
  return nullptr;
}

/// The depth is limited because a node may contain an alias of itself.
constexpr int kMaxJoinedDepth = 32;

const YamlNode* joined(const YamlNode& own, const YamlNode& defaults, JoinedNodes& nodes, int depth = 0) {
  const bool both_are_maps = own.kind == YamlNode::Kind::map && defaults.kind == YamlNode::Kind::map;
  if (!both_are_maps || depth > kMaxJoinedDepth) return &own;
  YamlNode& node = nodes.make(own);
  for (std::size_t i = 0; i + 1 < defaults.parts.size(); i += 2) {
    const YamlNode* const mine = value_in(own, *defaults.parts[i]);
    const YamlNode& value = *defaults.parts[i + 1];
    node.parts.push_back(defaults.parts[i]);
    node.parts.push_back(mine == nullptr ? &value : joined(*mine, value, nodes, depth + 1));
  }
  for (std::size_t i = 0; i + 1 < own.parts.size(); i += 2) {
    if (value_in(defaults, *own.parts[i]) != nullptr) continue;
    node.parts.insert(node.parts.end(), {own.parts[i], own.parts[i + 1]});
  }
  return &node;
}

}  // namespace

YamlFields YamlFields::with_defaults(const YamlFields& defaults) const {
  auto nodes = std::make_shared<JoinedNodes>(JoinedNodes{.own = node_, .defaults = defaults.node_});
  const YamlNode* const node = joined(*node_, *defaults.node_, *nodes);
  YamlFields both = *this;
  both.node_ = {std::move(nodes), node};
  return both;
}

YamlFields YamlFields::without(std::span<const std::string_view> keys) const {
  auto nodes = std::make_shared<JoinedNodes>(JoinedNodes{.own = node_, .defaults = nullptr});
  YamlNode& node = nodes->make(*node_);
  for (std::size_t i = 0; i + 1 < node_->parts.size(); i += 2) {
    if (std::find(keys.begin(), keys.end(), node_->parts[i]->scalar) != keys.end()) continue;
    node.parts.insert(node.parts.end(), {node_->parts[i], node_->parts[i + 1]});
  }
  YamlFields rest = *this;
  rest.node_ = {std::move(nodes), &node};
  return rest;
}

YamlFields YamlFields::settled(
    const std::function<std::optional<std::string>(const YamlFields&)>& text_of) const {
  auto nodes = std::make_shared<JoinedNodes>(JoinedNodes{.own = node_, .defaults = nullptr});
  const std::function<const YamlNode*(const YamlFields&, int)> copy = [&](const YamlFields& from,
                                                                          int depth) -> const YamlNode* {
    if (depth > kMaxJoinedDepth) from.fail("is nested too deeply; expected fewer levels");
    YamlNode& node = nodes->make(*from.node_);
    node.kind = from.node_->kind;
    if (const auto text = text_of ? text_of(from) : std::nullopt) {
      node.kind = YamlNode::Kind::scalar;
      node.scalar = *text;
    } else if (from.is_scalar()) {
      node.scalar = from.read_scalar(*from.node_);
      node.text_line = from.node_->text_line;
      node.text_column = from.node_->text_column;
    } else if (from.is_list()) {
      for (const YamlFields& element : from.elements()) node.parts.push_back(copy(element, depth + 1));
    } else if (from.is_map()) {
      for (std::size_t i = 0; i + 1 < from.node_->parts.size(); i += 2) {
        YamlNode& key = nodes->make(*from.node_->parts[i]);
        key.kind = YamlNode::Kind::scalar;
        key.scalar = from.part(*from.node_->parts[i], from.field_).text();
        const YamlFields value = from.part(*from.node_->parts[i + 1], from.field_of(key.scalar));
        node.parts.insert(node.parts.end(), {&key, copy(value, depth + 1)});
      }
    }
    return &node;
  };
  YamlFields same = *this;
  same.node_ = {nodes, copy(*this, 0)};
  same.rule_ = nullptr;
  return same;
}

YamlFields YamlFields::with_entry(const std::string& key, const std::string& text) const {
  auto nodes = std::make_shared<JoinedNodes>(JoinedNodes{.own = node_, .defaults = nullptr});
  YamlNode& node = nodes->make(*node_);
  node.parts = node_->parts;
  for (const std::string& scalar : {key, text}) {
    YamlNode& added = nodes->make(*node_);
    added.kind = YamlNode::Kind::scalar;
    added.scalar = scalar;
    node.parts.push_back(&added);
  }
  YamlFields longer = *this;
  longer.node_ = {std::move(nodes), &node};
  return longer;
}

YamlFields YamlFields::under(const std::string& key) const {
  auto nodes = std::make_shared<JoinedNodes>(JoinedNodes{.own = node_, .defaults = nullptr});
  YamlNode& node = nodes->make(*node_);
  YamlNode& name = nodes->make(*node_);
  name.kind = YamlNode::Kind::scalar;
  name.scalar = key;
  node.parts = {&name, node_.get()};
  YamlFields map = *this;
  map.node_ = {std::move(nodes), &node};
  if (map.field_.ends_with("." + key)) map.field_.resize(map.field_.size() - key.size() - 1);
  return map;
}

bool YamlFields::is_map() const { return node_->kind == YamlNode::Kind::map; }
bool YamlFields::is_list() const { return node_->kind == YamlNode::Kind::list; }
bool YamlFields::is_scalar() const { return node_->kind == YamlNode::Kind::scalar; }

std::string YamlFields::read_scalar(const YamlNode& node) const {
  const std::string& written = node.scalar;
  if (rule_ == nullptr || written.find("${") == std::string::npos) return written;
  try {
    return rule_->apply(written);
  } catch (const FileError&) {
    throw;
  } catch (const std::runtime_error& error) {
    part(node, field_).fail(error.what());
  }
}

template <typename Take>
void YamlFields::for_each_entry(Take take) const {
  if (!is_map()) fail("expected a map, as in `key: value`");
  for (std::size_t i = 0; i + 1 < node_->parts.size(); i += 2) {
    const YamlNode& key = *node_->parts[i];
    if (key.kind != YamlNode::Kind::scalar) fail("a key is not a word; expected `key: value`");
    take(read_scalar(key), *node_->parts[i + 1]);
  }
}

void YamlFields::require_map() const { require_keys_of(nullptr); }

void YamlFields::require_keys(std::span<const Key> known) const { require_keys_of(&known); }

void YamlFields::require_keys_of(const std::span<const Key>* known) const {
  Diagnostics diagnostics;
  std::set<std::string> seen;
  const auto is_known = [&](const std::string& key) {
    return known == nullptr ||
           std::any_of(known->begin(), known->end(), [&](const Key& row) { return row.key == key; });
  };
  diagnostics.require([&] {
    for_each_entry([&](const std::string& key, const YamlNode& value) {
      if (!seen.insert(key).second) {
        diagnostics.attempt(
            [&] { part(value, field_of(key)).fail("is given twice; expected it only once"); });
      } else if (!is_known(key)) {
        diagnostics.attempt([&] { part(value, field_of(key)).refuse_key(key, *known); });
      }
    });
  });
}

void YamlFields::refuse_key(const std::string& key, std::span<const Key> known) const {
  std::vector<std::string> names;
  std::string list;
  for (const Key& row : known) {
    names.emplace_back(row.key);
    list += (list.empty() ? "" : ", ") + names.back();
  }
  const std::string name = key.substr(0, key.find(':'));
  if (name != key && std::find(names.begin(), names.end(), name) != names.end()) {
    fail("has no space after its ':'; expected `" + name + ": " + one_line(key.substr(name.size() + 1)) +
         "`");
  }
  const auto nearest = near_word(key, names);
  fail("is not a key here; expected one of " + list +
       (nearest ? " (the nearest is '" + *nearest + "')" : ""));
}

std::optional<YamlFields> YamlFields::find(std::string_view key) const {
  if (!is_map()) return std::nullopt;
  for (std::size_t i = 0; i + 1 < node_->parts.size(); i += 2) {
    const YamlNode& name = *node_->parts[i];
    if (name.kind == YamlNode::Kind::scalar && read_scalar(name) == key) {
      return part(*node_->parts[i + 1], field_of(std::string(key)));
    }
  }
  return std::nullopt;
}

YamlFields YamlFields::at(std::string_view key) const {
  if (!is_map()) fail("expected a map, as in `key: value`");
  auto value = find(key);
  if (!value) fail(understudy::quoted(key) + " is missing; expected it here");
  return *std::move(value);
}

std::vector<std::pair<std::string, YamlFields>> YamlFields::entries() const {
  std::vector<std::pair<std::string, YamlFields>> all;
  for_each_entry([&](const std::string& key, const YamlNode& value) {
    all.emplace_back(key, part(value, field_of(key)));
  });
  return all;
}

std::vector<YamlFields> YamlFields::elements() const {
  if (!is_list()) fail("expected a list, as in `[ a, b ]`");
  std::vector<YamlFields> all;
  for (std::size_t i = 0; i < node_->parts.size(); ++i) {
    all.push_back(part(*node_->parts[i], field_ + "[" + std::to_string(i) + "]"));
  }
  return all;
}

std::string YamlFields::text() const {
  const bool is_glued = node_->kind == YamlNode::Kind::nothing && field_.find(':') != std::string::npos;
  if (is_glued) fail("has no space after its ':'; expected `key: value`");
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
    const std::string range =
        "a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest);
    fail(understudy::quoted(digits) + " is not valid; expected " +
         (lowest == highest ? std::to_string(lowest) : range));
  }
  return *value;
}

bool YamlFields::on_or_off() const {
  const std::string word = text();
  const bool on = word == "on" || word == "true" || word == "1";
  if (!on && word != "off" && word != "false" && word != "0")
    fail(understudy::quoted(word) + " is neither on nor off; expected on or off");
  return on;
}

SimTime YamlFields::duration() const {
  const std::string written = text();
  const auto duration = parse_duration(written);
  if (!duration) fail(understudy::quoted(written) + " is not a duration; expected one such as 250ms");
  return *duration;
}

Tick YamlFields::ticks() const {
  const std::string written = text();
  const auto duration = parse_duration(written);
  if (!duration || *duration % kTickLength != SimTime{0}) {
    fail(understudy::quoted(written) +
         " is not a duration of whole milliseconds; expected one such as 120ms");
  }
  return *duration / kTickLength;
}

}  // namespace understudy::emulator::world
