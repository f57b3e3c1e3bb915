// Decides which commands are allowed where: stored in a program, typed while no program runs, or from outside
// while one runs. The manual prints three columns without an explanation, and only for its second list.
#pragma once

#include <cstdint>

#include "interpreter/slim/command.h"

namespace understudy::interpreter::slim {

enum class Place : std::uint8_t {
  program,    // 程式
  immediate,  // 立即: typed while no program runs
  external,   // 外部: typed while a program runs
};

/// Options about the columns that the manual leaves open.
struct Columns {
  /// While a program runs, the host may send the printed commands, queries, and the commands that end a pause
  /// (lenient); only the printed commands (strict); or RESET as well (with_reset).
  enum class External : std::uint8_t { lenient, strict, with_reset } external = External::lenient;
  /// Moves from variables can only be stored, as the column 立即 prints, or also typed.
  enum class VariableForms : std::uint8_t {
    as_printed,
    typed_too
  } variable_forms = VariableForms::as_printed;

  /// SAVE C, SAVE D, SAVE P and DF can only be typed, or also stored; their list has no columns.
  enum class Saves : std::uint8_t { typed_only, stored_too } saves = Saves::typed_only;

  bool operator==(const Columns&) const = default;
};

bool is_allowed(const Command& command, Place place, const Columns& columns = {});

}  // namespace understudy::interpreter::slim
