// A path that decelerates for one of its axes, waits for in-position, and does not jump.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "motion/bad_motion.h"
#include "motion/coordinated.h"

namespace understudy::motion {
namespace coordinated_slow_test {

struct Group {
  std::vector<Axis> axes{2};
  std::vector<Environment> environment{2};
  std::vector<std::int64_t> pulses = {0, 0};
  Coordinated group;
  Tick now = 0;

  explicit Group(const AxisSettings& settings) {
    for (Axis& axis : axes) {
      axis.set(settings);
      axis.servo_on = true;
    }
    group.axis_of = {0, 1, Coordinated::kNone, Coordinated::kNone};
    // 100,000 per second, a = 1e6: a stop takes 100 ms and 5000 units.
    group.run.set_speed({.top_speed_u_s = 1e5, .up = RampLaw::by_slope(1e6), .down = RampLaw::by_slope(1e6)},
                        0);
    group.run.append(line(Point::Zero(), Point(30000, 40000, 0, 0)), {}, 0);
  }
  void step() {
    ++now;
    group.step(now, axes, environment, pulses);
  }
  void to_the_end() {
    for (int i = 0; i < 5000 && group.engaged; ++i) step();
    ASSERT_FALSE(group.engaged);
  }
};

TEST(CoordinatedSlow, ALimitThatSlowsDownSlowsThePathAndKeepsItsShape) {
  AxisSettings settings;
  settings.at_limit_plus = Reaction::slow_down;
  Group group(settings);
  group.environment[0].add(Signal::limit_plus, 12'000, 90'000);  // X: the path is at 20,000
  ASSERT_EQ(group.group.begin(Point::Zero(), group.axes, group.now), Cause::none);
  while (group.group.engaged && group.now < 2000) {
    group.step();
    const std::int64_t x = group.axes[0].travel_pulses;
    EXPECT_LE(std::abs(4 * x - 3 * group.axes[1].travel_pulses), 4) << "on the line, half a pulse each";
  }
  EXPECT_EQ(group.group.cause, Cause::limit_plus);
  EXPECT_EQ(group.axes[0].cause, Cause::limit_plus);
  // 5000 units further along the path, so 3000 of X, from the pulse of the edge.
  EXPECT_NEAR(static_cast<double>(group.axes[0].travel_pulses), 15'000, 1);
  EXPECT_EQ(group.group.run.queued(), 0U);
}

/// A circle whose top only just reaches the limit: between two ticks, whatever the speed.
TEST(CoordinatedSlow, WhatLiesAtTheTurnOfAnArcIsMetWithinATick) {
  for (const Reaction reaction : {Reaction::stop_at_once, Reaction::slow_down}) {
    for (double speed_u_s = 80e3; speed_u_s < 120e3; speed_u_s += 3777) {
      AxisSettings settings;
      settings.at_limit_plus = reaction;
      Group group(settings);
      group.group.run = {};
      group.group.run.set_speed(
          {.top_speed_u_s = speed_u_s, .up = RampLaw::by_slope(1e9), .down = RampLaw::by_slope(1e9)}, 0);
      group.group.run.append(arc_by_centre(Point::Zero(), Point(1000, 0, 0, 0), Point::Zero(),
                                           Turn::clockwise, {.plane = {0, 1}}),
                             {}, 0);
      group.environment[1].add(Signal::limit_plus, 1000, 5000);
      ASSERT_EQ(group.group.begin(Point::Zero(), group.axes, group.now), Cause::none);
      group.to_the_end();
      EXPECT_EQ(group.group.cause, Cause::limit_plus) << speed_u_s;
      EXPECT_NEAR(static_cast<double>(group.axes[0].travel_pulses), 1000, 45) << "the top of it";
      EXPECT_NEAR(static_cast<double>(group.axes[1].travel_pulses), 1000, 1);
    }
  }
}

TEST(CoordinatedSlow, ACommandSlowsThePathDown) {
  Group group(AxisSettings{});
  group.group.begin(Point::Zero(), group.axes, group.now);
  for (int i = 0; i < 200; ++i) group.step();
  const double begun = group.group.run.sample(group.now).position_u;
  group.group.slow_down(group.now, Cause::stopped);
  group.to_the_end();
  EXPECT_EQ(group.group.cause, Cause::stopped);
  EXPECT_NEAR(static_cast<double>(group.axes[1].travel_pulses), 0.8 * (begun + 5000), 1);
}

TEST(CoordinatedSlow, EndsOnlyWhenItsAxesAreInPosition) {
  AxisSettings settings;
  settings.waits_for_in_position = true;
  Group group(settings);
  group.group.begin(Point::Zero(), group.axes, group.now);
  for (int i = 0; i < 1000; ++i) group.step();
  EXPECT_TRUE(group.group.engaged);
  EXPECT_EQ(group.axes[1].travel_pulses, 40'000);
  group.environment[0].set_steady(Signal::in_position, true);
  group.step();
  EXPECT_TRUE(group.group.engaged);
  group.environment[1].set_steady(Signal::in_position, true);
  group.step();
  EXPECT_FALSE(group.group.engaged);
  EXPECT_EQ(group.group.cause, Cause::arrived);
}

TEST(CoordinatedSlow, WhatIsForbiddenIsRefusedBeforeAnythingBegins) {
  Group group(AxisSettings{});
  group.environment[1].set_steady(Signal::alarm, true);
  group.axes[1].step(0, group.environment[1]);
  EXPECT_EQ(group.group.begin(Point::Zero(), group.axes, group.now), Cause::alarm);
  EXPECT_FALSE(group.group.engaged);
  EXPECT_FALSE(group.axes[0].moving());
  Group nowhere(AxisSettings{});
  EXPECT_THROW(nowhere.group.begin(Point(NAN, 0, 0, 0), nowhere.axes, 0), BadMotion);
  EXPECT_THROW(nowhere.group.begin(Point(5, 0, 0, 0), nowhere.axes, 0), BadMotion) << "the path begins at 0";
  nowhere.group.scale[1].divider = 0;
  EXPECT_THROW(nowhere.group.begin(Point::Zero(), nowhere.axes, 0), BadMotion);
  EXPECT_FALSE(nowhere.axes[0].moving());
  EXPECT_FALSE(nowhere.group.run.running());
}

TEST(PathRunRefusal, PathsThatBeginElsewhereAndCreepingLawsAreRefused) {
  PathRun run;
  run.append(line(Point::Zero(), Point(1, 0, 0, 0)), {}, 0);
  EXPECT_THROW(run.append(line(Point(5, 0, 0, 0), Point(6, 0, 0, 0)), {}, 0), BadMotion);
  EXPECT_EQ(run.queued(), 1U);
  SpeedLaw law{.top_speed_u_s = 100, .up = RampLaw::by_slope(100), .down = RampLaw::by_slope(100)};
  law.slow_down_at_u = 0.5;
  EXPECT_THROW(run.set_speed(law, 0), BadMotion);
  law.start_speed_u_s = 1;
  EXPECT_NO_THROW(run.set_speed(law, 0));
}

}  // namespace coordinated_slow_test
}  // namespace understudy::motion
