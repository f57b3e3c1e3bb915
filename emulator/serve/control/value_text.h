// Makes the output of `ctl get` and `ctl eval` from their replies.
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator::serve {

/// Returns a line for each value of a reply to {"do":"get"}: "feeder.Cord_A 32000", "time 3.05s". Throws
/// nlohmann's exceptions if it is not such a reply.
std::vector<std::string> value_lines(const std::string& reply);

/// Returns the value in a reply to {"do":"eval"}.
std::string value_text(const std::string& reply);

}  // namespace understudy::emulator::serve
