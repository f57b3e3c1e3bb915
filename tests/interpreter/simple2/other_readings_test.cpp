// Impossible flags, comparisons of timers, waits that are cut short: our option, and the others.
#include "tests/interpreter/simple2/scripted_machine.h"

namespace understudy::interpreter::simple2 {
namespace other_readings_test {

/// Counts its passes in MEM0: endlessly, if the jump leads back to line 0.
int passes_with_jump_to(std::uint8_t flag, Dialect::UndefinedFlag reading) {
  ProgramRun run(program_of({{0x6B, 0, 0, 0}, {0x03, flag, 0, 0}, {0xFF, 0, 0, 0}}));
  run.dialect.undefined_flag = reading;
  run.until(100);
  return run.machine.parameters[0];
}

int passes_with_loop_to(std::uint8_t flag, Dialect::UndefinedFlag reading) {
  ProgramRun run(program_of({{0x6B, 0, 0, 0}, {0x04, flag, 3, 0}, {0xFF, 0, 0, 0}}));
  run.dialect.undefined_flag = reading;
  run.to_the_end();
  return run.machine.parameters[0];
}

TEST(Simple2OtherReadings, AFlagThatCannotBeIsLine0OrVoid) {
  using enum Dialect::UndefinedFlag;
  for (const std::uint8_t flag : {0, 65, 255}) {
    EXPECT_EQ(passes_with_loop_to(flag, line_0), 3) << int{flag};
    EXPECT_EQ(passes_with_loop_to(flag, line_void), 1) << int{flag};
    EXPECT_GT(passes_with_jump_to(flag, line_0), 1) << int{flag};
    EXPECT_EQ(passes_with_jump_to(flag, line_void), 1) << int{flag};
  }
  for (const std::uint8_t flag : {1, 64}) {
    EXPECT_EQ(passes_with_loop_to(flag, line_void), 3) << "no line has it, but one might";
    EXPECT_GT(passes_with_jump_to(flag, line_void), 1) << int{flag};
  }
}

TEST(Simple2OtherReadings, TimersAreComparedWithoutASignOrWith) {
  struct Case {
    std::int32_t timer, limit;
    bool without, with;
  };
  for (const auto& [timer, limit, without, with] :
       {Case{5, -1, false, true}, Case{-1, 5, true, false}, Case{5, 5, true, true}, Case{4, 5, false, false},
        Case{-2, -1, false, false}, Case{INT32_MIN, INT32_MAX, true, false}}) {
    for (const bool has_sign : {false, true}) {
      // Jump_Timer2_GE to line 2, which counts in MEM0; otherwise the end.
      ProgramRun run(program_of({{0x1B, 1, 1, 0}, {0xFF, 0, 0, 0}, {0x6B, 0, 0, 1}, {0xFF, 0, 0, 0}}));
      if (has_sign) run.dialect.timer_compare = Dialect::TimerCompare::with_sign;
      run.machine.parameters[kTimer1 + 1] = timer;
      run.machine.parameters[1] = limit;
      run.to_the_end();
      EXPECT_EQ(run.machine.parameters[0], (has_sign ? with : without) ? 1 : 0) << timer << " " << limit;
    }
  }
}

/// Move_INC_A_Wait or Wait_Move_A, followed by a line that counts in MEM0.
ProgramRun waiting(std::uint8_t opcode, Dialect::WaitCutShort reading) {
  ProgramRun run(program_of({{opcode, 0, 0, 0}, {0x6B, 0, 0, 0}, {0xFF, 0, 0, 0}}));
  run.dialect.wait_cut_short = reading;
  return run;
}

/// A line that waits for one axis, and the state of that axis and of the other one.
struct WaitingLine {
  std::uint8_t opcode;
  bool ScriptedMachine::*moving;
  bool ScriptedMachine::*cut_short;
  bool ScriptedMachine::*other_cut_short;
};

constexpr WaitingLine kWaitsForOneAxis[] = {
    {0x24, &ScriptedMachine::moving_a, &ScriptedMachine::cut_short_a,
     &ScriptedMachine::cut_short_b},  // Wait_Move_A
    {0x25, &ScriptedMachine::moving_a, &ScriptedMachine::cut_short_a,
     &ScriptedMachine::cut_short_b},  // Move_INC_A_Wait
    {0x34, &ScriptedMachine::moving_b, &ScriptedMachine::cut_short_b,
     &ScriptedMachine::cut_short_a},  // Wait_Move_B
    {0x35, &ScriptedMachine::moving_b, &ScriptedMachine::cut_short_b,
     &ScriptedMachine::cut_short_a},  // Move_INC_B_Wait
};

TEST(Simple2OtherReadings, AWaitThatIsCutShortIsOverOrEndsTheProgram) {
  using enum Dialect::WaitCutShort;
  for (const auto reading : {line_is_over, waits_on, program_ends}) {
    for (const auto& [opcode, moving, cut_short, other_cut_short] : kWaitsForOneAxis) {
      for (const bool is_cut : {false, true}) {
        ProgramRun run = waiting(opcode, reading);
        run.machine.*moving = true;
        run.until(20);
        EXPECT_TRUE(run.execution.running) << int{opcode};
        run.machine.*moving = false;
        run.machine.*cut_short = is_cut;
        run.until(40);
        if (is_cut && reading == waits_on) {
          EXPECT_TRUE(run.execution.running) << int{opcode};
          EXPECT_EQ(next_active_slot_ms(run.execution, 40, run.program, run.dialect, run.machine), kNoSlot);
          run.machine.*cut_short = false;  // a later move has completed
          run.until(60);
        }
        const bool ends = is_cut && reading == program_ends;
        EXPECT_EQ(run.machine.parameters[0], ends ? 0 : 1) << int{opcode};
        EXPECT_EQ(run.execution.ending, ends ? Ending::wait_cut_short : Ending::end_instruction);
      }
      // An earlier interruption does not matter, because the line waited for nothing; nor does the other
      // axis.
      ProgramRun before = waiting(opcode, reading);
      before.machine.*cut_short = true;
      before.until(40);
      EXPECT_EQ(before.machine.parameters[0], 1) << int{opcode};
      ProgramRun other = waiting(opcode, reading);
      other.machine.*moving = other.machine.*other_cut_short = true;
      other.until(20);
      other.machine.*moving = false;
      other.until(40);
      EXPECT_EQ(other.machine.parameters[0], 1) << int{opcode};
    }
  }
}

/// Every line that can wait, on a machine that makes it wait.
constexpr Line kWaitingLines[] = {{.command = 0x01, .data1 = 10, .data2 = 1},  // Wait_IO
                                  {.command = 0x02, .data1 = 200},             // Delay_mSec
                                  {.command = 0x24},                           // Wait_Move_A
                                  {.command = 0x25}};                          // Move_INC_A_Wait

ProgramRun waiting_run(const Line& line, Dialect::RewrittenLine reading) {
  ProgramRun run(program_of({line, {0x6B, 0, 0, 0}, {0xFF, 0, 0, 0}}));
  run.dialect.rewritten_line = reading;
  run.machine.moving_a = true;
  run.until(20);
  EXPECT_EQ(run.execution.now_line, 0) << int{line.command};
  return run;
}

TEST(Simple2OtherReadings, ARewrittenLineIsReadAgainOrWaitsOn) {
  using enum Dialect::RewrittenLine;
  for (const Line& line : kWaitingLines) {
    for (const auto reading : {reread, waits_on}) {
      ProgramRun run = waiting_run(line, reading);
      run.program.set_cell(0, 0x00);  // NOP
      const auto next = next_active_slot_ms(run.execution, 18, run.program, run.dialect, run.machine);
      EXPECT_EQ(next == 20, reading == reread) << int{line.command};
      run.until(40);
      EXPECT_EQ(run.execution.running, reading == waits_on) << int{line.command};
      EXPECT_EQ(run.machine.parameters[0], reading == reread ? 1 : 0) << int{line.command};
      // The end of its wait: DIN_10, the end of the move, the end of the delay.
      run.machine.inputs = 1 << 10;
      run.machine.moving_a = false;
      run.until(300);
      EXPECT_FALSE(run.execution.running) << int{line.command};
      EXPECT_EQ(run.machine.parameters[0], 1) << int{line.command};
    }
  }
}

TEST(Simple2OtherReadings, AFlagGivenToAWaitingLineDoesNotEndIt) {
  for (const Line& line : kWaitingLines) {
    ProgramRun run = waiting_run(line, Dialect::RewrittenLine::reread);
    run.program.set_cell(3, 7);
    run.until(40);
    EXPECT_EQ(run.execution.now_line, 0) << int{line.command};
    EXPECT_EQ(run.machine.take_calls(), line.command == 0x25 ? "A by 0" : "") << "once";
  }
}

TEST(Simple2OtherReadings, ALineInPlaceOfAWaitingOneRuns) {
  for (const Line& line : kWaitingLines) {
    ProgramRun run = waiting_run(line, Dialect::RewrittenLine::reread);
    run.program.set_cell(0, 0xFF);
    run.until(22);
    EXPECT_EQ(run.execution.ending, Ending::end_instruction) << int{line.command};
    EXPECT_FALSE(run.execution.running) << int{line.command};
  }
}

}  // namespace other_readings_test
}  // namespace understudy::interpreter::simple2
