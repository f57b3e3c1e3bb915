// TAPZ, TAREDO, TAUPZ, TASTOP: every cell of the manual's table, on the path, with the total time.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/emulator/devices/slim/one_chain.h"

namespace understudy::emulator::slim {
namespace {

constexpr int kPulses = 1000;

OneChain at_origin(const ChainOptions& options = {}) {
  OneChain bench(options);
  bench.map({0, 1});
  bench.scale_all(kPulses);
  return bench;
}

/// 50 east, then half a circle to (50, 100): one length, and the place on it.
constexpr double kLine = 50;
constexpr double kArc = 50 * std::numbers::pi;

void line_and_arc(OneChain& bench, int mode = 1) {
  bench.chain.set_continuous_path(mode);
  ASSERT_EQ(bench.line({kLine, 0}), Error::none);
  ASSERT_EQ(bench.chain.arc({.centre_x_units = 50, .centre_y_units = 50, .sweep_deg = 180}), Error::none);
}

/// How far the modules are from the nearest place of that path, in pulses, and how far along it.
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

TEST(SlimPause, SlowsDownOnThePathAndGoesOnExactlyThere) {
  // Within the first command; so late in it that the stop lies beyond its end (from 45 on, 5 units are
  // needed); within the second; while it speeds up; while it slows down for the end.
  for (const Tick pause_at : std::initializer_list<Tick>{50, 300, 520, 545, 900, 2100}) {
    SCOPED_TRACE(pause_at);
    OneChain bench = at_origin();
    line_and_arc(bench);
    const Trapezoid whole{kLine + kArc, 100, 1000};
    bench.steps(pause_at + 1);
    ASSERT_EQ(bench.chain.pause(), Error::none);
    // Speed and place by the closed form, and where it stops from there.
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
              bench.chain.pulses(0) + bench.chain.pulses(1) == 0 ? kNever : bench.tick + 1);
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

TEST(SlimPause, WithoutContinuousPathItStopsAtTheBorderThatItSlowsDownForAnyhow) {
  OneChain bench = at_origin();
  line_and_arc(bench, 0);
  bench.steps(1 + 570);  // 600 ms for the line; slowing down since 500
  bench.chain.pause();
  bench.steps(200);
  EXPECT_EQ(bench.travel(0), 50 * kPulses);
  EXPECT_EQ(bench.travel(1), 0);
  const Tick resumed = bench.tick;
  bench.chain.resume();
  bench.finish();
  // The arc begins from rest; the run needs a tick to see that its line is over.
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

TEST(SlimPause, SingleMovesPauseAndGoOnAsWell) {
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
  // And before it stands: 0.5 s down from 1 to 0.5 (0.375), the same up.
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
  EXPECT_EQ(bench.chain.pause(), Error::none);  // idle as well
  EXPECT_TRUE(bench.chain.paused());
  bench.step();  // the first one, in which every axis looks around
  EXPECT_EQ(bench.chain.next_active_tick(bench.tick), kNever);
}

TEST(SlimPauseTable, RunAndTaredoOrTaupzHaveNoEffect) {
  for (const bool refused : {false, true}) {
    ChainOptions options;
    if (refused) options.in_vain = ChainOptions::InVain::refused;
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
  bench.chain.set_output(0, 1, true);  // behind the motion: forgotten with it
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
    EXPECT_TRUE(bench.chain.servo_on(module));
    EXPECT_FALSE(bench.chain.moving(module));
    EXPECT_EQ(bench.chain.queued(module), 0U);
  }
  // Motion is accepted at once, and counts from where it stands.
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
  for (const Tick later : {0, 10, 500}) {  // from the instant on
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
  EXPECT_EQ(bench.chain.set_tvm(50), Error::none);
  bench.steps(10);
  EXPECT_EQ(bench.travel(0), 50 * kPulses);
  const Tick resumed = bench.tick;
  bench.chain.resume();
  bench.finish();
  EXPECT_EQ(bench.tick - resumed - 1, 1050);  // 50/50 + 50/1000
}

TEST(SlimPauseTable, PauseAndTaupzDiscardsAndAcceptsMotionAgain) {
  for (const Tick wait : {0, 40, 300}) {  // while it slows down, too: then it does so to the end
    OneChain bench = at_origin();
    line_and_arc(bench);
    bench.chain.move(5, true, 50);
    bench.steps(521);  // 47 done: stops at 52, beyond the border
    bench.chain.pause();
    bench.steps(wait);
    EXPECT_EQ(bench.chain.discard(), Error::none);
    EXPECT_FALSE(bench.chain.paused());
    EXPECT_EQ(bench.chain.queued(0), 0U);
    // 2MA back to the origin: begins from rest, from where it stands then.
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

/// At 1000 pulses a second, reached within 0.1 s and 50 pulses.
OneChain at_jog(const ChainOptions& options = {}) {
  OneChain bench(options);
  bench.speeds(6, 10'000, 10'000);
  bench.jog_speed(6, 1000);
  bench.chain.jog(6, +1);
  bench.steps(1001);
  EXPECT_EQ(bench.travel(6), 950);
  return bench;
}

TEST(SlimPauseTable, AJogGoesOnAfterThePause) {
  OneChain bench = at_jog();
  bench.chain.pause();
  EXPECT_EQ(bench.chain.move(6, false, 5), Error::paused);
  bench.steps(1000);
  EXPECT_EQ(bench.travel(6), 1000);
  EXPECT_FALSE(bench.chain.moving(6));
  EXPECT_TRUE(bench.chain.busy(6));
  // What is to be done in its turn is not done in between.
  EXPECT_EQ(bench.chain.set_coordinate(6, 7), Error::none);
  EXPECT_EQ(bench.chain.coordinate(6), 1000);
  bench.chain.resume();
  bench.steps(1001);
  EXPECT_EQ(bench.travel(6), 1950);
  EXPECT_EQ(bench.chain.status(6).mode, Mode::jog);
  bench.chain.jog(6, 0);
  bench.finish();
  EXPECT_EQ(bench.travel(6), 2000);
  EXPECT_EQ(bench.chain.coordinate(6), 7);
  EXPECT_FALSE(bench.chain.busy(6));
}

TEST(SlimPauseTable, AJogGoesOnBeforeItStands) {
  OneChain bench = at_jog();
  bench.chain.pause();
  bench.steps(50);
  bench.chain.resume();
  bench.steps(50);
  EXPECT_DOUBLE_EQ(bench.chain.speed_pps(6), 1000);
  EXPECT_EQ(bench.travel(6), 950 + 75);
}

TEST(SlimPauseTable, AMoveBehindAJogStillWaitsAfterThePause) {
  OneChain bench = at_jog();
  EXPECT_EQ(bench.chain.move(6, false, 500), Error::none);
  bench.chain.pause();
  bench.steps(200);
  bench.chain.resume();
  bench.steps(1001);
  EXPECT_EQ(bench.travel(6), 1950);
  bench.chain.jog(6, 0);
  bench.finish();
  EXPECT_EQ(bench.travel(6), 2500);
}

TEST(SlimPauseTable, WhatAJogWasAboutToBeGoesOn) {
  // Turning round, and being stopped, when the pause comes.
  OneChain turning = at_jog();
  turning.chain.jog(6, -1);
  turning.steps(50);
  turning.chain.pause();
  turning.steps(200);
  EXPECT_EQ(turning.travel(6), 1000);
  turning.chain.pause_queues();  // another pause changes nothing
  turning.chain.resume_queues();
  turning.chain.resume();
  turning.steps(1001);
  EXPECT_EQ(turning.travel(6), 50);

  for (const bool before : {false, true}) {  // JG0 before the pause, and in it
    OneChain stopping = at_jog();
    if (before) stopping.chain.jog(6, 0);
    stopping.steps(50);
    stopping.chain.pause();
    if (!before) stopping.chain.jog(6, 0);
    stopping.steps(200);
    stopping.chain.resume();
    stopping.steps(200);
    EXPECT_FALSE(stopping.chain.busy(6));
    EXPECT_EQ(stopping.travel(6), before ? 1000 : 1050);
  }
}

TEST(SlimPauseTable, AJogIsGivenUpAndStoppedLikeAnything) {
  for (int how = 0; how < 5; ++how) {
    OneChain bench = at_jog();
    bench.chain.pause();
    bench.steps(how == 0 ? 50 : 200);
    switch (how) {
      case 0:
      case 1: bench.chain.discard(); break;
      case 2: bench.chain.emergency_stop(); break;
      case 3: bench.chain.clear_queues(); break;
      default: bench.chain.reset(6); break;
    }
    bench.chain.resume();
    bench.steps(300);
    EXPECT_FALSE(bench.chain.busy(6)) << how;
    EXPECT_EQ(bench.travel(6), 1000) << how;
  }
}

TEST(SlimPauseTable, AThrustGoesOnAfterThePause) {
  for (const auto thrust : {ChainOptions::Thrust::stands, ChainOptions::Thrust::runs_at_vj}) {
    for (const Tick wait : {30, 300}) {  // while it slows down, and at rest
      ChainOptions options;
      options.thrust = thrust;
      OneChain bench(options);
      bench.speeds(6, 10'000, 10'000);
      bench.jog_speed(6, 1000);
      bench.chain.thrust(6, 500);
      bench.steps(1001);
      bench.chain.pause();
      bench.steps(wait);
      bench.chain.resume();
      bench.steps(300);
      EXPECT_EQ(bench.chain.status(6).mode, Mode::torque);
      EXPECT_EQ(bench.chain.thrust_of(6), 500);
      EXPECT_EQ(bench.chain.speed_pps(6), thrust == ChainOptions::Thrust::stands ? 0 : 1000);
    }
  }
}

// ---- TVM, TVA

TEST(SlimTvm, ChangesOnThePathWithTheSlopeThereIs) {
  OneChain bench = at_origin();
  ASSERT_EQ(bench.chain.arc({.centre_x_units = 50, .centre_y_units = 0, .sweep_deg = 360}), Error::none);
  const double length = 100 * std::numbers::pi;
  // 0 .. 1000 ms at 100 (95 done), then 200: 100 ms up (15), and from 2000 ms on (900 ms at 200: 180) 40.
  bench.steps(1001);
  ASSERT_EQ(bench.chain.set_tvm(200), Error::none);
  EXPECT_EQ(bench.chain.settings(7).path_speed_units_s, 200);
  bench.steps(1000);
  ASSERT_EQ(bench.chain.set_tvm(40), Error::none);
  double worst = 0;
  while (!bench.all_done()) {
    bench.step();
    const double off = std::hypot(bench.chain.coordinate(0) - 50, bench.chain.coordinate(1)) - 50;
    worst = std::max(worst, std::abs(off) * kPulses);
  }
  EXPECT_LE(worst, kHalfEach);
  // 160 ms down (120 mean * 0.16 = 19.2), what is left at 40 but for 0.8 of the last 40 ms.
  const double left = length - 95 - 15 - 180 - 19.2 - 0.8;
  EXPECT_EQ(bench.tick - 1, ticks_of(2.0 + 0.16 + left / 40 + 0.04));
  EXPECT_EQ(bench.travel(0), 0);
  EXPECT_EQ(bench.travel(1), 0);
}

TEST(SlimTvm, Pr3OfOneModuleInMotionCountsAtOnce) {
  using InMotion = ChainOptions::PathSpeedInMotion;
  struct Row {
    InMotion how;
    int module;
    Tick ms;
  };
  // 45 of 100 at 100, 80 ms down to 20 (4.8), 50 at 20, and 20 ms to stop: or as if nothing had been.
  for (const Row& row :
       {Row{InMotion::whole_path, 0, 3100}, Row{InMotion::whole_path, 1, 3100}, Row{InMotion::by_x, 0, 3100},
        Row{InMotion::by_x, 1, 1100}, Row{InMotion::next_command, 0, 1100}}) {
    ChainOptions options;
    options.path_speed_in_motion = row.how;
    OneChain bench = at_origin(options);
    bench.line({100, 0});
    bench.steps(501);
    EXPECT_EQ(bench.chain.set_path_speed(row.module, 20), Error::none);
    EXPECT_EQ(bench.chain.set_path_speed(5, 50), Error::none);  // of one that is on no path
    EXPECT_EQ(bench.finish() - 1, row.ms);
    EXPECT_EQ(bench.travel(0), 100 * kPulses);
  }
}

TEST(SlimTvm, OneByOneSpoilsWhatComes) {
  ChainOptions next_command;
  next_command.path_speed_in_motion = ChainOptions::PathSpeedInMotion::next_command;
  OneChain bench = at_origin(next_command);
  bench.line({100, 0});
  bench.steps(500);
  EXPECT_EQ(bench.chain.set_path_speed(1, 20), Error::none);
  EXPECT_EQ(bench.finish() - 1, 1100);
  EXPECT_EQ(bench.line({100, 0}), Error::unequal_speeds);
  ChainOptions options;
  options.unequal_speeds = ChainOptions::UnequalSpeeds::by_module_0;
  bench.chain.set_options(options);
  const Tick began = bench.tick;
  EXPECT_EQ(bench.line({100, 0}), Error::none);
  EXPECT_EQ(bench.finish() - began - 1, 1100);
}

TEST(SlimTvm, TvaIsRefusedWhileAnythingIsCoordinated) {
  OneChain bench = at_origin();
  bench.line({100, 0});
  bench.steps(500);
  EXPECT_EQ(bench.chain.set_path_acceleration(0, 500), Error::not_allowed);
  bench.finish();
  for (int module = 0; module < 2; ++module) {
    EXPECT_EQ(bench.chain.set_path_acceleration(module, 500), Error::none);
  }
  const Tick began = bench.tick;
  bench.line({100, 0});
  EXPECT_EQ(bench.finish() - began - 1, 1200);
}

TEST(SlimTvm, NeitherMayBeZeroOrLess) {
  OneChain bench = at_origin();
  for (const double bad : {0.0, -1.0, std::nan(""), 1e300, 1e-300}) {
    EXPECT_EQ(bench.chain.set_tvm(bad), Error::range);
    EXPECT_EQ(bench.chain.set_path_speed(0, bad), Error::range);
    EXPECT_EQ(bench.chain.set_path_acceleration(0, bad), Error::range);
  }
}

}  // namespace
}  // namespace understudy::emulator::slim
