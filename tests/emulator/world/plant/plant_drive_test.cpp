// A servo drive: Ready after its delay, pulses without Ready, the alarm and its contact, ACLR.
#include <gtest/gtest.h>

#include <vector>

#include "emulator/world/plant/plant.h"

namespace understudy::emulator::world {
namespace plant_drive_test {

PlantSetup with_drive(const DriveSetup& drive) {
  PlantSetup setup;
  setup.drive = drive;
  return setup;
}

constexpr DriveInputs kOff{};
constexpr DriveInputs kOn{.servo = true};
constexpr DriveInputs kOnAndClear{.servo = true, .alarm_clear = true};

TEST(PlantDrive, IsReadySoManyTicksAfterItIsEnabledToTheMillisecond) {
  for (const Tick delay : {0, 1, 2, 7, 120}) {
    for (const bool by : {true, false}) {
      PlantAxis axis(with_drive({.ready_after = delay, .enabled_by = by}));
      for (Tick tick = 1; tick <= 10; ++tick) {
        axis.step(tick, 0, {.servo = !by});
        ASSERT_FALSE(axis.ready());
      }
      for (Tick tick = 11; tick <= 11 + delay + 5; ++tick) {
        axis.step(tick, 0, {.servo = by});
        ASSERT_EQ(axis.ready(), tick >= 11 + delay) << "delay " << delay << " tick " << tick;
      }
    }
  }
}

TEST(PlantDrive, LosesThePulsesBeforeReadyAndMakesTheOthers) {
  // Enabled in tick 5, ready 3 ticks later at the end, so the pulses of tick 9 are the first that step.
  PlantAxis axis(with_drive({.ready_after = 3}));
  for (Tick tick = 1; tick <= 20; ++tick) axis.step(tick, 10, tick >= 5 ? kOn : kOff);
  EXPECT_EQ(axis.lost_pulses(), 8 * 10);
  EXPECT_EQ(axis.position_pulses(), 12 * 10);
}

TEST(PlantDrive, WithoutADelayStepsFromTheTickAfterItIsEnabled) {
  PlantAxis axis(with_drive({}));
  axis.step(1, -7, kOn);
  EXPECT_TRUE(axis.ready());
  EXPECT_EQ(axis.position_pulses(), 0);
  axis.step(2, -7, kOn);
  EXPECT_EQ(axis.position_pulses(), -7);
  EXPECT_EQ(axis.lost_pulses(), 7);
}

TEST(PlantDrive, DisabledInMidMoveStopsInTheNextTickAndWaitsAgain) {
  PlantAxis axis(with_drive({.ready_after = 4}));
  for (Tick tick = 1; tick <= 30; ++tick) axis.step(tick, 1, tick == 15 ? kOff : kOn);
  // Ready at tick 5; ticks 6 to 15 step (it is disabled in 15). Enabled again at 16, ready at 20: 21 to 30
  // step.
  EXPECT_EQ(axis.position_pulses(), 10 + 10);
  EXPECT_EQ(axis.lost_pulses(), 10);
}

TEST(PlantDrive, AnInterruptionOfOneTickRestartsTheDelay) {
  PlantAxis axis(with_drive({.ready_after = 10}));
  for (Tick tick = 1; tick <= 40; ++tick) {
    axis.step(tick, 0, tick == 10 ? kOff : kOn);
    EXPECT_EQ(axis.ready(), tick >= 21) << tick;  // it would have been ready at 11
  }
}

TEST(PlantDrive, AnAlarmStopsTheMotorAtOnceAndTakesReadyAway) {
  PlantAxis axis(with_drive({.ready_after = 2}));
  Tick tick = 0;
  while (tick < 10) axis.step(++tick, 1, kOn);
  EXPECT_EQ(axis.position_pulses(), 7);  // ready at 3, steps in 4 to 10
  axis.faults().alarm = true;
  EXPECT_TRUE(axis.in_alarm());
  axis.step(++tick, 1, kOn);
  EXPECT_FALSE(axis.ready());
  EXPECT_EQ(axis.position_pulses(), 7);
  EXPECT_EQ(axis.lost_pulses(), 4);
}

TEST(PlantDrive, AnAlarmLastsUntilClearedEvenIfItsCauseIsGone) {
  PlantAxis axis(with_drive({.ready_after = 2}));
  axis.faults().alarm = true;
  struct Step {
    bool cause;
    DriveInputs inputs;
    bool alarm, ready;  // afterwards
  };
  Tick tick = 0;
  for (const Step& step : std::vector<Step>{{true, kOn, true, false},
                                            {true, kOnAndClear, true, false},  // the cause persists
                                            {true, kOn, true, false},
                                            {false, kOn, true, false},  // latched
                                            {false, kOn, true, false},
                                            {false, kOff, true, false},  // and not by disabling it
                                            {false, kOn, true, false},
                                            {false, kOnAndClear, false, false},  // enabled again: 8
                                            {false, kOnAndClear, false, false},
                                            {false, kOn, false, true},  // 10
                                            {false, kOn, false, true},
                                            {false, kOnAndClear, false, true},  // nothing to clear
                                            {true, kOnAndClear, true, false},
                                            {false, kOnAndClear, false, false},
                                            {true, kOn, true, false},
                                            {true, kOnAndClear, true, false},
                                            {false, kOn, true, false},  // cleared too early: still on
                                            {false, {.alarm_clear = true}, false, false},
                                            {false, kOn, false, false},
                                            {false, kOn, false, false},
                                            {false, kOn, false, true}}) {
    axis.faults().alarm = step.cause;
    axis.step(++tick, 0, step.inputs);
    EXPECT_EQ(axis.in_alarm(), step.alarm) << tick;
    EXPECT_EQ(axis.ready(), step.ready) << tick;
  }
}

TEST(PlantDrive, ItsAlarmContactOpensOrCloses) {
  for (const bool opens : {false, true}) {
    PlantAxis axis(with_drive({.alarm_opens = opens}));
    EXPECT_EQ(axis.contact(Contact::alarm), opens) << "closed without an alarm, if it opens with one";
    axis.step(1, 0, kOn);
    EXPECT_EQ(axis.contact(Contact::alarm), opens);
    axis.faults().alarm = true;
    EXPECT_EQ(axis.contact(Contact::alarm), !opens);
    axis.step(2, 0, kOn);
    axis.faults().alarm = false;
    axis.step(3, 0, kOn);
    EXPECT_EQ(axis.contact(Contact::alarm), !opens) << "latched";
    axis.step(4, 0, kOnAndClear);
    EXPECT_EQ(axis.contact(Contact::alarm), opens);
  }
}

TEST(PlantDrive, WithoutOneAnAlarmFollowsItsCauseAndReadyStaysOff) {
  PlantAxis axis;
  axis.step(1, 5, kOn);
  EXPECT_FALSE(axis.has_drive());
  EXPECT_FALSE(axis.ready());
  EXPECT_FALSE(axis.contact(Contact::alarm));
  EXPECT_EQ(axis.position_pulses(), 5) << "every pulse is a step";
  axis.faults().alarm = true;
  axis.step(2, 5, kOn);
  EXPECT_TRUE(axis.contact(Contact::alarm));
  EXPECT_EQ(axis.position_pulses(), 5);
  axis.faults().alarm = false;
  EXPECT_FALSE(axis.contact(Contact::alarm));
  axis.step(3, 5, kOn);
  EXPECT_EQ(axis.position_pulses(), 10);
  EXPECT_EQ(axis.lost_pulses(), 5);
}

}  // namespace plant_drive_test
}  // namespace understudy::emulator::world
