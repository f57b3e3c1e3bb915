// SLIM: the parameters in its command list (part 1 "參數", part 2 parameter table), as data. Assignments,
// queries, range checks, the memory, ULC, `describe` and the documentation use these rows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string_view>

#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/rules/errors.h"
#include "interpreter/slim/command.h"

namespace understudy::emulator::models::slim {

struct ParameterDefinition {
  std::string_view name;
  std::string_view alias;  // a second name in the manual; empty if there is none
  enum class Type : std::uint8_t { integer, real } type = Type::real;
  double lowest = 0;
  double highest = 0;
  bool above_lowest = false;  // the lowest value itself is not allowed
  double factory = 0;
  std::string_view unit;
  bool host_only = false;  // one value for the whole chain, stored in T0
  std::string_view meaning;
  std::string_view not_implemented{};  // if the parameter is only stored: what is missing
};

inline constexpr double kMaxReal = 3.4028234663852886e38;  // float32

/// All parameters, in the order in which ULC lists them.
inline constexpr ParameterDefinition kParameters[] = {
    {"PN10", "VM", ParameterDefinition::Type::real, kMinSpeed, 1e6, false, 1000, "RPM or RPS, by FU", false,
     "working speed"},
    {"PN14", "VJ", ParameterDefinition::Type::real, kMinSpeed, 1e6, false, 100, "RPM or RPS, by FU", false,
     "jog speed"},
    {"FU", "", ParameterDefinition::Type::integer, 0, 1, false, 0, "", false,
     "unit of PN10 and PN14: 0 RPM, 1 RPS"},
    {"VA", "", ParameterDefinition::Type::real, kMinSpeed, kMaxSpeed, false, 10000, "RPM/s or RPS/s, by FU",
     false, "acceleration of single-axis moves; the name is ours, like TVA"},
    {"LL", "", ParameterDefinition::Type::real, 0, 1e6, false, 0, "W", false, "load limit; 0: none",
     "no load is computed"},
    {"EL", "", ParameterDefinition::Type::integer, 0, 2147483647, false, 0, "pulse", false,
     "position error limit; 0: none", "the servo follows without error"},
    {"PN37", "", ParameterDefinition::Type::integer, 0, 65535, false, 0x8888, "", true,
     "module of each axis at power-up, one nibble each for x, y, z and w; 8: none"},
    {"PN44", "", ParameterDefinition::Type::integer, 1, 2147483647, false, 1, "", false,
     "user coordinate unit", "coordinates use PN45 and PN46"},
    {"PN45", "", ParameterDefinition::Type::integer, 1, 2147483647, false, 1, "pulse", false,
     "user coordinate unit: this many pulses ..."},
    {"PN46", "", ParameterDefinition::Type::integer, 1, 2147483647, false, 1, "unit", false,
     "... are this many units"},
    {"PN50", "", ParameterDefinition::Type::integer, 0, 255, false, 1, "", true,
     "linked modules, bit p for Tp; T0 is always linked"},
    {"PR2", "TVA", ParameterDefinition::Type::real, kMinSpeed, kMaxSpeed, false, 1000, "unit/s2", false,
     "resultant acceleration of coordinated motion"},
    {"PR3", "TVM", ParameterDefinition::Type::real, kMinSpeed, kMaxSpeed, false, 100, "unit/s", false,
     "resultant speed of coordinated motion"},
    {"PR4", "", ParameterDefinition::Type::real, kMinSpeed, kMaxSpeed, false, 100, "unit/s", false,
     "PR3 by another name, or, if so chosen, the speed of 2MA and 2MR"},
    {"PR7", "CMA", ParameterDefinition::Type::real, 0, 180, false, 0, "degree", false,
     "largest angle that CM 2 joins"},
    {"SYN", "", ParameterDefinition::Type::integer, 0, 7, false, 0, "", false,
     "master of linked axes, on older models", "arcs need no master"},
};
inline constexpr std::size_t kParameterCount = std::size(kParameters);

/// The values of one module. A double holds an integer exactly.
using Parameters = std::array<double, kParameterCount>;

/// Returns the number of a row. An unknown name is a compile error.
consteval std::size_t parameter(std::string_view name) {
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    if (kParameters[i].name == name || (!kParameters[i].alias.empty() && kParameters[i].alias == name))
      return i;
  }
  throw "no such parameter";
}

/// Which of PN10 and PN14 is VM. The manual only states that both are speeds. Rows are ordered by meaning:
/// with `pn14_is_vm`, the first row is called PN14.
enum class SpeedNames : std::uint8_t { pn10_is_vm, pn14_is_vm };

/// Converts a position in a list to the row with the name at that position, and a row to its position.
constexpr std::size_t listed_at(std::size_t place, SpeedNames names) {
  static_assert(parameter("PN10") == 0 && parameter("PN14") == 1);
  return names == SpeedNames::pn14_is_vm && place < 2 ? 1 - place : place;
}
constexpr std::string_view name_of(std::size_t number, SpeedNames names) {
  return kParameters[listed_at(number, names)].name;
}

/// Finds a row by its name or alias, which must be in capitals.
constexpr std::optional<std::size_t> find_parameter(std::string_view name, SpeedNames names) {
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    const std::string_view alias = kParameters[i].alias;
    if (name_of(i, names) == name || (!alias.empty() && alias == name)) return i;
  }
  return std::nullopt;
}

constexpr Parameters factory_parameters() {
  Parameters all{};
  for (std::size_t i = 0; i < kParameterCount; ++i) all[i] = kParameters[i].factory;
  return all;
}

/// Returns the value as the parameter stores it: reals are rounded to 32 bits. Returns nothing if it is out
/// of range.
std::optional<double> fitted(const ParameterDefinition& row, double value);

/// The limit of TM, which is set in the same way as a parameter.
inline constexpr double kMaxClock_s = 1e9;

/// Returns why an assignment is refused in any state of the chain: the parameter is unknown (syntax), or it
/// cannot have this value. Without a value, only the name is checked. In an axis map, a module may occur
/// twice only if the last letter receives the module.
Error check_parameter(int module, std::string_view name, std::optional<double> value, SpeedNames names,
                      bool module_taken_from_letter);
/// Like check_parameter(), but for a program line, whose value may be a variable. All other lines are
/// accepted.
Error check_parameter_line(const interpreter::slim::Command& command, bool module_taken_from_letter);

}  // namespace understudy::emulator::models::slim
