// Wait_Move_A, Wait_Move_B and Wait_Move_ALL before and after 1.40 (manual: program instructions 0x24, 0x34,
// 0x44): they waited in their line, and B moved; now they jump to a flag.
#include "tests/emulator/models/simple2_r3/program_host.h"

namespace understudy::emulator::models::simple2_r3 {
namespace firmware_wait_move_test {

using namespace opcode;

// A moves 30 pulses (40 ms), B 50 (60 ms).
world::Words move_and_wait(std::uint16_t move, std::uint16_t wait, std::uint16_t flag) {
  return program_lines({{move, 0, 1, 0},     // slot 12; both: A by MEM0, B by MEM1
                        {wait, flag, 0, 0},  // slot 14
                        {kOut, 0, 1, 0},
                        {kEnd, 0, 0, 0},
                        {kOut, 1, 1, 7},  // flag 7
                        {wait, 9, 0, 0},  // a flag that no line has
                        {kOut, 2, 1, 0},
                        {kEnd, 0, 0, 0}});
}

TEST(FirmwareWaitMove, WaitMoveAAndAllWaitInLineUntil139AndJumpFrom140On) {
  struct Case {
    std::uint16_t move, wait;
    Tick moved;  // the slot that finds the move ended: A in tick 52, B in tick 72
  };
  for (const Case& row :
       {Case{kMoveA, kWaitA, 54}, Case{kMoveAll, kWaitAll, 74}, Case{kMoveA, kWaitAll, 54}}) {
    for (const Firmware firmware : kVersions) {
      SCOPED_TRACE(std::to_string(row.wait) + ", firmware " + std::to_string(firmware));
      ProgramHost host(firmware);
      host.write_32(0x8000, 30);
      host.write_32(0x8002, 50);
      host.start(move_and_wait(row.move, row.wait, 7));
      const Tick out = row.moved + 2;
      // From 1.40: to flag 7 in slot 16; slot 18 has the wait without a flag, which holds its line.
      const ProgramCourse course = firmware <= 139
                                       ? ProgramCourse{.outputs = {out, kNone, kNone}, .end = out + 2}
                                       : ProgramCourse{.outputs = {kNone, 16, out}, .end = out + 2};
      ASSERT_NO_FATAL_FAILURE(host.expect(course, 120));
      EXPECT_EQ(host.value_32(0x0E04), 30);
      EXPECT_EQ(host.value_32(0x0E06), row.move == kMoveAll ? 50 : 0);
    }
  }
}

TEST(FirmwareWaitMove, AWaitForAFlagThatNoLineHasHoldsItsLineInAll) {
  for (const std::uint16_t flag : {0, 1, 64, 65, 255}) {
    for (const Firmware firmware : kVersions) {
      for (const bool all : {false, true}) {
        SCOPED_TRACE(std::to_string(flag) + ", firmware " + std::to_string(firmware));
        ProgramHost host(firmware);
        host.write_32(0x8000, 30);
        host.write_32(0x8002, 50);
        host.start(move_and_wait(all ? kMoveAll : kMoveA, all ? kWaitAll : kWaitA, flag));
        const Tick out = all ? 76 : 56;
        ASSERT_NO_FATAL_FAILURE(host.expect({.outputs = {out, kNone, kNone}, .end = out + 2}, 120));
      }
    }
  }
}

TEST(FirmwareWaitMove, AWaitThatIsItsOwnFlagTakesTheSameTimeInAll) {
  for (const Firmware firmware : kVersions) {
    ProgramHost host(firmware);
    host.write_32(0x8000, 30);
    host.start(program_lines({{kMoveA, 0, 0, 0}, {kWaitA, 5, 0, 5}, {kOut, 0, 1, 0}, {kEnd, 0, 0, 0}}));
    ASSERT_NO_FATAL_FAILURE(host.expect({.outputs = {56, kNone, kNone}, .end = 58}, 120)) << firmware;
  }
}

TEST(FirmwareWaitMove, From140AWaitCanWorkMeanwhile) {
  // Counter1 goes up in slots 14, 18, 22, ... and the wait jumps back in 16, 20, ...; slot 52 is the last one
  // that sees it move, so there are counts up to slot 54: 11.
  for (const Firmware firmware : kVersions) {
    ProgramHost host(firmware);
    host.write_32(0x8000, 30);
    host.start(program_lines({{kMoveA, 0, 0, 0}, {kCountUp, 1, 0, 3}, {kWaitA, 3, 0, 0}, {kEnd, 0, 0, 0}}));
    // Until 1.39 the wait holds from slot 16 on, and slot 54 finds the end.
    ASSERT_NO_FATAL_FAILURE(host.expect({.end = firmware <= 139 ? 56 : 58}, 120)) << firmware;
    EXPECT_EQ(host.word(0xF122), firmware <= 139 ? 1 : 11) << firmware;
  }
}

TEST(FirmwareWaitMove, AWaitForAnAxisAtRestOrInAnotherModeContinuesInAll) {
  for (const Firmware firmware : kVersions) {
    for (const std::uint16_t before : {0x00, 0x84}) {  // NOP; VelmRPM_A of MEM0, which is not a position move
      ProgramHost host(firmware);
      host.write_32(0x8000, 30'000);
      host.start(program_lines({{before, 0, 0, 0},
                                {kWaitA, 7, 0, 0},
                                {kWaitAll, 7, 0, 0},
                                {kOut, 0, 1, 0},
                                {kEnd, 0, 0, 0},
                                {kOut, 1, 1, 7},
                                {kEnd, 0, 0, 0}}));
      ASSERT_NO_FATAL_FAILURE(host.expect({.outputs = {18, kNone, kNone}, .end = 20}, 60)) << firmware;
    }
  }
}

// --- Wait_Move_B ---

// B begins 30 pulses in slot 12; the delay leads to slot 34, where it has gone 16: 22 - 1 ms, less 5.
world::Words move_b_and_wait(std::uint16_t flag, std::uint16_t flag_of_last) {
  return program_lines({{kMoveB, 0, 0, 0},   // slot 12
                        {kDelay, 20, 0, 0},  // slot 14: the next line in slot 34
                        {kWaitB, flag, 0, 0},
                        {kOut, 0, 1, 0},
                        {kEnd, 0, 0, 0},
                        {kOut, 1, 1, flag_of_last},
                        {kEnd, 0, 0, 0}});
}

struct Parameter {
  std::uint16_t number;  // as DATA1 of Wait_Move_B; 1 to 64 are flags as well
  std::size_t address;
};
// MEM5, VAR40 (PROG_VAR8), DAT64 (Parms_Pulse1), Cord_A.
constexpr Parameter kParameters[] = {{5, 0x800A}, {40, 0x8110}, {64, 0x2000}, {154, 0x0E04}};

TEST(FirmwareWaitMove, Until139WaitMoveBMovesByTheParameterThatItsFlagIs) {
  struct Case {
    Value by;
    std::int32_t ends_at;
    Tick ended;  // the slot that finds it
  };
  // From 16: 20 more take 30 ms, to tick 64; 20 back as long; 0 ends what moves at once.
  for (const Case& row : {Case{20, 36, 66}, Case{-20, -4, 66}, Case{0, 16, 36}}) {
    for (const Parameter& parameter : kParameters) {
      SCOPED_TRACE(std::to_string(row.by) + " by parameter " + std::to_string(parameter.number));
      ProgramHost host(139);
      host.write_32(0x8000, 30);
      host.write_32(parameter.address, row.by);
      host.start(move_b_and_wait(parameter.number, parameter.number));
      ASSERT_NO_FATAL_FAILURE(
          host.expect({.outputs = {row.ended + 2, kNone, kNone}, .end = row.ended + 4}, 120));
      EXPECT_EQ(host.value_32(0x0E06), row.ends_at);
    }
  }
}

TEST(FirmwareWaitMove, Until139WaitMoveBMovesAnAxisAtRestToo) {
  ProgramHost host(139);
  host.write_32(0x8000, 30);
  host.start(program_lines({{kWaitB, 0, 0, 0}, {kOut, 0, 1, 0}, {kEnd, 0, 0, 0}}));
  ASSERT_NO_FATAL_FAILURE(host.expect({.outputs = {56, kNone, kNone}, .end = 58}, 120));
  EXPECT_EQ(host.value_32(0x0E06), 30);
}

TEST(FirmwareWaitMove, From140WaitMoveBJumpsLikeTheOthers) {
  for (const Firmware firmware : kVersions) {
    if (firmware <= 139) continue;
    for (const Parameter& parameter : kParameters) {
      for (const bool flag_is_there : {true, false}) {
        SCOPED_TRACE(std::to_string(parameter.number) + ", firmware " + std::to_string(firmware));
        ProgramHost host(firmware);
        host.write_32(0x8000, 30);
        host.write_32(parameter.address, 20);
        host.start(move_b_and_wait(parameter.number, flag_is_there ? parameter.number : 0));
        // Beyond 64 there are no flags: it holds its line until slot 54.
        const ProgramCourse course = flag_is_there && parameter.number <= 64
                                         ? ProgramCourse{.outputs = {kNone, 36, kNone}, .end = 38}
                                         : ProgramCourse{.outputs = {56, kNone, kNone}, .end = 58};
        ASSERT_NO_FATAL_FAILURE(host.expect(course, 120));
        EXPECT_EQ(host.value_32(0x0E06), 30);
      }
    }
  }
}

TEST(FirmwareWaitMove, TheChoiceToBelieveThatItWaitsIsOneFor139Only) {
  for (const Firmware firmware : kVersions) {
    ProgramHost host(firmware, {{"wait_move_b_139", "waits"}});
    host.write_32(0x8000, 30);
    host.write_32(0x800A, 20);
    host.start(move_b_and_wait(5, 5));
    const ProgramCourse course = firmware <= 139 ? ProgramCourse{.outputs = {56, kNone, kNone}, .end = 58}
                                                 : ProgramCourse{.outputs = {kNone, 36, kNone}, .end = 38};
    ASSERT_NO_FATAL_FAILURE(host.expect(course, 120)) << firmware;
    EXPECT_EQ(host.value_32(0x0E06), 30);
  }
}

}  // namespace firmware_wait_move_test
}  // namespace understudy::emulator::models::simple2_r3
