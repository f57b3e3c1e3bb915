// What one entry of `vary` makes of a parameter: listed values, a range, or values that are drawn. Asked by
// number, so that a million values take no more room than one.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/play/reading/amounts.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::play {

/// The number-th of 0 to count-1 in an order that depends on the seed alone: each comes once, and nothing is
/// held.
std::uint64_t shuffled(std::uint64_t number, std::uint64_t count, std::uint64_t seed);

class Variation {
 public:
  /// `seed`: for values that are drawn, where the entry has none of its own, or `overrides` that. Throws
  /// FileError.
  Variation(const world::YamlFields& field, std::string name, std::uint64_t seed, bool overrides);

  const std::string& name() const { return name_; }
  const world::YamlFields& field() const { return field_; }
  /// How many values are multiplied with those of other parameters.
  std::uint64_t count() const { return count_; }
  std::string value(std::uint64_t number) const;
  /// It multiplies nothing: one value is drawn for each case, by a hash of the case's other values.
  bool is_free() const { return is_free_; }
  std::string drawn_for(std::uint64_t hash) const;
  /// Somebody has written each of them down.
  bool is_listed() const { return !listed_.empty() && !is_drawn_; }

 private:
  void read_range(bool is_drawn);
  void read_samples(std::uint64_t seed, bool overrides);
  void read_list(const world::YamlFields& list);
  std::string value_at(std::uint64_t place) const;

  std::string name_;
  world::YamlFields field_;
  std::vector<std::string> listed_;          // or
  AmountScale scale_{Amount::Kind::number};  // from first_ on, in steps of step_
  std::int64_t first_ = 0;
  std::int64_t step_ = 1;
  std::uint64_t places_ = 0;  // how many values there are to choose from
  std::uint64_t count_ = 0;
  bool is_drawn_ = false;
  bool is_free_ = false;
  std::uint64_t seed_ = 0;
};

}  // namespace understudy::emulator::play
