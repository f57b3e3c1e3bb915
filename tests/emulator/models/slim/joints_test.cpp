// Continuous paths: CM 0, 1, 2 with PR7, and which paths can be joined.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/emulator/models/slim/one_chain.h"

namespace understudy::emulator::models::slim {
namespace joints_test {

constexpr int kPulses = 1000;

OneChain at_origin() {
  OneChain bench;
  bench.map({0, 1, 2});
  bench.scale_all(kPulses);
  return bench;
}

void octagon(OneChain& bench) {
  for (int side = 0; side < 8; ++side) {
    const double angle = side * std::numbers::pi / 4;
    ASSERT_EQ(bench.line({10 * std::cos(angle), 10 * std::sin(angle)}), Error::none);
  }
}

TEST(SlimJoints, TheOctagonsTime) {
  struct Row {
    int mode;
    double pr7;
    Tick ms;  // eight sides of 10: each 2 sqrt(10/1000) s from rest to rest, or 80/100 + 0.1 s in all
  };
  for (const Row& row : {Row{0, 0, 1600}, Row{1, 0, 900}, Row{2, 45, 900}, Row{2, 60, 900},
                         Row{2, 44.9, 1600}, Row{2, 0, 1600}}) {
    OneChain bench = at_origin();
    ASSERT_EQ(bench.chain.set_continuous_path(row.mode), Error::none);
    ASSERT_EQ(bench.chain.settings().set_smooth_corner(0, row.pr7), Error::none);
    octagon(bench);
    EXPECT_EQ(bench.finish() - 1, row.ms) << "CM " << row.mode << ", PR7 " << row.pr7;
    EXPECT_EQ(bench.travel(0), 0);
    EXPECT_EQ(bench.travel(1), 0);
  }
}

TEST(SlimJoints, ASharpCornerInCm1IsPassedAtFullSpeedOnThePath) {
  OneChain bench = at_origin();
  bench.chain.set_continuous_path(1);
  bench.line({50, 0});
  bench.line({0, 50});
  while (!bench.all_done()) {
    bench.step();
    const double s = Trapezoid{100, 100, 1000}.at(static_cast<double>(bench.tick - 1) / 1000);
    EXPECT_NEAR(static_cast<double>(bench.travel(0)), kPulses * std::min(s, 50.0), 0.5 + 1e-6);
    EXPECT_NEAR(static_cast<double>(bench.travel(1)), kPulses * std::max(s - 50, 0.0), 0.5 + 1e-6);
    EXPECT_EQ(bench.chain.status(0).in_blend, !bench.all_done());
  }
  EXPECT_EQ(bench.tick - 1, 1100);  // 100/100 + 0.1
}

/// Returns the time of two commands of 50 units each; the second one can be issued in another mode.
Tick pair_ms(int first_mode, int second_mode, double pr7, bool turn_back = false) {
  OneChain bench = at_origin();
  bench.chain.settings().set_smooth_corner(0, pr7);
  bench.chain.set_continuous_path(first_mode);
  bench.line({50, 0});
  bench.chain.set_continuous_path(second_mode);
  bench.line(turn_back ? std::initializer_list<double>{-50, 0} : std::initializer_list<double>{50, 0});
  return bench.finish() - 1;
}

TEST(SlimJoints, TheModesOfBothCommandsMustAllowIt) {
  // Joined 1.1 s, from rest to rest 0.6 s each.
  for (int first = 0; first <= 2; ++first) {
    for (int second = 0; second <= 2; ++second) {
      EXPECT_EQ(pair_ms(first, second, 0), first == 0 || second == 0 ? 1200 : 1100) << first << second;
    }
  }
  EXPECT_EQ(pair_ms(1, 1, 0, true), 1100);
  EXPECT_EQ(pair_ms(1, 2, 90, true), 1200);
  EXPECT_EQ(pair_ms(2, 1, 90, true), 1200);
  EXPECT_EQ(pair_ms(2, 2, 180, true), 1100);
}

TEST(SlimJoints, TheThresholdIsReadWhenTheSecondIsIssued) {
  OneChain bench = at_origin();
  bench.chain.set_continuous_path(2);
  bench.line({50, 0});
  bench.chain.settings().set_smooth_corner(0, 90);
  bench.line({0, 50});
  bench.chain.settings().set_smooth_corner(0, 0);
  EXPECT_EQ(bench.finish() - 1, 1100);
}

TEST(SlimJoints, ArcsJoinByTheirTangents) {
  // East 50, then a half circle about (50, 50): length 50 pi, without a corner where they meet.
  OneChain bench = at_origin();
  bench.chain.set_continuous_path(2);
  bench.line({50, 0});
  bench.chain.arc({.centre_x_units = 50, .centre_y_units = 50, .sweep_deg = 180});
  EXPECT_EQ(bench.finish() - 1, ticks_of(Trapezoid{50 + 50 * std::numbers::pi, 100, 1000}.duration_s()));
  EXPECT_EQ(bench.travel(1), 100 * kPulses);
}

TEST(SlimJoints, ThreeAxesJoinByAngleOnlyLineToLine) {
  const Tick apart = 2 * 600;
  for (const int mode : {1, 2}) {
    OneChain lines = at_origin();
    lines.chain.set_continuous_path(mode);
    lines.line({0, 0, 50});
    lines.line({0, 0, 50});
    EXPECT_EQ(lines.finish() - 1, 1100) << mode;
    // A helix that only rises is as straight, but it is not a line.
    OneChain helix = at_origin();
    helix.chain.set_continuous_path(mode);
    helix.line({0, 0, 50});
    helix.chain.arc({.centre_x_units = 10, .sweep_deg = 0, .height_units = 100});
    EXPECT_EQ(helix.finish() - 1, mode == 1 ? 1100 : apart) << mode;
  }
}

TEST(SlimJoints, OnlyTheSameModulesOnTheSameLettersAreJoined) {
  OneChain bench = at_origin();
  bench.chain.set_continuous_path(1);
  bench.line({50, 0});
  bench.map({1, 0});
  bench.line({0, 50});  // module 0 moves on by 50 all the same
  EXPECT_EQ(bench.finish() - 1, 1200);
  EXPECT_EQ(bench.travel(0), 100 * kPulses);
}

TEST(SlimJoints, WhatLiesBetweenTwoCommandsKeepsThemApart) {
  OneChain bench = at_origin();
  bench.chain.set_continuous_path(1);
  bench.line({50, 0});
  bench.chain.set_output(0, 1, true);
  bench.line({50, 0});
  bench.steps(600);
  EXPECT_FALSE(bench.chain.output(0, 1));
  bench.step();
  EXPECT_TRUE(bench.chain.output(0, 1));
  EXPECT_EQ(bench.finish() - 1, 1200);
}

TEST(SlimJoints, ASuccessorThatComesTooLateBeginsFromRest) {
  // 2MR 100,0 decelerates from 95 on, 1000 ms after its beginning, and ends after 1100.
  struct Row {
    Tick issued_after, ms;
  };
  for (const Row& row : {Row{500, 2100}, Row{999, 2100}, Row{1050, 2200}, Row{1099, 2200}}) {
    OneChain bench = at_origin();
    bench.chain.set_continuous_path(1);
    bench.line({100, 0});
    bench.steps(row.issued_after + 1);
    bench.line({100, 0});
    EXPECT_EQ(bench.finish() - 1, row.ms) << row.issued_after;
  }
}

TEST(SlimJoints, ThirtyTwoShortPiecesAreOneMotion) {
  OneChain bench = at_origin();
  bench.chain.set_continuous_path(1);
  for (int i = 0; i < 32; ++i) ASSERT_EQ(bench.line({0.5, 0}), Error::none);
  EXPECT_EQ(bench.line({0.5, 0}), Error::buffer_full);
  // 16 units in all: none of the pieces alone is long enough to stop within it.
  EXPECT_EQ(bench.finish() - 1, ticks_of(Trapezoid{16, 100, 1000}.duration_s()));
}

}  // namespace joints_test
}  // namespace understudy::emulator::models::slim
