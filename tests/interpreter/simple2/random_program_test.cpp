// Programs that nobody would write.
#include <random>

#include "interpreter/simple2/instructions.h"
#include "tests/interpreter/simple2/scripted_machine.h"

namespace understudy::interpreter::simple2 {
namespace random_program_test {

using Random = std::mt19937;

std::uint8_t below(Random& random, unsigned limit) { return static_cast<std::uint8_t>(random() % limit); }

/// Any cells, or, more often, listed commands with flags and parameters that exist.
Program random_program(Random& random) {
  Lines lines{};
  const bool is_sane = random() % 4 != 0;
  for (Line& line : lines) {
    const std::uint8_t listed = kInstructions[random() % (kInstructions.size() - 1)].opcode;
    line = is_sane ? Line{listed, below(random, 12), below(random, 12), below(random, 12)}
                   : Line{below(random, 256), below(random, 256), below(random, 256), below(random, 256)};
  }
  return Program(lines);
}

Dialect random_dialect(Random& random) {
  constexpr int kVersions[] = {139, 140, 141, 142, 152};
  Dialect dialect = dialect_of_firmware(kVersions[random() % std::size(kVersions)]);
  dialect.loop_count = static_cast<Dialect::LoopCount>(random() % 2);
  dialect.loop_left = static_cast<Dialect::LoopLeft>(random() % 2);
  dialect.loop_nesting = static_cast<Dialect::LoopNesting>(random() % 2);
  dialect.unknown_command = static_cast<Dialect::UnknownCommand>(random() % 2);
  dialect.after_last_line = static_cast<Dialect::AfterLastLine>(random() % 2);
  dialect.delay_counts = static_cast<Dialect::DelayCounts>(random() % 2);
  dialect.undefined_flag = static_cast<Dialect::UndefinedFlag>(random() % 2);
  dialect.timer_compare = static_cast<Dialect::TimerCompare>(random() % 2);
  dialect.wait_cut_short = static_cast<Dialect::WaitCutShort>(random() % 3);
  dialect.rewritten_line = static_cast<Dialect::RewrittenLine>(random() % 2);
  return dialect;
}

void change_something(Random& random, ScriptedMachine& machine) {
  switch (random() % 3) {
    case 0: machine.inputs = static_cast<std::uint16_t>(random()); break;
    case 1: machine.status = static_cast<std::uint16_t>(random()); break;
    default:
      machine.moving_a = random() % 2 != 0;
      machine.moving_b = random() % 2 != 0;
      machine.cut_short_a = !machine.moving_a && random() % 4 == 0;
      machine.cut_short_b = !machine.moving_b && random() % 4 == 0;
  }
}

ProgramRun random_run(Random& random) {
  ProgramRun run(random_program(random), below(random, 256));
  run.dialect = random_dialect(random);
  for (std::int32_t& parameter : run.machine.parameters)
    parameter = static_cast<std::int32_t>(random() % 50) - 10;
  return run;
}

constexpr int kPrograms = 150;
constexpr int kSlots = 1500;

TEST(Simple2RandomProgram, NeverLeavesItsLinesAndExecutesOneASlotAtMost) {
  Random random(20240611);
  for (int count = 0; count < kPrograms; ++count) {
    SCOPED_TRACE(count);
    ProgramRun run = random_run(random);
    for (int slot = 0; slot < kSlots && run.execution.running; ++slot) {
      const Execution before = run.execution;
      if (random() % 8 == 0) change_something(random, run.machine);
      run.machine.calls.clear();
      run.slot();
      EXPECT_LE(run.machine.calls.size(), 2u);  // both axes
      const bool same_line = run.execution.now_line == before.now_line;
      const bool planned_line = run.execution.now_line == before.next_line;
      ASSERT_TRUE(same_line || planned_line) << int{run.execution.now_line};
      ASSERT_LE(run.execution.next_line, 257);
    }
  }
}

TEST(Simple2RandomProgram, ContinuesTheSameFromACopyInTheMiddle) {
  Random random(7);
  for (int count = 0; count < kPrograms; ++count) {
    ProgramRun run = random_run(random);
    run.until(static_cast<std::int64_t>(random() % 300));
    ProgramRun copy = run;
    for (int slot = 0; slot < 300; ++slot) {
      if (random() % 8 == 0) {
        change_something(random, run.machine);
        copy.machine.inputs = run.machine.inputs;
        copy.machine.status = run.machine.status;
        copy.machine.moving_a = run.machine.moving_a;
        copy.machine.moving_b = run.machine.moving_b;
        copy.machine.cut_short_a = run.machine.cut_short_a;
        copy.machine.cut_short_b = run.machine.cut_short_b;
      }
      run.slot();
      copy.slot();
      ASSERT_EQ(copy.execution, run.execution) << count << " " << slot;
      ASSERT_EQ(copy.machine, run.machine) << count << " " << slot;
    }
  }
}

TEST(Simple2RandomProgram, MayLeaveOutTheSlotsInWhichNothingHappens) {
  Random random(99);
  int left_out = 0;
  for (int count = 0; count < kPrograms; ++count) {
    ProgramRun every = random_run(random);
    ProgramRun some = every;
    for (int slot = 0; slot < kSlots; ++slot) {
      const std::int64_t now_ms = every.next_slot_ms;
      const auto next_ms = [&](const ProgramRun& run) {
        return next_active_slot_ms(run.execution, now_ms - 1, run.program, run.dialect, run.machine);
      };
      if (random() % 32 == 0) {
        change_something(random, every.machine);
        some.machine = every.machine;
      }
      if (next_ms(some) > now_ms) {
        some.next_slot_ms += kSlotMs;
        ++left_out;
      } else {
        some.slot();
      }
      every.slot();
      ASSERT_EQ(some.execution, every.execution) << count << " " << now_ms;
      ASSERT_EQ(some.machine, every.machine) << count << " " << now_ms;
    }
  }
  EXPECT_GT(left_out, kPrograms * kSlots / 4);
}

TEST(Simple2NextActiveSlot, IsNoneWithoutAProgramAndTheNextOneWithOne) {
  ProgramRun run(program_of({{0x00, 0, 0, 0}, {0xFF, 0, 0, 0}}));
  const auto next_ms = [&](std::int64_t done_ms) {
    return next_active_slot_ms(run.execution, done_ms, run.program, run.dialect, run.machine);
  };
  EXPECT_EQ(next_ms(-1), 0);
  EXPECT_EQ(next_ms(0), 2);
  EXPECT_EQ(next_ms(1), 2);
  run.to_the_end();
  EXPECT_EQ(next_ms(4), kNoSlot);
}

TEST(Simple2NextActiveSlot, IsTheEndOfADelay) {
  ProgramRun run(program_of({{0x02, 101, 0, 0}}));
  run.slot();
  EXPECT_EQ(next_active_slot_ms(run.execution, 0, run.program, run.dialect, run.machine), 102);
}

TEST(Simple2NextActiveSlot, IsNoneWhileAWaitCannotEndByItself) {
  ProgramRun run(program_of({{0x01, 0, 1, 0}}));
  run.slot();
  EXPECT_EQ(next_active_slot_ms(run.execution, 0, run.program, run.dialect, run.machine), kNoSlot);
  run.machine.inputs = 1;
  EXPECT_EQ(next_active_slot_ms(run.execution, 5, run.program, run.dialect, run.machine), 6);
}

TEST(Simple2NextActiveSlot, ComesForAWaitMoveBThatMovesUpTo139) {
  ProgramRun run(program_of({{0x34, 0, 0, 0}}));
  run.dialect = dialect_of_firmware(139);
  run.machine.moving_b = true;
  EXPECT_EQ(next_active_slot_ms(run.execution, -1, run.program, run.dialect, run.machine), 0);
  run.dialect = dialect_of_firmware(140);
  run.slot();
  EXPECT_EQ(next_active_slot_ms(run.execution, 0, run.program, run.dialect, run.machine), kNoSlot);
}

}  // namespace random_program_test
}  // namespace understudy::interpreter::simple2
