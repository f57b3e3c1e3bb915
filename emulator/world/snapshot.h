// The state of a running world as a value: saved and restored in memory, hashed. It can also be restored into
// another world of the same bench. For a file see snapshot_file.h.
//
// A world that is restored goes on as it did after it was saved: the same things from outside at the same
// times make the same states and the same bytes on its lines. Not to be called from within
// World::advance_to(), that is by those who watch it.
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
    SharedTexts texts{};  // shared with the world that was saved; `bytes` has their digests
    bool operator==(const Part& other) const {
      return name == other.name && texts == other.texts && bytes.size() == other.bytes.size() &&
             (bytes.empty() || std::memcmp(bytes.data(), other.bytes.data(), bytes.size()) == 0);
    }
  };
  SimTime time{0};  // simulated
  std::vector<Part> parts;
  bool operator==(const WorldState&) const = default;
};

/// The part that decides nothing of what the model does: bytes that a host has not taken yet, how ticks were
/// crossed.
inline constexpr std::string_view kEdgePart = "edge";

WorldState save(const World& world);

/// Reads a state; calling the result, as often as you like, puts the world into it and does not throw. Throws
/// StateError "part: what is wrong" if it is not a state of such a world. Watchers, observers and the
/// listener stay as they are. The world must outlive it.
std::function<void()> read_state(World& world, const WorldState& state);

/// Like the above, at once; if it throws, nothing has changed.
void restore(World& world, const WorldState& state);

/// "feeder.axes[0].motor.travel_pulses: 12 against 13", "rs485.feeder.counters.replies: 1 against 2": the
/// first field by which two states of such a world differ, by its path and name; empty if none does. Throws
/// StateError for what cannot be read as such a one.
std::string difference(const World& world, const WorldState& a, const WorldState& b);

/// A hash of everything that decides what the model does, and of nothing else: not of bytes that a host has
/// not taken yet, nor of whether quiet ticks were crossed in bulk, nor of counts of that.
std::uint64_t hash(const World& world);

}  // namespace understudy::emulator::world
