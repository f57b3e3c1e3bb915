// An axis that is stopped within a tick stops the others at that point of the path, whatever the speed.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>

#include "tests/motion/coordinated_bench.h"

namespace understudy::motion {
namespace coordinated_stop_pulse_test {

struct Course {
  const char* what;
  std::function<void(Bench&)> lay;
  // The other axes' positions when X is at `x`, moving there: calculated from the course itself.
  std::function<Point(double x)> others;
  std::int64_t limit;  // of X: from here on, in its direction of motion
};

constexpr double kRadius = 40'000;

Path quarter() {
  return arc_by_centre(Point::Zero(), place_of(0, kRadius), place_of(kRadius, kRadius),
                       Turn::counter_clockwise);
}

const Course kCourses[]{
    {"a line in two axes", [](Bench& b) { b.add(line(place_of(0, 0), place_of(30'000, 12'000))); },
     [](double x) { return place_of(x, 0.4 * x); }, 5001},
    {"a line in three axes, one of them backwards",
     [](Bench& b) {
       b.add(line(Point::Zero(), Point{30'000, -60'000, 7'500, 0}));
     },
     [](double x) {
       return Point{x, -2 * x, x / 4, 0};
     },
     7},
    {"a line that goes down", [](Bench& b) { b.add(line(Point::Zero(), place_of(-30'000, 10'000))); },
     [](double x) { return place_of(x, -x / 3); }, -4002},
    {"a quarter of a circle", [](Bench& b) { b.add(quarter()); },
     [](double x) { return place_of(x, kRadius - std::sqrt(kRadius * kRadius - x * x)); }, 24'017},
    {"lines of 50 pulses, many of them in a tick at the highest speed",
     [](Bench& b) {
       Point at = Point::Zero();
       for (int i = 0; i < 30; ++i) {
         const Point next = at + place_of(40, i % 2 == 0 ? 30 : -30);
         b.add(line(at, next), {.rule = Joint::Rule::join});
         at = next;
       }
     },
     [](double x) {
       const double within = std::fmod(x, 80);
       return place_of(x, 0.75 * (within <= 40 ? within : 80 - within));
     },
     731},
    {"the end of a chain, in its last tick",
     [](Bench& b) {
       b.add(line(place_of(0, 0), place_of(3000, 1000)));
       b.add(line(place_of(3000, 1000), place_of(0, 0)));
     },
     [](double x) { return place_of(x, x / 3); }, 2999},
};

TEST(CoordinatedStopPulse, TheOthersStandWhereThePathWas) {
  for (const Course& course : kCourses) {
    for (const double speed : {10.0, 100.0, 4'000'000.0}) {
      SCOPED_TRACE(std::string(course.what) + " at " + std::to_string(speed));
      if (speed < 1000 && std::abs(course.limit) > 1000) continue;  // minutes of ticks
      Bench bench(by_slope(speed, 1e12));
      course.lay(bench);
      const int direction = course.limit < 0 ? -1 : +1;
      if (direction > 0) {
        bench.environment[0].add(Signal::limit_plus, course.limit, 1'000'000);
      } else {
        bench.environment[0].add(Signal::limit_minus, -1'000'000, course.limit);
      }
      ASSERT_EQ(bench.begin(), Cause::none);
      ASSERT_GT(bench.to_the_end(), 0);
      EXPECT_EQ(bench.axes[0].travel_pulses, course.limit);
      // The pulse is sent when the path is half a pulse before it.
      const Point expected = course.others(static_cast<double>(course.limit) - 0.5 * direction);
      for (std::size_t i = 1; i < 3; ++i) {
        const auto number = static_cast<Eigen::Index>(i);
        EXPECT_NEAR(static_cast<double>(bench.axes[i].travel_pulses), expected[number], 0.5 + 1e-6) << i;
        EXPECT_EQ(bench.sent[i], bench.axes[i].travel_pulses) << i;
      }
    }
  }
}

TEST(CoordinatedStopPulse, TheFirstOfTwoDecides) {
  for (const bool y_first : {false, true}) {
    Bench bench(by_slope(4'000'000, 1e12));
    bench.add(line(place_of(0, 0), place_of(30'000, 15'000)));
    bench.environment[0].add(Signal::limit_plus, y_first ? 1101 : 1000, 1'000'000);
    bench.environment[1].add(Signal::limit_plus, y_first ? 500 : 551, 1'000'000);
    ASSERT_EQ(bench.begin(), Cause::none);
    ASSERT_GT(bench.to_the_end(), 0);
    EXPECT_EQ(bench.axes[0].travel_pulses, y_first ? 999 : 1000) << y_first;
    EXPECT_EQ(bench.axes[1].travel_pulses, 500) << y_first;
    EXPECT_EQ(bench.axes[y_first ? 1 : 0].cause, Cause::limit_plus) << y_first;
  }
}

TEST(CoordinatedStopPulse, AnAlarmStopsAllBeforeAnyPulseOfTheTick) {
  Bench bench(by_slope(4'000'000, 1e12));
  bench.add(line(place_of(0, 0), place_of(300'000, 150'000)));
  ASSERT_EQ(bench.begin(), Cause::none);
  bench.steps(5);
  const Travels before = bench.travels();
  bench.environment[1].set_steady(Signal::alarm, true);
  bench.step();
  EXPECT_EQ(bench.travels(), before);
  EXPECT_EQ(bench.group.cause, Cause::alarm);
}

TEST(CoordinatedStopPulse, AnEdgeOfTheMarkStopsAllWhereAsked) {
  for (const bool at_its_end : {false, true}) {
    Bench bench(by_slope(4'000'000, 1e12));
    bench.add(line(place_of(0, 0), place_of(30'000, 15'000)));
    AxisSettings settings;
    (at_its_end ? settings.at_mark_off : settings.at_mark_on) = Reaction::stop_at_once;
    bench.axes[0].set(settings);
    bench.environment[0].add(Signal::mark, 6001, 7000);
    ASSERT_EQ(bench.begin(), Cause::none);
    ASSERT_GT(bench.to_the_end(), 0);
    EXPECT_EQ(bench.axes[0].travel_pulses, at_its_end ? 7001 : 6001);
    EXPECT_EQ(bench.axes[1].travel_pulses, at_its_end ? 3500 : 3000);
    EXPECT_EQ(bench.group.cause, Cause::stopped);
  }
}

TEST(CoordinatedStopPulse, ASingleAxisStopsAtTheMarksEdge) {
  for (const double speed : {10.0, 4'000'000.0}) {
    Bench bench;
    AxisSettings settings;
    settings.at_mark_on = Reaction::stop_at_once;
    bench.axes[0].set(settings);
    bench.environment[0].add(Signal::mark, 23, 60);
    ASSERT_EQ(bench.axes[0].run(+1, by_slope(speed, 1e12), bench.tick), Cause::none);
    for (int i = 0; i < 3000 && bench.axes[0].moving(); ++i) bench.step();
    EXPECT_EQ(bench.axes[0].travel_pulses, 23) << speed;
  }
}

}  // namespace coordinated_stop_pulse_test
}  // namespace understudy::motion
