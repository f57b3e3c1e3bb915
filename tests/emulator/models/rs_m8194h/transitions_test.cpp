// Every event in every activity of an axis (7.5): the cells of the matrix, one by one.
#include <gtest/gtest.h>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace transitions_test {

enum class Does : std::uint8_t {
  idles,
  drives,
  interpolates,
  homes,
  is_held,
  is_locked,
  is_path_locked,
  is_in_emergency
};
struct Situation {
  Does does;
  const char* name;
  std::vector<std::string_view> commands;
};
const Situation kSituations[] = {
    {Does::idles, "idle", {}},
    {Does::drives, "driving", {"RSM_CONTINUE_MOVE X 10000"}},
    {Does::interpolates, "interpolating", {"RSM_LINE_2D 1000000 500000"}},
    {Does::homes, "homing", {"RSM_SET_HOME_MODE X 1 0 0 0 0", "RSM_HOME_START X"}},
    {Does::is_held, "held", {"RSM_DRV_HOLD X", "RSM_FIXED_MOVE X 1000"}},
    {Does::is_locked, "locked", {"RSM_STOP_SUDDENLY X"}},
    {Does::is_path_locked, "path locked", {"RSM_VSTOP_SUDDENLY"}},
    {Does::is_in_emergency, "emergency", {"RSM_EMERGENCY_STOP 0"}},
};

/// The state of X 1 tick and 3 s after the event.
struct Outcome {
  bool moves_after = false;  // in the next tick
  bool moves_at_last = false;
  bool locked = false;
  bool path_locked = false;
  bool emergency = false;
  int error = 0;
  bool has_held_drive = false;
};

struct Cell {
  Does does;
  const char* event;
  Outcome outcome;
};

constexpr int kStop = 0x100;
constexpr int kEmergency = 0x200;
constexpr Outcome kNothing{};
const Cell kCells[] = {
    // single drive
    {Does::idles, "RSM_FIXED_MOVE X 100000", {.moves_after = true, .moves_at_last = true}},
    {Does::is_locked, "RSM_FIXED_MOVE X 100000", {.locked = true, .error = kStop}},
    {Does::is_path_locked, "RSM_FIXED_MOVE X 100000", {.path_locked = true, .error = kStop}},
    {Does::is_in_emergency, "RSM_FIXED_MOVE X 100000", {.emergency = true, .error = kEmergency}},
    {Does::is_held, "RSM_CONTINUE_MOVE X 5000", {.has_held_drive = true}},
    // interpolation
    {Does::idles, "RSM_LINE_2D 1000000 500000", {.moves_after = true, .moves_at_last = true}},
    {Does::is_locked, "RSM_LINE_2D 1000000 500000", {.locked = true, .error = kStop}},
    {Does::is_path_locked, "RSM_LINE_2D 1000000 500000", {.path_locked = true, .error = kStop}},
    {Does::is_in_emergency, "RSM_LINE_2D 1000000 500000", {.emergency = true, .error = kEmergency}},
    // STOP_SLOWLY
    {Does::idles, "RSM_STOP_SLOWLY X", {.locked = true, .error = kStop}},
    {Does::drives, "RSM_STOP_SLOWLY X", {.moves_after = true, .locked = true, .error = kStop}},
    {Does::interpolates, "RSM_STOP_SLOWLY X", {.moves_after = true, .locked = true, .error = kStop}},
    {Does::homes, "RSM_STOP_SLOWLY X", {.moves_after = true, .locked = true, .error = kStop}},
    {Does::is_held, "RSM_STOP_SLOWLY X", {.locked = true, .error = kStop}},
    {Does::is_locked, "RSM_STOP_SLOWLY X", {.locked = true, .error = kStop}},
    {Does::is_path_locked, "RSM_STOP_SLOWLY X", {.locked = true, .path_locked = true, .error = kStop}},
    {Does::is_in_emergency,
     "RSM_STOP_SLOWLY X",
     {.locked = true, .emergency = true, .error = kStop | kEmergency}},
    // STOP_SUDDENLY
    {Does::idles, "RSM_STOP_SUDDENLY X", {.locked = true, .error = kStop}},
    {Does::drives, "RSM_STOP_SUDDENLY X", {.locked = true, .error = kStop}},
    {Does::interpolates, "RSM_STOP_SUDDENLY X", {.locked = true, .error = kStop}},
    {Does::homes, "RSM_STOP_SUDDENLY X", {.locked = true, .error = kStop}},
    {Does::is_held, "RSM_STOP_SUDDENLY X", {.locked = true, .error = kStop}},
    {Does::is_path_locked, "RSM_STOP_SUDDENLY X", {.locked = true, .path_locked = true, .error = kStop}},
    {Does::is_in_emergency,
     "RSM_STOP_SUDDENLY X",
     {.locked = true, .emergency = true, .error = kStop | kEmergency}},
    // VSTOP, of the axes of AXIS_ASSIGN if nothing interpolates
    {Does::idles, "RSM_VSTOP_SLOWLY", {.path_locked = true, .error = kStop}},
    {Does::drives,
     "RSM_VSTOP_SLOWLY",
     {.moves_after = true, .moves_at_last = true, .path_locked = true, .error = kStop}},
    {Does::interpolates, "RSM_VSTOP_SLOWLY", {.moves_after = true, .path_locked = true, .error = kStop}},
    {Does::interpolates, "RSM_VSTOP_SUDDENLY", {.path_locked = true, .error = kStop}},
    {Does::homes,
     "RSM_VSTOP_SUDDENLY",
     {.moves_after = true, .moves_at_last = true, .path_locked = true, .error = kStop}},
    {Does::is_held, "RSM_VSTOP_SLOWLY", {.path_locked = true, .error = kStop}},
    {Does::is_locked, "RSM_VSTOP_SLOWLY", {.locked = true, .path_locked = true, .error = kStop}},
    {Does::is_in_emergency,
     "RSM_VSTOP_SLOWLY",
     {.path_locked = true, .emergency = true, .error = kStop | kEmergency}},
    // EMERGENCY_STOP
    {Does::idles, "RSM_EMERGENCY_STOP 0", {.emergency = true, .error = kEmergency}},
    {Does::drives, "RSM_EMERGENCY_STOP 0", {.emergency = true, .error = kEmergency}},
    {Does::drives, "RSM_EMERGENCY_STOP 1", {.moves_after = true, .emergency = true, .error = kEmergency}},
    {Does::interpolates, "RSM_EMERGENCY_STOP 0", {.emergency = true, .error = kEmergency}},
    {Does::interpolates,
     "RSM_EMERGENCY_STOP 1",
     {.moves_after = true, .emergency = true, .error = kEmergency}},
    {Does::homes, "RSM_EMERGENCY_STOP 0", {.emergency = true, .error = kEmergency}},
    {Does::homes, "RSM_EMERGENCY_STOP 1", {.moves_after = true, .emergency = true, .error = kEmergency}},
    {Does::is_held, "RSM_EMERGENCY_STOP 0", {.emergency = true, .error = kEmergency}},
    {Does::is_locked,
     "RSM_EMERGENCY_STOP 0",
     {.locked = true, .emergency = true, .error = kStop | kEmergency}},
    {Does::is_path_locked,
     "RSM_EMERGENCY_STOP 1",
     {.path_locked = true, .emergency = true, .error = kStop | kEmergency}},
    // what clears locks
    {Does::is_locked, "RSM_CLEAR_STOP X", kNothing},
    {Does::is_path_locked, "RSM_CLEAR_STOP X", {.path_locked = true, .error = kStop}},
    {Does::is_in_emergency, "RSM_CLEAR_STOP X", {.emergency = true, .error = kEmergency}},
    {Does::is_locked, "RSM_CLEAR_VSTOP", {.locked = true, .error = kStop}},
    {Does::is_path_locked, "RSM_CLEAR_VSTOP", kNothing},
    {Does::is_in_emergency, "RSM_CLEAR_VSTOP", {.emergency = true, .error = kEmergency}},
    {Does::is_locked, "RSM_CLEAR_EMERGENCY_STOP", {.locked = true, .error = kStop}},
    {Does::is_path_locked, "RSM_CLEAR_EMERGENCY_STOP", {.path_locked = true, .error = kStop}},
    {Does::is_in_emergency, "RSM_CLEAR_EMERGENCY_STOP", kNothing},
    {Does::is_held, "RSM_CLEAR_STOP X", {.has_held_drive = true}},
    // holds
    {Does::drives, "RSM_DRV_HOLD X", {.moves_after = true, .moves_at_last = true}},
    {Does::is_held, "RSM_DRV_START X", {.moves_after = true}},
    // the rest
    {Does::drives, "RSM_MP_TERMINATE", {.moves_after = true, .moves_at_last = true}},
    {Does::interpolates, "RSM_MP_TERMINATE", {.moves_after = true, .moves_at_last = true}},
    {Does::homes, "RSM_MP_TERMINATE", {.moves_after = true, .moves_at_last = true}},
    {Does::is_held, "RSM_CLEAR_CARD_BUFFER", {.has_held_drive = true}},
    {Does::drives, "RSM_RESET_CARD", kNothing},
    {Does::interpolates, "RSM_RESET_CARD", kNothing},
    {Does::homes, "RSM_RESET_CARD", kNothing},
    {Does::is_held, "RSM_RESET_CARD", kNothing},
    {Does::is_locked, "RSM_RESET_CARD", kNothing},
    {Does::is_path_locked, "RSM_RESET_CARD", kNothing},
    {Does::is_in_emergency, "RSM_RESET_CARD", kNothing},
};

struct PreparedRsm : OneRsm {
  PreparedRsm() {
    send({"RSM_SET_SV XY 1000", "RSM_SET_V XY 10000", "RSM_SET_A XY 20000", "RSM_AXIS_ASSIGN X Y 0",
          "RSM_SET_VSV 1000", "RSM_SET_VV 10000", "RSM_SET_VA 20000", "RSM_VECTOR_SPEED 1"});
    run(3);
  }
};

TEST(RsM8194hMeetings, EachCellIsAsTheMatrixSays) {
  for (const Cell& cell : kCells) {
    const Situation& situation = kSituations[static_cast<std::size_t>(cell.does)];
    SCOPED_TRACE(std::string(situation.name) + " meets " + cell.event);
    PreparedRsm rsm;
    for (const std::string_view command : situation.commands) rsm.send(command);
    rsm.run(1000);
    rsm.send(cell.event);
    rsm.run(1);
    const auto moves = [&] { return (rsm.get("DRIVING_AXIS") & 1) != 0; };
    EXPECT_EQ(moves(), cell.outcome.moves_after);
    rsm.run(3000);
    EXPECT_EQ(moves(), cell.outcome.moves_at_last);
    const AxisUnit& unit = rsm.state().units[0];
    EXPECT_EQ(unit.locked, cell.outcome.locked);
    EXPECT_EQ(unit.path_locked, cell.outcome.path_locked);
    EXPECT_EQ(rsm.get("EMERGENCY_STOP"), cell.outcome.emergency ? 1 : 0);
    EXPECT_EQ(rsm.get("ERROR_CODE_X"), cell.outcome.error);
    EXPECT_EQ(unit.held_drive.what != Drive::What::none, cell.outcome.has_held_drive);
  }
}

TEST(RsM8194hMeetings, DrivesWaitForAnAxisInMotion) {
  for (const Does does : {Does::drives, Does::interpolates, Does::homes}) {
    for (const char* command : {"RSM_FIXED_MOVE X 100", "RSM_HOME_START X", "RSM_LINE_2D 10 10"}) {
      PreparedRsm rsm;
      for (const std::string_view each : kSituations[static_cast<std::size_t>(does)].commands) rsm.send(each);
      rsm.run(100);
      rsm.send(command);
      rsm.run(100);
      EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 29) << command;
      // A stop makes it void.
      rsm.send("RSM_STOP_SUDDENLY X");
      rsm.run(2);
      EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 30) << command;
      EXPECT_EQ(rsm.get("DRIVING_AXIS") & 1, 0);
    }
  }
}

TEST(RsM8194hMeetings, HeldDrivesStartTogether) {
  // The example of 7.5.1.
  OneRsm rsm;
  rsm.send({"RSM_DRV_HOLD XYU", "RSM_SET_MAX_V XYU 20000", "RSM_NORMAL_SPEED U 0", "RSM_SET_V U 2000",
            "RSM_SET_A U 1000", "RSM_SET_SV U 2000", "RSM_SET_AO U 9", "RSM_AXIS_ASSIGN X Y 0",
            "RSM_VECTOR_SPEED 0", "RSM_SET_VSV 2000", "RSM_SET_VV 2000", "RSM_FIXED_MOVE U 5000",
            "RSM_LINE_2D 12000 10000"});
  rsm.run(50);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 30);
  rsm.send("RSM_DRV_START XYU");
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0b1011);
  rsm.run(1001);
  EXPECT_EQ(rsm.get("LP_U"), 2000);
  EXPECT_NEAR(static_cast<double>(rsm.get("LP_X")), 2000 * 12000 / 15620.5, 1);
  EXPECT_NEAR(static_cast<double>(rsm.get("LP_Y")), 2000 * 10000 / 15620.5, 1);
  rsm.run_to_rest();
  EXPECT_EQ(rsm.positions(), (std::vector<Value>{12000, 10000, 0, 5000}));
}

TEST(RsM8194hMeetings, APathIsHeldUntilAllItsAxesAreReleased) {
  PreparedRsm rsm;
  rsm.send({"RSM_DRV_HOLD XY", "RSM_LINE_2D 1000 1000", "RSM_DRV_START X"});
  rsm.run(20);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  rsm.send("RSM_DRV_START Y");
  rsm.run(1);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 3);
}

TEST(RsM8194hMeetings, AStreamIsHeldWithAllItsSegments) {
  for (const bool in_two : {false, true}) {
    OneRsm rsm;
    rsm.send({"RSM_SET_MAX_V XY 80000", "RSM_DRV_HOLD XY", "RSM_LINE_2D_INITIAL X Y 100 2000 20000"});
    for (int i = 0; i < 9; ++i) rsm.send("RSM_LINE_2D_CONTINUE 0 100 0");
    rsm.run(20);
    EXPECT_EQ(rsm.positions(), (std::vector<Value>{0, 0, 0, 0}));
    EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 30);
    OneRsm twin;
    twin.device().restore_state(rsm.device().save_state());
    EXPECT_TRUE(twin.device().same_state(rsm.device()));
    if (!in_two) twin.send("RSM_LINE_2D_CONTINUE 1 0 100");
    twin.send("RSM_DRV_START XY");
    // It continues after those that were held.
    if (in_two) twin.send("RSM_LINE_2D_CONTINUE 1 0 100");
    for (int i = 0; i < 700 && twin.get("DRIVING_AXIS") != 0; ++i) {
      twin.run(1);
      EXPECT_EQ(twin.get("Continuous_Inp_Interrupt"), 0);
    }
    EXPECT_EQ(twin.positions(), (std::vector<Value>{900, 100, 0, 0}));
  }
}

TEST(RsM8194hMeetings, AHeldStreamIsReplacedOrEndsAsAWhole) {
  OneRsm rsm;
  rsm.send({"RSM_SET_MAX_V XY 80000", "RSM_SET_SV XY 2000", "RSM_SET_V XY 2000", "RSM_DRV_HOLD XY",
            "RSM_LINE_2D_INITIAL X Y 2000 2000 20000"});
  // The complete stream is replaced by the next one, and that by a drive of one of its axes.
  rsm.send({"RSM_LINE_2D_CONTINUE 0 100 0", "RSM_LINE_2D_CONTINUE 1 100 0", "RSM_LINE_2D_CONTINUE 0 0 50",
            "RSM_LINE_2D_CONTINUE 1 0 50", "RSM_DRV_START XY"});
  rsm.run_to_rest();
  EXPECT_EQ(rsm.positions(), (std::vector<Value>{0, 100, 0, 0}));
  rsm.send({"RSM_DRV_HOLD XY", "RSM_LINE_2D_CONTINUE 0 100 0", "RSM_LINE_2D_CONTINUE 1 100 0",
            "RSM_FIXED_MOVE X 7", "RSM_DRV_START XY"});
  rsm.run_to_rest();
  EXPECT_EQ(rsm.positions(), (std::vector<Value>{7, 100, 0, 0}));
  // A stop ends the rest of it.
  rsm.send({"RSM_DRV_HOLD XY", "RSM_LINE_2D_CONTINUE 0 100 0", "RSM_LINE_2D_CONTINUE 0 100 0",
            "RSM_LINE_2D_CONTINUE 0 100 0", "RSM_LINE_2D_CONTINUE 1 100 0", "RSM_DRV_START XY"});
  rsm.run(30);
  rsm.send({"RSM_VSTOP_SUDDENLY", "RSM_CLEAR_VSTOP"});
  rsm.run(300);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  EXPECT_LT(rsm.get("LP_X"), 107);
}

TEST(RsM8194hMeetings, AHeldPathKeepsTheAxesThatItWasSentFor) {
  OneRsm rsm;
  rsm.send({"RSM_SET_MAX_V XYZU 80000", "RSM_SET_VV 2000", "RSM_DRV_HOLD XY", "RSM_AXIS_ASSIGN X Y 0",
            "RSM_LINE_2D 100 50", "RSM_AXIS_ASSIGN Z U 0", "RSM_LINE_2D 30 40"});
  rsm.run_to_rest();
  EXPECT_EQ(rsm.positions(), (std::vector<Value>{0, 0, 30, 40}));
  rsm.send("RSM_DRV_START XY");
  rsm.run_to_rest();
  EXPECT_EQ(rsm.positions(), (std::vector<Value>{100, 50, 30, 40}));
}

TEST(RsM8194hMeetings, ByChoiceTheFirstHeldDriveIsKept) {
  struct Case {
    std::vector<const char*> drives;
    std::vector<Value> places;
  };
  const Case kCases[] = {
      {{"RSM_LINE_2D 100 50", "RSM_LINE_2D 30 40"}, {100, 50, 0, 0}},
      {{"RSM_LINE_2D 100 50", "RSM_FIXED_MOVE X 7"}, {100, 50, 0, 0}},
      {{"RSM_FIXED_MOVE X 7", "RSM_LINE_2D 100 50"}, {7, 0, 0, 0}},
  };
  for (const Case& each : kCases) {
    OneRsm rsm({.choices = {{"second_held_drive", "is_void"}}});
    rsm.send({"RSM_SET_MAX_V XY 80000", "RSM_SET_SV X 2000", "RSM_SET_V X 2000", "RSM_SET_VV 2000",
              "RSM_AXIS_ASSIGN X Y 0", "RSM_DRV_HOLD XY"});
    for (const char* const drive : each.drives) rsm.send(drive);
    rsm.send("RSM_DRV_START XY");
    rsm.run_to_rest();
    EXPECT_EQ(rsm.positions(), each.places) << each.drives.back();
  }
}

TEST(RsM8194hMeetings, AlarmStopsRefusesAndIsCleared) {
  PreparedRsm rsm;
  rsm.send({"RSM_SET_ALARM X 1 0", "RSM_CONTINUE_MOVE X 10000"});
  rsm.run(100);
  rsm.pin(0, Pin::alarm, true);
  rsm.run(2);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0x10);
  rsm.send("RSM_FIXED_MOVE X 100");
  rsm.run(5);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  rsm.send("RSM_CLEAR_STOP X");
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0x10);  // still active
  rsm.pin(0, Pin::alarm, false);
  rsm.run(2);
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0x10);
  rsm.send("RSM_CLEAR_STOP X");
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0);
}

TEST(RsM8194hMeetings, AHeldStreamHasTheRoomOfTheFifo) {
  PreparedRsm rsm;
  rsm.send({"RSM_LINE_2D_INITIAL X Y 1000 1000 1000", "RSM_DRV_HOLD XY"});
  for (int i = 0; i < 30; ++i) {
    rsm.send("RSM_LINE_2D_CONTINUE 0 10 0");
    rsm.run(1);
  }
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 30) << "all of them are held";
  rsm.send({"RSM_LINE_2D_CONTINUE 0 10 0", "RSM_LINE_2D_CONTINUE 1 10 0", "RSM_SET_LP Z 5"});
  rsm.run(10);
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 27) << "these wait";
  EXPECT_EQ(rsm.get("LP_Z"), 0);
}

TEST(RsM8194hMeetings, TheEmergencyInputStopsAllThatMoves) {
  PreparedRsm rsm;
  rsm.send({"RSM_CONTINUE_MOVE XZ 10000", "RSM_SET_LP U 1"});
  rsm.run(100);
  rsm.input(kEmergencyPin, true);
  rsm.run(2);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0x20);
  EXPECT_EQ(rsm.get("ERROR_CODE_Y"), 0);
  EXPECT_EQ(rsm.get("ERROR_CODE_Z"), 0x20);
  EXPECT_EQ(rsm.get("DI_ALL_Y"), 0x03E8);
  rsm.send("RSM_FIXED_MOVE Y 100");
  rsm.run(5);
  EXPECT_EQ(rsm.get("ERROR_CODE_Y"), 0x20);
  EXPECT_EQ(rsm.get("LP_Y"), 0);
}

}  // namespace transitions_test
}  // namespace understudy::emulator::models::rs_m8194h
