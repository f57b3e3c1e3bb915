// Choices about homing, velocity, PWM and sync mode.
#include "emulator/device/axes.h"
#include "emulator/models/simple2_r3/device.h"
#include "tests/emulator/models/simple2_r3/choice_cases.h"

namespace understudy::emulator::models::simple2_r3 {
namespace choices_modes_test {

std::uint8_t pwm_percent(OneSimple2& feeder) {
  return static_cast<const Simple2R3&>(feeder.device()).state().axes[0].pwm_percent;
}

/// A machine with a home switch at 100 to 150 and a lower limit at -50; homing at one pulse a tick, with
/// ramps of 10 ms, which take 5 pulses.
struct HomingMachine : ReadySimple2 {
  explicit HomingMachine(Given given) : ReadySimple2(with_switches(given)) {
    set("Aaxis_Resoultion", 3000);
    set("Aaxis_Home_Speed", 20);
    set("Axis_GoHome_DIR", 1);
    set("DIN3_Aaxis_DN_Limit", 1);
    set("DIN4_Aaxis_Home", 1);
  }
  void home() {
    set("Aaxis_GoHome", 1);
    run(1500);
    EXPECT_FALSE(moving('A'));
  }
  std::int64_t place() { return world().plant(0, 0).position_pulses(); }

  static Given with_switches(Given given) {
    world::PlantSetup machine;
    machine.home = world::PulseSpan{100, 150};
    machine.lower_limit = -50;
    given.plant[0] = machine;
    return given;
  }
};

TEST(ChoicesHoming, SequenceEndsOnTheEdgeOrBehindIt) {
  // The switch is seen on at 100; slowing down takes five pulses more.
  for (const auto& [option, place] :
       each_option("homing_sequence", {{"edge_met_in_direction", 100}, {"stops_at_first_edge", 105}})) {
    HomingMachine up(with("homing_sequence", option));
    up.home();
    EXPECT_EQ(up.place(), place) << option;
    EXPECT_TRUE(up.bit("STATUS.8")) << option;
    EXPECT_EQ(up.coordinate('A'), 0) << option;

    // Again, from on the switch: ours goes off it and comes again, the other is there already.
    up.home();
    EXPECT_EQ(up.place(), place) << option;
  }
  for (const auto& [option, place] :
       each_option("homing_sequence", {{"edge_met_in_direction", 150}, {"stops_at_first_edge", 105}})) {
    // Downwards first: the limit turns it round, and it meets the switch from below. Ours runs past it, for
    // the edge that is met downwards.
    HomingMachine down(with("homing_sequence", option));
    down.set("Axis_GoHome_DIR", 0);
    down.home();
    EXPECT_EQ(down.place(), place) << option;
    EXPECT_TRUE(down.bit("STATUS.8")) << option;
  }
}

TEST(ChoicesHoming, HomeBitLastsUntilTheNextHomingOrTheNextMotion) {
  const std::vector<std::pair<std::string, Value>> motions{
      {"Aaxis_Move_INC", 1}, {"Aaxis_Move_ABS", 1}, {"Aaxis_DirectmRPM", 5000}, {"Aaxis_SyncMode", 1}};
  for (const auto& [option, lasts] :
       each_option<bool>("home_bit", {{"homing_begins", true}, {"any_motion", false}})) {
    for (const auto& [command, value] : motions) {
      HomingMachine feeder(with("home_bit", option));
      feeder.home();
      feeder.set_one_pulse_a_tick('A', 100);
      feeder.set("Aaxis_Pulse", 0);
      feeder.set("Aaxis_Move_INC", 1);  // no motion
      EXPECT_TRUE(feeder.bit("STATUS.8")) << option;
      feeder.set("Aaxis_Pulse", 100);
      feeder.set(command, value);
      EXPECT_EQ(feeder.bit("STATUS.8"), lasts) << option << ", " << command;
      feeder.set("Aaxis_GoHome", 1);
      EXPECT_FALSE(feeder.bit("STATUS.8")) << option;
    }
  }
}

TEST(ChoicesModes, MovingBitShowsEveryModeOrPositionMovesOnly) {
  for (const auto& [option, shown] :
       each_option<bool>("moving_bit", {{"every_mode", true}, {"position_only", false}})) {
    ReadySimple2 feeder(with("moving_bit", option));
    feeder.set("Aaxis_DirectmRPM", 5000);
    EXPECT_EQ(feeder.moving('A'), shown) << option;
    feeder.set("Aaxis_DirectPWM", 40);
    EXPECT_EQ(feeder.moving('A'), shown) << option;
    feeder.set_one_pulse_a_tick('A', 100);
    feeder.set("Aaxis_Move_INC", 1);
    EXPECT_TRUE(feeder.moving('A')) << option;
  }
}

TEST(ChoicesModes, VelocityUnitIsLiteralOrAThousandTimesThat) {
  // 1000 units: 0.001 RPM each half millisecond, or 1 RPM. After 100 ms 0.2 RPM, or 200 RPM, and turns of the
  // mean of all steps: 200 * 201 / 2 * 0.5 ms / 60 s = 0.1675 times the step in RPM, of 3200 pulses.
  for (const auto& [option, pulses] :
       each_option("velocity_unit", {{"literal", 0}, {"two_rpm_per_second", 536}})) {
    ReadySimple2 feeder(with("velocity_unit", option));
    feeder.set("Aaxis_DirectmRPM", 1'000'000);
    feeder.run(100);
    EXPECT_EQ(feeder.coordinate('A'), pulses) << option;
  }
}

TEST(ChoicesModes, VelocityStepChangesSpeedOrCountsPulsesFirst) {
  // 32768 uRPM a step: 32768e-6 / 60 * 0.0005 * 3200 = 8.738e-4 pulses a step, times 1 + ... + 2000 =
  // 2001000, or 0 + ... + 1999 = 1999000: 1748.5 and 1746.8.
  for (const auto& [option, pulses] : each_option("velocity_step", {{"speed", 1748}, {"pulses", 1746}})) {
    ReadySimple2 feeder(with("velocity_step", option));
    feeder.set("Axis_VelMode_ACC", 32768);
    feeder.set("Aaxis_DirectmRPM", 1'000'000);
    feeder.run(1000);
    EXPECT_EQ(feeder.coordinate('A'), pulses) << option;
  }
}

TEST(ChoicesModes, ModeAfterStopIsPositionOrStays) {
  for (const char* stop : {"Aaxis_STOP", "Aaxis_SVON"}) {
    for (const auto& [option, stays] :
         each_option<bool>("mode_after_stop", {{"position", false}, {"stays", true}})) {
      ReadySimple2 feeder(with("mode_after_stop", option));
      const auto mode_after = [&, &choice = option](const char* command, Value value) {
        feeder.set("Aaxis_SVON", 1);
        feeder.set(command, value);
        feeder.run(5);
        feeder.set(stop, std::string_view(stop) == "Aaxis_STOP" ? 1 : 0);
        EXPECT_FALSE(feeder.moving('A')) << choice << ", " << command;
        return feeder.get("Aaxis_Mode");
      };
      EXPECT_EQ(mode_after("Aaxis_DirectmRPM", 5000), stays ? 1 : 0) << option;
      EXPECT_EQ(mode_after("Aaxis_DirectPWM", 40), stays ? 2 : 0) << option;
      EXPECT_EQ(pwm_percent(feeder), 0);
      EXPECT_EQ(mode_after("Aaxis_SyncMode", 1), 0) << option << ": STOP is said to leave sync mode";
      feeder.set("Aaxis_SVON", 1);
      feeder.set("Aaxis_DirectPWM", 40);
      feeder.set("Aaxis_STOP", 1);
      feeder.set_one_pulse_a_tick('A', 100);
      feeder.set("Aaxis_Move_INC", 1);
      EXPECT_EQ(feeder.get("Aaxis_Mode"), 0) << option;
    }
  }
}

TEST(ChoicesModes, DroppedValueIsStoredOrForgotten) {
  for (const auto& [option, stored] :
       each_option<bool>("dropped_value", {{"stored", true}, {"forgotten", false}})) {
    ReadySimple2 feeder(with("dropped_value", option));
    feeder.set("DIN2_Aaxis_UP_Limit", 1);
    feeder.input(2, true);
    feeder.run(1);
    feeder.set("Aaxis_DirectmRPM", -700);
    feeder.set("Aaxis_DirectmRPM", 5000);  // into the limit: it counts as 0
    EXPECT_EQ(feeder.get("Aaxis_DirectmRPM"), stored ? 5000 : 0) << option;
    feeder.set("Aaxis_SVON", 0);
    feeder.set("Aaxis_DirectmRPM", 5000);
    feeder.set("Aaxis_DirectPWM", 40);
    EXPECT_EQ(feeder.get("Aaxis_DirectmRPM"), stored ? 5000 : 0) << option;
    EXPECT_EQ(feeder.get("Aaxis_DirectPWM"), stored ? 40 : 0) << option;
  }
}

TEST(ChoicesModes, PwmNeedsTheServoOrNot) {
  for (const auto& [option, percent] : each_option("pwm_servo", {{"needed", 0}, {"not_needed", 40}})) {
    OneSimple2 feeder(with("pwm_servo", option));
    feeder.set("Aaxis_DirectPWM", 40);
    EXPECT_EQ(pwm_percent(feeder), percent) << option;
    EXPECT_EQ(feeder.get("Aaxis_Mode"), percent == 0 ? 0 : 2) << option;
    feeder.set("Aaxis_SVON", 1);
    feeder.set("Aaxis_DirectPWM", 40);
    feeder.set("Aaxis_SVON", 0);
    EXPECT_EQ(pwm_percent(feeder), percent) << option;
    feeder.set_one_pulse_a_tick('A', 100);
    feeder.set("Aaxis_Move_INC", 1);
    EXPECT_FALSE(feeder.bit("Aaxis_Move_INC")) << "pulses need it in either case";
    feeder.set("Aaxis_STOP", 1);
    EXPECT_EQ(pwm_percent(feeder), 0) << option;
  }
}

TEST(ChoicesModes, SyncSlopeIsInRpmOrInPulsesEachPeriod) {
  // At 60000 pulses per revolution 1 RPM is 1000 a second, 5 in 5 ms. A slope of 3: 15, 30 and 45 pulses in
  // the first three periods, or 3, 6 and 9.
  for (const auto& [option, pulses] : each_option("sync_slope", {{"rpm", 90}, {"pulses", 18}})) {
    ReadySimple2 feeder(with("sync_slope", option));
    feeder.set("Aaxis_Resoultion", 60'000);
    feeder.set("Axis_SyncSlope", 3);
    feeder.set("Aaxis_SyncMode", 1);
    for (int tick = 1; tick <= 15; ++tick) {
      feeder.device().axes()->set_encoder(0, 1000 * tick);
      feeder.run(1);
    }
    EXPECT_EQ(feeder.coordinate('A'), pulses) << option;
  }
}

TEST(ChoicesModes, SyncPeriodsBeginWithTheCommandOrAtEveryFifthTick) {
  struct Expected {
    Value at_13, at_15, at_17, at_19;
  };
  // Ten counts, two pulses per tick over a period; the command comes after tick 12.
  for (const auto& [option, expected] : each_option<Expected>(
           "sync_period", {{"at_sync_start", {2, 6, 10, 10}}, {"every_fifth_tick", {0, 2, 6, 10}}})) {
    ReadySimple2 feeder(with("sync_period", option));
    feeder.run_to(12);
    feeder.set("Aaxis_SyncMode", 1);
    feeder.device().axes()->set_encoder(0, 10);
    for (const auto& [tick, pulses] : {std::pair{13, expected.at_13}, std::pair{15, expected.at_15},
                                       std::pair{17, expected.at_17}, std::pair{19, expected.at_19}}) {
      feeder.run_to(tick);
      EXPECT_EQ(feeder.coordinate('A'), pulses) << option << ", tick " << tick;
    }
  }
}

TEST(ChoicesModes, EncoderSpeedIsOver100Or10Milliseconds) {
  // 16 counts per tick of 3200 are 300 RPM; after 10 ticks of the last 100, a tenth of that.
  for (const auto& [option, rpm] :
       each_option("encoder_speed", {{"window_of_100ms", 30}, {"window_of_10ms", 300}})) {
    ReadySimple2 feeder(with("encoder_speed", option));
    feeder.set("Axis_EncSync_NUM", 0);  // what is fed past a machine wakes no device, but sync mode looks
    feeder.set("Aaxis_SyncMode", 1);
    for (int tick = 1; tick <= 100; ++tick) {
      feeder.device().axes()->set_encoder(0, 16 * tick);
      feeder.run(1);
      if (tick == 10) {
        EXPECT_EQ(feeder.get("ENCA_RPM"), rpm) << option;
      }
    }
    EXPECT_EQ(feeder.get("ENCA_RPM"), 300) << option;
  }
}

}  // namespace choices_modes_test
}  // namespace understudy::emulator::models::simple2_r3
