// Simple2-R3's moves (manual, appendix A) with only a conversion of units.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "motion/move.h"

namespace understudy::motion {
namespace fit_simple2_test {

/// The registers of a move: pulses, RPM, pulses per revolution, ramps in units of 10 ms.
struct Move {
  double p, v_rpm, ppr, ta_10ms, td_10ms;

  Profile plan() const {
    return motion::plan(p, SpeedLaw{.top_speed_u_s = v_rpm * ppr / 60,
                                    .up = RampLaw::by_time(ta_10ms / 100),
                                    .down = RampLaw::by_time(td_10ms / 100)});
  }
};

struct Golden {
  double t_ms, position;
};

void expect_positions(const Move& move, const std::vector<Golden>& table, double tolerance) {
  const Profile profile = move.plan();
  for (const auto& [t_ms, position] : table) {
    const double here = profile.sample(t_ms / 1000).position_u;
    EXPECT_NEAR(here, position, tolerance) << t_ms << " ms";
    EXPECT_EQ(std::floor(here + pulse_tolerance(move.p)), std::floor(position)) << t_ms << " ms";
  }
}

TEST(FitSimple2, TheManualsExampleIsMetPulseByPulse) {
  const Move example{.p = 32'000, .v_rpm = 200, .ppr = 3200, .ta_10ms = 5, .td_10ms = 5};
  EXPECT_NEAR(example.plan().duration_s, 3.05, 1e-12);
  expect_positions(example,
                   {{1, 0.107},
                    {10, 10.667},
                    {25, 66.667},
                    {50, 266.667},
                    {51, 277.333},
                    {100, 800},
                    {1000, 10'400},
                    {1525, 16'000},
                    {3000, 31'733.33},
                    {3025, 31'933.33},
                    {3049, 31'999.89},
                    {3050, 32'000}},
                   0.006);
}

TEST(FitSimple2, TheThirtySecondMoveIsMetPulseByPulse) {
  expect_positions({.p = 3200, .v_rpm = 3000, .ppr = 3200, .ta_10ms = 1500, .td_10ms = 1500},
                   {{100, 0.071},
                    {1000, 7.111},
                    {7500, 400},
                    {15'000, 1600},
                    {22'500, 2800},
                    {29'000, 3192.889},
                    {30'000, 3200}},
                   0.0006);
}

TEST(FitSimple2, TopSpeedsCruisesAndDurationsAreThoseOfTheManual) {
  struct Row {
    Move move;
    double top_rpm, cruise_s, total_s;
  };
  for (const auto& [move, top_rpm, cruise_s, total_s] :
       std::vector<Row>{{{1600, 200, 3200, 5, 5}, 200, 0.1, 0.2},
                        {{533, 200, 3200, 5, 5}, 199.875, 0, 0.1},
                        {{100, 200, 3200, 5, 5}, 37.5, 0, 0.1},
                        {{3200, 3000, 3200, 1500, 1500}, 4, 0, 30},
                        {{6400, 600, 3200, 20, 50}, 2400.0 / 7, 0, 0.7}}) {
    SCOPED_TRACE(move.p);
    const Profile profile = move.plan();
    EXPECT_NEAR(profile.sample(move.ta_10ms / 100).speed_u_s * 60 / move.ppr, top_rpm, 1e-9);
    EXPECT_NEAR(profile.duration_s - (move.ta_10ms + move.td_10ms) / 100, cruise_s, 1e-12);
    EXPECT_NEAR(profile.duration_s, total_s, 1e-12);
    EXPECT_EQ(profile.end_position_u, move.p);
  }
}

}  // namespace fit_simple2_test
}  // namespace understudy::motion
