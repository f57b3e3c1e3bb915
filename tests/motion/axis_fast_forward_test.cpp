// Fast-forwarded ticks equal single ticks: random courses of an axis, with everything that can happen to it.
#include <gtest/gtest.h>

#include "tests/motion/axis_scenario.h"

namespace understudy::motion {
namespace axis_fast_forward_test {

/// Equals `single` single ticks, in as few steps as possible.
void go_to(AxisCourse& course, Tick until, AxisScenario& scenario, Tick& skipped) {
  while (course.now < until) {
    const Tick max = scenario.between(0, 2) == 0 ? course.now + scenario.between(1, 200) : until;
    const Tick quiet = course.axis.quiet_until(course.now + 1, std::min(max, until), course.environment, {});
    if (quiet > course.now) {
      skipped += quiet - course.now;
      course.now = quiet;
      course.note(course.axis.fast_forward_to(quiet));
    } else {
      course.step();
    }
  }
}

TEST(AxisFastForward, IsTheSameStateAsSingleTicks) {
  RandomMoves seeds(seed() + 5);
  Tick skipped = 0;
  Tick stepped = 0;
  for (int i = 0; i < random_cases(800); ++i) {
    AxisScenario scenario(static_cast<std::uint64_t>(seeds.between(1, INT64_MAX)));
    AxisCourse bulk = scenario.course();
    AxisCourse single = bulk;
    for (int event = 0; event < 40; ++event) {
      const auto command = scenario.next();
      act(command, bulk);
      act(command, single);
      const Tick until = single.now + scenario.between(1, scenario.between(0, 9) == 0 ? 5'000 : 60);
      stepped += until - single.now;
      if (bulk.axis.task == Task::coordinated || bulk.axis.task == Task::following) {
        bulk.axis.stop();
        single.axis.stop();
      }
      go_to(bulk, until, scenario, skipped);
      while (single.now < until) single.step();
      // Skipped ticks have no events: what remains belongs to the last tick.
      ASSERT_EQ(bulk.axis, single.axis) << scenario.code() << " " << single.now;
      ASSERT_EQ(bulk.output_pulses, single.output_pulses) << scenario.code() << " " << single.now;
      ASSERT_EQ(bulk.seen, single.seen) << scenario.code() << " " << single.now;
      ASSERT_EQ(bulk.endings, single.endings) << scenario.code() << " " << single.now;
    }
  }
  EXPECT_GT(skipped, stepped / 2);
}

TEST(AxisFastForward, StaysWithinTheRangeItIsGiven) {
  RandomMoves random(seed() + 6);
  for (int i = 0; i < random_cases(2000); ++i) {
    AxisCourse course;
    const int direction = random.between(0, 1) == 0 ? -1 : +1;
    const auto top = static_cast<double>(random.of_any_size(1, 1'000'000));
    course.axis.move(direction * random.of_any_size(1, 10'000'000),
                     trapezoid(top, static_cast<double>(random.of_any_size(100, 10'000'000))), 0);
    course.step();
    AxisCourse single = course;
    const Axis::TravelRange range{.low = -random.of_any_size(1, 1'000'000),
                                  .high = random.of_any_size(1, 1'000'000)};
    const Tick max = random.of_any_size(1, 100'000);
    const Tick quiet = course.axis.quiet_until(2, max, course.environment, range);
    while (single.now < std::min<Tick>(quiet, 20'000)) {
      single.step();
      ASSERT_GE(single.travel(), range.low);
      ASSERT_LE(single.travel(), range.high);
      ASSERT_EQ(single.travel(), course.axis.travel_ahead(single.now));
      ASSERT_EQ(single.axis.events, 0);
    }
  }
}

TEST(AxisFastForward, AnHourIsAFewSteps) {
  AxisCourse course;
  course.axis.move(3'600'000'000, trapezoid(1'000'000, 1e6), 0);
  int steps = 0;
  while (course.axis.moving()) {
    const Tick quiet = course.axis.quiet_until(course.now + 1, kNoTick - 1, course.environment, {});
    if (quiet > course.now) {
      course.now = quiet;
      course.axis.fast_forward_to(quiet);
    } else {
      course.step();
    }
    ASSERT_LT(++steps, 20);
  }
  EXPECT_EQ(course.travel(), 3'600'000'000);
  EXPECT_EQ(course.now, 3'601'001);
}

TEST(AxisFastForward, OutsideItsRangeThereIsNone) {
  AxisCourse course;
  course.axis.run(+1, constant(10'000), 0);
  for (int i = 0; i < 5; ++i) course.step();
  const std::int64_t travel = course.travel();
  const auto quiet_within = [&](std::int64_t low, std::int64_t high) {
    return course.axis.quiet_until(course.now + 1, 1000, course.environment, {.low = low, .high = high});
  };
  EXPECT_GT(quiet_within(travel, travel + 1000), course.now);
  EXPECT_EQ(quiet_within(travel + 1, travel + 1000), course.now) << "it will be in it, but is not yet";
  EXPECT_EQ(quiet_within(travel - 1000, travel - 1), course.now);
}

TEST(AxisFastForward, WhereEveryPulseIsLookedAtThereIsNone) {
  AxisCourse course;
  course.axis.settings.raises = bit(Event::pulse);
  course.axis.run(+1, constant(10'000), 0);
  for (int i = 0; i < 20; ++i) {
    course.step();
    EXPECT_EQ(course.axis.quiet_until(course.now + 1, 1000, course.environment, {}), course.now);
  }
}

TEST(AxisFastForward, WhatIsCarriedEvenlyIsCarriedAtOnce) {
  for (const std::int64_t pulses : {-7, 0, 12}) {
    AxisCourse bulk;
    bulk.environment.add(Signal::home, 5'000, 6'000);
    bulk.axis.take_part();
    bulk.carry(pulses);
    bulk.carry(pulses);
    AxisCourse single = bulk;
    ASSERT_TRUE(bulk.axis.carries_quietly(bulk.environment));
    for (int i = 0; i < 100; ++i) single.carry(pulses);
    bulk.axis.carry_across(100 * pulses);
    EXPECT_EQ(bulk.axis, single.axis) << pulses;
  }
}

}  // namespace axis_fast_forward_test
}  // namespace understudy::motion
