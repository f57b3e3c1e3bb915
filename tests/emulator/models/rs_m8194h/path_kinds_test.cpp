// Paths by modes, streams and start points of rectangles (7.2.2, 7.4.1, 7.4.8).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"
#include "tests/sanitized.h"

namespace understudy::emulator::models::rs_m8194h {
namespace path_kinds_test {

TEST(RsM8194hPathKinds, AStreamIsConstantWhereItsInitialSaysSo) {
  struct Case {
    const char* initial;
    const char* segment;
    bool is_constant;
  };
  // 10,000 pulses at 10,000 PPS: ramps of 10,000 PPS/s from 0 turn one second into two.
  constexpr Case kCases[] = {
      {"RSM_MIX_2D_INITIAL X Y 0 0 10000 10000", "RSM_MIX_2D_CONTINUE 1 1 0 0 10000 0", true},
      {"RSM_MIX_2D_INITIAL X Y 1 0 10000 10000", "RSM_MIX_2D_CONTINUE 1 1 0 0 10000 0", false},
      {"RSM_LINE_2D_INITIAL X Y 0 10000 10000", "RSM_LINE_2D_CONTINUE 1 10000 0", false},
      {"RSM_LINE_3D_INITIAL X Y Z 0 10000 10000", "RSM_LINE_3D_CONTINUE 1 10000 0 0", false},
  };
  for (const Case& each : kCases) {
    OneRsm rsm;
    rsm.send({"RSM_SET_MAX_V XYZ 80000", each.initial, each.segment});
    const Tick lasts = rsm.run_to_rest();
    EXPECT_EQ(rsm.get("LP_X"), 10000) << each.initial;
    EXPECT_NEAR(static_cast<double>(lasts), each.is_constant ? 1001 : 2001, 30) << each.initial;
  }
}

/// The paths that a mode of VECTOR_SPEED is for (7.2.2).
struct Mode {
  bool line_2d, arc, line_3d;
};
constexpr Mode kModes[12] = {{true, true, false},  {true, false, false}, {true, false, false},
                             {true, false, false}, {true, false, false}, {false, true, false},
                             {false, true, false}, {false, false, true}, {false, false, true},
                             {false, false, true}, {false, false, true}, {false, false, true}};

TEST(RsM8194hPathKinds, ByChoiceAModeIsForItsOwnShapesAlone) {
  for (int mode = 0; mode < 12; ++mode) {
    const Mode& fits = kModes[mode];
    const std::pair<const char*, bool> kShapes[] = {{"RSM_LINE_2D 100 0", fits.line_2d},
                                                    {"RSM_ARC_CW 100 0 100 100", fits.arc},
                                                    {"RSM_CIRCLE_CCW 100 0", fits.arc},
                                                    {"RSM_LINE_3D 100 0 0", fits.line_3d}};
    for (const auto& [command, begins] : kShapes) {
      OneRsm rsm({.choices = {{"unfit_profile", "void"}}});
      rsm.send("RSM_VECTOR_SPEED " + std::to_string(mode));
      rsm.send({"RSM_AXIS_ASSIGN X Y Z", "RSM_SET_VV 1000", command});
      EXPECT_EQ(rsm.get("DRIVING_AXIS") != 0, begins) << mode << " " << command;
      EXPECT_EQ(rsm.get("Module_Error"), begins ? 0 : 1) << mode << " " << command;
    }
  }
}

/// Where the start points of a rectangle of 20000 by 10000 are, seen from its lower left, with corners of
/// 1000.
struct StartPoints {
  const char* option;
  double places[8][2];
};
constexpr double kBend = 1000 * (1 - std::numbers::sqrt2 / 2);
constexpr StartPoints kStartPoints[] = {
    {"counter_clockwise_from_the_lower_side",
     {{1000, 0},
      {19000, 0},
      {20000, 1000},
      {20000, 9000},
      {19000, 10000},
      {1000, 10000},
      {0, 9000},
      {0, 1000}}},
    {"clockwise_from_the_left_side",
     {{0, 1000},
      {0, 9000},
      {1000, 10000},
      {19000, 10000},
      {20000, 9000},
      {20000, 1000},
      {19000, 0},
      {1000, 0}}},
    {"middles_from_the_lower_side",
     {{10000, 0},
      {20000 - kBend, kBend},
      {20000, 5000},
      {20000 - kBend, 10000 - kBend},
      {10000, 10000},
      {kBend, 10000 - kBend},
      {0, 5000},
      {kBend, kBend}}},
};

TEST(RsM8194hPathKinds, RectanglesCloseFromEachOfTheirPoints) {
  // 7.4.1: 20000 by 10000 with corners of 1000.
  const double length = 2 * (18000 + 8000) + 2 * std::numbers::pi * 1000;
  for (int number = 0; number < 3 * 8 * 2; number += is_sanitized() ? 5 : 1) {
    const StartPoints& starts = kStartPoints[number / 16];
    const int point = number / 2 % 8;
    OneRsm rsm({.choices = {{"rectangle_start_points", starts.option}}});
    rsm.send("RSM_SET_MAX_V XY 80000");
    rsm.send("RSM_RECTANGLE X Y 0 " + std::to_string(point) + " " + std::to_string(number % 2) +
             " 20000 10000 1000 10000 10000 5000 5000");
    Value min_x = 0, max_x = 0, min_y = 0, max_y = 0;
    const Tick begin = rsm.now();
    do {
      rsm.run(1);
      min_x = std::min(min_x, rsm.get("LP_X"));
      max_x = std::max(max_x, rsm.get("LP_X"));
      min_y = std::min(min_y, rsm.get("LP_Y"));
      max_y = std::max(max_y, rsm.get("LP_Y"));
    } while (rsm.get("DRIVING_AXIS") != 0);
    EXPECT_EQ(rsm.now() - begin, static_cast<Tick>(std::ceil(length / 10)) + 1);
    EXPECT_EQ(rsm.positions(), (std::vector<Value>{0, 0, 0, 0}));
    EXPECT_NEAR(static_cast<double>(max_x - min_x), 20000, 1) << number;
    EXPECT_NEAR(static_cast<double>(max_y - min_y), 10000, 1) << number;
    EXPECT_NEAR(-static_cast<double>(min_x), starts.places[point][0], 1) << number;
    EXPECT_NEAR(-static_cast<double>(min_y), starts.places[point][1], 1) << number;
  }
}

/// As far as the arcs of the kernel go; beyond that the log reports it once.
TEST(RsM8194hPathKinds, AHelixBeyondTheKernelIsVoidAndToldOnce) {
  struct Case {
    const char* turns_and_pitch;
    bool runs;
    std::size_t reported;
  };
  const Case kCases[] = {
      {"159154 100", true, 0},      {"-159154 100", true, 0},      {"159155 100", false, 1},
      {"-159155 100", false, 1},    {"2000000000 0", false, 1},    {"500 2000000000", true, 0},
      {"501 2000000000", false, 1}, {"501 -2000000000", false, 1},
  };
  for (const Case& each : kCases) {
    OneRsm rsm;
    std::vector<std::string> reported;
    rsm.device().set_log([&](const std::string& text) { reported.push_back(text); });
    for (int i = 0; i < 2; ++i) {
      rsm.send("RSM_HELIX_3D X Y Z 1 1000 0 100 " + std::string(each.turns_and_pitch));
      rsm.run(3);
      EXPECT_EQ(rsm.get("DRIVING_AXIS"), each.runs ? 7 : 0) << each.turns_and_pitch;
      EXPECT_EQ(rsm.get("RINT_STATE_ALL"), each.runs ? 0 : 0x80) << each.turns_and_pitch;
    }
    EXPECT_EQ(reported.size(), each.reported) << each.turns_and_pitch;
  }
  // Another one that cannot be drawn: its centre is its start.
  OneRsm rsm;
  rsm.device().set_log([&](const std::string& text) { ADD_FAILURE() << text; });
  rsm.send("RSM_HELIX_3D X Y Z 1 1000 0 0 1 1");
  rsm.run(3);
  EXPECT_EQ(rsm.get("RINT_STATE_ALL"), 0x80);
}

}  // namespace path_kinds_test
}  // namespace understudy::emulator::models::rs_m8194h
