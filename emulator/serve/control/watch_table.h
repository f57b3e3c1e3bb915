// What `ctl watch` shows, made from two replies to {"do":"status"}.
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator::serve {

/// Lines of text: time and lateness, each line of the bench with its frames a second since the previous
/// reply, each device with its axes, registers, inputs and outputs. `before` may be empty; rates are then
/// left out. `between_s` is the wall time between the two. Words side by side take at most this many columns.
/// Throws ControlError if the reply is not a status.
std::vector<std::string> watch_table(const std::string& status, const std::string& before, double between_s,
                                     std::size_t columns = 100);

/// The message that asks for the values of these names, and for the time.
std::string get_message(const std::vector<std::string>& names);

/// What `ctl watch NAME...` shows of the reply: a line for each name, or the reason why it has no value now.
std::vector<std::string> watch_values(const std::string& reply);

/// The error in a reply that refuses; empty if it does not refuse. Throws ControlError if it is not a reply.
std::string why_refused(const std::string& reply);

}  // namespace understudy::emulator::serve
