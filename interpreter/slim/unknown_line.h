// Explains a line that is not a command to its author: the word may be known even if the form is not.
#pragma once

#include <string>
#include <string_view>

namespace understudy::interpreter::slim {

/// "'MA 1,2' is not a form of MA; expected MA x or MA Rn".
std::string why_not_command(std::string_view line);

}  // namespace understudy::interpreter::slim
