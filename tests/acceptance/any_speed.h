#pragma once

namespace understudy::acceptance {

/// Sets the terminal to a speed of any number (BOTHER), raw, 8N1. False if the kernel refused.
bool set_any_speed(int descriptor, int baud);

}  // namespace understudy::acceptance
