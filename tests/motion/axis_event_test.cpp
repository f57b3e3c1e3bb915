// The events of an axis: comparators, the mark, in-position.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/motion/axis_course.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace axis_event_test {

using Relation = Comparator::Relation;
using Range = Counter::Range;

/// Returns the ticks (1 ...) in which comparator `number` fires.
std::vector<Tick> firings(AxisCourse& course, Tick ticks, std::size_t number = 0) {
  std::vector<Tick> at;
  for (Tick tick = 0; tick < ticks; ++tick) {
    course.step();
    const unsigned event = static_cast<unsigned>(Event::comparator_0) + static_cast<unsigned>(number);
    if ((course.axis.events & bit(static_cast<Event>(event))) != 0) at.push_back(course.now);
  }
  return at;
}

struct RelationCase {
  Relation relation;
  int direction;
  std::int64_t value;
  Tick fires;  // at 1 pulse per tick, from 0 in tick 1; 0: never
};

TEST(AxisEvent, AComparatorFiresInTheTickItsRelationBecomesTrue) {
  constexpr std::array<RelationCase, 18> kCases{{
      {Relation::at_least, +1, 5, 6},
      {Relation::at_least, +1, 1, 2},
      {Relation::at_least, +1, 0, 0},  // is already true
      {Relation::at_least, -1, -5, 0},
      {Relation::below, -1, -5, 7},
      {Relation::below, -1, 0, 2},
      {Relation::below, +1, 5, 0},
      {Relation::below, +1, -5, 0},
      {Relation::equal, +1, 5, 6},
      {Relation::equal, -1, -5, 6},
      {Relation::equal, +1, 0, 0},
      {Relation::equal_upwards, +1, 5, 6},
      {Relation::equal_upwards, -1, -5, 0},
      {Relation::equal_upwards, +1, 0, 0},
      {Relation::equal_downwards, -1, -5, 6},
      {Relation::equal_downwards, +1, 5, 0},
      {Relation::equal_downwards, -1, 0, 0},
      {Relation::off, +1, 5, 0},
  }};
  for (std::size_t number = 0; number < 4; ++number) {
    for (const RelationCase& c : kCases) {
      AxisCourse course;
      course.axis.set_comparator(number, {.relation = c.relation, .value = c.value});
      course.axis.run(c.direction, constant(1'000), 0);
      const std::vector<Tick> expected = c.fires == 0 ? std::vector<Tick>{} : std::vector<Tick>{c.fires};
      EXPECT_EQ(firings(course, 40, number), expected)
          << static_cast<int>(c.relation) << " " << c.value << " way " << c.direction;
    }
  }
}

TEST(AxisEvent, AComparatorFiresEachTimeItsRelationTurnsTrue) {
  AxisCourse course;
  course.axis.set_comparator(0, {.relation = Relation::equal, .value = 10});
  course.axis.move(20, constant(1'000), 0);
  EXPECT_EQ(firings(course, 30).size(), 1U);
  course.axis.move(-20, constant(1'000), course.now);
  EXPECT_EQ(firings(course, 30).size(), 1U);
  course.axis.move(10, constant(1'000), course.now);
  EXPECT_EQ(firings(course, 30).size(), 1U);
  EXPECT_EQ(course.travel(), 10);
  EXPECT_EQ(firings(course, 30).size(), 0U);
}

TEST(AxisEvent, ANumberThatIsWrittenCanMakeTheRelationTrue) {
  AxisCourse course;
  Comparator mine{.relation = Relation::at_least, .value = 10};
  course.axis.set_comparator(0, mine);
  EXPECT_TRUE(firings(course, 3).empty());
  mine.value = -5;
  course.axis.set_comparator(0, mine);
  EXPECT_EQ(firings(course, 3), (std::vector<Tick>{4}));
  mine.value = -7;  // true, as before
  course.axis.set_comparator(0, mine);
  EXPECT_TRUE(firings(course, 3).empty());
  mine.value = 1;
  course.axis.set_comparator(0, mine);
  EXPECT_TRUE(firings(course, 3).empty());
  mine.counter.set(3, 0);  // and so can a counter
  course.axis.set_comparator(0, mine);
  EXPECT_EQ(firings(course, 3), (std::vector<Tick>{13}));
}

TEST(AxisEvent, AnotherRelationIsAnotherQuestion) {
  AxisCourse course;
  course.axis.set_comparator(0, {.relation = Relation::below, .value = -5});
  firings(course, 3);
  course.axis.set_comparator(0, {.relation = Relation::at_least, .value = -5});
  EXPECT_TRUE(firings(course, 3).empty());
}

TEST(AxisEvent, AComparatorOfTheEncoderLooksAtTheEncoder) {
  AxisCourse course;
  course.axis.set_comparator(1, {.relation = Relation::at_least, .count = Count::encoder, .value = 100});
  course.axis.run(+1, constant(1'000), 0);
  EXPECT_TRUE(firings(course, 200, 1).empty());
  course.axis.set_encoder(99);
  EXPECT_TRUE(firings(course, 5, 1).empty());
  course.axis.set_encoder(150);
  EXPECT_EQ(firings(course, 5, 1), (std::vector<Tick>{206}));
  course.axis.set_encoder(20);
  EXPECT_TRUE(firings(course, 5, 1).empty());
  course.axis.set_encoder(100);
  EXPECT_EQ(firings(course, 5, 1).size(), 1U);
}

/// An axis whose encoder is not compared with anything has nothing to check.
TEST(AxisEvent, AComparatorOfTheEncoderMeetsWhatComesAfterIt) {
  AxisCourse course;
  course.axis.run(+1, constant(1'000), 0);
  EXPECT_TRUE(firings(course, 5, 1).empty());
  course.axis.set_encoder(50);
  EXPECT_FALSE(course.axis.must_recheck);
  course.axis.set_comparator(
      1, {.relation = Comparator::Relation::equal_upwards, .count = Count::encoder, .value = 30});
  EXPECT_TRUE(firings(course, 5, 1).empty()) << "it was passed earlier";
  course.axis.set_encoder(20);
  EXPECT_TRUE(course.axis.must_recheck);
  EXPECT_TRUE(firings(course, 5, 1).empty());
  course.axis.set_encoder(40);
  EXPECT_EQ(firings(course, 5, 1).size(), 1U);
}

TEST(AxisEvent, AnEncoderThatJumpsFarPassesNothing) {
  // 100,000 counts within a tick are a motion, which passes everything in between; more are a jump.
  for (const int direction : {+1, -1}) {
    AxisCourse course;
    course.axis.set_comparator(
        0, {.relation = Relation::equal, .count = Count::encoder, .value = direction * 50'000});
    course.axis.set_comparator(1, {.relation = direction > 0 ? Relation::at_least : Relation::below,
                                   .count = Count::encoder,
                                   .value = direction * 100'001});
    EXPECT_TRUE(firings(course, 1).empty());
    course.axis.set_encoder(direction * 100'000);
    EXPECT_EQ(firings(course, 1).size(), 1U) << direction;
    course.axis.set_encoder(0);
    EXPECT_EQ(firings(course, 1).size(), 1U) << "and back, " << direction;
    course.axis.set_encoder(direction * 100'001);
    EXPECT_TRUE(firings(course, 1).empty()) << direction;
    course.axis.set_encoder(0);
    EXPECT_TRUE(firings(course, 1).empty()) << "and back, " << direction;
    // Only the end of a jump counts.
    course.axis.set_encoder(direction * 200'000);
    EXPECT_EQ(firings(course, 1, 1).size(), 1U) << direction;
  }
}

TEST(AxisEvent, AComparatorSeesItsCounterComeRound) {
  Comparator mine{
      .relation = Relation::below, .counter = {.range = Range::ring, .ring_top = 99}, .value = 10};
  mine.counter.set(50, 0);
  AxisCourse course;
  course.axis.set_comparator(0, mine);
  course.axis.run(+1, constant(1'000), 0);
  EXPECT_EQ(firings(course, 300), (std::vector<Tick>{51, 151, 251}));  // at 100, which is 0

  Comparator wide{.relation = Relation::at_least, .counter = {.range = Range::bits32}, .value = 0};
  wide.counter.set(INT32_MIN + 20, 0);
  AxisCourse down;
  down.axis.set_comparator(0, wide);
  down.axis.run(-1, constant(1'000), 0);
  EXPECT_EQ(firings(down, 100), (std::vector<Tick>{22}));
}

TEST(AxisEvent, SeveralEdgesInOneTickAreAllMet) {
  AxisCourse course;
  for (std::size_t i = 0; i < 4; ++i) {
    course.axis.set_comparator(i,
                               {.relation = Relation::equal, .value = 1'000 + static_cast<std::int64_t>(i)});
  }
  course.environment.add(Signal::mark, 2'000, 2'000);
  course.axis.run(+1, constant(4e6), 0);
  course.step();
  course.seen = 0;
  EXPECT_EQ(course.step(), 4'000);
  for (const Event event : {Event::comparator_0, Event::comparator_1, Event::comparator_2,
                            Event::comparator_3, Event::mark_on, Event::mark_off}) {
    EXPECT_TRUE(course.saw(event)) << static_cast<int>(event);
  }
  course.seen = 0;
  course.steps(10);
  EXPECT_EQ(course.seen, 0);
}

TEST(AxisEvent, AComparatorThatStopsAtOnceStopsOnItsPulse) {
  for (const int direction : {+1, -1}) {
    for (const std::int64_t value : {1, 3'999, 4'000, 4'001, 123'456}) {
      AxisCourse course;
      course.axis.set_comparator(
          2, {.relation = Relation::equal, .reaction = Reaction::stop_at_once, .value = direction * value});
      course.axis.run(direction, constant(4e6), 0);
      ASSERT_GE(course.until_rest(), 0);
      EXPECT_EQ(course.travel(), direction * value);
      EXPECT_EQ(course.axis.cause, Cause::comparator);
      EXPECT_TRUE(course.saw(Event::comparator_2));
      // It is at the limit, and continues from there.
      course.axis.move(direction * 5, constant(4e6), course.now);
      course.until_rest();
      EXPECT_EQ(course.travel(), direction * (value + 5));
    }
  }
}

TEST(AxisEvent, AComparatorMaySlowTheAxisDown) {
  AxisCourse course;
  course.axis.set_comparator(
      0, {.relation = Relation::at_least, .reaction = Reaction::slow_down, .value = 10'000});
  course.axis.run(+1, trapezoid(10'000, 100'000), 0);
  course.until_rest();
  EXPECT_NEAR(static_cast<double>(course.travel()), 10'500, 1);
  EXPECT_EQ(course.axis.cause, Cause::comparator);
}

TEST(AxisEvent, ComparatorsFireAsCountingPulseByPulseSays) {
  RandomMoves random(seed());
  for (int i = 0; i < random_cases(300); ++i) {
    AxisCourse course;
    course.environment.index_period = random.between(0, 60);
    course.axis.set({.at_limit_plus = Reaction::ignore});
    std::array<Comparator, 4> wanted;
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      Comparator& one = wanted[k];
      one.relation = static_cast<Relation>(random.between(0, 5));
      one.counter.range = random.between(0, 1) == 0 ? Range::linear : Range::ring;
      one.counter.ring_top = random.between(0, 50);
      one.counter.offset = random.between(-100, 100);
      one.value = random.between(-60, 60);
      course.axis.set_comparator(k, one);
    }
    std::array<bool, 4> was{};
    for (std::size_t k = 0; k < 4; ++k) was[k] = wanted[k].holds(0);
    std::int64_t travel = 0;
    for (int moves = 0; moves < 3; ++moves) {
      const std::int64_t distance = random.between(-400, 400);
      course.axis.move(distance, trapezoid(static_cast<double>(random.of_any_size(100, 100'000)), 1e6),
                       course.now);
      while (course.axis.moving()) {
        course.step();
        Events fired = 0;
        while (travel != course.travel()) {
          const int direction = travel < course.travel() ? +1 : -1;
          travel += direction;
          for (std::size_t k = 0; k < 4; ++k) {
            const bool holds = wanted[k].holds(travel);
            const bool comes_by_it = wanted[k].sense() == 0 || wanted[k].sense() == direction;
            if (holds && !was[k] && comes_by_it) fired |= static_cast<Events>(bit(Event::comparator_0) << k);
            was[k] = holds;
          }
        }
        const Events all = static_cast<Events>(bit(Event::comparator_0) * 15);
        ASSERT_EQ(course.axis.events & all, fired)
            << "seed " << seed() << " case " << i << " travel " << travel << " of " << distance;
      }
    }
  }
}

TEST(AxisEvent, TheMarkComesAndGoes) {
  AxisCourse course;
  course.environment.add(Signal::mark, 5, 9);
  course.axis.run(+1, constant(1'000), 0);
  course.steps(5);
  EXPECT_FALSE(course.saw(Event::mark_on));
  course.step();
  EXPECT_EQ(course.axis.events, bit(Event::mark_on));
  course.seen = 0;
  course.steps(4);
  EXPECT_EQ(course.seen, 0);
  course.step();
  EXPECT_EQ(course.axis.events, bit(Event::mark_off));
  course.environment.set_steady(Signal::mark, true);
  course.step();
  EXPECT_EQ(course.axis.events, bit(Event::mark_on));
}

TEST(AxisEvent, AMotionThatWaitsForInPositionEndsWhenItComesOn) {
  AxisCourse course;
  course.axis.set({.waits_for_in_position = true});
  course.axis.move(10, constant(1'000), 0);
  EXPECT_EQ(course.steps(11), 10);
  EXPECT_TRUE(course.axis.moving());
  EXPECT_EQ(course.axis.remaining_pulses(), 0);
  EXPECT_EQ(course.steps(100), 0);
  EXPECT_TRUE(course.axis.moving());
  EXPECT_EQ(course.endings, 0);
  course.axis.change_speed(constant(5'000), course.now);
  course.axis.change_distance(100, false, course.now);
  course.environment.set_steady(Signal::in_position, true);
  EXPECT_EQ(course.step(), 0);
  EXPECT_FALSE(course.axis.moving());
  EXPECT_EQ(course.endings, 1);
  EXPECT_EQ(course.axis.cause, Cause::arrived);
  EXPECT_EQ(course.travel(), 10);
}

TEST(AxisEvent, InPositionAtTheEndAlreadyIsNoWait) {
  AxisCourse course;
  course.environment.set_steady(Signal::in_position, true);
  course.axis.set({.waits_for_in_position = true});
  course.axis.move(10, constant(1'000), 0);
  course.steps(11);
  EXPECT_FALSE(course.axis.moving());
  EXPECT_EQ(course.axis.cause, Cause::arrived);
}

TEST(AxisEvent, AStopEndsTheWaitForInPosition) {
  for (const bool at_once : {false, true}) {
    AxisCourse course;
    course.axis.set({.waits_for_in_position = true});
    course.axis.move(10, constant(1'000), 0);
    course.steps(20);
    if (at_once) {
      course.axis.stop();
    } else {
      course.axis.slow_down(course.now);
    }
    EXPECT_FALSE(course.axis.moving());
    EXPECT_EQ(course.axis.cause, Cause::stopped);
    course.axis.move(-10, constant(1'000), course.now);
    course.steps(11);
    EXPECT_EQ(course.travel(), 0);
  }
}

TEST(AxisEvent, AnAxisThatDoesNotWaitTakesNoNoticeOfInPosition) {
  AxisCourse course;
  course.axis.move(10, constant(1'000), 0);
  course.steps(11);
  EXPECT_FALSE(course.axis.moving());
}

}  // namespace axis_event_test
}  // namespace understudy::motion
