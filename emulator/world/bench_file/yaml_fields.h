// Reads YAML. Its errors include the file, line and field. This header hides yaml-cpp, which is slow to
// compile.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/file_error.h"
#include "base/simulated_time.h"
#include "emulator/world/bench/inline_text.h"
#include "emulator/world/bench_file/schema.h"

namespace understudy::emulator::world {

struct YamlNode;  // yaml_document.h

/// A rule that is applied to every scalar, including keys, before the scalar is read.
class ScalarRule {
 public:
  virtual ~ScalarRule() = default;
  /// Called only for texts that contain `${`. Throws std::runtime_error with a one-line message for a text
  /// that it cannot accept.
  virtual std::string apply(const std::string& written) const = 0;
};

/// A node with its position in the file, for error messages. Everything that can fail throws FileError
/// "file:line:column: field: what".
class YamlFields {
 public:
  /// Returns the single document of a text, which must be a map. Messages call it `what`; the message for an
  /// empty file contains what was `expected`.
  static YamlFields parse(const std::string& text, const std::string& file, const std::string& what,
                          const std::string& expected);

  const std::string& file() const { return *file_; }
  const std::string& field() const { return field_; }
  int line() const;
  FilePlace place() const;
  /// Returns the place of this scalar as a multi-line text.
  InlineText inline_text() const;
  /// Returns the folder to which paths in the file are relative.
  std::string folder() const;
  [[noreturn]] void fail(const std::string& what) const;

  /// Returns this node with a different rule. The rule must outlive the node and all nodes that are derived
  /// from it. Null: scalars are read as written.
  YamlFields with_rule(const ScalarRule* rule) const;
  /// Returns this map with the missing entries added from `defaults`, another map of the same file. If both
  /// have a map for a key, the two maps are joined in the same way; otherwise, this map's value is used.
  YamlFields with_defaults(const YamlFields& defaults) const;
  /// Returns this map without some of its keys.
  YamlFields without(std::span<const std::string_view> keys) const;
  /// Returns a copy to whose scalars the rule has been applied, so that it needs no rule. Parts for which
  /// `text_of` returns a text become scalars with that text.
  YamlFields settled(const std::function<std::optional<std::string>(const YamlFields&)>& text_of = {}) const;
  /// Returns this map with a scalar appended.
  YamlFields with_entry(const std::string& key, const std::string& text) const;
  /// Returns a map that contains only this node.
  YamlFields under(const std::string& key) const;

  bool is_map() const;
  bool is_list() const;
  bool is_scalar() const;

  /// Requires a map without duplicate keys. Throws all errors together.
  void require_map() const;
  /// Also requires that all keys are `known`.
  void require_keys(std::span<const Key> known) const;
  /// find() returns nothing if the key is missing; at() throws.
  std::optional<YamlFields> find(std::string_view key) const;
  bool has(std::string_view key) const { return find(key).has_value(); }
  YamlFields at(std::string_view key) const;
  /// Returns all keys with their values, in the order of the file.
  std::vector<std::pair<std::string, YamlFields>> entries() const;
  /// Returns the elements of a list.
  std::vector<YamlFields> elements() const;

  std::string text() const;
  /// Returns a path that can be opened; a relative path is relative to folder().
  std::string path() const;
  std::int64_t integer(std::int64_t lowest, std::int64_t highest) const;
  std::int64_t integer(const Schema& schema) const { return integer(schema.lowest, schema.highest); }
  /// Reads "on" or "off" (or true, false, 1, 0).
  bool on_or_off() const;
  /// Reads a duration such as "120ms".
  SimTime duration() const;
  /// Reads a duration of whole milliseconds.
  Tick ticks() const;

 private:
  YamlFields(std::shared_ptr<const std::string> file, std::shared_ptr<const YamlNode> node,
             std::string field);
  YamlFields part(const YamlNode& node, std::string field) const;
  std::string read_scalar(const YamlNode& node) const;
  /// Calls take(key, value) for each entry of a map.
  template <typename Take>
  void for_each_entry(Take take) const;
  void require_keys_of(const std::span<const Key>* known) const;
  [[noreturn]] void refuse_key(const std::string& key, std::span<const Key> known) const;
  std::string field_of(const std::string& key) const { return is_root_ ? key : field_ + "." + key; }

  // All nodes of the document share this.
  std::shared_ptr<const std::string> file_;
  std::shared_ptr<const YamlNode> node_;
  std::string field_;
  bool is_root_ = false;  // the field names of its children consist only of their keys
  const ScalarRule* rule_ = nullptr;
};

}  // namespace understudy::emulator::world
