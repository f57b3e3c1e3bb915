// Outputs: buffered and immediate, pulses, PWM, and by position.
#include <gtest/gtest.h>

#include "emulator/device/terminals.h"
#include "tests/emulator/models/slim/dialogue_script.h"
#include "tests/emulator/models/slim/one_chain.h"

namespace understudy::emulator::models::slim {
namespace outputs_test {

int levels(const Chain& chain, int module) {
  int mask = 0;
  for (int output = 1; output <= 4; ++output) mask |= chain.output(module, output) << (output - 1);
  return mask;
}

TEST(SlimOutputs, SetClearToggleAndAllFour) {
  OneChain bench;
  EXPECT_EQ(levels(bench.chain, 3), 0);
  bench.chain.set_output(3, 1, true);
  bench.chain.set_output(3, 4, true);
  EXPECT_EQ(levels(bench.chain, 3), 0b1001);
  bench.chain.toggle_output(3, 1);
  bench.chain.toggle_output(3, 2);
  EXPECT_EQ(levels(bench.chain, 3), 0b1010);
  bench.chain.set_output(3, 2, false);
  EXPECT_EQ(levels(bench.chain, 3), 0b1000);
  for (int mask = 0; mask < 16; ++mask) {
    EXPECT_EQ(bench.chain.set_outputs(3, mask), Error::none);
    EXPECT_EQ(levels(bench.chain, 3), mask);
  }
  EXPECT_EQ(levels(bench.chain, 2), 0);
  for (const int bad : {0, 5, -1}) {
    EXPECT_EQ(bench.chain.set_output(3, bad, true), Error::range);
    EXPECT_EQ(bench.chain.set_output_at_once(3, bad, true), Error::range);
    EXPECT_EQ(bench.chain.toggle_output(3, bad), Error::range);
    EXPECT_EQ(bench.chain.pulse_output(3, bad, 1), Error::range);
    EXPECT_EQ(bench.chain.pwm(3, bad, 1, 1), Error::range);
    EXPECT_EQ(bench.chain.arm(3, 1, bad, true, 1), Error::range);
  }
  EXPECT_EQ(bench.chain.set_outputs(3, 16), Error::range);
  EXPECT_EQ(bench.chain.set_outputs(3, -1), Error::range);
}

TEST(SlimOutputs, QueuedOnesWaitForTheMotionButImmediateOnesDoNot) {
  OneChain bench;
  bench.speeds(0, 1000, 10'000);
  bench.chain.move(0, true, 1000);
  bench.chain.set_output(0, 1, true);
  bench.chain.set_output(1, 1, true);  // another module's FIFO
  bench.chain.set_output_at_once(0, 2, true);
  EXPECT_EQ(levels(bench.chain, 0), 0b10);
  EXPECT_EQ(levels(bench.chain, 1), 0b1);
  bench.steps(1100);
  EXPECT_EQ(levels(bench.chain, 0), 0b10);
  bench.step();  // the tick in which it arrives
  EXPECT_EQ(levels(bench.chain, 0), 0b11);
}

TEST(SlimOutputs, APulseLastsFourMillisecondsAUnit) {
  for (const std::int32_t width : {1, 3, 250}) {
    OneChain bench;
    bench.steps(10);
    bench.chain.pulse_output(0, 2, width);
    EXPECT_TRUE(bench.chain.done(0));        // no command waits for it
    EXPECT_FALSE(bench.chain.output(0, 2));  // it starts with a tick
    EXPECT_EQ(bench.chain.next_active_tick(bench.tick), 11);
    bench.step();
    Tick on = 0;
    while (bench.chain.output(0, 2)) {
      EXPECT_EQ(bench.chain.next_active_tick(bench.tick), 11 + 4 * width);
      bench.step();
      ++on;
    }
    EXPECT_EQ(on, 4 * width);
    EXPECT_EQ(bench.chain.next_active_tick(bench.tick), kNever);
    // On an output that is on: it is off after the pulse, and not before.
    bench.chain.set_output(0, 2, true);
    bench.chain.pulse_output(0, 2, width);
    for (Tick i = 0; i <= 4 * width; ++i, bench.step()) EXPECT_TRUE(bench.chain.output(0, 2));
    EXPECT_FALSE(bench.chain.output(0, 2));
  }
  OneChain bench;
  EXPECT_EQ(bench.chain.pulse_output(0, 2, 0), Error::range);
}

TEST(SlimOutputs, APulseOfAProgramLastsAsLong) {
  for (const int units : {1, 5, 25}) {
    DialogueScript script;
    script.play("> PG\n> PLS P1," + std::to_string(units) + "\n>\n> G\n");
    int on = 0;
    for (int i = 0; i < 200; ++i) {
      script.pass(1);
      on += script.device().terminals()->output(terminal(0, kFirstOutput)) ? 1 : 0;
    }
    EXPECT_EQ(on, 4 * units);
  }
}

TEST(SlimOutputs, PwmShowsItsPeriodAndDutyAsFarAsTicksCan) {
  struct Row {
    double hz, duty;
    int on_in_1000;
  };
  for (const Row& row : {Row{10, 25, 250}, Row{100, 70, 700}, Row{1, 50, 500}, Row{500, 50, 500},
                         Row{10, 0, 0}, Row{10, 100, 1000}, Row{5000, 80, 1000}, Row{5000, 20, 0}}) {
    OneChain bench;
    bench.step();  // in the first tick every axis updates its environment
    ASSERT_EQ(bench.chain.pwm(0, 1, row.hz, row.duty), Error::none);
    EXPECT_EQ(bench.chain.module_at(0).outputs[0].frequency_hz, row.hz);
    EXPECT_EQ(bench.chain.module_at(0).outputs[0].duty_percent, row.duty);
    int on = 0;
    bool before = bench.chain.output(0, 1);
    for (int i = 0; i < 1000; ++i) {
      const Tick next = bench.chain.next_active_tick(bench.tick);
      bench.step();
      // It changes at the predicted time, and only then.
      EXPECT_EQ(bench.chain.output(0, 1) != before, bench.tick == next) << row.hz << " at " << bench.tick;
      before = bench.chain.output(0, 1);
      on += before ? 1 : 0;
    }
    EXPECT_EQ(on, row.on_in_1000) << row.hz << " Hz, " << row.duty << " %";
  }
  OneChain bench;
  for (const auto& [hz, duty] :
       {std::pair{0.0, 50.0}, {-1.0, 50.0}, {10.0, 100.1}, {10.0, -1.0}, {1e9, 5.0}}) {
    EXPECT_EQ(bench.chain.pwm(0, 1, hz, duty), Error::range);
  }
  bench.chain.pwm(0, 1, 10, 50);
  bench.chain.toggle_output(0, 1);  // it is on at its beginning
  bench.steps(60);
  EXPECT_FALSE(bench.chain.output(0, 1));
}

TEST(SlimTriggers, FireOnceInTheTickThatPassesThemFromEitherSide) {
  for (const int direction : {+1, -1}) {
    OneChain bench;
    bench.speeds(0, 100'000, 1'000'000);  // up to 100 pulses per tick
    bench.chain.set_output_at_once(0, 4, true);
    ASSERT_EQ(bench.chain.arm(0, 1, 3, true, direction * 12'345), Error::none);
    ASSERT_EQ(bench.chain.arm(0, 2, 4, false, direction * 20'000), Error::none);
    bench.chain.move(0, true, direction * 30'000);
    while (!bench.all_done()) {
      bench.step();
      EXPECT_EQ(bench.chain.output(0, 3), bench.travel(0) * direction >= 12'345) << bench.tick;
      EXPECT_EQ(bench.chain.output(0, 4), bench.travel(0) * direction < 20'000) << bench.tick;
    }
    // Once, even if the coordinate is set again.
    bench.chain.set_outputs(0, 0b1000);
    bench.chain.set_coordinate(0, direction * 30'000);
    bench.chain.move(0, true, 0);
    bench.finish();
    EXPECT_EQ(levels(bench.chain, 0), 0b1000);
  }
}

TEST(SlimTriggers, AreArmedInTheirTurnAndWaitToBeReached) {
  OneChain bench;
  bench.chain.arm(0, 1, 1, true, 0);  // it is there now
  bench.chain.move(0, true, 100);
  bench.chain.arm(0, 2, 2, true, 50);  // only on the way back
  bench.chain.move(0, true, 40);
  bench.chain.move(0, true, 0);
  while (bench.chain.module_at(0).fifo.size() > 3) bench.step();
  EXPECT_EQ(levels(bench.chain, 0), 0);
  while (bench.chain.module_at(0).fifo.size() > 1) bench.step();
  EXPECT_EQ(levels(bench.chain, 0), 0b10);
  bench.finish();
  EXPECT_EQ(levels(bench.chain, 0), 0b11);
}

TEST(SlimTriggers, FollowTheCoordinateAndWorkInCoordinatedMotion) {
  OneChain bench;
  bench.map({0, 1});
  bench.chain.arm(1, 1, 1, true, 150);
  bench.chain.set_coordinate(1, 100);
  bench.line({0, 100});  // from 100 to 200: half way at 150
  while (!bench.chain.output(1, 1) && bench.tick < 5000) bench.step();
  EXPECT_EQ(bench.travel(1), 50);
  // Another P1SET replaces the armed one.
  bench.chain.arm(1, 1, 2, true, 160);
  bench.chain.arm(1, 1, 3, true, 170);
  bench.finish();
  EXPECT_EQ(levels(bench.chain, 1), 0b1);  // armed after the motion
  bench.line({0, -100});
  bench.finish();
  EXPECT_EQ(levels(bench.chain, 1), 0b101);
  EXPECT_EQ(bench.chain.arm(1, 3, 1, true, 1), Error::range);
}

/// Both triggers of one output in the same millisecond: the one that is passed last wins, in either
/// direction.
TEST(SlimTriggers, OfOneMillisecondActInTheirOrder) {
  for (const bool forwards : {true, false}) {
    for (const bool first_sets : {true, false}) {
      OneChain bench;
      bench.speeds(0, 1'000'000, 1e9);
      bench.chain.arm(0, 1, 1, first_sets, forwards ? 5010 : -5010);
      bench.chain.arm(0, 2, 1, !first_sets, forwards ? 5020 : -5020);
      bench.chain.set_output(0, 1, false);
      bench.chain.move(0, false, forwards ? 20'000 : -20'000);
      bench.finish();
      EXPECT_EQ(bench.chain.output(0, 1), !first_sets) << forwards;
      // On the way back they are passed in the other order.
      bench.chain.arm(0, 1, 1, first_sets, forwards ? 5010 : -5010);
      bench.chain.arm(0, 2, 1, !first_sets, forwards ? 5020 : -5020);
      bench.chain.move(0, false, forwards ? -20'000 : 20'000);
      bench.finish();
      EXPECT_EQ(bench.chain.output(0, 1), first_sets) << forwards;
    }
  }
}

}  // namespace outputs_test
}  // namespace understudy::emulator::models::slim
