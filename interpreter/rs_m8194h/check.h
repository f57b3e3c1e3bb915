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

/// Options that accept everything that any choice accepts, for commands that have been checked already.
inline constexpr Options kAnyChoice{option("rectangle_radius", "drawn_shorter"),
                                    option("uneven_scan_start", "starts_all_the_same"),
                                    option("initial_in_macros", "stored_when_the_line_runs")};

/// Returns the first parameter that is not in its range or list, or nothing if all are valid. References are
/// accepted; their values are checked when the line runs. bad_operand() checks operators, and all of
/// VAR_CALCULATE.
std::optional<std::size_t> bad_parameter(const Command& command, const Options& options = {});

/// Returns the first wrong operator of IF, or the first wrong operand or operator of VAR_CALCULATE.
std::optional<std::size_t> bad_operand(const Command& command);
/// Like bad_operand(), but returns Fault::comparison or Fault::operand, which have their own codes in a
/// download.
Fault operand_fault(const Command& command);

/// Returns what is expected of a parameter: "1 to 7", "an axis mask (X to XYZU)", "VAR0 to VAR511".
std::string expected_of(const Command& command, std::size_t parameter);

}  // namespace understudy::interpreter::rs_m8194h
