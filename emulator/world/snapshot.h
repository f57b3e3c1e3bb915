// Saves the state of a running world as a value, restores it, compares it and hashes it. A state can also be
// restored into another world of the same bench. snapshot_file.h stores it in a file.
//
// A restored world continues like the saved world: the same outside events at the same times lead to the same
// states and the same bytes on its lines. Do not call these functions from within World::advance_to(), which
// means from watchers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/simulated_time.h"
#include "base/state/shared_text.h"
#include "base/state/state_error.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

struct WorldState {
  struct Part {
    std::string name;  // "world", "device feeder", "line rs485", "edge"
    std::vector<std::byte> bytes;
    SharedTexts texts{};  // shared with the saved world; `bytes` contains their digests
    bool operator==(const Part& other) const {
      return name == other.name && texts == other.texts && bytes.size() == other.bytes.size() &&
             (bytes.empty() || std::memcmp(bytes.data(), other.bytes.data(), bytes.size()) == 0);
    }
  };
  SimTime time{0};  // simulated
  std::vector<Part> parts;
  bool operator==(const WorldState&) const = default;
};

/// The part that does not affect the model: bytes that a host has not read yet, and how ticks were skipped.
inline constexpr std::string_view kEdgePart = "edge";

WorldState save(const World& world);

/// Reads a state. The returned function puts the world into that state; it can be called repeatedly and does
/// not throw. Throws StateError "part: what is wrong" if such a world cannot be in that state. Watchers,
/// observers and listeners stay attached. The world must outlive the function.
std::function<void()> read_state(World& world, const WorldState& state);

/// Reads a state and puts it into effect immediately. If it throws, nothing has changed.
void restore(World& world, const WorldState& state);

/// Returns the path and name of the first field in which two states of such a world differ:
/// "feeder.axes[0].motor.travel_pulses: 12 against 13", "rs485.feeder.counters.replies: 1 against 2". Empty
/// if they are equal. Throws StateError if either state cannot be read.
std::string difference(const World& world, const WorldState& a, const WorldState& b);

/// Returns a hash of everything that affects the model. It omits bytes that a host has not read yet, and how
/// ticks were skipped.
std::uint64_t hash(const World& world);

}  // namespace understudy::emulator::world
