// Macros in the device: the download over the wire with its errors, the manual's programs, interaction with
// the FIFO, triggers without a host (5.4, 9, 10).
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace macros_test {

struct DownloadCase {
  int error;
  int reason;
  int macro;
  std::vector<std::string_view> lines;  // the last one is refused
  int line;
};
const DownloadCase kDownloadCases[] = {
    {0x01,
     3,
     1,
     {"RSM_MACRO_SET_V X 1", "RSM_MACRO_SET_V X 1", "RSM_MACRO_SET_V X 1", "RSM_MACRO_SET_V X 1",
      "RSM_MACRO_SET_V X 1", "RSM_MACRO_SET_V X 1", "RSM_MACRO_SET_V X 1", "RSM_MACRO_SET_V X 1",
      "RSM_MACRO_SET_V X 1"},
     8},
    {0x02,
     0xB1,
     41,
     {"RSM_MACRO_IF 1 == 1", "RSM_MACRO_IF 1 == 1", "RSM_MACRO_IF 1 == 1", "RSM_MACRO_IF 1 == 1",
      "RSM_MACRO_IF 1 == 1", "RSM_MACRO_IF 1 == 1", "RSM_MACRO_IF 1 == 1", "RSM_MACRO_IF 1 == 1"},
     7},
    {0x03, 0xB2, 1, {"RSM_MACRO_ELSE"}, 0},
    {0x04, 0xB3, 1, {"RSM_MACRO_END_IF"}, 0},
    {0x05, 0xB4, 1, {"RSM_MACRO_IF 1 == 1", "RSM_MACRO_MP_CLOSE"}, 0},
    {0x07,
     0xB5,
     41,
     {"RSM_MACRO_FOR 2", "RSM_MACRO_FOR 2", "RSM_MACRO_FOR 2", "RSM_MACRO_FOR 2", "RSM_MACRO_FOR 2",
      "RSM_MACRO_FOR 2", "RSM_MACRO_FOR 2", "RSM_MACRO_FOR 2"},
     7},
    {0x08, 0xB6, 1, {"RSM_MACRO_EXIT_FOR"}, 0},
    {0x09, 0xB7, 1, {"RSM_MACRO_SET_V X 1", "RSM_MACRO_NEXT"}, 1},
    {0x0A, 0xB8, 1, {"RSM_MACRO_FOR 2", "RSM_MACRO_MP_CLOSE"}, 0},
    {0x0B, 0xB9, 1, {"RSM_MACRO_LABEL 1", "RSM_MACRO_LABEL 1"}, 1},
    {0x0C, 0xBA, 1, {"RSM_MACRO_IF 1 == 1", "RSM_MACRO_LABEL 1"}, 1},
    {0x0D, 0xBB, 1, {"RSM_MACRO_FOR 2", "RSM_MACRO_LABEL 1"}, 1},
    {0x0E, 0xBC, 1, {"RSM_MACRO_GOTO 1", "RSM_MACRO_MP_CLOSE"}, 0},
};

TEST(RsM8194hMacros, EachDownloadErrorShowsWhatAndWhere) {
  for (const DownloadCase& row : kDownloadCases) {
    SCOPED_TRACE(row.error);
    OneRsm rsm({.program = "MP " + std::to_string(row.macro) + "\nRSM_MACRO_SET_VAR VAR1 42\nEND\n"});
    rsm.send("RSM_MP_CREATE " + std::to_string(row.macro));
    EXPECT_EQ(rsm.get("RSM_STATE"), 1);
    EXPECT_EQ(rsm.get("I8094H_STATE"), 3);
    for (std::size_t i = 0; i + 1 < row.lines.size(); ++i) rsm.send(row.lines[i]);
    EXPECT_EQ(rsm.exception(row.lines.back()), 3);
    EXPECT_EQ(rsm.get("IllegalFuncErr"), row.reason);
    if (row.lines.back() != "RSM_MACRO_MP_CLOSE") (void)rsm.exception("RSM_MACRO_MP_CLOSE");
    EXPECT_EQ(rsm.get("RSM_STATE"), 0);
    EXPECT_EQ(rsm.get("DOWNLOAD_MP"), row.macro);
    EXPECT_EQ(rsm.get("DOWNLOAD_ISR"), 0);
    EXPECT_EQ(rsm.get("DOWNLOAD_ERROR"), row.error);
    EXPECT_EQ(rsm.get("DOWNLOAD_LINE"), row.line);
    EXPECT_EQ(rsm.get("DOWNLOAD_CMD") & 0xFF00, 0x0A00);
    // The old macro is unchanged.
    rsm.send("RSM_MP_CALL " + std::to_string(row.macro));
    rsm.run(3);
    EXPECT_EQ(rsm.get("VAR1"), 42);
  }
}

struct Program {
  const char* section;
  const char* text;
  int call;
  std::map<std::string, Value> wanted;
};
const Program kPrograms[] = {
    {"9.1.1",
     "MP 21\nRSM_MACRO_SET_MAX_V XYZU 20000\nRSM_MACRO_NORMAL_SPEED XYZU 0\nRSM_MACRO_SET_V XYZU "
     "2000\nRSM_MACRO_SET_A XYZU 1000\nRSM_MACRO_SET_SV XYZU 2000\nRSM_MACRO_SET_AO XYZU "
     "9\nRSM_MACRO_FIXED_MOVE XYZU 10000\nEND\n",
     21,
     {{"LP_X", 10000}, {"LP_U", 10000}}},
    {"9.3.2",
     "MP 1\nRSM_MACRO_SET_LP X 77\nRSM_MACRO_GET_LP X\nRSM_MACRO_SET_RVAR VAR5\nEND\n",
     1,
     {{"VAR5", 77}}},
    {"9.4",
     "MP 100\nRSM_MACRO_SET_VAR VAR1 100\nRSM_MACRO_SET_VAR VAR2 200\nRSM_MACRO_VAR_CALCULATE VAR1 + VAR2 "
     "VAR3\nRSM_MACRO_VAR_CALCULATE VAR3 - 100 VAR3\nRSM_MACRO_VAR_CALCULATE VAR2 * 10 "
     "VAR2\nRSM_MACRO_VAR_CALCULATE VAR3 / VAR2 VAR1\nRSM_MACRO_SET_VAR VAR10 10\nEND\n",
     100,
     {{"VAR1", 0}, {"VAR2", 2000}, {"VAR3", 200}, {"VAR10", 10}}},
    {"9.5.1",
     "MP 100\nRSM_MACRO_SET_VAR VAR1 100\nRSM_MACRO_FOR VAR1\nRSM_MACRO_FIXED_MOVE X "
     "1000\nRSM_MACRO_FIXED_MOVE X -1000\nRSM_MACRO_GET_LP X\nRSM_MACRO_VAR_CALCULATE VAR7 + 1 "
     "VAR7\nRSM_MACRO_NEXT\nEND\n",
     100,
     {{"VAR1", 0}, {"VAR7", 100}, {"LP_X", 0}}},
    {"9.6.1",
     "MP 100\nRSM_MACRO_SET_VAR VAR1 100\nRSM_MACRO_SET_VAR VAR2 200\nRSM_MACRO_IF VAR1 < "
     "VAR2\nRSM_MACRO_FIXED_MOVE X 1000\nRSM_MACRO_ELSE\nRSM_MACRO_FIXED_MOVE X "
     "-1000\nRSM_MACRO_END_IF\nEND\n",
     100,
     {{"LP_X", 1000}}},
};

TEST(RsM8194hMacros, TheManualsProgramsDoWhatTheySay) {
  for (const Program& program : kPrograms) {
    SCOPED_TRACE(program.section);
    OneRsm rsm({.program = program.text});
    rsm.send({"RSM_SET_V X 100000", "RSM_SET_SV X 100000"});
    rsm.run(2);
    EXPECT_EQ(rsm.ask(world::write_request(8, static_cast<std::size_t>(program.call))).substr(0, 2), "06");
    EXPECT_EQ(rsm.get("MP_Call_number"), program.call);
    EXPECT_EQ(rsm.get("I8094H_STATE"), 5);
    rsm.run_to_rest();
    for (const auto& [name, value] : program.wanted) EXPECT_EQ(rsm.get(name), value) << name;
    EXPECT_EQ(rsm.get("MP_Completed"), 1);
    EXPECT_EQ(rsm.get("Module_Error"), 0);
  }
}

TEST(RsM8194hMacros, WhileOneRunsTheFifoWaitsAndCallsAreRefused) {
  OneRsm rsm({.program = "MP 1\nRSM_MACRO_TIMER 50\nEND\nMP 2\nRSM_MACRO_SET_VAR VAR2 1\nEND\n"});
  rsm.send({"RSM_MP_CALL 1", "RSM_SET_LP X 5"});
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 29);
  for (const char* command :
       {"RSM_MP_CALL 2", "RSM_MP_ISR_CALL 1", "RSM_MP_CREATE 3", "RSM_MP_ISR_CREATE 3", "RSM_LOAD_INITIAL"}) {
    EXPECT_EQ(rsm.exception(command), 6) << command;
    EXPECT_EQ(rsm.get("IllegalFuncErr"), 0xC3);
  }
  EXPECT_EQ(rsm.ask("06 00 08 00 02"), "86 06");
  rsm.run(40);
  EXPECT_EQ(rsm.get("LP_X"), 0);
  rsm.run(15);
  EXPECT_EQ(rsm.get("LP_X"), 5);
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 30);
}

TEST(RsM8194hMacros, TerminateEndsMacrosAndLeavesAxesMoving) {
  OneRsm rsm({.program = "MP 1\nRSM_MACRO_CONTINUE_MOVE X 1000\nRSM_MACRO_LABEL 0\nRSM_MACRO_TIMER "
                         "10\nRSM_MACRO_GOTO 0\nEND\n"});
  rsm.send("RSM_MP_CALL 1");
  rsm.run(100);
  EXPECT_EQ(rsm.get("MP_Call_number"), 1);
  rsm.send("RSM_MP_TERMINATE");
  EXPECT_EQ(rsm.get("MP_Call_number"), 0);
  EXPECT_EQ(rsm.get("MP_Completed"), 0);
  rsm.run(10);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 1);
}

TEST(RsM8194hMacros, SpeedsChangeOnTheFlyWhileOneRuns) {
  OneRsm rsm({.program = "MP 1\nRSM_MACRO_CONTINUE_MOVE X 1000\nRSM_MACRO_STOP_WAIT X\nEND\n"});
  rsm.send({"RSM_SET_A X 1000000", "RSM_SET_SV X 1000"});
  rsm.run(2);
  rsm.send("RSM_MP_CALL 1");
  rsm.run(50);
  rsm.send("RSM_CHANGE_VEL_ON_FLY X 3000");
  rsm.run(20);
  EXPECT_EQ(rsm.get("CV_X"), 3000);
}

TEST(RsM8194hMacros, DivisionByZeroIsAnExecutionError) {
  OneRsm rsm({.program = "MP 3\nRSM_MACRO_SET_VAR VAR1 5\nRSM_MACRO_VAR_CALCULATE VAR1 / VAR9 VAR1\nEND\n"});
  rsm.send("RSM_MP_CALL 3");
  rsm.run(4);
  EXPECT_EQ(rsm.get("VAR1"), 0);
  EXPECT_EQ(rsm.get("EXECUTION_MP"), 3);
  EXPECT_EQ(rsm.get("EXECUTION_LINE"), 1);
  EXPECT_EQ(rsm.get("EXECUTION_CMD"), 0x0AD4);
  EXPECT_EQ(rsm.get("EXECUTION_ERROR"), 0x10);
  EXPECT_EQ(rsm.get("Module_Error"), 1);
}

TEST(RsM8194hMacros, FrnetIsScannedEvery2Point88Milliseconds) {
  OneRsm rsm({.program = "MP 1\nRSM_MACRO_FRNET_WAIT 8 1 1 0\nRSM_MACRO_FRNET_OUT 2 "
                         "65280\nRSM_MACRO_FRNET_WRITE 2 0 1\nEND\n"});
  rsm.send("RSM_MP_CALL 1");
  rsm.run(21);
  EXPECT_EQ(rsm.get("MP_Call_number"), 1);
  // A pulse between two scans, at 20.16 and 23.04 ms, is not seen.
  rsm.input(kFirstDi + 1, true);
  rsm.run(1);
  rsm.input(kFirstDi + 1, false);
  rsm.run(8);
  EXPECT_EQ(rsm.get("MP_Call_number"), 1);
  rsm.input(kFirstDi + 1, true);
  rsm.run(5);
  EXPECT_EQ(rsm.get("MP_Call_number"), 0);
  EXPECT_EQ(rsm.ask("03 00 02 00 01"), "03 02 FF 01");
  EXPECT_EQ(rsm.ask("02 00 00 00 08"), "02 01 02");
  rsm.run(4);
  EXPECT_EQ(rsm.ports().output_word(kFirstDo + 32, 16), 0xFF01u);
}

TEST(RsM8194hMacros, FrnetIsScannedFromPowerUpOn) {
  constexpr Tick kScans[] = {3, 6, 9, 12, 15, 18, 21, 24, 26, 29, 32};  // 2.88 ms apart
  for (const Tick before : {0, 7, 1007}) {
    OneRsm rsm;
    rsm.run(before);
    rsm.world().switch_power(0, false);
    rsm.run(1);
    rsm.world().switch_power(0, true);
    bool level = false;
    for (Tick tick = 1; tick <= kScans[10]; ++tick) {
      level = !level;
      rsm.input(kFirstDi, level);
      const Value seen = rsm.input_word(8);
      rsm.run(1);
      const bool is_scan = std::ranges::count(kScans, tick) > 0;
      EXPECT_EQ(rsm.input_word(8), is_scan ? Value{level} : seen) << before << ", " << tick;
    }
  }
}

TEST(RsM8194hMacros, TriggersRunWithoutAHost) {
  OneRsm rsm({.program = "MP 1\nRSM_MACRO_FIXED_MOVE X 100\nRSM_MACRO_STOP_WAIT X\nEND\nMP "
                         "2\nRSM_MACRO_FIXED_MOVE X 10\nEND\n"
                         "TRIGGER 8.0 off_to_on MP1\nTRIGGER 8.1 on MP2\nTRIGGER 9.15 on hold Y\nTRIGGER "
                         "10.0 change abort_macro\n"});
  rsm.send({"RSM_SET_V XY 1000", "RSM_SET_SV XY 1000"});
  rsm.input(kFirstDi, true);
  rsm.run(10);
  EXPECT_EQ(rsm.get("LP_X"), 0);  // not enabled
  EXPECT_EQ(rsm.ask("06 00 09 00 01"), "06 00 09 00 01");
  rsm.run(10);
  EXPECT_EQ(rsm.get("LP_X"), 0);  // no edge yet
  rsm.input(kFirstDi, false);
  rsm.run(10);
  rsm.input(kFirstDi, true);
  rsm.run(10);
  EXPECT_EQ(rsm.get("MP_Call_number"), 1);
  rsm.input(kFirstDi + 1, true);  // waits its turn
  rsm.run(20);
  EXPECT_EQ(rsm.get("MP_Call_number"), 1);
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_X"), 110);
  rsm.input(kFirstDi + 31, true);
  rsm.run(10);
  rsm.send("RSM_FIXED_MOVE Y 100");
  rsm.run(10);
  EXPECT_EQ(rsm.get("LP_Y"), 0);
  rsm.input(kFirstDi + 31, false);
  rsm.run(200);
  EXPECT_EQ(rsm.get("LP_Y"), 100);
}

/// A level repeats its macro without any new event, so it must keep the module awake: in one long advance as
/// in single ticks.
TEST(RsM8194hMacros, ALevelRepeatsItsMacroAlsoInOneLongAdvance) {
  std::map<Value, Value> counts;
  for (const Value ticks_each : {1, 300}) {
    OneRsm rsm({.program = "MP 1\nRSM_MACRO_VAR_CALCULATE VAR0 + 1 VAR0\nRSM_MACRO_TIMER 3\nEND\n"
                           "TRIGGER 8.0 on MP1\n",
                .choices = {{"trigger_level_repeats", "again_when_it_has_ended"},
                            {"trigger_level_at_start", "waits_for_its_change"}}});
    rsm.input(kFirstDi, true);
    rsm.run(10);
    EXPECT_EQ(rsm.get("VAR0"), 0);
    EXPECT_EQ(rsm.ask("06 00 09 00 01"), "06 00 09 00 01");
    for (Value tick = 0; tick < 300; tick += ticks_each) rsm.run(ticks_each);
    counts[ticks_each] = rsm.get("VAR0");
    EXPECT_GE(counts[ticks_each], 300 / 5);  // 3 ms, plus one tick each to start and to end
  }
  EXPECT_EQ(counts[1], counts[300]);
}

TEST(RsM8194hMacros, AnAxisThatSeveralLevelsHoldIsLetGoByTheLast) {
  OneRsm rsm({.program = "TRIGGER 8.0 on hold X\nTRIGGER 8.1 on hold X\n"});
  rsm.send({"RSM_SET_V X 1000", "RSM_SET_SV X 1000"});
  EXPECT_EQ(rsm.ask("06 00 09 00 01"), "06 00 09 00 01");
  rsm.input(kFirstDi, true);
  rsm.input(kFirstDi + 1, true);
  rsm.run(10);
  rsm.send("RSM_FIXED_MOVE X 100");
  rsm.input(kFirstDi, false);
  rsm.run(10);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  rsm.input(kFirstDi + 1, false);
  rsm.run(10);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 1);
}

TEST(RsM8194hMacros, AnAbortedStopWaitTakesNothingElseAlong) {
  OneRsm rsm({.program = "TRIGGER 8.0 off_to_on abort_command\n"});
  rsm.send({"RSM_SET_V X 1000", "RSM_SET_SV X 1000"});
  EXPECT_EQ(rsm.ask("06 00 09 00 01"), "06 00 09 00 01");
  rsm.send({"RSM_CONTINUE_MOVE X 1000", "RSM_STOP_WAIT X", "RSM_SET_LP Y 5"});
  rsm.run(10);
  EXPECT_EQ(rsm.get("LP_Y"), 0);
  rsm.input(kFirstDi, true);
  rsm.run(10);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  EXPECT_EQ(rsm.get("LP_Y"), 5);
}

}  // namespace macros_test
}  // namespace understudy::emulator::models::rs_m8194h
