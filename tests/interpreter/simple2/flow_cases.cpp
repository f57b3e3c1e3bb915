#include "tests/interpreter/simple2/instruction_cases.h"

namespace understudy::interpreter::simple2 {

std::vector<InstructionCase> flow_cases() {
  return {
      // NOP
      {0x00, 0, 0, as_it_is, "", kNext},
      {0x00, 7, 9, as_it_is, "", kNext},
      // Wait_IO
      {0x01, 3, 1, with_inputs(0b1000), "", kNext},
      {0x01, 3, 1, with_inputs(0b0111), "", kHere},
      {0x01, 3, 0, with_inputs(0b0111), "", kNext},
      {0x01, 3, 0, with_inputs(0b1000), "", kHere},
      {0x01, 0, 1, with_inputs(1), "", kNext},
      {0x01, 10, 1, with_inputs(1 << 10), "", kNext},
      {0x01, 3, 200, with_inputs(0b1000), "", kNext},  // anything except 0 is ON
      {0x01, 11, 1, with_inputs(0xFFFF), "", kHere},   // there is no DIN 11: OFF
      {0x01, 11, 0, with_inputs(0xFFFF), "", kNext},
      {0x01, 255, 0, as_it_is, "", kNext},
      // Delay_mSec: a delay that ends within a slot takes one; the rest is in timing_test.cpp
      {0x02, 0, 0, as_it_is, "", kNext},
      {0x02, 2, 0, as_it_is, "", kNext},
      {0x02, 3, 0, as_it_is, "", kHere},
      {0x02, 0, 1, as_it_is, "", kHere},  // 256 ms
      // Jump
      {0x03, 7, 0, as_it_is, "", kFlag7},
      {0x03, 9, 0, as_it_is, "", kNoSuchFlag},
      {0x03, 0, 0, as_it_is, "", kNoSuchFlag},
      {0x03, 65, 0, as_it_is, "", kNoSuchFlag},
      {0x03, 255, 0, as_it_is, "", kNoSuchFlag},
      // Loop: loop_test.cpp
      {0x04, 7, 3, as_it_is, "", kNext},        // line 40 is not before line 10: void
      {0x04, 9, 3, as_it_is, "", kNoSuchFlag},  // line 0 is
      {0x04, 9, 1, as_it_is, "", kNext},        // the one pass is over
      {0x04, 9, 0, as_it_is, "", kNoSuchFlag},  // endless
      // Delay_mSec_VAR
      {0x07, 5, 0, with(5, 2), "", kNext},
      {0x07, 5, 0, with(5, 3), "", kHere},
      {0x07, 5, 0, with(5, -1000), "", kNext},  // limited to 0
      {0x07, 200, 0, as_it_is, "", kNext},      // no such parameter: 0
      // Jump_IN_ON, Jump_IN_OFF
      {0x10, 7, 4, with_inputs(1 << 4), "", kFlag7},
      {0x10, 7, 4, with_inputs(~(1 << 4) & 0x7FF), "", kNext},
      {0x10, 9, 4, with_inputs(1 << 4), "", kNoSuchFlag},
      {0x10, 7, 11, with_inputs(0xFFFF), "", kNext},
      {0x11, 7, 4, with_inputs(1 << 4), "", kNext},
      {0x11, 7, 4, with_inputs(~(1 << 4) & 0x7FF), "", kFlag7},
      {0x11, 9, 4, as_it_is, "", kNoSuchFlag},
      {0x11, 7, 11, with_inputs(0xFFFF), "", kFlag7},
      // Jump_STATUS_ON, Jump_STATUS_OFF
      {0xC0, 7, 15, with_status(0x8000), "", kFlag7},
      {0xC0, 7, 0, with_status(0xFFFE), "", kNext},
      {0xC0, 9, 4, with_status(0x0010), "", kNoSuchFlag},
      {0xC0, 7, 16, with_status(0xFFFF), "", kNext},  // there is no bit 16: 0
      {0xC1, 7, 15, with_status(0x8000), "", kNext},
      {0xC1, 7, 0, with_status(0xFFFE), "", kFlag7},
      {0xC1, 9, 4, as_it_is, "", kNoSuchFlag},
      {0xC1, 7, 16, with_status(0xFFFF), "", kFlag7},
      // END
      {0xFF, 0, 0, as_it_is, "", kEnd},
      {0xFF, 7, 7, as_it_is, "", kEnd},
  };
}

}  // namespace understudy::interpreter::simple2
