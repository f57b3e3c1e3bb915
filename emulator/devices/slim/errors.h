// What a chain of SLIM modules refuses, by the numbers that ?ERR shows.
#pragma once

#include <cstdint>

namespace understudy::emulator::slim {

/// The manual gives no list; these are ours.
enum class Error : std::uint8_t {
  none = 0,
  syntax = 1,
  out_of_range = 2,   // a value or an index
  not_allowed = 3,    // in this mode
  not_assigned = 4,   // an axis letter has no module, or the module is reserved for an axis
  not_linked = 5,     // PN50
  paused = 6,         // a motion command between TAPZ and TAREDO or TAUPZ
  speeds_differ = 7,  // PR2 or PR3 of the modules of one coordinated command
  buffer_full = 8,
  servo_off = 9,
  following_error = 10,  // beyond EL
  overload = 11,         // beyond LL
  over_temperature = 12,
  bad_address = 13,  // of a program, or its stack
};

}  // namespace understudy::emulator::slim
