// Flags that cannot be, and how timers are compared: ours, and the other readings.
#include "tests/interpreter/simple2/scripted_machine.h"

namespace understudy::interpreter::simple2 {
namespace {

/// Counts its passes in MEM0: endlessly, where the jump leads back to line 0.
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

}  // namespace
}  // namespace understudy::interpreter::simple2
