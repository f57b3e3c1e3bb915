// The names that earlier steps have defined and that later steps may use.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace understudy::emulator::play {

/// The names that are valid at a moment, and are valid again after that moment is restored.
struct StoryMoment {
  std::vector<std::string> faults;  // the active faults
  std::vector<std::string> spans;   // the open spans
};

struct Story : StoryMoment {
  std::map<std::string, StoryMoment> snapshots;
  std::set<std::string> saved;  // the files that have been saved
};

}  // namespace understudy::emulator::play
