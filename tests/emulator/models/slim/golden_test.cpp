// The coordinated commands alone: their durations, their ends, and their positions at every tick.
#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "tests/emulator/models/slim/one_chain.h"

namespace understudy::emulator::models::slim {
namespace golden_test {

constexpr double kTvm = 100;
constexpr double kTva = 1000;
constexpr int kPulses = 1000;  // a user unit

using Place = std::array<double, 4>;

/// The position after `s` on a straight line from the origin.
std::function<Place(double)> straight(const Place& end) {
  return [end](double s) {
    double length = 0;
    for (const double each : end) length += each * each;
    Place place{};
    for (std::size_t i = 0; i < 4; ++i) place[i] = end[i] * s / std::sqrt(length);
    return place;
  };
}
/// On a circle about a centre from the origin, with the third axis in proportion to the length.
std::function<Place(double)> round_about(double x, double y, double degrees, double rise = 0) {
  return [=](double s) {
    const double radius = std::hypot(x, y);
    const double sweep = degrees * std::numbers::pi / 180;
    const double length = std::hypot(radius * sweep, rise);
    const double angle = std::atan2(-y, -x) + sweep * s / length;
    return Place{x + radius * std::cos(angle), y + radius * std::sin(angle), rise * s / length, 0};
  };
}

struct Golden {
  const char* command;
  std::function<Error(Chain&)> issue;
  double length, seconds;
  Place end;
  std::function<Place(double)> at;
};

ArcOrder about(double x, double y, double degrees) {
  return {.centre_x_units = x, .centre_y_units = y, .sweep_deg = degrees};
}

std::vector<Golden> golden() {
  const auto line = [](std::vector<double> units, bool absolute) {
    return [=](Chain& chain) { return chain.line(units, absolute); };
  };
  const auto arc = [](const ArcOrder& order) { return [=](Chain& chain) { return chain.arc(order); }; };
  ArcOrder helix = about(10, 0, 360);
  helix.height_units = 5;
  ArcOrder relative = about(0, 50, 90);
  relative.absolute = false;
  // Lengths by hand: 100 sqrt(1.25) ..., 50 pi/2, 100 sqrt 2 * 2 pi, sqrt(100^2+100^2) ... of |(50,150)|
  // 158.1139 * 4 pi, sqrt((20 pi)^2 + 5^2), sqrt(1+4+9+16).
  return {
      {"2MA 100,50", line({100, 50}, true), 111.8034, 1.2180, {100, 50}, straight({100, 50})},
      {"2MR 3,4", line({3, 4}, false), 5, 0.1414, {3, 4}, straight({3, 4})},
      {"3MA 30,40,120", line({30, 40, 120}, true), 130, 1.4000, {30, 40, 120}, straight({30, 40, 120})},
      {"4MR 1,2,3,4", line({1, 2, 3, 4}, false), 5.4772, 0.1480, {1, 2, 3, 4}, straight({1, 2, 3, 4})},
      {"AA 0,50,90", arc(about(0, 50, 90)), 78.5398, 0.8854, {50, 50}, round_about(0, 50, 90)},
      {"AR 0,50,90", arc(relative), 78.5398, 0.8854, {50, 50}, round_about(0, 50, 90)},
      {"AA 100,100,360", arc(about(100, 100, 360)), 888.5766, 8.9858, {}, round_about(100, 100, 360)},
      {"AA 50,150,-720", arc(about(50, 150, -720)), 1986.9177, 19.9692, {}, round_about(50, 150, -720)},
      {"SAA 10,0,360,5", arc(helix), 63.0305, 0.7303, {0, 0, 5}, round_about(10, 0, 360, 5)},
  };
}

TEST(SlimGolden, MatchesTimeAndEndExactlyAndTicksWithinHalfAPulse) {
  for (const Golden& row : golden()) {
    SCOPED_TRACE(row.command);
    OneChain bench;
    bench.map({0, 1, 2, 3});
    bench.scale_all(kPulses);
    ASSERT_EQ(row.issue(bench.chain), Error::none);
    // At its beginning in the first tick.
    const Trapezoid profile{row.length, kTvm, kTva};
    EXPECT_NEAR(profile.duration_s(), row.seconds, 5.1e-5);
    double worst = 0;
    while (!bench.all_done() && bench.tick < 30'000) {
      bench.step();
      const double s = profile.at(static_cast<double>(bench.tick - 1) / 1000);
      const Place place = row.at(s);
      for (int i = 0; i < 4; ++i) {
        const double expected = place[static_cast<std::size_t>(i)] * kPulses;
        worst = std::max(worst, std::abs(static_cast<double>(bench.travel(i)) - expected));
      }
    }
    EXPECT_EQ(bench.tick - 1, ticks_of(row.seconds == 1.4 ? 1.4 : profile.duration_s()));
    // The table's lengths have four digits: 5e-5 units are 0.05 pulses.
    EXPECT_LE(worst, 0.5 + 0.06);
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(bench.travel(i), std::llround(row.end[static_cast<std::size_t>(i)] * kPulses)) << i;
      EXPECT_EQ(bench.sent[static_cast<std::size_t>(i)], bench.travel(i)) << i;
      EXPECT_DOUBLE_EQ(bench.chain.coordinate(i), row.end[static_cast<std::size_t>(i)]) << i;
    }
  }
}

TEST(SlimGolden, AxesWithUnitsOfTheirOwn) {
  // 2MR 30,40 is 50 units long whatever a unit is; each module gets its own pulses.
  OneChain bench;
  bench.map({2, 5});
  ASSERT_EQ(bench.chain.settings().set_scale(2, 1000, 3), Error::none);
  ASSERT_EQ(bench.chain.settings().set_scale(5, 7, 1), Error::none);
  ASSERT_EQ(bench.line({30, 40}), Error::none);
  EXPECT_EQ(bench.finish() - 1, 600);  // 50/100 + 100/1000
  EXPECT_EQ(bench.travel(2), 10'000);
  EXPECT_EQ(bench.travel(5), 280);
}

TEST(SlimGolden, ASpiralEndsWhereItsRadiusHasGrownTo) {
  // SPI 10,0,720,5 from the origin: radius 10, after two turns 20, at the angle at which it began: 180
  // degrees.
  OneChain bench;
  bench.map({0, 1});
  bench.scale_all(kPulses);
  ASSERT_EQ(bench.chain.spiral(10, 0, 720, 5), Error::none);
  double min = 1e9;
  double max = 0;
  while (!bench.all_done()) {
    bench.step();
    const double r = std::hypot(bench.chain.coordinate(0) - 10, bench.chain.coordinate(1));
    min = std::min(min, r);
    max = std::max(max, r);
  }
  EXPECT_EQ(bench.travel(0), -10'000);
  EXPECT_EQ(bench.travel(1), 0);
  EXPECT_NEAR(min, 10, 1e-3);
  EXPECT_NEAR(max, 20, 1e-3);
  // Length by sqrt(r^2 + (dr/dphi)^2), Simpson's rule over the angle.
  double length = 0;
  constexpr int kParts = 1000;
  const double slope = 5 / (2 * std::numbers::pi);
  for (int i = 0; i <= kParts; ++i) {
    const double r = 10 + 10.0 * i / kParts;
    const int weight = i == 0 || i == kParts ? 1 : i % 2 == 1 ? 4 : 2;
    length += weight * std::hypot(r, slope) * 4 * std::numbers::pi / kParts / 3;
  }
  EXPECT_EQ(bench.tick - 1, ticks_of(Trapezoid{length, kTvm, kTva}.duration_s()));
}

TEST(SlimGolden, RelativeTargetsInTheQueueAreNotRoundedTwice) {
  OneChain bench;  // a unit is a pulse
  bench.map({0, 1});
  for (int i = 0; i < 30; ++i) ASSERT_EQ(bench.line({0.4, -0.25}), Error::none);
  bench.finish();
  EXPECT_EQ(bench.travel(0), 12);
  EXPECT_EQ(bench.travel(1), -8);  // -7.5, half away from zero
}

TEST(SlimGolden, APathOfNoLengthIsDoneAtOnce) {
  OneChain bench;
  bench.map({0, 1, 2});
  ASSERT_EQ(bench.line({0, 0}), Error::none);
  EXPECT_TRUE(bench.all_done());
  EXPECT_EQ(bench.chain.arc(about(10, 0, 0)), Error::none);
  EXPECT_TRUE(bench.all_done());
  ArcOrder only_rise = about(10, 0, 0);
  only_rise.height_units = 50;
  EXPECT_EQ(bench.chain.arc(only_rise), Error::none);
  EXPECT_EQ(bench.finish() - 1, 600);
  EXPECT_EQ(bench.travel(2), 50);
}

TEST(SlimGolden, AnArcAboutWhereItStandsIsItsRiseAlone) {
  OneChain bench;
  bench.map({0, 1, 2});
  EXPECT_EQ(bench.chain.arc(about(0, 0, 90)), Error::none);  // ends at once
  EXPECT_TRUE(bench.all_done());
  ArcOrder rising = about(0, 0, 90);
  rising.height_units = 50;
  EXPECT_EQ(bench.chain.arc(rising), Error::none);
  EXPECT_EQ(bench.finish() - 1, 600);
  EXPECT_EQ(bench.travel(0), 0);
  EXPECT_EQ(bench.travel(2), 50);
  ChainOptions options;
  options.choose(option("path_without_length", "error_2"));
  bench.chain.set_options(options);
  EXPECT_EQ(bench.chain.arc(about(0, 0, 90)), Error::range);
}

TEST(SlimGolden, WhatCannotBeIsRefusedAndChangesNothing) {
  OneChain bench;
  bench.map({0, 1});
  const OneChain before = bench;
  EXPECT_EQ(bench.chain.arc(about(1e300, 0, 90)), Error::range);
  EXPECT_EQ(bench.chain.arc(about(10, 0, std::nan(""))), Error::range);
  EXPECT_EQ(bench.chain.spiral(10, 0, 3600, -5), Error::range);  // a radius below 0
  EXPECT_EQ(bench.line({1e13, 0}), Error::range);
  EXPECT_EQ(bench.line({1, 2, 3}), Error::axis);
  bench.chain.settings().set_linked(1, false);
  EXPECT_EQ(bench.line({1, 2}), Error::not_linked);
  bench.chain.settings().set_linked(1, true);
  EXPECT_EQ(bench.chain, before.chain);
  EXPECT_EQ(bench.chain.settings().set_path_speed(1, 200), Error::none);
  EXPECT_EQ(bench.line({1, 2}), Error::unequal_speeds);
  EXPECT_EQ(bench.chain.settings().set_path_speed(1, 100), Error::none);
  EXPECT_EQ(bench.chain.settings().set_path_acceleration(1, 2000), Error::none);
  EXPECT_EQ(bench.line({1, 2}), Error::unequal_speeds);
  EXPECT_TRUE(bench.all_done());
}

}  // namespace golden_test
}  // namespace understudy::emulator::models::slim
