// The fast and the slow path through a tick give the same result, and so do a copy and its original.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/state/difference.h"
#include "motion/state_fields.h"
#include "tests/motion/axis_scenario.h"

namespace understudy::motion {
namespace axis_equivalence_test {

constexpr int kTicks = 1'500;

/// Without the members that only say how the next tick is done.
Axis state_of(Axis axis) {
  axis.must_recheck = false;
  axis.watch_low = axis.watch_high = 0;
  return axis;
}

/// Stepped by the slow path, whatever the axis chooses.
std::int64_t step_slow_path(AxisCourse& course, std::int64_t counts) {
  course.axis.must_recheck = true;
  return step(course, counts);
}

void expect_alike(AxisScenario scenario) {
  AxisCourse quick = scenario.course();
  AxisCourse careful = quick;
  for (int tick = 0; tick < kTicks; ++tick) {
    const auto command = scenario.next();
    const std::int64_t counts = scenario.counts();
    act(command, quick);
    act(command, careful);
    ASSERT_EQ(step(quick, counts), step_slow_path(careful, counts)) << scenario.code() << " " << quick.now;
    ASSERT_EQ(quick.axis.events, careful.axis.events) << scenario.code() << " " << quick.now;
    ASSERT_EQ(quick.axis.travel_pulses, careful.axis.travel_pulses) << scenario.code() << " " << quick.now;
    ASSERT_EQ(quick.axis.cause, careful.axis.cause) << scenario.code() << " " << quick.now;
    if (tick % 16 == 0) {
      ASSERT_EQ(first_difference(state_of(quick.axis), state_of(careful.axis)), "")
          << scenario.code() << " " << quick.now;
    }
  }
  ASSERT_EQ(first_difference(state_of(quick.axis), state_of(careful.axis)), "") << scenario.code();
}

TEST(AxisEquivalence, TheShortWayThroughATickIsTheCarefulOne) {
  RandomMoves seeds(seed());
  for (int i = 0; i < random_cases(600) && !testing::Test::HasFatalFailure(); ++i) {
    expect_alike(AxisScenario(static_cast<std::uint64_t>(seeds.between(1, INT64_MAX))));
  }
}

/// Found once in 20,000: backlash is left over when the settings no longer have any.
TEST(AxisEquivalence, PlayThatIsLeftOverIsForgottenByBoth) {
  expect_alike(AxisScenario(1600278233990034164));
}

TEST(AxisEquivalence, ACopyContinuesAsItsOriginalDoes) {
  RandomMoves seeds(seed());
  for (int i = 0; i < random_cases(200); ++i) {
    AxisScenario scenario(static_cast<std::uint64_t>(seeds.between(1, INT64_MAX)));
    AxisCourse original = scenario.course();
    AxisCourse copy = original;
    for (int tick = 0; tick < kTicks; ++tick) {
      if (scenario.between(0, 200) == 0) copy = AxisCourse(original);
      const auto command = scenario.next();
      const std::int64_t counts = scenario.counts();
      act(command, original);
      act(command, copy);
      ASSERT_EQ(step(original, counts), step(copy, counts)) << scenario.code() << " " << original.now;
    }
    ASSERT_EQ(original.axis, copy.axis) << scenario.code();
  }
}

TEST(AxisEquivalence, WithinItsWindowNothingDependsOnThePlace) {
  RandomMoves seeds(seed());
  for (int i = 0; i < random_cases(150); ++i) {
    AxisScenario scenario(static_cast<std::uint64_t>(seeds.between(1, INT64_MAX)));
    AxisCourse course = scenario.course();
    for (int tick = 0; tick < kTicks; ++tick) {
      act(scenario.next(), course);
      step(course, scenario.counts());
      const Axis& axis = course.axis;
      ASSERT_LE(axis.watch_low, axis.travel_pulses) << scenario.code() << " " << course.now;
      ASSERT_GE(axis.watch_high, axis.travel_pulses) << scenario.code() << " " << course.now;
      if (axis.must_recheck) continue;
      const std::int64_t low = std::max(axis.watch_low, axis.travel_pulses - 1'000'000);
      const std::int64_t high = std::min(axis.watch_high, axis.travel_pulses + 1'000'000);
      for (const std::int64_t place : {low, high, scenario.between(low, high), scenario.between(low, high)}) {
        ASSERT_EQ(course.environment.at(place), axis.signals)
            << scenario.code() << " " << course.now << " " << place;
        for (const Comparator& comparator : axis.comparators) {
          if (comparator.count != Count::command) continue;
          ASSERT_EQ(comparator.holds(place), comparator.was_true)
              << scenario.code() << " " << course.now << " " << place;
        }
        // A soft limit is reached on the way out.
        const auto& max = axis.settings.soft_limit_plus;
        const auto& min = axis.settings.soft_limit_minus;
        const bool matters = axis.settings.at_soft_limit != Reaction::ignore;
        const std::int64_t way = matters ? axis.drive.direction : 0;
        ASSERT_FALSE(way > 0 && max && axis.travel_pulses <= *max && place > *max)
            << scenario.code() << " " << course.now;
        ASSERT_FALSE(way < 0 && min && axis.travel_pulses >= *min && place < *min)
            << scenario.code() << " " << course.now;
      }
    }
  }
}

TEST(AxisEquivalence, WhatComesOutIsTravelAndBacklashAndNothingAtRest) {
  RandomMoves seeds(seed());
  for (int i = 0; i < random_cases(300); ++i) {
    AxisScenario scenario(static_cast<std::uint64_t>(seeds.between(1, INT64_MAX)));
    AxisCourse course = scenario.course();
    for (int tick = 0; tick < kTicks; ++tick) {
      act(scenario.next(), course);
      const bool moved = course.axis.moving();
      const std::int64_t pulses = step(course, scenario.counts());
      ASSERT_TRUE(moved || pulses == 0) << scenario.code() << " " << course.now;
      const std::int64_t output = course.axis.travel_pulses + course.axis.backlash_sent;
      ASSERT_EQ(course.output_pulses, course.axis.inverted ? -output : output)
          << scenario.code() << " " << course.now;
    }
  }
}

TEST(AxisEquivalence, AnEdgeAtEveryPulseIsSlowButSure) {
  AxisCourse course;
  course.environment.index_period = 2;
  for (std::size_t i = 0; i < 4; ++i) {
    course.axis.set_comparator(i,
                               {.relation = Comparator::Relation::equal,
                                .counter = {.range = Counter::Range::ring, .ring_top = static_cast<int>(i)},
                                .value = 0});
  }
  course.axis.run(-1, constant(1e6), 0);
  course.step();
  for (int tick = 1; tick <= 100; ++tick) ASSERT_EQ(course.step(), -1'000);
  EXPECT_EQ(course.travel(), -100'000);
}

}  // namespace axis_equivalence_test
}  // namespace understudy::motion
