// PZ, REDO, CLR BUF.
#include <gtest/gtest.h>

#include "tests/emulator/models/slim/one_chain.h"

namespace understudy::emulator::models::slim {
namespace queues_test {

OneChain two_moves() {
  OneChain bench;
  bench.speeds(0, 1000, 10'000);
  bench.chain.move(0, true, 1000);
  bench.chain.move(0, true, 0);
  bench.steps(501);  // 450 done, 50 to stop
  return bench;
}

TEST(SlimQueues, PzHoldsAndRedoContinuesWithTheRestAndWhatFollows) {
  OneChain bench = two_moves();
  ASSERT_EQ(bench.chain.pause_queues(), Error::none);
  bench.steps(1000);
  EXPECT_EQ(bench.travel(0), 500);
  EXPECT_EQ(bench.chain.module_at(0).fifo.size(), 2U);
  EXPECT_EQ(bench.chain.next_active_tick(bench.tick), kNever);
  // Unlike TAPZ it lets commands be queued; a jog cannot run now.
  EXPECT_EQ(bench.chain.move(0, false, 10), Error::none);
  EXPECT_EQ(bench.chain.move(1, false, 10), Error::none);
  EXPECT_EQ(bench.chain.jog(2, +1), Error::paused);
  bench.steps(100);
  EXPECT_EQ(bench.travel(1), 0);
  const Tick again = bench.tick;
  ASSERT_EQ(bench.chain.resume_queues(), Error::none);
  // 500/1000 + 0.1, 1000/1000 + 0.1, 2 sqrt(10/10000).
  EXPECT_EQ(bench.finish() - again - 1, 600 + 1100 + 64);
  EXPECT_EQ(bench.travel(0), 10);
  EXPECT_EQ(bench.travel(1), 10);
}

TEST(SlimQueues, GroupsAreHeldOnTheirPath) {
  OneChain bench;
  bench.scale_all(100);
  bench.map({0, 1});
  bench.line({60, 80});
  bench.steps(501);
  bench.chain.pause_queues();
  bench.steps(200);
  EXPECT_EQ(bench.travel(0), 3000);
  EXPECT_EQ(bench.travel(1), 4000);
  const Tick again = bench.tick;
  bench.chain.resume_queues();
  EXPECT_EQ(bench.finish() - again - 1, 600);
}

TEST(SlimQueues, ClrBufInPauseForgetsTheInterruptedCommandToo) {
  for (const Tick wait : {0, 300}) {
    OneChain bench = two_moves();
    bench.chain.pause_queues();
    bench.steps(wait);
    EXPECT_EQ(bench.chain.clear_queues(), Error::none);
    EXPECT_FALSE(bench.chain.queues_paused());
    EXPECT_EQ(bench.chain.module_at(0).fifo.size(), 0U);
    bench.chain.resume_queues();
    bench.finish();
    EXPECT_EQ(bench.travel(0), 500);
    bench.chain.move(0, false, 10);
    bench.finish();
    EXPECT_EQ(bench.travel(0), 510);
  }
}

TEST(SlimQueues, ClrBufWithoutPauseLetsTheCommandInMotionFinish) {
  OneChain bench = two_moves();
  bench.chain.set_output(0, 1, true);
  EXPECT_EQ(bench.chain.clear_queues(), Error::none);
  EXPECT_EQ(bench.finish() - 1, 1100);
  EXPECT_EQ(bench.travel(0), 1000);
  EXPECT_FALSE(bench.chain.output(0, 1));
}

TEST(SlimQueues, ClrBufInAPathStopsAtTheFirstBorderWithinReach) {
  struct Row {
    Tick after;
    std::int64_t end;
    Tick ms;
  };
  // Pieces of 20 at 100 and 1000: 5 to accelerate, 5 to stop. After 150 ms 10 are done: 20 is within reach
  // (0.3 s). After 240 ms 19 are done: 24 is the earliest, so 40 (0.5 s).
  for (const Row& row : {Row{150, 2000, 300}, Row{200, 2000, 300}, Row{240, 4000, 500}}) {
    OneChain bench;
    bench.scale_all(100);
    bench.map({0, 1});
    bench.chain.set_continuous_path(1);
    for (int i = 0; i < 5; ++i) bench.line({20, 0});
    bench.steps(row.after + 1);
    bench.chain.clear_queues();
    EXPECT_EQ(bench.finish() - 1, row.ms) << row.after;
    EXPECT_EQ(bench.travel(0), row.end) << row.after;
    // A later command is not joined to any other.
    bench.line({20, 0});
    bench.finish();
    EXPECT_EQ(bench.travel(0), row.end + 2000);
  }
}

TEST(SlimQueues, APathBehindClrBufBeginsWhereWhatIsLeftEnds) {
  OneChain bench;
  bench.scale_all(100);
  bench.map({0, 1});
  bench.chain.set_continuous_path(1);
  for (int i = 0; i < 5; ++i) bench.line({20, 0});
  bench.steps(151);
  bench.chain.clear_queues();  // 20 remain
  bench.line({20, 0});
  bench.finish();
  EXPECT_EQ(bench.travel(0), 4000);
  EXPECT_EQ(bench.travel(1), 0);
}

TEST(SlimQueues, ClrBufInTapzStaysInPause) {
  OneChain bench = two_moves();
  bench.chain.pause();
  bench.steps(200);
  bench.chain.clear_queues();
  EXPECT_TRUE(bench.chain.paused());
  EXPECT_EQ(bench.chain.move(0, true, 1), Error::paused);
  bench.chain.resume();
  bench.finish();
  EXPECT_EQ(bench.travel(0), 500);
}

TEST(SlimQueues, BothPausesMustBeLifted) {
  OneChain bench = two_moves();
  bench.chain.pause();
  bench.chain.pause_queues();
  bench.steps(200);
  bench.chain.resume();
  bench.steps(200);
  EXPECT_EQ(bench.travel(0), 500);
  bench.chain.resume_queues();
  bench.finish();
  EXPECT_EQ(bench.travel(0), 0);
}

}  // namespace queues_test
}  // namespace understudy::emulator::models::slim
