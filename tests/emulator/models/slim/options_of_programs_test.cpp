// Options about SLIM's programs on the whole device. The tests of interpreter/slim test the language itself.
// Unless an option says otherwise, the n-th line after G runs n ms after it.
#include <algorithm>
#include <utility>

#include "base/state/state_error.h"
#include "tests/emulator/device/same_state.h"
#include "tests/emulator/models/slim/dialogue_script.h"

namespace understudy::emulator::models::slim {

namespace options_of_programs_test {

const std::string kAsking = R"(
> PG
> N0=GETI
> OUT N0
>
> G
@ 5
> EXIT
)";

TEST(SlimProgramChoices, GetNumberExit) {
  play({}, kAsking + "> ?ST\n< 1\n");
  // It is not a number, so the program keeps waiting for one.
  play({{"get_number_exit", "nothing"}}, kAsking + R"(
< ERR 1
@ 50
> 7
@ 3
< 7
> EXIT
)");
}

TEST(SlimProgramChoices, SavesInPrograms) {
  play({}, R"(
> PG
> SAVE C
< ERR 3
> SAVE D
< ERR 3
> SAVE P
< ERR 3
> DF
< ERR 3
)");
  const Choices chosen{{"first_list_columns", "saves_in_programs_too"}};
  play(chosen, R"(
> PG
> N3=5
> SAVE D
> N3=6
> VM=500
> SAVE C
> DF
> SAVE P
>
> G
@ 10
> ?N3
< 6
> ?VM
< 1000
off
on
> ?N3
< 5
> ?VM
< 500
> PL
< 0: N3=5
< 1: SAVE D
< 2: N3=6
< 3: VM=500
< 4: SAVE C
< 5: DF
< 6: SAVE P
)");
  // If a host is refused DF, a program is refused it, too.
  play(chosen, R"(
> PG
> MR 100000
> DF
> OUT "PAST"
>
> G
@ 10
> ?ERC
< 3
)");
}

const std::string kTwoLines =
    "> PG\n> OUT \"A\"\n> OUT \"B\"\n> OUT \"C\"\n> OUT \"D\"\n> OUT \"E\"\n>\n> G\n";

TEST(SlimProgramChoices, LinesATick) {
  play({}, kTwoLines + "@ 1\n< A\n> ?PE\n< 0\n@ 1\n< B\n@ 9\n< C\n< D\n< E\n");
  play({{"lines_a_tick", "four_a_millisecond"}},
       kTwoLines + "@ 1\n< A\n< B\n< C\n< D\n> ?PE\n< 0\n@ 1\n< E\n");
  // In the milliseconds divisible by 4: 4, 8, 12, 16, 20.
  play({{"lines_a_tick", "one_in_4_milliseconds"}},
       kTwoLines +
           "@ 3\n> ?PE\n< 0\n@ 1\n< A\n@ 3\n> ?PE\n< 0\n@ 1\n< B\n@ 11\n< C\n< D\n> ?PE\n< 0\n@ 1\n< E\n");
}

/// Returns the longest output that a program has had waiting for a line of 960 characters per second.
std::size_t max_waiting(const Choices& choices) {
  world::Bench bench = slim_bench(1, choices);
  bench.lines[0].timing = pty::Timing::wire;
  world::World world(bench, world::WorldOptions{}, [](const std::string&) {});
  const pty::Line& line = world.line(0).line;
  const std::string typed = "PG\r$A\rOUT \"" + std::string(48, 'x') + "\"\rJP $A\r\rG\r";
  world.receive(0, {reinterpret_cast<const std::uint8_t*>(typed.data()), typed.size()});
  std::size_t max = 0;
  for (int ms = 1; ms <= 5000; ++ms) {
    world.advance_to(std::chrono::milliseconds(ms));
    world.take_output(0, line.output().size());
    max = std::max(max, dynamic_cast<const Slim&>(world.device(0)).state().output.size());
  }
  return max;
}

TEST(SlimProgramChoices, PrintAhead) {
  // Texts of 50 characters, with their ends: the smallest count of them that is not below the limit.
  EXPECT_EQ(max_waiting({}), 1050u);
  EXPECT_EQ(max_waiting({{"print_ahead", "128_characters_then_it_waits"}}), 150u);
}

const std::string kTimedJump = "> PG\n> JTI 1,50,$A\n> OUT \"LATE\"\n> RET\n> $A OUT \"ON\"\n>\n> G\n";

TEST(SlimProgramChoices, TimeUnit) {
  play({}, kTimedJump + "@ 51\n> ?PE\n< 0\n@ 1\n< LATE\n");
  // At 1: until 1 + 50 x 4 = 201.
  play({{"time_unit", "4_milliseconds"}}, kTimedJump + "@ 201\n> ?PE\n< 0\n@ 1\n< LATE\n");
  play({{"time_unit", "4_milliseconds"}}, kTimedJump + "@ 200\nIN1 = 1\n@ 2\n< ON\n");
}

TEST(SlimProgramChoices, Events) {
  play({}, "> SET EV8 I,1\n> ON EV8,0\n> ON EV9,0\n< ERR 2\n");
  play({{"events", "4_with_the_conditions_of_jumps"}}, R"(
> SET EV4 I,1
> ON EV4,$E
> SET EV5 I,1
< ERR 2
> ON EV8,0
< ERR 2
> PG
> SET EV5 I,1
< ERR 2
> WT 50
> RET
> $E OUT "E"
> RET
>
> G
@ 10
IN1 = 1
@ 1
< E
)");
}

const std::string kPulses = R"(
> PG
> SET EV1 I,1
> ON EV1,$E
> WT 1000
> $E OUT "E"
> RET
>
> G
@ 20
# at 21, 22 and 23
IN1 = 1
@ 3
IN1 = 0
@ 5
)";

TEST(SlimProgramChoices, EventCheck) {
  play({}, kPulses + "< E\n");
  // Checked at 20, 24, 28 and 32.
  play({{"event_check", "each_4_milliseconds"}}, kPulses + R"(
> ?PE
< 0
IN1 = 1
@ 3
> ?PE
< 0
@ 1
< E
)");
}

const std::string kIntoAPause = R"(
> TAPZ
> PG
> MR 10000
> OUT "PAST"
>
> G
@ 10
)";

TEST(SlimProgramChoices, PauseInProgram) {
  // 10000: 155 ms.
  play({}, kIntoAPause + "> ?ERC\n< 0\n> TAREDO\n@ 200\n< PAST\n> ?PE\n< 10000\n");
  play({{"pause_in_program", "error_6"}}, kIntoAPause + R"(
> ?ERC
< 6
# on, pause, an error; no program
> ?ST
< 41
> TAREDO
@ 200
> ?PE
< 0
)");
  play({{"failed_line", "is_passed_over"}, {"pause_in_program", "error_6"}},
       kIntoAPause + "< PAST\n> ?ERC\n< 6\n> TAREDO\n@ 200\n> ?PE\n< 0\n");
}

TEST(SlimProgramChoices, CallDepth) {
  for (const auto& [option, depth] : {std::pair{"16", 16}, {"8", 8}, {"4", 4}}) {
    SCOPED_TRACE(option);
    DialogueScript script(1, {{"call_depth", option}});
    script.play("> PG\n> $A OUT \"X\"\n> CALL $A\n>\n> G\n");
    script.pass(2 * depth + 1);
    EXPECT_EQ(script.device().state().execution.stack.size(), static_cast<std::size_t>(depth));
    // Deep enough that it can be saved and restored.
    DialogueScript other(1, {{"call_depth", option}});
    other.pass(2 * depth + 1);
    EXPECT_NO_THROW(other.device().restore_state(script.device().save_state()));
    script.pass(100);
    // Each call that succeeds leads once more to the line before it.
    for (int i = 0; i < depth + 1; ++i) EXPECT_EQ(script.next(), "X");
    EXPECT_EQ(script.ask("?ERC"), "13");
  }
  DialogueScript deep(1);
  deep.play("> PG\n> $A CALL $A\n>\n> G\n@ 5\n");
  EXPECT_THROW(DialogueScript(1, {{"call_depth", "4"}}).device().restore_state(deep.device().save_state()),
               StateError);
}

/// Skipped ticks make no difference, and a saved state continues in the same way, with every option.
TEST(SlimProgramChoices, QuietTicksAndSavedStates) {
  const std::string busy = R"(
> PG
> SET EV1 I,1
> ON EV1,$E
> $L
> JTI 2,30,$ON
> WT 17
> MR 3000
> DN
> OUT N0
> JP $L
> $ON N0=GETI
> OUT N0
> WI 3
> CALL $S
> JP $L
> $S PLS P1,3
> RET
> $E ICHG
> ISET P4
> WT 6
> OUT "E"
> RET
>
> G
)";
  const std::string typed[] = {"",       "IN1 = 1\n", "IN1 = 0\n",          "IN1 = 1\n", "IN1 = 0\nIN2 = 1\n",
                               "> 12\n", "IN3 = 1\n", "IN1 = 1\nIN2 = 0\n", "IN3 = 0\n", ""};
  const Choices all[] = {
      {},
      {{"lines_a_tick", "four_a_millisecond"}},
      {{"lines_a_tick", "one_in_4_milliseconds"}},
      {{"event_check", "each_4_milliseconds"}},
      {{"lines_a_tick", "one_in_4_milliseconds"}, {"event_check", "each_4_milliseconds"}},
      {{"time_unit", "4_milliseconds"}, {"held_event", "is_dropped"}, {"event_check", "each_4_milliseconds"}},
      {{"lines_a_tick", "one_in_4_milliseconds"}, {"interrupted_wait", "have_gone_on"}},
  };
  std::uint64_t skipped = 0;
  for (Choices choices : all) {
    SCOPED_TRACE(choices.empty() ? "ours" : choices.begin()->second);
    choices["program_check"] = "when_it_runs";  // for the line that is not a command
    choices["failed_line"] = "is_passed_over";
    DialogueScript bulk(1, choices);
    DialogueScript single(1, choices);
    single.world().set_bulk_ticks(false);
    std::string sent[2];
    int moment = 0;
    const auto drain = [](DialogueScript& script, std::string& all_said) {
      for (std::string line = script.next(); line != "(nothing)"; line = script.next())
        all_said += line + "|";
    };
    bulk.play(busy);
    single.play(busy);
    for (const std::string& what : typed) {
      for (const Tick span : {Tick{1}, Tick{2}, Tick{43}, Tick{151 + 3 * moment}}) {
        bulk.pass(span);
        single.pass(span);
        drain(bulk, sent[0]);
        drain(single, sent[1]);
        ASSERT_EQ(sent[0], sent[1]);
        ASSERT_TRUE(saves_the_same(bulk.device(), single.device())) << "moment " << moment;
        const std::vector<std::byte> saved = bulk.device().save_state();
        bulk.device().restore_state(saved);
        ASSERT_TRUE(saves(bulk.device(), saved));
        ASSERT_TRUE(same_state(bulk.device(), single.device()));
      }
      bulk.play(what);
      single.play(what);
      ++moment;
    }
    EXPECT_NE(sent[0].find("E|"), std::string::npos) << sent[0];
    EXPECT_NE(sent[0].find("12|"), std::string::npos) << sent[0];
    skipped += bulk.world().ticks_skipped();
  }
  EXPECT_GT(skipped, 1000u);
}

}  // namespace options_of_programs_test

}  // namespace understudy::emulator::models::slim
