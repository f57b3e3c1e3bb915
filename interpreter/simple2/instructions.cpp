#include "interpreter/simple2/instructions.h"

#include <string_view>

namespace understudy::interpreter::simple2 {

std::string_view describe(Operand operand) {
  switch (operand) {
    case Operand::none: return "N/A";
    case Operand::flag: return "flag (1-64)";
    case Operand::parameter: return "param";
    case Operand::immediate: return "imm8 (-128..127)";
    case Operand::input: return "DIN number (0-10)";
    case Operand::output: return "DOUT number (0-6)";
    case Operand::output_bits: return "array logic bits (bit n = DOUTn, ON:1/OFF:0)";
    case Operand::output_mask: return "array change mask (bit n = DOUTn, change:1/keep:0)";
    case Operand::logic: return "logic (ON:1/OFF:0)";
    case Operand::amount_low: return "amount_L (low 8 bits)";
    case Operand::amount_high: return "amount_H (high 8 bits)";
    case Operand::percent: return "amount (0-100)";
    case Operand::loop_count: return "loop count (0 = infinite)";
    case Operand::counter: return "counter (1-2)";
    case Operand::timer: return "timer (1-2)";
    case Operand::status_bit: return "STATUS bit (0-15)";
  }
  return "";
}

}  // namespace understudy::interpreter::simple2
