// TAPZ, TAREDO, TAUPZ, TASTOP: every cell of the manual's table, on the path, with the total time.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/emulator/models/slim/one_chain.h"

namespace understudy::emulator::models::slim {
namespace pause_test {

constexpr int kPulses = 1000;

OneChain at_origin(const ChainOptions& options = {}) {
  OneChain bench(options);
  bench.map({0, 1});
  bench.scale_all(kPulses);
  return bench;
}

/// 50 east, then half a circle to (50, 100): one length, and the position on it.
constexpr double kLine = 50;
constexpr double kArc = 50 * std::numbers::pi;

void line_and_arc(OneChain& bench, int mode = 1) {
  bench.chain.set_continuous_path(mode);
  ASSERT_EQ(bench.line({kLine, 0}), Error::none);
  ASSERT_EQ(bench.chain.arc({.centre_x_units = 50, .centre_y_units = 50, .sweep_deg = 180}), Error::none);
}

/// Returns how far the modules are from the nearest point of that path, in pulses, and how far along it they
/// are.
struct OnPath {
  double off_pulses = 0;
  double along = 0;
};
OnPath on_path(const OneChain& bench) {
  const double x = bench.chain.coordinate(0);
  const double y = bench.chain.coordinate(1);
  const bool in_arc = x > 50 || y > 0;
  const double off = in_arc ? std::hypot(x - 50, y - 50) - 50 : y;
  return {.off_pulses = std::abs(off) * kPulses,
          .along = in_arc ? kLine + 50 * std::atan2(x - 50, 50 - y) : x};
}
/// Half a pulse in each axis.
const double kHalfEach = std::sqrt(0.5) + 1e-6;

TEST(SlimPause, SlowsDownOnThePathAndContinuesExactlyThere) {
  // Within the first command; so late in it that the stop lies beyond its end (from 45 on, 5 units are
  // needed); within the second; while it accelerates; while it decelerates for the end.
  for (const Tick pause_at : std::initializer_list<Tick>{50, 300, 520, 545, 900, 2100}) {
    SCOPED_TRACE(pause_at);
    OneChain bench = at_origin();
    line_and_arc(bench);
    const Trapezoid whole{kLine + kArc, 100, 1000};
    bench.steps(pause_at + 1);
    ASSERT_EQ(bench.chain.pause(), Error::none);
    // Speed and position by the closed form, and where it stops from there.
    const double t = static_cast<double>(pause_at) / 1000;
    const double s = whole.at(t);
    const double remaining_s = whole.duration_s() - t;
    const double v = std::min({100.0, 1000 * t, 1000 * remaining_s});
    const double stop = s + v * v / 2000;
    for (Tick i = 0; i < ticks_of(v / 1000); ++i) {
      EXPECT_TRUE(bench.chain.moving(0));
      bench.step();
      EXPECT_LE(on_path(bench).off_pulses, kHalfEach);
    }
    EXPECT_FALSE(bench.chain.moving(0));
    EXPECT_NEAR(on_path(bench).along, stop, 1e-3);
    EXPECT_TRUE(bench.chain.status(0).paused);
    EXPECT_EQ(bench.chain.next_active_tick(bench.tick),
              bench.chain.module_at(0).sent_pulses + bench.chain.module_at(1).sent_pulses == 0
                  ? kNever
                  : bench.tick + 1);
    bench.steps(777);
    EXPECT_NEAR(on_path(bench).along, stop, 1e-3);
    ASSERT_EQ(bench.chain.resume(), Error::none);
    const Tick resumed = bench.tick;
    while (!bench.all_done() && bench.tick < resumed + 10'000) {
      bench.step();
      EXPECT_LE(on_path(bench).off_pulses, kHalfEach);
    }
    const double left = kLine + kArc - stop;
    EXPECT_EQ(bench.tick - resumed - 1, left < 1e-9 ? 0 : ticks_of(Trapezoid{left, 100, 1000}.duration_s()));
    EXPECT_EQ(bench.travel(0), 50 * kPulses);
    EXPECT_EQ(bench.travel(1), 100 * kPulses);
  }
}

TEST(SlimPause, WithoutContinuousPathItStopsAtTheNextBorder) {
  OneChain bench = at_origin();
  line_and_arc(bench, 0);
  bench.steps(1 + 570);  // 600 ms for the line; decelerating since 500
  bench.chain.pause();
  bench.steps(200);
  EXPECT_EQ(bench.travel(0), 50 * kPulses);
  EXPECT_EQ(bench.travel(1), 0);
  const Tick resumed = bench.tick;
  bench.chain.resume();
  bench.finish();
  // The arc starts from rest; it needs a tick to detect that its line has ended.
  EXPECT_NEAR(static_cast<double>(bench.tick - resumed - 1),
              static_cast<double>(ticks_of(Trapezoid{kArc, 100, 1000}.duration_s())), 1);
}

TEST(SlimPause, GoingOnBeforeItStandsSpeedsUpAgain) {
  OneChain bench = at_origin();
  bench.line({100, 0});
  bench.steps(501);  // at 100 units/s, 45 units done
  bench.chain.pause();
  bench.steps(50);  // at 50, 3.75 further
  bench.chain.resume();
  bench.finish();
  // Up again in 50 ms and 3.75, then 100 - 45 - 7.5 - 5 = 42.5 at speed, 100 ms down.
  EXPECT_EQ(bench.tick - 1, 500 + 50 + 50 + 425 + 100);
  EXPECT_EQ(bench.travel(0), 100 * kPulses);
}

TEST(SlimPause, SingleMovesPauseAndContinueAsWell) {
  OneChain bench = at_origin();
  bench.speeds(5, 1000, 1000);  // 1 unit/s
  bench.chain.move(5, true, 4);
  bench.steps(2001);  // 0.5 + 1 units
  bench.chain.pause();
  EXPECT_EQ(bench.chain.move(6, true, 4), Error::paused);
  bench.steps(1500);
  EXPECT_FALSE(bench.chain.moving(5));
  EXPECT_EQ(bench.travel(5), 2000);
  EXPECT_FALSE(bench.chain.done(5));
  Tick resumed = bench.tick;
  bench.chain.resume();
  bench.finish();
  EXPECT_EQ(bench.tick - resumed - 1, 3000);  // 2/1 + 1
  EXPECT_EQ(bench.travel(5), 4000);
  // And before it stops: 0.5 s down from 1 to 0.5 (0.375), and the same up.
  bench.chain.move(5, false, 4);
  const Tick began = bench.tick;
  bench.steps(2001);
  bench.chain.pause();
  bench.steps(500);
  bench.chain.resume();
  bench.finish();
  EXPECT_EQ(bench.tick - began - 1, 2000 + 500 + 500 + 1250 + 1000);
  EXPECT_EQ(bench.travel(5), 8000);
}

// ---- The table

TEST(SlimPauseTable, RunAndTapz) {
  OneChain bench = at_origin();
  EXPECT_EQ(bench.chain.pause(), Error::none);  // even when idle
  EXPECT_TRUE(bench.chain.paused());
  bench.step();  // the first tick, in which every axis updates its environment
  EXPECT_EQ(bench.chain.next_active_tick(bench.tick), kNever);
}

TEST(SlimPauseTable, RunAndTaredoOrTaupzHaveNoEffect) {
  for (const bool refused : {false, true}) {
    ChainOptions options;
    if (refused) options.choose(option("ineffective_pause", "error_3"));
    OneChain bench = at_origin(options);
    bench.line({100, 0});
    bench.steps(300);
    const Chain before = bench.chain;
    const Error answer = refused ? Error::not_allowed : Error::none;
    EXPECT_EQ(bench.chain.resume(), answer);
    EXPECT_EQ(bench.chain.discard(), answer);
    EXPECT_EQ(bench.chain.resume_queues(), answer);
    EXPECT_EQ(bench.chain, before);
  }
}

TEST(SlimPauseTable, RunAndTastopStopsNowAndForgetsEverything) {
  OneChain bench = at_origin();
  line_and_arc(bench);
  bench.chain.move(5, true, 50);
  bench.chain.move(5, true, 0);
  bench.chain.jog(6, +1);
  bench.chain.thrust(7, 100);
  bench.chain.set_output(0, 1, true);  // after the motion: discarded with it
  bench.steps(300);
  const std::array<std::int64_t, 3> at{bench.travel(0), bench.travel(5), bench.travel(6)};
  ASSERT_GT(at[0], 0);
  ASSERT_GT(at[1], 0);
  ASSERT_GT(at[2], 0);
  EXPECT_EQ(bench.chain.emergency_stop(), Error::none);
  EXPECT_TRUE(bench.all_done());
  EXPECT_FALSE(bench.chain.paused());
  bench.steps(1000);
  EXPECT_EQ((std::array<std::int64_t, 3>{bench.travel(0), bench.travel(5), bench.travel(6)}), at);
  EXPECT_FALSE(bench.chain.output(0, 1));
  for (int module = 0; module < kModules; ++module) {
    EXPECT_TRUE(bench.chain.axis(module).servo_on);
    EXPECT_FALSE(bench.chain.moving(module));
    EXPECT_EQ(bench.chain.module_at(module).fifo.size(), 0U);
  }
  // Motion is accepted at once, and starts from the present position.
  const double x = bench.chain.coordinate(0);
  EXPECT_EQ(bench.line({10, 0}), Error::none);
  bench.finish();
  EXPECT_NEAR(bench.chain.coordinate(0), x + 10, 1e-9);
}

TEST(SlimPauseTable, PauseAndTapzAgainHasNoEffect) {
  OneChain bench = at_origin();
  bench.line({100, 0});
  bench.steps(500);
  bench.chain.pause();
  bench.steps(30);
  const Chain before = bench.chain;
  bench.chain.pause();
  EXPECT_EQ(bench.chain, before);
}

TEST(SlimPauseTable, PauseRefusesMotionAndAcceptsTheRest) {
  OneChain bench = at_origin();
  bench.line({100, 0});
  bench.steps(500);
  bench.chain.pause();
  for (const Tick later : {0, 10, 500}) {  // from this moment on
    bench.steps(later);
    EXPECT_EQ(bench.line({1, 1}), Error::paused);
    EXPECT_EQ(bench.chain.arc({.centre_x_units = 1, .sweep_deg = 10}), Error::paused);
    EXPECT_EQ(bench.chain.spiral(1, 0, 10, 1), Error::paused);
    EXPECT_EQ(bench.chain.move(5, true, 1), Error::paused);
    EXPECT_EQ(bench.chain.move_axis(Letter::x, true, 1), Error::paused);
    EXPECT_EQ(bench.chain.home(5), Error::paused);
    EXPECT_EQ(bench.chain.jog(5, 1), Error::paused);
    EXPECT_EQ(bench.chain.thrust(5, 1), Error::paused);
    EXPECT_EQ(bench.chain.jog(5, 0), Error::none);
    EXPECT_EQ(bench.chain.set_output(5, 1, later == 0), Error::none);
    EXPECT_EQ(bench.chain.output(5, 1), later == 0);
    EXPECT_EQ(bench.chain.set_output_at_once(0, 2, true), Error::none);
    EXPECT_EQ(bench.chain.set_coordinate(5, 3), Error::none);
    EXPECT_EQ(bench.chain.coordinate(5), 3);
    EXPECT_EQ(bench.chain.set_continuous_path(1), Error::none);
    EXPECT_EQ(bench.chain.assign(Letter::w, 4), Error::none);
  }
}

TEST(SlimPauseTable, TvmInPauseCountsFromThenOn) {
  OneChain bench = at_origin();
  bench.line({100, 0});
  bench.steps(501);  // 45, and 5 to stop
  bench.chain.pause();
  bench.steps(200);
  EXPECT_EQ(bench.chain.settings().set_tvm(50), Error::none);
  bench.steps(10);
  EXPECT_EQ(bench.travel(0), 50 * kPulses);
  const Tick resumed = bench.tick;
  bench.chain.resume();
  bench.finish();
  EXPECT_EQ(bench.tick - resumed - 1, 1050);  // 50/50 + 50/1000
}

TEST(SlimPauseTable, PauseAndTaupzDiscardsAndAcceptsMotionAgain) {
  for (const Tick wait : {0, 40, 300}) {  // even while it decelerates: then it decelerates to the end
    OneChain bench = at_origin();
    line_and_arc(bench);
    bench.chain.move(5, true, 50);
    bench.steps(521);  // 47 done: stops at 52, beyond the joint
    bench.chain.pause();
    bench.steps(wait);
    EXPECT_EQ(bench.chain.discard(), Error::none);
    EXPECT_FALSE(bench.chain.paused());
    EXPECT_EQ(bench.chain.module_at(0).fifo.size(), 0U);
    // 2MA back to the origin: starts from rest, from its present position.
    EXPECT_EQ(bench.line({0, 0}, true), Error::none);
    while (bench.chain.moving(0) && wait < 100 && bench.tick < 521 + 100) {
      bench.step();
      EXPECT_LE(on_path(bench).off_pulses, kHalfEach);
    }
    if (wait < 100) {
      EXPECT_NEAR(on_path(bench).along, 52, 1e-3);
    }
    bench.finish();
    EXPECT_EQ(bench.travel(0), 0);
    EXPECT_EQ(bench.travel(1), 0);
  }
}

TEST(SlimPauseTable, PauseAndTastopIsIdleAndNotPaused) {
  OneChain bench = at_origin();
  bench.line({100, 0});
  bench.steps(501);
  bench.chain.pause();
  bench.steps(50);
  const std::int64_t at = bench.travel(0);
  EXPECT_EQ(bench.chain.emergency_stop(), Error::none);
  EXPECT_FALSE(bench.chain.paused());
  bench.steps(500);
  EXPECT_EQ(bench.travel(0), at);
  EXPECT_EQ(bench.line({1, 1}), Error::none);
}

}  // namespace pause_test
}  // namespace understudy::emulator::models::slim
