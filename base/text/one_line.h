#pragma once

#include <string>
#include <string_view>

namespace understudy {

/// The text with its control characters written out ("\\n"), so that a quotation from a file or a frame can
/// neither break a message in two nor control the terminal.
std::string one_line(std::string_view text);

/// Like the above, for a quotation, cut if it is long.
std::string quoted(std::string_view text);
// Where <iomanip> is known, std::quoted would suit a std::string better.
inline std::string quoted(const std::string& text) { return quoted(std::string_view(text)); }
inline std::string quoted(std::string& text) { return quoted(std::string_view(text)); }
inline std::string quoted(const char* text) { return quoted(std::string_view(text)); }

}  // namespace understudy
