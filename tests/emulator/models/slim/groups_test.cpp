// Several coordinated motions at the same time, and how they wait for each other.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/emulator/models/slim/one_chain.h"

namespace understudy::emulator::models::slim {
namespace groups_test {

TEST(SlimGroups, ThreeOfTwoAxesRunAtTheSameTimeEachOnItsOwnPath) {
  OneChain bench;
  bench.scale_all(100);
  bench.map({0, 1});
  ASSERT_EQ(bench.line({30, 40}), Error::none);
  bench.map({2, 3});
  ASSERT_EQ(bench.chain.arc({.centre_x_units = 10, .sweep_deg = 360}), Error::none);
  bench.map({4, 5});
  ASSERT_EQ(bench.line({-100, 0}), Error::none);
  EXPECT_EQ(bench.chain.groups_running(), 3);
  const Trapezoid line{50, 100, 1000};
  const Trapezoid circle{20 * std::numbers::pi, 100, 1000};
  const Trapezoid other{100, 100, 1000};
  while (!bench.all_done()) {
    bench.step();
    const double t = static_cast<double>(bench.tick - 1) / 1000;
    EXPECT_NEAR(static_cast<double>(bench.travel(0)), 60 * line.at(t), 0.5 + 1e-6);
    EXPECT_NEAR(static_cast<double>(bench.travel(1)), 80 * line.at(t), 0.5 + 1e-6);
    EXPECT_NEAR(static_cast<double>(bench.travel(2)), 1000 - 1000 * std::cos(circle.at(t) / 10), 0.5 + 1e-6);
    EXPECT_NEAR(static_cast<double>(bench.travel(4)), -100 * other.at(t), 0.5 + 1e-6);
  }
  EXPECT_EQ(bench.tick - 1, 1100);
}

TEST(SlimGroups, TwoOfThreeAxesOrFourAndTwo) {
  OneChain bench;
  bench.map({0, 2, 4});
  ASSERT_EQ(bench.line({10, 20, 20}), Error::none);
  bench.map({1, 3, 5});
  ASSERT_EQ(bench.chain.arc({.centre_x_units = 10, .sweep_deg = 90, .height_units = 50}), Error::none);
  EXPECT_EQ(bench.chain.groups_running(), 2);
  bench.finish();
  EXPECT_EQ(bench.travel(4), 20);
  EXPECT_EQ(bench.travel(1), 10);
  EXPECT_EQ(bench.travel(3), -10);
  EXPECT_EQ(bench.travel(5), 50);
  bench.map({0, 1, 2, 3});
  ASSERT_EQ(bench.line({1, 2, 3, 4}), Error::none);
  bench.map({4, 5});
  ASSERT_EQ(bench.line({1, 2}), Error::none);
  EXPECT_EQ(bench.chain.groups_running(), 2);
  bench.finish();
  EXPECT_EQ(bench.travel(3), -10 + 4);
  EXPECT_EQ(bench.travel(5), 52);
}

TEST(SlimGroups, TheMapCountsWhenACommandIsIssued) {
  OneChain bench;
  bench.map({0, 1});
  bench.line({100, 0});
  bench.line({0, 100});
  bench.map({5, 4});
  bench.finish();
  EXPECT_EQ(bench.travel(0), 100);
  EXPECT_EQ(bench.travel(1), 100);
  EXPECT_EQ(bench.travel(5), 0);
}

TEST(SlimGroups, APathBehindAJogEndsByWhereTheJogStopped) {
  OneChain bench;
  bench.map({0, 1});
  bench.jog_speed(0, 1000);
  bench.chain.jog(0, +1);
  bench.steps(500);
  ASSERT_EQ(bench.line({100, 50}), Error::none);
  bench.steps(300);
  bench.chain.jog(0, 0);
  bench.finish();
  EXPECT_GT(bench.travel(0), 800);
  EXPECT_EQ(bench.travel(1), 50);
  // The next command starts at its end.
  ASSERT_EQ(bench.line({0, 0}, true), Error::none);
  bench.finish();
  EXPECT_EQ(bench.travel(0), 0);
  EXPECT_EQ(bench.travel(1), 0);
}

TEST(SlimGroups, ACommandStartsAtTheHeadOfAllItsFifos) {
  OneChain bench;
  bench.speeds(1, 1000, 10'000);
  bench.chain.move(1, true, 1000);  // 1.1 s
  bench.map({0, 1});
  bench.line({100, 0});  // waits for module 1: 1.1 s itself
  bench.map({0, 2});
  bench.line({50, 0});  // waits behind it in module 0's FIFO
  bench.map({3, 4});
  bench.line({50, 0});  // does not wait: 0.6 s
  EXPECT_EQ(bench.chain.groups_running(), 1);
  EXPECT_FALSE(bench.chain.done(2));
  bench.steps(1 + 600);
  EXPECT_TRUE(bench.chain.done(3));
  EXPECT_EQ(bench.travel(0), 0);
  bench.steps(500 + 1100);
  EXPECT_EQ(bench.travel(0), 100);
  EXPECT_TRUE(bench.chain.done(1));
  EXPECT_EQ(bench.finish() - 1, 1100 + 1100 + 600);
  EXPECT_EQ(bench.travel(0), 150);
}

TEST(SlimGroups, PauseAndTastopAreForAllOfThem) {
  OneChain bench;
  bench.scale_all(100);
  for (const int x : {0, 2, 4}) {
    bench.map({x, x + 1});
    bench.line({100.0 + x, 0});
  }
  bench.steps(501);
  bench.chain.pause();
  bench.steps(100);
  for (const int x : {0, 2, 4}) EXPECT_EQ(bench.travel(x), 5000) << x;  // 45 + 5
  bench.chain.resume();
  const Tick resumed = bench.tick;
  EXPECT_EQ(bench.finish() - resumed - 1, 640);  // 54/100 + 0.1
  for (const int x : {0, 2, 4}) EXPECT_EQ(bench.travel(x), 10'000 + 100 * x);
}

TEST(SlimGroups, MovesOfALetterRunBesideAGroup) {
  OneChain bench;
  bench.map({0, 1, 2});
  bench.speeds(2, 1000, 10'000);
  bench.line({100, 0});
  EXPECT_EQ(bench.chain.move_axis(Letter::z, false, 1000), Error::none);
  EXPECT_EQ(bench.chain.move_axis(Letter::x, false, -100), Error::none);  // behind the line
  bench.steps(1101);
  EXPECT_EQ(bench.travel(0), 100);
  EXPECT_EQ(bench.travel(2), 1000);
  bench.finish();
  EXPECT_EQ(bench.travel(0), 0);
}

TEST(SlimGroups, AThousandCommandsInAnyOrderLoseNothing) {
  // Fixed pseudo-random commands; the sums of the distances are the oracle.
  OneChain bench;
  bench.scale_all(10);
  bench.chain.settings().set_tvm(2000);
  std::array<std::int64_t, kModules> expected{};
  std::uint64_t seed = 12'345;
  const auto dice = [&](int n) {
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<int>((seed >> 33) % static_cast<std::uint64_t>(n));
  };
  int refused = 0;
  for (int i = 0; i < 1000; ++i) {
    bench.chain.set_continuous_path(dice(3));
    const int x = dice(6);
    const int y = (x + 1 + dice(5)) % 6;
    bench.map({x, y});
    const int dx = dice(41) - 20;
    const int dy = dice(41) - 20;
    const bool single = dice(4) == 0;
    Error answer = Error::buffer_full;
    while (answer == Error::buffer_full) {
      answer = single ? bench.chain.move_axis(Letter::x, false, dx)
                      : bench.line({static_cast<double>(dx), static_cast<double>(dy)});
      if (answer != Error::buffer_full) continue;
      ++refused;
      bench.step();
    }
    ASSERT_EQ(answer, Error::none);
    expected[static_cast<std::size_t>(x)] += dx * 10;
    if (!single) expected[static_cast<std::size_t>(y)] += dy * 10;
    if (dice(50) == 0) {
      bench.chain.pause();
      bench.steps(dice(60));
      bench.chain.resume();
    }
    bench.steps(dice(3));
  }
  bench.finish();
  for (int module = 0; module < kModules; ++module) {
    EXPECT_EQ(bench.travel(module), expected[static_cast<std::size_t>(module)]) << module;
    EXPECT_EQ(bench.sent[static_cast<std::size_t>(module)], bench.travel(module)) << module;
  }
  EXPECT_GT(refused, 0);
}

}  // namespace groups_test
}  // namespace understudy::emulator::models::slim
