// Explains why a line is not a command: the word may exist although the form does not.
#pragma once

#include <string>
#include <string_view>

namespace understudy::interpreter::slim {

/// Returns "'MA 1,2' is not a form of MA; expected MA x or MA Rn".
std::string why_not_command(std::string_view line);

}  // namespace understudy::interpreter::slim
