// Options other than the default where they interact with the rest of the device (8.5 of the behaviour;
// docs/fidelity/proofs/rs-m8194h/ shows each one alone).
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace other_readings_test {

using Choices = std::map<std::string, std::string>;

/// X, Y and Z run at a constant speed from their first pulse on.
struct SteadyRsm : OneRsm {
  explicit SteadyRsm(Choices choices, std::string program = {})
      : OneRsm({.program = std::move(program), .choices = std::move(choices)}) {
    send({"RSM_SET_MAX_V XYZU 8000", "RSM_SET_SV XYZU 1000", "RSM_SET_V XYZU 1000", "RSM_AXIS_ASSIGN X Y Z",
          "RSM_SET_VSV 1000", "RSM_SET_VV 1000"});
    run(3);
  }
};

// --- table writes that become lines ----------------------------------------------------------------------

const Choices kLines{{"table_writes", "become_lines"}};

TEST(RsM8194hOtherReadings, TableWritesOfADownloadAreItsLines) {
  SteadyRsm rsm(kLines);
  rsm.send("RSM_MP_CREATE 21");
  EXPECT_EQ(rsm.ask("10 00 01 00 02 04 00 05 00 06"), "10 00 01 00 02");              // DO groups 1 and 2
  EXPECT_EQ(rsm.ask("06 00 08 00 03"), "06 00 08 00 03");                             // CALL_MP
  EXPECT_EQ(rsm.ask("10 00 58 00 04 08 00 00 00 07 FF FF FF FF"), "10 00 58 00 04");  // ABS_U, LP_X
  EXPECT_EQ(rsm.ask("10 00 68 00 02 04 00 00 00 08"), "10 00 68 00 02");              // EP_U
  EXPECT_EQ(rsm.ask("10 01 2E 00 02 04 00 00 00 09"), "10 01 2E 00 02");              // VAR1
  EXPECT_EQ(rsm.ask("06 00 81 00 0A"),
            "06 00 81 00 0A");  // bVAR1 has no line of its own, so it is written at once
  EXPECT_EQ(rsm.get("bVAR1"), 10);
  EXPECT_EQ(rsm.get("VAR1"), 0);
  EXPECT_EQ(rsm.get("LP_X"), 0);
  rsm.send("RSM_MACRO_MP_CLOSE");
  EXPECT_EQ(rsm.device().user_program()->program_text(),
            "MP 21\n  RSM_MACRO_FRNET_OUT 1 5\n  RSM_MACRO_FRNET_OUT 2 6\n  RSM_MACRO_MP_CALL 3\n"
            "  RSM_MACRO_ABS_SET_POSITION U 7\n  RSM_MACRO_SET_LP X -1\n  RSM_MACRO_SET_EP U 8\n"
            "  RSM_MACRO_SET_VAR VAR1 9\nEND\n");
  // Outside a download, they act as usual.
  rsm.set("VAR1", 3);
  EXPECT_EQ(rsm.get("VAR1"), 3);
}

TEST(RsM8194hOtherReadings, TableWritesThatDoNotFitAMacroAreRefusedWhole) {
  SteadyRsm rsm(kLines);
  rsm.send("RSM_MP_CREATE 1");  // eight lines
  rsm.send("RSM_MACRO_SET_VAR VAR9 1");
  std::string nine = "10 01 2C 00 10 20";
  for (int i = 0; i < 8; ++i) nine += " 00 00 00 01";
  EXPECT_EQ(rsm.ask(nine), "90 03");
  EXPECT_EQ(rsm.get("IllegalFuncErr"), 3);
  EXPECT_EQ(rsm.ask("10 01 2C 00 0E 1C" + nine.substr(nine.size() - 7 * 12)), "10 01 2C 00 0E");
  EXPECT_EQ(rsm.ask("10 01 2C 00 02 04 00 00 00 01"), "90 03");
  rsm.send("RSM_MACRO_MP_CLOSE");
  rsm.send("RSM_MP_ISR_CREATE 1");
  EXPECT_EQ(rsm.ask("06 00 08 00 03"), "86 03");  // no MP_CALL in an ISR
  EXPECT_EQ(rsm.get("IllegalFuncErr"), 4);
  EXPECT_EQ(rsm.ask("06 00 00 00 03"), "06 00 00 00 03");
  rsm.send("RSM_MACRO_MP_ISR_CLOSE");
  const std::string text = rsm.device().user_program()->program_text();
  EXPECT_EQ(text.substr(text.find("ISR")), "ISR 1\n  RSM_MACRO_FRNET_OUT 0 3\nEND\n");
}

// --- drives ------------------------------------------------------------------------------------------------

TEST(RsM8194hOtherReadings, AnAxisThatLeavesItsPathLeavesTheOthersOnIt) {
  SteadyRsm rsm(Choices{{"stop_one_of_path", "it_alone_stops"}});
  rsm.send({"RSM_VECTOR_SPEED 7", "RSM_LINE_3D 200 -300 400"});
  rsm.run(100);
  const Value at = rsm.get("LP_Y");
  rsm.send("RSM_STOP_SLOWLY Y");
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 5);
  rsm.run_to_rest();
  EXPECT_EQ(rsm.positions(), (std::vector<Value>{200, at, 400, 0}));
  EXPECT_EQ(rsm.get("ERROR_CODE_Y"), 0x100);
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0);
  // All that remain: the path ends.
  rsm.send({"RSM_CLEAR_STOP Y", "RSM_LINE_3D 200 200 200"});
  rsm.run(100);
  rsm.send("RSM_STOP_SUDDENLY Y");
  rsm.send("RSM_STOP_SUDDENLY XZ");
  rsm.run(3);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0x100);
  EXPECT_EQ(rsm.get("ERROR_CODE_Z"), 0x100);
}

TEST(RsM8194hOtherReadings, AnAxisThatLeavesItsPathSlowsDownByItsOwnRamp) {
  // From 1,000 PPS to 100 at 5,000 PPS/s: 99 pulses, in 180 ms. The line is at its speed from the beginning.
  for (const int direction : {+1, -1}) {
    OneRsm rsm(GivenRsm{.choices = {{"stop_one_of_path", "it_alone_stops"}}});
    rsm.send({"RSM_SET_MAX_V XY 8000", "RSM_SET_SV XY 100", "RSM_SET_V XY 100", "RSM_SET_A XY 5000",
              "RSM_AXIS_ASSIGN X Y 0", "RSM_VECTOR_SPEED 0", "RSM_SET_VV 1000"});
    rsm.run(3);
    rsm.send("RSM_INTFACTOR_ENABLE X 7 1");
    rsm.send("RSM_LINE_2D " + std::to_string(direction * 2000) + " 0");
    rsm.run(1001);
    const Value from = rsm.get("LP_X");
    rsm.send("RSM_STOP_SLOWLY X");
    EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0x100);
    rsm.run(178);
    EXPECT_EQ(rsm.get("DRIVING_AXIS"), 3);
    EXPECT_EQ(rsm.get("INT_D-END"), 0);
    rsm.run(4);
    EXPECT_EQ(rsm.get("DRIVING_AXIS"), 2);
    EXPECT_EQ(rsm.get("INT_D-END"), 1);
    EXPECT_NEAR(static_cast<double>(rsm.get("LP_X") - from), direction * 99, 1);
    rsm.run_to_rest();
  }
}

TEST(RsM8194hOtherReadings, AnAxisThatLeavesItsPathHasBegunAlready) {
  SteadyRsm rsm(Choices{{"stop_one_of_path", "it_alone_stops"}});
  rsm.send({"RSM_VECTOR_SPEED 0", "RSM_SET_SV X 100", "RSM_SET_A X 5000", "RSM_SET_PRESET U 77",
            "RSM_SYNC_ACTION X U 16 0 0 1 0 0 0 0 0 0", "RSM_LINE_2D 2000 0"});
  rsm.run(5);
  EXPECT_EQ(rsm.get("LP_U"), 77);
  rsm.send({"RSM_SET_LP U 0", "RSM_STOP_SLOWLY X"});
  rsm.run(20);
  EXPECT_EQ(rsm.get("DRIVING_AXIS") & 1, 1) << "it decelerates";
  EXPECT_EQ(rsm.get("LP_U"), 0) << "D-STA came with the path";
}

TEST(RsM8194hOtherReadings, AnAxisThatLeavesItsPathAtItsStartSpeedStands) {
  SteadyRsm rsm(Choices{{"stop_one_of_path", "it_alone_stops"}});
  rsm.send({"RSM_VECTOR_SPEED 0", "RSM_LINE_2D 2000 0"});
  rsm.run(100);
  const Value at = rsm.get("LP_X");
  rsm.send("RSM_STOP_SLOWLY X");
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 2);
  rsm.run(5);
  EXPECT_EQ(rsm.get("LP_X"), at);
}

TEST(RsM8194hOtherReadings, AConstantPathWithoutItsAxis1NotifiesNobody) {
  SteadyRsm rsm(Choices{{"stop_one_of_path", "it_alone_stops"}, {"c_sta_in_interpolation", "for_axis1"}});
  rsm.send({"RSM_VECTOR_SPEED 1", "RSM_SET_VSV 100", "RSM_SET_VA 1000", "RSM_INTFACTOR_ENABLE XY 5 1",
            "RSM_INTFACTOR_ENABLE XY 6 1", "RSM_LINE_2D 2000 2000"});
  rsm.run(100);
  rsm.send("RSM_STOP_SUDDENLY X");
  rsm.run_to_rest();
  rsm.run(2);
  EXPECT_EQ(rsm.get("LP_Y"), 2000);
  EXPECT_EQ(rsm.get("INT_C-STA"), 0);
  EXPECT_EQ(rsm.get("INT_C-END"), 0);
}

TEST(RsM8194hOtherReadings, ASegmentMayComeOnceTheNextHasBegun) {
  SteadyRsm rsm(Choices{{"rint_stream", "a_segment_may_come"}});
  rsm.send({"RSM_LINE_2D_INITIAL X Y 1000 1000 1000", "RSM_LINE_2D_CONTINUE 0 100 0",
            "RSM_LINE_2D_CONTINUE 0 100 0"});
  rsm.run(90);
  EXPECT_EQ(rsm.get("Continuous_Inp_Interrupt"), 0);
  rsm.run(20);
  EXPECT_EQ(rsm.get("Continuous_Inp_Interrupt"), 1);
}

TEST(RsM8194hOtherReadings, ADriveThatIsTakenAlongIsDroppedByAStop) {
  for (const bool stops : {false, true}) {
    SteadyRsm rsm(Choices{{"mask_drive", "axis_by_axis"}});
    rsm.send({"RSM_FIXED_MOVE X 100", "RSM_FIXED_MOVE XY 50"});
    rsm.run(60);
    EXPECT_EQ(rsm.get("LP_Y"), 50);
    EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 30);
    // One more must wait after it.
    rsm.send("RSM_FIXED_MOVE XZ 10");
    EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 29);
    EXPECT_EQ(rsm.get("LP_Z"), 0);
    if (stops) rsm.send({"RSM_STOP_SUDDENLY X"});
    rsm.run(200);
    const Value stopped = rsm.get("LP_X");
    EXPECT_EQ(rsm.get("LP_Z"), 10);
    EXPECT_EQ(stopped < 100, stops);
    EXPECT_EQ(stopped == 160, !stops);
  }
}

TEST(RsM8194hOtherReadings, WithoutASpeedNothingIsDriven) {
  for (const bool needs_speed : {false, true}) {
    Choices choices;
    if (needs_speed) choices = {{"power_on_values", "0_and_no_drive"}};
    const char* const kDrives[] = {"RSM_FIXED_MOVE X 10", "RSM_ABS_FIXED_MOVE X 10", "RSM_HOME_START X",
                                   "RSM_LINE_2D 10 10", "RSM_LINE_SCAN_START X 0 10"};
    for (const char* const drive : kDrives) {
      OneRsm rsm({.choices = choices});
      rsm.send({"RSM_SET_HOME_MODE X 0 1 0 0 0", "RSM_AXIS_ASSIGN X Y 0", drive});
      EXPECT_EQ(rsm.get("DRIVING_AXIS") == 0, needs_speed) << drive;
      rsm.run(50);
      rsm.send({"RSM_STOP_SUDDENLY XY", "RSM_CLEAR_STOP XY"});
      rsm.run(3);
      rsm.send({"RSM_SET_V X 100", "RSM_SET_HV X 100", "RSM_SET_VV 100", drive});
      EXPECT_NE(rsm.get("DRIVING_AXIS"), 0) << drive;
    }
    OneRsm rsm({.choices = choices});
    rsm.send("RSM_CONTINUE_MOVE X 100");
    EXPECT_EQ(rsm.get("DRIVING_AXIS"), 1);
  }
}

TEST(RsM8194hOtherReadings, AnActionWithoutASpeedDrivesNothing) {
  for (const bool has_speed : {false, true}) {
    OneRsm rsm({.choices = {{"power_on_values", "0_and_no_drive"}}});
    // Y starts, without an end, at the end of X's drive.
    rsm.send({"RSM_SYNC_ACTION X Y 0x20 3 0 0 0 0 0 0 0 0", "RSM_SET_SV XY 1000", "RSM_SET_V X 1000"});
    if (has_speed) rsm.send("RSM_SET_V Y 1000");
    rsm.send("RSM_FIXED_MOVE X 5");
    rsm.run(100);
    EXPECT_EQ(rsm.get("LP_X"), 5);
    EXPECT_EQ(rsm.get("LP_Y") > 50, has_speed);
    EXPECT_EQ(rsm.get("DRIVING_AXIS"), has_speed ? 2 : 0);
  }
}

TEST(RsM8194hOtherReadings, AScanAboveItsMaximumIsVoid) {
  struct Case {
    const char* speed;
    const char* scan;
    bool begins;
  };
  // 4,000,000 PPS with a pitch of 40 pulses are 100 kHz.
  constexpr Case kCases[] = {{"RSM_SET_V X 4000000", "RSM_LINE_SCAN X 0 0 0 -39", true},
                             {"RSM_SET_V X 4000000", "RSM_LINE_SCAN X 0 0 0 -38", false},
                             {"RSM_SET_V X 40000", "RSM_LINE_SCAN X 0 0 0 -9", true}};
  for (const Case& each : kCases) {
    OneRsm rsm({.choices = {{"scan_too_fast", "the_scan_is_void"}}});
    rsm.send({"RSM_SET_MAX_V X 4000000", "RSM_SET_SV X 4000000", each.speed, each.scan,
              "RSM_LINE_SCAN_START X 0 40000"});
    EXPECT_EQ(rsm.get("DRIVING_AXIS") != 0, each.begins) << each.speed << " " << each.scan;
  }
}

/// The pulses that a path continues after a slow stop, only along X.
Value slowing_pulses(const Choices& choices, const char* const stop) {
  SteadyRsm rsm(choices);
  rsm.send({"RSM_SET_MAX_V XY 80000", "RSM_VECTOR_SPEED 0", "RSM_SET_VSV 100", "RSM_SET_VV 10000",
            "RSM_SET_VA 20000", "RSM_LINE_2D 100000 0"});
  rsm.run(100);
  const Value before = rsm.get("LP_X");
  rsm.send(stop);
  rsm.run(2000);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  return rsm.get("LP_X") - before;
}

TEST(RsM8194hOtherReadings, AConstantPathSlowsDownByVaForEachSlowStop) {
  const Choices by_va{{"slow_stop_without_ramps", "slows_down_by_va"}};
  // From 10,000 PPS to 100 by 20,000 PPS/s.
  constexpr double kWay = (10'000.0 * 10'000 - 100.0 * 100) / 2 / 20'000;
  for (const char* const stop : {"RSM_STOP_SLOWLY X", "RSM_VSTOP_SLOWLY", "RSM_EMERGENCY_STOP 1"}) {
    EXPECT_NEAR(static_cast<double>(slowing_pulses(by_va, stop)), kWay, 12) << stop;
    EXPECT_LE(slowing_pulses({}, stop), 10) << stop;
  }
  EXPECT_EQ(slowing_pulses(by_va, "RSM_VSTOP_SUDDENLY"), 0);
}

TEST(RsM8194hOtherReadings, HomingTurnsRoundAtASoftLimitAndFindsHome) {
  SteadyRsm rsm(Choices{{"home_soft_limit", "turns_round"}});
  rsm.send({"RSM_SET_SLMT X 100 -10000 0", "RSM_SET_HV X 1000", "RSM_SET_HOME_MODE X 0 1 0 0 0",
            "RSM_HOME_START X"});
  rsm.run(150);
  EXPECT_EQ(rsm.get("HOME_STATE_X"), 8);
  rsm.pin(0, Pin::home, true);
  rsm.run(5);
  EXPECT_EQ(rsm.get("HOME_STATE_X"), 12);
  rsm.pin(0, Pin::home, false);
  rsm.run(5);
  EXPECT_EQ(rsm.get("HOME_STATE_X"), 15);
  rsm.pin(0, Pin::home, true);
  rsm.run(5);
  EXPECT_EQ(rsm.get("HOME_STATE_X"), 0);
  EXPECT_EQ(rsm.get("INT_HMEND"), 1);
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0);
}

// --- what a pause holds
// --------------------------------------------------------------------------------------

const Choices kHolds{{"trigger_pause", "and_holds_all_axes"}};
const std::string kPause = "TRIGGER 8.0 off_to_on pause\nTRIGGER 8.1 off_to_on clear_stop\n";

struct PausedRsm : SteadyRsm {
  PausedRsm() : SteadyRsm(kHolds, kPause) { set("FRNET_EVENT", 1); }
  void pause() {
    input(kFirstDi, true);
    run(5);
  }
  void go_on() {
    input(kFirstDi + 1, true);
    run(5);
  }
};

TEST(RsM8194hOtherReadings, APauseHoldsWhatMovesWhereItIs) {
  PausedRsm rsm;
  rsm.send({"RSM_SET_SV XYZU 100", "RSM_SET_A XYZU 2000", "RSM_FIXED_MOVE X -1000", "RSM_CONTINUE_MOVE U 500",
            "RSM_VECTOR_SPEED 0"});
  rsm.run(600);
  rsm.pause();
  rsm.run(2000);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  const Value x = rsm.get("LP_X");
  const Value u = rsm.get("LP_U");
  EXPECT_LT(x, -100);
  EXPECT_GT(x, -1000);
  // A saved state contains it as well.
  PausedRsm twin;
  twin.device().restore_state(rsm.device().save_state());
  for (OneRsm* const one : {static_cast<OneRsm*>(&rsm), static_cast<OneRsm*>(&twin)}) {
    one->run(1000);
    EXPECT_EQ(one->get("LP_X"), x);
    one->input(kFirstDi + 1, true);
    one->run(2000);
    EXPECT_EQ(one->get("LP_X"), -1000);
    EXPECT_EQ(one->get("DRIVING_AXIS"), 8);
    EXPECT_GT(one->get("LP_U"), u + 500);
    EXPECT_EQ(one->get("CV_U"), 500);
  }
}

TEST(RsM8194hOtherReadings, APauseLeavesAloneWhatComesToRest) {
  PausedRsm rsm;
  rsm.send({"RSM_SET_SV X 100", "RSM_SET_A X 1000", "RSM_CONTINUE_MOVE X 1000"});
  rsm.run(1200);
  rsm.send("RSM_STOP_SLOWLY X");
  rsm.run(100);
  rsm.pause();
  rsm.run(2000);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  const Value x = rsm.get("LP_X");
  rsm.go_on();
  rsm.run(500);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  EXPECT_EQ(rsm.get("LP_X"), x);
}

TEST(RsM8194hOtherReadings, AShortPauseIsOverOnceTheAxisStands) {
  PausedRsm rsm;
  rsm.send({"RSM_SET_SV X 100", "RSM_SET_A X 1000", "RSM_SET_V X 1000", "RSM_FIXED_MOVE X 3000"});
  rsm.run(1200);
  EXPECT_EQ(rsm.get("CV_X"), 1000);
  rsm.pause();
  rsm.go_on();
  // It is not at rest yet: it continues to decelerate.
  EXPECT_GT(rsm.get("CV_X"), 900);
  rsm.run(500);
  EXPECT_NEAR(static_cast<double>(rsm.get("CV_X")), 490, 20);
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_X"), 3000);
}

TEST(RsM8194hOtherReadings, APauseHoldsAPathOnItsWay) {
  PausedRsm rsm;
  rsm.send({"RSM_SET_MAX_V XY 80000", "RSM_VECTOR_SPEED 5", "RSM_SET_VSV 100", "RSM_SET_VV 1000",
            "RSM_SET_VA 2000", "RSM_CIRCLE_CW 300 0"});
  rsm.run(700);
  rsm.pause();
  rsm.run(1500);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 3) << "it is still a path";
  const std::vector<Value> held = rsm.positions();
  EXPECT_NEAR(std::hypot(static_cast<double>(held[0]) - 300, static_cast<double>(held[1])), 300, 1);
  rsm.run(500);
  EXPECT_EQ(rsm.positions(), held);
  rsm.go_on();
  rsm.run(20);
  EXPECT_NE(rsm.positions(), held);
  rsm.run_to_rest();
  EXPECT_EQ(rsm.positions(), (std::vector<Value>{0, 0, 0, 0}));
}

TEST(RsM8194hOtherReadings, AStopEndsWhatAPauseHolds) {
  PausedRsm rsm;
  rsm.send({"RSM_FIXED_MOVE X 1000", "RSM_FIXED_MOVE Z 1000"});
  rsm.run(100);
  rsm.pause();
  rsm.run(100);
  const Value x = rsm.get("LP_X");
  rsm.send("RSM_STOP_SUDDENLY X");
  rsm.send("RSM_VSTOP_SUDDENLY");  // does not apply to an axis that moves on its own
  rsm.go_on();                     // which clears the stop as well
  rsm.run(2000);
  EXPECT_EQ(rsm.get("LP_X"), x);
  EXPECT_EQ(rsm.get("LP_Z"), 1000);
}

// --- what reading clears
// ---------------------------------------------------------------------------------------

TEST(RsM8194hOtherReadings, AReadClearsWhatItHasShown) {
  SteadyRsm rsm(Choices{{"rint_clears", "by_reading_too"}, {"factors_clear", "by_reading_too"}},
                "MP 1\nRSM_MACRO_SET_VAR VAR1 1\nEND\n");
  rsm.send({"RSM_INTFACTOR_ENABLE XY 7 1", "RSM_INTFACTOR_ENABLE XY 0 1", "RSM_LINE_3D_CONTINUE 0 1 1 1"});
  rsm.set("CALL_MP", 1);
  rsm.run(5);
  rsm.send("RSM_FIXED_MOVE XY 5");
  rsm.run(20);
  EXPECT_EQ(rsm.get("RINT_STATE_ALL"), 2) << "the MP has ended; it has cleared the module's error";
  EXPECT_EQ(rsm.get("RINT_STATE_ALL"), 2) << "an observer clears nothing";
  EXPECT_EQ(rsm.ask("04 00 49 00 01"), "04 02 00 00");  // another bit
  EXPECT_EQ(rsm.ask("04 00 4A 00 01"), "04 02 00 01");
  EXPECT_EQ(rsm.ask("04 00 48 00 01"), "04 02 00 00");
  EXPECT_EQ(rsm.ask("04 00 89 00 01"), "04 02 00 03");
  EXPECT_EQ(rsm.ask("04 00 81 00 0A"), "04 14 00 00 00 03 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00");
  EXPECT_EQ(rsm.ask("04 00 82 00 01"), "04 02 00 00");
  rsm.send("RSM_LINE_3D_CONTINUE 0 1 1 1");
  rsm.set("CALL_MP", 1);
  rsm.run(5);
  rsm.send("RSM_LINE_3D_CONTINUE 0 1 1 1");
  rsm.run(5);
  EXPECT_EQ(rsm.ask("04 00 50 00 01"), "04 02 00 01");  // only the module's error
  EXPECT_EQ(rsm.ask("04 00 48 00 01"), "04 02 00 02");
  EXPECT_EQ(rsm.ask("04 00 48 00 01"), "04 02 00 00");
}

}  // namespace other_readings_test
}  // namespace understudy::emulator::models::rs_m8194h
