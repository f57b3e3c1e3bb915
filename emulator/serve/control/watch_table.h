// Formats two replies to {"do":"status"} for `ctl watch`.
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator::serve {

/// Returns lines of text: time and lateness, each line of the bench with its frames per second since the
/// previous reply, and each device with its axes, registers, inputs and outputs. If `before` is empty, rates
/// are omitted. `between_s` is the wall time between the two replies. Lines of several words are at most
/// `columns` wide. Throws ControlError if the reply is not a status.
std::vector<std::string> watch_table(const std::string& status, const std::string& before, double between_s,
                                     std::size_t columns = 100);

/// Returns the message that requests the values of these names, and the time.
std::string get_message(const std::vector<std::string>& names);

/// Returns the display of `ctl watch NAME...`: for each name a line with its value, or with the reason why it
/// has no value now.
std::vector<std::string> watch_values(const std::string& reply);

/// Returns the error in a refusal, or an empty text for any other reply. Throws ControlError if the text is
/// not a reply.
std::string why_refused(const std::string& reply);

}  // namespace understudy::emulator::serve
