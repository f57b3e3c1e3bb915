// Makes the display of `ctl watch` from two replies to {"do":"status"}.
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator::serve {

/// Returns lines of text: time and lateness, each line of the bench with its frames per second since the
/// previous reply, each device with its axes, registers, inputs and outputs. `before` may be empty; rates are
/// then left out. `between_s` is the wall time between the two replies. Lines of several words are at most
/// `columns` wide. Throws ControlError if the reply is not a status.
std::vector<std::string> watch_table(const std::string& status, const std::string& before, double between_s,
                                     std::size_t columns = 100);

/// Returns the message that asks for the values of these names, and for the time.
std::string get_message(const std::vector<std::string>& names);

/// Returns the display of `ctl watch NAME...`: a line for each name with its value, or with the reason why it
/// has none now.
std::vector<std::string> watch_values(const std::string& reply);

/// Returns the error of a refusal, or an empty text for any other reply. Throws ControlError if it is not a
/// reply.
std::string why_refused(const std::string& reply);

}  // namespace understudy::emulator::serve
