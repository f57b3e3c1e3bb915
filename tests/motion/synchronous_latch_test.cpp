// Latches: exact to the pulse at the moment of the event, compared with closed forms in whole numbers.
#include <gtest/gtest.h>

#include "motion/synchronous.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace synchronous_latch_test {

SpeedLaw at_speed(std::int64_t pps) {
  const auto speed = static_cast<double>(pps);
  return {.start_speed_u_s = speed,
          .top_speed_u_s = speed,
          .up = RampLaw::by_slope(1e9),
          .down = RampLaw::by_slope(1e9)};
}

struct LatchBench final : EdgeOwner {
  std::array<Axis, 3> axes{};
  Environment nowhere;
  std::array<Environment, 3> environment{};
  SyncTable table;
  Tick tick = 0;
  std::array<bool, 3> has_fired{};

  LatchBench() {
    for (Axis& axis : axes) axis.switch_servo(true);
    for (SyncAction& action : table.actions) action.latch_command = true;
  }
  void at_edge(SharedTick& now, std::size_t axis, Events events) override {
    if (act(table, axis, events, now).fired != 0) has_fired[axis] = true;
  }
  /// Steps until the trigger fires; false if it does not within `max` ticks.
  bool fires(std::size_t trigger, Tick max) {
    for (const Tick last = tick + max; tick < last;) {
      ++tick;
      has_fired = {};
      std::array<std::int64_t, 3> pulses{};
      step_together({tick, axes, environment, pulses}, 0b111, nullptr, this);
      if (has_fired[trigger]) return true;
    }
    return false;
  }
  std::int64_t latched(std::size_t axis) const { return table.latches[axis].travel_pulses; }
};

TEST(SyncLatch, AtAComparatorsEdgeItIsThePulseOfBothAxes) {
  RandomMoves random(seed());
  for (int i = 0; i < random_cases(20'000); ++i) {
    LatchBench bench;
    const std::int64_t x_pps = random.of_any_size(500, 4'000'000);
    const std::int64_t y_pps = random.of_any_size(500, 4'000'000);
    const std::int64_t edge = random.of_any_size(1, 1 + x_pps / 20);
    const int x_way = random.between(0, 1) == 0 ? 1 : -1;
    const int y_way = random.between(0, 1) == 0 ? 1 : -1;
    const auto number = static_cast<std::size_t>(random.between(0, 3));
    // Forwards at >= edge; backwards at < -edge + 1, the pulse -edge.
    const Comparator comparator =
        x_way > 0 ? Comparator{.relation = Comparator::Relation::at_least, .value = edge}
                  : Comparator{.relation = Comparator::Relation::below, .value = -edge + 1};
    bench.axes[0].set_comparator(number, comparator);
    bench.table.triggers[0] = {.factors = static_cast<std::uint8_t>(1U << number), .activates = 0b111};
    ASSERT_EQ(bench.axes[0].run(x_way, at_speed(x_pps), 0), Cause::none);
    ASSERT_EQ(bench.axes[1].run(y_way, at_speed(y_pps), 0), Cause::none);
    ASSERT_TRUE(bench.fires(0, 100));
    const std::string what = "x " + std::to_string(x_pps * x_way) + " y " + std::to_string(y_pps * y_way) +
                             " edge " + std::to_string(edge) + " UNDERSTUDY_SEED=" + std::to_string(seed());
    ASSERT_EQ(bench.latched(0), x_way * edge) << what;
    // X sends its pulse n at n / x; by then Y has sent floor(n y / x). If Y's is sent at that very moment,
    // either is right.
    const std::int64_t y = bench.latched(1) * y_way;
    const bool together = edge * y_pps % x_pps == 0;
    ASSERT_TRUE(y == edge * y_pps / x_pps || (together && y == edge * y_pps / x_pps - 1))
        << what << ": " << y;
    ASSERT_EQ(bench.latched(2), 0);
    ASSERT_TRUE(bench.table.latches[2].taken);
  }
}

TEST(SyncLatch, DuringARampTheOtherAxisIsLatchedByTheRampsTime) {
  RandomMoves random(seed() + 1);
  for (int i = 0; i < random_cases(5000); ++i) {
    LatchBench bench;
    // X from rest with slope a: its pulse n at sqrt(2 n / a).
    const std::int64_t slope = random.of_any_size(10'000, 100'000'000);
    const std::int64_t edge = random.of_any_size(1, 1 + slope / 200);  // within 0.1 s
    const std::int64_t y_pps = random.of_any_size(500, 1'000'000);
    bench.axes[0].set_comparator(0, {.relation = Comparator::Relation::at_least, .value = edge});
    bench.table.triggers[0] = {.factors = static_cast<std::uint8_t>(bit(Event::comparator_0)),
                               .activates = 0b11};
    const SpeedLaw ramp{.top_speed_u_s = 1e9,
                        .up = RampLaw::by_slope(static_cast<double>(slope)),
                        .down = RampLaw::by_slope(1e9)};
    ASSERT_EQ(bench.axes[0].run(+1, ramp, 0), Cause::none);
    ASSERT_EQ(bench.axes[1].run(+1, at_speed(y_pps), 0), Cause::none);
    ASSERT_TRUE(bench.fires(0, 200));
    ASSERT_EQ(bench.latched(0), edge);
    const long double y = std::sqrt(2.0L * static_cast<long double>(edge) / static_cast<long double>(slope)) *
                          static_cast<long double>(y_pps);
    const std::int64_t pulses = bench.latched(1);
    // A pulse that is due within 1e-6 of one may count or not.
    ASSERT_LE(static_cast<long double>(pulses), y + 1e-6L) << slope << " " << edge << " " << y_pps;
    ASSERT_GT(static_cast<long double>(pulses), y - 1 - 1e-6L) << slope << " " << edge << " " << y_pps;
  }
}

TEST(SyncLatch, AtAMarksPlaceItIsThePulseOfTheMark) {
  for (const std::int64_t place : {1, 7, 1000, 4001}) {
    LatchBench bench;
    bench.environment[0].add(Signal::mark, place, place + 10);
    bench.table.triggers[0] = {.factors = static_cast<std::uint8_t>(bit(Event::mark_on)), .activates = 0b11};
    bench.axes[0].run(+1, at_speed(123'457), 0);
    bench.axes[1].run(-1, at_speed(1'000'000), 0);
    ASSERT_TRUE(bench.fires(0, 100));
    EXPECT_EQ(bench.latched(0), place);
    EXPECT_EQ(bench.latched(1), -(place * 1'000'000 / 123'457));
  }
}

TEST(SyncLatch, ExtraEdgesInATickDoNotCountAndTheLastLatchStays) {
  // 100 pulses per tick; C+ at 10, and C- at 90 in the same tick.
  for (const std::uint8_t factor : {std::uint8_t{1}, std::uint8_t{8}, std::uint8_t{9}}) {
    LatchBench bench;
    bench.axes[0].set_comparator(0, {.relation = Comparator::Relation::at_least, .value = 10});
    bench.axes[0].set_comparator(3, {.relation = Comparator::Relation::at_least, .value = 90});
    bench.table.triggers[0] = {.factors = factor, .activates = 0b11};
    bench.axes[0].run(+1, at_speed(100'000), 0);
    bench.axes[1].run(+1, at_speed(10'000), 0);
    ASSERT_TRUE(bench.fires(0, 10));
    EXPECT_EQ(bench.latched(0), factor == 1 ? 10 : 90);
    EXPECT_EQ(bench.latched(1), factor == 1 ? 1 : 9);
  }
}

TEST(SyncLatch, AnAxisStoppedInTheSameTickIsLatchedAtTheEvent) {
  // X's edge stops Z at once; Y's edge, in the same tick, latches Z.
  LatchBench bench;
  bench.axes[0].set_comparator(0, {.relation = Comparator::Relation::at_least, .value = 30});
  bench.axes[1].set_comparator(0, {.relation = Comparator::Relation::at_least, .value = 10});
  const auto factor = static_cast<std::uint8_t>(bit(Event::comparator_0));
  bench.table.triggers[0] = {.factors = factor, .activates = 0b100};
  bench.table.triggers[1] = {.factors = factor, .activates = 0b100};
  bench.table.actions[2].drive = SyncAction::Drive::stop_at_once;
  for (Axis& axis : bench.axes) axis.run(+1, at_speed(100'000), 0);
  ASSERT_TRUE(bench.fires(0, 100));
  EXPECT_EQ(bench.latched(2), 10);
  EXPECT_EQ(bench.axes[2].travel_pulses, 10);  // and has been stopped there, too
  EXPECT_FALSE(bench.axes[2].moving());
}

TEST(SyncLatch, TheEncoderIsLatchedAsItWasTold) {
  LatchBench bench;
  bench.table.actions = {};
  bench.table.actions[1].latch_encoder = true;
  bench.axes[1].set_encoder(-4711);
  bench.table.triggers[0] = {.factors = static_cast<std::uint8_t>(bit(Event::started)), .activates = 0b111};
  bench.axes[0].run(+1, at_speed(1000), 0);
  ASSERT_TRUE(bench.fires(0, 2));
  EXPECT_EQ(bench.table.latches[1].encoder_pulses, -4711);
  EXPECT_EQ(bench.table.latches[1].travel_pulses, 0);
  EXPECT_TRUE(bench.table.latches[1].taken);
  EXPECT_FALSE(bench.table.latches[0].taken);
  EXPECT_FALSE(bench.table.latches[2].taken);
}

TEST(SyncLatch, AnEndIsOfItsMomentInTheTick) {
  LatchBench bench;
  bench.table.triggers[0] = {.factors = static_cast<std::uint8_t>(bit(Event::ended)), .activates = 0b11};
  bench.axes[0].move(25, at_speed(10'000), 0);  // 2.5 ticks
  bench.axes[1].run(+1, at_speed(10'000), 0);
  ASSERT_TRUE(bench.fires(0, 10));
  EXPECT_EQ(bench.tick, 4);
  EXPECT_EQ(bench.latched(0), 25);
  EXPECT_EQ(bench.latched(1), 25);
}

}  // namespace synchronous_latch_test
}  // namespace understudy::motion
