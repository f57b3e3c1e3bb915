// Events: what makes them fire, what they interrupt, what delays them.
#include <gtest/gtest.h>

#include "tests/interpreter/slim/scripted_machine.h"

namespace understudy::interpreter::slim {
namespace events_test {

/// Lines 0 and 1 define the event, so the line that waits runs from 3 ms on.
std::vector<std::string> interrupted(const std::string& waiting) {
  return {"SET EV1 I,8", "ON EV1,$PPZ", waiting, "SET P1", "RET", "$PPZ ISET P4", "RET"};
}

TEST(SlimEvents, InterruptAWaitForTimeWhichBeginsAgain) {
  ProgramRun run(interrupted("WT 100"));
  run.begin();
  run.until(49);
  run.machine.inputs = {8};
  run.until(200);
  // Event at 50: ISET at 50, RET at 51, WT again at 52, so SET P1 at 152.
  EXPECT_EQ(run.machine.log, (Log{"50 ISET P4", "152 SET P1"}));
}

TEST(SlimEvents, InterruptAWaitForTimeThatMayContinueByChoice) {
  ProgramRun run(interrupted("WT 100"), {option("interrupted_wait", "have_gone_on")});
  run.begin();
  run.until(49);
  run.machine.inputs = {8};
  run.until(200);
  EXPECT_EQ(run.machine.log, (Log{"50 ISET P4", "103 SET P1"}));  // WT at 3
}

TEST(SlimEvents, DoNotInterruptAWaitThatIsJustOver) {
  ProgramRun run(interrupted("WT 100"));
  run.begin();
  run.until(102);
  run.machine.inputs = {8};  // seen at 103, when the wait ends
  run.until(300);
  EXPECT_EQ(run.machine.log, (Log{"103 ISET P4", "105 SET P1"}));
}

TEST(SlimEvents, InterruptAWaitForAnInput) {
  ProgramRun run(interrupted("WI 1"));
  run.begin();
  run.until(49);
  run.machine.inputs = {8};
  run.until(60);
  EXPECT_EQ(run.execution.hold, Hold::input);
  run.machine.inputs = {8, 1};
  run.until(70);
  EXPECT_EQ(run.machine.log, (Log{"50 ISET P4", "62 SET P1"}));  // WI sees it at 61
}

TEST(SlimEvents, InterruptAWaitForTheMachine) {
  ProgramRun run(interrupted("DN"));
  run.machine.waiting = {"DN"};
  run.begin();
  run.until(49);
  run.machine.inputs = {8};
  run.until(99);
  run.machine.waiting = {};
  run.until(110);
  EXPECT_EQ(run.machine.log, (Log{"50 ISET P4", "100 DN", "101 SET P1"}));
}

TEST(SlimEvents, InterruptATimedJump) {
  ProgramRun again(interrupted("JTI 1,100,$PPZ"));
  again.begin();
  again.until(49);
  again.machine.inputs = {8};
  again.until(200);
  // JTI at 3, event at 50, RET at 51, JTI again at 52: it checks until 152, then SET P1 at 153.
  EXPECT_EQ(again.machine.log, (Log{"50 ISET P4", "153 SET P1"}));

  ProgramRun continues(interrupted("JTI 1,100,$PPZ"), {option("interrupted_wait", "have_gone_on")});
  continues.begin();
  continues.until(49);
  continues.machine.inputs = {8};
  continues.until(200);
  EXPECT_EQ(continues.machine.log, (Log{"50 ISET P4", "104 SET P1"}));  // checks until 103
}

TEST(SlimEvents, InterruptAWaitForANumber) {
  ProgramRun run({"SET EV1 I,8", "ON EV1,$PPZ", "N0=GETI", "SET P1", "RET", "$PPZ N1=GETI", "RET"});
  run.begin();
  run.until(10);
  EXPECT_EQ(give_number(run.execution, run.program, "5"), Error::none);
  run.machine.inputs = {8};  // the number is for the line that asked; the event comes after it
  run.until(20);
  EXPECT_EQ(run.machine.log, (Log{"11 N0=5"}));
  EXPECT_TRUE(wants_number(run.execution));
  EXPECT_EQ(give_number(run.execution, run.program, "6"), Error::none);
  run.until(30);
  EXPECT_EQ(run.machine.log, (Log{"11 N0=5", "21 N1=6", "23 SET P1"}));
}

TEST(SlimEvents, FireOnceUntilTheConditionHasBeenFalse) {
  ProgramRun run({"SET EV2 NZ,N0", "ON EV2,$PPZ", "$LOOP JP $LOOP", "$PPZ ISET P4", "RET"});
  run.begin();
  run.until(19);
  run.machine.variables["N0"] = 1;
  run.until(40);
  run.machine.variables["N0"] = 0;
  run.until(41);
  run.machine.variables["N0"] = 2;
  run.until(60);
  EXPECT_EQ(run.machine.log, (Log{"20 ISET P4", "42 ISET P4"}));
}

TEST(SlimEvents, AreHeldUntilReturnAndTheLowestComesFirst) {
  const std::vector<std::string> lines{"SET EV1 I,1", "ON EV1,$A", "SET EV2 I,2", "ON EV2,$B", "SET EV3 I,3",
                                       "ON EV3,$C",   "WT 1000",   "$A ISET P1",  "RET",       "$B WT 20",
                                       "ISET P2",     "RET",       "$C ISET P3",  "RET"};
  ProgramRun run(lines);
  run.begin();
  run.until(49);
  run.machine.inputs = {2};  // EV2's routine from 50: WT 20, ISET P2 at 70, RET at 71
  run.until(55);
  run.machine.inputs = {1, 3};  // both held, and false again before the routine ends
  run.until(60);
  run.machine.inputs = {};
  run.until(100);
  EXPECT_EQ(run.machine.log, (Log{"70 ISET P2", "72 ISET P1", "74 ISET P3"}));

  ProgramRun dropping(lines, {option("held_event", "is_dropped")});
  dropping.begin();
  dropping.until(49);
  dropping.machine.inputs = {2};
  dropping.until(55);
  dropping.machine.inputs = {1, 3};
  dropping.until(60);
  dropping.machine.inputs = {3};
  dropping.until(100);
  EXPECT_EQ(dropping.machine.log, (Log{"70 ISET P2", "72 ISET P3"}));
}

TEST(SlimEvents, KnowAllConditions) {
  struct Case {
    std::string condition;
    double n0_before;
    double n0_after;  // N1 is 10 throughout
  };
  for (const Case& each :
       {Case{"NZ,N0", 0, 1}, Case{"Z,N0", 1, 0}, Case{"E,10,N0", 9, 10}, Case{"NE,N1,N0", 10, 9},
        Case{"G,N1,N0", 10, 11}, Case{"NG,N1,N0", 11, 10}, Case{"E,AIN,N0", 5, 300}}) {
    ProgramRun run({"SET EV1 " + each.condition, "ON EV1,$PPZ", "WT 1000", "$PPZ ISET P4", "RET"});
    run.machine.variables = {{"N0", each.n0_before}, {"N1", 10}};
    run.machine.analog = 300;
    run.begin();
    run.until(19);
    run.machine.variables["N0"] = each.n0_after;
    run.until(30);
    EXPECT_EQ(run.machine.log, (Log{"20 ISET P4"})) << each.condition;
  }
}

TEST(SlimEvents, FireAtOnceOrAwaitAChangeIfTheConditionAlreadyHolds) {
  for (const bool waits : {false, true}) {
    ProgramRun run(interrupted("WT 1000"), waits ? Options{option("event_at_arming", "waits_for_a_change")}
                                                 : Options{option("event_at_arming", "fires")});
    run.machine.inputs = {8};
    run.begin();
    run.until(100);
    EXPECT_EQ(run.machine.log, (waits ? Log{} : Log{"3 ISET P4"}));
  }
}

TEST(SlimEvents, DefinedByHandOutliveThePrograms) {
  ProgramRun run({"WT 50", "RET", "$PPZ ISET P4", "RET"});
  for (const std::string line : {"SET EV1 I,8", "ON EV1,$PPZ"}) {
    define_event(run.execution.events, *parse_line(line).line.command, run.options);
  }
  run.machine.inputs = {8};
  for (const std::int64_t begun_ms : {0, 200}) {
    run.until(begun_ms);
    run.begin();
    run.until(begun_ms + 150);
    EXPECT_EQ(run.execution.ending, Ending::returned);
  }
  EXPECT_EQ(run.machine.log, (Log{"1 ISET P4", "201 ISET P4"}));
}

TEST(SlimEvents, ARoutineHasRoomOnAFullStack) {
  ProgramRun run({"SET EV1 I,8", "ON EV1,$PPZ", "CALL $A", "$A CALL $B", "$B CALL $C", "$C CALL $D",
                  "$D WT 1000", "$PPZ ISET P4", "RET"},
                 {option("call_depth", "4")});
  run.begin();
  run.until(49);
  run.machine.inputs = {8};
  run.until(60);
  EXPECT_EQ(run.machine.log, (Log{"50 ISET P4"}));
  EXPECT_TRUE(run.execution.running);
}

TEST(SlimEvents, WithoutARoutineEndTheProgram) {
  ProgramRun nowhere(interrupted("WT 100"));
  ASSERT_EQ(nowhere.program.replace(1, "ON EV1,$NOWHERE"), Error::none);
  nowhere.begin();
  nowhere.until(9);
  nowhere.machine.inputs = {8};
  nowhere.until(20);
  EXPECT_EQ(nowhere.execution.error, Error::address);

  ProgramRun out_of_range(interrupted("WT 100"));
  ASSERT_EQ(out_of_range.program.replace(0, "SET EV1 NZ,NS(N0)"), Error::none);
  out_of_range.begin();
  out_of_range.until(9);
  out_of_range.machine.variables["N0"] = 2001;
  out_of_range.until(20);
  EXPECT_EQ(out_of_range.execution.error, Error::range);
  EXPECT_EQ(out_of_range.errors, std::vector{Error::range});
}

}  // namespace events_test
}  // namespace understudy::interpreter::slim
