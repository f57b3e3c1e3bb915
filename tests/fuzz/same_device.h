// Requires two devices to be in the same state; otherwise names the field that differs.
#pragma once

#include <cstdio>

#include "emulator/device/device.h"
#include "tests/fuzz/fuzzing.h"

namespace understudy::fuzzing {

inline void require_same_state(const emulator::Device& a, const emulator::Device& b, const char* what) {
  if (a.same_state(b)) return;
  std::fprintf(stderr, "%s\n", a.state_difference(a.save_state(), b.save_state()).c_str());
  require(false, what);
}

}  // namespace understudy::fuzzing
