#pragma once

namespace understudy::acceptance {

/// Sets the terminal to any speed (BOTHER), raw, 8N1. Returns false if the kernel refuses.
bool set_any_speed(int descriptor, int baud);

}  // namespace understudy::acceptance
