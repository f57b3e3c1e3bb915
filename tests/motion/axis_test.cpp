#include "motion/axis.h"

#include <gtest/gtest.h>

#include "tests/motion/random_moves.h"

namespace understudy::motion {
namespace {

constexpr RegisterMove kManualExample{32'000, 200, 3200, 5, 5};

std::int64_t run(Axis& axis, Tick first, Tick last) {
  std::int64_t sent = 0;
  for (Tick t = first; t <= last; ++t) sent += axis.step(t);
  return sent;
}

TEST(Axis, AtRestSendsNothingAndAsksForNothing) {
  Axis axis;
  EXPECT_FALSE(axis.moving());
  EXPECT_EQ(axis.step(1), 0);
  EXPECT_EQ(axis.next_active_tick(1), Axis::kNever);
}

TEST(Axis, IsAtTheProfilesBeginningInItsFirstTickAndAtItsEndInTheLast) {
  Axis axis;
  axis.start(kManualExample.plan(), +1, 100);
  EXPECT_TRUE(axis.moving());
  EXPECT_EQ(axis.step(100), 0);
  EXPECT_EQ(run(axis, 101, 200), 800);  // s(100 ms)
  EXPECT_EQ(run(axis, 201, 3149), 31'999 - 800);
  EXPECT_TRUE(axis.moving());
  EXPECT_EQ(axis.step(3150), 1);
  EXPECT_FALSE(axis.moving());
  EXPECT_EQ(run(axis, 3151, 3300), 0);
}

TEST(Axis, ANegativeMoveIsTheMirrorImage) {
  Axis up;
  Axis down;
  up.start(kManualExample.plan(), +1, 1);
  down.start(kManualExample.plan(), -1, 1);
  for (Tick t = 1; t <= 3051; ++t) {
    ASSERT_EQ(up.step(t), -down.step(t)) << t;
    ASSERT_EQ(up.moving(), down.moving()) << t;
  }
  EXPECT_FALSE(down.moving());
}

TEST(Axis, SkippedTicksSendTheirPulsesTogether) {
  RandomMoves random(7);
  for (int i = 0; i < 300; ++i) {
    const RegisterMove move = random.next(5000);
    Axis each;
    Axis some;
    const Tick first = random.between(0, 1'000'000'000);
    each.start(move.plan(), -1, first);
    some.start(move.plan(), -1, first);
    std::int64_t sent_each = 0;
    std::int64_t sent_some = 0;
    Tick t = first;
    while (each.moving() || some.moving()) {
      const Tick next = t + random.between(1, 200);
      for (; t < next; ++t) sent_each += each.step(t);
      sent_some += some.step(t - 1);
      ASSERT_EQ(sent_some, sent_each) << move.code() << " tick " << t;
      ASSERT_EQ(some, each) << move.code() << " tick " << t;
    }
    ASSERT_EQ(sent_each, -move.distance_pulses) << move.code();
  }
}

TEST(Axis, TicksThatItDoesNotAskForSendNothing) {
  RandomMoves random(11);
  for (int i = 0; i < 200; ++i) {
    const RegisterMove move = random.next(3000);
    Axis each;
    each.start(move.plan(), +1, 50);
    for (Tick t = 1; t < 100'000 && each.moving(); ++t) {
      Axis sleeper = each;
      const Tick next = sleeper.next_active_tick(t - 1);
      ASSERT_GE(next, t) << move.code();
      const std::int64_t sent = each.step(t);
      if (next > t) {
        ASSERT_EQ(sent, 0) << move.code() << " tick " << t;
        ASSERT_TRUE(each.moving()) << move.code() << " tick " << t;
      }
    }
    ASSERT_FALSE(each.moving()) << move.code();
    ASSERT_EQ(each.next_active_tick(100'000), Axis::kNever);
  }
}

TEST(Axis, AHangingMoveCountsAsMovingSendsNothingAndEndsByStop) {
  Axis axis;
  axis.hang(-1);
  EXPECT_TRUE(axis.moving());
  EXPECT_EQ(axis.direction, -1);
  EXPECT_EQ(run(axis, 1, 100'000), 0);
  EXPECT_TRUE(axis.moving());
  EXPECT_EQ(axis.next_active_tick(5), Axis::kNever);
  axis.stop();
  EXPECT_FALSE(axis.moving());
}

TEST(Axis, AfterStopThereIsNoPulse) {
  Axis axis;
  axis.start(kManualExample.plan(), +1, 0);
  EXPECT_EQ(run(axis, 0, 1525), 16'000);
  axis.stop();
  EXPECT_FALSE(axis.moving());
  EXPECT_EQ(run(axis, 1526, 4000), 0);
}

TEST(Axis, ANewMoveBeginsAnewFromStandstill) {
  Axis axis;
  axis.start(kManualExample.plan(), +1, 0);
  run(axis, 0, 1525);
  axis.start(kManualExample.plan(), -1, 1526);
  EXPECT_EQ(axis.step(1526), 0);
  EXPECT_EQ(run(axis, 1527, 1526 + 100), -800);
  EXPECT_EQ(run(axis, 1627, 1526 + 3050), -31'200);
  EXPECT_FALSE(axis.moving());
}

TEST(Axis, AMoveOfNoDistanceEndsTheOneThatRuns) {
  Axis axis;
  axis.start(kManualExample.plan(), +1, 0);
  run(axis, 0, 1000);
  axis.start(Profile{}, +1, 1001);
  EXPECT_FALSE(axis.moving());
  EXPECT_EQ(run(axis, 1001, 4000), 0);
  axis.hang(+1);
  axis.start(Profile{}, +1, 4001);
  EXPECT_FALSE(axis.moving());
}

TEST(Axis, ANewMoveEndsAHangingOneAndTheOtherWayRound) {
  Axis axis;
  axis.hang(+1);
  axis.start(kManualExample.plan(), +1, 10);
  EXPECT_EQ(run(axis, 10, 110), 800);
  axis.hang(+1);
  EXPECT_TRUE(axis.moving());
  EXPECT_EQ(run(axis, 111, 4000), 0);
}

TEST(Axis, OnceAtRestNothingOfTheMoveIsLeft) {
  Axis axis;
  axis.start(kManualExample.plan(), +1, 0);
  run(axis, 0, 3050);
  Axis stopped;
  stopped.start(kManualExample.plan(), +1, 0);
  run(stopped, 0, 70);
  stopped.stop();
  EXPECT_EQ(axis, stopped);
}

}  // namespace
}  // namespace understudy::motion
