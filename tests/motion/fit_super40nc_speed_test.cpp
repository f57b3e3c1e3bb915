// SUPER-40NC's speeds and ramps with only a conversion of units.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/motion/move_checks.h"

namespace understudy::motion {
namespace fit_super40nc_speed_test {

/// The settings of an axis, with the factory values.
struct Settings {
  double ppr = 4000;            // pulses per revolution
  double full_rpm = 5000;       // C22: the speed that the ramp times refer to
  double start_rpm = 1;         // X13
  double acceleration_s = 0.5;  // from 0 to C22
  double deceleration_s = 0.5;
  double section_steps = 1;  // PRUS, in steps of the chip's speed register

  double pps(double rpm) const { return rpm * ppr / 60; }
  double slope(double time_s) const { return pps(full_rpm) / time_s; }

  /// The smallest speed multiplier, 300 / (PRMG + 1), that FH fits at.
  static double multiplier(double fh_pps) {
    return 300 / (std::clamp(std::floor(65'535 * 300 / fh_pps) - 1, 2.0, 4095.0) + 1);
  }

  SpeedLaw law(double fh_pps) const {
    const double section = section_steps * multiplier(fh_pps);
    return {.start_speed_u_s = pps(start_rpm),
            .top_speed_u_s = fh_pps,
            .up = RampLaw::by_sections(slope(acceleration_s), section),
            .down = RampLaw::by_sections(slope(deceleration_s), section),
            // The chip finds the point to decelerate by counting, up to twice the acceleration.
            .slow_down_reckoned_by =
                RampLaw::by_sections(slope(std::min(deceleration_s, 2 * acceleration_s)), section)};
  }
};

TEST(FitSuper40ncSpeed, TheFactorySlopeIsTwoThirdsOfAMillion) {
  EXPECT_NEAR(Settings{}.slope(0.5), 666'667, 0.5);
}

TEST(FitSuper40ncSpeed, TheMultiplierIsTheSmallestThatTheSpeedFitsAt) {
  struct Row {
    double fh_pps, multiplier;
  };
  for (const auto& [fh_pps, multiplier] : std::vector<Row>{{65'535, 1},
                                                           {65'536, 300.0 / 299},
                                                           {65'535.0 * 100, 100},
                                                           {1, 300.0 / 4096},
                                                           {4799, 300.0 / 4096},
                                                           {333'333, 300.0 / 58}}) {
    EXPECT_NEAR(Settings::multiplier(fh_pps), multiplier, 1e-12) << fh_pps;
    EXPECT_LE(fh_pps / Settings::multiplier(fh_pps), 65'535);
  }
}

TEST(FitSuper40ncSpeed, MovesTakeDistanceOverSpeedAndSpeedOverSlope) {
  const Settings factory;
  struct Row {
    const char* what;
    double distance, pps, duration_s;
  };
  for (const Row& row : std::vector<Row>{
           {"DRV 1000 at 100 rpm", 1000, factory.pps(100), 0.160},
           {"DRV 1000 at 200 rpm", 1000, factory.pps(200), 0.095},
           {"DRV 2000 at 200 rpm", 2000, factory.pps(200), 0.170},
           {"DRV 5000 at 100 rpm", 5000, factory.pps(100), 0.760},
           {"DRV 5000 at 500 rpm", 5000, factory.pps(500), 0.200},
           {"DRV 10000 at 200 rpm", 10'000, factory.pps(200), 0.770},
           {"DRV 15000 at 100 rpm", 15'000, factory.pps(100), 2.260},
           {"DRV 45000 at 100 rpm", 45'000, factory.pps(100), 6.760},
           {"LIN 20000, 25000 at 50000 u/s", std::hypot(20'000, 25'000), 50'000, 0.715},
           {"LIN 25000, 25000 at 20000 u/s", std::hypot(25'000, 25'000), 20'000, 1.798},
       }) {
    const Profile profile = plan(row.distance, factory.law(row.pps));
    EXPECT_NEAR(profile.duration_s, row.duration_s, 0.003) << row.what;
    EXPECT_EQ(profile.end_position_u, row.distance);
  }
}

TEST(FitSuper40ncSpeed, FiveHundredRpmAreReachedInFiftyMilliseconds) {
  const Settings factory;
  const double top = factory.pps(500);
  const Profile profile = plan(1e6, factory.law(top));
  EXPECT_NEAR(profile.segments[2].begin_s, 0.05, 0.001);
  EXPECT_NEAR(profile.sample(0.051).speed_u_s, top, 1e-6 * top);
}

TEST(FitSuper40ncSpeed, TwoSectionsLengthenARampUntilItIsAllParabola) {
  const double top = 400'000;  // at a multiplier of 300 / 49
  for (const double steps : {1.0, 100.0, 5000.0, 20'000.0, 32'600.0, 32'700.0, 65'535.0}) {
    Settings settings;
    settings.section_steps = steps;
    const double change = top - settings.pps(1);
    const double section = steps * 300 / 49;
    const double slope = settings.slope(0.5);
    const double ramp_s = 2 * section >= change ? 2 * change / slope : (change + 2 * section) / slope;
    EXPECT_NEAR(ramp(settings.law(top).up, change).duration_s(), ramp_s, 1e-9) << steps;
    const Profile profile = plan(3e6, settings.law(top));
    EXPECT_NEAR(profile.duration_s, 2 * ramp_s + (3e6 - ramp_s * (top + settings.pps(1))) / top, 1e-6)
        << steps;
    EXPECT_NEAR(profile.sample(ramp_s).speed_u_s, top, 1e-3) << steps;
  }
}

TEST(FitSuper40ncSpeed, ADecelerationOverTwiceTheAccelerationIsCutOff) {
  Settings settings;
  settings.section_steps = 0;
  const double top = settings.pps(1000);
  const double start = settings.pps(1);
  for (const auto& [deceleration_s, cut_off] :
       {std::pair{0.2, false}, {0.5, false}, {1.0, false}, {1.001, true}, {2.0, true}, {5.0, true}}) {
    settings.deceleration_s = deceleration_s;
    const Profile profile = plan(100'000, settings.law(top));
    // Over the distance that was planned, the slower ramp only decreases the speed so far.
    const double reckoned = (top * top - start * start) / (2 * settings.slope(std::min(deceleration_s, 1.0)));
    const double end = std::sqrt(top * top - 2 * settings.slope(deceleration_s) * reckoned);
    EXPECT_NEAR(profile.end_speed_u_s, end, 0.05) << deceleration_s;
    EXPECT_EQ(profile.end_speed_u_s > start * 1.01, cut_off) << deceleration_s;
    EXPECT_EQ(profile.end_position_u, 100'000);
    const Fault gap = gap_in(profile, 100'000);
    EXPECT_FALSE(gap) << *gap;
  }
}

}  // namespace fit_super40nc_speed_test
}  // namespace understudy::motion
