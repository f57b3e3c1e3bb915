// Writes a command as text that parse_line() parses to the same value.
#pragma once

#include <string>

#include "interpreter/slim/command.h"

namespace understudy::interpreter::slim {

/// Returns the shortest text that parses to the same number.
std::string text_of(double number);
std::string text_of(const Operand& operand);
std::string text_of(const Command& command);
std::string text_of(const ParsedLine& line);

}  // namespace understudy::interpreter::slim
