// Identifies a case of a file by the parameter values from `cases` and `vary`.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace understudy::emulator::play {

struct Case {
  std::string play{};  // the name within the file, if the file contains several scenarios
  std::vector<std::pair<std::string, std::string>> values{};  // in the order of the file
  bool is_varied = false;  // from `vary`, so there may be too many cases to inspect each of them
};

/// Returns "(speed=200, takes=3050ms)", or an empty text if there are no values.
std::string to_text(const Case& which);

/// Returns a hash of the scenario's name, the parameter names and the values. It depends neither on their
/// order nor on other cases, so it is the same in every shard, and does not change when cases are added to
/// the file.
std::uint64_t identity_of(const Case& which);
/// Returns the identity as 16 hexadecimal digits, the form for users and for results.
std::string identity_text(std::uint64_t identity);

}  // namespace understudy::emulator::play
