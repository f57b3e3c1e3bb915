// When lines are executed: one in each slot of 2 ms.
#include "tests/interpreter/simple2/scripted_machine.h"

namespace understudy::interpreter::simple2 {
namespace timing_test {

using Trace =
    std::vector<std::pair<std::int64_t, int>>;  // ms, line; the times at which the present line changed

Trace trace_to_the_end(ProgramRun& run) {
  Trace trace;
  int last = -1;
  for (int slots = 0; run.execution.running && slots < 10000; ++slots) {
    const std::int64_t ms = run.next_slot_ms;
    run.slot();
    if (run.execution.now_line != last) trace.emplace_back(ms, run.execution.now_line);
    last = run.execution.now_line;
  }
  return trace;
}

/// When the line after a delay in line 0 is executed.
std::int64_t next_line_after_delay_ms(int amount_ms, Dialect::DelayCounts counts = {}) {
  ProgramRun run(
      program_of({{0x02, static_cast<std::uint8_t>(amount_ms), static_cast<std::uint8_t>(amount_ms >> 8), 0},
                  {0x00, 0, 0, 0},
                  {0xFF, 0, 0, 0}}));
  run.dialect.delay_counts = counts;
  int max = 50000;
  while (run.execution.now_line == 0 && max-- > 0) run.slot();
  return run.next_slot_ms - kSlotMs;
}

TEST(Simple2Timing, ABlinkingOutputFollowsTheTraceWorkedOutByHand) {
  ProgramRun run(program_of({{0x05, 0, 1, 1},     // 0: Out 0 ON, flag 1
                             {0x02, 100, 0, 0},   // 1: Delay 100 ms
                             {0x05, 0, 0, 0},     // 2: Out 0 OFF
                             {0x02, 100, 0, 0},   // 3: Delay 100 ms
                             {0x04, 1, 3, 0},     // 4: Loop flag 1, 3
                             {0xFF, 0, 0, 0}}));  // 5: END
  const Trace wanted = {{0, 0},   {2, 1},   {102, 2}, {104, 3}, {204, 4}, {206, 0}, {208, 1}, {308, 2},
                        {310, 3}, {410, 4}, {412, 0}, {414, 1}, {514, 2}, {516, 3}, {616, 4}, {618, 5}};
  EXPECT_EQ(trace_to_the_end(run), wanted);
  EXPECT_EQ(run.execution.ending, Ending::end_instruction);
  EXPECT_EQ(
      run.machine.take_calls(),
      "outputs 0000001; outputs 0000000; outputs 0000001; outputs 0000000; outputs 0000001; outputs 0000000");
}

TEST(Simple2Timing, AfterADelayTheNextLineTakesTheFirstSlotDue) {
  const std::vector<std::pair<int, std::int64_t>> wanted = {
      {0, 2},     {1, 2},     {2, 2},     {3, 4},       {4, 4},        {5, 6},
      {255, 256}, {256, 256}, {257, 258}, {1500, 1500}, {65535, 65536}};
  for (const auto& [amount_ms, next_line_ms] : wanted) {
    EXPECT_EQ(next_line_after_delay_ms(amount_ms), next_line_ms) << amount_ms;
  }
}

TEST(Simple2Timing, ADelayMayAlsoBeCountedBeforeTheSlotOfTheNextLine) {
  const auto counts = Dialect::DelayCounts::before_next_slot;
  EXPECT_EQ(next_line_after_delay_ms(0, counts), 2);
  EXPECT_EQ(next_line_after_delay_ms(1, counts), 4);
  EXPECT_EQ(next_line_after_delay_ms(100, counts), 102);
}

TEST(Simple2Timing, ADelayFromAParameterEndsAt65535ms) {
  ProgramRun run(program_of({{0x07, 5, 0, 0}, {0xFF, 0, 0, 0}}));
  run.machine.parameters[5] = INT32_MAX;
  run.until(65536);
  EXPECT_EQ(run.execution.now_line, 0);
  run.slot();
  EXPECT_FALSE(run.execution.running);
}

TEST(Simple2Timing, AWaitEndsInItsOwnSlotAndTheNextLineComesOneLater) {
  ProgramRun run(program_of({{0x01, 2, 1, 0}, {0x05, 0, 1, 0}}));
  run.until(10);
  EXPECT_TRUE(run.machine.calls.empty());
  run.machine.inputs = 1 << 2;
  run.slot();  // 10 ms: found ON
  EXPECT_TRUE(run.machine.calls.empty());
  run.machine.inputs = 0;  // too late to matter
  run.slot();
  EXPECT_EQ(run.machine.take_calls(), "outputs 0000001");
}

TEST(Simple2Timing, AMoveOf100msIsSeenAt102AndTheNextLineComesAt104) {
  ProgramRun run(program_of({{0x25, 5, 0, 0}, {0x05, 0, 1, 0}}));
  run.slot();  // 0 ms: the move starts
  run.machine.moving_a = true;
  run.until(102);                // slot 100 runs before the axis in its tick
  run.machine.moving_a = false;  // ended in tick 100
  run.slot();
  EXPECT_EQ(run.machine.take_calls(), "A by 0");
  EXPECT_EQ(run.next_slot_ms, 104);
  run.slot();
  EXPECT_EQ(run.machine.take_calls(), "outputs 0000001");
}

TEST(Simple2Timing, AMoveThatIsOverAtOnceStillTakesASlotToBeSeen) {
  ProgramRun run(program_of({{0x28, 0, 0, 0}, {0x05, 0, 1, 0}}));
  run.until(4);
  EXPECT_EQ(run.machine.take_calls(), "A home");
  run.slot();
  EXPECT_EQ(run.machine.take_calls(), "outputs 0000001");
}

TEST(Simple2Timing, AMoveOfBothAxesIsWaitedForUntilTheSlowerOneIsOver) {
  ProgramRun run(program_of({{0x45, 5, 6, 0}, {0x05, 0, 1, 0}}));
  run.slot();
  run.machine.moving_a = run.machine.moving_b = true;
  run.until(50);
  run.machine.moving_a = false;
  run.until(100);
  EXPECT_EQ(run.execution.now_line, 0);
  run.machine.moving_b = false;
  run.until(104);
  EXPECT_EQ(run.execution.now_line, 1);
}

TEST(Simple2Timing, AMoveThatNeverEndsIsWaitedForWithoutEnd) {
  ProgramRun run(program_of({{0x20, 5, 0, 0}, {0x24, 0, 0, 0}, {0xFF, 0, 0, 0}}));
  run.machine.moving_a = true;  // speed 0
  run.until(100000);
  EXPECT_TRUE(run.execution.running);
  EXPECT_EQ(run.execution.now_line, 1);
}

TEST(Simple2Timing, AProgramEndsAfterItsLastLine) {
  ProgramRun run{Program{}};
  run.until(512);
  EXPECT_TRUE(run.execution.running);
  EXPECT_EQ(run.execution.now_line, 255);
  run.slot();
  EXPECT_FALSE(run.execution.running);
  EXPECT_EQ(run.execution.ending, Ending::past_last_line);
  EXPECT_EQ(run.execution.now_line, 255);
}

TEST(Simple2Timing, ASkipOrADelayOutOfTheLastLineEndsTheProgram) {
  Lines lines{};
  lines[255] = {0x90, 5, 1, 0};  // VAR_DirectEQ MEM5 1, which is false
  ProgramRun skip(Program(lines), 255);
  skip.until(4);
  EXPECT_EQ(skip.execution.ending, Ending::past_last_line);

  lines[255] = {0x02, 10, 0, 0};
  ProgramRun delay(Program(lines), 255);
  delay.until(10);
  EXPECT_TRUE(delay.execution.running);
  delay.slot();
  EXPECT_EQ(delay.execution.ending, Ending::past_last_line);
}

TEST(Simple2Timing, AProgramMayAlsoContinueAtLine0) {
  Lines lines{};
  lines[254] = {0x90, 5, 1, 0};
  ProgramRun run(Program(lines), 254);
  run.dialect.after_last_line = Dialect::AfterLastLine::goes_on_at_0;
  run.until(4);
  EXPECT_EQ(run.execution.now_line, 0);
  run.until(4 + 2 * 254);
  EXPECT_EQ(run.execution.now_line, 254);
  run.slot();
  EXPECT_EQ(run.execution.now_line, 0);
}

TEST(Simple2Timing, StartRestartsWhateverIsRunning) {
  ProgramRun run(program_of({{0x02, 0xFF, 0xFF, 0}, {0x05, 0, 1, 0}}));
  run.until(100);
  start(run.execution, 1);
  EXPECT_EQ(run.execution.now_line, 1);
  run.slot();
  EXPECT_EQ(run.machine.take_calls(), "outputs 0000001");

  ProgramRun waiting(program_of({{0x25, 5, 0, 0}, {0x05, 0, 1, 0}}));
  waiting.slot();
  waiting.machine.moving_a = true;
  start(waiting.execution, 1);
  waiting.slot();
  EXPECT_EQ(waiting.machine.take_calls(), "A by 0; outputs 0000001");
}

TEST(Simple2Timing, StopEndsAProgramAndNothingElse) {
  ProgramRun run(program_of({{0x20, 5, 0, 0}, {0x02, 100, 0, 0}, {0x05, 0, 1, 0}}));
  run.until(50);
  stop(run.execution);
  EXPECT_FALSE(run.execution.running);
  EXPECT_EQ(run.execution.ending, Ending::stopped);
  EXPECT_EQ(run.execution.now_line, 1);
  run.until(200);
  EXPECT_EQ(run.machine.take_calls(), "A by 0");

  const Execution over = run.execution;
  stop(run.execution);
  EXPECT_EQ(run.execution, over);
}

TEST(Simple2Timing, StopLeavesAProgramThatIsOverAsItWas) {
  ProgramRun run(program_of({{0xFF, 0, 0, 0}}));
  run.slot();
  stop(run.execution);
  EXPECT_EQ(run.execution.ending, Ending::end_instruction);
}

TEST(Simple2Timing, ALineRewrittenWhileItWaitsIsReadAgain) {
  for (const Line& waits : {Line{0x01, 0, 1, 0}, Line{0x02, 100, 0, 0}}) {  // Wait_IO, Delay_mSec
    ProgramRun run(program_of({waits, {0x05, 0, 1, 0}}));
    run.until(10);
    EXPECT_EQ(run.execution.now_line, 0);
    run.program.set_cell(0, 0x00);  // NOP
    run.until(12);
    EXPECT_EQ(run.execution.now_line, 0);
    run.slot();
    EXPECT_EQ(run.execution.now_line, 1);
  }
}

}  // namespace timing_test
}  // namespace understudy::interpreter::simple2
