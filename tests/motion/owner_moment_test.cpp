// Moments between edges that the owner of the axes finds, in a number that it calculates from several axes.
#include <gtest/gtest.h>

#include "motion/bisection.h"
#include "motion/shared_tick.h"
#include "motion/tick.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace owner_moment_test {

constexpr double kTick_s = 1 / kTicksPerSecond;

/// X goes forwards and Y backwards. Stops both when they are `apart` pulses from each other.
struct Watcher final : EdgeOwner {
  std::int64_t apart = 0;
  int asked = 0;
  int reported = 0;

  static Instant instant(SharedTick& now, double at_s) {
    return at_s >= kTick_s ? Instant{.tick = now.tick()} : Instant{.tick = now.tick() - 1, .after_s = at_s};
  }
  void at_edge(SharedTick&, std::size_t, Events) override {}
  std::optional<Instant> next_moment(SharedTick& now, const Instant& until) override {
    ++asked;
    const auto seconds = [&](const Instant& at) { return at.tick == now.tick() ? kTick_s : at.after_s; };
    const auto are_apart = [&](double at_s) {
      const Instant at = instant(now, at_s);
      return now.place_ahead(0, at).travel_pulses - now.place_ahead(1, at).travel_pulses >= apart;
    };
    if (reported != 0 || !are_apart(seconds(until))) return std::nullopt;
    if (are_apart(seconds(now.now()))) return now.now();
    return instant(now, turnover(seconds(now.now()), seconds(until), are_apart).after);
  }
  void at_moment(SharedTick& now) override {
    ++reported;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      now.bring(axis);
      now.axes()[axis].stop(Cause::comparator, now.now());
    }
  }
};

struct WatchedBench {
  std::array<Axis, 2> axes{};
  std::array<Environment, 2> environment{};
  Watcher watcher;
  Tick tick = 0;

  WatchedBench(std::int64_t x_pps, std::int64_t y_pps) {
    for (Axis& axis : axes) axis.switch_servo(true);
    run(axes[0], +1, x_pps);
    run(axes[1], -1, y_pps);
  }
  static void run(Axis& axis, int direction, std::int64_t pps) {
    const auto speed = static_cast<double>(pps);
    const SpeedLaw law{.start_speed_u_s = speed,
                       .top_speed_u_s = speed,
                       .up = RampLaw::by_slope(1e9),
                       .down = RampLaw::by_slope(1e9)};
    ASSERT_EQ(axis.run(direction, law, 0), Cause::none);
  }
  void step(Tick ticks, std::uint32_t watched) {
    for (const Tick last = tick + ticks; tick < last && watcher.reported == 0;) {
      std::array<std::int64_t, 2> pulses{};
      step_together(
          {.tick = ++tick, .axes = axes, .environment = environment, .pulses = pulses, .watched = watched},
          0b11, nullptr, &watcher);
    }
  }
};

TEST(OwnerMoment, IsThePulseAtWhichTwoAxesAreSoFarApart) {
  RandomMoves random(seed());
  for (int i = 0; i < random_cases(2000); ++i) {
    const std::int64_t x_pps = random.of_any_size(500, 4'000'000);
    const std::int64_t y_pps = random.of_any_size(500, 4'000'000);
    WatchedBench bench(x_pps, y_pps);
    bench.watcher.apart = random.of_any_size(1, 1 + (x_pps + y_pps) / 100);
    // X sends its pulse n at n / x, and Y at n / y.
    std::int64_t x = 0, y = 0;
    bool together = false;
    while (x + y < bench.watcher.apart) {
      together = (x + 1) * y_pps == (y + 1) * x_pps;
      (x + 1) * y_pps < (y + 1) * x_pps ? ++x : ++y;
    }
    if (together) continue;  // either is right
    bench.step(100, 0b11);
    const std::string what = "x " + std::to_string(x_pps) + " y " + std::to_string(y_pps) + " apart " +
                             std::to_string(bench.watcher.apart) +
                             " UNDERSTUDY_SEED=" + std::to_string(seed());
    ASSERT_EQ(bench.watcher.reported, 1) << what;
    ASSERT_EQ(bench.axes[0].travel_pulses, x) << what;
    ASSERT_EQ(bench.axes[1].travel_pulses, -y) << what;
    for (const Axis& axis : bench.axes) {
      ASSERT_FALSE(axis.moving());
      ASSERT_EQ(axis.cause, Cause::comparator);
    }
  }
}

TEST(OwnerMoment, IsNotLookedForInTicksThatAreNotWatched) {
  WatchedBench bench(1000, 1000);
  bench.watcher.apart = 10;
  bench.step(20, 0);
  EXPECT_EQ(bench.watcher.asked, 0);
  EXPECT_GT(bench.axes[0].travel_pulses, bench.watcher.apart);
  bench.step(1, 0b11);
  EXPECT_EQ(bench.watcher.reported, 1);
}

}  // namespace owner_moment_test
}  // namespace understudy::motion
