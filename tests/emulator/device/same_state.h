// Whether two devices of one make are in the same state; if not, the first field that differs, by its name.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "emulator/device/device.h"

namespace understudy::emulator {

inline testing::AssertionResult same_state(const Device& a, const Device& b) {
  if (a.same_state(b)) return testing::AssertionSuccess();
  return testing::AssertionFailure() << a.name() << "." << a.state_difference(a.save_state(), b.save_state());
}

/// The same of what they save: its bytes are all that a snapshot has of them.
inline testing::AssertionResult saves(const Device& device, const std::vector<std::byte>& bytes) {
  const std::vector<std::byte> saved = device.save_state();
  if (saved == bytes) return testing::AssertionSuccess();
  return testing::AssertionFailure() << device.name() << "." << device.state_difference(bytes, saved);
}
inline testing::AssertionResult saves_the_same(const Device& a, const Device& b) {
  return saves(b, a.save_state());
}

}  // namespace understudy::emulator
