// Jumps, calls, waits and ends. Times are calculated by hand from "one line per tick": after G at 0, the n-th
// line runs at n ms.
#include <gtest/gtest.h>

#include "tests/interpreter/slim/scripted_machine.h"

namespace understudy::interpreter::slim {
namespace flow_test {

TEST(SlimFlow, OneLineATickUntilTheEnd) {
  ProgramRun run({"MA 100", "$HERE", "SET P1"});
  ASSERT_EQ(run.begin(), Error::none);
  run.until(2);
  EXPECT_TRUE(run.execution.running);
  run.until(10);
  EXPECT_EQ(run.machine.log, (Log{"1 MA 100.0", "3 SET P1"}));  // a label alone also takes its tick
  EXPECT_FALSE(run.execution.running);
  EXPECT_EQ(run.execution.ending, Ending::past_last_line);
}

TEST(SlimFlow, SeveralLinesATickWhereTheyAreAskedFor) {
  ProgramRun run({"SET P1", "SET P2", "SET P3", "SET P4", "WT 1", "CLR P1"},
                 {option("lines_a_tick", "four_a_millisecond")});
  run.begin();
  run.until(10);
  // Four lines, then WT 1 at 2 ms, and what follows 1 ms later.
  EXPECT_EQ(run.machine.log, (Log{"1 SET P1", "1 SET P2", "1 SET P3", "1 SET P4", "3 CLR P1"}));
}

TEST(SlimFlow, StartsAtALineOrALabel) {
  const std::vector<std::string> lines{"SET P1", "$B SET P2", "$b SET P3", "SET P4"};
  const Options first_counts{option("same_label", "the_first_counts")};
  ProgramRun at_line(lines, first_counts);
  EXPECT_EQ(at_line.begin("3"), Error::none);
  at_line.until(3);
  EXPECT_EQ(at_line.machine.log, (Log{"1 SET P4"}));

  ProgramRun at_label(lines, first_counts);  // labels ignore case; the first of two counts
  EXPECT_EQ(at_label.begin("$b"), Error::none);
  at_label.until(1);
  EXPECT_EQ(at_label.machine.log, (Log{"1 SET P2"}));

  ProgramRun nowhere(lines, first_counts);
  const Execution before = nowhere.execution;
  EXPECT_EQ(nowhere.begin("4"), Error::address);
  EXPECT_EQ(nowhere.begin("$C"), Error::address);
  EXPECT_EQ(nowhere.execution, before);
  ProgramRun empty({});
  EXPECT_EQ(start(empty.execution, empty.program, nullptr, {}), Error::address);
}

struct JumpCase {
  std::string line;
  bool jumps;
};

/// Input 3 is On; N1 is 5, NS(5) is 7, R1 is 0.1 as a float32, AIN is 600, TM is 12.
TEST(SlimFlow, JumpsBothWays) {
  const std::vector<JumpCase> cases{
      {"JP $A", true},           {"JI 3,$A", true},         {"JI 4,$A", false},
      {"JNI 3,$A", false},       {"JNI 4,$A", true},        {"JZ N0,$A", true},
      {"JZ N1,$A", false},       {"JNZ N0,$A", false},      {"JNZ N1,$A", true},
      {"JZ NS(4),$A", true},     {"JNZ NS(N1),$A", true},  // NS(5)
      {"JE 5,N1,$A", true},      {"JE 4,N1,$A", false},     {"JNE 5,N1,$A", false},
      {"JNE 4,N1,$A", true},     {"JG 4,N1,$A", true},  // the variable, 5, is greater than 4
      {"JG 5,N1,$A", false},     {"JG 6,N1,$A", false},     {"JNG 4,N1,$A", false},
      {"JNG 5,N1,$A", true},     {"JNG 6,N1,$A", true},     {"JE 0.1,R1,$A", true},  // both as float32
      {"JG 0.1,R1,$A", false},   {"JG 0.05,R1,$A", true},   {"JE N1,NS(5),$A", false},
      {"JG N1,NS(N1),$A", true},                           // 7 > 5
      {"JG AIN,N1,$A", false},   {"JNG AIN,N1,$A", true},  // 5 <= 600
      {"JE TM,R1,$A", false},    {"JG TM,NS(5),$A", false}, {"JTI 3,100,$A", true},
      {"JNTI 4,100,$A", true},   {"JTI 4,0,$A", false},     {"JNTI 3,0,$A", false},
  };
  for (const JumpCase& each : cases) {
    ProgramRun run({each.line, "SET P1", "RET", "$A SET P2"});
    run.machine.inputs = {3};
    run.machine.variables = {{"N1", 5}, {"NS(5)", 7}, {"R1", 0.1f}};
    run.machine.analog = 600;
    run.machine.clock = 12;
    run.begin();
    run.until(5);
    EXPECT_EQ(run.machine.log, (Log{each.jumps ? "2 SET P2" : "2 SET P1"})) << each.line;
    EXPECT_EQ(run.execution.ending, each.jumps ? Ending::past_last_line : Ending::returned) << each.line;
  }
}

TEST(SlimFlow, JumpsToNowhereEndTheProgram) {
  for (const std::string line : {"JP $B", "JP 3", "JI 3,$B", "CALL $B", "JNTI 4,5,9"}) {
    ProgramRun run({"SET P1", line, "SET P2"});
    run.machine.inputs = {3};
    run.begin();
    run.until(5);
    EXPECT_EQ(run.machine.log, (Log{"1 SET P1"})) << line;
    EXPECT_EQ(run.execution.ending, Ending::failed) << line;
    EXPECT_EQ(run.execution.error, Error::address) << line;
    EXPECT_EQ(run.execution.line, 1) << line;
    EXPECT_EQ(run.errors, std::vector{Error::address}) << line;
  }
}

/// Checked from its own tick, 1, until 1 + 10; the line after it, or its target, runs one tick later.
TEST(SlimFlow, TimedJumpsLookForTheirWholeTime) {
  struct Case {
    bool for_on;
    std::int64_t changes_after_ms;  // the level is present at the next tick
    std::string done;
  };
  for (const Case& each :
       {Case{true, 4, "6 SET P2"}, Case{true, 10, "12 SET P2"}, Case{true, 11, "12 SET P1"},
        Case{false, 4, "6 SET P2"}, Case{false, 11, "12 SET P1"}}) {
    ProgramRun run({each.for_on ? "JTI 2,10,$A" : "JNTI 2,10,$A", "SET P1", "RET", "$A SET P2"});
    if (!each.for_on) run.machine.inputs = {2};
    run.begin();
    run.until(each.changes_after_ms);
    run.machine.inputs = each.for_on ? std::set<int>{2} : std::set<int>{};
    run.until(20);
    EXPECT_EQ(run.machine.log, Log{each.done}) << each.for_on << " " << each.changes_after_ms;
  }
}

TEST(SlimFlow, WaitsForTime) {
  ProgramRun run({"WT 100", "SET P1", "WT 0", "SET P2", "WT 1", "SET P3", "WT 5"});
  run.begin();
  run.until(105);
  // WT 100 at 1; 1 + 100 = 101; WT 0 takes its tick, 102; SET P2 103; WT 1 at 104; SET P3 at 105.
  EXPECT_EQ(run.machine.log, (Log{"101 SET P1", "103 SET P2", "105 SET P3"}));
  run.until(110);
  EXPECT_TRUE(run.execution.running);  // WT 5 at 106: until 111
  run.until(111);
  EXPECT_EQ(run.execution.ending, Ending::past_last_line);
}

TEST(SlimFlow, WaitsForInputs) {
  ProgramRun run({"WI 1", "SET P1", "WNI 1", "CLR P1"});
  run.begin();
  run.until(7);
  EXPECT_EQ(next_active_ms(run.execution, 7, run.program, run.options, run.machine), kNever);
  run.machine.inputs = {1};  // seen at 8
  run.until(20);
  run.machine.inputs = {};  // seen at 21
  run.until(30);
  EXPECT_EQ(run.machine.log, (Log{"9 SET P1", "22 CLR P1"}));
}

TEST(SlimFlow, WaitsForTheMachine) {
  for (const std::string line : {"DN", "T1DN", "XDN", "WDN", "MA 5.0"}) {
    ProgramRun run({line, "SET P1"});
    run.machine.waiting = {line};
    run.begin();
    run.until(50);
    EXPECT_EQ(run.execution.hold, Hold::machine);
    run.machine.waiting = {};
    run.until(60);
    EXPECT_EQ(run.machine.log, (Log{"51 " + line, "52 SET P1"}));
  }
}

TEST(SlimFlow, CallsReturnAndNest) {
  ProgramRun run({"CALL $A", "SET P1", "RET", "$A CALL $B", "SET P2", "RET", "$B SET P3", "RET"});
  run.begin();
  run.until(20);
  // 1 CALL, 2 CALL, 3 SET P3, 4 RET, 5 SET P2, 6 RET, 7 SET P1, 8 RET at the top.
  EXPECT_EQ(run.machine.log, (Log{"3 SET P3", "5 SET P2", "7 SET P1"}));
  EXPECT_EQ(run.execution.ending, Ending::returned);
}

TEST(SlimFlow, CallsAreSixteenDeep) {
  ProgramRun run({"$A SET P1", "CALL $A"});
  run.begin();
  run.until(100);
  // Sixteen calls succeed, so the line before CALL is executed seventeen times.
  EXPECT_EQ(run.machine.log.size(), 17u);
  EXPECT_EQ(run.execution.ending, Ending::failed);
  EXPECT_EQ(run.execution.error, Error::address);
  ProgramRun shallow({"$A SET P1", "CALL $A"}, {option("call_depth", "4")});
  shallow.begin();
  shallow.until(100);
  EXPECT_EQ(shallow.machine.log.size(), 5u);
}

TEST(SlimFlow, ACallInTheLastLineReturnsBehindIt) {
  ProgramRun run({"JP $MAIN", "$SUB SET P1", "RET", "$MAIN CALL $SUB"});
  run.begin();
  run.until(10);
  EXPECT_EQ(run.machine.log, (Log{"3 SET P1"}));
  EXPECT_EQ(run.execution.ending, Ending::past_last_line);
}

TEST(SlimFlow, ALineThatTheMachineRefusesEndsTheProgramOrIsPassed) {
  const std::vector<std::string> lines{"T3MA 5", "SET P1"};
  ProgramRun ends(lines);
  ends.machine.refusals = {{"T3MA 5.0", Error::not_linked}};
  ends.begin();
  ends.until(5);
  EXPECT_EQ(ends.execution.ending, Ending::failed);
  EXPECT_EQ(ends.execution.error, Error::not_linked);
  EXPECT_EQ(ends.errors, std::vector{Error::not_linked});
  EXPECT_TRUE(ends.machine.log.empty());

  ProgramRun passes(lines, {option("failed_line", "is_passed_over")});
  passes.machine.refusals = ends.machine.refusals;
  passes.begin();
  passes.until(5);
  EXPECT_EQ(passes.errors, std::vector{Error::not_linked});
  EXPECT_EQ(passes.machine.log, (Log{"2 SET P1"}));
}

TEST(SlimFlow, ExitLeavesAtOnce) {
  ProgramRun run({"WT 100", "SET P1"});
  run.begin();
  run.until(10);
  stop(run.execution);
  EXPECT_EQ(run.execution.ending, Ending::exited);
  run.until(200);
  EXPECT_TRUE(run.machine.log.empty());
}

TEST(SlimFlow, IndicesAreReadWhenTheLineIsCarriedOut) {
  ProgramRun run({"N1=7", "NS(N1)=3", "R0=RS(N1)", "N1=-1", "NS(N1)=3"});
  run.begin();
  run.until(10);
  EXPECT_EQ(run.machine.log, (Log{"1 N1=7", "2 NS(7)=3", "3 R0=RS(7)", "4 N1=-1"}));
  EXPECT_EQ(run.execution.error, Error::range);
}

TEST(SlimFlow, NumbersComeFromTheHost) {
  ProgramRun run({"N0=GETI", "R0=GETR", "JG GETI,N0,$A", "RET", "$A OUT N0", "GETI", "OUT R0"});
  run.begin();
  EXPECT_FALSE(wants_number(run.execution));
  run.until(20);
  ASSERT_TRUE(wants_number(run.execution));
  EXPECT_EQ(next_active_ms(run.execution, 20, run.program, run.options, run.machine), kNever);
  EXPECT_EQ(give_number(run.execution, run.program, "PE 3"), Error::syntax);
  EXPECT_EQ(give_number(run.execution, run.program, "1.5"), Error::syntax);
  EXPECT_EQ(give_number(run.execution, run.program, "32767"), Error::range);
  EXPECT_EQ(give_number(run.execution, run.program, ""), Error::syntax);
  ASSERT_TRUE(wants_number(run.execution));
  EXPECT_EQ(give_number(run.execution, run.program, " 12 "), Error::none);
  EXPECT_FALSE(wants_number(run.execution));
  EXPECT_EQ(give_number(run.execution, run.program, "13"), Error::not_allowed);
  run.until(30);  // N0=12 at 21; GETR waits from 22 on
  EXPECT_EQ(give_number(run.execution, run.program, "-0.25"), Error::none);
  run.until(40);  // R0 at 31; the jump waits from 32 on
  EXPECT_EQ(give_number(run.execution, run.program, "11"), Error::none);
  run.until(50);  // jumps at 41: 12 > 11; GETI alone waits from 43 on
  EXPECT_EQ(give_number(run.execution, run.program, "1"), Error::none);
  run.until(60);
  EXPECT_EQ(run.machine.log, (Log{"21 N0=12", "31 R0=-0.25", "42 OUT N0", "52 OUT R0"}));
}

TEST(SlimFlow, ToldFromWhatNoRunComesTo) {
  ProgramRun run({"SET EV1 NE,NS(N1),N0", "ON EV1,$A", "JTI 1,50,$A", "WI 2", "$A RET"});
  run.begin();
  run.until(10);
  const Execution sound = run.execution;
  ASSERT_EQ(sound.hold, Hold::window);
  const auto still_sound = [&](auto change) {
    Execution changed = sound;
    change(changed);
    return is_sound(changed, run.program, run.options);
  };
  EXPECT_TRUE(still_sound([](Execution&) {}));
  EXPECT_FALSE(still_sound([](Execution& e) { e.line = 5; }));
  EXPECT_FALSE(still_sound([](Execution& e) { e.line = -1; }));
  EXPECT_FALSE(still_sound([](Execution& e) { e.line = 1; }));  // ON EV has no window
  EXPECT_FALSE(still_sound([](Execution& e) { e.hold = Hold::input; }));
  EXPECT_FALSE(still_sound([](Execution& e) { e.hold = Hold::number; }));
  EXPECT_FALSE(still_sound([](Execution& e) { e.stack.resize(17); }));
  EXPECT_FALSE(still_sound([](Execution& e) { e.stack.assign(2, {.of_event = true}); }));
  EXPECT_FALSE(still_sound([](Execution& e) { e.stack.assign(1, {.line = 6}); }));
  EXPECT_FALSE(still_sound([](Execution& e) { e.events[0].operands.pop_back(); }));
  EXPECT_FALSE(still_sound([](Execution& e) { e.events[0].operands[1].index = 65; }));
  EXPECT_FALSE(still_sound([](Execution& e) { e.events[0].address.kind = Operand::Kind::port; }));
}

}  // namespace flow_test
}  // namespace understudy::interpreter::slim
