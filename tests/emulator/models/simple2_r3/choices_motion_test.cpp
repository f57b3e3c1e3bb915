// Choices about moves: what begins one, what stops it, what it counts.
//
// At one pulse a tick (OneSimple2::set_one_pulse_a_tick) a move that is commanded in tick 10 is at its
// beginning in tick 11, has floor(t - 5) pulses at 11 + t from 10 ms on, and ends after its pulses and 10 ms.
#include "tests/emulator/models/simple2_r3/choice_cases.h"

namespace understudy::emulator::models::simple2_r3 {
namespace choices_motion_test {

/// Half-way through a move of 100 pulses: 50 are out.
struct HalfWay : ReadySimple2 {
  explicit HalfWay(const Given& given) : ReadySimple2(given) {
    set_one_pulse_a_tick('A', 100);
    set("Aaxis_Move_INC", 1);
    run_to(11 + 55);
    EXPECT_EQ(coordinate('A'), 50);
  }
};

TEST(ChoicesMotion, CommandWhileMovingReplacesTheMoveOrIsIgnored) {
  for (const auto& [option, end] :
       each_option("command_while_moving", {{"replaces", 150}, {"ignored", 100}})) {
    HalfWay feeder(with("command_while_moving", option));
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run(200);
    EXPECT_EQ(feeder.coordinate('A'), end) << option;
    feeder.set("Aaxis_Move_INC", 1);  // at rest: accepted either way
    feeder.run(20);
    feeder.set("Aaxis_GoHome", 1);
    EXPECT_EQ(feeder.bit("STATUS.6"), option == "replaces") << option;
  }
}

TEST(ChoicesMotion, IncrementalInMotionCountsFromHereOrTheOldTarget) {
  for (const auto& [option, end] :
       each_option("incremental_while_moving", {{"present_place", 150}, {"old_target", 200}})) {
    HalfWay feeder(with("incremental_while_moving", option));
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run(300);
    EXPECT_EQ(feeder.coordinate('A'), end) << option;
    feeder.set("Aaxis_Pulse", 30);
    feeder.set("Aaxis_Move_ABS", 1);
    feeder.run(300);
    EXPECT_EQ(feeder.coordinate('A'), 30) << option;
  }
  for (const auto& [option, end] :
       each_option("incremental_while_moving", {{"present_place", 20}, {"old_target", 70}})) {
    HalfWay feeder(with("incremental_while_moving", option));
    feeder.set("Aaxis_Pulse", -30);  // back by 30 from 50, or from 100
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run(300);
    EXPECT_EQ(feeder.coordinate('A'), end) << option;
  }
}

TEST(ChoicesMotion, ModeChangeWhileMovingReplacesTheMoveOrIsIgnored) {
  const std::vector<std::tuple<std::string, Value, Value>> commands{
      {"Aaxis_DirectmRPM", 1000, 1}, {"Aaxis_DirectPWM", 40, 2}, {"Aaxis_SyncMode", 1, 3}};
  for (const auto& [option, replaces] :
       each_option<bool>("mode_change_while_moving", {{"replaces", true}, {"ignored", false}})) {
    for (const auto& [command, value, mode] : commands) {
      HalfWay feeder(with("mode_change_while_moving", option));
      feeder.set(command, value);
      EXPECT_EQ(feeder.get("Aaxis_Mode"), replaces ? mode : 0) << option << ", " << command;
      EXPECT_EQ(feeder.bit("Aaxis_Move_INC"), !replaces) << option << ", " << command;
      if (replaces) continue;
      feeder.run(200);
      EXPECT_EQ(feeder.coordinate('A'), 100) << command;
      feeder.set(command, value);
      EXPECT_EQ(feeder.get("Aaxis_Mode"), mode) << "it does not move";
    }
  }
}

TEST(ChoicesMotion, SpeedWhileMovingWaitsForTheNextMoveOrCountsAtOnce) {
  for (const auto& [option, in_100_ticks] :
       each_option("speed_while_moving", {{"next_move", 100}, {"at_once", 200}})) {
    ReadySimple2 feeder(with("speed_while_moving", option));
    feeder.set_one_pulse_a_tick('A', 10'000);
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run(100);
    feeder.set("Aaxis_Speed", 40);  // two pulses per tick, after 10 ms
    feeder.run(100);
    const Value before = feeder.coordinate('A');
    feeder.run(100);
    EXPECT_EQ(feeder.coordinate('A') - before, in_100_ticks) << option;
    feeder.set("Aaxis_Speed", 0);  // means the next move
    feeder.run(100);
    EXPECT_EQ(feeder.coordinate('A') - before, 2 * in_100_ticks) << option;
    feeder.run_while_moving('A');
    EXPECT_EQ(feeder.coordinate('A'), 10'000) << option;
  }
  for (const char* option : {"next_move", "at_once"}) {
    ReadySimple2 feeder(with("speed_while_moving", option));
    feeder.set_one_pulse_a_tick('A', 0);
    feeder.set("Parms_Pulse1", 10'000);
    feeder.set("Parms_Speed1", 20);
    feeder.set("Aaxis_ParmsMove_INC", 1);  // the set's speed is its own
    feeder.run(100);
    feeder.set("Aaxis_Speed", 40);
    feeder.run(100);
    const Value before = feeder.coordinate('A');
    feeder.run(100);
    EXPECT_EQ(feeder.coordinate('A') - before, 100) << option;
  }
}

TEST(ChoicesMotion, ResolutionInMotionWaitsForTheNextMoveOrActsAtOnce) {
  for (const auto& [option, in_100_ticks] :
       each_option("speed_while_moving", {{"next_move", 100}, {"at_once", 200}})) {
    ReadySimple2 feeder(with("speed_while_moving", option));
    feeder.set_one_pulse_a_tick('A', 10'000);
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run(100);
    feeder.set("Aaxis_Resoultion", 6000);  // 20 RPM are two pulses per tick now
    feeder.run(100);
    const Value before = feeder.coordinate('A');
    feeder.run(100);
    EXPECT_EQ(feeder.coordinate('A') - before, in_100_ticks) << option;
  }
}

TEST(ChoicesMotion, PulseRateCapLowersTheSpeedOrDropsTheCommand) {
  // At 3000 pulses per revolution 100 kHz is 2000 RPM.
  for (const auto& [option, runs] :
       each_option<bool>("pulse_rate_cap", {{"speed_lowered", true}, {"command_dropped", false}})) {
    ReadySimple2 feeder(with("pulse_rate_cap", option));
    feeder.set_one_pulse_a_tick('A', 100'000);
    const auto begins = [&](const char* command, Value value) {
      feeder.set(command, value);
      const bool begun = feeder.moving('A');
      feeder.set("Aaxis_STOP", 1);
      return begun;
    };
    feeder.set("Aaxis_Speed", 2001);
    feeder.set("Aaxis_Home_Speed", 2001);
    EXPECT_EQ(begins("Aaxis_Move_INC", 1), runs) << option;
    EXPECT_EQ(begins("Aaxis_GoHome", 1), runs) << option;
    EXPECT_EQ(begins("Aaxis_DirectmRPM", 2'000'001), runs) << option;
    EXPECT_EQ(begins("Aaxis_DirectmRPM", -2'000'001), runs) << option;
    feeder.set("Aaxis_Speed", 2000);
    feeder.set("Aaxis_Home_Speed", 2000);
    EXPECT_TRUE(begins("Aaxis_Move_INC", 1)) << option;
    EXPECT_TRUE(begins("Aaxis_GoHome", 1)) << option;
    EXPECT_TRUE(begins("Aaxis_DirectmRPM", -2'000'000)) << option;
  }
}

TEST(ChoicesMotion, LimitReactionStopsThatDirectionOrNothing) {
  for (const auto& [option, stops] :
       each_option<bool>("limit_reaction", {{"stops_that_direction", true}, {"none", false}})) {
    for (const int sign : {+1, -1}) {
      ReadySimple2 feeder(with("limit_reaction", option));
      feeder.set("DIN2_Aaxis_UP_Limit", 1);
      feeder.set("DIN3_Aaxis_DN_Limit", 1);
      feeder.set_one_pulse_a_tick('A', sign * 100);
      feeder.set("Aaxis_Move_INC", 1);
      feeder.run_to(11 + 55);
      feeder.input(sign > 0 ? 2 : 3, true);
      feeder.run(200);
      EXPECT_EQ(feeder.coordinate('A'), sign * (stops ? 50 : 100)) << option;
      EXPECT_EQ(feeder.get(sign > 0 ? "STATUS.12" : "STATUS.14"), 1) << option;
      feeder.set("Aaxis_Move_INC", 1);
      EXPECT_EQ(feeder.moving('A'), !stops) << option;
    }
  }
}

TEST(ChoicesMotion, LimitSenseIsTheCommandedOrThePhysicalOne) {
  for (const auto& [option, stopped_sign] :
       each_option<int>("limit_sense", {{"commanded", +1}, {"physical", -1}})) {
    for (const int sign : {+1, -1}) {
      ReadySimple2 feeder(with("limit_sense", option));
      feeder.set("DIN2_Aaxis_UP_Limit", 1);
      feeder.set("Aaxis_DIR_Polarity", 1);
      feeder.input(2, true);
      feeder.run(1);
      feeder.set_one_pulse_a_tick('A', sign * 100);
      feeder.set("Aaxis_Move_INC", 1);
      EXPECT_EQ(feeder.moving('A'), sign != stopped_sign) << option << ", " << sign;
      feeder.set("Aaxis_DIR_Polarity", 0);  // both senses are one
      feeder.run(200);
      feeder.set("Aaxis_Move_INC", 1);
      EXPECT_EQ(feeder.moving('A'), sign < 0) << option << ", " << sign;
    }
  }
}

TEST(ChoicesMotion, AlarmReactionStopsNothingOrSwitchesTheServoOffToo) {
  struct Expected {
    Value end;
    bool servo;
  };
  for (const auto& [option, expected] : each_option<Expected>(
           "alarm_reaction",
           {{"stops", {50, true}}, {"none", {100, true}}, {"stops_and_servo_off", {50, false}}})) {
    ReadySimple2 feeder(with("alarm_reaction", option));
    feeder.set("DIN0_Aaxis_Alarm", 1);
    feeder.set_one_pulse_a_tick('A', 100);
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run_to(11 + 55);
    feeder.input(0, true);
    feeder.run(200);
    EXPECT_EQ(feeder.coordinate('A'), expected.end) << option;
    EXPECT_EQ(feeder.get("STATUS.0"), 1) << option;
    EXPECT_EQ(feeder.bit("STATUS.10"), expected.servo) << option;
    EXPECT_TRUE(feeder.bit("STATUS.11")) << "B has no alarm";
    feeder.set("Aaxis_Move_INC", 1);
    EXPECT_EQ(feeder.moving('A'), option == "none") << option;
    feeder.input(0, false);
    feeder.run(1);
    EXPECT_EQ(feeder.bit("STATUS.10"), expected.servo) << "it does not come back automatically";
  }
}

TEST(ChoicesMotion, AlarmIsALevelOrLatchedUntilItIsCleared) {
  for (const auto& [option, latched] :
       each_option<bool>("alarm_latch", {{"level", false}, {"latched", true}})) {
    ReadySimple2 feeder(with("alarm_latch", option));
    feeder.set("DIN0_Aaxis_Alarm", 1);
    feeder.set_one_pulse_a_tick('A', 100);
    feeder.input(0, true);
    feeder.run(1);
    feeder.set("Aaxis_ACLR", 1);  // in vain while the input is on
    feeder.run(1);
    EXPECT_TRUE(feeder.bit("STATUS.0")) << option;
    feeder.input(0, false);
    feeder.run(100);
    EXPECT_EQ(feeder.bit("STATUS.0"), latched) << option;
    feeder.set("Aaxis_Move_INC", 1);
    EXPECT_EQ(feeder.moving('A'), !latched) << option;
    feeder.set("Aaxis_ACLR", 1);
    EXPECT_FALSE(feeder.bit("STATUS.0")) << option;
    feeder.set("Aaxis_Move_INC", 1);
    EXPECT_TRUE(feeder.moving('A')) << option;
    feeder.run(300);
    EXPECT_EQ(feeder.coordinate('A') % 100, 0) << option;
  }
}

TEST(ChoicesMotion, ReadyGatesNothingOrEveryCommand) {
  const std::vector<std::pair<std::string, Value>> commands{{"Aaxis_Move_INC", 1},
                                                            {"Aaxis_GoHome", 1},
                                                            {"Aaxis_DirectmRPM", 5000},
                                                            {"Aaxis_DirectPWM", 40},
                                                            {"Aaxis_SyncMode", 1}};
  for (const auto& [option, gates] : each_option<bool>("ready_gates", {{"no", false}, {"yes", true}})) {
    for (const auto& [command, value] : commands) {
      ReadySimple2 feeder(with("ready_gates", option));
      feeder.set_one_pulse_a_tick('A', 100);
      feeder.set("Aaxis_Home_Speed", 20);
      const auto is_taken = [&feeder, &name = command, &to = value] {
        feeder.set(name, to);
        const bool taken = feeder.moving('A') || feeder.bit("Aaxis_Mode");
        feeder.set("Aaxis_STOP", 1);
        return taken;
      };
      EXPECT_TRUE(is_taken()) << option << ", " << command << ": Ready is not assigned";
      feeder.set("DIN1_Aaxis_Ready", 1);
      EXPECT_EQ(is_taken(), !gates) << option << ", " << command;
      feeder.input(1, true);
      feeder.run(1);
      EXPECT_TRUE(is_taken()) << option << ", " << command;
    }
  }
}

TEST(ChoicesMotion, CoordinateOverflowWrapsOrSaturates) {
  // 2147483600 + 100 is 53 too many for 2^31 - 1.
  for (const auto& [option, end] :
       each_option("coordinate_overflow", {{"wraps", -2'147'483'596}, {"saturates", 2'147'483'647}})) {
    ReadySimple2 feeder(with("coordinate_overflow", option));
    feeder.set_one_pulse_a_tick('A', 100);
    feeder.set("Cord_A", 2'147'483'600);
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run(200);
    EXPECT_EQ(feeder.coordinate('A'), end) << option;
  }
  for (const auto& [option, end] :
       each_option("coordinate_overflow", {{"wraps", 2'147'483'596}, {"saturates", -2'147'483'648}})) {
    ReadySimple2 feeder(with("coordinate_overflow", option));
    feeder.set_one_pulse_a_tick('A', -100);
    feeder.set("Cord_A", -2'147'483'600);
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run(200);
    EXPECT_EQ(feeder.coordinate('A'), end) << option;
  }
}

TEST(ChoicesMotion, PresetInMotionKeepsTheRemainingPulsesOrTheTarget) {
  // To 200, of which 150 remain at 50.
  for (const auto& [preset, remaining_kept] : {std::pair{0, 150}, std::pair{300, 450}, std::pair{120, 270}}) {
    for (const auto& [option, end] : each_option(
             "preset_while_moving", {{"keeps_remaining_pulses", remaining_kept}, {"keeps_target", 200}})) {
      ReadySimple2 feeder(with("preset_while_moving", option));
      feeder.set_one_pulse_a_tick('A', 200);
      feeder.set("Aaxis_Move_ABS", 1);
      feeder.run_to(11 + 55);
      feeder.set("Cord_A", preset);
      feeder.run(500);
      EXPECT_EQ(feeder.coordinate('A'), end) << option << ", " << preset;
      EXPECT_FALSE(feeder.moving('A'));
    }
  }
}

}  // namespace choices_motion_test
}  // namespace understudy::emulator::models::simple2_r3
