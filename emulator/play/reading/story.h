// What the steps so far have made that later steps may name.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace understudy::emulator::play {

/// What holds at one moment, and again after a restore.
struct StoryMoment {
  std::vector<std::string> faults;  // in force
  std::vector<std::string> spans;   // open
};

struct Story : StoryMoment {
  std::map<std::string, StoryMoment> snapshots;
  std::set<std::string> saved;  // files
};

}  // namespace understudy::emulator::play
