// Names that earlier steps have defined and later steps may use.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace understudy::emulator::play {

/// The names that are valid at one moment, and again after a restore to it.
struct StoryMoment {
  std::vector<std::string> faults;  // the faults in effect
  std::vector<std::string> spans;   // the open spans
};

struct Story : StoryMoment {
  std::map<std::string, StoryMoment> snapshots;
  std::set<std::string> saved;  // the files that have been saved
};

}  // namespace understudy::emulator::play
