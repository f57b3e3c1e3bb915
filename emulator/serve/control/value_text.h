// Formats the replies to `ctl get` and `ctl eval`.
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator::serve {

/// Returns a line for each value in a reply to {"do":"get"}, such as "feeder.Cord_A 32000" or "time 3.05s".
/// Throws nlohmann's exceptions for other replies.
std::vector<std::string> value_lines(const std::string& reply);

/// Returns the value in a reply to {"do":"eval"}.
std::string value_text(const std::string& reply);

}  // namespace understudy::emulator::serve
