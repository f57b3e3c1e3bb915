// Whether two devices of one make are in the same state; if not, the first field that differs, by its name.
#pragma once

#include <gtest/gtest.h>

#include "emulator/device/device.h"

namespace understudy::emulator {

inline testing::AssertionResult same_state(const Device& a, const Device& b) {
  if (a.same_state(b)) return testing::AssertionSuccess();
  return testing::AssertionFailure() << a.name() << "." << a.state_difference(a.save_state(), b.save_state());
}

}  // namespace understudy::emulator
