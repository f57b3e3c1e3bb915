// Checks a command's parameters against its row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/faults.h"

namespace understudy::interpreter::rs_m8194h {

/// Options about commands that the manual leaves open.
struct CommandOptions {
  /// True: a rectangle whose corners do not fit its sides is refused here; false: the machine that executes
  /// it decides.
  bool rectangle_corners_must_fit = true;
  /// True: speeds, slopes and their rates beyond their printed limits are refused; false: the machine clamps
  /// them.
  bool speeds_have_ends = false;
  /// True: a variable can be set only within the range of positions.
  bool variables_have_ends = false;
  /// True: a move of no distance is refused. The next two refuse a helix that turns back, or that has no
  /// turn.
  bool zero_moves_are_refused = false;
  bool helix_turns_forward_only = false;
  bool helix_has_turns = false;
  /// True: LINE_SCAN_START accepts the types that are not available yet.
  bool uneven_scans_start = false;
  /// True: SYNC_ACTION has one trigger axis. With the next one, SET_OUT accepts X and Y only.
  bool one_trigger_axis = false;
  bool outputs_are_of_x_and_y = false;
  /// The order of the letters of `<=` that a message may have.
  enum class Letters : std::uint8_t { either, as_in_the_frame, as_in_the_table };
  Letters letters = Letters::either;
  /// True: in IF, a single letter, = or !, is not an operator.
  bool single_signs_are_refused = false;
  /// True: in FRNET_OUT, a number that is a variable's address means the variable.
  bool addresses_are_variables = false;
  /// True: the six codes that differ between 12.3 and chapter 7 are those of 12.3.
  bool codes_of_12_3 = false;
  /// True: FRNET_WAIT may also have the register count of 12.3, which includes its time.
  bool frnet_wait_may_have_7 = false;
  /// True: a code that occurs only in a frame of 7.4.8 means MIX_2D_INITIAL.
  bool knows_0cb2 = false;
  /// True: a variable may replace a constant only where the command's section says so.
  bool few_take_references = false;
  /// True: sides and radii of a rectangle are at most 200,000,000.
  bool rectangles_end_earlier = false;
  /// True: macros also store into the Initial Table.
  bool macros_store_initial = false;
  /// True: if both the state and the code are wrong, the reply names the state.
  bool state_before_code = false;

  bool operator==(const CommandOptions&) const = default;
};

/// Options that accept everything that any choice accepts, for commands that have been checked already.
inline constexpr CommandOptions kAnyChoice{
    .rectangle_corners_must_fit = false, .uneven_scans_start = true, .macros_store_initial = true};

/// Returns the first parameter that is not in its range or list, or nothing if all are good. References are
/// good; their values are checked when the line runs. bad_operand() checks operators, and all of
/// VAR_CALCULATE.
std::optional<std::size_t> bad_parameter(const Command& command, const CommandOptions& options = {});

/// Returns the first wrong operator of IF, or the first wrong operand or operator of VAR_CALCULATE.
std::optional<std::size_t> bad_operand(const Command& command);
/// Like bad_operand(), but returns Fault::comparison or Fault::operand, which have their own codes in a
/// download.
Fault operand_fault(const Command& command);

/// Returns what is expected of a parameter: "1 to 7", "an axis mask (X to XYZU)", "VAR0 to VAR511".
std::string expected_of(const Command& command, std::size_t parameter);

}  // namespace understudy::interpreter::rs_m8194h
