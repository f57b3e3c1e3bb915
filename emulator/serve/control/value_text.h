// What `ctl get` and `ctl eval` print, made from the reply.
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator::serve {

/// "feeder.Cord_A 32000", "time 3.05s": a line for each value of a reply to {"do":"get"}. Throws nlohmann's
/// exceptions if it is not such a reply.
std::vector<std::string> value_lines(const std::string& reply);

/// The value in a reply to {"do":"eval"}.
std::string value_text(const std::string& reply);

}  // namespace understudy::emulator::serve
