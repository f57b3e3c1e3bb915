#include "tests/interpreter/simple2/instruction_cases.h"

namespace understudy::interpreter::simple2 {
namespace {

void both_move(ScriptedMachine& machine) { machine.moving_a = machine.moving_b = true; }

}  // namespace

std::vector<InstructionCase> motion_cases() {
  return {
      // Move_INC_x, Move_ABS_x, Move_Home_x continue at once, whether or not the axis moves
      {0x20, 5, 0, with(5, -500), "A by -500", kNext},
      {0x20, 5, 0, a_moves, "A by 0", kNext},
      {0x21, 5, 0, with(5, INT32_MIN), "A to -2147483648", kNext},
      {0x27, 0, 0, a_moves, "A home", kNext},
      {0x30, 5, 0, with(5, 500), "B by 500", kNext},
      {0x31, 5, 0, with(5, INT32_MAX), "B to 2147483647", kNext},
      {0x37, 0, 0, b_moves, "B home", kNext},
      {0x40, 5, 6, with(5, 1, 6, 2), "A by 1; B by 2", kNext},
      {0x41, 5, 6, with(5, 1, 6, 2), "A to 1; B to 2", kNext},
      {0x47, 0, 0, both_move, "A home; B home", kNext},
      // Speeds and ramps
      {0x22, 5, 0, with(5, 200), "A speed 200", kNext},
      {0x22, 5, 0, with(5, 32769), "A speed 32768", kNext},
      {0x22, 5, 0, with(5, -1), "A speed 0", kNext},
      {0x32, 5, 0, with(5, 32768), "B speed 32768", kNext},
      {0x42, 5, 6, with(5, 100, 6, 200), "A speed 100; B speed 200", kNext},
      {0x23, 5, 6, with(5, 10, 6, 20), "A ramps 10 20", kNext},
      {0x23, 5, 6, with(5, -10, 6, 3001), "A ramps 0 3000", kNext},
      {0x33, 5, 6, with(5, 3000, 6, 0), "B ramps 3000 0", kNext},
      {0x43, 5, 6, with(5, 10, 6, 20), "A ramps 10 20; B ramps 10 20", kNext},  // the same for both axes
      // *_Wait: the second slot is the first one to check
      {0x25, 5, 0, with(5, 3), "A by 3", kHere},
      {0x25, 5, 0, a_moves, "A by 0", kHere},
      {0x26, 5, 0, with(5, 3), "A to 3", kHere},
      {0x28, 0, 0, a_moves, "A home", kHere},
      {0x35, 5, 0, with(5, 3), "B by 3", kHere},
      {0x36, 5, 0, with(5, 3), "B to 3", kHere},
      {0x38, 0, 0, b_moves, "B home", kHere},
      {0x45, 5, 6, with(5, 1, 6, 2), "A by 1; B by 2", kHere},
      {0x46, 5, 6, with(5, 1, 6, 2), "A to 1; B to 2", kHere},
      {0x48, 0, 0, both_move, "A home; B home", kHere},
      // Wait_Move_x from 1.40 on: moving jumps, or waits if no line has the flag
      {0x24, 7, 0, as_it_is, "", kNext},
      {0x24, 7, 0, a_moves, "", kFlag7},
      {0x24, 7, 0, b_moves, "", kNext},
      {0x24, 9, 0, a_moves, "", kHere},
      {0x24, 0, 0, a_moves, "", kHere},
      {0x24, 65, 0, a_moves, "", kHere},
      {0x34, 7, 0, a_moves, "", kNext},
      {0x34, 7, 0, b_moves, "", kFlag7},
      {0x34, 9, 0, b_moves, "", kHere},
      {0x44, 7, 0, as_it_is, "", kNext},
      {0x44, 7, 0, a_moves, "", kFlag7},
      {0x44, 7, 0, b_moves, "", kFlag7},
      {0x44, 255, 0, b_moves, "", kHere},
      // Servo and STOP
      {0x2A, 0, 0, as_it_is, "A servo on", kNext},
      {0x2B, 0, 0, as_it_is, "A servo off", kNext},
      {0x2F, 0, 0, as_it_is, "A stop", kNext},
      {0x3A, 0, 0, as_it_is, "B servo on", kNext},
      {0x3B, 0, 0, as_it_is, "B servo off", kNext},
      {0x3F, 0, 0, as_it_is, "B stop", kNext},
      {0x4A, 0, 0, as_it_is, "A servo on; B servo on", kNext},
      {0x4B, 0, 0, as_it_is, "A servo off; B servo off", kNext},
      {0x4F, 0, 0, as_it_is, "A stop; B stop", kNext},
      // Coordinates are parameters 154 and 155
      {0x70, 0, 0, as_it_is, "p154 = 0; p155 = 0", kNext},
      {0x71, 0, 0, as_it_is, "p154 = 0", kNext},
      {0x72, 0, 0, as_it_is, "p155 = 0", kNext},
      {0x73, 5, 6, with(5, -1, 6, 2), "p154 = -1; p155 = 2", kNext},
      {0x73, 155, 154, with(154, 1, 155, 2), "p154 = 2; p155 = 1", kNext},  // both are read first
      {0x74, 5, 0, with(5, 7), "p154 = 7", kNext},
      {0x75, 5, 0, with(5, 7), "p155 = 7", kNext},
      // PWM, 0 to 100
      {0x80, 5, 0, with(5, 55), "A PWM 55", kNext},
      {0x80, 5, 0, with(5, -1), "A PWM 0", kNext},
      {0x81, 5, 0, with(5, 101), "B PWM 100", kNext},
      {0x82, 100, 0, as_it_is, "A PWM 100", kNext},
      {0x82, 0, 0, as_it_is, "A PWM 0", kNext},
      {0x83, 255, 0, as_it_is, "B PWM 100", kNext},
      // Velocity mode, mRPM and RPM
      {0x84, 5, 0, with(5, -1234), "A mRPM -1234", kNext},
      {0x85, 5, 0, with(5, INT32_MAX), "B mRPM 2147483647", kNext},
      {0x86, 5, 0, with(5, -1234), "A mRPM -1234000", kNext},
      {0x86, 5, 0, with(5, 2147484), "A mRPM 2147483647", kNext},
      {0x87, 5, 0, with(5, INT32_MIN), "B mRPM -2147483648", kNext},
      {0x88, 0x2C, 0x01, as_it_is, "A mRPM 300000", kNext},
      {0x88, 0xFF, 0xFF, as_it_is, "A mRPM -1000", kNext},
      {0x89, 0x00, 0x80, as_it_is, "B mRPM -32768000", kNext},
      {0x89, 0xFF, 0x7F, as_it_is, "B mRPM 32767000", kNext},
      // Encoder sync
      {0x8A, 0, 0, as_it_is, "A follows", kNext},
      {0x8B, 0, 0, as_it_is, "B follows", kNext},
  };
}

}  // namespace understudy::interpreter::simple2
