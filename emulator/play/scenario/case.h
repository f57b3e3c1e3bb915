// Which case of its file a scenario is: what `cases` and `vary` gave its parameters.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace understudy::emulator::play {

struct Case {
  std::string play{};  // of several in its file, the name as it is written there
  std::vector<std::pair<std::string, std::string>> values{};  // names and values, in the order written
  bool is_varied = false;  // `vary` made it: one of so many that nobody looks at each
};

/// "(speed=200, takes=3050ms)"; empty without values.
std::string to_text(const Case& which);

/// A hash of the play, names and values. It depends neither on their order nor on any other case: the same in
/// every shard, and when the file grows by other cases.
std::uint64_t identity_of(const Case& which);
/// As people and results write it: 16 digits.
std::string identity_text(std::uint64_t identity);

}  // namespace understudy::emulator::play
