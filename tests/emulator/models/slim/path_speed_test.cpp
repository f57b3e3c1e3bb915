// TVM, PR3 and TVA: for all modules, for one module, during motion.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/emulator/models/slim/one_chain.h"

namespace understudy::emulator::models::slim {
namespace path_speed_test {

constexpr int kPulses = 1000;

OneChain at_origin(const ChainOptions& options = {}) {
  OneChain bench(options);
  bench.map({0, 1});
  bench.scale_all(kPulses);
  return bench;
}

/// Half a pulse in each axis.
const double kHalfEach = std::sqrt(0.5) + 1e-6;

TEST(SlimTvm, ChangesOnThePathWithTheSlopeThereIs) {
  OneChain bench = at_origin();
  ASSERT_EQ(bench.chain.arc({.centre_x_units = 50, .centre_y_units = 0, .sweep_deg = 360}), Error::none);
  const double length = 100 * std::numbers::pi;
  // 0 .. 1000 ms at 100 (95 done), then 200: 100 ms up (15), and from 2000 ms on (900 ms at 200: 180) 40.
  bench.steps(1001);
  ASSERT_EQ(bench.chain.settings().set_tvm(200), Error::none);
  EXPECT_EQ(bench.chain.module_at(7).settings.path_speed_units_s, 200);
  bench.steps(1000);
  ASSERT_EQ(bench.chain.settings().set_tvm(40), Error::none);
  double worst = 0;
  while (!bench.all_done()) {
    bench.step();
    const double off = std::hypot(bench.chain.coordinate(0) - 50, bench.chain.coordinate(1)) - 50;
    worst = std::max(worst, std::abs(off) * kPulses);
  }
  EXPECT_LE(worst, kHalfEach);
  // 160 ms down (120 mean * 0.16 = 19.2), the rest at 40, except 0.8 for the last 40 ms.
  const double left = length - 95 - 15 - 180 - 19.2 - 0.8;
  EXPECT_EQ(bench.tick - 1, ticks_of(2.0 + 0.16 + left / 40 + 0.04));
  EXPECT_EQ(bench.travel(0), 0);
  EXPECT_EQ(bench.travel(1), 0);
}

TEST(SlimTvm, Pr3OfOneModuleInMotionCountsAtOnce) {
  constexpr Option kWholePath = option("path_speed_in_motion", "at_once_for_the_whole_path");
  constexpr Option kByX = option("path_speed_in_motion", "at_once_if_x_has_it");
  constexpr Option kNextCommand = option("path_speed_in_motion", "next_command");
  struct Row {
    Option how;
    int module;
    Tick ms;
  };
  // 45 of 100 at 100, 80 ms down to 20 (4.8), 50 at 20, and 20 ms to stop; or as if nothing had happened.
  for (const Row& row : {Row{kWholePath, 0, 3100}, Row{kWholePath, 1, 3100}, Row{kByX, 0, 3100},
                         Row{kByX, 1, 1100}, Row{kNextCommand, 0, 1100}}) {
    ChainOptions options;
    options.choose(row.how);
    OneChain bench = at_origin(options);
    bench.line({100, 0});
    bench.steps(501);
    EXPECT_EQ(bench.chain.settings().set_path_speed(row.module, 20), Error::none);
    EXPECT_EQ(bench.chain.settings().set_path_speed(5, 50), Error::none);  // of a module without a path
    EXPECT_EQ(bench.finish() - 1, row.ms);
    EXPECT_EQ(bench.travel(0), 100 * kPulses);
  }
}

TEST(SlimTvm, OneByOneSpoilsWhatComes) {
  ChainOptions next_command;
  next_command.choose(option("path_speed_in_motion", "next_command"));
  OneChain bench = at_origin(next_command);
  bench.line({100, 0});
  bench.steps(500);
  EXPECT_EQ(bench.chain.settings().set_path_speed(1, 20), Error::none);
  EXPECT_EQ(bench.finish() - 1, 1100);
  EXPECT_EQ(bench.line({100, 0}), Error::unequal_speeds);
  ChainOptions options;
  options.choose(option("unequal_speeds", "as_t0_has_them"));
  bench.chain.set_options(options);
  const Tick began = bench.tick;
  EXPECT_EQ(bench.line({100, 0}), Error::none);
  EXPECT_EQ(bench.finish() - began - 1, 1100);
}

TEST(SlimTvm, TvaIsRefusedOfAModuleOnAPath) {
  OneChain bench = at_origin();
  bench.line({100, 0});
  bench.steps(500);
  EXPECT_EQ(bench.chain.settings().set_path_acceleration(0, 500), Error::not_allowed);
  EXPECT_EQ(bench.chain.settings().set_path_acceleration(1, 500), Error::not_allowed);
  EXPECT_EQ(bench.chain.settings().set_path_acceleration(2, 500), Error::none);  // without a path
  EXPECT_EQ(bench.finish() - 1, 1100);
  for (int module = 0; module < 2; ++module) {
    EXPECT_EQ(bench.chain.settings().set_path_acceleration(module, 500), Error::none);
  }
  const Tick began = bench.tick;
  bench.line({100, 0});
  EXPECT_EQ(bench.finish() - began - 1, 1200);
}

TEST(SlimTvm, NeitherMayBeZeroOrLess) {
  OneChain bench = at_origin();
  for (const double bad : {0.0, -1.0, std::nan(""), 1e300, 1e-300}) {
    EXPECT_EQ(bench.chain.settings().set_tvm(bad), Error::range);
    EXPECT_EQ(bench.chain.settings().set_path_speed(0, bad), Error::range);
    EXPECT_EQ(bench.chain.settings().set_path_acceleration(0, bad), Error::range);
  }
}

}  // namespace path_speed_test
}  // namespace understudy::emulator::models::slim
