#include "emulator/models/slim/parameters.h"

#include <cmath>
#include <optional>
#include <string_view>

#include "emulator/models/slim/rules/errors.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/parse.h"
#include "interpreter/slim/verbs.h"

namespace understudy::emulator::models::slim {

std::optional<double> fitted(const ParameterDefinition& row, double value) {
  if (!std::isfinite(value)) return std::nullopt;
  if (row.type == ParameterDefinition::Type::integer) {
    if (value != std::floor(value)) return std::nullopt;
  } else {
    if (std::abs(value) > kMaxReal) return std::nullopt;
    value = static_cast<float>(value);
  }
  if (value < row.lowest || value > row.highest || (row.above_lowest && value == row.lowest))
    return std::nullopt;
  return value;
}

namespace {

/// Returns true for a value of PN37: four nibbles, each 0 to 5 or 8.
bool is_axis_map(int map, bool may_repeat) {
  unsigned seen = 0;
  for (int shift = 0; shift < 16; shift += 4) {
    const int module = (map >> shift) & 0xF;
    constexpr int kMappableModules = 6;
    constexpr int kNone = 8;
    if (module == kNone) continue;
    if (module >= kMappableModules || (!may_repeat && (seen >> module & 1) != 0)) return false;
    seen |= 1U << module;
  }
  return true;
}

}  // namespace

Error check_parameter(int module, std::string_view name, std::optional<double> value, SpeedNames names,
                      bool module_taken_from_letter) {
  if (name == "TM") {
    const bool fits = !value || (*value >= 0 && *value <= kMaxClock_s);
    return fits ? Error::none : Error::range;
  }
  const auto number = find_parameter(name, names);
  if (!number) return Error::syntax;
  const ParameterDefinition& row = kParameters[*number];
  if (row.host_only && module > 0) return Error::syntax;
  if (!value) return Error::none;
  const auto fits = fitted(row, *value);
  if (!fits) return Error::range;
  const bool is_map = *number == parameter("PN37");
  return is_map && !is_axis_map(static_cast<int>(*fits), module_taken_from_letter) ? Error::range
                                                                                   : Error::none;
}

namespace {

using interpreter::slim::Operand;
using interpreter::slim::Verb;

constexpr Verb kAnsweredInWords[] = {Verb::query_version, Verb::query_error_history, Verb::query_time};

/// Returns true if the function shows the value of an existing query that returns a number.
bool is_quantity(const Operand& operand) {
  const auto parsed = interpreter::slim::parse_line("?" + operand.text);
  if (parsed.error != Error::none || !parsed.line.command) return false;
  const interpreter::slim::Command& query = *parsed.line.command;
  if (interpreter::slim::is_one_of(kAnsweredInWords, query.verb)) return false;
  return query.verb != Verb::query_parameter || check_parameter(query.module, query.name, std::nullopt,
                                                                SpeedNames::pn10_is_vm, false) == Error::none;
}

}  // namespace

Error check_parameter_line(const interpreter::slim::Command& command, bool module_taken_from_letter) {
  for (const Operand& operand : command.operands) {
    if (operand.kind == Operand::Kind::quantity && !is_quantity(operand)) return Error::syntax;
  }
  const bool is_speed = command.verb == Verb::set_path_speed;
  if (command.verb != Verb::set_parameter && !is_speed) return Error::none;
  const Operand& given = command.operands.front();
  std::optional<double> value;
  if (given.kind == Operand::Kind::integer || given.kind == Operand::Kind::real) value = given.number;
  // It does not matter which of PN10 and PN14 is the speed: both have the same range.
  return check_parameter(command.module, is_speed ? "TVM" : std::string_view(command.name), value,
                         SpeedNames::pn10_is_vm, module_taken_from_letter);
}

}  // namespace understudy::emulator::models::slim
