// Lines, arcs, streams, rectangles, helices: where they end, how long they take, how far they are from the
// ideal path (7.2, 7.4).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace paths_test {

constexpr double kPi = 3.14159265358979323846;

/// Constant vector speed of 10000 PPS in X and Y.
struct ConstantRsm : OneRsm {
  explicit ConstantRsm(const std::string& axes = "X Y 0", int mode = 0) {
    send("RSM_AXIS_ASSIGN " + axes);
    send("RSM_VECTOR_SPEED " + std::to_string(mode));
    send({"RSM_SET_MAX_V XYZU 80000", "RSM_SET_VSV 10000", "RSM_SET_VV 10000"});
    run(3);
  }
};

struct Way {
  const char* command;
  double length;
  Value x, y;
};
const Way kWays[] = {
    {"RSM_LINE_2D 12000 -5000", 13000, 12000, -5000},
    {"RSM_ARC_CW -5000 -5000 -10000 -10000", 7071.0678 * kPi, -10000, -10000},
    {"RSM_ARC_CCW -5000 -5000 -10000 -10000", 7071.0678 * kPi, -10000, -10000},
    {"RSM_ARC_CW 5000 0 5000 5000", 5000 * kPi / 2, 5000, 5000},
    {"RSM_ARC_CCW 5000 0 5000 5000", 5000 * kPi * 1.5, 5000, 5000},
    {"RSM_CIRCLE_CW 0 10000", 20000 * kPi, 0, 0},
    {"RSM_CIRCLE_CCW 10000 0", 20000 * kPi, 0, 0},
};

TEST(RsM8194hPaths, EndWhereTheyShouldInTheTimeOfTheirLength) {
  for (const Way& way : kWays) {
    ConstantRsm rsm;
    rsm.send(way.command);
    EXPECT_EQ(rsm.get("InterpolationRdyFlag"), 0);
    EXPECT_EQ(rsm.get("DRIVING_AXIS"), 3);
    EXPECT_EQ(rsm.run_to_rest(), static_cast<Tick>(std::ceil(way.length / 10 - 1e-6)) + 1) << way.command;
    EXPECT_EQ(rsm.get("LP_X"), way.x) << way.command;
    EXPECT_EQ(rsm.get("LP_Y"), way.y) << way.command;
    EXPECT_EQ(rsm.get("InterpolationRdyFlag"), 1);
  }
}

TEST(RsM8194hPaths, AbsoluteFormsGoByTheAbsoluteCounters) {
  ConstantRsm rsm;
  rsm.send({"RSM_ABS_SET_POSITION X 1000", "RSM_ABS_SET_POSITION Y -1000", "RSM_SET_LP XY 7",
            "RSM_ABS_LINE_2D 4000 3000"});
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_X"), 3007);
  EXPECT_EQ(rsm.get("LP_Y"), 4007);
  rsm.send("RSM_ABS_ARC_CCW 4000 4000 4000 5000");
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("ABS_X"), 4000);
  EXPECT_EQ(rsm.get("ABS_Y"), 5000);
}

TEST(RsM8194hPaths, OfOnePulseGiveItAndOfNoneAreOver) {
  ConstantRsm rsm;
  rsm.send("RSM_LINE_2D 0 0");
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  rsm.send("RSM_LINE_2D 1 0");
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 3);
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_X"), 1);
  EXPECT_EQ(rsm.get("LP_Y"), 0);
}

TEST(RsM8194hPaths, AnyAxesMayBeAssigned) {
  ConstantRsm rsm("U Y X", 7);
  rsm.send("RSM_LINE_3D 6000 -3000 2000");
  EXPECT_EQ(rsm.run_to_rest(), 701);
  EXPECT_EQ(rsm.positions(), (std::vector<Value>{2000, -3000, 0, 6000}));
}

TEST(RsM8194hPaths, StayWithinHalfAPulseOfACircle) {
  ConstantRsm rsm;
  rsm.send("RSM_CIRCLE_CW 3000 4000");
  int ticks = 0;
  while (rsm.get("DRIVING_AXIS") != 0) {
    rsm.run(1);
    const double dx = static_cast<double>(rsm.get("LP_X")) - 3000;
    const double dy = static_cast<double>(rsm.get("LP_Y")) - 4000;
    ASSERT_NEAR(std::sqrt(dx * dx + dy * dy), 5000, 0.71);
    ++ticks;
  }
  EXPECT_GT(ticks, 3000);
}

TEST(RsM8194hPaths, AnEndOffTheCircleIsReachedInItsQuadrant) {
  ConstantRsm rsm;
  rsm.send("RSM_ARC_CW 10000 0 11000 9000");  // 7.2.2: radius 10000, the end at 9055
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_X"), 11000);
  EXPECT_NEAR(static_cast<double>(rsm.get("LP_Y")), std::sqrt(1e8 - 1e6), 1);
}

TEST(RsM8194hPaths, WhatCannotBeDrawnIsVoid) {
  for (const char* command :
       {"RSM_ARC_CW 0 0 100 100", "RSM_LINE_3D 1 2 3", "RSM_LINE_2D_CONTINUE 0 100 100"}) {
    ConstantRsm rsm;
    rsm.send(command);
    rsm.run(5);
    EXPECT_EQ(rsm.positions(), (std::vector<Value>{0, 0, 0, 0})) << command;
    EXPECT_EQ(rsm.get("Module_Error"), 1) << command;
    rsm.send("RSM_LINE_2D 100 0");
    rsm.run_to_rest();
    EXPECT_EQ(rsm.get("LP_X"), 100);
  }
}

TEST(RsM8194hPaths, AFedStreamNeverSlowsBeforeItsLastSegment) {
  OneRsm rsm;
  rsm.send({"RSM_SET_MAX_V XY 80000", "RSM_LINE_2D_INITIAL X Y 300 18000 500000"});
  constexpr int kSegments = 2000;
  int sent = 0;
  Value min_after_ramp = 100000;
  while (sent < kSegments || rsm.get("DRIVING_AXIS") != 0) {
    // The segments of a staircase: right angles everywhere.
    while (sent < kSegments && rsm.get("FREE_BUFFER_SIZE") > 0) {
      ++sent;
      const std::string last = sent == kSegments ? "1" : "0";
      rsm.send("RSM_LINE_2D_CONTINUE " + last + (sent % 2 == 0 ? " 100 0" : " 0 100"));
    }
    rsm.run(1);
    const Value speed = rsm.get("CV_X") + rsm.get("CV_Y");
    if (rsm.now() > 60 && sent < kSegments) min_after_ramp = std::min(min_after_ramp, speed);
    ASSERT_EQ(rsm.get("Continuous_Inp_Interrupt"), 0);
    ASSERT_LT(rsm.now(), 100000);
  }
  EXPECT_EQ(rsm.get("LP_X"), 100 * kSegments / 2);
  EXPECT_EQ(rsm.get("LP_Y"), 100 * kSegments / 2);
  EXPECT_GE(min_after_ramp, 17990);
  EXPECT_LE(min_after_ramp, 18000);
}

TEST(RsM8194hPaths, AStarvedStreamEndsAndContinuesFromItsStartSpeed) {
  OneRsm rsm;
  rsm.send({"RSM_SET_MAX_V XY 80000", "RSM_LINE_2D_INITIAL X Y 1000 10000 100000",
            "RSM_LINE_2D_CONTINUE 0 3000 4000"});
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_X"), 3000);
  EXPECT_EQ(rsm.get("Continuous_Inp_Interrupt"), 1);
  EXPECT_EQ(rsm.get("InterpolationRdyFlag"), 1);
  rsm.send("RSM_LINE_2D_CONTINUE 1 3000 4000");
  EXPECT_EQ(rsm.get("Continuous_Inp_Interrupt"), 0);
  // Both ramps: (10000^2 - 1000^2) / 200000 pulses in 90 ms each.
  EXPECT_EQ(rsm.run_to_rest(), static_cast<Tick>(std::ceil(180 + (5000 - 990) / 10.0)) + 1);
  EXPECT_EQ(rsm.get("LP_Y"), 8000);
  EXPECT_EQ(rsm.get("Continuous_Inp_Interrupt"), 0);
}

TEST(RsM8194hPaths, MixedSegmentsFollowEachOther) {
  OneRsm rsm;
  rsm.send({"RSM_SET_MAX_V XY 80000", "RSM_MIX_2D_INITIAL X Y 0 10000 10000 100000",
            "RSM_MIX_2D_CONTINUE 0 1 0 0 1000 0", "RSM_MIX_2D_CONTINUE 0 3 0 500 0 1000",
            "RSM_ABS_MIX_2D_CONTINUE 0 1 0 0 0 1000", "RSM_MIX_2D_CONTINUE 1 5 0 -500 0 0"});
  const double length = 1000 + 500 * kPi + 1000 + 1000 * kPi;
  EXPECT_EQ(rsm.run_to_rest(), static_cast<Tick>(std::ceil(length / 10)) + 1);
  EXPECT_EQ(rsm.get("LP_X"), 0);
  EXPECT_EQ(rsm.get("LP_Y"), 1000);
}

TEST(RsM8194hPaths, HelicesTurnAtTheSpeedOfTheirCircle) {
  OneRsm rsm;
  rsm.send({"RSM_SET_MAX_V XYZU 80000", "RSM_HELIX_3D Y Z U 1 10000 0 5000 3 -2000"});
  EXPECT_NEAR(static_cast<double>(rsm.run_to_rest()), 3 * 2 * kPi * 5000 / 10 + 1, 1);
  EXPECT_EQ(rsm.positions(), (std::vector<Value>{0, 0, 0, -6000}));
}

constexpr double kRounding = 1e-6;

using Place = std::array<double, 3>;

/// Returns true if a straight line from a to b comes within half a pulse of a place, coordinate by
/// coordinate.
bool line_passes(const Place& a, const Place& b, const Place& place) {
  double from = 0, to = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const double way = b[i] - a[i];
    const double low = place[i] - 0.5 - kRounding - a[i];
    const double high = place[i] + 0.5 + kRounding - a[i];
    if (way == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    from = std::max(from, std::min(low / way, high / way));
    to = std::min(to, std::max(low / way, high / way));
  }
  return from <= to;
}
/// Like the above for a circle, in the first two coordinates.
bool circle_passes(const Place& centre, double radius, const Place& place) {
  const double dx = std::abs(place[0] - centre[0]);
  const double dy = std::abs(place[1] - centre[1]);
  const double nearest = std::hypot(std::max(dx - 0.5, 0.0), std::max(dy - 0.5, 0.0));
  const double farthest = std::hypot(dx + 0.5, dy + 0.5);
  return nearest <= radius + kRounding && radius <= farthest + kRounding;
}

using Passes = std::function<bool(const Place&)>;
Passes line(const Place& a, const Place& b) {
  return [=](const Place& place) { return line_passes(a, b, place); };
}
Passes circle(const Place& centre, double radius) {
  return [=](const Place& place) { return circle_passes(centre, radius, place); };
}

struct Course {
  int mode;  // of VECTOR_SPEED
  std::vector<std::string> commands;
  std::vector<Passes> ways;  // one of them at each tick
  Place end;
};

std::vector<Course> courses() {
  const Place zero{0, 0, 0};
  std::vector<Course> all;
  for (const int mode : {0, 1, 2, 3, 4}) {
    all.push_back({mode, {"RSM_LINE_2D 9000 -4001"}, {line(zero, {9000, -4001, 0})}, {9000, -4001, 0}});
    all.push_back({mode, {"RSM_LINE_2D -7 12345"}, {line(zero, {-7, 12345, 0})}, {-7, 12345, 0}});
  }
  for (const int mode : {0, 5, 6}) {
    all.push_back({mode, {"RSM_ARC_CW 3000 0 3000 3000"}, {circle({3000, 0, 0}, 3000)}, {3000, 3000, 0}});
    all.push_back({mode, {"RSM_ARC_CCW 3000 0 3000 3000"}, {circle({3000, 0, 0}, 3000)}, {3000, 3000, 0}});
    all.push_back({mode, {"RSM_CIRCLE_CW 1203 -1604"}, {circle({1203, -1604, 0}, 2005)}, zero});
    all.push_back({mode, {"RSM_CIRCLE_CCW 0 4000"}, {circle({0, 4000, 0}, 4000)}, zero});
  }
  for (const int mode : {7, 8, 9, 10, 11}) {
    all.push_back({mode, {"RSM_LINE_3D 9000 -4001 77"}, {line(zero, {9000, -4001, 77})}, {9000, -4001, 77}});
  }
  all.push_back({7,
                 {"RSM_LINE_3D_INITIAL X Y Z 1000 8000 50000", "RSM_LINE_3D_CONTINUE 0 3000 500 -900",
                  "RSM_LINE_3D_CONTINUE 0 -200 1700 3", "RSM_LINE_3D_CONTINUE 1 0 0 4000"},
                 {line(zero, {3000, 500, -900}), line({3000, 500, -900}, {2800, 2200, -897}),
                  line({2800, 2200, -897}, {2800, 2200, 3103})},
                 {2800, 2200, 3103}});
  all.push_back({0,
                 {"RSM_MIX_2D_INITIAL X Y 1 1000 8000 50000", "RSM_MIX_2D_CONTINUE 0 1 0 0 3000 0",
                  "RSM_MIX_2D_CONTINUE 0 3 0 1500 0 3000", "RSM_MIX_2D_CONTINUE 0 1 0 0 -3000 0",
                  "RSM_MIX_2D_CONTINUE 1 5 0 -800 0 0"},
                 {line(zero, {3000, 0, 0}), circle({3000, 1500, 0}, 1500),
                  line({3000, 3000, 0}, {0, 3000, 0}), circle({0, 2200, 0}, 800)},
                 {0, 3000, 0}});
  // From Sp0, 6000 by 4000 with corners of 500.
  all.push_back(
      {0,
       {"RSM_RECTANGLE X Y 1 0 0 6000 4000 500 1000 8000 40000 40000"},
       {line(zero, {5000, 0, 0}), circle({5000, 500, 0}, 500), line({5500, 500, 0}, {5500, 3500, 0}),
        circle({5000, 3500, 0}, 500), line({5000, 4000, 0}, {0, 4000, 0}), circle({0, 3500, 0}, 500),
        line({-500, 3500, 0}, {-500, 500, 0}), circle({0, 500, 0}, 500)},
       zero});
  // Z is proportional to the angle.
  all.push_back({0,
                 {"RSM_HELIX_3D X Y Z 1 9000 1000 0 3 -700"},
                 {[](const Place& place) {
                   if (!circle_passes({1000, 0, 0}, 1000, place)) return false;
                   const double turned = std::atan2(-place[1], 1000 - place[0]) / (2 * std::numbers::pi);
                   const double by_z = place[2] / -700;
                   // A pulse of Z is a good part of a turn, and a pulse across is a small one.
                   const double off = std::remainder(by_z - turned, 1.0);
                   return std::abs(off) <= 0.5 / 700 + 0.71 / (1000 * 2 * std::numbers::pi);
                 }},
                 {0, 0, -2100}});
  return all;
}

TEST(RsM8194hPaths, PathsAreWithinHalfAPulseAtEveryTick) {
  for (const Course& course : courses()) {
    SCOPED_TRACE(course.commands.back() + " in mode " + std::to_string(course.mode));
    OneRsm rsm;
    rsm.send({"RSM_SET_MAX_V XYZ 80000", "RSM_SET_VSV 1000", "RSM_SET_VV 9000", "RSM_SET_VA 40000",
              "RSM_SET_VD 20000", "RSM_SET_VK 200000", "RSM_SET_VL 150000", "RSM_AXIS_ASSIGN X Y Z"});
    rsm.run(2);
    rsm.send("RSM_VECTOR_SPEED " + std::to_string(course.mode));
    for (const std::string& command : course.commands) rsm.send(command);
    std::size_t way = 0;
    int ticks = 0;
    do {
      rsm.run(1);
      ++ticks;
      const Place place{static_cast<double>(rsm.get("LP_X")), static_cast<double>(rsm.get("LP_Y")),
                        static_cast<double>(rsm.get("LP_Z"))};
      while (way + 1 < course.ways.size() && !course.ways[way](place)) ++way;
      ASSERT_TRUE(course.ways[way](place))
          << "at " << ticks << " on way " << way << ": " << place[0] << " " << place[1] << " " << place[2];
    } while (rsm.get("DRIVING_AXIS") != 0);
    EXPECT_EQ(way + 1, course.ways.size());
    EXPECT_GT(ticks, 500);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(rsm.positions()[i], course.end[i]);
  }
}

/// The example of 7.4.3: 20,001 segments through the FIFO, from a host that sends until it is refused as
/// busy.
TEST(RsM8194hPaths, AStreamOf20001SegmentsNeverStops) {
  constexpr int kSegments = 20'001;
  constexpr int kStep = 100;
  OneRsm rsm;
  rsm.send({"RSM_SET_MAX_V XY 160000", "RSM_LINE_2D_INITIAL X Y 300 18000 500000"});
  const world::Bytes segment = pdu_of("RSM_LINE_2D_CONTINUE 0 100 100");
  const world::Bytes last = pdu_of("RSM_LINE_2D_CONTINUE 1 100 100");
  const Tick begin = rsm.now();
  int sent = 0;
  int busy = 0;
  do {
    while (sent < kSegments) {
      const std::string reply = rsm.ask(sent + 1 == kSegments ? last : segment);
      if (reply.starts_with("90")) {
        ASSERT_EQ(reply, "90 06");
        ++busy;
        break;
      }
      ++sent;
    }
    rsm.run(kStep);
    ASSERT_EQ(rsm.get("Continuous_Inp_Interrupt"), 0) << sent;
    ASSERT_EQ(rsm.get("ERROR_STATE"), 0);
    if (sent < kSegments) {
      // 18000 along the diagonal.
      ASSERT_NEAR(static_cast<double>(rsm.get("CV_X")), 18000 / std::numbers::sqrt2, 1);
      ASSERT_EQ(rsm.get("LP_X"), rsm.get("LP_Y"));
    }
  } while (rsm.get("DRIVING_AXIS") != 0);
  EXPECT_GT(busy, 1000);
  EXPECT_EQ(rsm.positions(), (std::vector<Value>{2'000'100, 2'000'100, 0, 0}));
  const double ramp_s = (18000.0 - 300) / 500000;
  const double ramp_pulses = (18000.0 + 300) / 2 * ramp_s;
  const double at_v = (kSegments * 100 * std::numbers::sqrt2 - ramp_pulses) / 18000 + ramp_s;
  // The end ramp is cut short: it has two segments at most.
  EXPECT_GT(static_cast<double>(rsm.now() - begin), at_v * 1000);
  EXPECT_LT(static_cast<double>(rsm.now() - begin - kStep), (at_v + ramp_s - ramp_pulses / 18000) * 1000 + 1);
}

/// A limit whose active level has changed since the last tick keeps a path from starting.
TEST(RsM8194hPaths, APathFindsTheSignalsOfThisMoment) {
  for (const std::string axis : {"X", "Y", "Z", "U"}) {
    OneRsm rsm;
    rsm.send({"RSM_SET_VSV 1000", "RSM_SET_VV 1000"});
    rsm.send("RSM_AXIS_ASSIGN " + axis + (axis == "Y" ? " Z 0" : " Y 0"));
    rsm.run(5);
    rsm.send("RSM_SET_HLMT " + axis + " 1 1");
    rsm.send("RSM_LINE_2D 100 100");
    EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0) << axis;
    EXPECT_EQ(rsm.get("ERROR_CODE_" + axis), 4) << axis;
    // And the reverse.
    rsm.send("RSM_SET_HLMT " + axis + " 0 0");
    rsm.send("RSM_LINE_2D 100 100");
    EXPECT_NE(rsm.get("DRIVING_AXIS"), 0) << axis;
    rsm.run_to_rest();
    EXPECT_EQ(rsm.get("LP_" + axis), 100);
  }
}

}  // namespace paths_test
}  // namespace understudy::emulator::models::rs_m8194h
