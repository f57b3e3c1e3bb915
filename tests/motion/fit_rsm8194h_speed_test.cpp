// RS-M8194H's speeds and ramps, and the MCX314 registers beneath them, with only a conversion of units.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/motion/move_checks.h"

namespace understudy::motion {
namespace fit_rsm8194h_speed_test {

/// The four speed modes that the controller has.
enum class Mode { t_symmetric = 0, s_symmetric = 1, t_asymmetric = 2, s_asymmetric = 3 };

/// An axis as its commands set it, in pps, pps/s, pps/s^2.
struct Settings {
  double max_v = 200'000;
  double v = 0, sv = 0, a = 0, d = 0, k = 0, l = 0;
  double ao = 8;
  Mode mode = Mode::t_symmetric;

  double unit() const { return max_v / 8000; }
  /// The chip's registers hold whole units: truncated, but never to zero.
  double quantised(double pps) const { return std::max(1.0, std::floor(pps / unit())) * unit(); }

  SpeedLaw law() const {
    SpeedLaw law{.start_speed_u_s = quantised(sv), .top_speed_u_s = quantised(v)};
    law.when_short = Short::keep_half;  // AVTRI
    law.slow_down_offset_u = ao;
    switch (mode) {
      case Mode::t_symmetric: law.up = law.down = RampLaw::by_slope(a); break;
      case Mode::t_asymmetric:
        law.up = RampLaw::by_slope(a);
        law.down = RampLaw::by_slope(d);
        break;
      case Mode::s_symmetric: law.up = law.down = RampLaw::by_jerk(k); break;
      case Mode::s_asymmetric:
        law.up = RampLaw::by_jerk(k);
        law.down = RampLaw::by_jerk(l);
        break;
    }
    return law;
  }
};

TEST(FitRsm8194hSpeed, TheChipsRegistersStandForTheUnitsOfItsManual) {
  const double m = 8'000'000 / 800'000.0;
  EXPECT_EQ(m, 10);
  EXPECT_NEAR(62.5e6 / 1010 * m / 1000, 619, 0.5);  // kpps/s^2 per second
  EXPECT_EQ(125 * 100 * m, 125'000);
  const Settings settings{.max_v = 8000 * m};
  EXPECT_EQ(settings.unit(), m);
  EXPECT_EQ(settings.quantised(100 * m), 1000);
  EXPECT_EQ(settings.quantised(4000 * m), 40'000);
}

TEST(FitRsm8194hSpeed, SpeedsAreWholeUnitsOfAnEightThousandth) {
  struct Row {
    double max_v, pps, quantised;
  };
  for (const auto& [max_v, pps, quantised] : std::vector<Row>{{200'000, 200'000, 200'000},
                                                              {200'000, 1000, 1000},
                                                              {200'000, 1024, 1000},
                                                              {200'000, 1025, 1025},
                                                              {200'000, 24, 25},
                                                              {200'000, 0, 25},
                                                              {8000, 123.9, 123},
                                                              {4'000'000, 1499, 1000}}) {
    Settings settings;
    settings.max_v = max_v;
    EXPECT_DOUBLE_EQ(settings.quantised(pps), quantised) << pps << " of " << max_v;
  }
}

Settings common(Mode mode) {
  return {.max_v = 80'000,
          .v = 40'000,
          .sv = 1000,
          .a = 125'000,
          .d = 250'000,
          .k = 618'811.88,
          .l = 1e6,
          .ao = 8,
          .mode = mode};
}

struct Phases {
  double up_s, up_u, down_s, down_u;
};

Phases expected_phases(const Settings& s) {
  const double v = s.quantised(s.v);
  const double sv = s.quantised(s.sv);
  const auto by_slope = [&](double slope) { return (v * v - sv * sv) / (2 * slope); };
  const auto by_jerk = [&](double jerk) { return (v + sv) * std::sqrt((v - sv) / jerk); };
  const auto slope_s = [&](double slope) { return (v - sv) / slope; };
  const auto jerk_s = [&](double jerk) { return 2 * std::sqrt((v - sv) / jerk); };
  switch (s.mode) {
    case Mode::t_symmetric: return {slope_s(s.a), by_slope(s.a), slope_s(s.a), by_slope(s.a)};
    case Mode::t_asymmetric: return {slope_s(s.a), by_slope(s.a), slope_s(s.d), by_slope(s.d)};
    case Mode::s_symmetric: return {jerk_s(s.k), by_jerk(s.k), jerk_s(s.k), by_jerk(s.k)};
    case Mode::s_asymmetric: return {jerk_s(s.k), by_jerk(s.k), jerk_s(s.l), by_jerk(s.l)};
  }
  return {};
}

TEST(FitRsm8194hSpeed, RampsTakeThePulsesOfTheirFormulas) {
  EXPECT_NEAR(expected_phases(common(Mode::t_symmetric)).up_u, 6396, 1e-9);
  EXPECT_NEAR(expected_phases(common(Mode::s_symmetric)).up_u, 10'292.9, 0.1);
  for (const Mode mode : {Mode::t_symmetric, Mode::s_symmetric, Mode::t_asymmetric, Mode::s_asymmetric}) {
    for (const double max_v : {80'000.0, 200'000.0, 4'000'000.0}) {
      Settings settings = common(mode);
      settings.max_v = max_v;
      const double v = settings.quantised(settings.v);
      const double sv = settings.quantised(settings.sv);
      const Phases phases = expected_phases(settings);
      for (const double distance : {41'200.0, 100'000.0, 1e9}) {
        const Profile profile = plan(distance, settings.law());
        SCOPED_TRACE(testing::Message() << static_cast<int>(mode) << " " << max_v << " " << distance);
        EXPECT_NEAR(profile.sample(phases.up_s).position_u, phases.up_u, 1e-6);
        EXPECT_NEAR(profile.sample(phases.up_s).speed_u_s, v, 1e-6);
        const double cruise_s = (distance - phases.up_u - phases.down_u - settings.ao) / v;
        const double slowed_s = phases.up_s + cruise_s + phases.down_s;
        EXPECT_NEAR(profile.sample(slowed_s).position_u, distance - 8, 1e-9 * distance + 1e-5);
        EXPECT_NEAR(profile.duration_s, slowed_s + 8 / sv, 1e-9 * slowed_s) << "8 pulses are crept";
        EXPECT_EQ(profile.end_position_u, distance);
        EXPECT_EQ(profile.end_speed_u_s, sv);
      }
    }
  }
}

TEST(FitRsm8194hSpeed, AShortMoveKeepsHalfOfItForConstantSpeed) {
  for (const Mode mode : {Mode::t_symmetric, Mode::s_symmetric, Mode::t_asymmetric, Mode::s_asymmetric}) {
    for (const double distance : {20.0, 100.0, 4000.0, 10'000.0}) {
      const Settings settings = common(mode);
      const Profile profile = plan(distance, settings.law());
      SCOPED_TRACE(testing::Message() << static_cast<int>(mode) << " " << distance);
      double ramps_u = 0;
      for (std::int32_t i = 0; i < profile.segment_count; ++i) {
        const Segment& s = profile.segments[static_cast<std::size_t>(i)];
        if (sense_of(s) == 0) continue;
        const auto duration_s = static_cast<double>(segment_end_s(profile, i)) - s.begin_s;
        ramps_u += sample_segment(s, duration_s).position_u - s.position_u;
      }
      EXPECT_NEAR(ramps_u, (distance - 8) / 2, 1e-6 * distance);
      EXPECT_LT(greatest_speed(profile), 40'000);
      EXPECT_EQ(profile.end_position_u, distance);
    }
  }
}

TEST(FitRsm8194hSpeed, AMoveOfNoMoreThanItsOffsetIsCreptAtTheStartSpeed) {
  for (const double distance : {1.0, 2.0, 7.0, 8.0}) {
    const Profile profile = plan(distance, common(Mode::s_asymmetric).law());
    EXPECT_NEAR(profile.duration_s, distance / 1000, 1e-12);
    EXPECT_EQ(profile.segment_count, 1);
  }
}

}  // namespace fit_rsm8194h_speed_test
}  // namespace understudy::motion
