// CalcREG is parameter 158.
#include "tests/interpreter/simple2/instruction_cases.h"

namespace understudy::interpreter::simple2 {

std::vector<InstructionCase> number_cases() {
  constexpr std::int32_t kMin = INT32_MIN;
  constexpr std::int32_t kMax = INT32_MAX;
  constexpr std::uint8_t kMinus1 = 0xFF;
  constexpr std::uint8_t kMinus3 = 0xFD;
  constexpr std::uint8_t kMinus128 = 0x80;
  return {
      // VAR_EQ, VAR_GT, VAR_LT: true continues, false skips a line
      {0x1C, 5, 6, with(5, -7, 6, -7), "", kNext},
      {0x1C, 5, 6, with(5, -7, 6, 7), "", kAfterNext},
      {0x1D, 5, 6, with(5, 8, 6, 7), "", kNext},
      {0x1D, 5, 6, with(5, 7, 6, 7), "", kAfterNext},
      {0x1D, 5, 6, with(5, kMin, 6, kMax), "", kAfterNext},
      {0x1E, 5, 6, with(5, kMin, 6, kMax), "", kNext},
      {0x1E, 5, 6, with(5, 7, 6, 7), "", kAfterNext},
      {0x1E, 5, 6, with(5, 8, 6, 7), "", kAfterNext},
      // VAR_DirectEQ, _GT, _LT: DATA2 is signed
      {0x90, 5, kMinus3, with(5, -3), "", kNext},
      {0x90, 5, kMinus3, with(5, 253), "", kAfterNext},
      {0x90, 5, kMinus128, with(5, -128), "", kNext},
      {0x91, 5, kMinus1, with(5, 0), "", kNext},
      {0x91, 5, 127, with(5, 127), "", kAfterNext},
      {0x92, 5, kMinus128, with(5, -129), "", kNext},
      {0x92, 5, 127, with(5, 127), "", kAfterNext},
      {0x92, 5, kMinus1, with(5, 0), "", kAfterNext},
      // VAR_GT_0, VAR_GE_0: true jumps
      {0x1F, 7, 5, with(5, 1), "", kFlag7},
      {0x1F, 7, 5, with(5, 0), "", kNext},
      {0x1F, 7, 5, with(5, -1), "", kNext},
      {0x1F, 9, 5, with(5, 1), "", kNoSuchFlag},
      {0x97, 7, 5, with(5, kMax), "", kFlag7},
      {0x97, 7, 5, with(5, 0), "", kFlag7},
      {0x97, 7, 5, with(5, -1), "", kNext},
      {0x97, 0, 5, with(5, 0), "", kNoSuchFlag},

      // Write_CalcREG, Load_CalcREG, VAR_Copy, VAR_Direct
      {0x60, 5, 0, with(5, -42), "p158 = -42", kNext},
      {0x61, 5, 0, with(158, -42), "p5 = -42", kNext},
      {0x61, 158, 0, with(158, 3), "p158 = 3", kNext},
      {0x62, 5, 6, with(5, 99), "p6 = 99", kNext},
      {0x62, 5, 165, with(5, 99), "p165 = 99", kNext},  // the machine knows that 165 does not exist
      {0x6F, 5, 127, as_it_is, "p5 = 127", kNext},
      {0x6F, 5, kMinus128, as_it_is, "p5 = -128", kNext},

      // VAR_Add, VAR_Sub, VAR_Mul wrap
      {0x63, 5, 6, with(5, 40, 6, -42), "p158 = -2", kNext},
      {0x63, 5, 6, with(5, kMax, 6, 1), "p158 = -2147483648", kNext},
      {0x63, 5, 5, with(5, kMin), "p158 = 0", kNext},
      {0x64, 5, 6, with(5, 40, 6, -42), "p158 = 82", kNext},
      {0x64, 5, 6, with(5, kMin, 6, 1), "p158 = 2147483647", kNext},
      {0x65, 5, 6, with(5, 1000, 6, -1000), "p158 = -1000000", kNext},
      {0x65, 5, 6, with(5, 65536, 6, 65536), "p158 = 0", kNext},
      {0x65, 5, 6, with(5, kMin, 6, -1), "p158 = -2147483648", kNext},
      {0x65, 5, 6, with(5, 123456789, 6, 987654321), "p158 = -67153019", kNext},
      // VAR_Div, VAR_DivR: towards zero, the remainder with the dividend's sign
      {0x66, 5, 6, with(5, 7, 6, 2), "p158 = 3", kNext},
      {0x66, 5, 6, with(5, -7, 6, 2), "p158 = -3", kNext},
      {0x66, 5, 6, with(5, 7, 6, -2), "p158 = -3", kNext},
      {0x66, 5, 6, with(5, 7, 6, 0), "p158 = 0", kNext},
      {0x66, 5, 6, with(5, kMin, 6, -1), "p158 = -2147483648", kNext},
      {0x6D, 5, 6, with(5, 7, 6, 4), "p158 = 3", kNext},
      {0x6D, 5, 6, with(5, -7, 6, 4), "p158 = -3", kNext},
      {0x6D, 5, 6, with(5, 7, 6, -4), "p158 = 3", kNext},
      {0x6D, 5, 6, with(5, 7, 6, 0), "p158 = 0", kNext},
      {0x6D, 5, 6, with(5, kMin, 6, -1), "p158 = 0", kNext},
      // The same with DATA2 itself
      {0x67, 5, kMinus3, with(5, 10), "p158 = 7", kNext},
      {0x67, 5, 127, with(5, kMax), "p158 = -2147483522", kNext},
      {0x68, 5, kMinus3, with(5, 10), "p158 = 13", kNext},
      {0x68, 5, kMinus128, with(5, 0), "p158 = 128", kNext},
      {0x69, 5, kMinus3, with(5, 10), "p158 = -30", kNext},
      {0x69, 5, 0, with(5, 10), "p158 = 0", kNext},
      {0x6A, 5, kMinus3, with(5, 10), "p158 = -3", kNext},
      {0x6A, 5, 0, with(5, 10), "p158 = 0", kNext},
      {0x6A, 5, kMinus1, with(5, kMin), "p158 = -2147483648", kNext},
      {0x6E, 5, kMinus3, with(5, -10), "p158 = -1", kNext},
      {0x6E, 5, 0, with(5, 10), "p158 = 0", kNext},
      {0x6E, 5, kMinus1, with(5, kMin), "p158 = 0", kNext},

      // In place: VAR_Inc, VAR_Dec, VAR_INV
      {0x6B, 5, 0, with(5, -1), "p5 = 0", kNext},
      {0x6B, 5, 0, with(5, kMax), "p5 = -2147483648", kNext},
      {0x6C, 5, 0, with(5, 0), "p5 = -1", kNext},
      {0x6C, 5, 0, with(5, kMin), "p5 = 2147483647", kNext},
      {0x93, 5, 0, with(5, 12), "p5 = -12", kNext},
      {0x93, 5, 0, with(5, kMin), "p5 = -2147483648", kNext},
      // Into another: VAR_INV_To, VAR_Inc_To, VAR_Dec_To
      {0x94, 5, 6, with(5, 12, 6, 1), "p6 = -12", kNext},
      {0x95, 5, 6, with(5, 12, 6, 1), "p6 = 13", kNext},
      {0x96, 5, 6, with(5, 12, 6, 1), "p6 = 11", kNext},
      {0x96, 5, 5, with(5, kMin), "p5 = 2147483647", kNext},
  };
}

}  // namespace understudy::interpreter::simple2
