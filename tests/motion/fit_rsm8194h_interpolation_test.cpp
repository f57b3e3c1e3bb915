// RS-M8194H's interpolation: vector speeds VSV, VV, VA, VD, VK, VL, VAO on lines and arcs, continuous
// interpolation, rectangle and helix. Lengths in pulses; manual 7.2 and 7.4.
#include <gtest/gtest.h>

#include <optional>

#include "motion/bad_motion.h"
#include "tests/motion/coordinated_bench.h"

namespace understudy::motion {
namespace fit_rsm8194h_interpolation_test {

constexpr double kPi = std::numbers::pi;

/// VECTOR_SPEED's parameters; with `s_curve`, VK and VL are used, otherwise VA and VD. VAO 0 unless given.
struct VectorSpeed {
  bool s_curve = false;
  double vsv = 0, vv = 0, va = 0, vd = 0, vk = 0, vl = 0, vao = 0;

  SpeedLaw law() const {
    SpeedLaw speed{.start_speed_u_s = vsv, .top_speed_u_s = vv};
    // Constant speed: VV = VSV, and no ramp is ever used.
    speed.up = s_curve ? RampLaw::by_jerk(vk) : RampLaw::by_slope(va > 0 ? va : 1e6);
    speed.down = s_curve ? RampLaw::by_jerk(vl) : RampLaw::by_slope(vd > 0 ? vd : 1e6);
    speed.slow_down_offset_u = vao;
    return speed;
  }
  double ramp_s(double a, double k) const {
    return vv <= vsv ? 0 : s_curve ? 2 * std::sqrt((vv - vsv) / k) : (vv - vsv) / a;
  }
  /// The chip's law over a length that reaches VV: the pulses of a ramp are its mean speed times its time. A
  /// ramp that starts VAO pulses early leaves these to creep at VSV.
  double closed_s(double length) const {
    const double up_s = ramp_s(va, vk);
    const double down_s = ramp_s(vd, vl);
    const double ramps_u = (vv + vsv) / 2 * (up_s + down_s);
    return up_s + down_s + (length - ramps_u - vao) / vv + (vao > 0 ? vao / vsv : 0);
  }
};

double run_s(Bench& bench, const std::vector<Path>& segments) {
  const Tick begin = bench.tick;
  for (const Path& path : segments) bench.add(path, kJoin);
  EXPECT_EQ(bench.begin(segments.front().begin), Cause::none);
  return static_cast<double>(bench.to_the_end() - begin - 1) / kTicksPerSecond;
}

const Point kHere = Point::Zero();
const Path kLine2 = line(kHere, place_of(30'000, -40'000));
const Path kLine3 = line(kHere, place_of(-20'000, 30'000, 60'000));
const Path kArc =
    arc_by_centre(kHere, place_of(20'000, 0), place_of(20'000, 20'000), Turn::counter_clockwise);

struct ModeCase {
  int mode;
  const char* what;
  Path path;
  double length;
  VectorSpeed speed;
};

TEST(FitRsm8194hInterpolation, EveryModeOfVectorSpeedTakesTheChipsTime) {
  const VectorSpeed constant{.vsv = 5000, .vv = 5000};
  const VectorSpeed t{.vsv = 1000, .vv = 20'000, .va = 50'000, .vd = 50'000};
  const VectorSpeed t_asymmetric{.vsv = 1000, .vv = 20'000, .va = 50'000, .vd = 20'000};
  const VectorSpeed s{.s_curve = true, .vsv = 1000, .vv = 20'000, .vk = 500'000, .vl = 500'000};
  const VectorSpeed s_asymmetric{.s_curve = true, .vsv = 1000, .vv = 20'000, .vk = 500'000, .vl = 200'000};
  const double arc_u = 1.5 * kPi * 20'000;
  const ModeCase kModes[]{
      {0, "2-axis line, constant", kLine2, 50'000, constant},
      {0, "2-axis arc, constant", kArc, arc_u, constant},
      {1, "2-axis line, symmetric T", kLine2, 50'000, t},
      {2, "2-axis line, symmetric S", kLine2, 50'000, s},
      {3, "2-axis line, asymmetric T", kLine2, 50'000, t_asymmetric},
      {4, "2-axis line, asymmetric S", kLine2, 50'000, s_asymmetric},
      {5, "2-axis arc, symmetric T", kArc, arc_u, t},
      {6, "2-axis arc, asymmetric T", kArc, arc_u, t_asymmetric},
      {7, "3-axis line, constant", kLine3, 70'000, constant},
      {8, "3-axis line, symmetric T", kLine3, 70'000, t},
      {9, "3-axis line, symmetric S", kLine3, 70'000, s},
      {10, "3-axis line, asymmetric T", kLine3, 70'000, t_asymmetric},
      {11, "3-axis line, asymmetric S", kLine3, 70'000, s_asymmetric},
  };
  for (const ModeCase& mode : kModes) {
    for (const double vao : {0.0, 8.0, 200.0}) {
      VectorSpeed speed = mode.speed;
      speed.vao = vao;
      Bench bench(speed.law());
      EXPECT_NEAR(mode.path.length_u, mode.length, 1e-6) << mode.what;
      EXPECT_NEAR(run_s(bench, {mode.path}), speed.closed_s(mode.length), 0.0011)
          << mode.what << " VAO " << vao;
      for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(bench.axes[static_cast<std::size_t>(i)].travel_pulses, std::llround(mode.path.end[i]))
            << mode.what;
      }
    }
  }
}

TEST(FitRsm8194hInterpolation, AtConstantVectorSpeedEveryTickGoesTheSameWay) {
  for (const Path& path : {kLine2, kLine3, kArc}) {
    PathRun run;
    run.set_speed(VectorSpeed{.vsv = 5000, .vv = 5000}.law(), 0);
    run.append(path, kStop, 0);
    run.start(0);
    Point before = run.step(1);
    for (Tick tick = 2; run.queued() > 0; ++tick) {
      const Point place = run.step(tick);
      // A chord of an arc of 5 on a radius of 20,000 is as long as the arc, except for 1e-8.
      if (run.queued() > 0) {
        ASSERT_NEAR((place - before).norm(), 5, 1e-6) << tick;
      }
      before = place;
    }
    EXPECT_EQ(before, path.end);
  }
}

TEST(FitRsm8194hInterpolation, AVaoBelowZeroEndsAbruptlyAtMoreThanVsv) {
  VectorSpeed late{.vsv = 1000, .vv = 20'000, .va = 50'000, .vd = 50'000, .vao = -500};
  Bench bench(late.law());
  const double whole_s = VectorSpeed{.vsv = 1000, .vv = 20'000, .va = 50'000, .vd = 50'000}.closed_s(50'000);
  EXPECT_LT(run_s(bench, {kLine2}), whole_s - 0.05);
  EXPECT_EQ(bench.travels(), (Travels{30'000, -40'000, 0, 0}));
}

TEST(FitRsm8194hInterpolation, RelativeArcsAreAboutTheirCentreToTheirEnd) {
  // ARC_CW centre (-5000, -5000) end (-10000, -10000): a half circle of 7071.
  const Path half = arc_by_centre(kHere, place_of(-5000, -5000), place_of(-10'000, -10'000), Turn::clockwise);
  EXPECT_NEAR(half.length_u, kPi * 7071.0678, 1e-3);
  // Clockwise from the north-east of its centre: through the south-east.
  EXPECT_LT((half.at(half.length_u / 2) - place_of(0, -10'000)).norm(), 1e-6);
  const Path other =
      arc_by_centre(kHere, place_of(-5000, -5000), place_of(-10'000, -10'000), Turn::counter_clockwise);
  EXPECT_LT((other.at(other.length_u / 2) - place_of(-10'000, 0)).norm(), 1e-6);
  // CIRCLE_CCW: the end is the beginning.
  const Path circle = arc_by_centre(kHere, place_of(0, 3000), kHere, Turn::counter_clockwise);
  EXPECT_NEAR(circle.length_u, 2 * kPi * 3000, 1e-6);
  for (const Path& path : {half, other, circle}) {
    Bench bench(VectorSpeed{.vsv = 500, .vv = 30'000, .va = 1e5, .vd = 1e5}.law());
    EXPECT_GT(run_s(bench, {path}), 0);
    EXPECT_EQ(bench.travels(), (Travels{std::llround(path.end[0]), std::llround(path.end[1]), 0, 0}));
  }
}

TEST(FitRsm8194hInterpolation, AnEndOffTheCircleIsAcceptedAsTheChipDrawsIt) {
  // 7.2.2's example: centre (10000, 0), end (11000, 9000). The shorter coordinate from the centre is X's
  // 1000: the arc ends there, on the circle of 10000, clockwise from the west to the north.
  const Path arc = arc_by_centre(kHere, place_of(10'000, 0), place_of(11'000, 9000), Turn::clockwise,
                                 {.off_circle = OffCircle::quadrant});
  EXPECT_LT((arc.end - place_of(11'000, std::sqrt(1e8 - 1e6))).norm(), 1e-6);
  Bench bench(VectorSpeed{.vsv = 5000, .vv = 5000}.law());
  EXPECT_NEAR(run_s(bench, {arc}), 10'000 * (kPi / 2 + std::asin(0.1)) / 5000, 0.0011);
  EXPECT_EQ(bench.travels(), (Travels{11'000, 9950, 0, 0}));
}

/// LINE_2D_CONTINUE: relative segments, of which the last is marked.
TEST(FitRsm8194hInterpolation, SegmentsKeepTheVectorSpeedUntilTheLastSlowsDown) {
  const VectorSpeed t{.vsv = 1000, .vv = 20'000, .va = 50'000, .vd = 50'000};
  PathRun run;
  run.set_speed(t.law(), 0);
  Point here = kHere;
  std::vector<Path> segments;
  for (int i = 0; i < 30; ++i) {
    const Point next = here + place_of(1000, i % 2 == 0 ? 300 : -300);
    segments.push_back(line(here, next));
    here = next;
  }
  segments.push_back(line(here, here + place_of(8000, 0)));
  for (const Path& segment : segments) run.append(segment, kJoin, 0);
  run.start(0);
  double length = 0;
  for (const Path& segment : segments) length += segment.length_u;
  const double ramp_u = (20'000.0 * 20'000 - 1000 * 1000) / (2 * 50'000);
  Tick tick = 0;
  while (run.queued() > 0 && tick < 10'000) {
    run.step(++tick);
    const Sample here_now = run.sample(tick);
    if (here_now.position_u > ramp_u + 20 && here_now.position_u < length - ramp_u - 20) {
      ASSERT_NEAR(here_now.speed_u_s, 20'000, 1e-6) << tick;
    }
    if (run.queued() > 1) {
      ASSERT_GE(here_now.speed_u_s, 1000) << tick;
    }
  }
  EXPECT_NEAR(static_cast<double>(tick - 1) / 1000, t.closed_s(length), 0.0011);
  EXPECT_EQ(run.step(tick + 1), segments.back().end);
}

/// 7.4.3's example streams 20001 segments; the host waits while the queue is full.
TEST(FitRsm8194hInterpolation, AStreamIsTakenAsRoomComesAndNeverStopsOnTheWay) {
  const VectorSpeed t{.vsv = 1000, .vv = 10'000, .va = 100'000, .vd = 100'000};
  Bench bench(t.law());
  constexpr int kSegments = 5000;
  int sent = 0;
  const auto send = [&] {
    while (sent < kSegments && !bench.group.run.full()) {
      const auto x = static_cast<double>(sent * 40);
      bench.add(line(place_of(x, 0), place_of(x + 40, 0)), kJoin);
      ++sent;
    }
  };
  send();
  bench.begin();
  double min = 1e9;
  while (bench.group.engaged && bench.tick < 60'000) {
    bench.step();
    if (bench.tick % 3 == 0) send();
    const double x = static_cast<double>(bench.axes[0].travel_pulses);
    if (x > 600 && x < kSegments * 40 - 600) {
      min = std::min(min, bench.group.run.sample(bench.tick).speed_u_s);
    }
  }
  EXPECT_NEAR(min, 10'000, 1e-6);  // stops in 495, of the queue's 1280 minus three ticks' 30
  EXPECT_NEAR(static_cast<double>(bench.tick - 1) / 1000, t.closed_s(kSegments * 40), 0.0011);
  EXPECT_EQ(bench.travels(), (Travels{kSegments * 40, 0, 0, 0}));
}

TEST(FitRsm8194hInterpolation, ARoundedRectangleRunsAtConstantVectorSpeed) {
  constexpr double kLong = 20'000;
  constexpr double kWide = 10'000;
  constexpr double kCorner = 1000;
  // From the middle of the lower side, counter-clockwise.
  std::vector<Path> sides;
  Point here = kHere;
  const double straight[]{kLong / 2 - kCorner, kWide - 2 * kCorner, kLong - 2 * kCorner, kWide - 2 * kCorner};
  for (int i = 0; i < 4; ++i) {
    const Point ahead = place_of(i == 0 ? 1 : i == 2 ? -1 : 0, i == 1 ? 1 : i == 3 ? -1 : 0);
    const Point left = place_of(-ahead[1], ahead[0]);
    sides.push_back(line(here, here + straight[i] * ahead));
    here = sides.back().end;
    sides.push_back(
        arc_by_centre(here, here + kCorner * left, here + kCorner * (ahead + left), Turn::counter_clockwise));
    here = sides.back().end;
  }
  sides.push_back(line(here, kHere));
  for (std::size_t i = 1; i < sides.size(); ++i)
    EXPECT_NEAR(corner_deg(sides[i - 1], sides[i]), 0, 1e-9) << i;
  const double length = 2 * (kLong + kWide) - 8 * kCorner + 2 * kPi * kCorner;
  const VectorSpeed constant{.vsv = 8000, .vv = 8000};
  Bench bench(constant.law());
  EXPECT_NEAR(run_s(bench, sides), length / 8000, 0.0011);
  EXPECT_EQ(bench.travels(), (Travels{0, 0, 0, 0}));
  const VectorSpeed t{.vsv = 1000, .vv = 20'000, .va = 50'000, .vd = 20'000};
  Bench ramped(t.law());
  EXPECT_NEAR(run_s(ramped, sides), t.closed_s(length), 0.0011);
}

TEST(FitRsm8194hInterpolation, AHelixTurnsWhileItsThirdAxisGoesByItsPitch) {
  // HELIX_3D: CW, centre (0, 25000), 3 turns, pitch -2000.
  const Path helix = arc_by_sweep(kHere, place_of(0, 25'000), -3 * 2 * kPi, place_of(0, 0, -6000));
  const double length = 3 * std::hypot(2 * kPi * 25'000, 2000);
  EXPECT_NEAR(helix.length_u, length, 1e-3);
  Bench bench(VectorSpeed{.vsv = 100'000, .vv = 100'000}.law());
  bench.add(helix);
  bench.begin();
  while (bench.group.engaged && bench.tick < 10'000) {
    bench.step();
    const auto at = bench.travels();
    const double x = static_cast<double>(at[0]);
    const double y = static_cast<double>(at[1]);
    const double z = static_cast<double>(at[2]);
    ASSERT_NEAR(std::hypot(x, y - 25'000), 25'000, 0.75) << bench.tick;
    const double turned = static_cast<double>(bench.tick - 1) * 100 / length * 3;
    if (turned < 3) {
      ASSERT_NEAR(z, -2000 * turned, 0.5 + 1e-6) << bench.tick;
    }
  }
  EXPECT_NEAR(static_cast<double>(bench.tick - 1) / 1000, length / 100'000, 0.0011);
  EXPECT_EQ(bench.travels(), (Travels{0, 0, -6000, 0}));
}

}  // namespace fit_rsm8194h_interpolation_test
}  // namespace understudy::motion
