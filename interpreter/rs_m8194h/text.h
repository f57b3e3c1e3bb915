// A command as text and back, without loss: the manual's name, then the parameters.
//
//   RSM_FIXED_MOVE XYZU 10000
//   RSM_SET_NHOME INITIAL_XY 1            ; into the Initial Table; AXIS_XY is XY
//   RSM_WRITE_MD MD1500 0 1.5
//   RSM_MACRO_IF VAR1 <= VAR2
//   RSM_MACRO_FRNET_OUT bVAR0, VAR1       ; with or without commas
//
// Names may be in upper or lower case, and numbers decimal or hexadecimal (0x).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/text/tokens.h"
#include "interpreter/rs_m8194h/check.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/options.h"
#include "interpreter/rs_m8194h/text_error.h"

namespace understudy::interpreter::rs_m8194h {

std::string text_of(const Command& command);

struct ParsedCommand {
  std::optional<Command> command;
  std::optional<TextError> error;  // set if there is no command
};

/// Parses one line that decode() accepts in some state of the device. Operators are also checked.
ParsedCommand parse_command(std::string_view text, const Options& options = {});
/// Like parse_command(text), but for tokens. There must be at least one token.
ParsedCommand parse_command(std::span<const Token> tokens, const Options& options = {});

}  // namespace understudy::interpreter::rs_m8194h
