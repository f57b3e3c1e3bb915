// The numbers in SLIM's error replies (`ERR n`, `?ERR`, `?ERC`). The manual does not list any, so these
// numbers are ours.
#pragma once

#include <cstdint>

namespace understudy::interpreter::slim {

enum class Error : std::uint8_t {
  none = 0,
  syntax = 1,          // not a command, or not in a known form
  range = 2,           // a value or index out of range
  not_allowed = 3,     // not in this mode: typed, stored, or from outside while a program is running
  axis = 4,            // not assigned, or its module is reserved for another axis
  not_linked = 5,      // a module that is not in PN50
  paused = 6,          // refused during a pause
  unequal_speeds = 7,  // PR2 or PR3 differs between the axes of a command
  buffer_full = 8,     // the FIFO or the program is full
  servo_off = 9,       // HOFF
  following_error = 10,
  overload = 11,
  over_temperature = 12,
  address = 13,  // no such line or label, or the stack is full
};

}  // namespace understudy::interpreter::slim
