// Commands of 0, STOP while an axis already slows down, and other motion that a host can see but the manual
// does not describe.
#include <cmath>

#include "emulator/device/axes.h"
#include "emulator/models/simple2_r3/device.h"
#include "tests/emulator/models/simple2_r3/choice_cases.h"
#include "tests/emulator/models/simple2_r3/reaction_rig.h"

namespace understudy::emulator::models::simple2_r3 {
namespace zero_and_stop_test {

// --- 0 -------------------------------------------------------------------------------------------------

TEST(Zero, ADutyOf0InAnAlarmCancelsAVelocity) {
  for (const char* option : {"stays_stopped", "resumes"}) {
    Rig rig(with("after_alarm", option));
    rig.set("Aaxis_DirectmRPM", kVelocity_mrpm);
    rig.watch(300);
    rig.input(kAlarmInput, true);
    rig.watch(20);
    rig.set("Aaxis_DirectPWM", 0);
    EXPECT_EQ(rig.get("Aaxis_Mode"), 2) << option;
    free(rig);
    EXPECT_EQ(rig.watch(300), Pulses(300)) << option;
  }
}

TEST(Zero, ADistanceOf0StopsAtOnceByAllReadings) {
  const auto expect_stop = [](const Given& given, bool by_velocity) {
    Rig rig(given);
    if (by_velocity) {
      rig.set("Aaxis_DirectmRPM", kVelocity_mrpm);
    } else {
      rig.move(100'000, 100);
    }
    rig.watch(600);
    rig.set("Aaxis_Speed", 32768);  // whatever the speed
    rig.set("Aaxis_Pulse", 0);
    rig.set("Aaxis_Move_INC", 1);
    EXPECT_FALSE(rig.moving('A'));
    EXPECT_EQ(rig.get("Aaxis_Move_INC"), 0);
    EXPECT_EQ(rig.get("Aaxis_Mode"), 0);
    EXPECT_EQ(rig.watch(200), Pulses(200));
  };
  expect_stop({}, false);
  expect_stop(with("command_while_moving", "ignored"), false);
  expect_stop(with("incremental_while_moving", "old_target"), false);
  expect_stop(with("pulse_rate_cap", "command_dropped"), false);
  expect_stop(with("move_in_other_mode", "ignored"), true);
  expect_stop(with("move_in_other_mode", "goes_on_from_the_speed"), true);
  expect_stop(with("pulse_rate_cap", "command_dropped"), true);
}

TEST(Zero, ADutyOrADistanceOf0NeedsNoReady) {
  for (const char* what : {"Aaxis_DirectPWM", "Aaxis_Move_INC"}) {
    Rig rig(with("ready_gates", "yes"));
    rig.set("DIN1_Aaxis_Ready", 1);
    rig.input(1, true);
    rig.watch(5);
    rig.set("Aaxis_DirectPWM", kDuty);
    rig.input(1, false);
    rig.watch(5);
    EXPECT_EQ(pwm_duty(rig.axis()), kDuty);
    rig.set(what, what == std::string_view("Aaxis_Move_INC") ? 1 : 0);  // Pulse is 0
    EXPECT_EQ(pwm_duty(rig.axis()), 0) << what;
  }
}

// --- what a move leaves to be done ------------------------------------------------------------------------

TEST(OldTarget, AMoveAtSpeed0CountsAsInProgress) {
  Rig rig(with("incremental_while_moving", "old_target"));
  rig.set_move('A', -500, 0, 1, 1);
  rig.set("Aaxis_Move_INC", 1);
  rig.watch(100);
  rig.set("Aaxis_Pulse", -100);
  rig.set("Aaxis_Move_INC", 1);  // at speed 0 again
  EXPECT_TRUE(rig.moving('A'));
  rig.move(200);
  EXPECT_EQ(sum(rig.watch(1000)), -400);
}

TEST(OldTarget, HomingAndAStoppedMoveHaveNone) {
  Rig rig({.choices = {{"incremental_while_moving", "old_target"}, {"stop", "slows_down"}}});
  rig.move(100'000, 100);
  rig.watch(600);
  rig.set("Aaxis_STOP", 1);
  rig.watch(10);
  EXPECT_TRUE(rig.moving('A'));
  rig.move(kDistance);
  EXPECT_EQ(sum(rig.watch(600)), kDistance);
  rig.set("Aaxis_Home_Speed", 0);
  rig.set("Aaxis_GoHome", 1);
  rig.watch(5);
  rig.move(kDistance);
  EXPECT_EQ(sum(rig.watch(600)), kDistance);
}

// --- STOP ------------------------------------------------------------------------------------------------

/// STOP at each moment at which the axis slows down: from there on it is never faster than without.
void expect_no_gentler(void (*begin)(Rig&), Tick last) {
  const Given given = with("stop", "slows_down");
  Rig other(given);
  begin(other);
  std::vector<double> speeds;
  std::vector<bool> slows;
  for (Tick i = 0; i < last; ++i) {
    speeds.push_back(std::abs(other.device().axes()->speed_pps(0)));
    const motion::Axis& motor = other.axis().motor;
    slows.push_back(motor.drive.moving() && motor.sample(other.now()).acceleration_u_s2 < 0);
    other.watch(1);
  }
  int stops = 0;
  for (Tick at = 1; at < last; at += 7) {
    if (!slows[static_cast<std::size_t>(at)]) continue;
    ++stops;
    Rig rig(given);
    begin(rig);
    rig.watch(at);
    rig.set("Aaxis_STOP", 1);
    double before = speeds[static_cast<std::size_t>(at)];
    for (Tick i = at + 1; i < last; ++i) {
      rig.watch(1);
      const double now = std::abs(rig.device().axes()->speed_pps(0));
      const double min = speeds[static_cast<std::size_t>(i - 1)] - speeds[static_cast<std::size_t>(i)];
      const bool continues = slows[static_cast<std::size_t>(i)] && now > 0;
      if (continues) {
        ASSERT_GE(before - now, min - 1e-6) << "STOP in tick " << at << ", in tick " << i;
      }
      if (now == 0) {
        ASSERT_LE(before, min + 5) << "no abrupt end: STOP in tick " << at;
        break;
      }
      before = now;
    }
  }
  EXPECT_GT(stops, 5);
}

TEST(StopByRegister, NeverSlowsAMoveDownLess) {
  expect_no_gentler([](Rig& rig) { rig.move(1000, 40); }, 1600);
}

TEST(StopByRegister, NeverSlowsHomingsWayBackLess) {
  expect_no_gentler(
      [](Rig& rig) {
        rig.set("Aaxis_Home_AccTime", 20);
        rig.set("Aaxis_GoHome", 1);
        rig.watch(400);
        rig.input(kHomeInput, true);
        rig.watch(1);
      },
      700);
}

TEST(StopByRegister, EndsAMoveOnItsTargetByTheRampThatRuns) {
  Rig rig(with("stop", "slows_down"));
  rig.set_move('A', 32000, 200, 5, 100);
  rig.set("Aaxis_Move_INC", 1);
  while (rig.coordinate('A') < 31500) rig.watch(1);
  rig.set("Aaxis_STOP", 1);
  std::int64_t last = 0;
  while (rig.moving('A')) last = sum(rig.watch(1));
  EXPECT_LE(last, 1) << "not abruptly";
  EXPECT_EQ(rig.coordinate('A'), 32000);
}

TEST(StopByRegister, OfAMoveAtSpeed0EndsItsTriggerAtOnce) {
  for (const char* option : {"at_once", "slows_down"}) {
    Rig rig(with("stop", option));
    rig.set_move('A', 500, 0, 1, 1);
    rig.set("Aaxis_Move_INC", 1);
    rig.watch(10);
    rig.set("Aaxis_STOP", 1);
    EXPECT_FALSE(rig.moving('A')) << option;
    EXPECT_EQ(rig.get("Aaxis_Move_INC"), 0) << option;
  }
}

TEST(Speed, HasNoSignAtRest) {
  Rig rig({});
  rig.move(-100);
  while (rig.moving('A')) {
    EXPECT_FALSE(rig.device().axes()->speed_pps(0) == 0 && std::signbit(rig.device().axes()->speed_pps(0)));
    rig.watch(1);
  }
  rig.set("Aaxis_DIR_Polarity", 1);
  EXPECT_FALSE(std::signbit(rig.device().axes()->speed_pps(0)));
}

// --- programs and inputs
// -------------------------------------------------------------------------------------

/// Move_INC_A_Wait by VAR0, Out DOUT_0 ON, END; or Wait_Move_A in place of the first.
void run_waiting(Rig& rig, std::uint16_t command) {
  rig.set("PROG_VAR0", kDistance);
  rig.set_move('A', kDistance, 20, 1, 1);
  write_program(rig, {{command, 32, 0, 0}, {0x05, 0, 1, 0}, {0xFF, 0, 0, 0}});
  rig.set("PROG_MAIN_RunTime_START", 0);
  rig.watch(50);
}

TEST(KeptMove, IsWaitedForByALine) {
  for (const std::uint16_t command : {0x25, 0x24}) {
    Rig rig(with("command_while_servo_off", "kept_until_servo_on"));
    rig.set("Aaxis_SVON", 0);
    if (command == 0x24) rig.move(kDistance);
    run_waiting(rig, command);
    EXPECT_FALSE(rig.output(0)) << command;
    rig.set("Aaxis_SVON", 1);
    EXPECT_EQ(sum(rig.watch(100)), 94) << command;
    EXPECT_FALSE(rig.output(0)) << command;
    rig.watch(200);
    EXPECT_TRUE(rig.output(0)) << command;
  }
}

TEST(WaitMoveHoming, DoesNotMatterToAMove) {
  for (const auto& [option, is_over] :
       each_option<bool>("wait_move_homing", {{"waits", false}, {"does_not_wait", false}})) {
    Rig rig(with("wait_move_homing", option));
    rig.move(kDistance);
    run_waiting(rig, 0x24);
    EXPECT_EQ(rig.output(0), is_over) << option;
    rig.watch(300);
    EXPECT_TRUE(rig.output(0)) << option;
  }
}

TEST(KeptMove, ThatStopForgetsIsCutShort) {
  for (const auto& [option, continues] : each_option<bool>(
           "wait_cut_short", {{"goes_on", true}, {"waits_on", false}, {"program_ends", false}})) {
    Rig rig({.choices = {{"command_while_servo_off", "kept_until_servo_on"}, {"wait_cut_short", option}}});
    rig.set("Aaxis_SVON", 0);
    run_waiting(rig, 0x25);
    rig.set("Aaxis_STOP", 1);
    rig.watch(20);
    EXPECT_EQ(rig.output(0), continues) << option;
    EXPECT_EQ(rig.bit("PROG_MAIN_RunTime_Status"), option == "waits_on") << option;
  }
}

TEST(WaitCutShort, IsNoMatterToALineThatBeginsAtRest) {
  for (const std::uint16_t command : {0x24, 0x25}) {
    Rig rig(with("wait_cut_short", "waits_on"));
    rig.move(100'000);
    rig.watch(50);
    rig.set("Aaxis_STOP", 1);
    rig.watch(10);
    if (command == 0x25) rig.input(kAlarmInput, true);  // so that its move is not accepted
    run_waiting(rig, command);
    EXPECT_TRUE(rig.output(0)) << command;
  }
}

TEST(Inputs, AreLookedAtAtPowerUp) {
  OneSimple2 feeder({.set = {{"DIN4_Aaxis_Home", 1}}});
  feeder.input(4, true);
  EXPECT_EQ(feeder.get("DIN_ALL"), 0x10);
  EXPECT_EQ(feeder.get("DIN_4"), 1);
  feeder.run(1);
  EXPECT_EQ(feeder.get("DIN_ALL"), 0x10);
  feeder.input(4, false);
  EXPECT_EQ(feeder.get("DIN_4"), 1) << "not before the next tick";
  feeder.run(5);
  feeder.input(10, true);
  switch_off_and_on(feeder);
  EXPECT_EQ(feeder.get("DIN_ALL"), 0x400);
}

}  // namespace zero_and_stop_test
}  // namespace understudy::emulator::models::simple2_r3
