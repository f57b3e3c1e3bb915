// The error numbers in D8094. The manual does not list any, so these numbers are ours.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace understudy::interpreter::super_40nc {

enum class Code : std::uint8_t {
  none = 0,
  unknown = 1,     // unknown instruction or operand, or a pointer to a step where no instruction begins
  wrong_area = 2,  // not allowed in this area, or without effect
  label_missing = 3,
  label_twice = 4,  // D8096 contains the step of the other label
  pairing = 5,      // unmatched CAL and RET, or IF, ELSE and ENDI; or a stack is full
  no_end = 6,
  logic = 7,  // wrong blocks or branches, or contacts without a jump
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
  axis_taken = 21,       // or moving
  emergency_input = 22,  // CEMG
  comparator = 23,
};

/// The meanings of the numbers.
inline constexpr std::array<std::string_view, 24> kCodeWords{
    "no error",
    "an instruction, operand or step that does not exist",
    "an instruction that has no effect in this program",
    "a label that does not exist",
    "a label that appears twice",
    "CAL and RET, or IF, ELSE and ENDI, that do not match",
    "no END",
    "contacts or blocks that do not match",
    "a division by zero",
    "a register that does not exist",
    "no room in program memory",
    "the positive limit",
    "the negative limit",
    "the positive soft limit",
    "the negative soft limit",
    "a home search that failed",
    "an axis that this program does not own, by D9003 (C21)",
    "an impossible arc",
    "ALM",
    "M8002, emergency stop",
    "a file or recipe that does not exist",
    "an axis that is moving or in use",
    "CEMG, emergency input",
    "a comparator",
};
constexpr std::string_view words_of(Code code) { return kCodeWords[static_cast<std::size_t>(code)]; }

/// Returns true if the program continues after a line with this error.
constexpr bool leaves_program_running(Code code) {
  return code == Code::wrong_area || code == Code::division_by_zero || code == Code::out_of_range ||
         code == Code::axis_not_owned || code == Code::arc_impossible || code == Code::axis_taken ||
         code == Code::label_twice;
}

}  // namespace understudy::interpreter::super_40nc
