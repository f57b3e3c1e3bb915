// Breakpoints, logpoints and steps.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "emulator/world/expression/expression.h"
#include "emulator/world/names/names.h"
#include "emulator/world/snapshot.h"
#include "tests/emulator/world/debug/debugged_world.h"
#include "tests/emulator/world/two_devices.h"

namespace understudy::emulator::world {
namespace debugger_test {

using Kind = BreakpointSetup::Kind;

constexpr const char* kCounter =
    "        NOP\n"
    "again:  VAR_Inc VAR32\n"
    "        Delay_mSec 5\n"
    "        Jump again\n"
    "        END\n";

struct Counting : DebuggedWorld {
  Counting() : DebuggedWorld("simple2-r3", kCounter) { set(world, "PROG_MAIN_RunTime_START", 0); }
};

TEST(Breakpoint, StopsAtTheEndOfTheTickInWhichItsLineBegins) {
  Counting counting;
  const Breakpoint& set_one = counting.debugger.add({.line = 3});
  EXPECT_EQ(set_one.number, 1);
  EXPECT_EQ(set_one.line, 3);
  EXPECT_EQ(counting.run(1000), "breakpoint 1: m line 3: Delay_mSec 5");
  EXPECT_EQ(get(counting.world, "PROG_VAR0"), 1);
  EXPECT_EQ(counting.world.now(), time_of(tick_at(counting.world.now())));
  EXPECT_EQ(counting.debugger.stop()->place.line, 3);
  EXPECT_EQ(counting.debugger.stop()->place.number, 2);
  for (int i = 2; i < 5; ++i) {
    EXPECT_EQ(counting.run(1000), "breakpoint 1: m line 3: Delay_mSec 5");
    EXPECT_EQ(get(counting.world, "PROG_VAR0"), i);
  }
  EXPECT_EQ(counting.reported("stop").size(), 4U);
  EXPECT_TRUE(counting.debugger.remove(1));
  EXPECT_FALSE(counting.debugger.remove(1));
  EXPECT_FALSE(counting.debugger.is_watching());
  EXPECT_EQ(counting.run(100), "");
  EXPECT_EQ(counting.debugger.stop(), nullptr) << "the world has continued";
}

TEST(Breakpoint, OnALineWithoutInstructionMovesOn) {
  DebuggedWorld world("simple2-r3", kCounter);
  EXPECT_EQ(world.debugger.add({.line = 1}).line, 1);
  DebuggedWorld slim("slim", "; a remark\n\nMR 5\nRET\n");
  EXPECT_EQ(slim.debugger.add({.line = 1}).line, 1) << "the listing that it returns has no comments";
}

TEST(Breakpoint, CountsOnlyHitsOfItsConditionAndActsAtTheNth) {
  Counting counting;
  counting.debugger.add({.line = 3, .condition = "PROG_VAR0 >= 4", .nth = 2});
  EXPECT_EQ(counting.run(1000), "breakpoint 1: m line 3: Delay_mSec 5");
  EXPECT_EQ(get(counting.world, "PROG_VAR0"), 5);
  EXPECT_EQ(counting.debugger.breakpoints()[0].hits, 2U);
}

TEST(Breakpoint, OfAnInstructionCountsFromZeroInItsPart) {
  DebuggedWorld macros("rs-m8194h",
                       "MP 41\n  RSM_MACRO_MP_CALL 2\nEND\nMP 2\n  RSM_MACRO_SET_VAR VAR1 1\n"
                       "  RSM_MACRO_TIMER 5\nEND\n");
  macros.debugger.add({.kind = Kind::instruction, .program = "MP2", .line = 1});
  set(macros.world, "CALL_MPn", 41);
  EXPECT_EQ(macros.run(1000).substr(0, 31), "breakpoint 1: m MP2 line 3: RSM");
}

TEST(Breakpoint, OfAConditionStopsWhenItBecomesTrue) {
  Counting counting;
  counting.debugger.add({.kind = Kind::condition, .condition = "PROG_VAR0 % 4 == 3"});
  EXPECT_EQ(counting.run(1000), "breakpoint 1: PROG_VAR0 % 4 == 3  (PROG_VAR0 is 3)");
  EXPECT_EQ(counting.run(1000), "breakpoint 1: PROG_VAR0 % 4 == 3  (PROG_VAR0 is 7)");
  counting.debugger.remove_all();
  counting.debugger.add({.kind = Kind::condition, .condition = "time >= 400ms"});
  EXPECT_EQ(counting.run(1000).substr(0, 14), "breakpoint 2: ");
  EXPECT_EQ(counting.world.now(), std::chrono::milliseconds(400));
}

TEST(Breakpoint, OfAConditionWithoutResultStopsAndSaysWhy) {
  Counting counting;
  counting.debugger.add({.line = 3, .condition = "10 / (PROG_VAR0 - 2) > 100"});
  EXPECT_EQ(counting.run(1000).substr(0, 69),
            "breakpoint 1: m line 3: Delay_mSec 5; its condition has no result: co");
  EXPECT_EQ(get(counting.world, "PROG_VAR0"), 2);
}

TEST(Breakpoint, OfAWriteTellsWhoWrites) {
  Counting counting;
  counting.debugger.add({.kind = Kind::write, .name = "PROG_VAR0", .by = "device"});
  counting.debugger.add({.kind = Kind::write, .name = "m.PROG_VAR8"});
  EXPECT_EQ(counting.run(1000), "breakpoint 1: PROG_VAR0: the device changes it to 1");
  counting.debugger.remove(1);
  EXPECT_EQ(counting.run(50), "");
  PreparedWrite prepared;
  prepare_value(*counting.world.device(0).register_bank(),
                find_register(counting.world.known(), "PROG_VAR8").place, 7, prepared);
  counting.world.write(0, prepared);
  EXPECT_EQ(counting.run(50), "breakpoint 2: m.PROG_VAR8: control writes 7");
  counting.world.write(0, prepared);
  EXPECT_EQ(counting.run(50), "breakpoint 2: m.PROG_VAR8: control writes 7")
      << "even if its value does not change";
  counting.world.receive(0, write_request(1, 0, 1));  // of another register
  EXPECT_EQ(counting.run(50), "");
}

TEST(Breakpoint, OfAnEventStopsWhenItHappens) {
  DebuggedWorld moved("simple2-r3", "", "plant: { m.A: { limits: { upper: 50 } } }\n");
  moved.debugger.add({.kind = Kind::event, .name = "limit"});
  moved.debugger.add({.kind = Kind::event, .name = "exception"});
  moved.debugger.add({.kind = Kind::event, .name = "power"});
  moved.world.receive(0, read_request(1, 0x7FFF, 1));
  EXPECT_EQ(moved.run(1000).substr(0, 25), "breakpoint 2: exception: ");
  set(moved.world, "Aaxis_SVON", 1);
  set(moved.world, "Aaxis_Speed", 60);
  set(moved.world, "Aaxis_Pulse", 100);
  set(moved.world, "Aaxis_Move_INC", 1);
  EXPECT_EQ(moved.run(1000), "breakpoint 1: limit: m.A: its upper limit");
  EXPECT_EQ(moved.run(1000), "") << "it stays there";
  moved.world.switch_power(0, false);
  EXPECT_EQ(moved.run(1000), "breakpoint 3: power: m 0");
}

TEST(Logpoint, PrintsAndNeverStops) {
  Counting counting;
  counting.debugger.add({.line = 3, .log = "PROG_VAR0 is {PROG_VAR0}, {1 / (PROG_VAR0 - 1)}!"});
  EXPECT_EQ(counting.run(20), "");
  const std::vector<std::string> reported = counting.reported("logpoint");
  ASSERT_GT(reported.size(), 1U);
  EXPECT_EQ(reported[0].substr(0, 17), "PROG_VAR0 is 1, (");
  EXPECT_EQ(reported[1], "PROG_VAR0 is 2, 1!");
}

TEST(Debugger, RefusesWhatItCannotWatchInOneLine) {
  Counting counting;
  const auto error_of = [&](const BreakpointSetup& setup) -> std::string {
    try {
      counting.debugger.add(setup);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(error_of({.line = 300}),
            "line: there is no instruction on line 300 or after it; expected at most 5");
  EXPECT_EQ(error_of({.kind = Kind::instruction, .line = 999}),
            "instruction: there is no instruction 999; expected 0 to 255");
  EXPECT_EQ(error_of({.kind = Kind::instruction, .program = "MP1"}).substr(0, 25),
            "program: 'MP1' is unknown");
  EXPECT_NE(error_of({.line = 1, .condition = "PROG_VAR0 >"}), "");
  EXPECT_NE(error_of({.line = 1, .condition = "VAR_NONE > 1"}), "");
  EXPECT_NE(error_of({.line = 1, .condition = "m.A.greatest_speed > 1"}), "");
  EXPECT_EQ(error_of({.line = 1, .log = "at {PROG_VAR0"}), "log: '{' is not closed; expected '}' after it");
  EXPECT_NE(error_of({.line = 1, .log = "at {}"}), "");
  EXPECT_NE(error_of({.kind = Kind::write, .name = "VAR_NONE"}), "");
  EXPECT_EQ(error_of({.kind = Kind::write, .name = "PROG_VAR0", .by = "hots"}),
            "by: 'hots' is unknown; the nearest is 'host'");
  EXPECT_NE(error_of({.kind = Kind::event, .name = "exeption"}), "");
  EXPECT_TRUE(counting.debugger.breakpoints().empty());
  EXPECT_FALSE(counting.debugger.is_watching());
  for (std::size_t i = 0; i < Debugger::kMaxBreakpoints; ++i) EXPECT_EQ(error_of({.line = 1}), "");
  EXPECT_EQ(error_of({.line = 1}),
            "there are 256 breakpoints already; expected one of them to be deleted first");
  counting.debugger.remove_all();
  counting.world.switch_power(0, false);
  EXPECT_EQ(error_of({.line = 1}), "m has no power; expected it to be on");
  EXPECT_THROW(counting.debugger.begin_step(StepKind::line, 0, ""), BreakpointError);
}

TEST(Debugger, FindsItsLinesInEachProgramAnew) {
  Counting counting;
  counting.debugger.add({.line = 3});
  EXPECT_NE(counting.run(100), "");
  const WorldState before = save(counting.world);
  counting.world.load_program(0, "        NOP\n        END\n");
  EXPECT_EQ(counting.debugger.breakpoints()[0].line, 0) << "before time moves";
  set(counting.world, "PROG_MAIN_RunTime_START", 0);
  EXPECT_EQ(counting.run(100), "") << "it has no line 3";
  EXPECT_EQ(counting.debugger.breakpoints()[0].line, 0);
  restore(counting.world, before);
  counting.debugger.restart();
  EXPECT_EQ(counting.debugger.stop(), nullptr);
  EXPECT_EQ(counting.run(100), "breakpoint 1: m line 3: Delay_mSec 5");
  counting.world.switch_power(0, false);
  EXPECT_EQ(counting.run(100), "");
  counting.world.switch_power(0, true);
  EXPECT_EQ(counting.run(2000), "");
  counting.world.load_program(0, kCounter);
  set(counting.world, "PROG_MAIN_RunTime_START", 0);
  EXPECT_NE(counting.run(100), "") << "a power cycle does not delete it";
}

TEST(ProgramLines, AreOfAFileWithItsPartsInAnyOrder) {
  const std::string file = "MP 41\n  RSM_MACRO_TIMER 5\nEND\nMP 2\n  RSM_MACRO_TIMER 6\nEND\n";
  Bench bench = parse_bench(models::all_models(),
                            "understudy: 1\nlines: { a: { stations: [ { name: m, model: rs-m8194h } ] } }\n",
                            "bench.yaml", ".");
  bench.devices[0].settings.program = file;
  bench.devices[0].settings.program_name = "macros.mac";
  World world(bench, {}, {});
  const ProgramLines lines(world.device(0));
  EXPECT_EQ(lines.source(), "macros.mac");
  EXPECT_EQ(lines.text(), file);
  EXPECT_EQ(lines.lines(), (std::vector<int>{2, 5}));
  world.load_program(0, "MP 41\n  RSM_MACRO_TIMER 9\nEND\n");
  EXPECT_EQ(ProgramLines(world.device(0)).source(), "") << "it has another program";
}

struct StepCase {
  const char* model;
  const char* program;
  const char* start;  // "CALL_MPn=41", or a line of text
  int call;           // the line of the listing that calls
  int routine;        // the first line of the routine
  int second;         // the line one step later: labels take no tick of their own
  int behind;         // the line after the call
  const char* part;   // the number of programs that run at once
};

/// A routine waits for something that takes some ticks, so each step ends in a different tick. The first line
/// of a macro runs in the tick of its call, so a step continues to its second.
constexpr StepCase kSteps[] = {
    {"rs-m8194h",
     "MP 2\n  RSM_MACRO_TIMER 5\n  RSM_MACRO_TIMER 6\n  RSM_MACRO_TIMER 7\nEND\nMP 41\n  RSM_MACRO_TIMER 5\n "
     " RSM_MACRO_MP_CALL "
     "2\n"
     "  RSM_MACRO_TIMER 5\nEND\n",
     "CALL_MPn=41", 9, 3, 4, 10, ""},
    {"slim", "WT 5\nCALL 4\nWT 6\nRET\n$4 WT 7\nWT 8\nRET\n", "G", 2, 5, 6, 3, ""},
    {"super-40nc",
     "AREA C\nTMR K20\nCAL K100 K1\nTMR K30\nEND\nLAB K100\nTMR K20\nTMR K30\nRET\nAREA PLC\nEND\n",
     "M8000=1", 3, 6, 8, 4, "C"},
};

class Steps : public testing::TestWithParam<StepCase> {};

TEST_P(Steps, GoIntoRoutinesOverThemAndOutOfThem) {
  const StepCase& one = GetParam();
  DebuggedWorld world(one.model, one.program);
  world.debugger.add({.line = one.call});
  const std::string start = one.start;
  if (const std::size_t equals = start.find('='); equals != std::string::npos) {
    ASSERT_EQ(set(world.world, start.substr(0, equals), std::stoi(start.substr(equals + 1))), Refusal::none);
  } else {
    world.world.command(0, start);
  }
  const auto line = [&] { return world.debugger.stop() == nullptr ? 0 : world.debugger.stop()->place.line; };
  ASSERT_NE(world.run(2000), "") << world.world.device(0).user_program()->program_text();
  ASSERT_EQ(line(), one.call);
  const WorldState at_call = save(world.world);
  const DebugStop stop = *world.debugger.stop();

  EXPECT_NE(world.step(StepKind::line), "");
  EXPECT_EQ(line(), one.routine) << world.debugger.stop()->text;
  EXPECT_NE(world.step(StepKind::instruction), "");
  EXPECT_EQ(line(), one.second);
  EXPECT_NE(world.step(StepKind::out), "");
  EXPECT_EQ(line(), one.behind);
  EXPECT_THROW(world.debugger.begin_step(StepKind::out, 0, ""), BreakpointError);

  restore(world.world, at_call);
  world.debugger.restart();
  world.debugger.remove_all();
  world.debugger.add({.line = one.call});
  // The stop is over, so it starts where the program is.
  EXPECT_NE(world.step(StepKind::out, one.part), "");
  EXPECT_EQ(line(), one.behind);
}

TEST_P(Steps, OverACallEndBehindIt) {
  const StepCase& one = GetParam();
  DebuggedWorld world(one.model, one.program);
  world.debugger.add({.line = one.call});
  const std::string start = one.start;
  if (const std::size_t equals = start.find('='); equals != std::string::npos) {
    set(world.world, start.substr(0, equals), std::stoi(start.substr(equals + 1)));
  } else {
    world.world.command(0, start);
  }
  ASSERT_NE(world.run(2000), "");
  EXPECT_NE(world.step(StepKind::over), "");
  ASSERT_NE(world.debugger.stop(), nullptr);
  EXPECT_EQ(world.debugger.stop()->place.line, one.behind) << world.debugger.stop()->text;
}

INSTANTIATE_TEST_SUITE_P(Of, Steps, testing::ValuesIn(kSteps), [](const auto& test) {
  std::string name = test.param.model;
  std::erase(name, '-');
  return name;
});

/// Each scan of a PLC runs all lines, so a step continues behind the line of the stop in the next scan.
TEST(Step, OfALadderGoesFromLineToLine) {
  for (const StepKind kind : {StepKind::line, StepKind::instruction, StepKind::over}) {
    DebuggedWorld ladder("super-40nc", "AREA PLC\nLD M1\nOUT Y0\nLD M2\nOUT Y1\nLD M3\nOUT Y2\nEND\n");
    ladder.debugger.add({.line = 2});
    ASSERT_NE(ladder.run(2000), "");
    ladder.debugger.remove_all();
    std::vector<int> lines;
    SimTime before = ladder.world.now();
    for (int i = 0; i < 8; ++i) {
      ASSERT_NE(ladder.step(kind), "");
      EXPECT_LE(ladder.world.now() - before, time_of(2)) << "one scan a step, two behind the last line";
      before = ladder.world.now();
      lines.push_back(ladder.debugger.stop()->place.line);
    }
    EXPECT_EQ(std::vector(lines.begin(), lines.begin() + 5), (std::vector{3, 4, 5, 6, 7}));
    EXPECT_EQ(std::count(lines.begin(), lines.end(), 2), 1) << "after the last line comes the first";
    const std::vector<ProgramLocation> places = ladder.world.device(0).user_program()->program_locations();
    ASSERT_EQ(places.size(), 1U);
    EXPECT_EQ(places[0].program, "PLC");
    EXPECT_EQ(places[0].state, ProgramLocation::State::running);
  }
}

TEST(Step, EndsWhenTheAxesStand) {
  DebuggedWorld moved("simple2-r3");
  set(moved.world, "Aaxis_SVON", 1);
  set(moved.world, "Aaxis_Speed", 60);
  set(moved.world, "Aaxis_Pulse", 1000);
  set(moved.world, "Aaxis_Move_INC", 1);
  moved.run(3);
  EXPECT_EQ(moved.step(StepKind::stand, "", 10'000), "step: the axes of m are at rest");
  EXPECT_EQ(get(moved.world, "Cord_A"), 1000);
}

TEST(Step, EndsWhenItsProgramOrPowerIsGone) {
  Counting counting;
  counting.run(10);
  counting.debugger.begin_step(StepKind::line, 0, "");
  counting.world.switch_power(0, false);
  EXPECT_EQ(counting.run(10), "step: m has lost its power");
  EXPECT_EQ(counting.debugger.stop()->reason, DebugStop::Reason::power);
  EXPECT_FALSE(counting.debugger.is_stepping());
  Counting other;
  other.run(10);
  other.debugger.begin_step(StepKind::line, 0, "");
  other.world.load_program(0, "        Delay_mSec 9\n        END\n");
  set(other.world, "PROG_MAIN_RunTime_START", 0);
  EXPECT_EQ(other.run(100), "step: m has a different program");
}

}  // namespace debugger_test
}  // namespace understudy::emulator::world
