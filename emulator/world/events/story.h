// Describes how a scenario failed: one sentence, and the events that led there.
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
  std::vector<std::string> names;  // the names that the sentence mentions: "feeder.A.lost"
  std::vector<Moment> moments;     // the oldest first
};

/// Returns the story of a failure. The moments are the last events that touch its names, and then the last
/// ones of the same devices, all of them before the failure.
Story story_of(const World& world, const RecordedFailure& failure, const std::deque<Event>& events);

/// Returns the moments as lines: "1.030091302s  host writes feeder.Aaxis_Pulse = 32000".
std::vector<std::string> moment_lines(const Story& story);

}  // namespace understudy::emulator::world
