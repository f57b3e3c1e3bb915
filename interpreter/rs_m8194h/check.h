// Checks a command's parameters against its row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/options.h"

namespace understudy::interpreter::rs_m8194h {

/// Options that accept everything that any choice accepts, for commands that were already checked.
inline constexpr Options kAnyChoice{option("rectangle_radius", "drawn_shorter"),
                                    option("uneven_scan_start", "starts_all_the_same"),
                                    option("initial_in_macros", "stored_when_the_line_runs")};

/// Returns the first parameter that is not in its range or list, or nothing if all are valid. References are
/// accepted, because their values are checked when the line runs. Operators and all parameters of
/// VAR_CALCULATE are left to bad_operand().
std::optional<std::size_t> bad_parameter(const Command& command, const Options& options = {});

/// Returns the first wrong operator of IF, or the first wrong operand or operator of VAR_CALCULATE.
std::optional<std::size_t> bad_operand(const Command& command);
/// Like bad_operand(), but returns Fault::comparison or Fault::operand, which have their own download error
/// codes.
Fault operand_fault(const Command& command);

/// Returns the expected values of a parameter: "1 to 7", "an axis mask (X to XYZU)", "VAR0 to VAR511".
std::string expected_of(const Command& command, std::size_t parameter);

}  // namespace understudy::interpreter::rs_m8194h
