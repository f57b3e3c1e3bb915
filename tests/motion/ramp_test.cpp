#include "motion/ramp.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "motion/bad_motion.h"
#include "tests/motion/move_checks.h"

namespace understudy::motion {
namespace ramp_test {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Ramp, HasTheShapeOfItsLaw) {
  struct Row {
    const char* what;
    RampLaw law;
    double dv, ends_s, middle_s, acceleration, jerk;
  };
  for (const Row& row : std::vector<Row>{
           {"slope", RampLaw::by_slope(50), 100, 0, 2, 50, 0},
           {"time", RampLaw::by_time(4), 100, 0, 4, 25, 0},
           {"time, small change", RampLaw::by_time(4), 1, 0, 4, 0.25, 0},
           {"jerk", RampLaw::by_jerk(100), 100, 1, 0, 100, 100},
           {"jerk with a bound", RampLaw::by_jerk(100, 50), 100, 0.5, 1.5, 50, 100},
           {"jerk, bound just reached", RampLaw::by_jerk(100, 50), 25, 0.5, 0, 50, 100},
           {"jerk, bound not reached", RampLaw::by_jerk(100, 50), 4, 0.2, 0, 20, 100},
           {"sections", RampLaw::by_sections(100, 10), 100, 0.2, 0.8, 100, 500},
           {"sections, full S", RampLaw::by_sections(100, 50), 100, 1, 0, 100, 100},
           {"sections larger than that", RampLaw::by_sections(100, 500), 100, 1, 0, 100, 100},
           {"sections of nothing", RampLaw::by_sections(50, 0), 100, 0, 2, 50, 0},
       }) {
    SCOPED_TRACE(row.what);
    const Ramp shape = ramp(row.law, row.dv);
    EXPECT_NEAR(shape.ends_s, row.ends_s, 1e-12);
    EXPECT_NEAR(shape.middle_s, row.middle_s, 1e-12);
    EXPECT_NEAR(shape.acceleration_u_s2, row.acceleration, 1e-12);
    EXPECT_NEAR(shape.jerk_u_s3, row.jerk, 1e-9);
    EXPECT_NEAR(ramp_distance(row.law, 30, 30 + row.dv), (30 + row.dv / 2) * shape.duration_s(), 1e-9);
    EXPECT_NEAR(ramp_distance(row.law, 30 + row.dv, 30), (30 + row.dv / 2) * shape.duration_s(), 1e-9);
    const RampTime time = time_law(row.law, row.dv);
    EXPECT_NEAR(time.per_speed * row.dv + time.constant + time.per_root * std::sqrt(row.dv),
                shape.duration_s(), 1e-12);
  }
}

TEST(Ramp, NoChangeOfSpeedTakesNoTimeWhateverTheLaw) {
  for (const RampLaw& law : {RampLaw::by_slope(50), RampLaw::by_time(4), RampLaw::by_jerk(100),
                             RampLaw::by_jerk(100, 50), RampLaw::by_sections(100, 10)}) {
    EXPECT_EQ(ramp(law, 0).duration_s(), 0);
    EXPECT_EQ(ramp_distance(law, 70, 70), 0);
    Profile profile;
    append_ramp(profile, law, 70, 70);
    EXPECT_EQ(profile, Profile{});
  }
}

TEST(Ramp, WhereALawChangesItsFormBothFormsAgree) {
  for (const RampLaw& law : {RampLaw::by_jerk(100, 50), RampLaw::by_jerk(7, 3), RampLaw::by_sections(100, 10),
                             RampLaw::by_sections(3, 0.7)}) {
    const double change = form_changes_at(law);
    const double below_s = ramp(law, change).duration_s();
    const double above_s = ramp(law, change * (1 + 1e-14)).duration_s();
    EXPECT_NEAR(below_s, above_s, 1e-12 * below_s);
  }
  EXPECT_EQ(form_changes_at(RampLaw::by_slope(5)), kInfinite);
  EXPECT_EQ(form_changes_at(RampLaw::by_time(5)), kInfinite);
  EXPECT_EQ(form_changes_at(RampLaw::by_jerk(5)), kInfinite);
}

TEST(Ramp, IsAppendedUpAndDown) {
  for (const RampLaw& law : {RampLaw::by_slope(50), RampLaw::by_time(4), RampLaw::by_jerk(100),
                             RampLaw::by_jerk(100, 50), RampLaw::by_sections(100, 10)}) {
    for (const auto& [from, to] : {std::pair{20.0, 120.0}, {120.0, 20.0}, {0.0, 7.0}, {7.0, 0.0}}) {
      Profile profile = Profile::from(5);
      append_ramp(profile, law, from, to);
      EXPECT_EQ(profile.segments[0].speed_u_s, from);
      EXPECT_EQ(profile.end_speed_u_s, to);
      EXPECT_NEAR(profile.end_position_u, 5 + ramp_distance(law, from, to), 1e-10);
      EXPECT_NEAR(profile.duration_s, ramp(law, std::abs(to - from)).duration_s(), 1e-12);
      const Fault gap = gap_in(profile, 100);
      EXPECT_FALSE(gap) << *gap;
      const Fault differs = differs_from_integral(profile, profile.end_position_u, 100);
      EXPECT_FALSE(differs) << *differs;
    }
  }
}

// ---- Changes with an acceleration at their beginning

struct Change {
  const char* what;
  RampLaw law;
  double from, acceleration, to;
  double duration_s, distance, extreme;  // extreme: the speed furthest in the direction of the acceleration
};

void expect_changes(const std::vector<Change>& rows, const SpeedRange& range) {
  for (const Change& row : rows) {
    SCOPED_TRACE(row.what);
    Profile profile;
    append_change(profile, {.speed_u_s = row.from, .acceleration_u_s2 = row.acceleration}, row.to, row.law,
                  row.law, range);
    EXPECT_NEAR(profile.duration_s, row.duration_s, 1e-9);
    EXPECT_NEAR(profile.end_position_u, row.distance, 1e-9);
    if (profile.segment_count > 0) {
      EXPECT_NEAR(profile.end_speed_u_s, row.to, 1e-12);
    }
    const Fault gap = gap_in(profile, std::max(1.0, row.distance));
    EXPECT_FALSE(gap) << *gap;
    double extreme = row.acceleration > 0 ? std::max(row.from, row.to) : std::min(row.from, row.to);
    for (std::int32_t i = 0; i < profile.segment_count; ++i) {
      const double speed = profile.segments[static_cast<std::size_t>(i)].speed_u_s;
      extreme = row.acceleration > 0 ? std::max(extreme, speed) : std::min(extreme, speed);
    }
    EXPECT_NEAR(extreme, row.extreme, 1e-9);
  }
}

TEST(RampChange, LawsWithoutJerkDropTheirAccelerationAtOnce) {
  expect_changes(
      {
          {"on", RampLaw::by_slope(50), 20, 50, 120, 2, 140, 120},
          {"back", RampLaw::by_slope(50), 120, 50, 20, 2, 140, 120},
          {"stays", RampLaw::by_slope(50), 70, 50, 70, 0, 0, 70},
          {"by time", RampLaw::by_time(4), 20, 50, 120, 4, 280, 120},
          {"sections of nothing", RampLaw::by_sections(50, 0), 20, -50, 120, 2, 140, 20},
      },
      {.min_u_s = 0, .max_u_s = 200});
}

TEST(RampChange, AJerkLawContinuesWithTheAccelerationItHas) {
  // The ramp from 0 to 100 by jerk 100 is half way, at 50 and with 100 u/s^2, after a second.
  const RampLaw law = RampLaw::by_jerk(100);
  expect_changes(
      {
          {"to where it was going", law, 50, 100, 100, 1, 100 - 50.0 / 3, 100},
          {"to the speed where it fades at once", law, 0.5, 10, 1, 0.1, 0.05 + 0.05 - 0.1 / 6, 1},
          // Fades up to 100 within a second (83.333 u), then down to 50 within 2 sqrt(0.5) s.
          {"past its new speed and back", law, 50, 100, 50, 1 + std::sqrt(2.0),
           100 - 50.0 / 3 + 75 * std::sqrt(2.0), 100},
      },
      {.min_u_s = 0, .max_u_s = 200});
}

TEST(RampChange, ABoundThatWasLoweredIsGoneBackToFirst) {
  // Above 50 u/s: from 100 u/s^2 to 50 in half a second (37.5 u/s), 50 u/s at 50 in a second, out in half
  // (12.5). Parabolas before and after the straight.
  const double before_u = 0.5 * 100 * 0.25 - 100 * 0.125 / 6;
  const double after_u = 87.5 * 0.5 + 25 * 0.25 - 100 * 0.125 / 6;
  expect_changes({{"up", RampLaw::by_jerk(100, 50), 50, 100, 150, 2, 100 + before_u + 62.5 + after_u, 150}},
                 {.min_u_s = 0, .max_u_s = 200});
}

TEST(RampChange, MoreAccelerationThanTheLawCanHaveDropsAtOnce) {
  // At 2 u/s, jerk 100 can have 20 u/s^2, which fades in 0.2 s, at 4 u/s; from there down to 3 takes 0.2 s,
  // too.
  const RampLaw law = RampLaw::by_jerk(100);
  expect_changes({{"up", law, 2, 1e9, 3, 0.4, 0.4 + 20 * 0.02 - 100 * 0.008 / 6 + 0.7, 4}},
                 {.min_u_s = 0, .max_u_s = 200});
}

TEST(RampChange, SlowingDownNeverPassesTheLeastSpeed) {
  // Jerk 1 would take 100 s and 5000 u/s to fade 100 u/s^2: with 50 u/s left, jerk 100 is needed.
  expect_changes(
      {
          {"to the least", RampLaw::by_jerk(1), 70, -100, 20, 1, 20 + 100.0 / 6, 20},
          {"and up again", RampLaw::by_jerk(1), 70, -100, 21, 1 + 2, 20 + 100.0 / 6 + 41, 20},
          {"at the least already", RampLaw::by_jerk(1), 20, -100, 21, 2, 41, 20},
          {"by sections", RampLaw::by_sections(100, 5000), 70, -100, 20, 1, 20 + 100.0 / 6, 20},
      },
      {.min_u_s = 20, .max_u_s = 200});
}

TEST(RampChange, ASectionLawGoingUpNeverPassesTheGreatestSpeed) {
  // Sections of 50 at 100 u/s^2 have jerk 100; from 80 with 100 u/s^2 there are 20 u/s left: jerk 250.
  expect_changes({{"to the greatest", RampLaw::by_sections(100, 50), 80, 100, 100, 0.4,
                   100 * 0.4 - 250 * 0.064 / 6, 100}},
                 {.min_u_s = 0, .max_u_s = 100});
}

TEST(RampChange, TheSpeedWithoutAccelerationIsWhereItFadesAtOnce) {
  const SpeedRange range{.min_u_s = 20, .max_u_s = 100};
  const RampLaw jerk = RampLaw::by_jerk(100);
  const RampLaw soft = RampLaw::by_jerk(1);
  const RampLaw slope = RampLaw::by_slope(100);
  const RampLaw sections = RampLaw::by_sections(100, 50);  // jerk 100
  EXPECT_DOUBLE_EQ(
      speed_without_acceleration({.speed_u_s = 70, .acceleration_u_s2 = 100}, jerk, slope, range), 120)
      << "exceeds the maximum";
  EXPECT_DOUBLE_EQ(
      speed_without_acceleration({.speed_u_s = 70, .acceleration_u_s2 = -60}, slope, jerk, range), 52);
  EXPECT_DOUBLE_EQ(
      speed_without_acceleration({.speed_u_s = 70, .acceleration_u_s2 = -100}, jerk, soft, range), 20)
      << "but not the minimum";
  EXPECT_DOUBLE_EQ(
      speed_without_acceleration({.speed_u_s = 70, .acceleration_u_s2 = 100}, slope, jerk, range), 70);
  EXPECT_DOUBLE_EQ(speed_without_acceleration({.speed_u_s = 70, .acceleration_u_s2 = 0}, jerk, jerk, range),
                   70);
  EXPECT_DOUBLE_EQ(
      speed_without_acceleration({.speed_u_s = 70, .acceleration_u_s2 = 60}, sections, slope, range), 88);
  EXPECT_DOUBLE_EQ(
      speed_without_acceleration({.speed_u_s = 70, .acceleration_u_s2 = 100}, sections, slope, range), 100);
  EXPECT_DOUBLE_EQ(
      speed_without_acceleration({.speed_u_s = 100, .acceleration_u_s2 = 100}, sections, slope, range), 100);
}

// ---- Refusals

TEST(Ramp, WhatIsOutsideALawsDomainIsRefusedByName) {
  struct Row {
    std::function<void(double)> make;
    std::string message;
    bool zero_allowed;
  };
  const std::vector<Row> rows = {
      {[](double x) { RampLaw::by_slope(x); }, "ramp: acceleration must be ", false},
      {[](double x) { RampLaw::by_time(x); }, "ramp: duration must be ", false},
      {[](double x) { RampLaw::by_jerk(x); }, "jerk ramp: jerk must be ", false},
      {[](double x) { RampLaw::by_jerk(x, 5); }, "jerk ramp: jerk must be ", false},
      {[](double x) { RampLaw::by_jerk(5, x); }, "jerk ramp: acceleration limit must be ", false},
      {[](double x) { RampLaw::by_sections(x, 5); }, "ramp with sections: acceleration must be ", false},
      {[](double x) { RampLaw::by_sections(5, x); }, "ramp with sections: section must be ", true},
  };
  struct Bad {
    double value;
    Refusal refusal;
    std::string ending;
  };
  for (const Row& row : rows) {
    for (const Bad& bad : std::vector<Bad>{{kNan, Refusal::not_finite, "a finite number; it is nan"},
                                           {kInfinite, Refusal::not_finite, "a finite number; it is inf"},
                                           {-kInfinite, Refusal::not_finite, "a finite number; it is -inf"},
                                           {-1.5, Refusal::not_positive, "above 0; it is -1.5"},
                                           {0, Refusal::not_positive, "above 0; it is 0"},
                                           {-1e-320, Refusal::not_positive, "above 0; it is -1e-320"}}) {
      if (row.zero_allowed && bad.value == 0) {
        EXPECT_NO_THROW(row.make(0));
        continue;
      }
      try {
        row.make(bad.value);
        ADD_FAILURE() << row.message << bad.value << " was accepted";
      } catch (const BadMotion& error) {
        const bool below = row.zero_allowed && bad.refusal == Refusal::not_positive;
        EXPECT_EQ(error.refusal(), below ? Refusal::negative : bad.refusal) << error.what();
        EXPECT_EQ(std::string(error.what()).find(row.message), 0U) << error.what();
        if (!below) {
          EXPECT_EQ(error.what(), row.message + bad.ending);
        }
      }
    }
    EXPECT_NO_THROW(row.make(1e-300));
    EXPECT_NO_THROW(row.make(1e300));
  }
  EXPECT_THROW(check(RampLaw{}), BadMotion) << "an invalid law";
}

}  // namespace ramp_test
}  // namespace understudy::motion
