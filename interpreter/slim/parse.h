// Parses a line of text into a command. availability.h decides whether the command is allowed.
#pragma once

#include <optional>
#include <string_view>

#include "interpreter/slim/command.h"
#include "interpreter/slim/error.h"
#include "interpreter/slim/options.h"

namespace understudy::interpreter::slim {

struct ParseResult {
  Error error = Error::none;  // syntax or range, if there is an error
  ParsedLine line = {};       // valid if there is no error

  bool operator==(const ParseResult&) const = default;
};

/// Parses a line and checks everything that does not depend on state. An empty line is not an error.
ParseResult parse_line(std::string_view text, const Options& options = {});

/// Parses a decimal number in the form that hosts send: sign, digits, point, exponent. Returns nothing for
/// any other text.
std::optional<Operand> parse_number(std::string_view text);

}  // namespace understudy::interpreter::slim
