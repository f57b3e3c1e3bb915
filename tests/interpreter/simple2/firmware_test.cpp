// The effects of the firmware version.
#include "tests/interpreter/simple2/scripted_machine.h"

namespace understudy::interpreter::simple2 {
namespace firmware_test {

constexpr int kVersions[] = {130, 139, 140, 141, 142, 150, 151, 152};

/// One line in line 10, with flag 7 on line 40, in a firmware.
ProgramRun run_of(int firmware, const Line& line) {
  Lines lines{};
  lines[10] = line;
  lines[40].flag = 7;
  ProgramRun run(Program(lines), 10);
  run.dialect = dialect_of_firmware(firmware);
  return run;
}

TEST(Simple2Firmware, UpTo139WaitMoveAAndAllWaitAndTakeNoFlag) {
  for (const int firmware : kVersions) {
    for (const std::uint8_t opcode : {0x24, 0x44}) {
      ProgramRun run = run_of(firmware, {opcode, 7, 0, 0});
      run.machine.moving_a = true;
      run.until(100);
      EXPECT_EQ(run.execution.now_line == 10, firmware <= 139) << firmware;
      if (firmware > 139) continue;
      run.machine.moving_a = false;
      run.slot();
      run.slot();
      EXPECT_EQ(run.execution.now_line, 11) << firmware;
    }
  }
}

TEST(Simple2Firmware, From140WaitMoveGoesToItsFlagInTheNextSlot) {
  for (const std::uint8_t opcode : {0x24, 0x34, 0x44}) {
    ProgramRun run = run_of(140, {opcode, 7, 0, 0});
    run.machine.moving_a = run.machine.moving_b = true;
    run.until(4);
    EXPECT_EQ(run.execution.now_line, 40) << int{opcode};
  }
}

TEST(Simple2Firmware, UpTo139WaitMoveBMovesByTheParameterThatIsItsFlag) {
  for (const int firmware : kVersions) {
    ProgramRun run = run_of(firmware, {0x34, 7, 0, 0});
    run.machine.parameters[7] = 1234;
    run.slot();
    EXPECT_EQ(run.machine.take_calls(), firmware <= 139 ? "B by 1234" : "") << firmware;
    if (firmware > 139) continue;
    run.machine.moving_b = true;
    run.until(100);
    EXPECT_EQ(run.execution.now_line, 10);
    run.machine.moving_b = false;
    run.until(104);
    EXPECT_EQ(run.execution.now_line, 11);
  }
}

TEST(Simple2Firmware, UpTo139WaitMoveBMayAlsoBeBelievedToWait) {
  ProgramRun run = run_of(139, {0x34, 7, 0, 0});
  run.dialect.quirk_wait_move_b_is_move_inc_b_wait = false;
  run.machine.moving_b = true;
  run.until(100);
  EXPECT_EQ(run.machine.take_calls(), "");
  EXPECT_EQ(run.execution.now_line, 10);
  run.machine.moving_b = false;
  run.until(104);
  EXPECT_EQ(run.execution.now_line, 11);
}

TEST(Simple2Firmware, UpTo141JumpTimer1NeverJumpsAndJumpTimer2Does) {
  for (const int firmware : kVersions) {
    ProgramRun timer1 = run_of(firmware, {0x1A, 7, 5, 0});
    timer1.machine.parameters[173] = 1000;
    timer1.until(4);
    EXPECT_EQ(timer1.execution.now_line, firmware <= 141 ? 11 : 40) << firmware;

    ProgramRun timer2 = run_of(firmware, {0x1B, 7, 5, 0});
    timer2.machine.parameters[174] = 1000;
    timer2.until(4);
    EXPECT_EQ(timer2.execution.now_line, 40) << firmware;
  }
}

TEST(Simple2Firmware, From142NothingIsLeftOfTheDefects) {
  EXPECT_EQ(dialect_of_firmware(142), Dialect{});
  EXPECT_EQ(dialect_of_firmware(152), Dialect{});
}

}  // namespace firmware_test
}  // namespace understudy::interpreter::simple2
