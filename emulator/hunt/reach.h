// Notes what a course has reached, as a set of numbers. Each number stands for something that can be reached.
// There are four sorts: lines of programs and their decisions; registers with classes of values; coarse
// states of the whole bench; and orders, which are two such states in sequence and the events between them.
//
// Samples are taken when something happens: at messages, faults, inputs, and after each step.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/play/performing/observer.h"

namespace understudy::emulator::hunt {

enum class Sort : std::uint8_t { program, value, state, order };
inline constexpr std::array<std::string_view, 4> kSorts{"lines and branches", "values", "states", "orders"};

/// Something that was reached. Its sort is in the lowest bits of its number.
using Feature = std::uint64_t;
constexpr Sort sort_of(Feature feature) { return static_cast<Sort>(feature & 3); }

struct Reached {
  /// The time at which each feature was first reached. Results must not depend on the order of iteration.
  std::unordered_map<Feature, SimTime> when{};

  /// The latest observations. An order combines one of them with the next.
  struct Last {
    std::uint64_t state = 0;
    std::uint64_t event = 0;
    std::uint64_t request = 0;  // the hosts' last request
    std::uint64_t reply = 0;    // the reply to it; 0 if it has none yet
  };
  Last last{};
  bool goes_on = false;  // the next observer continues from `last`
};

/// Returns an observer that adds to `reached`, which must outlive it.
play::ObserverMaker reach_observer(Reached& reached);

}  // namespace understudy::emulator::hunt
