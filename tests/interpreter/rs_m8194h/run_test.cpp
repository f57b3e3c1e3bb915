// Running macros.
#include "interpreter/rs_m8194h/run.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/state/state_bytes.h"
#include "interpreter/rs_m8194h/state_fields.h"
#include "tests/interpreter/rs_m8194h/scripted_machine.h"

namespace understudy::interpreter::rs_m8194h {
namespace run_test {

using Log = std::vector<std::string>;

struct Bench {
  explicit Bench(const std::string& text, const Options& with = {}) : options(with) { machine.store(text); }

  void start(int mp = 1) { start_mp(execution, mp, machine.now_ms + 1, machine); }
  /// Runs ticks. Returns what is left for the FIFO in the last one.
  int run(int ticks, int budget = 8) {
    int left = 0;
    for (int i = 0; i < ticks; ++i) {
      ++machine.now_ms;
      left = run_tick(execution, machine.now_ms, budget, is_paused, options, machine);
      EXPECT_TRUE(is_sound(execution, machine)) << machine.now_ms;
    }
    return left;
  }
  int var(std::size_t number) const { return machine.variables[number]; }

  Options options;
  ScriptedMachine machine;
  Execution execution;
  bool is_paused = false;
};

/// Lines without RSM_MACRO_, separated by '|' without blanks around it.
std::string mp(int number, const std::string& lines) {
  std::string text = "MP " + std::to_string(number) + "\n";
  std::string line;
  for (const char c : lines + "|") {
    if (c != '|' || line.ends_with(' ')) {
      line += c;
      continue;
    }
    if (!line.empty()) text += "RSM_MACRO_" + line + "\n";
    line.clear();
  }
  return text + "END\n";
}
std::string isr(int number, const std::string& lines) {
  const std::string text = mp(number, lines);
  return "ISR" + text.substr(2);
}

// --- the manual's programs -----------------------------------------------------------------------

TEST(RsM8194hRun, ArithmeticOfTheManualGivesWhatItsLinesSay) {
  Bench bench(
      mp(100,
         "SET_VAR VAR1 100|SET_VAR VAR2 200|VAR_CALCULATE VAR1 + VAR2 VAR3|SET_VAR VAR10 10|"
         "VAR_CALCULATE VAR2 * VAR10 VAR2|VAR_CALCULATE VAR3 - VAR1 VAR3|VAR_CALCULATE VAR3 / VAR2 VAR1"));
  bench.start(100);
  EXPECT_EQ(bench.run(1), 1);
  EXPECT_EQ(bench.var(1), 0);
  EXPECT_EQ(bench.var(2), 2000);
  EXPECT_EQ(bench.var(3), 200);
  EXPECT_EQ(bench.var(10), 10);
}

TEST(RsM8194hRun, LoopOfTheManualCountsItsVariableDown) {
  Bench bench(mp(100, "SET_VAR VAR1 100|FOR VAR1|FIXED_MOVE X 1000|FIXED_MOVE X -1000|NEXT"));
  bench.start(100);
  bench.run(100);
  EXPECT_EQ(bench.var(1), 0);
  EXPECT_EQ(std::ranges::count_if(bench.machine.log, [](auto& line) { return line.ends_with(" X 1000"); }),
            100);
  EXPECT_EQ(std::ranges::count_if(bench.machine.log, [](auto& line) { return line.ends_with(" X -1000"); }),
            100);
}

TEST(RsM8194hRun, BranchOfTheManualTakesItsFirstWay) {
  Bench bench(mp(
      100,
      "SET_VAR VAR1 100|SET_VAR VAR2 200|IF VAR1 < VAR2|FIXED_MOVE X 1000|ELSE|FIXED_MOVE X -1000|END_IF"));
  bench.start(100);
  bench.run(1);
  EXPECT_EQ(bench.machine.log, (Log{"1 FIXED_MOVE X 1000", "1 end"}));
}

TEST(RsM8194hRun, ReadingOfTheManualIsStored) {
  Bench bench(mp(1, "GET_LP X|SET_RVAR VAR5"));
  bench.machine.readings["RSM_MACRO_GET_LP X"] = -77;
  bench.start();
  bench.run(1);
  EXPECT_EQ(bench.var(5), -77);
}

// --- blocks --------------------------------------------------------------------------------------

TEST(RsM8194hRun, CountsDecideHowOftenALoopRuns) {
  for (const int count : {-2'000'000'000, -1, 0, 1, 2, 13}) {
    Bench bench(mp(1, "SET_VAR VAR2 " + std::to_string(count) + "|FOR " + std::to_string(count) +
                          "|VAR_CALCULATE VAR0 + 1 VAR0|NEXT|FOR VAR2|VAR_CALCULATE VAR1 + 1 VAR1|NEXT"));
    bench.start();
    bench.run(40);
    EXPECT_EQ(bench.var(0), std::max(count, 0));
    EXPECT_EQ(bench.var(1), std::max(count, 0));
    EXPECT_EQ(bench.var(2), std::min(count, 0));
  }
}

TEST(RsM8194hRun, VariableOfALoopIsItsCounter) {
  Bench bench(mp(41,
                 "SET_VAR VAR1 9|FOR VAR1|VAR_CALCULATE VAR0 + 1 VAR0|VAR_CALCULATE VAR1 / 2 VAR1|NEXT|"
                 "SET_VAR VAR2 5|FOR VAR2|EXIT_FOR|NEXT"));
  bench.start(41);
  bench.run(10);
  EXPECT_EQ(bench.var(0), 2);  // 9, 4, 3 after NEXT; 1, 0
  EXPECT_EQ(bench.var(1), 0);
  EXPECT_EQ(bench.var(2), 5);
}

TEST(RsM8194hRun, JumpsLeaveTheirBlocks) {
  Bench bench(
      mp(41,
         "LABEL 0|FOR 3|FOR 3|VAR_CALCULATE VAR0 + 1 VAR0|IF VAR0 < 2|GOTO 0|END_IF|EXIT_FOR|NEXT|NEXT|"
         "EXIT_MACRO|SET_VAR VAR0 0"));
  bench.start(41);
  bench.run(10);
  EXPECT_EQ(bench.var(0), 4);  // once before the jump, then three times
  EXPECT_FALSE(bench.execution.is_alive());
}

TEST(RsM8194hRun, EndlessLoopsLeaveNothingForOthers) {
  Bench bench(mp(1, "LABEL 0|VAR_CALCULATE VAR0 + 1 VAR0|GOTO 0"));
  bench.start();
  EXPECT_EQ(bench.run(3), 0);
  EXPECT_EQ(bench.var(0), 8);
  terminate(bench.execution);
  EXPECT_EQ(bench.run(1), 8);
  EXPECT_EQ(bench.machine.log, Log{});
}

// --- numbers -------------------------------------------------------------------------------------

TEST(RsM8194hRun, ArithmeticWrapsAndNothingIsDividedByZero) {
  struct Case {
    const char* line;
    int result;
  };
  constexpr Case kCases[] = {
      {"VAR1 + 2000000000", -294'967'296},
      {"VAR1 - VAR2", 2'000'000'001},
      {"VAR1 * VAR1", -1'651'507'200},  // 4 * 10^18 modulo 2^32
      {"7 / -2", -3},
      {"-7 / 2", -3},
      {"12 & 10", 8},
      {"12 | 3", 15},
      {"7 / 0", 0},
  };
  for (const Case& one : kCases) {
    Bench bench(mp(1, std::string("SET_VAR VAR1 2000000000|SET_VAR VAR2 -1|SET_VAR VAR3 99|VAR_CALCULATE ") +
                          one.line + " VAR3"));
    bench.start();
    bench.run(1);
    EXPECT_EQ(bench.var(3), one.result) << one.line;
    const Log wanted =
        std::string(one.line) == "7 / 0" ? Log{"1 fault 16 MP1 line 3", "1 end"} : Log{"1 end"};
    EXPECT_EQ(bench.machine.log, wanted) << one.line;
  }
}

TEST(RsM8194hRun, ReferencesAreReadWhenTheLineRuns) {
  Bench bench(mp(41,
                 "FRNET_OUT bVAR0 VAR1|SET_V X VAR2|FIXED_MOVE Y VAR3|SET_VAR VAR3 5|FIXED_MOVE Y VAR3|"
                 "FIXED_MOVE Y VAR4|FRNET_OUT bVAR1 0|NORMAL_SPEED X bVAR2"));
  bench.machine.byte_variables = {3, 8, 0x81};
  bench.machine.variables[1] = 0xFFFF;
  bench.machine.variables[2] = -5;
  bench.machine.variables[3] = -4;
  bench.machine.variables[4] = 2'000'000'001;
  bench.start(41);
  bench.run(2);
  EXPECT_EQ(bench.machine.log,
            (Log{"1 FRNET_OUT 3 65535", "1 SET_V X 0", "1 FIXED_MOVE Y -4", "1 FIXED_MOVE Y 5",
                 "1 fault 16 MP41 line 5", "1 fault 16 MP41 line 6", "1 fault 16 MP41 line 7", "1 end"}));
}

TEST(RsM8194hRun, WhatAVariableHoldsIsNotAReferenceAgain) {
  Bench bench(mp(41,
                 "SET_ACTION X 0 0 0 0 1 bVAR3 0 0 0|SET_ACTION X 0 0 0 0 bVAR1 bVAR3 0 0 0|"
                 "SET_ACTION X 0 0 0 0 1 bVAR2 0 0 0|SET_VAR VAR1 VAR2|FIXED_MOVE X VAR1"));
  bench.machine.byte_variables = {0, 0, 20, 0x83};
  bench.machine.variables[2] = 0x7FFF0003;
  bench.start(41);
  bench.run(1);
  EXPECT_EQ(bench.machine.log, (Log{"1 fault 16 MP41 line 0", "1 SET_ACTION X 0 0 0 0 0 bVAR3 0 0 0",
                                    "1 SET_ACTION X 0 0 0 0 1 20 0 0 0", "1 fault 16 MP41 line 4", "1 end"}));
}

TEST(RsM8194hRun, ReturnValuesOutliveCallsButNotTheRun) {
  const std::string text =
      mp(1, "SET_RVAR VAR0|GET_ERROR|MP_CALL 2|SET_RVAR VAR2") + mp(2, "SET_RVAR VAR1|GET_EP Y");
  Bench bench(text);
  bench.machine.readings = {{"RSM_MACRO_GET_ERROR", 1}, {"RSM_MACRO_GET_EP Y", 42}};
  bench.machine.variables[0] = 9;
  for (int i = 0; i < 2; ++i) {
    bench.start();
    bench.run(1);
    EXPECT_EQ(bench.var(0), 0);
    EXPECT_EQ(bench.var(1), 1);
    EXPECT_EQ(bench.var(2), 42);
  }
  Bench strict(text, {option("return_register_keeps", "execution_error")});
  strict.start();
  strict.run(1);
  EXPECT_EQ(strict.machine.log, (Log{"1 fault 16 MP1 line 0", "1 end"}));
}

// --- calls ---------------------------------------------------------------------------------------

TEST(RsM8194hRun, CallsGoDownToTheSeventhLevel) {
  const std::string text = mp(1, "VAR_CALCULATE VAR0 + 1 VAR0|MP_CALL 1|VAR_CALCULATE VAR1 + 1 VAR1");
  Bench bench(text);
  bench.start();
  bench.run(10);
  EXPECT_EQ(bench.var(0), 7);
  EXPECT_EQ(bench.var(1), 7);
  EXPECT_EQ(bench.machine.log, (Log{"2 fault 15 MP1 line 1", "3 end"}));
  Bench ending(text, {option("call_too_deep", "ends_the_macro")});
  ending.start();
  ending.run(10);
  EXPECT_EQ(ending.var(1), 6);
}

TEST(RsM8194hRun, NumberOfTheMacroAtWorkIsShown) {
  Bench bench(mp(1, "MP_CALL 2|TIMER 1") + mp(2, "TIMER 2|EXIT_MACRO|SET_VAR VAR0 1"));
  EXPECT_EQ(running_mp(bench.execution), 0);
  bench.start();
  EXPECT_EQ(running_mp(bench.execution), 1);
  bench.run(1);
  EXPECT_EQ(running_mp(bench.execution), 2);
  bench.run(2);
  EXPECT_EQ(running_mp(bench.execution), 1);
  bench.run(1);
  EXPECT_EQ(running_mp(bench.execution), 0);
  EXPECT_EQ(bench.machine.log, Log{"4 end"});
  EXPECT_EQ(bench.var(0), 0);
}

TEST(RsM8194hRun, WhatHasNoLinesEndsAtOnce) {
  Bench bench(mp(1, "") + mp(2, "MP_CALL 1|MP_CALL 99|SET_VAR VAR0 1"));
  bench.start(1);
  EXPECT_FALSE(bench.execution.is_alive());
  bench.start(99);
  EXPECT_FALSE(bench.execution.is_alive());
  EXPECT_EQ(bench.machine.log, (Log{"0 end", "0 end"}));
  bench.start(2);
  bench.run(1);
  EXPECT_EQ(bench.var(0), 1);
}

// --- waits ---------------------------------------------------------------------------------------

TEST(RsM8194hRun, TimersLastTheirTicks) {
  Bench bench(mp(41, "TIMER 0|DRV_HOLD X|TIMER 3|DRV_HOLD Y|SET_VAR VAR1 -5|TIMER VAR1|DRV_HOLD Z|TIMER 1"));
  bench.start(41);
  bench.run(10);
  EXPECT_EQ(bench.machine.log, (Log{"1 DRV_HOLD X", "4 DRV_HOLD Y", "4 DRV_HOLD Z", "5 end"}));
  Bench strict(mp(1, "SET_VAR VAR1 -5|TIMER VAR1"), {option("timer_negative", "execution_error")});
  strict.start();
  strict.run(1);
  EXPECT_EQ(strict.machine.log, (Log{"1 fault 16 MP1 line 1", "1 end"}));
}

TEST(RsM8194hRun, AxesAndDrivesAreWaitedFor) {
  Bench bench(mp(1, "STOP_WAIT XY|DRV_HOLD X|FIXED_MOVE Z 1|DRV_HOLD Y"));
  bench.machine.moving = 0x6;
  bench.start();
  EXPECT_EQ(bench.run(3), 0);
  bench.machine.moving = 0x4;
  bench.run(3);
  EXPECT_EQ(bench.machine.log, Log{"4 DRV_HOLD X"});
  bench.machine.moving = 0;
  EXPECT_EQ(bench.run(1), 6);
  EXPECT_EQ(bench.machine.log, (Log{"4 DRV_HOLD X", "7 FIXED_MOVE Z 1", "7 DRV_HOLD Y", "7 end"}));
}

TEST(RsM8194hRun, InputsAreWaitedForUpToTheTimeout) {
  const std::string text = mp(1, "FRNET_WAIT 8 3 1 4|DRV_HOLD X|FRNET_WAIT 8 3 0 0|DRV_HOLD Y");
  Bench bench(text);
  bench.start();
  bench.run(2);
  bench.machine.inputs = {131};
  bench.run(1000);
  EXPECT_EQ(bench.machine.log, Log{"3 DRV_HOLD X"});
  bench.machine.inputs.clear();
  bench.run(1);
  EXPECT_EQ(bench.machine.log.back(), "1003 end");
  Bench late(text);
  late.start();
  late.run(9);
  EXPECT_EQ(late.machine.log, (Log{"5 DRV_HOLD X", "5 DRV_HOLD Y", "5 end"}));
  Bench edge(text, {option("frnet_wait_level", "waits_for_the_change")});
  edge.machine.inputs = {131};
  edge.start();
  edge.run(9);
  EXPECT_EQ(edge.machine.log, Log{"5 DRV_HOLD X"});
  edge.machine.inputs.clear();
  edge.run(1);
  EXPECT_EQ(edge.machine.log.back(), "10 end");
}

TEST(RsM8194hRun, InputsAreWaitedForWithoutEndAtANegativeTime) {
  Bench bench(mp(1, "SET_VAR VAR1 -5|FRNET_WAIT 8 3 1 VAR1|DRV_HOLD X"));
  bench.start();
  bench.run(1);
  EXPECT_EQ(bench.execution.mp.hold, Hold::frnet);
  EXPECT_EQ(bench.execution.mp.until_ms, kNever);
}

TEST(RsM8194hRun, EachWaitForAChangeWantsOneOfItsOwn) {
  Bench bench(mp(1, "FRNET_WAIT 8 3 1 0|DRV_HOLD X|FRNET_WAIT 8 3 1 0|DRV_HOLD Y"),
              {option("frnet_wait_level", "waits_for_the_change")});
  bench.start();
  bench.run(2);
  bench.machine.inputs = {131};
  bench.run(5);
  EXPECT_EQ(bench.machine.log, Log{"3 DRV_HOLD X"});
  bench.machine.inputs.clear();
  bench.run(1);
  bench.machine.inputs = {131};
  bench.run(1);
  EXPECT_EQ(bench.machine.log.back(), "9 end");
}

TEST(RsM8194hRun, RestIsSkippedAtOnce) {
  Bench bench(mp(1, "TIMER 1000|DRV_HOLD X|STOP_WAIT X"));
  EXPECT_EQ(next_active_ms(bench.execution, 0), kNever);
  bench.start();
  EXPECT_EQ(next_active_ms(bench.execution, 0), 1);
  bench.run(1);
  EXPECT_EQ(next_active_ms(bench.execution, 1), 1001);
  bench.machine.moving = 1;
  bench.machine.now_ms = 1000;
  bench.run(1);
  EXPECT_EQ(bench.machine.log, Log{"1001 DRV_HOLD X"});
  EXPECT_EQ(next_active_ms(bench.execution, 1001), 1002);
}

TEST(RsM8194hRun, PausedNoMpContinuesButItsTimersDo) {
  Bench bench(mp(1, "TIMER 2|DRV_HOLD X") + isr(1, "DRV_HOLD U"));
  bench.start();
  bench.run(1);
  bench.is_paused = true;
  bench.machine.isrs = {{4, 1}};
  EXPECT_EQ(bench.run(5), 0);
  EXPECT_EQ(bench.machine.log, Log{"4 DRV_HOLD U"});
  bench.is_paused = false;
  bench.run(1);
  EXPECT_EQ(bench.machine.log, (Log{"4 DRV_HOLD U", "7 DRV_HOLD X", "7 end"}));
}

TEST(RsM8194hRun, WaitsCanBeGivenUp) {
  Bench bench(mp(1, "TIMER 500|DRV_HOLD X|FIXED_MOVE Y 1|STOP_WAIT Y"));
  bench.machine.moving = 2;
  bench.start();
  drop_wait(bench.execution, bench.machine);  // it has not started: nothing waits yet
  EXPECT_EQ(next_active_ms(bench.execution, -5), 1);
  bench.run(1);
  drop_wait(bench.execution, bench.machine);
  bench.run(1);
  EXPECT_EQ(bench.machine.log, Log{"2 DRV_HOLD X"});
  drop_wait(bench.execution, bench.machine);
  bench.run(1);
  EXPECT_TRUE(bench.execution.is_alive());
  drop_wait(bench.execution, bench.machine);
  EXPECT_FALSE(bench.execution.is_alive());
  EXPECT_EQ(bench.machine.log, (Log{"2 DRV_HOLD X", "3 end"}));
}

// --- interrupts ----------------------------------------------------------------------------------

TEST(RsM8194hRun, AnIsrComesBetweenTwoLines) {
  Bench bench(mp(91, "DRV_HOLD X|TIMER 4|DRV_HOLD Y|GET_LP X|TIMER 1|SET_RVAR VAR0") +
              isr(1, "DRV_HOLD Z|GET_LP U|SET_RVAR VAR1|FRNET_WAIT 8 0 1 5") + isr(2, "DRV_HOLD U"));
  bench.machine.readings = {{"RSM_MACRO_GET_LP X", 10}, {"RSM_MACRO_GET_LP U", 20}};
  bench.machine.isrs = {{3, 1}, {4, 2}};
  bench.start(91);
  bench.run(3);
  EXPECT_EQ(running_isr(bench.execution), 1);
  EXPECT_EQ(running_mp(bench.execution), 91);
  bench.run(20);
  // The timer of the MP ends while the ISR waits; the second ISR comes after the first.
  EXPECT_EQ(bench.machine.log,
            (Log{"1 DRV_HOLD X", "3 DRV_HOLD Z", "8 DRV_HOLD U", "8 DRV_HOLD Y", "9 end"}));
  EXPECT_EQ(bench.var(0), 10);
  EXPECT_EQ(bench.var(1), 20);
}

TEST(RsM8194hRun, IsrsByOtherReadingsOfTheManual) {
  const std::string text = mp(1, "TIMER 2|DRV_HOLD X|GET_LP X|TIMER 3|SET_RVAR VAR0") +
                           isr(1, "FRNET_WAIT 8 0 1 4|DRV_HOLD Z|GET_LP U") + isr(2, "DRV_HOLD U");
  const auto log_of = [&text](const Options& options) {
    Bench bench(text, options);
    bench.machine.readings = {{"RSM_MACRO_GET_LP X", 10}, {"RSM_MACRO_GET_LP U", 20}};
    bench.machine.isrs = {{2, 1}, {3, 2}};
    bench.start();
    bench.run(20);
    bench.machine.log.push_back(std::to_string(bench.var(0)));
    return bench.machine.log;
  };
  EXPECT_EQ(log_of({}), (Log{"6 DRV_HOLD Z", "6 DRV_HOLD U", "6 DRV_HOLD X", "9 end", "10"}));
  EXPECT_EQ(log_of({option("mp_during_isr", "goes_on_while_it_waits")}),
            (Log{"3 DRV_HOLD X", "6 DRV_HOLD Z", "6 DRV_HOLD U", "6 end", "10"}));
  EXPECT_EQ(log_of({option("isr_nesting", "nested")}),
            (Log{"3 DRV_HOLD U", "6 DRV_HOLD Z", "6 DRV_HOLD X", "9 end", "10"}));
  EXPECT_EQ(log_of({option("isr_waits", "are_passed_over")}),
            (Log{"2 DRV_HOLD Z", "3 DRV_HOLD U", "3 DRV_HOLD X", "6 end", "10"}));
  EXPECT_EQ(
      log_of({option("mp_during_isr", "goes_on_while_it_waits"), option("return_registers", "one_for_both")})
          .back(),
      "20");
}

TEST(RsM8194hRun, TerminateEndsAllOfThem) {
  Bench bench(mp(1, "TIMER 5|DRV_HOLD X") + isr(1, "MP_TERMINATE|DRV_HOLD Y"));
  bench.machine.isrs = {{2, 1}};
  bench.start();
  EXPECT_EQ(bench.run(2), 7);
  EXPECT_EQ(bench.machine.log, Log{"2 terminated"});
  EXPECT_FALSE(bench.execution.is_alive());
}

TEST(RsM8194hRun, WhereAMacroIsReplacedItEnds) {
  Bench bench(mp(1, "MP_CALL 2|DRV_HOLD X") + mp(2, "MP_CALL 3|DRV_HOLD Y") + mp(3, "TIMER 100|DRV_HOLD Z"));
  bench.start();
  bench.run(2);
  bench.machine.store(mp(2, "EXIT_MACRO"));
  replaced(bench.execution, {false, 2}, bench.machine);
  EXPECT_TRUE(is_sound(bench.execution, bench.machine));
  bench.run(1);
  EXPECT_EQ(bench.machine.log, (Log{"3 DRV_HOLD X", "3 end"}));
}

// --- state ---------------------------------------------------------------------------------------

TEST(RsM8194hRun, ContinuesFromItsBytes) {
  const std::string text = mp(151,
                              "SET_VAR VAR0 3|FOR 3|FOR VAR0|MP_CALL 152|TIMER 1|NEXT|GET_EP X|FRNET_WAIT 9 "
                              "1 0 3|NEXT|STOP_WAIT X") +
                           mp(152, "FOR 2|FIXED_MOVE Y 5|TIMER VAR5|NEXT|SET_RVAR VAR7") +
                           isr(1, "FRNET_WAIT 8 0 1 2|DRV_HOLD X");
  Bench whole(text);
  whole.machine.isrs = {{3, 1}, {9, 1}, {14, 1}};
  whole.machine.variables[5] = 2;
  Bench cut = whole;
  whole.start(151);
  cut.start(151);
  for (int tick = 0; tick < 90; ++tick) {
    whole.run(1, 3);
    StateWriter writer;
    writer.write(cut.execution);
    const std::vector<std::byte> bytes = writer.take();
    Execution restored;
    StateReader reader(bytes);
    reader.read(restored);
    EXPECT_EQ(restored, cut.execution);
    cut.execution = restored;
    cut.run(1, 3);
    ASSERT_EQ(cut.execution, whole.execution) << tick;
  }
  EXPECT_EQ(cut.machine.log, whole.machine.log);
  EXPECT_FALSE(whole.execution.is_alive());
}

TEST(RsM8194hRun, UnsoundStatesAreKnown) {
  Bench bench(mp(1, "FOR 2|TIMER 5|NEXT"));
  bench.start();
  bench.run(1);
  const Execution sound = bench.execution;
  EXPECT_TRUE(is_sound(sound, bench.machine));
  const auto is_sound_with = [&](auto change) {
    Execution execution = sound;
    change(execution);
    return is_sound(execution, bench.machine);
  };
  EXPECT_FALSE(is_sound_with([](Execution& e) { e.mp.levels[0].line = 9; }));
  EXPECT_FALSE(is_sound_with([](Execution& e) { e.mp.levels[0].line = 0; }));
  EXPECT_FALSE(is_sound_with([](Execution& e) { e.mp.levels[0].loops.clear(); }));
  EXPECT_FALSE(is_sound_with([](Execution& e) { e.mp.levels[0].number = 2; }));
  EXPECT_FALSE(is_sound_with([](Execution& e) { e.mp.levels[0].number = 0; }));
  EXPECT_FALSE(is_sound_with([](Execution& e) { e.isrs.push_back(e.mp); }));
  EXPECT_FALSE(is_sound_with([](Execution& e) { e.isrs.push_back({.is_isr = true}); }));
  EXPECT_FALSE(is_sound_with([](Execution& e) { e.mp.is_isr = true; }));
  EXPECT_FALSE(is_sound_with([](Execution& e) { e.mp.levels[0].loops[0].left = 0; }));
  EXPECT_FALSE(is_sound_with([](Execution& e) { e.mp = {.hold = Hold::timer}; }));
  for (const std::uint32_t axes : {0x10U, 0xFFFFFFFFU}) {
    EXPECT_FALSE(is_sound_with([axes](Execution& e) {
      e.mp.hold = Hold::axes;
      e.mp.awaited = axes;
    }));
  }
  for (const auto& [awaited, is_input] :
       {std::pair(0x00803U, true), std::pair(0x10F0FU, true), std::pair(0x703U, false),
        std::pair(0x1003U, false), std::pair(0x810U, false), std::pair(0x20803U, false)}) {
    const bool is_sound_wait = is_sound_with([awaited = awaited](Execution& e) {
      e.mp.hold = Hold::frnet;
      e.mp.awaited = awaited;
    });
    EXPECT_EQ(is_sound_wait, is_input) << awaited;
  }
}

}  // namespace run_test
}  // namespace understudy::interpreter::rs_m8194h
