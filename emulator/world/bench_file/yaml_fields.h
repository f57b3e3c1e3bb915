// Reading YAML with errors that name file, line and field. yaml-cpp itself is behind it: that is slow to
// compile.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/file_error.h"
#include "base/simulated_time.h"
#include "emulator/world/bench_file/form.h"

namespace understudy::emulator::world {

struct YamlNode;  // yaml_document.h

/// What is done to every scalar, keys included, before it is read.
class ScalarRule {
 public:
  virtual ~ScalarRule() = default;
  /// Called only for texts with `${` in them: all others stay as they are. Throws a std::runtime_error of one
  /// line for a text it cannot take.
  virtual std::string apply(const std::string& written) const = 0;
};

/// Where a node is in its file, and how to complain about it. All that can fail throws FileError
/// "file:line:column: field: what".
class YamlFields {
 public:
  /// The one document of a text; a map. Messages call it `what`; for an empty file they say what was
  /// `expected`.
  static YamlFields parse(const std::string& text, const std::string& file, const std::string& what,
                          const std::string& expected);

  const std::string& file() const { return *file_; }
  const std::string& field() const { return field_; }
  int line() const;
  FilePlace place() const;
  /// The folder that paths in it are relative to.
  std::string folder() const;
  [[noreturn]] void fail(const std::string& what) const;

  /// Like this node, but read by another rule, which must outlive it and what is taken from it. Null: as
  /// written.
  YamlFields with_rule(const ScalarRule* rule) const;
  /// This map, and what only `defaults`, another map of the same file, has. Where both have a map for a key
  /// these are joined in the same way; anything else in `defaults` gives way.
  YamlFields with_defaults(const YamlFields& defaults) const;
  /// This map without some of its keys.
  YamlFields without(std::span<const std::string_view> keys) const;

  bool is_map() const;
  bool is_list() const;
  bool is_scalar() const;

  /// Demands a map without duplicate keys. Everything that is wrong is thrown together.
  void demand_map() const;
  /// And whose keys are all `known`.
  void demand_keys(std::span<const KeyRow> known) const;
  /// The value of a key, or nothing; of at(), a failure.
  std::optional<YamlFields> find(std::string_view key) const;
  bool has(std::string_view key) const { return find(key).has_value(); }
  YamlFields at(std::string_view key) const;
  /// All keys with their values, in the order written.
  std::vector<std::pair<std::string, YamlFields>> entries() const;
  /// The elements of a list.
  std::vector<YamlFields> elements() const;

  std::string text() const;
  /// A path in folder(), as it is opened.
  std::string path() const;
  std::int64_t integer(std::int64_t lowest, std::int64_t highest) const;
  std::int64_t integer(const Form& form) const { return integer(form.lowest, form.highest); }
  /// "on", "off" (and true, false, 1, 0).
  bool on_or_off() const;
  /// "120ms".
  SimTime duration() const;
  /// A duration of whole milliseconds.
  Tick ticks() const;

 private:
  YamlFields(std::shared_ptr<const std::string> file, std::shared_ptr<const YamlNode> node,
             std::string field);
  YamlFields part(const YamlNode& node, std::string field) const;
  std::string read_scalar(const YamlNode& node) const;
  /// Of a map: each of its keys, as read, with the value. Calls take(key, value).
  template <typename Take>
  void for_each_entry(Take take) const;
  void demand_keys_of(const std::span<const KeyRow>* known) const;
  [[noreturn]] void refuse_key(const std::string& key, std::span<const KeyRow> known) const;
  std::string field_of(const std::string& key) const { return is_root_ ? key : field_ + "." + key; }

  // Both are shared with everything in it.
  std::shared_ptr<const std::string> file_;
  std::shared_ptr<const YamlNode> node_;
  std::string field_;
  bool is_root_ = false;  // what is in it is called by its key alone
  const ScalarRule* rule_ = nullptr;
};

}  // namespace understudy::emulator::world
