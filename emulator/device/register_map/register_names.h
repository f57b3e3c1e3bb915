// Finds the registers of a model's rows by name. One pattern in a row ("D{}") represents thousands of names,
// so names are computed from patterns and never stored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/register_map/row.h"

namespace understudy::emulator {

/// The parts of a 32-bit register. Halves also have names.
enum class RegisterPart : std::uint8_t { whole, low, high };

class RegisterNames {
 public:
  /// The rows must outlive this object.
  explicit RegisterNames(std::span<const RegisterRow> rows);

  struct Named {
    std::size_t row = 0;  // the index of the row in the rows
    int index = 0;        // the number of the register in its row
    RegisterPart part = RegisterPart::whole;
  };
  std::optional<Named> find(Table table, std::string_view name) const;

  /// Calls `act` for every name, in the order of the rows.
  void for_each(const std::function<void(const Named& named, const std::string& name)>& act) const;
  /// Throws std::logic_error if two registers of a table have the same name. This takes as long as looking up
  /// all names, so use it only for models from users' files, and for tests of our own rows.
  void require_distinct() const;

  /// Returns the name of a row's register according to one of the row's patterns: "MAIN_LINE" + number +
  /// "_CMD".
  static std::string name_of(const RegisterRow& row, int index, std::string_view pattern);

 private:
  /// Patterns are hashed by the beginning of their names: the part before "{}", or the whole name.
  struct Pattern {
    std::uint32_t hash = 0;
    std::uint32_t next = 0;  // the next pattern in the same bucket, counted from 1; 0: none
    std::uint16_t row = 0;
    bool is_alias = false;
    RegisterPart part = RegisterPart::whole;
  };
  std::string_view text_of(const Pattern& pattern) const;
  std::optional<int> index_of(const Pattern& pattern, std::size_t begins_with, std::string_view name) const;
  template <typename Act>
  void for_each_match(Table table, std::string_view name, Act act) const;

  std::span<const RegisterRow> rows_;
  std::vector<Pattern> patterns_;
  std::vector<std::uint32_t> buckets_;  // the number of buckets is a power of two
  std::size_t longest_ = 0;             // the length of the longest beginning
};

/// Returns the meaning of a row's register, in English: "X: jogs in the positive direction while on".
std::string meaning_of(const RegisterRow& row, int index);
/// Returns the manual's heading for the register, or an empty text if the manual has only a section name.
std::string heading_of(const RegisterRow& row, int index);

}  // namespace understudy::emulator
