// What `ctl watch` shows, made from two replies to {"do":"status"}.
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator {

/// Lines of text: time and lateness, each line of the bench with its frames a second since the reply before,
/// each device with its axes, registers, inputs and outputs. `before` may be empty: rates are left out then.
/// `between_s` is the wall time between the two. Throws ControlError for what is no status.
std::vector<std::string> watch_table(const std::string& status, const std::string& before, double between_s);

}  // namespace understudy::emulator
