// Snapshots as text: the state of a world in a JSON file. Only the program version that wrote a snapshot can
// read it, and only for the same bench.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

#include "emulator/world/bench/bench.h"
#include "emulator/world/snapshot.h"

namespace understudy::emulator::world {

/// Thrown for a snapshot that cannot be used. The message is one line: "field: what is wrong; what was
/// expected".
struct SnapshotError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns a hash of everything in a bench that is not in the state of the world. The initial contents of
/// memories are omitted, because the state contains the present contents.
std::uint64_t bench_hash(const Bench& bench);

/// Used instead of bench_hash() for a state within a recording, whose header contains the bench.
inline constexpr std::uint64_t kBenchOfRecording = 0;

std::string to_text(const WorldState& state, std::uint64_t bench);
/// Throws SnapshotError if the text is cut off, was changed, is not a snapshot, or is from another version or
/// bench.
WorldState parse_snapshot(const std::string& text, std::uint64_t bench);

}  // namespace understudy::emulator::world
