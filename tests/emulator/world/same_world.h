// Compares the states of two machines or worlds; names the first field that differs.
#pragma once

#include <gtest/gtest.h>

#include "base/state/difference.h"
#include "emulator/world/plant/plant.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/state_fields.h"

namespace understudy::emulator::world {

inline testing::AssertionResult same_state(const PlantAxis& a, const PlantAxis& b) {
  if (a.same_state(b)) return testing::AssertionSuccess();
  return testing::AssertionFailure() << first_difference(a.save(), b.save(), "machine");
}

/// Ignores bytes that hosts have left on the lines, and how ticks were run.
inline testing::AssertionResult same_state(const World& a, const World& b) {
  if (hash(a) == hash(b)) return testing::AssertionSuccess();
  return testing::AssertionFailure() << difference(a, save(a), save(b));
}

}  // namespace understudy::emulator::world
