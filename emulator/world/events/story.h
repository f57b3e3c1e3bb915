// Describes how a scenario failed: a sentence, and the events that led to the failure.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/world/events/event_log.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

struct Story {
  /// An event in words.
  struct Moment {
    SimTime at{0};
    std::string text;
  };
  SimTime at{0};
  std::string sentence;            // "failed at 6.091s: feeder.A.lost is 5; expected 0 (fail.yaml:8: ...)"
  std::vector<std::string> names;  // the names in the sentence: "feeder.A.lost"
  std::vector<Moment> moments;     // the oldest first
};

/// Returns the story of a failure. The moments are the last events that affect the names in the failure, and
/// the last events of the same devices. All of them precede the failure.
Story story_of(const World& world, const RecordedFailure& failure, const std::deque<Event>& events);

/// Returns the moments as lines: "1.030091302s  host writes feeder.Aaxis_Pulse = 32000".
std::vector<std::string> moment_lines(const Story& story);

}  // namespace understudy::emulator::world
