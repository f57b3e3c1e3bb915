// Choices about the program and its language, shown by programs that run in the device. Started at tick 10, a
// program runs a line at 12, 14 and so on.
#include "tests/emulator/models/simple2_r3/choice_cases.h"

namespace understudy::emulator::models::simple2_r3 {
namespace choices_program_test {

// CMD of the lines used here.
constexpr std::uint16_t kWaitIo = 0x01, kJump = 0x03, kOut = 0x05, kEnd = 0xFF;
constexpr std::uint16_t kMoveA = 0x20, kMoveSpeedA = 0x22, kMoveAccDecA = 0x23, kMoveAWait = 0x25;
constexpr std::uint16_t kJumpTimer1 = 0x1A, kCountUp = 0x51, kCountDown = 0x52, kCountTo = 0x53;
constexpr std::uint16_t kTimerStart = 0x55, kCopy = 0x62, kAdd = 0x63, kSub = 0x64, kDiv = 0x66, kDivR = 0x6D;
constexpr std::uint16_t kDivDirect = 0x6A, kInc = 0x6B, kPwmA = 0x80;
// Parameters.
constexpr std::uint16_t kVar0 = 32, kParmsSpeed1 = 80;

const ProgramLine kTheEnd{kEnd, 0, 0, 0};
constexpr Value kBytes0xFFFF = 0xFF;

bool runs(OneSimple2& feeder) { return feeder.bit("PROG_MAIN_RunTime_Status"); }

TEST(ChoicesProgram, Timer1NeverOrAlwaysJumpsUpTo141) {
  for (const auto& [option, jumps] :
       each_option<bool>("timer1_defect", {{"never_jumps", false}, {"always_jumps", true}})) {
    for (const Value reached : {0, 100}) {
      Given given = with("timer1_defect", option);
      given.firmware = 141;
      OneSimple2 feeder(given);
      feeder.set("Timer1_Value", 50);
      feeder.set("PROG_MEM0", reached);
      start_with_program(feeder, {{kJumpTimer1, 1, 0, 0}, kTheEnd, {kOut, 0, 1, 1}, kTheEnd});
      feeder.run(20);
      EXPECT_EQ(feeder.bit("DOUT_0"), jumps) << option << ", " << reached;
    }
    OneSimple2 newer(with("timer1_defect", option));  // works
    newer.set("Timer1_Value", 50);
    newer.set("PROG_MEM0", 100);
    start_with_program(newer, {{kJumpTimer1, 1, 0, 0}, kTheEnd, {kOut, 0, 1, 1}, kTheEnd});
    newer.run(20);
    EXPECT_FALSE(newer.bit("DOUT_0")) << option;
  }
}

TEST(ChoicesProgram, AnUndefinedOperandIsHarmlessOrEndsTheProgram) {
  const ProgramLine wrong_lines[] = {
      {kOut, 7, 1, 0},        {kWaitIo, 11, 0, 0}, {kCountUp, 3, 0, 0}, {kCountTo, 0, 0, 0},
      {kTimerStart, 3, 0, 0}, {0x10, 1, 11, 0},    {0xC0, 1, 16, 0},  // Jump_IN_ON, Jump_STATUS_ON
  };
  for (const auto& [option, harmless] :
       each_option<bool>("undefined_operand", {{"harmless", true}, {"ends", false}})) {
    for (const ProgramLine& wrong : wrong_lines) {
      OneSimple2 feeder(with("undefined_operand", option));
      start_with_program(feeder, {wrong, {kOut, 6, 1, 0}, {kJump, 2, 0, 2}});
      feeder.run(20);
      EXPECT_EQ(feeder.get("DOUT_ALL"), harmless ? 0x40 : 0) << option << ", " << wrong[0];
      EXPECT_EQ(runs(feeder), harmless) << option << ", " << wrong[0];
    }
    OneSimple2 right(with("undefined_operand", option));  // the last of each, and a flag that no line has
    start_with_program(
        right, {{kWaitIo, 10, 0, 0}, {kCountUp, 2, 0, 0}, {0xC0, 65, 15, 0}, {kOut, 6, 1, 0}, kTheEnd});
    right.run(20);
    EXPECT_EQ(right.get("DOUT_ALL"), 0x40) << option;
  }
}

TEST(ChoicesProgram, AnUndefinedParameterReadsZeroOrEndsTheProgram) {
  for (const auto& [option, reads_zero] :
       each_option<bool>("undefined_parameter", {{"reads_zero", true}, {"ends", false}})) {
    for (const std::uint16_t number : {159, 166, 183, 255}) {
      OneSimple2 feeder(with("undefined_parameter", option));
      feeder.set("PROG_VAR0", 5);
      start_with_program(feeder,
                         {{kCopy, number, kVar0, 0}, {kCopy, kVar0, number, 0}, {kOut, 6, 1, 0}, kTheEnd});
      feeder.run(20);
      EXPECT_EQ(feeder.get("PROG_VAR0"), reads_zero ? 0 : 5) << option << ", " << number;
      EXPECT_EQ(feeder.bit("DOUT_6"), reads_zero) << option << ", " << number;
    }
    OneSimple2 right(with("undefined_parameter", option));
    start_with_program(right, {{kCopy, 158, 182, 0}, {kOut, 159, 1, 0}, {kOut, 6, 1, 0}, kTheEnd});
    right.run(20);
    EXPECT_TRUE(right.bit("DOUT_6")) << option << ": a DOUT is not a parameter";
  }
}

TEST(ChoicesProgram, AValueOutOfRangeIsClampedOrCutTo16BitsFirst) {
  struct Expected {
    Value from_70000, from_minus_1, acc_time, pwm;
  };
  // 70000 is 4464 beyond 2^16, 65546 is 10.
  for (const auto& [option, expected] : each_option<Expected>(
           "value_out_of_range",
           {{"clamped", {32768, 0, 3000, 100}}, {"low_16_bits", {4464, 32768, 3000, 10}}})) {
    ReadySimple2 feeder(with("value_out_of_range", option));
    feeder.set("PROG_MEM0", 70'000);
    feeder.set("PROG_MEM1", -1);
    feeder.set("PROG_MEM2", 65'546);
    start_with_program(feeder, {{kCopy, 0, kParmsSpeed1, 0},
                                {kCopy, 1, kParmsSpeed1 + 1, 0},
                                {kMoveSpeedA, 0, 0, 0},
                                {kMoveAccDecA, 0, 1, 0},
                                {kPwmA, 2, 0, 0},
                                kTheEnd});
    feeder.run(20);
    EXPECT_EQ(feeder.get("Parms_Speed1"), expected.from_70000) << option;
    EXPECT_EQ(feeder.get("Parms_Speed2"), expected.from_minus_1) << option;
    EXPECT_EQ(feeder.get("Aaxis_Speed"), expected.from_70000) << option;
    EXPECT_EQ(feeder.get("Aaxis_AccTime"), expected.acc_time) << option;
    EXPECT_EQ(feeder.get("Aaxis_DecTime"), option == "clamped" ? 0 : 3000) << option;
    EXPECT_EQ(feeder.get("Aaxis_DirectPWM"), expected.pwm) << option;
  }
}

TEST(ChoicesProgram, ADelayOutOfRangeIsClampedOrCutTo16Bits) {
  for (const auto& [option, end] :
       each_option<Tick>("value_out_of_range", {{"clamped", 12 + 65'536}, {"low_16_bits", 12 + 10}})) {
    OneSimple2 feeder(with("value_out_of_range", option));
    feeder.set("PROG_MEM2", 65'546);
    start_with_program(feeder, {{0x07, 2, 0, 0}, kTheEnd});  // Delay_mSec_VAR
    feeder.run_to(end - 1);
    EXPECT_TRUE(runs(feeder)) << option;
    feeder.run_to(end);
    EXPECT_FALSE(runs(feeder)) << option;
  }
}

TEST(ChoicesProgram, ItsSpeedIsTheAxissOrItsOwn) {
  for (const auto& [option, shared] :
       each_option<bool>("program_speed", {{"registers", true}, {"of_its_own", false}})) {
    ReadySimple2 feeder(with("program_speed", option));
    feeder.set_one_pulse_a_tick('A', 100);
    feeder.set("PROG_MEM0", 40);
    feeder.set("PROG_MEM1", 2);
    feeder.set("PROG_MEM2", 1000);
    start_with_program(feeder,
                       {{kMoveSpeedA, 0, 0, 0}, {kMoveAccDecA, 1, 1, 0}, {kMoveAWait, 2, 0, 0}, kTheEnd});
    feeder.run_to(116);
    const Value before = feeder.coordinate('A');
    feeder.run(100);
    EXPECT_EQ(feeder.coordinate('A') - before, 200) << option << ": by 40 RPM";
    EXPECT_EQ(feeder.get("Aaxis_Speed"), shared ? 40 : 20) << option;
    EXPECT_EQ(feeder.get("Aaxis_AccTime"), shared ? 2 : 1) << option;
    feeder.run_while_moving('A');
    feeder.set("Aaxis_Pulse", 1000);
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run(100);
    const Value later = feeder.coordinate('A');
    feeder.run(100);
    EXPECT_EQ(feeder.coordinate('A') - later, shared ? 200 : 100) << option << ": the host's own move";
  }
}

TEST(ChoicesProgram, ItsMoveLeavesPulseOrShowsThere) {
  for (const auto& [option, shown] :
       each_option<bool>("program_pulse", {{"not_shown", false}, {"shown", true}})) {
    ReadySimple2 feeder(with("program_pulse", option));
    feeder.set_move('A', 7, 20, 1, 1);
    feeder.set_move('B', 7, 20, 1, 1);
    feeder.set("PROG_MEM0", 100);
    feeder.set("PROG_MEM1", -50);
    start_with_program(feeder, {{kMoveA, 0, 0, 0}, {0x31, 1, 0, 0}, kTheEnd});  // Move_INC_A, Move_ABS_B
    feeder.run(10);
    EXPECT_EQ(feeder.get("Aaxis_Pulse"), shown ? 100 : 7) << option;
    EXPECT_EQ(feeder.get("Baxis_Pulse"), shown ? -50 : 7) << option;
  }
}

TEST(ChoicesProgram, TheLineBehindAWaitRunsASlotLaterOrInTheSame) {
  struct Expected {
    Tick behind_input, behind_move;
  };
  // DIN 4 comes on after tick 20, so slot 22 finds it. A move of 100 pulses that begins in tick 12 ends in
  // tick 122, and slot 124 finds it.
  for (const auto& [option, expected] : each_option<Expected>(
           "wait_slot", {{"slot_of_its_own", {24, 126}}, {"in_the_same_slot", {22, 124}}})) {
    OneSimple2 feeder(with("wait_slot", option));
    start_with_program(feeder,
                       {{kWaitIo, 4, 1, 0}, {kOut, 0, 1, 0}, {kWaitIo, 4, 1, 0}, {kOut, 1, 1, 0}, kTheEnd});
    feeder.run_to(20);
    feeder.input(4, true);
    feeder.run_to(expected.behind_input - 1);
    EXPECT_FALSE(feeder.output(0)) << option;
    feeder.run_to(expected.behind_input);
    EXPECT_TRUE(feeder.output(0)) << option;
    feeder.run_to(expected.behind_input + 3);  // a wait that is over at once takes its slot either way
    EXPECT_FALSE(feeder.output(1)) << option;
    feeder.run_to(expected.behind_input + 4);
    EXPECT_TRUE(feeder.output(1)) << option;

    OneSimple2 mover(with("wait_slot", option));
    mover.set("ALL_SVON", 1);
    mover.set_one_pulse_a_tick('A', 0);
    mover.set("PROG_MEM0", 100);
    start_with_program(mover, {{kMoveAWait, 0, 0, 0}, {kOut, 0, 1, 0}, kTheEnd});
    mover.run_to(expected.behind_move - 1);
    EXPECT_FALSE(mover.output(0)) << option;
    mover.run_to(expected.behind_move);
    EXPECT_TRUE(mover.output(0)) << option;
  }
}

// --- results and counts ------------------------------------------------------------------------------

/// CalcREG after a line.
Value calculated(const Given& given, const ProgramLine& line, Value mem0, Value mem1) {
  OneSimple2 feeder(given);
  feeder.set("PROG_MEM0", mem0);
  feeder.set("PROG_MEM1", mem1);
  start_with_program(feeder, {line, kTheEnd});
  feeder.run(10);
  return feeder.get("CalcREG");
}

TEST(ChoicesProgram, ArithmeticWrapsOrSaturates) {
  constexpr Value kMax = 2'147'483'647;
  constexpr Value kMin = -kMax - 1;
  struct Expected {
    Value sum, difference, quotient, increased;
  };
  for (const auto& [option, expected] : each_option<Expected>(
           "arithmetic",
           {{"wraps", {kMin + 9, kMax - 9, kMin, kMin}}, {"saturates", {kMax, kMin, kMax, kMax}}})) {
    const Given given = with("arithmetic", option);
    EXPECT_EQ(calculated(given, {kAdd, 0, 1, 0}, kMax, 10), expected.sum) << option;
    EXPECT_EQ(calculated(given, {kSub, 0, 1, 0}, kMin, 10), expected.difference) << option;
    EXPECT_EQ(calculated(given, {kDiv, 0, 1, 0}, kMin, -1), expected.quotient) << option;
    EXPECT_EQ(calculated(given, {kAdd, 0, 1, 0}, kMax, -10), kMax - 10) << option;
    OneSimple2 feeder(given);
    feeder.set("PROG_MEM0", kMax);
    start_with_program(feeder, {{kInc, 0, 0, 0}, kTheEnd});
    feeder.run(10);
    EXPECT_EQ(feeder.get("PROG_MEM0"), expected.increased) << option;
  }
}

TEST(ChoicesProgram, DivisionGoesTowardsZeroOrDownwards) {
  struct Expected {
    Value quotient, remainder;
  };
  const auto minus_2 = static_cast<std::uint16_t>(kBytes0xFFFF - 1);
  for (const auto& [option, of_minus_7_by_2] :
       each_option<Expected>("division", {{"towards_zero", {-3, -1}}, {"downwards", {-4, 1}}})) {
    const Given given = with("division", option);
    const bool down = option == "downwards";
    EXPECT_EQ(calculated(given, {kDiv, 0, 1, 0}, -7, 2), of_minus_7_by_2.quotient) << option;
    EXPECT_EQ(calculated(given, {kDivR, 0, 1, 0}, -7, 2), of_minus_7_by_2.remainder) << option;
    EXPECT_EQ(calculated(given, {kDivDirect, 0, minus_2, 0}, 7, 0), down ? -4 : -3) << option;
    EXPECT_EQ(calculated(given, {kDivR, 0, 1, 0}, 7, -2), down ? -1 : 1) << option;
    for (const auto& [a, b, quotient, rest] :
         {std::array<Value, 4>{7, 2, 3, 1}, {-8, 2, -4, 0}, {-7, -2, 3, -1}, {-7, 0, 0, 0}}) {
      EXPECT_EQ(calculated(given, {kDiv, 0, 1, 0}, a, b), quotient) << option << ", " << a << " / " << b;
      EXPECT_EQ(calculated(given, {kDivR, 0, 1, 0}, a, b), rest) << option << ", " << a << " / " << b;
    }
  }
}

TEST(ChoicesProgram, CountersWrapOrSaturate) {
  struct Expected {
    Value up, down, set_to_70000, set_to_minus_1;
  };
  for (const auto& [option, expected] : each_option<Expected>(
           "counter_overflow", {{"wraps", {0, 65535, 4464, 65535}}, {"saturates", {65535, 0, 65535, 0}}})) {
    const auto counter_after = [&choice = option](const ProgramLine& line, Value before, Value mem0) {
      OneSimple2 feeder(with("counter_overflow", choice));
      feeder.set("Counter2_Value", before);
      feeder.set("PROG_MEM0", mem0);
      start_with_program(feeder, {line, kTheEnd});
      feeder.run(10);
      return feeder.get("Counter2_Value");
    };
    EXPECT_EQ(counter_after({kCountUp, 2, 0, 0}, 65535, 0), expected.up) << option;
    EXPECT_EQ(counter_after({kCountDown, 2, 0, 0}, 0, 0), expected.down) << option;
    EXPECT_EQ(counter_after({kCountTo, 2, 0, 0}, 5, 70'000), expected.set_to_70000) << option;
    EXPECT_EQ(counter_after({kCountTo, 2, 0, 0}, 5, -1), expected.set_to_minus_1) << option;
    EXPECT_EQ(counter_after({kCountUp, 2, 0, 0}, 65534, 0), 65535) << option;
  }
}

}  // namespace choices_program_test
}  // namespace understudy::emulator::models::simple2_r3
