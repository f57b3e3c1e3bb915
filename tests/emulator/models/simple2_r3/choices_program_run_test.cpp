// Choices about flags, and about a program's beginning and end, shown by programs that run in the device.
// Started at tick 10, a program runs a line at 12, 14 and so on.
#include "tests/emulator/models/simple2_r3/choice_cases.h"

namespace understudy::emulator::models::simple2_r3 {
namespace choices_program_run_test {

// CMD of the lines used here.
constexpr std::uint16_t kDelay = 0x02, kJump = 0x03, kLoop = 0x04, kOut = 0x05, kEnd = 0xFF;
constexpr std::uint16_t kMoveA = 0x20, kCountUp = 0x51, kTimerStart = 0x55;
const ProgramLine kTheEnd{kEnd, 0, 0, 0};

bool runs(OneSimple2& feeder) { return feeder.bit("PROG_MAIN_RunTime_Status"); }

// --- flags -------------------------------------------------------------------------------------------

TEST(ChoicesFlags, AreFoundAtEveryWriteOrAtStart) {
  for (const auto& [option, at_once] :
       each_option<bool>("flags_found", {{"at_every_write", true}, {"at_start", false}})) {
    OneSimple2 feeder(with("flags_found", option));
    start_with_program(feeder, {{0, 0, 0, 1}, {kJump, 1, 0, 0}, kTheEnd, {kOut, 0, 1, 0}, kTheEnd});
    feeder.run(50);
    EXPECT_TRUE(runs(feeder)) << option << ": in a loop";
    feeder.set("MAIN_LINE3_JMP", 1);  // the last line with the flag, from now on
    feeder.run(50);
    EXPECT_EQ(feeder.output(0), at_once) << option;
    EXPECT_EQ(runs(feeder), !at_once) << option;
    feeder.set("PROG_MAIN_RunTime_START", 0);
    feeder.run(50);
    EXPECT_TRUE(feeder.output(0)) << option;
  }
  OneSimple2 kept(with("flags_found", "at_start"));  // by itself after power-up, too
  write_program(kept, {{kJump, 1, 0, 0}, kTheEnd, {kOut, 0, 1, 1}, kTheEnd});
  kept.set("AutoStart_MainProg", 1);
  kept.run(500);
  switch_off_and_on(kept);
  kept.run(20);
  EXPECT_TRUE(kept.output(0));
}

TEST(ChoicesFlags, BehindTheFirstEndCountOrDoNot) {
  for (const auto& [option, counts] :
       each_option<bool>("flags_after_end", {{"counts", true}, {"does_not_count", false}})) {
    OneSimple2 feeder(with("flags_after_end", option));
    // Without the flag the jump is to line 0, forever.
    start_with_program(feeder, {{kJump, 1, 0, 0}, {kOut, 1, 1, 0}, kTheEnd, {kOut, 0, 1, 1}, kTheEnd});
    feeder.run(50);
    EXPECT_EQ(feeder.output(0), counts) << option;
    EXPECT_EQ(runs(feeder), !counts) << option;
    feeder.set("MAIN_LINE2_CMD", 0);  // no END before it any more
    feeder.run(50);
    EXPECT_TRUE(feeder.output(0)) << option;
    feeder.set("MAIN_LINE1_JMP", 1);
    feeder.set("MAIN_LINE1_CMD", kEnd);  // the flag is on the END itself
    feeder.set("DOUT_0", 0);
    feeder.set("PROG_MAIN_RunTime_START", 0);
    feeder.run(50);
    EXPECT_EQ(feeder.output(0), counts) << option;
    EXPECT_FALSE(runs(feeder)) << option;
  }
}

TEST(ChoicesFlags, OfSeveralTheLastLineCountsOrTheOneWrittenLast) {
  for (const auto& [option, last_line] :
       each_option<bool>("same_flag_twice", {{"last_line", true}, {"last_written", false}})) {
    OneSimple2 feeder(with("same_flag_twice", option));
    const auto goes_to = [&] {
      feeder.set("DOUT_ALL", 0);
      feeder.set("PROG_MAIN_RunTime_START", 0);
      feeder.run(20);
      return feeder.get("DOUT_ALL");
    };
    write_program(
        feeder,
        {{kJump, 1, 0, 0}, {kOut, 0, 1, 1}, kTheEnd, {kOut, 1, 1, 1}, kTheEnd, {kOut, 2, 1, 0}, kTheEnd});
    EXPECT_EQ(goes_to(), 2) << option << ": written in order";
    feeder.set("MAIN_LINE1_JMP", 1);
    EXPECT_EQ(goes_to(), last_line ? 2 : 1) << option;
    feeder.set("MAIN_LINE5_JMP", 1);
    EXPECT_EQ(goes_to(), 4) << option;
    feeder.set("MAIN_LINE1_JMP", 1);
    feeder.set("MAIN_LINE1_JMP", 0);  // of those that are left, the last line
    EXPECT_EQ(goes_to(), 4) << option;
    feeder.set("MAIN_LINE3_JMP", 1);
    feeder.run(1000);
    switch_off_and_on(feeder);
    EXPECT_EQ(goes_to(), 4) << option << ": the order is not known any more";
  }
}

// --- beginning and end -----------------------------------------------------------------------------------

TEST(ChoicesProgramRun, TimersCountIn1Or10Or100Milliseconds) {
  // Started in slot 12, when tick 11 was the last; read after tick 311 and, stopped in slot 312, later. A
  // count comes with every multiple of the unit: 311 / 10 - 11 / 10 = 30, 311 / 100 - 0 = 3.
  for (const auto& [option, count] : each_option("timer_unit", {{"1ms", 300}, {"10ms", 30}, {"100ms", 3}})) {
    OneSimple2 feeder(with("timer_unit", option));
    start_with_program(feeder,
                       {{kTimerStart, 2, 0, 0}, {kDelay, 298 & 0xFF, 298 >> 8, 0}, {0x54, 2, 0, 0}, kTheEnd});
    feeder.run_to(311);
    EXPECT_EQ(feeder.get("Timer2_Value"), count) << option;
    feeder.run_to(1000);
    EXPECT_EQ(feeder.get("Timer2_Value"), count) << option << ": Timer_Stop";
    feeder.set("Timer2_Value", 4'294'967'295);
    EXPECT_EQ(feeder.get("Timer2_Value"), 4'294'967'295) << option;
  }
}

TEST(ChoicesProgramRun, TimersAtPowerUpAreStoppedOrRun) {
  for (const auto& [option, runs_by_itself] :
       each_option<bool>("timers_at_power_up", {{"stopped", false}, {"running", true}})) {
    OneSimple2 feeder(with("timers_at_power_up", option));
    feeder.run_to(100);
    EXPECT_EQ(feeder.get("Timer1_Value"), runs_by_itself ? 100 : 0) << option;
    switch_off_and_on(feeder);
    feeder.run(30);
    EXPECT_EQ(feeder.get("Timer2_Value"), runs_by_itself ? 30 : 0) << option << ": from 0 again";
    feeder.set("Factory_Reset", 1);
    feeder.run(7);
    EXPECT_EQ(feeder.get("Timer1_Value"), runs_by_itself ? 7 : 0) << option;
    start_with_program(feeder, {{0x54, 1, 0, 0}, kTheEnd});  // Timer_Stop
    feeder.run(20);
    const Value stopped = feeder.get("Timer1_Value");
    feeder.run(20);
    EXPECT_EQ(feeder.get("Timer1_Value"), stopped) << option;
  }
}

TEST(ChoicesProgramRun, StartKeepsOrClearsWhatProgramsCountWith) {
  for (const auto& [option, kept] :
       each_option<bool>("program_start", {{"keeps_them", true}, {"clears_them", false}})) {
    OneSimple2 feeder(with("program_start", option));
    const std::pair<const char*, Value> values[] = {{"Counter1_Value", 5}, {"Counter2_Value", 6},
                                                    {"CalcREG", -3},       {"Timer1_Value", 8},
                                                    {"PROG_VAR0", 9},      {"PROG_VAR31", 10}};
    for (const auto& [name, value] : values) feeder.set(name, value);
    feeder.set("PROG_MEM31", 11);
    feeder.set("Timer2_Value", 1);
    feeder.set("PROG_MAIN_RunTime_START", 0);
    for (const auto& [name, value] : values) EXPECT_EQ(feeder.get(name), kept ? value : 0) << option << name;
    EXPECT_EQ(feeder.get("PROG_MEM31"), 11) << option;
  }
}

TEST(ChoicesProgramRun, StartWhileRunningRestartsOrJumpsOrIsIgnored) {
  struct Expected {
    Value start_0, start_3;
  };
  // Three passes of a count, which end at 30. Started again after tick 17, in the second of them: from the
  // beginning three more; with the Loop's count still there two more; at line 3 the program ends.
  for (const auto& [option, expected] : each_option<Expected>(
           "start_while_running", {{"restarts", {4, 1}}, {"jumps", {3, 1}}, {"ignored", {3, 3}}})) {
    for (const auto& [line, counted] : {std::pair{0, expected.start_0}, std::pair{3, expected.start_3}}) {
      OneSimple2 feeder(with("start_while_running", option));
      start_with_program(feeder, {{0, 0, 0, 1}, {kCountUp, 1, 0, 0}, {kLoop, 1, 3, 0}, kTheEnd});
      feeder.run_to(17);
      feeder.set("PROG_MAIN_RunTime_START", line);
      feeder.run(100);
      EXPECT_FALSE(runs(feeder)) << option;
      EXPECT_EQ(feeder.get("Counter1_Value"), counted) << option << ", START " << line;
      feeder.set("PROG_MAIN_RunTime_START", 0);  // of a program that is not running: always a new start
      feeder.run(100);
      EXPECT_EQ(feeder.get("Counter1_Value"), counted + 3) << option << ", START " << line;
    }
  }
}

TEST(ChoicesProgramRun, ItsEndLetsMotionContinueOrStopsIt) {
  // The move begins in tick 12; END runs at 74, before that tick's motion, so 61 ms and 56 pulses are done.
  // The host ends it after tick 74.
  for (const auto& [option, continues] :
       each_option<bool>("program_end", {{"goes_on", true}, {"stops", false}})) {
    for (const bool by_host : {false, true}) {
      OneSimple2 feeder(with("program_end", option));
      feeder.set("ALL_SVON", 1);
      feeder.set_one_pulse_a_tick('A', 0);
      feeder.set("PROG_MEM0", 100);
      start_with_program(
          feeder,
          {{kMoveA, 0, 0, 0}, {kDelay, static_cast<std::uint16_t>(by_host ? 200 : 60), 0, 0}, kTheEnd});
      feeder.run_to(74);
      if (by_host) feeder.set("PROG_MAIN_RunTime_END", 1);
      EXPECT_FALSE(runs(feeder)) << option;
      feeder.run(200);
      EXPECT_EQ(feeder.coordinate('A'), continues ? 100 : by_host ? 57 : 56) << option;
    }
  }
}

TEST(ChoicesProgramRun, ErasingARunningProgramStopsItOrRunsOverNothing) {
  for (const auto& [option, continues] :
       each_option<bool>("erase_while_running", {{"stops_it", false}, {"goes_on", true}})) {
    OneSimple2 feeder(with("erase_while_running", option));
    start_with_program(feeder, {{kJump, 1, 0, 1}});
    feeder.run_to(20);
    feeder.set("PROG_MAIN_Erase_ALL", 1);
    EXPECT_EQ(runs(feeder), continues) << option;
    // Lines 0 to 255 at 22 to 532; the slot behind them ends it.
    feeder.run_to(533);
    EXPECT_EQ(runs(feeder), continues) << option;
    feeder.run_to(534);
    EXPECT_FALSE(runs(feeder)) << option;
  }
}

}  // namespace choices_program_run_test
}  // namespace understudy::emulator::models::simple2_r3
