// The triggers of an action, their order, and the effect of each action.
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "motion/bad_motion.h"
#include "motion/synchronous.h"

namespace understudy::motion {
namespace synchronous_action_test {

using Do = SyncAction::Drive;

/// Steep: at its speed within the first tick.
SpeedLaw at_speed(double pps) {
  return {.start_speed_u_s = pps,
          .top_speed_u_s = pps,
          .up = RampLaw::by_slope(1e9),
          .down = RampLaw::by_slope(1e9)};
}

struct SyncBench final : EdgeOwner {
  std::array<Axis, 4> axes{};
  std::array<Environment, 4> environment{};
  SyncTable table;
  struct Last {
    std::array<Events, 4> fired{};
    std::uint8_t outputs = 0, interrupts = 0, presets_command = 0, presets_encoder = 0;
    bool operator==(const Last&) const = default;
  };
  Last last;
  std::size_t axes_there = 4;
  Tick tick = 0;

  SyncBench() {
    for (Axis& axis : axes) axis.switch_servo(true);
    table.speeds.fill(at_speed(1000));  // one pulse a tick
    table.distance_pulses.fill(50);
  }
  void on(std::size_t trigger, Events factors, std::uint8_t activates) {
    table.triggers[trigger] = {.factors = static_cast<std::uint8_t>(factors), .activates = activates};
  }
  void compare(std::size_t axis, std::size_t number, Comparator::Relation relation, std::int64_t value) {
    axes[axis].set_comparator(number, {.relation = relation, .value = value});
  }
  void at_edge(SharedTick& now, std::size_t axis, Events events) override {
    const SyncOutcome outcome = act(table, axis, events, now);
    last.fired[axis] = static_cast<Events>(last.fired[axis] | outcome.fired);
    last.outputs |= outcome.outputs;
    last.interrupts |= outcome.interrupts;
    last.presets_command |= outcome.presets_command;
    last.presets_encoder |= outcome.presets_encoder;
  }
  void step() {
    ++tick;
    last = {};
    std::array<std::int64_t, 4> pulses{};
    step_together({tick, std::span(axes).first(axes_there), environment, pulses}, (1U << axes_there) - 1,
                  nullptr, this);
  }
  void steps(int count) {
    for (; count > 0; --count) step();
  }
};

struct FactorCase {
  const char* what;
  Event factor;
  std::function<void(SyncBench&)> cause;  // before the tick in which it happens
};

TEST(SyncFactor, EachEventActivatesInTheTickItHappensAndNoneBut) {
  const auto moving = [](SyncBench& bench, int direction) {
    bench.axes[0].run(direction, at_speed(1000), bench.tick);
    bench.step();  // at its beginning
    bench.steps(4);
  };
  const FactorCase kCases[]{
      {"P>=C+", Event::comparator_0,
       [&](SyncBench& b) { b.compare(0, 0, Comparator::Relation::at_least, 5), moving(b, +1); }},
      {"P<C+", Event::comparator_1,
       [&](SyncBench& b) { b.compare(0, 1, Comparator::Relation::below, -4), moving(b, -1); }},
      {"P<C-", Event::comparator_2,
       [&](SyncBench& b) { b.compare(0, 2, Comparator::Relation::below, -4), moving(b, -1); }},
      {"P>=C-", Event::comparator_3,
       [&](SyncBench& b) { b.compare(0, 3, Comparator::Relation::at_least, 5), moving(b, +1); }},
      {"drive starts", Event::started, [](SyncBench& b) { b.axes[0].run(+1, at_speed(1000), b.tick); }},
      {"drive ends", Event::ended,
       [&](SyncBench& b) {
         moving(b, +1);
         b.axes[0].stop();
       }},
      {"IN3 on", Event::mark_on, [](SyncBench& b) { b.environment[0].set_steady(Signal::mark, true); }},
      {"IN3 off", Event::mark_off,
       [](SyncBench& b) {
         b.environment[0].set_steady(Signal::mark, true);
         b.step();
         b.environment[0].set_steady(Signal::mark, false);
       }},
  };
  for (const FactorCase& factor : kCases) {
    for (int listening = 0; listening < 8; ++listening) {
      SyncBench bench;
      factor.cause(bench);
      // Only now: what happened on the way does not count.
      bench.on(0, static_cast<Events>(1U << listening), 0b0010);
      bench.table.actions[1].drive = Do::fixed_plus;
      bench.step();
      const bool fires = listening == static_cast<int>(factor.factor);
      EXPECT_EQ(bench.last.fired[0], fires ? bit(factor.factor) : 0) << factor.what << ", " << listening;
      EXPECT_EQ(bench.axes[1].moving(), fires) << factor.what << ", " << listening;
    }
  }
}

TEST(SyncFactor, SeveralInOneMaskFireByWhicheverComesAndTogether) {
  SyncBench bench;
  bench.on(0, bit(Event::started) | bit(Event::mark_on), 0b0110);
  bench.table.actions[1].output = true;
  bench.table.actions[2].interrupt = true;
  bench.axes[0].run(+1, at_speed(1000), bench.tick);
  bench.step();
  EXPECT_EQ(bench.last.fired[0], bit(Event::started));
  EXPECT_EQ(bench.last.outputs, 0b0010);
  EXPECT_EQ(bench.last.interrupts, 0b0100);
  bench.step();
  EXPECT_EQ(bench.last, SyncBench::Last{});
  bench.environment[0].set_steady(Signal::mark, true);
  bench.step();
  EXPECT_EQ(bench.last.fired[0], bit(Event::mark_on));
  bench.axes[0].run(+1, at_speed(1000), bench.tick);
  bench.environment[0].set_steady(Signal::mark, false);
  bench.step();
  bench.axes[0].run(-1, at_speed(1000), bench.tick);
  bench.environment[0].set_steady(Signal::mark, true);
  bench.step();
  EXPECT_EQ(bench.last.fired[0], bit(Event::started) | bit(Event::mark_on));
}

TEST(SyncFactor, AComparatorFiresOnceEachTimeItBecomesTrue) {
  SyncBench bench;
  bench.compare(0, 0, Comparator::Relation::at_least, 10);
  bench.on(0, bit(Event::comparator_0), 0b0001);
  int fired = 0;
  const auto count = [&](int ticks) {
    for (; ticks > 0; --ticks) {
      bench.step();
      fired += bench.last.fired[0] != 0 ? 1 : 0;
    }
  };
  bench.axes[0].move(20, at_speed(1000), bench.tick);
  count(40);
  EXPECT_EQ(fired, 1);
  bench.axes[0].move(-15, at_speed(1000), bench.tick);
  count(40);
  EXPECT_EQ(fired, 1);
  bench.axes[0].move(15, at_speed(1000), bench.tick);
  count(40);
  EXPECT_EQ(fired, 2);
}

struct DriveCase {
  const char* what;
  Do drive;
  std::int64_t standing;  // travel 200 ticks later, of an axis that was at rest
  std::int64_t running;   // ... and of one that moved on at 2 pulses per tick, and was at 20
};

TEST(SyncDrive, EachDriveOnAnAxisThatStandsAndOnOneThatRuns) {
  const DriveCase kCases[]{
      {"none", Do::none, 0, 420},
      {"fixed +", Do::fixed_plus, 50, 420},
      {"fixed -", Do::fixed_minus, -50, 420},
      {"endless +", Do::endless_plus, 198, 420},
      {"endless -", Do::endless_minus, -198, 420},
      {"slow down", Do::slow_down, 0, 20 + 10},
      {"stop at once", Do::stop_at_once, 0, 20},
  };
  for (const DriveCase& drive : kCases) {
    for (const bool runs : {false, true}) {
      SyncBench bench;
      SpeedLaw gentle = at_speed(2000);
      gentle.start_speed_u_s = 0;
      gentle.up = RampLaw::by_slope(1e9);
      gentle.down = RampLaw::by_slope(2000.0 * 2000 / 2 / 10);  // stops in 10 pulses
      if (runs) {
        bench.axes[1].run(+1, gentle, bench.tick);
        while (bench.axes[1].travel_pulses < 19) bench.step();
      }
      bench.on(0, bit(Event::mark_on), 0b0010);
      bench.table.actions[1].drive = drive.drive;
      bench.environment[0].set_steady(Signal::mark, true);
      // It fires at the beginning of this tick.
      bench.steps(200);
      EXPECT_NEAR(static_cast<double>(bench.axes[1].travel_pulses),
                  static_cast<double>(runs ? drive.running : drive.standing), 1)
          << drive.what << (runs ? " running" : " standing");
    }
  }
}

TEST(SyncDrive, WhatAnAxisRefusesIsNotDone) {
  SyncBench bench;
  bench.axes[1].switch_servo(false);
  bench.on(0, bit(Event::mark_on), 0b0110);
  bench.table.actions[1].drive = Do::endless_plus;
  bench.table.actions[2].drive = Do::endless_plus;
  bench.environment[0].set_steady(Signal::mark, true);
  bench.steps(3);
  EXPECT_FALSE(bench.axes[1].moving());
  EXPECT_TRUE(bench.axes[2].moving());
}

TEST(SyncOrder, AnAxisActivatedTwiceInATickBeginsOnce) {
  SyncBench bench;
  for (const std::size_t trigger : {0U, 1U}) bench.on(trigger, bit(Event::mark_on), 0b0100);
  bench.table.actions[2].drive = Do::fixed_plus;
  bench.environment[0].set_steady(Signal::mark, true);
  bench.environment[1].set_steady(Signal::mark, true);
  bench.step();
  EXPECT_EQ(bench.last.fired[0], bit(Event::mark_on));
  EXPECT_EQ(bench.last.fired[1], bit(Event::mark_on));
  bench.steps(100);
  EXPECT_EQ(bench.axes[2].travel_pulses, 50);
}

TEST(SyncOrder, AnEventThatAnActionCausesActsInTheNextTick) {
  // X's end starts Y, Y's start stops Z, and Z's end records the position of X.
  SyncBench bench;
  bench.on(0, bit(Event::ended), 0b0010);
  bench.on(1, bit(Event::started), 0b0100);
  bench.on(2, bit(Event::ended), 0b0001);
  bench.table.actions[0].output = true;
  bench.table.actions[1].drive = Do::fixed_plus;
  bench.table.actions[2].drive = Do::stop_at_once;
  bench.axes[2].run(-1, at_speed(1000), bench.tick);
  bench.axes[0].move(5, at_speed(1000), bench.tick);
  bench.steps(6);  // started in tick 1, ended in tick 6
  EXPECT_EQ(bench.last.fired, (std::array<Events, 4>{bit(Event::ended), 0, 0, 0}));
  EXPECT_TRUE(bench.axes[1].moving());
  EXPECT_TRUE(bench.axes[2].moving());
  bench.step();
  EXPECT_EQ(bench.last.fired, (std::array<Events, 4>{0, bit(Event::started), 0, 0}));
  EXPECT_FALSE(bench.axes[2].moving());
  bench.step();
  EXPECT_EQ(bench.last.fired, (std::array<Events, 4>{0, 0, bit(Event::ended), 0}));
  EXPECT_EQ(bench.last.outputs, 0b0001);
}

TEST(SyncOrder, OneAxisEndStartsTheNextWhoseComparatorStopsAThird) {
  SyncBench bench;
  bench.on(0, bit(Event::ended), 0b0010);
  bench.on(1, bit(Event::comparator_0), 0b0100);
  bench.table.actions[1].drive = Do::endless_plus;
  bench.table.actions[2].drive = Do::stop_at_once;
  bench.compare(1, 0, Comparator::Relation::at_least, 30);
  bench.axes[0].move(20, at_speed(1000), bench.tick);
  bench.axes[2].run(-1, at_speed(1000), bench.tick);
  bench.steps(200);
  // X ends in tick 21; Y is at its beginning in 22 and at 30 in 52; Z started in 1.
  EXPECT_EQ(bench.axes[0].travel_pulses, 20);
  EXPECT_EQ(bench.axes[2].travel_pulses, -51);
  EXPECT_EQ(bench.axes[1].travel_pulses, 200 - 22);
}

TEST(SyncOrder, AxesThatAreNotThereAreLeftOut) {
  SyncBench bench;
  bench.on(0, bit(Event::mark_on), 0b1111);
  bench.on(3, bit(Event::mark_on), 0b1111);
  for (SyncAction& action : bench.table.actions) action = {.drive = Do::fixed_plus, .output = true};
  for (Environment& environment : bench.environment) environment.set_steady(Signal::mark, true);
  bench.axes_there = 2;
  bench.step();
  EXPECT_EQ(bench.last.outputs, 0b0011);
  EXPECT_EQ(bench.last.fired[3], 0);
  EXPECT_FALSE(bench.axes[2].moving());
}

TEST(SyncPreset, PresetsAreTakenBeforeTheDriveOfTheSameAction) {
  SyncBench bench;
  bench.on(0, bit(Event::mark_on), 0b0110);
  bench.table.actions[1] = {
      .drive = Do::fixed_minus, .preset = SyncAction::Preset::distance, .preset_value = 7};
  bench.table.actions[2] = {
      .drive = Do::fixed_plus, .preset = SyncAction::Preset::speed, .preset_value = 10'000};
  bench.environment[0].set_steady(Signal::mark, true);
  bench.steps(1 + 1 + 6);
  EXPECT_EQ(bench.axes[2].travel_pulses, 50);  // at ten per tick, within six ticks
  bench.steps(10);
  EXPECT_EQ(bench.axes[1].travel_pulses, -7);
  EXPECT_EQ(bench.table.distance_pulses, (std::array<std::int64_t, 4>{50, 7, 50, 50}));
  EXPECT_EQ(bench.table.speeds[2].top_speed_u_s, 10'000);
}

TEST(SyncPreset, CountsAreTheOwnersAndASpeedBelowOneIsNone) {
  SyncBench bench;
  bench.on(0, bit(Event::mark_on), 0b1111);
  bench.table.actions[0] = {.preset = SyncAction::Preset::command, .preset_value = 5};
  bench.table.actions[1] = {.preset = SyncAction::Preset::encoder, .preset_value = 6};
  bench.table.actions[2] = {.preset = SyncAction::Preset::speed, .preset_value = 0};
  bench.environment[0].set_steady(Signal::mark, true);
  const SyncTable before = bench.table;
  bench.step();
  EXPECT_EQ(bench.last.presets_command, 0b0001);
  EXPECT_EQ(bench.last.presets_encoder, 0b0010);
  EXPECT_EQ(bench.table, before);
}

TEST(SyncPreset, AnEndlessRunGoesByTheSpeedThereWas) {
  SyncBench bench;
  bench.on(0, bit(Event::mark_on), 0b0010);
  bench.table.actions[1] = {
      .drive = Do::endless_plus, .preset = SyncAction::Preset::speed, .preset_value = 10'000};
  bench.environment[0].set_steady(Signal::mark, true);
  bench.steps(12);
  EXPECT_EQ(bench.axes[1].travel_pulses, 10);
}

}  // namespace synchronous_action_test
}  // namespace understudy::motion
