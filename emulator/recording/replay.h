// Runs a recording again and compares every byte that is said.
#pragma once

#include <functional>
#include <istream>
#include <optional>
#include <string>

#include "emulator/recording/recording.h"

namespace understudy::emulator {

struct ReplayResult {
  enum class Verdict : std::uint8_t {
    same,       // every byte, at its time
    different,  // `difference` tells the first
    stopped,    // as asked, or at its end if that comes first
  } verdict = Verdict::same;
  std::string difference;  // one line
  SimTime reached{0};
  std::uint64_t events = 0;
  std::uint64_t bytes_said = 0;
  bool has_end = false;  // false: the recording breaks off, as that of a killed program does
};

struct Replayed {
  RecordingHeader header;
  Bench bench;
  ReplayResult result;
};

/// `name` stands for the file in messages: RecordingError "name:line: field: what". `until`: goes no further
/// than that. `world_made` gets the world when it is new, and may watch it; it lasts as long as the call.
/// `done` gets it when all is over.
Replayed replay(std::istream& recording, const std::string& name, std::optional<SimTime> until,
                const std::function<void(World&)>& world_made = {},
                const std::function<void(World&)>& done = {});

}  // namespace understudy::emulator
