// Ways to advance a world to a time, and comparisons of worlds afterwards, for tests that all ways have the
// same result.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "emulator/device/terminals.h"
#include "tests/emulator/device/same_state.h"
#include "tests/emulator/world/same_world.h"
#include "tests/emulator/world/two_devices.h"

namespace understudy::emulator::world {

/// Returns UNDERSTUDY_SEED, or the given seed.
inline std::uint64_t seed_or(std::uint64_t usual) {
  const char* given = std::getenv("UNDERSTUDY_SEED");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : usual;
}

/// Advances a world to a time.
using Stepping = std::function<void(World&, SimTime)>;

inline void by_single_ticks(World& world, SimTime to) {
  world.set_bulk_ticks(false);
  world.advance_to(to);
  EXPECT_EQ(world.ticks_skipped(), 0u);
}

inline Stepping by_odd_steps(std::uint64_t seed) {
  return [random = std::mt19937_64(seed)](World& world, SimTime to) mutable {
    using namespace std::chrono_literals;
    while (world.now() < to) {
      constexpr SimTime kLengths[] = {1ns, 333'333ns, 1ms, 7ms - 1ns, 17'001'003ns, 500ms};
      world.advance_to(std::min(to, world.now() + kLengths[random() % std::size(kLengths)]));
    }
    world.advance_to(to);
  };
}

inline void by_what_is_due(World& world, SimTime to) {
  int idle_turns = 0;
  while (const auto due = world.next_due()) {
    if (*due > to) break;
    const SimTime before = world.now();
    world.advance_to(*due);
    idle_turns = world.now() == before ? idle_turns + 1 : 0;
    ASSERT_LT(idle_turns, 10) << "due repeatedly at " << format_duration(*due);
  }
  world.advance_to(to);
}

inline testing::AssertionResult same(World& one, World& other) {
  const auto differ = [](const std::string& what) {
    return testing::AssertionFailure() << what << " differs";
  };
  if (one.now() != other.now()) return differ("the time");
  if (one.next_due() != other.next_due()) return differ("what is due");
  if (one.faults() != other.faults()) return differ("what is broken");
  for (std::size_t d = 0; d < one.device_count(); ++d) {
    const Device& device = one.device(d);
    const Device& twin = other.device(d);
    if (device.powered() != twin.powered()) return differ("the power");
    if (const auto same = same_state(device, twin); !same) return same;
    for (int i = 0; i < static_cast<int>(device.model().terminals.size()); ++i) {
      if (device.input(i) != twin.input(i)) return differ("an input");
      if (device.terminals()->output(i) != twin.terminals()->output(i)) return differ("an output");
      if (one.external_input(d, i) != other.external_input(d, i)) return differ("an external input");
    }
    for (int axis = 0; axis < static_cast<int>(device.model().axes.size()); ++axis) {
      if (const auto same = same_state(one.plant(d, axis), other.plant(d, axis)); !same) return same;
    }
  }
  if (take_output(one) != take_output(other)) return differ("what the line says");
  return testing::AssertionSuccess();
}

/// Applies the same events to both worlds, one after another, and compares the worlds before each event and
/// long after the last. The `plain` world is advanced in one step. `look` is called after each event. Fails
/// fatally.
template <typename Event>
void play_both(World& plain, World& twin, const std::vector<Event>& events, const Stepping& stepping,
               const std::string& name, const std::function<void()>& look) {
  const auto both_to = [&](SimTime time, const std::string& where) {
    plain.advance_to(time);
    stepping(twin, time);
    ASSERT_TRUE(same(plain, twin)) << name << " " << where << " at " << format_duration(time);
  };
  for (std::size_t i = 0; i < events.size(); ++i) {
    ASSERT_NO_FATAL_FAILURE(both_to(events[i].at, "before event " + std::to_string(i)));
    apply(plain, events[i]);
    apply(twin, events[i]);
    look();
  }
  ASSERT_NO_FATAL_FAILURE(both_to(events.back().at + std::chrono::seconds(40), "at the end"));
  look();
}

}  // namespace understudy::emulator::world
