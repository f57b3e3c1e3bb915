// Counters are parameters 171 and 172, timers 173 and 174.
#include "tests/interpreter/simple2/instruction_cases.h"

namespace understudy::interpreter::simple2 {

std::vector<InstructionCase> output_cases() {
  return {
      // Out
      {0x05, 0, 1, as_it_is, "outputs 0000001", kNext},
      {0x05, 6, 1, with_outputs(0b0001000), "outputs 1001000", kNext},
      {0x05, 3, 0, with_outputs(0b1111111), "outputs 1110111", kNext},
      {0x05, 3, 255, as_it_is, "outputs 0001000", kNext},
      {0x05, 7, 1, as_it_is, "", kNext},  // there is no DOUT 7
      {0x05, 255, 1, as_it_is, "", kNext},
      // Out_ALL
      {0x06, 1, 0, as_it_is, "outputs 1111111", kNext},
      {0x06, 0, 0, with_outputs(0b1111111), "outputs 0000000", kNext},
      {0x06, 2, 0, as_it_is, "outputs 1111111", kNext},
      // Out_Array: the manual's example, 29
      {0x08, 29, 0, with_outputs(0b1100010), "outputs 0011101", kNext},
      {0x08, 0x80, 0, with_outputs(0b1111111), "outputs 0000000", kNext},
      // Out_Array_Select: the manual's example, 53 over outputs 3 and 4
      {0x09, 53, 1, with_outputs(0b0011000), "outputs 0111101", kNext},
      {0x09, 53, 0, with_outputs(0b1111111), "outputs 1001010", kNext},
      {0x09, 0x80, 1, as_it_is, "outputs 0000000", kNext},

      // Jump_CounterN_EQ, _GT
      {0x12, 7, 5, with(171, 500, 5, 500), "", kFlag7},
      {0x12, 7, 5, with(171, 500, 5, 501), "", kNext},
      {0x12, 9, 5, as_it_is, "", kNoSuchFlag},
      {0x12, 7, 5, with(171, 65535, 5, -1), "", kNext},  // a counter is unsigned
      {0x13, 7, 5, with(171, 501, 5, 500), "", kFlag7},
      {0x13, 7, 5, with(171, 500, 5, 500), "", kNext},
      {0x13, 7, 5, with(171, 0, 5, -1), "", kFlag7},
      {0x14, 7, 5, with(172, 65535, 5, 65535), "", kFlag7},
      {0x14, 7, 5, with(171, 1, 172, 2), "", kNext},
      {0x15, 7, 5, with(172, 65535, 5, 65534), "", kFlag7},
      {0x15, 7, 5, with(172, 3, 5, 70000), "", kNext},
      {0x15, 9, 5, with(172, 1), "", kNoSuchFlag},
      // Jump_CounterN_EQ_0, _GT_0
      {0xB0, 7, 0, as_it_is, "", kFlag7},
      {0xB0, 7, 0, with(171, 1), "", kNext},
      {0xB1, 7, 0, with(171, 1), "", kFlag7},
      {0xB1, 7, 0, with(172, 1), "", kNext},
      {0xB2, 7, 0, with(171, 1), "", kFlag7},
      {0xB2, 7, 0, with(172, 1), "", kNext},
      {0xB3, 7, 0, with(172, 65535), "", kFlag7},
      {0xB3, 7, 0, as_it_is, "", kNext},
      // Counter_Clear, _Increase, _Decrease, _Value: 16 bits that wrap
      {0x50, 1, 0, with(171, 9), "p171 = 0", kNext},
      {0x50, 2, 0, with(172, 9), "p172 = 0", kNext},
      {0x50, 0, 0, as_it_is, "", kNext},
      {0x50, 3, 0, as_it_is, "", kNext},
      {0x51, 1, 0, with(171, 9), "p171 = 10", kNext},
      {0x51, 2, 0, with(172, 65535), "p172 = 0", kNext},
      {0x51, 3, 0, as_it_is, "", kNext},
      {0x52, 1, 0, with(171, 9), "p171 = 8", kNext},
      {0x52, 2, 0, as_it_is, "p172 = 65535", kNext},
      {0x52, 0, 0, as_it_is, "", kNext},
      {0x51, 255, 0, as_it_is, "", kNext},
      {0x53, 1, 5, with(5, 1234), "p171 = 1234", kNext},
      {0x53, 2, 5, with(5, 65536 + 7), "p172 = 7", kNext},
      {0x53, 1, 5, with(5, -1), "p171 = 65535", kNext},
      {0x53, 4, 5, with(5, 1), "", kNext},
      // Timer_Stop, _Start, _Reset, _Value
      {0x54, 1, 0, as_it_is, "timer 1 stands", kNext},
      {0x54, 2, 0, as_it_is, "timer 2 stands", kNext},
      {0x54, 3, 0, as_it_is, "", kNext},
      {0x55, 1, 0, as_it_is, "timer 1 runs", kNext},
      {0x55, 2, 0, as_it_is, "timer 2 runs", kNext},
      {0x55, 0, 0, as_it_is, "", kNext},
      {0x56, 1, 0, with(173, 5), "p173 = 0", kNext},
      {0x56, 2, 0, with(174, 5), "p174 = 0", kNext},
      {0x56, 3, 0, as_it_is, "", kNext},
      {0x57, 1, 5, with(5, 77), "p173 = 77", kNext},
      {0x57, 2, 5, with(5, -1), "p174 = -1", kNext},  // the same 32 bits, 4294967295 as a timer
      {0x57, 3, 5, as_it_is, "", kNext},
      // Jump_TimerN_GE
      {0x1A, 7, 5, with(173, 100, 5, 100), "", kFlag7},
      {0x1A, 7, 5, with(173, 99, 5, 100), "", kNext},
      {0x1A, 9, 5, with(173, 100, 5, 100), "", kNoSuchFlag},
      {0x1B, 7, 5, with(174, 101, 5, 100), "", kFlag7},
      {0x1B, 7, 5, with(173, 101, 5, 100), "", kNext},               // the other timer
      {0x1B, 7, 5, with(174, INT32_MIN, 5, INT32_MAX), "", kFlag7},  // 2147483648 >= 2147483647
      {0x1B, 7, 5, with(174, 5, 5, -1), "", kNext},                  // 5 < 4294967295
  };
}

}  // namespace understudy::interpreter::simple2
