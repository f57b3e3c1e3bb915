// Reading YAML with errors that name file, line and field. Only bench_file.cpp and its like include this:
// yaml-cpp is slow to compile.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/simulated_time.h"

namespace understudy::emulator {

/// Where in which file a node stands, and how to complain about it.
class YamlFields {
 public:
  YamlFields(std::string file, const YAML::Node& node, std::string field)
      : file_(std::move(file)), node_(node), field_(std::move(field)) {}

  const YAML::Node& node() const { return node_; }
  const std::string& field() const { return field_; }

  /// Throws BenchError "file:line: field: what".
  [[noreturn]] void fail(const std::string& what) const;

  /// Demands a map without duplicate keys, and whose keys are all `known` (any, if that is empty).
  void demand_map(std::initializer_list<std::string_view> known) const;
  bool has(std::string_view key) const;
  /// The value of a key; fails if it is missing.
  YamlFields at(std::string_view key) const;
  /// All keys with their values, in the order written.
  std::vector<std::pair<std::string, YamlFields>> entries() const;
  /// The elements of a list.
  std::vector<YamlFields> elements() const;

  std::string text() const;
  std::int64_t integer(std::int64_t lowest, std::int64_t highest) const;
  /// "on", "off" (and true, false, 1, 0).
  bool on_or_off() const;
  /// A duration of whole milliseconds, "120ms".
  Tick ticks() const;

 private:
  std::string file_;
  YAML::Node node_;
  std::string field_;
};

}  // namespace understudy::emulator
