// SUPER-40NC's LIN and arcs: lengths in 0.001 mm (LU), F in LU per second, factory slope and CMX/CDV 1/1.
#include <gtest/gtest.h>

#include "tests/motion/coordinated_bench.h"

namespace understudy::motion {
namespace fit_super40nc_path_test {

constexpr double kSlope = 666'667;  // pulses per second squared
constexpr double kMm = 1000;

SpeedLaw feed(double mm_s) { return by_slope(mm_s * kMm, kSlope); }

/// Returns the seconds until the axes are released.
double run_s(Bench& bench, const Path& path) {
  const Tick begin = bench.tick;
  bench.add(path);
  EXPECT_EQ(bench.begin(path.begin), Cause::none);
  return static_cast<double>(bench.to_the_end() - begin - 1) / kTicksPerSecond;
}

Point mm(double x, double y, double z = 0, double u = 0) { return kMm * place_of(x, y, z, u); }

constexpr double kTolerance_s = 0.003;

TEST(FitSuper40ncPath, LinTakesTheManualsTimes) {
  Bench fast(feed(50));
  EXPECT_NEAR(run_s(fast, line(mm(0, 0), mm(20, 25))), 0.715, kTolerance_s);
  EXPECT_EQ(fast.travels(), (Travels{20'000, 25'000, 0, 0}));
  Bench slow(feed(20));
  EXPECT_NEAR(run_s(slow, line(mm(0, 0), mm(25, 25))), 1.798, kTolerance_s);
  EXPECT_EQ(slow.travels(), (Travels{25'000, 25'000, 0, 0}));
  // Four axes at once: M2's first move, at the default feed of the program.
  Bench four(feed(10));
  const Point end = mm(12.15, 35.5, 1.5, 22.3);
  EXPECT_NEAR(run_s(four, line(mm(0, 0), end)), end.norm() / 10'000 + 10'000 / kSlope, kTolerance_s);
  EXPECT_EQ(four.travels(), (Travels{12'150, 35'500, 1500, 22'300}));
}

TEST(FitSuper40ncPath, SampleM3ALineAHalfCircleAndAFullCircle) {
  Bench bench(feed(50));
  EXPECT_NEAR(run_s(bench, line(mm(0, 0), mm(20, 25))), 0.715, kTolerance_s);
  // CCW K48000 K25000 K14000: end absolute, centre from the beginning: through (34, 11).
  const Path half = arc_by_centre(mm(20, 25), mm(34, 25), mm(48, 25), Turn::counter_clockwise);
  EXPECT_LT((half.at(half.length_u / 2) - mm(34, 11)).norm(), 1e-6);
  EXPECT_NEAR(run_s(bench, half), 0.955, kTolerance_s);
  EXPECT_EQ(bench.travels(), (Travels{48'000, 25'000, 0, 0}));
  // CW * * K7000 K7000: a full circle.
  const Path circle = arc_by_centre(mm(48, 25), mm(55, 32), mm(48, 25), Turn::clockwise);
  EXPECT_NEAR(run_s(bench, circle), 1.319, kTolerance_s);
  EXPECT_EQ(bench.travels(), (Travels{48'000, 25'000, 0, 0}));
}

TEST(FitSuper40ncPath, SampleM4ArcsByThreePoints) {
  Bench bench(feed(50));
  run_s(bench, line(mm(0, 0), mm(20, 25)));
  const Path first = arc_by_three_points(mm(20, 25), mm(25, 66), mm(65, 80));
  EXPECT_LT((first.centre - mm(56.0573, 41.4076)).norm(), 0.1);
  EXPECT_NEAR(first.length_u, 88'165, 1);
  EXPECT_NEAR(run_s(bench, first), 88.165 / 50 + 50'000 / kSlope, kTolerance_s);
  const Path second = arc_by_three_points(mm(65, 80), mm(65, 36), mm(20, 25));
  EXPECT_LT((second.centre - mm(35.7778, 58)).norm(), 0.1);
  EXPECT_NEAR(run_s(bench, second), 97.374 / 50 + 50'000 / kSlope, kTolerance_s);
  EXPECT_EQ(bench.travels(), (Travels{20'000, 25'000, 0, 0}));
}

TEST(FitSuper40ncPath, SampleM5ArcsByRadius) {
  Bench bench(feed(50));
  run_s(bench, line(mm(0, 0), mm(20, 15)));
  const Path major = arc_by_radius(mm(20, 15), mm(30, 23), -10 * kMm, Turn::clockwise);
  EXPECT_LT((major.centre - mm(20.2016, 24.9980)).norm(), 0.1);
  EXPECT_NEAR(run_s(bench, major), 280.370 * std::numbers::pi / 180 * 10 / 50 + 50'000 / kSlope,
              kTolerance_s);
  EXPECT_EQ(bench.travels(), (Travels{30'000, 23'000, 0, 0}));
  const Path minor = arc_by_radius(mm(30, 23), mm(20, 15), 10 * kMm, Turn::counter_clockwise);
  EXPECT_LT((minor.centre - mm(29.7984, 13.0020)).norm(), 0.1);
  EXPECT_NEAR(run_s(bench, minor), 79.630 * std::numbers::pi / 180 * 10 / 50 + 50'000 / kSlope, kTolerance_s);
  EXPECT_EQ(bench.travels(), (Travels{20'000, 15'000, 0, 0}));
}

TEST(FitSuper40ncPath, HalfCirclesInEachPlane) {
  // M6's: 24 mm across about a centre 12 mm ahead on the first axis of the plane.
  struct Row {
    const char* name;
    Plane plane;
  };
  for (const Row& row : {Row{"XYP", {0, 1}}, Row{"XZP", {0, 2}}, Row{"YZP", {1, 2}}}) {
    Bench bench(feed(10));
    const Point begin = mm(14, 18, 5);
    Point centre = begin;
    Point end = begin;
    Point lowest = begin;
    centre[row.plane.first] += 12 * kMm;
    end[row.plane.first] += 24 * kMm;
    lowest[row.plane.first] += 12 * kMm;
    lowest[row.plane.second] -= 12 * kMm;
    const Path half = arc_by_centre(begin, centre, end, Turn::counter_clockwise, {.plane = row.plane});
    EXPECT_LT((half.at(half.length_u / 2) - lowest).norm(), 1e-6) << row.name;
    EXPECT_NEAR(run_s(bench, half), 12 * std::numbers::pi / 10 + 10'000 / kSlope, kTolerance_s) << row.name;
    Travels expected{};
    expected[static_cast<std::size_t>(row.plane.first)] = 24'000;
    EXPECT_EQ(bench.travels(), expected) << row.name;
  }
}

TEST(FitSuper40ncPath, CmxAndCdvScaleTheAxesNotThePath) {
  // 8/5: the slope in LU is that of the axis times 5/8; the path's time follows from LU alone.
  const double slope_lu = kSlope * 5 / 8;
  Bench bench(by_slope(50'000, slope_lu));
  bench.group.scale.fill(UnitScale::of(8, 5));
  const double length = mm(20, 25).norm();
  EXPECT_NEAR(run_s(bench, line(mm(0, 0), mm(20, 25))), length / 50'000 + 50'000 / slope_lu, kTolerance_s);
  EXPECT_EQ(bench.travels(), (Travels{32'000, 40'000, 0, 0}));
  // Back through odd positions: rounding errors do not add up.
  Point here = mm(20, 25);
  for (const Point& next : {mm(7.777, 3.333), mm(-1.001, 13.337), mm(0.003, -0.002), mm(0, 0)}) {
    run_s(bench, line(here, next));
    here = next;
  }
  EXPECT_EQ(bench.travels(), (Travels{0, 0, 0, 0}));
}

TEST(FitSuper40ncPath, OverrideScalesFBetween0And200PerCentAtOnce) {
  const double length = mm(20, 25).norm();
  for (const int per_cent : {1, 50, 100, 150, 200}) {
    Bench bench(feed(50));
    bench.group.run.set_override(per_cent / 100.0, 0);
    const double speed = 500.0 * per_cent;
    EXPECT_NEAR(run_s(bench, line(mm(0, 0), mm(20, 25))), trapezoid_s(length, speed, kSlope), kTolerance_s);
  }
  // During motion, 0 holds and 100 continues.
  Bench bench(feed(50));
  bench.add(line(mm(0, 0), mm(20, 25)));
  bench.begin();
  bench.steps(201);
  bench.group.run.set_override(0, bench.tick);
  bench.steps(75);  // 50,000 / 666,667 s
  const Travels stands = bench.travels();
  bench.steps(500);
  EXPECT_EQ(bench.travels(), stands);
  EXPECT_NEAR(static_cast<double>(stands[0]) * 1.25, static_cast<double>(stands[1]), 2);
  EXPECT_TRUE(bench.group.engaged);
  bench.group.run.set_override(1, bench.tick);
  EXPECT_GT(bench.to_the_end(), 0);
  EXPECT_EQ(bench.travels(), (Travels{20'000, 25'000, 0, 0}));
}

TEST(FitSuper40ncPath, APauseInAnArcIsResumedToItsEnd) {
  const Path circle = arc_by_centre(mm(48, 25), mm(55, 32), mm(48, 25), Turn::clockwise);
  for (int at = 50; at < 1300; at += 111) {
    Bench bench(feed(50));
    bench.add(circle);
    bench.begin(circle.begin);
    bench.steps(at);
    bench.group.run.pause(bench.tick);
    bench.steps(300);
    EXPECT_TRUE(bench.group.engaged);
    const auto [x, y, z, u] = bench.travels();
    EXPECT_NEAR(std::hypot(static_cast<double>(x) - 7000, static_cast<double>(y) - 7000),
                7000 * std::sqrt(2.0), 1);
    bench.group.run.resume(bench.tick);
    EXPECT_GT(bench.to_the_end(), 0);
    EXPECT_EQ(bench.travels(), (Travels{0, 0, 0, 0}));
    EXPECT_EQ(bench.group.cause, Cause::arrived);
  }
}

}  // namespace fit_super40nc_path_test
}  // namespace understudy::motion
