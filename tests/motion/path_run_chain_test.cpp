// Chains: which corners are run through, where the motion stops, and how long it takes.
#include <gtest/gtest.h>

#include <array>

#include "motion/bad_motion.h"
#include "tests/motion/path_shapes.h"

namespace understudy::motion {
namespace path_run_chain_test {

constexpr double kPi = std::numbers::pi;
constexpr Tick kBegin = 70;

/// Milliseconds from start() to the tick of the end, minus the one tick that a start takes.
Tick duration_ms(PathRun& run, Tick begin = kBegin) {
  run.start(begin);
  return finish(run, begin) - begin - 1;
}

PathRun run_of(const std::vector<Path>& paths, Joint joint, const SpeedLaw& law = by_slope(100, 1000)) {
  PathRun run;
  run.set_speed(law, 0);
  for (const Path& path : paths) run.append(path, joint, 0);
  return run;
}

std::vector<Path> polygon(int sides, double side_u) {
  std::vector<Path> paths;
  Point here = place_of(0, 0);
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * kPi * i / sides;
    const Point next =
        i + 1 == sides ? place_of(0, 0) : here + side_u * place_of(std::cos(angle), std::sin(angle));
    paths.push_back(line(here, next));
    here = next;
  }
  return paths;
}

TEST(PathRunChain, OnePathTakesItsTrapezoidsTimeAndEndsOnItsEndPoint) {
  struct Row {
    double length, top, slope;
  };
  constexpr Row kRows[]{{100, 100, 1000}, {10, 100, 1000}, {9.999, 100, 1000},  {1e-6, 100, 1000},
                        {0.3, 7, 3},      {1e6, 1e5, 1e6}, {123.456, 0.5, 0.1}, {1e9, 1e8, 1e7}};
  for (const Row& row : kRows) {
    const Point end = place_of(row.length * 0.6, -row.length * 0.8);
    PathRun run = run_of({line(place_of(0, 0), end)}, kStop, by_slope(row.top, row.slope));
    const double closed_ms = trapezoid_s(end.norm(), row.top, row.slope) * kTicksPerSecond;
    EXPECT_NEAR(static_cast<double>(duration_ms(run)), closed_ms, 1) << row.length;
    EXPECT_EQ(run.step(10'000'000), end) << row.length;
  }
}

TEST(PathRunChain, IsAtTheBeginningInItsFirstTickAndMovesInTheSecond) {
  const Point begin = place_of(5, 6, 7, 8);
  PathRun run = run_of({line(begin, place_of(9, 6, 7, 8))}, kStop);
  run.start(kBegin);
  EXPECT_TRUE(run.running());
  EXPECT_TRUE(run.at_rest(kBegin));
  EXPECT_EQ(run.step(kBegin + 1), begin);
  EXPECT_NEAR(run.step(kBegin + 2)[0] - 5, 0.5 * 1000 * 1e-6, 1e-15);
  EXPECT_FALSE(run.at_rest(kBegin + 2));
}

TEST(PathRunChain, AStartSpeedIsNotThereBeforeTheBeginning) {
  SpeedLaw law = by_slope(100, 1000);
  law.start_speed_u_s = 20;
  PathRun run = run_of({line(place_of(0, 0), place_of(9, 0))}, kStop, law);
  run.start(kBegin);
  EXPECT_TRUE(run.at_rest(kBegin));
  law.up = law.down = RampLaw::by_slope(500);
  run.set_speed(law, kBegin);  // still at rest
  run.step(kBegin + 1);
  run.step(kBegin + 2);
  EXPECT_NEAR(run.sample(kBegin + 2).speed_u_s, 20.5, 1e-9);
}

TEST(PathRunChain, CornersAreStoppedAtRunThroughOrDecidedByTheirAngle) {
  struct Row {
    const char* what;
    int sides;
    Joint joint;
    bool smooth;
  };
  const Row rows[]{{"always stop", 8, kStop, false},
                   {"always join", 8, kJoin, true},
                   {"octagon, exactly its 45 degrees", 8, join_below(45), true},
                   {"octagon, a little less", 8, join_below(44.999), false},
                   {"octagon, more", 8, join_below(60), true},
                   {"octagon, straight on only", 8, join_below(0), false},
                   {"square, exactly its 90 degrees", 4, join_below(90), true},
                   {"square, less", 4, join_below(89.999), false},
                   {"triangle, exactly its 120 degrees", 3, join_below(120), true},
                   {"hexagon, exactly its 60 degrees", 6, join_below(60), true},
                   {"there and back, joined all the same", 2, kJoin, true},
                   {"there and back, 180 degrees", 2, join_below(180), true},
                   {"there and back, less", 2, join_below(179.9), false}};
  for (const Row& row : rows) {
    PathRun run = run_of(polygon(row.sides, 10), row.joint);
    const double closed_ms =
        1000 * (row.smooth ? trapezoid_s(10 * row.sides, 100, 1000) : row.sides * trapezoid_s(10, 100, 1000));
    EXPECT_NEAR(static_cast<double>(duration_ms(run)), closed_ms, row.smooth ? 1 : row.sides) << row.what;
    EXPECT_EQ(run.step(1'000'000), place_of(0, 0)) << row.what;
  }
}

TEST(PathRunChain, AtAnArcItsTangentCounts) {
  // From the east, around a quarter about (0, 10), and on to the north: no corner at either joint.
  const Shape first = Shape::line_to(place_of(-20, 0), place_of(0, 0));
  const Shape arc = Shape::arc(place_of(0, 0), place_of(0, 10), kPi / 2);
  const Shape last = Shape::line_to(arc.end, arc.end + place_of(0, 20));
  const Shape wrong = Shape::line_to(arc.end, arc.end + place_of(20, 0));
  const double smooth_ms = 1000 * trapezoid_s(40 + 5 * kPi, 100, 1000);
  PathRun on = run_of({first.path(), arc.path(), last.path()}, join_below(0));
  EXPECT_NEAR(static_cast<double>(duration_ms(on)), smooth_ms, 1);
  PathRun corner = run_of({first.path(), arc.path(), wrong.path()}, join_below(89));
  EXPECT_NEAR(static_cast<double>(duration_ms(corner)),
              1000 * (trapezoid_s(20 + 5 * kPi, 100, 1000) + trapezoid_s(20, 100, 1000)), 2);
}

TEST(PathRunChain, PassesCornersWithoutStoppingAndCountsPathsDone) {
  PathRun run = run_of(polygon(8, 10), kJoin);
  run.start(0);
  int completed = 0;
  for (Tick tick = 1; tick <= 901; ++tick) {
    run.step(tick);
    completed += run.completed();
    if (tick > 150 && tick < 750) {
      ASSERT_NEAR(run.sample(tick).speed_u_s, 100, 1e-9) << tick;
    }
    if (run.running()) {
      ASSERT_EQ(run.queued(), 8U - static_cast<unsigned>(completed)) << tick;
    }
  }
  EXPECT_EQ(completed, 8);
  EXPECT_FALSE(run.running());
  EXPECT_TRUE(run.at_rest(901));
}

TEST(PathRunChain, OneTickMayPassManyPaths) {
  std::vector<Path> paths;
  for (int i = 0; i < 32; ++i) paths.push_back(line(place_of(i * 0.01, 0), place_of((i + 1) * 0.01, 0)));
  PathRun run = run_of(paths, kJoin, by_slope(1000, 1e6));
  EXPECT_TRUE(run.full());
  EXPECT_NEAR(static_cast<double>(duration_ms(run)), 1000 * trapezoid_s(0.32, 1000, 1e6), 1);
  EXPECT_EQ(run.step(1000), paths.back().end);
}

TEST(PathRunChain, AFullQueueRefusesAndKeepsWhatItHas) {
  std::vector<Path> there_and_back;
  for (std::size_t i = 0; i < PathRun::kMaxPaths; ++i) {
    const double from = i % 2 == 0 ? 0 : 1;
    there_and_back.push_back(line(place_of(from, 0), place_of(1 - from, 0)));
  }
  PathRun run = run_of(there_and_back, kStop);
  const PathRun before = run;
  try {
    run.append(line(place_of(1, 0), place_of(2, 0)), kJoin, 0);
    ADD_FAILURE() << "taken";
  } catch (const BadMotion& refused) {
    EXPECT_EQ(refused.refusal(), Refusal::no_room);
  }
  EXPECT_EQ(run, before);
}

TEST(PathRunChain, PathsOfNoLengthAreOverAsTheyBegin) {
  const Path nothing = line(place_of(3, 4), place_of(3, 4));
  const Path away = line(place_of(3, 4), place_of(3, 14));
  const Path back = line(place_of(3, 14), place_of(3, 4));
  const Path nothing_there = line(place_of(3, 14), place_of(3, 14));
  const Tick one = 200;  // 10 at 100 and 1000: the triangle that is just whole
  struct Row {
    const char* what;
    std::vector<Path> paths;
    Joint joint;
    Tick ms;
  };
  const Row rows[]{
      {"alone", {nothing}, kStop, 0},
      {"many", {nothing, nothing, nothing}, kStop, 0},
      {"many joined", {nothing, nothing, nothing}, kJoin, 0},
      {"first", {nothing, away}, kStop, one},
      {"first joined", {nothing, away}, kJoin, one},
      {"last", {away, nothing_there}, kStop, one},
      {"last joined", {away, nothing_there}, kJoin, one},
      {"between", {away, nothing_there, back}, kStop, 2 * one},
      {"between, joined", {away, nothing_there, back}, kJoin, 300},
      {"a corner is no less for a path of no length in it",
       {away, nothing_there, back},
       join_below(90),
       2 * one},
      {"nor for two", {away, nothing_there, nothing_there, back}, join_below(90), 2 * one},
  };
  for (const Row& row : rows) {
    PathRun run = run_of(row.paths, row.joint);
    run.start(kBegin);
    int completed = 0;
    Tick tick = kBegin;
    while (run.queued() > 0 && tick < kBegin + 2000) {
      run.step(++tick);
      completed += run.completed();
    }
    EXPECT_EQ(tick - kBegin - 1, row.ms) << row.what;
    EXPECT_EQ(completed, static_cast<int>(row.paths.size())) << row.what;
    EXPECT_EQ(run.step(tick + 1), row.paths.back().end) << row.what;
    EXPECT_EQ(run.completed(), 0) << row.what;
  }
}

TEST(PathRunChain, EveryLawsChainTakesTheTimeOfOneMoveOfItsLength) {
  SpeedLaw jerk{.top_speed_u_s = 80, .up = RampLaw::by_jerk(5000), .down = RampLaw::by_jerk(2000)};
  SpeedLaw time{.top_speed_u_s = 80, .up = RampLaw::by_time(0.1), .down = RampLaw::by_time(0.25)};
  SpeedLaw sections{
      .top_speed_u_s = 80, .up = RampLaw::by_sections(1000, 10), .down = RampLaw::by_sections(600, 10)};
  // Both ramps whole: the cruising length is what the ramps, each at half the top speed, leave.
  const auto closed_s = [](double length, double ramps_s) { return length / 80 + ramps_s / 2; };
  struct Row {
    SpeedLaw law;
    double ramps_s;
  };
  const Row rows[]{{jerk, 2 * std::sqrt(80.0 / 5000) + 2 * std::sqrt(80.0 / 2000)},
                   {time, 0.35},
                   {sections, (80.0 + 20) / 1000 + (80.0 + 20) / 600}};
  for (const Row& row : rows) {
    PathRun run = run_of(polygon(8, 10), kJoin, row.law);
    EXPECT_NEAR(static_cast<double>(duration_ms(run)), 1000 * closed_s(80, row.ramps_s), 1);
  }
}

TEST(PathRunChain, LawsThatNoChainCouldBePlannedWithAreRefusedAtOnce) {
  PathRun run;
  run.set_speed(by_slope(100, 1000), 0);
  const PathRun before = run;
  SpeedLaw creeps_at_nothing = by_slope(100, 1000);
  creeps_at_nothing.slow_down_offset_u = 8;
  SpeedLaw for_ages = by_slope(1e300, 1e-10);
  SpeedLaw too_slow = by_slope(1e-300, 1);
  SpeedLaw none;
  for (const SpeedLaw& law : {creeps_at_nothing, for_ages, too_slow, none}) {
    EXPECT_THROW(run.set_speed(law, 0), BadMotion);
    EXPECT_EQ(run, before);
  }
  for (const double factor : {-0.1, 10.1, std::nan(""), 1e-320}) {
    EXPECT_THROW(run.set_override(factor, 0), BadMotion) << factor;
    EXPECT_EQ(run, before);
  }
  PathRun without_law;
  without_law.append(line(place_of(0, 0), place_of(1, 0)), kStop, 0);
  EXPECT_THROW(without_law.start(0), BadMotion);
  EXPECT_FALSE(without_law.running());
}

}  // namespace path_run_chain_test
}  // namespace understudy::motion
