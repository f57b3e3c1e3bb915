// Numbers the cases of a scenario: each row of `cases`, or each option of a `choice`, combined with all
// values of `vary`. The cases are never listed, so their number is not limited.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/play/reading/variation.h"
#include "emulator/play/scenario/case.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::play {

/// The parameter that contains the option of a `choice`.
inline constexpr std::string_view kOptionParameter = "option";

class CaseTable {
 public:
  /// Reads the cases. `seed` replaces the file's own seed, including that for drawn values. Throws FileError.
  CaseTable(const world::YamlFields& root, std::optional<std::uint64_t> seed);

  /// Returns 1 for a file with neither `cases` nor `vary`.
  std::uint64_t size() const { return size_; }
  bool is_varied() const { return !variations_.empty(); }
  /// Returns the choice whose options are the cases, or an empty text. In that case, the first value of each
  /// case is its option.
  const std::string& choice() const { return choice_; }
  /// Returns a case by its number. The last entry of `vary` changes fastest, and the row changes slowest.
  Case at(std::uint64_t number) const;
  /// Returns the place of that parameter's value for that case in the file, for diagnostics.
  world::YamlFields field_of(std::uint64_t number, const std::string& name) const;
  /// Returns the place of the whole case in the file.
  world::YamlFields place_of(std::uint64_t number) const;

  /// Returns cases that together contain each row, each listed value, and, for each range, both ends and some
  /// intermediate values. If there are few cases, returns all of them; if there are many, returns hardly more
  /// than necessary.
  std::vector<std::uint64_t> typical() const;

 private:
  struct Row {
    world::YamlFields where;
    std::vector<std::pair<std::string, std::string>> values;
  };
  void read_rows(const world::YamlFields& root);
  void read_options(const world::YamlFields& root);
  std::vector<std::string> common_parameters(const world::YamlFields& root) const;
  void add_values(const world::YamlFields& row, std::vector<std::string>& known);
  void read_variations(const world::YamlFields& root, std::optional<std::uint64_t> seed);
  std::uint64_t row_of(std::uint64_t number) const;

  world::YamlFields root_;
  std::string choice_;
  std::vector<Row> rows_;
  std::vector<Variation> variations_;
  std::uint64_t size_ = 1;
};

}  // namespace understudy::emulator::play
