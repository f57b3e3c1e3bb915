// How a machine, an event or a host affects a program beyond its next line.
#include <gtest/gtest.h>

#include "tests/interpreter/slim/scripted_machine.h"

namespace understudy::interpreter::slim {
namespace machine_and_program_test {

TEST(SlimMachine, MayEndTheProgramByACommand) {
  ProgramRun run({"SET P1", "TASTOP", "SET P2"});
  run.machine.endings["TASTOP"] = Outcome::Program::ends;
  run.begin();
  run.until(10);
  EXPECT_EQ(run.machine.log, (Log{"1 SET P1", "2 TASTOP"}));
  EXPECT_FALSE(run.execution.running);
  EXPECT_EQ(run.execution.ending, Ending::exited);
}

const std::vector<std::string> kInterrupted{"SET EV1 I,1", "ON EV1,$E", "WT 100",  "SET P1",
                                            "RET",         "$E TASTOP", "CALL $S", "SET P3",
                                            "RET",         "$S SET P2", "RET"};

TEST(SlimMachine, MayForgetWhatAnEventHasInterrupted) {
  for (const bool forgets : {true, false}) {
    ProgramRun run(kInterrupted);
    if (forgets) run.machine.endings["TASTOP"] = Outcome::Program::forgets_what_it_interrupted;
    run.begin();
    run.until(10);
    run.machine.inputs.insert(1);
    run.until(400);
    // The routine and its subroutine continue to their ends.
    Log expected{"11 TASTOP", "13 SET P2", "15 SET P3"};
    if (!forgets) expected.emplace_back("117 SET P1");
    EXPECT_EQ(run.machine.log, expected);
    EXPECT_FALSE(run.execution.running);
  }
}

TEST(SlimMachine, InItsMainLineAProgramHasNothingToForget) {
  ProgramRun run({"TASTOP", "SET P1"});
  run.machine.endings["TASTOP"] = Outcome::Program::forgets_what_it_interrupted;
  run.begin();
  run.until(10);
  EXPECT_EQ(run.machine.log, (Log{"1 TASTOP", "2 SET P1"}));
}

TEST(SlimEvents, MayRunTheirRoutineWithoutAProgram) {
  ProgramRun run({"SET P1", "RET", "$E SET P2", "RET"},
                 {option("events_without_program", "run_their_routine")});
  const auto define = [&](std::string_view line) {
    define_event(run.execution.events, *parse_line(line).line.command, run.options);
  };
  define("SET EV1 I,1");
  define("ON EV1,$E");
  run.until(20);
  EXPECT_TRUE(run.machine.log.empty());
  run.machine.inputs.insert(1);
  run.until(40);
  EXPECT_EQ(run.machine.log, (Log{"22 SET P2"}));
  EXPECT_FALSE(run.execution.running);
  // Once for each time that it becomes true.
  run.machine.inputs.clear();
  run.until(50);
  run.machine.inputs.insert(1);
  run.until(60);
  EXPECT_EQ(run.machine.log.size(), 2U);
  // To a label that does not exist: an error, once.
  define("ON EV1,$NOWHERE");
  run.until(90);
  EXPECT_EQ(run.errors, (std::vector<Error>{Error::address}));
}

TEST(SlimFlow, ABareNumberMayHaveAVariable) {
  for (const bool has : {false, true}) {
    ProgramRun run({"GETI", "GETR", "SET P1"}, has ? Options{option("bare_number", "into_n0_or_r0")}
                                                   : Options{option("bare_number", "nowhere")});
    run.begin();
    run.until(5);
    EXPECT_EQ(give_number(run.execution, run.program, "17"), Error::none);
    run.until(10);
    EXPECT_EQ(give_number(run.execution, run.program, "2.5"), Error::none);
    run.until(20);
    EXPECT_EQ(run.machine.variables, (has ? std::map<std::string, double>{{"N0", 17}, {"R0", 2.5}}
                                          : std::map<std::string, double>{}));
    EXPECT_EQ(run.machine.log.back(), "12 SET P1");
  }
}

TEST(SlimProgram, AMachineChecksLinesAsTheyAreEntered) {
  Options options;
  options.check_command = [](const Command& command) {
    return command.verb == Verb::set_parameter && command.name == "FOO" ? Error::syntax : Error::none;
  };
  Program program;
  EXPECT_EQ(program.insert(0, "FOO=5", options), Error::syntax);
  EXPECT_EQ(program.insert(0, "PR3=5", options), Error::none);
  EXPECT_EQ(program.replace(0, "FOO=5", options), Error::syntax);
  options.choose(option("program_check", "when_it_runs"));
  EXPECT_EQ(program.insert(1, "$A FOO=5", options), Error::none);
  EXPECT_EQ(program.line(1).error, Error::syntax);
  EXPECT_EQ(program.line(1).parsed.label, "A");
}

TEST(SlimProgram, ALabelStandsOnce) {
  Program program;
  EXPECT_EQ(program.insert(0, "$A SET P1"), Error::none);
  EXPECT_EQ(program.insert(0, "$a"), Error::address);
  EXPECT_EQ(program.insert(1, "$B"), Error::none);
  EXPECT_EQ(program.replace(0, "$A SET P2"), Error::none);  // its own
  EXPECT_EQ(program.replace(1, "$A SET P2"), Error::address);
  EXPECT_EQ(program.size(), 2);
}

}  // namespace machine_and_program_test
}  // namespace understudy::interpreter::slim
