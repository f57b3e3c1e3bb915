// The cases of a scenario file, by number: each row of `cases` with each combination of the values of
// `vary`. They are never listed, so there may be any number.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/play/reading/variation.h"
#include "emulator/play/scenario/case.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::play {

class CaseTable {
 public:
  /// `seed` replaces the file's own seed, also for drawn values. Throws FileError.
  CaseTable(const world::YamlFields& root, std::optional<std::uint64_t> seed);

  /// Returns 1 for a file with neither `cases` nor `vary`.
  std::uint64_t size() const { return size_; }
  bool is_varied() const { return !variations_.empty(); }
  /// The last entry of `vary` changes fastest, the row slowest.
  Case at(std::uint64_t number) const;
  /// Returns the position in the file of that parameter's value in that case, for messages.
  world::YamlFields field_of(std::uint64_t number, const std::string& name) const;
  /// Returns the position in the file of the case as a whole.
  world::YamlFields place_of(std::uint64_t number) const;

  /// Returns cases that have each row and each listed value at least once, and both ends and some more
  /// values of each range. If there are few cases, these are all.
  std::vector<std::uint64_t> typical() const;

 private:
  struct Row {
    world::YamlFields where;
    std::vector<std::pair<std::string, std::string>> values;
  };
  void read_rows(const world::YamlFields& root);
  void read_variations(const world::YamlFields& root, std::optional<std::uint64_t> seed);
  std::uint64_t row_of(std::uint64_t number) const;

  world::YamlFields root_;
  std::vector<Row> rows_;
  std::vector<Variation> variations_;
  std::uint64_t size_ = 1;
};

}  // namespace understudy::emulator::play
