// A machine that is stepped only when it says so, or when something comes from outside, is the machine that
// is stepped every tick.
#include <gtest/gtest.h>

#include <random>

#include "emulator/plant/plant.h"

namespace understudy::emulator {
namespace {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(engine_);
  }
  bool one_in(int n) { return between(1, n) == 1; }

 private:
  std::mt19937_64 engine_;
};

PlantSetup random_setup(Random& random) {
  PlantSetup setup;
  if (random.one_in(2)) setup.travel = PulseSpan{-random.between(0, 500), random.between(0, 500)};
  if (random.one_in(2)) setup.home = PulseSpan{random.between(-60, 0), random.between(0, 60)};
  if (random.one_in(2)) setup.lower_limit = -random.between(50, 400);
  if (random.one_in(2)) setup.upper_limit = random.between(50, 400);
  setup.home_hysteresis_pulses = random.between(0, 20);
  setup.limit_hysteresis_pulses = random.between(0, 20);
  setup.encoder_counts_per_revolution = static_cast<int>(random.between(0, 5000));
  setup.pulses_per_revolution = static_cast<int>(random.between(1, 5000));
  setup.encoder_reversed = random.one_in(2);
  if (!random.one_in(4)) {
    setup.drive = DriveSetup{.ready_after = random.one_in(3) ? 0 : random.between(1, 60),
                             .enabled_by = !random.one_in(3),
                             .alarm_opens = random.one_in(2)};
  }
  return setup;
}

/// What comes from outside: held until it changes.
struct Outside {
  DriveInputs inputs;
  MachineFaults faults;  // but for slips
};

void change(Outside& outside, Random& random) {
  switch (random.between(0, 5)) {
    case 0: outside.inputs.servo = !outside.inputs.servo; break;
    case 1: outside.inputs.alarm_clear = !outside.inputs.alarm_clear; break;
    case 2: outside.faults.alarm = !outside.faults.alarm; break;
    case 3: outside.faults.stalled = random.one_in(3); break;
    case 4: outside.faults.loses_one_in = random.one_in(2) ? 0 : random.between(1, 40); break;
    default: break;
  }
}

TEST(PlantTicks, ThatNothingHappensInMayBeLeftOut) {
  int left_out = 0;
  int became_ready = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    Random random(seed);
    const PlantSetup setup = random_setup(random);
    PlantAxis every(setup);
    PlantAxis seldom(setup);
    Outside outside;
    every.step(0, 0, outside.inputs);  // as a world begins
    seldom.step(0, 0, outside.inputs);
    Tick done = 0;
    for (Tick tick = 1; tick <= 3000; ++tick) {
      const bool disturbed = random.one_in(25);
      std::int64_t slip = 0;
      if (disturbed) {
        change(outside, random);
        slip = random.one_in(6) ? random.between(-200, 200) : 0;
      }
      const std::int64_t pulses = tick / 100 % 3 == 0 ? random.between(-30, 30) : 0;

      MachineFaults faults = outside.faults;
      faults.slipped_pulses = slip;
      if (disturbed) every.set_faults(faults);
      const bool was_ready = every.ready();
      every.step(tick, pulses, outside.inputs);
      became_ready += every.ready() && !was_ready;

      if (disturbed) seldom.set_faults(faults);
      if (disturbed || pulses != 0 || seldom.next_active_tick(done) <= tick) {
        seldom.step(tick, pulses, outside.inputs);
        done = tick;
      } else {
        ++left_out;
      }
      ASSERT_TRUE(every.same_state(seldom)) << "seed " << seed << " tick " << tick;
    }
  }
  EXPECT_GT(left_out, 100'000);
  EXPECT_GT(became_ready, 500);
}

TEST(PlantTicks, AreWantedForASlipAndForReadyAlone) {
  PlantSetup setup;
  setup.drive = DriveSetup{.ready_after = 40};
  PlantAxis axis(setup);
  axis.step(0, 0, {});
  EXPECT_EQ(axis.next_active_tick(0), kNever);
  axis.step(10, 0, {.servo = true});
  EXPECT_EQ(axis.next_active_tick(10), 50);
  EXPECT_EQ(axis.next_active_tick(30), 50);
  axis.faults().slipped_pulses = 1;
  EXPECT_EQ(axis.next_active_tick(30), 31);
  axis.step(31, 0, {.servo = true});
  EXPECT_EQ(axis.next_active_tick(31), 50);
  axis.step(50, 0, {.servo = true});
  EXPECT_TRUE(axis.ready());
  EXPECT_EQ(axis.next_active_tick(50), kNever);
}

}  // namespace
}  // namespace understudy::emulator
