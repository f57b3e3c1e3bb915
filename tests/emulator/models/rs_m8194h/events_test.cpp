// Synchronous actions, interrupt factors and ISRs, the line scan (7.3, 7.4.12): the manual's examples and
// others.
#include <gtest/gtest.h>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace events_test {

struct SteadyRsm : OneRsm {
  explicit SteadyRsm(const std::string& program = "") : OneRsm({.program = program}) {
    send({"RSM_SET_MAX_V XYZU 80000", "RSM_SET_SV XYZU 2000", "RSM_SET_V XYZU 2000"});
    run(2);
  }
};

TEST(RsM8194hEvents, AComparatorStartsAnotherAxis) {
  // 7.3.1, example 2: at EP(U) >= 5000 Y moves by its preset.
  SteadyRsm rsm;
  rsm.send({"RSM_SYNC_ACTION U Y 1 1 0 3 0 0 0 0 0 0", "RSM_SET_COMPARE U 0 1 5000", "RSM_FIXED_MOVE U 10000",
            "RSM_SET_PRESET Y 2000"});
  rsm.run(2490);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 8);
  rsm.run(20);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 10);
  rsm.run_to_rest();
  EXPECT_EQ(rsm.positions(), (std::vector<Value>{0, 2000, 0, 10000}));
}

TEST(RsM8194hEvents, AnAxisStopsItselfAtThePulse) {
  // 7.3.1, example 4: X stops at 5000, and its ISR moves Y.
  SteadyRsm rsm("ISR 1\nRSM_MACRO_FIXED_MOVE Y 1000\nEND\n");
  rsm.send({"RSM_ENABLE_INT", "RSM_SYNC_ACTION X X 1 6 0 0 0 1 1 0 0 0", "RSM_SET_COMPARE X 0 0 5000",
            "RSM_FIXED_MOVE X 10000"});
  rsm.run(2600);
  EXPECT_EQ(rsm.get("LP_X"), 5000);
  EXPECT_EQ(rsm.get("INT_SYNC"), 1);
  rsm.run_to_rest();
  EXPECT_EQ(rsm.positions(), (std::vector<Value>{5000, 1000, 0, 0}));
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0);
}

TEST(RsM8194hEvents, IsrsArmTheNextOne) {
  // 7.3.12.
  SteadyRsm rsm(
      "ISR 1\nRSM_MACRO_FIXED_MOVE Y 1000\nRSM_MACRO_SET_COMPARE X 0 0 4000\nRSM_MACRO_INTFACTOR_ENABLE X 4 "
      "2\nEND\n"
      "ISR 2\nRSM_MACRO_FIXED_MOVE Z 1000\nRSM_MACRO_SET_COMPARE X 0 0 6000\nRSM_MACRO_INTFACTOR_ENABLE X 4 "
      "3\nEND\n"
      "ISR 3\nRSM_MACRO_FIXED_MOVE U 1000\nRSM_MACRO_INTFACTOR_DISABLE X 10\nEND\n");
  rsm.send({"RSM_SET_COMPARE X 0 0 2000", "RSM_ENABLE_INT", "RSM_INTFACTOR_ENABLE X 4 1",
            "RSM_FIXED_MOVE X 16000"});
  rsm.run(1500);
  EXPECT_EQ(rsm.get("LP_Z"), 0);
  EXPECT_GT(rsm.get("LP_Y"), 900);
  rsm.run_to_rest();
  EXPECT_EQ(rsm.positions(), (std::vector<Value>{16000, 1000, 1000, 1000}));
}

struct FactorCase {
  const char* command;
  Value axes;
};

TEST(RsM8194hEvents, EnabledFactorsAreNotedForTheirAxes) {
  SteadyRsm rsm;
  for (int factor = 0; factor <= 7; ++factor)
    rsm.send("RSM_INTFACTOR_ENABLE XZ " + std::to_string(factor) + " 1");
  rsm.send({"RSM_SET_COMPARE XYZU 0 0 100", "RSM_SET_COMPARE XYZU 1 0 -100", "RSM_SET_SV XZ 100",
            "RSM_SET_A XZ 100000"});
  rsm.run(2);
  rsm.send("RSM_INTFACTOR_ENABLE XZ 2 1");
  rsm.send({"RSM_FIXED_MOVE XY 1000", "RSM_FIXED_MOVE Z -1000"});
  rsm.run_to_rest();
  rsm.run(2);
  EXPECT_EQ(rsm.get("INT_PULSE"), 5);
  EXPECT_EQ(rsm.get("INT_P_GE_C+"), 1);  // only X has passed C+
  EXPECT_EQ(rsm.get("INT_P_LT_C-"), 4);  // and only Z has passed C-
  EXPECT_EQ(rsm.get("INT_C-STA"), 5);
  EXPECT_EQ(rsm.get("INT_C-END"), 5);
  EXPECT_EQ(rsm.get("INT_D-END"), 5);
  rsm.send("RSM_INTFACTOR_DISABLE X 10");
  EXPECT_EQ(rsm.get("INT_PULSE"), 4);
  EXPECT_EQ(rsm.get("INT_D-END"), 4);
}

TEST(RsM8194hEvents, WithInterruptsOffNoIsrIsCalledLaterEither) {
  SteadyRsm rsm("ISR 1\nRSM_MACRO_SET_VAR VAR1 1\nEND\n");
  rsm.send({"RSM_INTFACTOR_ENABLE X 7 1", "RSM_FIXED_MOVE X 10"});
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("INT_D-END"), 1);
  rsm.send("RSM_ENABLE_INT");
  rsm.run(5);
  EXPECT_EQ(rsm.get("VAR1"), 0);
  rsm.send("RSM_FIXED_MOVE X 10");
  rsm.run_to_rest();
  rsm.run(5);
  EXPECT_EQ(rsm.get("VAR1"), 1);
}

TEST(RsM8194hEvents, AComparatorComparesTheCounterThatItNames) {
  for (const int type : {0, 1}) {
    SteadyRsm rsm;
    rsm.send({"RSM_SET_LP X 500", "RSM_SET_EP X 1000", "RSM_INTFACTOR_ENABLE X 4 1"});
    rsm.send("RSM_SET_COMPARE X 0 " + std::to_string(type) + (type == 0 ? " 550" : " 1050"));
    rsm.send("RSM_FIXED_MOVE X 100");
    Value at = 0;
    for (int i = 0; i < 50 && at == 0; ++i) {
      rsm.run(1);
      if (rsm.input_word(134) != 0) at = rsm.get("LP_X");
    }
    // Within a millisecond's pulses of the 50th.
    EXPECT_GE(at, 550) << type;
    EXPECT_LE(at, 560) << type;
  }
}

TEST(RsM8194hEvents, LatchesAndPresetsAreOfTheMomentOfTheEdge) {
  // 7.3.1's first example: IN3 latches EP and sets it to zero.
  SteadyRsm rsm;
  rsm.send({"RSM_SYNC_ACTION U U 64 0 2 2 1 0 0 0 0 0", "RSM_SET_PRESET U 100"});
  rsm.pin(3, Pin::in3, true);
  rsm.run(2);
  rsm.send("RSM_FIXED_MOVE U 1000");
  rsm.run(100);
  rsm.pin(3, Pin::in3, false);  // the contact opens: the line goes high
  rsm.run(1);
  const Value latched = rsm.get("LATCH_U");
  EXPECT_NEAR(static_cast<double>(latched), 200, 3);
  EXPECT_NEAR(static_cast<double>(rsm.get("EP_U")), 101, 3);
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_U"), 1000);
  EXPECT_EQ(rsm.get("EP_U"), 1000 - latched + 100);
}

TEST(RsM8194hEvents, EachDriveAndPresetDoesWhatItsLineSays) {
  // The lines of 7.3.1: nDRV by nPRESET, of Y, at the start of a move of X.
  enum Drives { none, fixed_plus, fixed_minus, endless_plus, endless_minus, slow_stop, sudden_stop };
  enum Presets { nothing, position, encoder, distance, speed };
  constexpr Value kPreset = 500;
  for (int drive = none; drive <= sudden_stop; ++drive) {
    for (int preset = nothing; preset <= speed; ++preset) {
      SCOPED_TRACE("nDRV " + std::to_string(drive) + ", nPRESET " + std::to_string(preset));
      SteadyRsm rsm;
      rsm.send({"RSM_SET_SV Y 100", "RSM_SET_A Y 100000", "RSM_SET_PRESET Y 500"});
      rsm.send("RSM_SYNC_ACTION X Y 16 " + std::to_string(drive) + " 0 " + std::to_string(preset) +
               " 0 0 0 0 0 0");
      const bool is_stop = drive >= slow_stop;
      if (is_stop) rsm.send("RSM_CONTINUE_MOVE Y 2000");
      rsm.run(100);
      rsm.send("RSM_FIXED_MOVE X 2");
      rsm.run(400);
      const bool is_endless = drive == endless_plus || drive == endless_minus;
      const int direction = drive == fixed_plus || drive == endless_plus ? 1 : -1;
      const bool is_fixed = drive == fixed_plus || drive == fixed_minus;
      EXPECT_EQ(rsm.get("DRIVING_AXIS"), is_endless ? 2 : 0);
      // For an endless drive neither a distance nor a speed has a meaning.
      if (is_endless) {
        EXPECT_EQ(rsm.get("CV_Y"), 2000);
      }
      const Value moved = is_fixed && preset == distance ? direction * kPreset : 0;
      const Value absolute = rsm.get("ABS_Y");
      if (!is_endless && !is_stop) {
        EXPECT_EQ(absolute, moved);
      }
      if (is_endless) {
        EXPECT_EQ(absolute > 0, direction > 0);
      }
      // All three have the same count, except for the preset; a stop takes some pulses first.
      EXPECT_EQ(rsm.get("LP_Y") != absolute, preset == position);
      EXPECT_EQ(rsm.get("EP_Y") != absolute, preset == encoder);
      if (!is_stop && preset == position) {
        EXPECT_EQ(rsm.get("LP_Y") - absolute, kPreset);
      }
      if (!is_stop && preset == encoder) {
        EXPECT_EQ(rsm.get("EP_Y") - absolute, kPreset);
      }
      // V for the next drive.
      rsm.send(
          {"RSM_STOP_SUDDENLY Y", "RSM_CLEAR_STOP Y", "RSM_CLEAR_SYNC_ACTION X", "RSM_FIXED_MOVE Y 1000"});
      rsm.run(100);
      EXPECT_EQ(rsm.get("CV_Y"), preset == speed && !is_endless ? kPreset : 2000);
    }
  }
}

TEST(RsM8194hEvents, ASpeedPresetOfZeroLeavesTheSpeed) {
  SteadyRsm rsm;
  rsm.send({"RSM_SYNC_ACTION X Y 16 0 0 4 0 0 0 0 0 0", "RSM_SET_PRESET Y 0", "RSM_CONTINUE_MOVE Y 2000"});
  rsm.run(100);
  rsm.send("RSM_FIXED_MOVE X 2");
  rsm.run(100);
  EXPECT_EQ(rsm.get("CV_Y"), 2000);
  rsm.send({"RSM_STOP_SUDDENLY Y", "RSM_CLEAR_STOP Y", "RSM_FIXED_MOVE Y 1000"});
  rsm.run(100);
  EXPECT_EQ(rsm.get("CV_Y"), 2000);
}

TEST(RsM8194hEvents, LineScansTriggerAtTheirPitch) {
  SteadyRsm rsm;
  rsm.send({"RSM_LINE_SCAN X 0 0 0 -39"});
  rsm.send({"RSM_LINE_SCAN_START XY 0 -4010"});
  EXPECT_EQ(rsm.get("Line_Scan_Completed"), 0);
  rsm.run_to_rest();
  rsm.run(1);
  EXPECT_EQ(rsm.get("Line_Scan_Completed"), 1);
  EXPECT_EQ(rsm.get("LP_Y"), -4010);
  EXPECT_EQ(rsm.ports().output_pulses(kFirstOut), 100);
  EXPECT_EQ(rsm.ports().output_pulses(kFirstOut + 1), 0);
  // The setting has been used.
  rsm.send({"RSM_LINE_SCAN_START X 0 4000"});
  rsm.run_to_rest();
  EXPECT_EQ(rsm.ports().output_pulses(kFirstOut), 100);
}

TEST(RsM8194hEvents, ScansAreCompletedOnceAllOfThemStand) {
  SteadyRsm rsm;
  // Y has no setting, and moves without triggers.
  rsm.send({"RSM_LINE_SCAN_START Y 0 2000", "RSM_LINE_SCAN X 0 0 0 9", "RSM_LINE_SCAN_START X 0 200"});
  rsm.run(200);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 2);
  EXPECT_EQ(rsm.get("Line_Scan_Completed"), 0);
  rsm.run_to_rest();
  rsm.run(1);
  EXPECT_EQ(rsm.get("Line_Scan_Completed"), 1);
}

TEST(RsM8194hEvents, AScanThatDoesNotMoveLeavesItsFirstPlaceInCPlus) {
  SteadyRsm rsm;
  rsm.pin(0, Pin::limit_plus, true);
  rsm.send({"RSM_SET_LP X 500", "RSM_LINE_SCAN X 0 0 0 9", "RSM_LINE_SCAN_START X 0 1000"});
  rsm.run(5);
  EXPECT_EQ(rsm.get("LP_X"), 500);
  EXPECT_EQ(rsm.get("Line_Scan_Completed"), 1);
  EXPECT_EQ(rsm.state().units[0].compare[0].value, 510);
}

// A ring wraps, and the counter may be set during the move: the distance decides.
TEST(RsM8194hEvents, LineScansContinueWhenTheirCounterJumps) {
  for (const int type : {0, 2}) {
    SteadyRsm rsm;
    const std::string of_type = std::to_string(type);
    rsm.send({"RSM_VRING_ENABLE X 999", "RSM_LINE_SCAN X " + of_type + " 0 0 49",
              "RSM_LINE_SCAN_START X " + of_type + " 5000"});
    rsm.run_to_rest();
    rsm.run(1);
    EXPECT_EQ(rsm.ports().output_pulses(kFirstOut), 100);
    EXPECT_EQ(rsm.state().units[0].compare[0].value, 50);
    rsm.send({"RSM_VRING_DISABLE X", "RSM_LINE_SCAN X " + of_type + " 0 0 -99",
              "RSM_LINE_SCAN_START X " + of_type + " -5000"});
    rsm.run(20);
    rsm.send({"RSM_SET_LP X 1000000", "RSM_SET_EP X 1000000"});
    rsm.run_to_rest();
    rsm.run(1);
    EXPECT_EQ(rsm.ports().output_pulses(kFirstOut), 150);
  }
}

TEST(RsM8194hEvents, AHeldLineScanBeginsWhenItIsReleased) {
  SteadyRsm rsm;
  rsm.send({"RSM_DRV_HOLD X", "RSM_LINE_SCAN X 0 0 0 9", "RSM_LINE_SCAN_START X 0 1000"});
  rsm.run(50);
  EXPECT_EQ(rsm.get("Line_Scan_Completed"), 0) << "it has not started";
  rsm.send("RSM_DRV_START X");
  rsm.run(100);
  EXPECT_EQ(rsm.get("Line_Scan_Completed"), 0);
  rsm.run(500);
  EXPECT_EQ(rsm.get("Line_Scan_Completed"), 1);
  EXPECT_EQ(rsm.ports().output_pulses(kFirstOut), 100);
}

TEST(RsM8194hEvents, ALineScanByAnEncoderHasItsLastTriggerToo) {
  world::PlantSetup plant;
  plant.encoder_counts_per_revolution = 4000;
  plant.pulses_per_revolution = 1000;
  for (const int direction : {+1, -1}) {
    OneRsm rsm({.plant = {{0, plant}}});
    rsm.send({"RSM_SET_SV X 2000", "RSM_SET_V X 2000", "RSM_LINE_SCAN X 2 0 0 -39"});
    rsm.send("RSM_LINE_SCAN_START X 2 " + std::to_string(direction * 1000));
    rsm.run(550);
    EXPECT_EQ(rsm.get("EP_X"), direction * 4000);
    EXPECT_EQ(rsm.ports().output_pulses(kFirstOut), 100);
    EXPECT_EQ(rsm.get("Line_Scan_Completed"), 1);
  }
}

TEST(RsM8194hEvents, LineScansThatBeginApartAreBothGiven) {
  SteadyRsm rsm;
  rsm.send({"RSM_LINE_SCAN X 0 0 0 9", "RSM_LINE_SCAN Y 0 0 0 4", "RSM_LINE_SCAN_START X 0 2000"});
  rsm.run(100);
  rsm.send("RSM_LINE_SCAN_START Y 0 500");
  rsm.run(400);
  EXPECT_EQ(rsm.get("Line_Scan_Completed"), 0) << "X is moving";
  rsm.run(600);
  EXPECT_EQ(rsm.get("Line_Scan_Completed"), 1);
  EXPECT_EQ(rsm.ports().output_pulses(kFirstOut), 200);
  EXPECT_EQ(rsm.ports().output_pulses(kFirstOut + 1), 100);
}

TEST(RsM8194hEvents, ActionsGivePulsesAtXAndYOnly) {
  SteadyRsm rsm;
  rsm.send({"RSM_SYNC_ACTION Z XYZU 32 0 0 0 1 0 0 0 0 0", "RSM_FIXED_MOVE Z 10"});
  rsm.run_to_rest();
  rsm.run(2);
  EXPECT_EQ(rsm.ports().output_pulses(kFirstOut), 1);
  EXPECT_EQ(rsm.ports().output_pulses(kFirstOut + 1), 1);
}

}  // namespace events_test
}  // namespace understudy::emulator::models::rs_m8194h
