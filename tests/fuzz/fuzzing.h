// Code shared by the fuzz targets: error reports, and how the time of a search is divided.
//
// A search needs many runs: worlds are made once and restored to their initial state, and checks that cost
// several times as much as a plain run (the same run in single ticks, a second station) are done for one
// input in eight, or fewer. When a corpus is replayed, everything is checked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>

namespace understudy::fuzzing {

inline void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "violated: %s\n", what);
  std::abort();
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Returns true for one input in `many`, for which everything is checked. The result depends only on the
/// input.
inline bool is_checked_wholly([[maybe_unused]] std::span<const std::uint8_t> input,
                              [[maybe_unused]] std::uint32_t one_in = 8) {
#ifdef UNDERSTUDY_REPLAYS_CORPUS
  return true;
#else
  std::uint32_t sum = 0;
  for (const std::uint8_t byte : input) sum = sum * 31 + byte;
  return (sum >> 3) % one_in == 0;
#endif
}

}  // namespace understudy::fuzzing
