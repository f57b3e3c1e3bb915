#pragma once

#include <string>
#include <string_view>

namespace understudy {

/// The text with its control characters written out ("\\n"), so that what is quoted from a file or a frame
/// can neither break a message in two nor reach the terminal.
std::string one_line(std::string_view text);

/// The same for something that is quoted, cut if it is long.
std::string quoted(std::string_view text);

}  // namespace understudy
