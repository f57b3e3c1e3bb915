// Identifies a case of a file by the values that `cases` and `vary` give to its parameters.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace understudy::emulator::play {

struct Case {
  std::string play{};  // the name in the file, if the file has several scenarios
  std::vector<std::pair<std::string, std::string>> values{};  // in the order written
  bool is_varied = false;  // made by `vary`, so there may be too many to inspect each of them
};

/// Returns "(speed=200, takes=3050ms)", or an empty text without values.
std::string to_text(const Case& which);

/// Returns a hash of the scenario's name, and of the names and values. It depends neither on their order nor
/// on other cases, so it is the same in every shard, and does not change when cases are added to the file.
std::uint64_t identity_of(const Case& which);
/// Returns the identity as 16 hexadecimal digits, the form in which users type it and results show it.
std::string identity_text(std::uint64_t identity);

}  // namespace understudy::emulator::play
