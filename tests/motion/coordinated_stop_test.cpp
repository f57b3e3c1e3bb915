// A stop of one axis of a coordinated motion stops all axes.
#include <gtest/gtest.h>

#include <functional>

#include "tests/motion/coordinated_bench.h"

namespace understudy::motion {
namespace coordinated_stop_test {

/// A line of X and Y, 2 to 1, at 20 pulses of X per tick, started at position 0, 0; another waits behind it.
Bench two_to_one(double sign = 1) {
  Bench bench(by_slope(20'000 * std::sqrt(1.25), 1e9));
  bench.group.axis_of = {0, 1, 2, Coordinated::kNone};
  bench.add(line(place_of(0, 0), place_of(sign * 10'000, sign * 5000)));
  bench.add(line(place_of(sign * 10'000, sign * 5000), place_of(0, 0)));
  return bench;
}

struct StopCase {
  const char* what;
  std::function<void(Bench&)> set_up;  // before the beginning
  double sign;                         // of the line
  Cause cause;
  std::size_t axis;     // the axis that is stopped ...
  std::int64_t travel;  // at this pulse
};

TEST(CoordinatedStop, AnAxisThatMeetsSomethingStopsThemAllAtItsPulse) {
  const auto settings = [](Bench& bench, std::size_t axis, const std::function<void(AxisSettings&)>& set) {
    AxisSettings changed;
    set(changed);
    bench.axes[axis].set(changed);
  };
  const StopCase kCases[]{
      {"limit + of X", [](Bench& b) { b.environment[0].add(Signal::limit_plus, 5003, 9000); }, 1,
       Cause::limit_plus, 0, 5003},
      {"limit + of Y", [](Bench& b) { b.environment[1].add(Signal::limit_plus, 2501, 9000); }, 1,
       Cause::limit_plus, 1, 2501},
      {"limit - of X", [](Bench& b) { b.environment[0].add(Signal::limit_minus, -9000, -77); }, -1,
       Cause::limit_minus, 0, -77},
      {"limit that slows down",
       [&](Bench& b) {
         b.environment[0].add(Signal::limit_plus, 5003, 9000);
         settings(b, 0, [](AxisSettings& s) { s.at_limit_plus = Reaction::slow_down; });
       },
       1, Cause::limit_plus, 0, 5003},  // the path decelerates, and needs a quarter of a unit
      {"soft limit + of Y",
       [&](Bench& b) { settings(b, 1, [](AxisSettings& s) { s.soft_limit_plus = 1234; }); }, 1,
       Cause::soft_limit_plus, 1, 1235},  // the pulse beyond it triggers
      {"soft limit + of Y, where a tick ends",
       [&](Bench& b) { settings(b, 1, [](AxisSettings& s) { s.soft_limit_plus = 1240; }); }, 1,
       Cause::soft_limit_plus, 1, 1241},
      {"soft limit - of Y",
       [&](Bench& b) { settings(b, 1, [](AxisSettings& s) { s.soft_limit_minus = -1234; }); }, -1,
       Cause::soft_limit_minus, 1, -1235},
      {"alarm of Y at a place", [](Bench& b) { b.environment[1].add(Signal::alarm, 3000, 3001); }, 1,
       Cause::alarm, 1, 3000},
      {"emergency of X at a place", [](Bench& b) { b.environment[0].add(Signal::emergency, 70, 71); }, 1,
       Cause::emergency, 0, 70},
      {"comparator of X",
       [](Bench& b) {
         b.axes[0].set_comparator(
             0,
             {.relation = Comparator::Relation::at_least, .reaction = Reaction::stop_at_once, .value = 4321});
       },
       1, Cause::comparator, 0, 4321},
  };
  for (const StopCase& stop : kCases) {
    Bench bench = two_to_one(stop.sign);
    stop.set_up(bench);
    ASSERT_EQ(bench.begin(), Cause::none) << stop.what;
    ASSERT_GT(bench.to_the_end(), 0) << stop.what;
    EXPECT_EQ(bench.group.cause, stop.cause) << stop.what;
    EXPECT_EQ(bench.axes[stop.axis].travel_pulses, stop.travel) << stop.what;
    EXPECT_EQ(bench.axes[stop.axis].cause, stop.cause) << stop.what;
    // The other is where the path is at that pulse.
    const auto x = static_cast<double>(bench.axes[0].travel_pulses);
    const auto y = static_cast<double>(bench.axes[1].travel_pulses);
    EXPECT_LE(std::abs(x - 2 * y), 1.5) << stop.what;
    EXPECT_EQ(bench.group.run.queued(), 0U) << stop.what;
    const Travels stands = bench.travels();
    bench.steps(20);
    EXPECT_EQ(bench.travels(), stands) << stop.what;
    for (const Axis& axis : bench.axes) EXPECT_FALSE(axis.moving()) << stop.what;
    for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE((bench.events[i] & bit(Event::ended)) != 0) << stop.what;
  }
}

TEST(CoordinatedStop, SignalsThatAreNoneOfItsPlacesStopItToo) {
  for (const auto& [signal, cause] :
       {std::pair{Signal::alarm, Cause::alarm}, std::pair{Signal::emergency, Cause::emergency}}) {
    // An axis that takes part, but is at rest.
    Bench bench = two_to_one();
    bench.begin();
    bench.steps(100);
    bench.environment[2].set_steady(signal, true);
    bench.step();
    EXPECT_FALSE(bench.group.engaged);
    EXPECT_EQ(bench.group.cause, cause);
  }
}

TEST(CoordinatedStop, AnEventOfOneAxisBetweenTicksEndsItForAll) {
  const std::pair<std::function<void(Axis&, Tick)>, Cause> kOrders[]{
      {[](Axis& axis, Tick) { axis.stop(); }, Cause::stopped},
      {[](Axis& axis, Tick now) { axis.slow_down(now); }, Cause::stopped},
      {[](Axis& axis, Tick) { axis.switch_servo(false); }, Cause::servo_off},
  };
  for (const auto& [order, cause] : kOrders) {
    Bench bench = two_to_one();
    bench.begin();
    bench.steps(100);
    const Travels before = bench.travels();
    order(bench.axes[1], bench.tick);
    bench.step();
    EXPECT_FALSE(bench.group.engaged);
    EXPECT_EQ(bench.group.cause, cause);
    EXPECT_EQ(bench.axes[1].travel_pulses, before[1]);
    EXPECT_TRUE((bench.axes[1].events & bit(Event::ended)) != 0);  // reported in that very tick
    EXPECT_FALSE(bench.axes[0].moving());
  }
}

TEST(CoordinatedStop, AnAxisThatIsSentElsewhereLosesNoTickOfItsNewMotion) {
  Bench bench = two_to_one();
  bench.begin();
  bench.steps(100);
  const Travels before = bench.travels();
  bench.axes[1].move(1000, by_slope(10'000, 1e9), bench.tick);
  Bench alone = bench;
  alone.group.engaged = false;
  for (int i = 0; i < 5; ++i) {
    bench.step();
    alone.step();
    EXPECT_EQ(bench.axes[1].travel_pulses, alone.axes[1].travel_pulses) << i;
    EXPECT_FALSE(bench.group.engaged);
    EXPECT_EQ(bench.group.cause, Cause::stopped);
  }
  bench.steps(200);
  EXPECT_EQ(bench.axes[1].travel_pulses, before[1] + 1000);
}

TEST(CoordinatedStop, StoppedByItsOwnerNoPulseFollows) {
  Bench bench = two_to_one();
  bench.begin();
  bench.steps(50);
  const Travels before = bench.travels();
  bench.group.stop(bench.axes, Cause::emergency);
  bench.steps(10);
  EXPECT_EQ(bench.travels(), before);
  EXPECT_EQ(bench.group.cause, Cause::emergency);
  EXPECT_EQ(bench.axes[0].cause, Cause::emergency);
  bench.group.stop(bench.axes);  // nothing left to stop
  EXPECT_EQ(bench.group.cause, Cause::emergency);
}

TEST(CoordinatedStop, OneServoOffRefusesForAllAndChangesNothing) {
  Bench bench = two_to_one();
  bench.axes[2].switch_servo(false);
  const Coordinated group = bench.group;
  const auto axes = bench.axes;
  EXPECT_EQ(bench.begin(), Cause::servo_off);
  EXPECT_EQ(bench.group, group);
  EXPECT_EQ(bench.axes, axes);
  AxisSettings without;
  without.needs_servo = false;
  bench.axes[2].set(without);
  EXPECT_EQ(bench.begin(), Cause::none);
}

TEST(CoordinatedStop, AnAxisOnALimitMayLeaveItAndMayStandOnItButNotGoOn) {
  struct Row {
    const char* what;
    double x, y;
    bool arrives;
  };
  // X is on its + limit, where a move in + brought it.
  for (const Row& row : {Row{"leaves it", -500, 100, true}, Row{"stands on it", 0, 100, true},
                         Row{"goes on", 500, 100, false}}) {
    Bench bench(by_slope(1000, 1e5));
    bench.environment[0].add(Signal::limit_plus, 1000, 5000);
    bench.axes[0].move(3000, by_slope(10'000, 1e6), 0);
    bench.steps(1000);
    ASSERT_EQ(bench.axes[0].travel_pulses, 1000);
    bench.add(line(place_of(0, 0), place_of(row.x, row.y)));
    ASSERT_EQ(bench.begin(), Cause::none);
    EXPECT_GT(bench.to_the_end(), 0);
    EXPECT_EQ(bench.group.cause, row.arrives ? Cause::arrived : Cause::limit_plus) << row.what;
    if (row.arrives) {
      EXPECT_EQ(bench.travels(), (Travels{1000 + std::llround(row.x), std::llround(row.y), 0, 0}))
          << row.what;
    } else {
      EXPECT_EQ(bench.axes[0].travel_pulses, 1000) << row.what;
    }
  }
}

TEST(CoordinatedStop, TheNextRunBeginsWhereTheyWereStopped) {
  Bench bench = two_to_one();
  bench.environment[0].add(Signal::alarm, 4000, 4020);
  bench.begin();
  bench.to_the_end();
  bench.environment[0] = Environment{.version = bench.environment[0].version + 1};
  bench.steps(5);
  const Travels at = bench.travels();
  const Point from = place_of(static_cast<double>(at[0]), static_cast<double>(at[1]));
  bench.add(line(from, place_of(0, 0)));
  ASSERT_EQ(bench.begin(from), Cause::none);
  EXPECT_GT(bench.to_the_end(), 0);
  EXPECT_EQ(bench.group.cause, Cause::arrived);
  EXPECT_EQ(bench.travels(), (Travels{0, 0, 0, 0}));
}

}  // namespace coordinated_stop_test
}  // namespace understudy::motion
