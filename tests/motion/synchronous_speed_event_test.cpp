// PULSE, C-STA and C-END: which pulses are the first and the last at constant speed, compared with closed
// forms.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "motion/axis.h"
#include "tests/motion/axis_scenario.h"

namespace understudy::motion {
namespace synchronous_speed_event_test {

constexpr Events kConstant = bit(Event::constant_started) | bit(Event::constant_ended);

/// An axis, and its positions at its events.
struct EventBench {
  std::array<Axis, 1> axes{};
  Environment environment;
  Tick now = 0;
  struct Seen {
    Event event;
    std::int64_t at_pulse;
    bool operator==(const Seen&) const = default;
  };
  std::vector<Seen> seen;
  bool last_seen_at_end = false;

  explicit EventBench(Events raises = kConstant) {
    axes[0].switch_servo(true);
    axes[0].settings.raises = raises;
  }
  Axis& axis() { return axes[0]; }

  void step(bool with_care) {
    ++now;
    const std::int64_t base = axis().base_pulses;
    if (with_care) axis().must_recheck = true;
    axis().step(now, environment);
    for (const Event event : {Event::constant_ended, Event::constant_started}) {
      if ((axis().events & bit(event)) == 0) continue;
      const bool runs = axis().drive.moving();
      last_seen_at_end = !runs;
      const Instant at = axis().event_at[static_cast<std::size_t>(event)];
      seen.push_back({event, runs ? axis().drive.direction * axis().drive.pulses_at_moment(at)
                                  : axis().travel_pulses - base});
    }
  }
  void run(Tick max, bool with_care = false) {
    for (const Tick last = now + max; now < last && axis().moving();) {
      ASSERT_NO_FATAL_FAILURE(step(with_care));
    }
  }
};

using Seen = EventBench::Seen;

/// The pulse that is the first one at or beyond `place`; rounding errors do not make it another.
std::int64_t first_pulse_at(double place) {
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(place - 1e-6)));
}

bool is_on_a_pulse(double place) { return std::abs(place - std::round(place)) < 1e-5; }

TEST(SyncSpeedEvent, ATrapezoidHasOneOfEachAtItsPulse) {
  RandomMoves random(seed());
  int seen = 0;
  for (int i = 0; i < random_cases(3000); ++i) {
    const auto start = static_cast<double>(random.of_any_size(1, 5'000));
    const double top = start + static_cast<double>(random.of_any_size(1'000, 200'000));
    const auto up = static_cast<double>(random.of_any_size(20'000, 4'000'000));
    const auto down = static_cast<double>(random.of_any_size(20'000, 4'000'000));
    const std::int64_t distance = random.of_any_size(1, 200'000);
    const double rise = (top * top - start * start) / (2 * up);
    const double fall = static_cast<double>(distance) - (top * top - start * start) / (2 * down);
    if (is_on_a_pulse(rise) || is_on_a_pulse(fall)) continue;
    EventBench bench;
    bench.axis().move(distance,
                      {.start_speed_u_s = start,
                       .top_speed_u_s = top,
                       .up = RampLaw::by_slope(up),
                       .down = RampLaw::by_slope(down)},
                      0);
    ASSERT_NO_FATAL_FAILURE(bench.run(500'000));
    std::vector<Seen> wanted;
    if (first_pulse_at(rise) < first_pulse_at(fall)) {
      wanted = {{Event::constant_started, first_pulse_at(rise)},
                {Event::constant_ended, first_pulse_at(fall)}};
    }
    // If the drive ended in the tick of the event, its pulse cannot be determined any more.
    if (!bench.seen.empty() && bench.last_seen_at_end && !wanted.empty()) {
      for (Seen& one : bench.seen) {
        if (one.event == Event::constant_ended) one.at_pulse = wanted[1].at_pulse;
      }
    }
    // Two in one tick are reported in another order.
    if (bench.seen.size() == 2 && bench.seen[0].event == Event::constant_ended) {
      std::swap(bench.seen[0], bench.seen[1]);
    }
    ASSERT_EQ(bench.seen, wanted) << "seed " << seed() << " case " << i << " start " << start << " top "
                                  << top << " up " << up << " down " << down << " distance " << distance;
    seen += static_cast<int>(wanted.size());
  }
  EXPECT_GT(seen, 100);
}

TEST(SyncSpeedEvent, AConstantDriveBeginsAndEndsWithItsPulses) {
  for (const std::int64_t distance : {1, 2, 25, 10'000}) {
    EventBench bench;
    bench.axis().move(distance, constant(1'700), 0);
    ASSERT_NO_FATAL_FAILURE(bench.run(100'000));
    ASSERT_EQ(bench.seen.size(), 2u) << distance;
    for (const Seen& one : bench.seen) {
      EXPECT_EQ(one.at_pulse, one.event == Event::constant_started ? 1 : distance) << distance;
    }
  }
}

TEST(SyncSpeedEvent, ATriangleHasNone) {
  EventBench bench;
  bench.axis().move(1000, trapezoid(1e6, 1e6), 0);
  ASSERT_NO_FATAL_FAILURE(bench.run(10'000));
  EXPECT_TRUE(bench.seen.empty());
  EXPECT_EQ(bench.axis().travel_pulses, 1000);
}

TEST(SyncSpeedEvent, EachChangeOfSpeedHasItsOwn) {
  // 100 pulses per tick at first. 10,000 pps more or less take 10 ms, and so 1050 or 950 pulses... in pairs.
  EventBench bench;
  bench.axis().run(+1, constant(100'000), 0);
  ASSERT_NO_FATAL_FAILURE(bench.run(10));
  bench.axis().change_speed(trapezoid(110'000, 1e6), bench.now);
  ASSERT_NO_FATAL_FAILURE(bench.run(30));
  bench.axis().change_speed(trapezoid(110'000, 1e6), bench.now);  // the same: nothing changes
  ASSERT_NO_FATAL_FAILURE(bench.run(30));
  bench.axis().slow_down(bench.now);
  ASSERT_NO_FATAL_FAILURE(bench.run(1000));
  ASSERT_EQ(bench.seen.size(), 4u);
  EXPECT_EQ(bench.seen[0], (Seen{Event::constant_started, 1}));
  EXPECT_EQ(bench.seen[1], (Seen{Event::constant_ended, 901}));           // 9 ms at 100, and the next pulse
  EXPECT_EQ(bench.seen[2], (Seen{Event::constant_started, 900 + 1050}));  // (100 + 110) / 2 in 10 ms
  EXPECT_EQ(bench.seen[3].event, Event::constant_ended);
}

TEST(SyncSpeedEvent, AStopAtOnceEndsIt) {
  EventBench bench;
  bench.axis().run(-1, constant(20'000), 0);
  ASSERT_NO_FATAL_FAILURE(bench.run(5));
  bench.axis().stop();
  ASSERT_NO_FATAL_FAILURE(bench.step(false));
  ASSERT_EQ(bench.seen.size(), 2u);
  EXPECT_EQ(bench.seen[1].event, Event::constant_ended);
  EXPECT_EQ(bench.axis().event_at[static_cast<std::size_t>(Event::constant_ended)], (Instant{.tick = 5}));
  EXPECT_EQ(bench.axis().travel_pulses, -80);
}

TEST(SyncSpeedEvent, NothingIsRaisedThatIsNotAskedFor) {
  EventBench bench(0);
  bench.axis().move(5'000, trapezoid(20'000, 1e6), 0);
  Events seen = 0;
  while (bench.axis().moving()) {
    ASSERT_NO_FATAL_FAILURE(bench.step(false));
    seen |= bench.axis().events;
  }
  EXPECT_EQ(seen, bit(Event::started) | bit(Event::ended));
}

TEST(SyncSpeedEvent, APulseIsOncePerTickInWhichThereIsOne) {
  EventBench bench(bit(Event::pulse));
  bench.axis().settings.backlash_pulses = 3;
  bench.axis().settings.backlash_speed_pps = 400;
  bench.axis().last_direction = -1;
  bench.axis().move(40, constant(300), 0);
  int ticks_with_pulses = 0;
  while (bench.axis().moving()) {
    ++bench.now;
    const std::int64_t pulses = bench.axis().step(bench.now, bench.environment);
    ASSERT_EQ((bench.axis().events & bit(Event::pulse)) != 0, pulses != 0) << bench.now;
    ticks_with_pulses += pulses != 0;
  }
  EXPECT_EQ(ticks_with_pulses, 43);  // 3 of backlash
}

TEST(SyncSpeedEvent, HomingHasPulsesButNoConstantSpeed) {
  EventBench bench(kConstant | bit(Event::pulse));
  HomingProgram program{.speeds = {constant(10'000)}};
  program.add({.until = Signal::home, .then = HomingPhase::Then::stop_at_once});
  bench.environment.add(Signal::home, 500, 600);
  bench.axis().home(program, 0);
  Events seen = 0;
  while (bench.axis().moving()) {
    ASSERT_NO_FATAL_FAILURE(bench.step(false));
    seen |= bench.axis().events;
  }
  EXPECT_EQ(seen, bit(Event::started) | bit(Event::ended) | bit(Event::homed) | bit(Event::pulse));
  EXPECT_EQ(bench.axis().travel_pulses, 500);
}

TEST(SyncSpeedEvent, TheShortWayThroughATickRaisesThemToo) {
  RandomMoves random(seed() + 1);
  for (int i = 0; i < random_cases(300); ++i) {
    AxisScenario scenario(static_cast<std::uint64_t>(random.between(1, INT64_MAX)));
    AxisCourse quick = scenario.course();
    quick.axis.settings.raises = static_cast<Events>(random.between(0, 7) << 9);
    AxisCourse careful = quick;
    for (int tick = 0; tick < 1500; ++tick) {
      const auto command = scenario.next();
      const std::int64_t counts = scenario.counts();
      for (AxisCourse* course : {&quick, &careful}) {
        const Events raises = course->axis.settings.raises;
        act(command, *course);
        course->axis.settings.raises = raises;
      }
      careful.axis.must_recheck = true;
      ASSERT_EQ(step(quick, counts), step(careful, counts)) << scenario.code() << " " << quick.now;
      ASSERT_EQ(quick.axis.events, careful.axis.events) << scenario.code() << " " << quick.now;
      ASSERT_EQ(quick.axis.event_at, careful.axis.event_at) << scenario.code() << " " << quick.now;
      ASSERT_EQ(quick.axis.constant_pps, careful.axis.constant_pps) << scenario.code() << " " << quick.now;
    }
  }
}

}  // namespace synchronous_speed_event_test
}  // namespace understudy::motion
