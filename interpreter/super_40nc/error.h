// The numbers of D8094. The manual prints none; these are ours.
#pragma once

#include <cstdint>
#include <string_view>

namespace understudy::interpreter::super_40nc {

enum class Code : std::uint8_t {
  none = 0,
  unknown = 1,     // instruction or operand; a pointer that no instruction begins at
  wrong_area = 2,  // not allowed, or void, in this area
  label_missing = 3,
  label_twice = 4,  // D8096 has the other one
  pairing = 5,      // CAL and RET, IF, ELSE and ENDI; a stack that is full
  no_end = 6,
  logic = 7,  // blocks, branches, groups without a jump
  division_by_zero = 8,
  out_of_range = 9,  // a register
  memory_full = 10,
  limit_positive = 11,
  limit_negative = 12,
  soft_limit_positive = 13,
  soft_limit_negative = 14,
  home_failed = 15,
  axis_not_owned = 16,  // C21
  arc_impossible = 17,
  alarm = 18,
  emergency_stop = 19,   // M8002
  no_such_file = 20,     // or recipe
  axis_taken = 21,       // or moves
  emergency_input = 22,  // CEMG
  comparator = 23,
};

}  // namespace understudy::interpreter::super_40nc
