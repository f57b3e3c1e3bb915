// A machine that is stepped only when it requests it, or when something changes from outside, equals a
// machine that is stepped every tick.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "emulator/world/plant/plant.h"
#include "tests/emulator/world/same_world.h"

namespace understudy::emulator::world {
namespace plant_tick_test {

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

/// Levels from outside, held until they change.
struct Outside {
  DriveInputs inputs;
  MachineFaults faults;  // except for slips
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
    every.step(0, 0, outside.inputs);  // in the initial state of a world
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
      ASSERT_TRUE(same_state(every, seldom)) << "seed " << seed << " tick " << tick;
    }
  }
  EXPECT_GT(left_out, 100'000);
  EXPECT_GT(became_ready, 500);
}

TEST(PlantTicks, AreTheSameQuietlyAndInFull) {
  int quiet = 0;
  int switched = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Random random(seed);
    PlantSetup setup = random_setup(random);
    if (!random.one_in(8)) setup.drive.reset();
    setup.has_wheel = random.one_in(8);
    setup.position_pulses = random.between(-500, 500);
    PlantAxis in_full(setup);
    PlantAxis quietly(setup);
    Outside outside;
    for (Tick tick = 1; tick <= 2000; ++tick) {
      if (random.one_in(60)) {
        change(outside, random);
        MachineFaults faults = outside.faults;
        if (random.one_in(6)) faults.slipped_pulses = random.between(-200, 200);
        if (random.one_in(6)) faults.encoder_noise_counts = random.between(-3, 3);
        for (PlantAxis* plant : {&in_full, &quietly}) plant->set_faults(faults);
      }
      if (random.one_in(300)) outside.faults = {};
      if (random.one_in(200)) {
        const std::int64_t counts = random.between(-50, 50);
        for (PlantAxis* plant : {&in_full, &quietly}) plant->turn(counts, 20);
      }
      if (random.one_in(500)) {
        PlantAxis::State state = in_full.save();
        state.position_pulses = random.between(-500, 500);
        for (bool* on :
             {&state.at_home, &state.at_lower_limit, &state.at_upper_limit, &state.alarm_latched}) {
          *on = random.one_in(3);
        }
        for (PlantAxis* plant : {&in_full, &quietly}) plant->restore(state);
      }
      const std::int64_t pulses =
          tick / 50 % 3 == 0 ? 0 : random.between(-12, 12) + (tick / 400 % 2 ? 3 : -3);
      const auto contacts = [](const PlantAxis& plant) {
        std::array<bool, kContactNames.size()> closed{};
        for (std::size_t i = 0; i < closed.size(); ++i) closed[i] = plant.contact(static_cast<Contact>(i));
        return closed;
      };
      const auto before = contacts(quietly);
      in_full.step(tick, pulses, outside.inputs);
      if (quietly.step_quietly(pulses)) {
        ++quiet;
        ASSERT_EQ(contacts(quietly), before) << "seed " << seed << " tick " << tick;
        ASSERT_EQ(quietly.quiet_encoder_counts(), in_full.encoder_counts()) << "seed " << seed;
      } else {
        quietly.step(tick, pulses, outside.inputs);
        switched += contacts(quietly) != before;
      }
      ASSERT_TRUE(same_state(in_full, quietly)) << "seed " << seed << " tick " << tick;
      ASSERT_EQ(quietly.encoder_counts(), in_full.encoder_counts());
    }
  }
  EXPECT_GT(quiet, 100'000);
  EXPECT_GT(switched, 1000);
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

}  // namespace plant_tick_test
}  // namespace understudy::emulator::world
