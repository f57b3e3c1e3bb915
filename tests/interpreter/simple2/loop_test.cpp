// Loop (0x04): traces calculated by hand. Counters are parameters 171 and 172, and the lines below count with
// VAR_Inc (0x6B), because a test can read the scripted machine's parameters.
#include "tests/interpreter/simple2/scripted_machine.h"

namespace understudy::interpreter::simple2 {
namespace loop_test {

/// Counts its passes in MEM0 and ends.
Program passes_of(std::uint8_t count) {
  return program_of(
      {{0x00, 0, 0, 0}, {0x6B, 0, 0, 1}, {0x00, 0, 0, 0}, {0x04, 1, count, 0}, {0xFF, 0, 0, 0}});
}

int passes(std::uint8_t count, Dialect dialect = {}) {
  ProgramRun run(passes_of(count));
  run.dialect = dialect;
  run.to_the_end();
  EXPECT_EQ(run.execution.ending, Ending::end_instruction);
  return run.machine.parameters[0];
}

TEST(Simple2Loop, RunsItsBodyAsOftenAsItSays) {
  EXPECT_EQ(passes(1), 1);
  EXPECT_EQ(passes(2), 2);
  EXPECT_EQ(passes(3), 3);
  EXPECT_EQ(passes(255), 255);
}

TEST(Simple2Loop, MayCountFurtherPassesInstead) {
  Dialect dialect;
  dialect.loop_count = Dialect::LoopCount::further_passes;
  EXPECT_EQ(passes(1, dialect), 2);
  EXPECT_EQ(passes(3, dialect), 4);
  EXPECT_EQ(passes(255, dialect), 256);
}

TEST(Simple2Loop, Of0IsEndless) {
  ProgramRun run(passes_of(0));
  run.until(2 + 6 * 1000);  // line 0, then 1000 passes of three lines
  EXPECT_TRUE(run.execution.running);
  EXPECT_EQ(run.machine.parameters[0], 1000);
}

TEST(Simple2Loop, OnAFlagThatIsNotBeforeItIsVoid) {
  for (const std::uint8_t flag_line : {2, 3}) {
    Lines lines{};
    lines[0] = {0x6B, 0, 0, 0};
    lines[2] = {0x04, 1, 5, 0};
    lines[3] = {0xFF, 0, 0, 0};
    lines[flag_line].flag = 1;
    ProgramRun run{Program(lines)};
    run.to_the_end();
    EXPECT_EQ(run.next_slot_ms, 8) << int{flag_line};
    EXPECT_EQ(run.machine.parameters[0], 1);
  }
}

TEST(Simple2Loop, OnAFlagThatNoLineHasGoesBackToLine0) {
  ProgramRun run(program_of({{0x6B, 0, 0, 0}, {0x04, 20, 4, 0}, {0xFF, 0, 0, 0}}));
  run.to_the_end();
  EXPECT_EQ(run.machine.parameters[0], 4);

  ProgramRun in_line_0(program_of({{0x04, 20, 4, 0}, {0xFF, 0, 0, 0}}));  // there it is void
  in_line_0.to_the_end();
  EXPECT_EQ(in_line_0.next_slot_ms, 4);
}

TEST(Simple2Loop, CanFollowAnother) {
  ProgramRun run(
      program_of({{0x6B, 0, 0, 1}, {0x04, 1, 3, 0}, {0x6B, 1, 0, 2}, {0x04, 2, 4, 0}, {0xFF, 0, 0, 0}}));
  run.to_the_end();
  EXPECT_EQ(run.machine.parameters[0], 3);
  EXPECT_EQ(run.machine.parameters[1], 4);
}

TEST(Simple2Loop, RestartsWhenItIsReachedAgainAfterItsEnd) {
  // 0: MEM0++ (flag 1); 1: Loop 1 x3; 2: MEM1++; 3: MEM1 < 2? then 4: Jump 1; else 5: END
  ProgramRun run(program_of({{0x6B, 0, 0, 1},
                             {0x04, 1, 3, 0},
                             {0x6B, 1, 0, 0},
                             {0x92, 1, 2, 0},
                             {0x03, 1, 0, 0},
                             {0xFF, 0, 0, 0}}));
  run.to_the_end();
  EXPECT_EQ(run.machine.parameters[0], 6);
}

// 0 (flag 1): MEM0++; 1 (flag 2): MEM1++; 2: Loop 2 x2; 3: Loop 1 x OUTER; 4: END
Program nested(std::uint8_t outer) {
  return program_of(
      {{0x6B, 0, 0, 1}, {0x6B, 1, 0, 2}, {0x04, 2, 2, 0}, {0x04, 1, outer, 0}, {0xFF, 0, 0, 0}});
}

TEST(Simple2Loop, InsideACountingLoopEndsTheProgram) {
  ProgramRun run(nested(3));
  run.to_the_end();
  EXPECT_EQ(run.execution.ending, Ending::nested_loop);
  EXPECT_EQ(run.execution.now_line, 2);  // in the outer loop's second pass
  EXPECT_EQ(run.machine.parameters[0], 2);
  EXPECT_EQ(run.machine.parameters[1], 3);
  EXPECT_EQ(run.next_slot_ms, 2 * 9);  // 0 1 2 1 2 3 0 1 2
}

TEST(Simple2Loop, InsideALoopThatDoesNotRepeatDoesNoHarm) {
  ProgramRun run(nested(1));
  run.to_the_end();
  EXPECT_EQ(run.execution.ending, Ending::end_instruction);
  EXPECT_EQ(run.machine.parameters[1], 2);
}

TEST(Simple2Loop, InsideAnotherMayAlsoEndTheProgramAtTheOuterOne) {
  for (const std::uint8_t outer : {0, 1, 3}) {
    ProgramRun run(nested(outer));
    run.dialect.loop_nesting = Dialect::LoopNesting::when_outer_starts;
    run.to_the_end();
    EXPECT_EQ(run.execution.ending, Ending::nested_loop);
    EXPECT_EQ(run.execution.now_line, 3);
    EXPECT_EQ(run.machine.parameters[0], 1);
    EXPECT_EQ(run.machine.parameters[1], 2);
  }
}

TEST(Simple2Loop, ThatIsVoidIsNoLoopInsideAnother) {
  // 0 (flag 1): MEM0++; 1: Loop 5 (line 3: void); 2: Loop 1 x3; 3 (flag 5): END
  for (const auto nesting : {Dialect::LoopNesting::when_met, Dialect::LoopNesting::when_outer_starts}) {
    ProgramRun run(program_of({{0x6B, 0, 0, 1}, {0x04, 5, 2, 0}, {0x04, 1, 3, 0}, {0xFF, 0, 0, 5}}));
    run.dialect.loop_nesting = nesting;
    run.to_the_end();
    EXPECT_EQ(run.execution.ending, Ending::end_instruction);
    EXPECT_EQ(run.machine.parameters[0], 3);
  }
}

// 0 (flag 1): MEM0++; 1: DIN 0 ON? to flag 2; 2: Loop 1 x3; 3: END; 4 (flag 2): NOP; 5: Jump flag 1
int passes_with_a_way_out(Dialect::LoopLeft left) {
  ProgramRun run(program_of({{0x6B, 0, 0, 1},
                             {0x10, 2, 0, 0},
                             {0x04, 1, 3, 0},
                             {0xFF, 0, 0, 0},
                             {0x00, 0, 0, 2},
                             {0x03, 1, 0, 0}}));
  run.dialect.loop_left = left;
  run.until(8);
  run.machine.inputs = 1;  // in the second pass, line 1 at 8 ms leaves the loop
  run.until(10);
  run.machine.inputs = 0;
  run.to_the_end();
  return run.machine.parameters[0];
}

TEST(Simple2Loop, LeftByAJumpForgetsItsCount) {
  EXPECT_EQ(passes_with_a_way_out(Dialect::LoopLeft::forgotten), 2 + 3);
  EXPECT_EQ(passes_with_a_way_out(Dialect::LoopLeft::remembered), 2 + 2);
}

// 0 (flag 1): MEM0++; 1: MEM5 == 0? else skip; 2: Loop 1 x3; 3: MEM6 == 0? then 4: Jump flag 1; else 5: END
int passes_with_a_skip(Dialect::LoopLeft left) {
  ProgramRun run(program_of({{0x6B, 0, 0, 1},
                             {0x90, 5, 0, 0},
                             {0x04, 1, 3, 0},
                             {0x90, 6, 0, 0},
                             {0x03, 1, 0, 0},
                             {0xFF, 0, 0, 0}}));
  run.dialect.loop_left = left;
  run.until(8);
  run.machine.parameters[5] = 1;  // in the second pass, line 1 at 8 ms skips the Loop
  run.until(12);
  run.machine.parameters[5] = 0;
  run.until(14);
  run.machine.parameters[6] = 1;
  run.to_the_end();
  return run.machine.parameters[0];
}

TEST(Simple2Loop, LeftByASkipForgetsItsCount) {
  EXPECT_EQ(passes_with_a_skip(Dialect::LoopLeft::forgotten), 2 + 3);
  EXPECT_EQ(passes_with_a_skip(Dialect::LoopLeft::remembered), 2 + 2);
}

// 0 (flag 2): NOP; 1 (flag 1): MEM0++; 2: DIN 0 ON? to flag 2; 3: Loop 1 x3; 4: END
int passes_with_a_way_back(Dialect::LoopLeft left) {
  ProgramRun run(
      program_of({{0x00, 0, 0, 2}, {0x6B, 0, 0, 1}, {0x10, 2, 0, 0}, {0x04, 1, 3, 0}, {0xFF, 0, 0, 0}}));
  run.dialect.loop_left = left;
  run.until(10);
  run.machine.inputs = 1;  // in the second pass, line 2 at 10 ms leaves the loop for the line before it
  run.until(12);
  run.machine.inputs = 0;
  run.to_the_end();
  return run.machine.parameters[0];
}

TEST(Simple2Loop, LeftForALineBeforeItForgetsItsCount) {
  EXPECT_EQ(passes_with_a_way_back(Dialect::LoopLeft::forgotten), 2 + 3);
  EXPECT_EQ(passes_with_a_way_back(Dialect::LoopLeft::remembered), 2 + 2);
}

TEST(Simple2Loop, ThatRemembersRestartsAfterItsEndAsWell) {
  // 0 (flag 1): MEM0++; 1: Loop 1 x3; 2: MEM1++; 3: MEM1 < 2? then 4: Jump 1; else 5: END
  ProgramRun run(program_of({{0x6B, 0, 0, 1},
                             {0x04, 1, 3, 0},
                             {0x6B, 1, 0, 0},
                             {0x92, 1, 2, 0},
                             {0x03, 1, 0, 0},
                             {0xFF, 0, 0, 0}}));
  run.dialect.loop_left = Dialect::LoopLeft::remembered;
  run.to_the_end();
  EXPECT_EQ(run.machine.parameters[0], 6);
}

TEST(Simple2Loop, OutsideOneThatIsRememberedIsNotInsideIt) {
  // 0 (flag 1): MEM0++; 1: Loop 1 x2; 2: END; 3 (flag 2): MEM1++; 4: Jump flag 3 if DIN 0; 5: Loop 2 x9;
  // 6 (flag 3): MEM2++; 7: Loop 3 x2; 8: Jump flag 1
  const Program program = program_of({{0x6B, 0, 0, 1},
                                      {0x04, 1, 2, 0},
                                      {0xFF, 0, 0, 0},
                                      {0x6B, 1, 0, 2},
                                      {0x10, 3, 0, 0},
                                      {0x04, 2, 9, 0},
                                      {0x6B, 2, 0, 3},
                                      {0x04, 3, 2, 0},
                                      {0x03, 1, 0, 0}});
  ProgramRun after(program, 3);
  after.dialect.loop_left = Dialect::LoopLeft::remembered;
  after.until(8);
  after.machine.inputs = 1;  // in the second pass, line 4 jumps to line 6: the Loop of line 7 is after it
  after.to_the_end();
  EXPECT_EQ(after.execution.ending, Ending::end_instruction);
  EXPECT_EQ(after.machine.parameters[2], 2);

  ProgramRun before(program, 3);
  before.dialect.loop_left = Dialect::LoopLeft::remembered;
  before.program.set_cell(4 * 4 + 1, 1);  // line 4 jumps to line 0: the Loop of line 1 is before it
  before.until(8);
  before.machine.inputs = 1;
  before.to_the_end();
  EXPECT_EQ(before.execution.ending, Ending::end_instruction);
  EXPECT_EQ(before.machine.parameters[0], 2);
}

TEST(Simple2Loop, LeftForAnotherLoopLetsThatOneCount) {
  // 0 (flag 1): MEM0++; 1: Jump flag 2 if DIN 0; 2: Loop 1 x0; 3 (flag 2): MEM1++; 4: Loop 2 x4; 5: END
  ProgramRun run(program_of({{0x6B, 0, 0, 1},
                             {0x10, 2, 0, 0},
                             {0x04, 1, 0, 0},
                             {0x6B, 1, 0, 2},
                             {0x04, 2, 4, 0},
                             {0xFF, 0, 0, 0}}));
  run.until(60);
  run.machine.inputs = 1;
  run.to_the_end();
  EXPECT_EQ(run.execution.ending, Ending::end_instruction);
  EXPECT_EQ(run.machine.parameters[1], 4);
}

TEST(Simple2Loop, IsForgottenByAStart) {
  ProgramRun run(passes_of(3));
  run.until(10);  // in the second pass
  run.machine.parameters[0] = 0;
  start(run.execution, 0);
  run.to_the_end();
  EXPECT_EQ(run.machine.parameters[0], 3);
}

TEST(Simple2Loop, WithADelayInItsBodyKeepsItsCount) {
  ProgramRun run(program_of({{0x6B, 0, 0, 1}, {0x02, 50, 0, 0}, {0x04, 1, 3, 0}, {0xFF, 0, 0, 0}}));
  run.to_the_end();
  EXPECT_EQ(run.machine.parameters[0], 3);
  EXPECT_EQ(run.next_slot_ms, 3 * (2 + 50 + 2) + 2);
}

}  // namespace loop_test
}  // namespace understudy::interpreter::simple2
