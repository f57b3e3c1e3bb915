// What to say about a line that is none, to somebody who wrote it: its word may be known, and its form not.
#pragma once

#include <string>
#include <string_view>

namespace understudy::interpreter::slim {

/// "'MA 1,2' is not a form of MA; expected MA x or MA Rn".
std::string why_not_command(std::string_view line);

}  // namespace understudy::interpreter::slim
