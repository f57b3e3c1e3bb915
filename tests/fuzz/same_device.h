// Two devices that must be in the same state; if they are not, the field that differs is told.
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
