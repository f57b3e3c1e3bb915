// An entry of `vary`, which assigns values to a parameter: listed values, a range, or drawn values. Values
// are computed from their index, so a million values need no more memory than one.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/play/reading/amounts.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::play {

/// Returns the element with index `number` in a permutation of 0 to count-1 that depends only on the seed.
/// This needs no memory.
std::uint64_t shuffled(std::uint64_t number, std::uint64_t count, std::uint64_t seed);

class Variation {
 public:
  /// `seed` is used for drawn values if the entry has no seed, or if `overrides` is true. Throws
  /// FileError.
  Variation(const world::YamlFields& field, std::string name, std::uint64_t seed, bool overrides);

  const std::string& name() const { return name_; }
  const world::YamlFields& field() const { return field_; }
  /// Returns how many values are combined with those of other parameters.
  std::uint64_t count() const { return count_; }
  std::string value(std::uint64_t number) const;
  /// Returns true if it has a list of values rather than a range.
  bool has_list() const { return !listed_.empty(); }
  /// Return how many values a range or a list contains, and the value at a place in it.
  std::uint64_t places() const { return places_; }
  std::string value_at(std::uint64_t place) const;
  /// Returns true if the entry is not combined: for each case, one value is drawn, which is determined by a
  /// hash of the other values in the case.
  bool is_free() const { return is_free_; }
  std::string drawn_for(std::uint64_t hash) const;
  /// Returns true if all values are written in the file.
  bool is_listed() const { return !listed_.empty() && !is_drawn_; }

 private:
  void read_range(bool is_drawn);
  void read_samples(std::uint64_t seed, bool overrides);
  void read_list(const world::YamlFields& list);

  std::string name_;
  world::YamlFields field_;
  std::vector<std::string> listed_;          // the list; empty if it is a range
  AmountScale scale_{Amount::Kind::number};  // of a range, which begins at first_ and has steps of step_
  std::int64_t first_ = 0;
  std::int64_t step_ = 1;
  std::uint64_t places_ = 0;  // how many values can be chosen
  std::uint64_t count_ = 0;
  bool is_drawn_ = false;
  bool is_free_ = false;
  std::uint64_t seed_ = 0;
};

}  // namespace understudy::emulator::play
