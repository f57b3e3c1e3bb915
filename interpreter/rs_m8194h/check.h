// Whether the parameters of a command are what its row allows.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/faults.h"

namespace understudy::interpreter::rs_m8194h {

/// What the manual leaves open about commands.
struct CommandOptions {
  /// A rectangle whose corners do not fit its sides is refused, or left to whoever carries it out.
  bool rectangle_corners_must_fit = true;

  bool operator==(const CommandOptions&) const = default;
};

/// The first parameter that is not in its range or list; nothing: all are good. References are good; what
/// they stand for is checked when the line runs. Operators, and all of VAR_CALCULATE, are a matter of
/// bad_operand().
std::optional<std::size_t> bad_parameter(const Command& command, const CommandOptions& options = {});

/// The first operator of IF, or operand or operator of VAR_CALCULATE, that is wrong.
std::optional<std::size_t> bad_operand(const Command& command);
/// The same as Fault::comparison or Fault::operand, for which the download has codes of their own.
Fault operand_fault(const Command& command);

/// "1 to 7", "an axis mask (X to XYZU)", "VAR0 to VAR511": what is expected of a parameter.
std::string expected_of(const Command& command, std::size_t parameter);

}  // namespace understudy::interpreter::rs_m8194h
