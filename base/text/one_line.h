#pragma once

#include <string>
#include <string_view>

namespace understudy {

/// Returns the text with control characters written as escapes ("\\n"), so that a quotation from a file or a
/// frame can neither split a message in two nor control the terminal.
std::string one_line(std::string_view text);

/// Like one_line(), but in quotes, and shortened if it is long.
std::string quoted(std::string_view text);
// The overload for std::string is needed because std::quoted would be a better match if <iomanip> is
// included.
inline std::string quoted(const std::string& text) { return quoted(std::string_view(text)); }
inline std::string quoted(std::string& text) { return quoted(std::string_view(text)); }
inline std::string quoted(const char* text) { return quoted(std::string_view(text)); }

}  // namespace understudy
