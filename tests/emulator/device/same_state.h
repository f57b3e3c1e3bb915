// Compares the states of two devices of one kind; names the first field that differs.
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

/// Checks the bytes that the device saves, because a snapshot contains only these.
inline testing::AssertionResult saves(const Device& device, const std::vector<std::byte>& bytes) {
  const std::vector<std::byte> saved = device.save_state();
  if (saved == bytes) return testing::AssertionSuccess();
  return testing::AssertionFailure() << device.name() << "." << device.state_difference(bytes, saved);
}
inline testing::AssertionResult saves_the_same(const Device& a, const Device& b) {
  return saves(b, a.save_state());
}

}  // namespace understudy::emulator
