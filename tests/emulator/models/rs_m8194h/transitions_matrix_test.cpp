// The whole matrix of 7.5: each activity of an axis with each event. One line for each event, one column for
// each state; every cell is tested.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <optional>
#include <string>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace transitions_matrix_test {

using Commands = std::vector<std::string_view>;

struct Situation {
  const char* name;
  Commands commands;
};
const Situation kStates[] = {
    {"idle", {}},
    {"driving", {"RSM_CONTINUE_MOVE X 10000"}},
    {"interpolating", {"RSM_LINE_2D 1000000 500000"}},
    {"homing", {"RSM_SET_HOME_MODE X 1 0 0 0 0", "RSM_HOME_START X"}},
    // X is at rest; its drive starts together with that of Y, which moves. A lock of X voids only its part,
    // and commands behind it that are not stops wait (7.5.3, 7.5.4: a stop locks the axes that it names).
    // VSTOP locks all axes that are assigned, and their drives are void (7.5.5, 7.5.6): no part of it waits.
    // EMG ends Y's drive, too, so this one is tried at once, and is void.
    {"waited for", {"RSM_CONTINUE_MOVE Y 10000", "RSM_FIXED_MOVE XY 100000"}},
    {"held", {"RSM_DRV_HOLD X", "RSM_FIXED_MOVE X 100000"}},
    {"locked", {"RSM_STOP_SUDDENLY X"}},
    {"path locked", {"RSM_VSTOP_SUDDENLY"}},
    {"in emergency", {"RSM_EMERGENCY_STOP 0"}},
};
constexpr std::size_t kStateCount = std::size(kStates);

/// An input, or none.
struct Edge {
  Pin pin{};
  std::size_t axis = 0;
  bool level = false;
  bool is_emergency = false;
};

/// The state of X afterwards: M moves or S is at rest, soon and 3 s later; L locked; V locked as an axis of
/// paths; E in the emergency state; D a drive of it is held; P a path of it is held; h it is held; W the FIFO
/// waits; its error.
struct Row {
  Commands before;  // of the situation
  Commands event;
  std::optional<Edge> edge;
  std::array<const char*, kStateCount> after;
};

constexpr Edge kOpensIn3{.pin = Pin::in3, .axis = 3, .level = false};
constexpr Edge kClosesExp{.pin = Pin::external_plus, .axis = 0, .level = true};
constexpr Edge kLimit{.pin = Pin::limit_plus, .axis = 0, .level = true};
constexpr Edge kAlarm{.pin = Pin::alarm, .axis = 0, .level = true};
constexpr Edge kEmg{.level = true, .is_emergency = true};

// clang-format off
const Row kRows[] = {
    // before, event, edge
    //  idle        driving      interp.      homing       waits        held          locked         path locked    emergency
    {{}, {"RSM_FIXED_MOVE X 100000"}, {},
     {"MM",        "MM W",      "MM W",      "MM W",      "SS W",      "SS Dh",      "SS L 100",    "SS V 100",    "SS E 200"}},
    {{}, {"RSM_SET_HOME_MODE X 1 0 0 0 0", "RSM_HOME_START X"}, {},
     {"MM",        "MM W",      "MM W",      "MM W",      "SS W",      "SS Dh",      "SS L 100",    "SS V 100",    "SS E 200"}},
    {{}, {"RSM_LINE_SCAN_START X 0 100000"}, {},
     {"MM",        "MM W",      "MM W",      "MM W",      "SS W",      "SS Dh",      "SS L 100",    "SS V 100",    "SS E 200"}},
    {{}, {"RSM_LINE_2D 1000000 500000"}, {},
     {"MM",        "MM W",      "MM W",      "MM W",      "SS W",      "SS Ph",      "SS L 100",    "SS V 100",    "SS E 200"}},
    {{"RSM_EXD_FP X 100000"}, {}, kClosesExp,
     {"MM",        "MM",        "MM",        "MM",        "MM W",      "MM Dh",      "SS L 100",    "SS V 100",    "SS E 200"}},
    // Synchronous drives and stops of X, by IN3 of U.
    {{"RSM_SYNC_ACTION U X 64 1 0 3 0 0 0 0 0 0", "RSM_SET_PRESET X 100000"}, {}, kOpensIn3,
     {"MM",        "MM",        "MM",        "MM",        "MM W",      "MM Dh",      "SS L 100",    "SS V 100",    "SS E 200"}},
    {{"RSM_SYNC_ACTION U X 64 2 0 3 0 0 0 0 0 0", "RSM_SET_PRESET X 100000"}, {}, kOpensIn3,
     {"MM",        "MM",        "MM",        "MM",        "MM W",      "MM Dh",      "SS L 100",    "SS V 100",    "SS E 200"}},
    {{"RSM_SYNC_ACTION U X 64 3 0 0 0 0 0 0 0 0"}, {}, kOpensIn3,
     {"MM",        "MM",        "MM",        "MM",        "MM W",      "MM Dh",      "SS L 100",    "SS V 100",    "SS E 200"}},
    {{"RSM_SYNC_ACTION U X 64 4 0 0 0 0 0 0 0 0"}, {}, kOpensIn3,
     {"MM",        "MM",        "MM",        "MM",        "MM W",      "MM Dh",      "SS L 100",    "SS V 100",    "SS E 200"}},
    {{"RSM_SYNC_ACTION U X 64 5 0 0 0 0 0 0 0 0"}, {}, kOpensIn3,
     {"SS",        "MS",        "MS",        "MS",        "SS W",      "SS Dh",      "SS L 100",    "SS V 100",    "SS E 200"}},
    {{"RSM_SYNC_ACTION U X 64 6 0 0 0 0 0 0 0 0"}, {}, kOpensIn3,
     {"SS",        "SS",        "SS",        "SS",        "SS W",      "SS Dh",      "SS L 100",    "SS V 100",    "SS E 200"}},
    // Settings, and SET_PULSE during a motion that is not a fixed move
    {{}, {"RSM_SET_V X 5000", "RSM_SET_LP X 3", "RSM_SET_COMPARE X 0 0 9", "RSM_SET_PULSE X 5"}, {},
     {"SS",        "MM",        "MM",        "MM",        "SS W",      "SS Dh",      "SS L 100",    "SS V 100",    "SS E 200"}},
    // Stops
    {{}, {"RSM_STOP_SLOWLY X"}, {},
     {"SS L 100",  "MS L 100",  "MS L 100",  "MS L 100",  "SS LW 100", "SS Lh 100",  "SS L 100",    "SS LV 100",   "SS LE 300"}},
    {{}, {"RSM_STOP_SUDDENLY X"}, {},
     {"SS L 100",  "SS L 100",  "SS L 100",  "SS L 100",  "SS LW 100", "SS Lh 100",  "SS L 100",    "SS LV 100",   "SS LE 300"}},
    {{}, {"RSM_VSTOP_SLOWLY"}, {},
     {"SS V 100",  "MM V 100",  "MS V 100",  "MM V 100",  "SS V 100",  "SS Vh 100",  "SS LV 100",   "SS V 100",    "SS VE 300"}},
    {{}, {"RSM_VSTOP_SUDDENLY"}, {},
     {"SS V 100",  "MM V 100",  "SS V 100",  "MM V 100",  "SS V 100",  "SS Vh 100",  "SS LV 100",   "SS V 100",    "SS VE 300"}},
    {{}, {"RSM_EMERGENCY_STOP 0"}, {},
     {"SS E 200",  "SS E 200",  "SS E 200",  "SS E 200",  "SS E 200",  "SS E 200",   "SS LE 300",   "SS VE 300",   "SS E 200"}},
    {{}, {"RSM_EMERGENCY_STOP 1"}, {},
     {"SS E 200",  "MS E 200",  "MS E 200",  "MS E 200",  "SS E 200",  "SS E 200",   "SS LE 300",   "SS VE 300",   "SS E 200"}},
    // What clears them
    {{}, {"RSM_CLEAR_STOP X"}, {},
     {"SS",        "MM",        "MM",        "MM",        "SS W",      "SS Dh",      "SS",          "SS V 100",    "SS E 200"}},
    {{}, {"RSM_CLEAR_VSTOP"}, {},
     {"SS",        "MM",        "MM",        "MM",        "SS W",      "SS Dh",      "SS L 100",    "SS",          "SS E 200"}},
    {{}, {"RSM_CLEAR_EMERGENCY_STOP"}, {},
     {"SS",        "MM",        "MM",        "MM",        "SS W",      "SS Dh",      "SS L 100",    "SS V 100",    "SS"}},
    // Holds
    {{}, {"RSM_DRV_HOLD X"}, {},
     {"SS h",      "MM h",      "MM h",      "MM h",      "SS W",      "SS Dh",      "SS Lh 100",   "SS Vh 100",   "SS Eh 200"}},
    {{}, {"RSM_DRV_START X"}, {},
     {"SS",        "MM",        "MM",        "MM",        "SS W",      "MM",         "SS L 100",    "SS V 100",    "SS E 200"}},
    {{}, {"RSM_STOP_WAIT X", "RSM_SET_LP U 7"}, {},
     {"SS",        "MM W",      "MM W",      "MM W",      "SS W",      "SS Dh",      "SS L 100",    "SS V 100",    "SS E 200"}},
    // The rest
    {{}, {"RSM_MP_TERMINATE"}, {},
     {"SS",        "MM",        "MM",        "MM",        "SS W",      "SS Dh",      "SS L 100",    "SS V 100",    "SS E 200"}},
    {{}, {"RSM_CLEAR_CARD_BUFFER"}, {},
     {"SS",        "MM",        "MM",        "MM",        "SS",        "SS Dh",      "SS L 100",    "SS V 100",    "SS E 200"}},
    {{}, {"RSM_RESET_CARD"}, {},
     {"SS",        "SS",        "SS",        "SS",        "SS",        "SS",         "SS",          "SS",          "SS"}},
    {{}, {}, kLimit,
     {"SS",        "SS 4",      "SS 4",      "SS",        "SS W",      "SS Dh",      "SS L 100",    "SS V 100",    "SS E 200"}},
    {{"RSM_LIMITSTOP_MODE X 1"}, {}, kLimit,
     {"SS",        "MS 4",      "MS 4",      "MS",        "SS W",      "SS Dh",      "SS L 100",    "SS V 100",    "SS E 200"}},
    {{"RSM_SET_SLMT X 15000 -2000000000 0"}, {}, {},
     {"SS",        "MS 1",      "MS 1",      "MS 1",      "SS W",      "SS Dh",      "SS L 100",    "SS V 100",    "SS E 200"}},
    {{"RSM_SET_ALARM X 1 0"}, {}, kAlarm,
     {"SS",        "SS 10",     "SS 10",     "SS 10",     "SS W",      "SS Dh",      "SS L 100",    "SS V 100",    "SS E 200"}},
    {{}, {}, kEmg,
     {"SS",        "SS 20",     "SS 20",     "SS 20",     "SS 20",     "SS Dh",      "SS L 100",    "SS V 100",    "SS E 200"}},
};
// clang-format on

std::string reported(const OneRsm& rsm, bool moved_soon) {
  const AxisUnit& unit = rsm.state().units[0];
  std::string text(moved_soon ? "M" : "S");
  text += (rsm.get("DRIVING_AXIS") & 1) != 0 ? "M" : "S";
  std::string flags;
  if (unit.locked) flags += "L";
  if (unit.path_locked) flags += "V";
  if (rsm.get("EMERGENCY_STOP") != 0) flags += "E";
  if (unit.held_drive.what != Drive::What::none) flags += "D";
  if (!rsm.state().held_paths.empty()) flags += "P";
  if (unit.held) flags += "h";
  if (rsm.get("FREE_BUFFER_SIZE") != 30) flags += "W";
  if (!flags.empty()) text += " " + flags;
  char error[16] = "";
  if (unit.error_code != 0) std::snprintf(error, sizeof error, " %X", unsigned{unit.error_code});
  return text + error;
}

std::string walk(const Row& row, const Situation& state) {
  OneRsm rsm;
  rsm.pin(3, Pin::in3, true);
  rsm.send({"RSM_SET_SV XY 1000", "RSM_SET_V XY 10000", "RSM_SET_A XY 20000", "RSM_AXIS_ASSIGN X Y 0",
            "RSM_VECTOR_SPEED 1", "RSM_SET_VSV 1000", "RSM_SET_VV 10000", "RSM_SET_VA 20000"});
  for (const std::string_view command : row.before) rsm.send(command);
  rsm.run(5);
  for (const std::string_view command : state.commands) rsm.send(command);
  rsm.run(1000);
  for (const std::string_view command : row.event) rsm.send(command);
  if (row.edge && row.edge->is_emergency) {
    rsm.input(kEmergencyPin, row.edge->level);
  } else if (row.edge) {
    rsm.pin(row.edge->axis, row.edge->pin, row.edge->level);
  }
  rsm.run(2);
  const bool moved_soon = (rsm.get("DRIVING_AXIS") & 1) != 0;
  rsm.run(3000);
  return reported(rsm, moved_soon);
}

TEST(RsM8194hMatrix, EachCellIsAsItsRowSays) {
  for (const Row& row : kRows) {
    std::string name;
    for (const Commands* const commands : {&row.before, &row.event}) {
      for (const std::string_view command : *commands) name += std::string(command) + "; ";
    }
    for (std::size_t s = 0; s < kStateCount; ++s) {
      EXPECT_EQ(walk(row, kStates[s]), row.after[s]) << kStates[s].name << " meets " << name;
    }
  }
}

}  // namespace transitions_matrix_test
}  // namespace understudy::emulator::models::rs_m8194h
