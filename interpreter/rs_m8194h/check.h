// Whether the parameters of a command are what its row allows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/faults.h"

namespace understudy::interpreter::rs_m8194h {

/// What the manual leaves open about commands.
struct CommandOptions {
  /// A rectangle whose corners do not fit its sides is refused, or left to whoever carries it out.
  bool rectangle_corners_must_fit = true;
  /// Speeds, slopes and their rates beyond the ends that are printed as numbers are refused; else whoever
  /// moves clamps them.
  bool speeds_have_ends = false;
  /// A variable is set within the range of positions only.
  bool variables_have_ends = false;
  /// A move of no distance, and a helix that turns back, are refused.
  bool zero_moves_are_refused = false;
  bool helix_turns_forward_only = false;
  bool helix_has_turns = false;
  /// LINE_SCAN_START takes the types that are not available yet.
  bool uneven_scans_start = false;
  /// SYNC_ACTION has one trigger axis; SET_OUT knows X and Y.
  bool one_trigger_axis = false;
  bool outputs_are_of_x_and_y = false;
  /// Which order of the letters of `<=` a message may have.
  enum class Letters : std::uint8_t { either, as_in_the_frame, as_in_the_table };
  Letters letters = Letters::either;
  /// IF: one letter, = or !, is no operator.
  bool single_signs_are_refused = false;
  /// FRNET_OUT: a number that is a variable's address stands for it.
  bool addresses_are_variables = false;
  /// The six codes that 12.3 gives otherwise than chapter 7.
  bool codes_of_12_3 = false;
  /// FRNET_WAIT also as 12.3 counts its registers: its time is one of them.
  bool frnet_wait_may_have_7 = false;
  /// A code that only a frame of 7.4.8 has is that of MIX_2D_INITIAL.
  bool knows_0cb2 = false;
  /// A variable may stand for a constant only where the command's section says so.
  bool few_take_references = false;
  /// Sides and radii of a rectangle end at 200,000,000.
  bool rectangles_end_earlier = false;
  /// The Initial Table is stored in by macros as well.
  bool macros_store_initial = false;
  /// Which of two faults answers.
  bool state_before_code = false;

  bool operator==(const CommandOptions&) const = default;
};

/// Takes what any choice takes: of what is read that somebody else has checked.
inline constexpr CommandOptions kAnyChoice{
    .rectangle_corners_must_fit = false, .uneven_scans_start = true, .macros_store_initial = true};

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
