// Identifies a case of a file by the values that `cases` and `vary` give to its parameters.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace understudy::emulator::play {

struct Case {
  std::vector<std::pair<std::string, std::string>> values{};  // names and values, in the order written
  bool is_varied = false;  // made by `vary`: one of many, which are not looked at one by one
};

/// Returns "(speed=200, takes=3050ms)", or an empty text without values.
std::string to_text(const Case& which);

/// Returns a hash of names and values. It depends neither on their order nor on other cases, so it is the
/// same in every shard, and when cases are added to the file.
std::uint64_t identity_of(const Case& which);
/// Returns the 16 digits in which people and results write it.
std::string identity_text(std::uint64_t identity);

}  // namespace understudy::emulator::play
