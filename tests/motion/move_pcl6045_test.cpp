// The PCL6045's registers and its formulas of times, distances and FH correction, compared with the section
// law.
#include <gtest/gtest.h>

#include <vector>

#include "tests/motion/move_checks.h"

namespace understudy::motion {
namespace move_pcl6045_test {

constexpr double kClock = 19'660'800;

/// PRFL, PRFH, PRUR, PRDR, PRMG, PRUS (0: no sections; half the change and more: full S), PRMV.
struct Registers {
  double fl, fh, ur, dr, mg, us, mv;

  double multiplier() const { return kClock / ((mg + 1) * 65536); }  // pps for each step of PRFH
  RampLaw ramp(double rate) const {
    return RampLaw::by_sections(multiplier() * kClock / (4 * (rate + 1)), us * multiplier());
  }
  SpeedLaw law() const {
    return {.start_speed_u_s = fl * multiplier(),
            .top_speed_u_s = fh * multiplier(),
            .up = ramp(ur),
            .down = ramp(dr)};
  }
  Profile plan() const { return motion::plan(mv, law()); }
};

constexpr double kFullS = 65535;

TEST(MovePcl6045, TheMultiplierIsOneAtTheFactorySetting) {
  EXPECT_EQ((Registers{.fl = 0, .fh = 0, .ur = 0, .dr = 0, .mg = 299, .us = 0, .mv = 0}.multiplier()), 1);
  EXPECT_EQ((Registers{.fl = 0, .fh = 0, .ur = 0, .dr = 0, .mg = 2, .us = 0, .mv = 0}.multiplier()), 100);
}

TEST(MovePcl6045, AccelerationTimesFollowItsThreeFormulas) {
  struct Row {
    double us, fl, fh, rate, time_s;
  };
  for (const Row& row : std::vector<Row>{
           // (FH - FL) (UR + 1) 4 / f, 8 / f, and (FH - FL + 2 US) (UR + 1) 4 / f
           {0, 200, 2000, 1364, 1800 * 1365.0 * 4 / kClock},
           {kFullS, 200, 2000, 1364, 1800 * 1365.0 * 8 / kClock},
           {300, 200, 2000, 1364, 2400 * 1365.0 * 4 / kClock},
           {900, 200, 2000, 1364, 3600 * 1365.0 * 4 / kClock},  // US = dv / 2: both agree
           {100, 1, 65535, 1, 65734 * 2.0 * 4 / kClock},
       }) {
    const Registers chip{
        .fl = row.fl, .fh = row.fh, .ur = row.rate, .dr = row.rate, .mg = 299, .us = row.us, .mv = 0};
    EXPECT_NEAR(ramp(chip.law().up, row.fh - row.fl).duration_s(), row.time_s, 1e-12) << row.us;
  }
  const Registers sample{.fl = 200, .fh = 2000, .ur = 1364, .dr = 1364, .mg = 299, .us = 0, .mv = 0};
  EXPECT_NEAR(ramp(sample.law().up, 1800).duration_s(), 0.49988, 5e-6);
}

TEST(MovePcl6045, RampDistancesFollowItsRampDownPointFormulas) {
  for (const double us : {0.0, 100.0, 300.0, 899.0, 900.0, kFullS}) {
    for (const double mg : {299.0, 2.0, 4095.0}) {
      const Registers chip{.fl = 200, .fh = 2000, .ur = 1364, .dr = 700, .mg = mg, .us = us, .mv = 0};
      const double unit = (mg + 1) * 32768;
      const double dv = chip.fh - chip.fl;
      const double pulses = us >= dv / 2 ? (chip.fh * chip.fh - chip.fl * chip.fl) * (chip.dr + 1) * 2 / unit
                                         : (chip.fh + chip.fl) * (dv + 2 * us) * (chip.dr + 1) / unit;
      const SpeedLaw law = chip.law();
      EXPECT_NEAR(ramp_distance(law.down, law.top_speed_u_s, law.start_speed_u_s), pulses, 1e-9 * pulses)
          << us << " " << mg;
    }
  }
}

struct Corrected {
  double us, mv, fh;
};

TEST(MovePcl6045, ShortMovesHaveTheSpeedOfItsFhCorrection) {
  const double fl = 200;
  const double rates = 1364 + 1364 + 2;
  const double unit = 300 * 32768;
  const auto k = [&](double mv) { return unit * mv / rates; };
  std::vector<Corrected> rows = {{0, 400, 1216.697}, {300, 400, 904.305}};  // chips' example, printed
  for (const double mv : {1.0, 2.0, 50.0, 300.0, 400.0}) {
    rows.push_back({0, mv, std::sqrt(k(mv) + fl * fl)});
    rows.push_back({kFullS, mv, std::sqrt(k(mv) / 2 + fl * fl)});
  }
  // With sections: if the move is longer than that; below it there is no straight part.
  const double us = 300;
  const double min = (us + fl) * us * rates * 8 / unit;
  EXPECT_NEAR(min, 333.25, 0.01);
  for (const double mv : {min * (1 + 1e-9), 334.0, 350.0, 400.0, 600.0}) {
    rows.push_back({us, mv, -us + std::sqrt((us - fl) * (us - fl) + k(mv))});
  }
  for (const double mv : {min, 333.0, 100.0, 1.0}) rows.push_back({us, mv, std::sqrt(k(mv) / 2 + fl * fl)});
  for (const auto& [sections, mv, fh] : rows) {
    const Registers chip{.fl = fl, .fh = 2000, .ur = 1364, .dr = 1364, .mg = 299, .us = sections, .mv = mv};
    const Profile profile = chip.plan();
    EXPECT_NEAR(static_cast<double>(greatest_speed(profile)), fh, 1e-3) << sections << " " << mv;
    EXPECT_EQ(profile.end_position_u, mv);
    for (const Fault& fault : {gap_in(profile, mv), beyond_limits(profile, chip.law(), true),
                               differs_from_integral(profile, mv, mv)}) {
      EXPECT_FALSE(fault) << *fault;
    }
  }
}

TEST(MovePcl6045, WithoutFhCorrectionTheRampIsBrokenOff) {
  const Registers chip{.fl = 200, .fh = 2000, .ur = 1364, .dr = 1364, .mg = 299, .us = kFullS, .mv = 400};
  SpeedLaw law = chip.law();
  law.when_short = Short::cut_ramp;
  const Profile cut = plan(400, law);
  const Profile corrected = chip.plan();
  // The whole ramp to 2000 is softer at its beginning than one to 872: slower at first, and longer.
  EXPECT_GT(cut.duration_s, corrected.duration_s);
  EXPECT_EQ(cut.end_position_u, 400);
  EXPECT_NEAR(static_cast<double>(greatest_speed(corrected)), 871.8806, 1e-3);
}

}  // namespace move_pcl6045_test
}  // namespace understudy::motion
