// Every choice that has more than one option shows its effect.
#include "emulator/devices/simple2_r3/choices.h"

#include <set>

#include "emulator/devices/simple2_r3/device.h"
#include "tests/emulator/devices/simple2_r3/one_simple2.h"

namespace understudy::emulator::simple2_r3 {
namespace {

/// The device's reply to a frame on its line, at once; no bytes if it is silent.
std::vector<std::uint8_t> ask(OneSimple2& feeder, const std::vector<std::uint8_t>& frame) {
  pty::Line& line = feeder.world().line(0).line;
  line.receive(frame, feeder.world().now());
  feeder.run(20);
  const std::vector<std::uint8_t> reply(line.output().begin(), line.output().end());
  line.take_output(reply.size());
  return reply;
}

// Aaxis_SVON = 1 to station 1, and the same to station 0.
const std::vector<std::uint8_t> kServoOnTo1{0x01, 0x06, 0x10, 0x14, 0x00, 0x01, 0x0C, 0xCE};
const std::vector<std::uint8_t> kServoOnTo0{0x00, 0x06, 0x10, 0x14, 0x00, 0x01, 0x0D, 0x1F};
const std::vector<std::uint8_t> kNothing;

Given with(const std::string& choice, const std::string& option) { return {.choices = {{choice, option}}}; }

TEST(Choices, ThisFileHasACaseForEveryOneThatCanBeChosen) {
  const std::set<std::string_view> cases = {
      "station_0_request", "switch_0_broadcast", "factory_reset_of_volatile",
      "output_read_back",  "aclr_again",         "servo_at_power_up",
      "limit_reaction",    "alarm_reaction",     "home_coordinate",
      "velocity_unit",     "velocity_commit",    "wait_move_b_139",
      "loop_count",        "loop_left",          "loop_nesting",
      "unknown_command",   "after_last_line",    "delay_counts",
      "switches_sampled",  "eeprom_time",        "password_kept",
      "lock_judged",       "locked_writes"};
  std::set<std::string_view> selectable;
  for (const ChoiceRow& row : kChoices) {
    if (options_of(row).size() > 1) selectable.insert(row.id);
  }
  EXPECT_EQ(selectable, cases);
}

TEST(Choices, Station0RequestIsObeyedSilentlyOrIgnored) {
  for (const auto& [option, obeyed] : {std::pair{"broadcast", true}, std::pair{"ignored", false}}) {
    OneSimple2 feeder(with("station_0_request", option));
    EXPECT_EQ(ask(feeder, kServoOnTo0), kNothing) << option;
    EXPECT_EQ(feeder.bit("Aaxis_SVON"), obeyed) << option;
    EXPECT_EQ(ask(feeder, kServoOnTo1), kServoOnTo1) << option;
  }
}

TEST(Choices, Switch0BroadcastIsAnsweredOrObeyedSilently) {
  for (const auto& [option, answered] : {std::pair{"answered", true}, std::pair{"silent", false}}) {
    Given given = with("switch_0_broadcast", option);
    given.address = 0;
    OneSimple2 feeder(given);
    EXPECT_EQ(ask(feeder, kServoOnTo0), answered ? kServoOnTo0 : kNothing) << option;
    EXPECT_TRUE(feeder.bit("Aaxis_SVON")) << option;
    EXPECT_EQ(ask(feeder, kServoOnTo1), kServoOnTo1) << "every other station number is answered";
  }
}

TEST(Choices, FactoryResetOfVolatileResetsOrKeepsWhatIsNotPersistent) {
  for (const auto& [option, kept] : {std::pair{"reset_too", false}, std::pair{"kept", true}}) {
    OneSimple2 feeder(with("factory_reset_of_volatile", option));
    feeder.set("PROG_VAR3", 7);
    feeder.set("Aaxis_Speed", 200);
    feeder.set("PROG_MEM3", 7);
    feeder.set("Factory_Reset", 1);
    EXPECT_EQ(feeder.get("PROG_VAR3"), kept ? 7 : 0) << option;
    EXPECT_EQ(feeder.get("Aaxis_Speed"), kept ? 200 : 0) << option;
    EXPECT_EQ(feeder.get("PROG_MEM3"), 0) << option;
  }
}

TEST(Choices, OutputReadBackIsThePinsLevelOrWhatWasWritten) {
  for (const auto& [option, written] : {std::pair{"level_on_pin", false}, std::pair{"written_level", true}}) {
    OneSimple2 feeder(with("output_read_back", option));
    feeder.set("DOUT0_Aaxis_SVON", 1);
    feeder.set("DOUT2_Baxis_SVON", 1);
    feeder.set("DOUT_ALL", 0x12);
    feeder.set("Aaxis_SVON", 1);
    feeder.set("DOUT_2", 1);
    // On the pins: 0 by SVON, 1 and 4 as written, 2 off as B is off.
    EXPECT_EQ(feeder.get("DOUT_ALL"), written ? 0x16 : 0x13) << option;
    EXPECT_EQ(feeder.get("DOUT_0"), written ? 0 : 1) << option;
    EXPECT_EQ(feeder.get("DOUT_2"), written ? 1 : 0) << option;
    EXPECT_TRUE(feeder.output(0)) << option;
    EXPECT_FALSE(feeder.output(2)) << option;
  }
}

TEST(Choices, AclrAgainRestartsThe200MillisecondsOrIsIgnored) {
  for (const auto& [option, end] : {std::pair{"restarts", Tick{351}}, std::pair{"ignored", Tick{251}}}) {
    OneSimple2 feeder(with("aclr_again", option));
    feeder.run_to(50);
    feeder.set("Aaxis_ACLR", 1);
    feeder.run_to(150);
    feeder.set("Aaxis_ACLR", 1);
    feeder.run_to(end - 1);
    EXPECT_EQ(feeder.get("Aaxis_ACLR"), 1) << option;
    feeder.run_to(end);
    EXPECT_EQ(feeder.get("Aaxis_ACLR"), 0) << option;
    feeder.set("Aaxis_ACLR", 1);  // afterwards it works again
    EXPECT_EQ(feeder.get("Aaxis_ACLR"), 1) << option;
  }
}

TEST(Choices, ServoAtPowerUpIsOffOrOn) {
  for (const auto& [option, on] : {std::pair{"off", false}, std::pair{"on", true}}) {
    OneSimple2 feeder(with("servo_at_power_up", option));
    EXPECT_EQ(feeder.get("STATUS"), on ? kServoA | kServoB : 0) << option;
    feeder.set_one_pulse_a_tick('A', 100);
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run(200);
    EXPECT_EQ(feeder.coordinate('A'), on ? 100 : 0) << option;
  }
}

TEST(Choices, LimitReactionStopsThatDirectionOrNothing) {
  for (const auto& [option, stops] : {std::pair{"stops_that_direction", true}, std::pair{"none", false}}) {
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

TEST(Choices, AlarmReactionStopsOrNothing) {
  for (const auto& [option, stops] : {std::pair{"stops", true}, std::pair{"none", false}}) {
    ReadySimple2 feeder(with("alarm_reaction", option));
    feeder.set("DIN0_Aaxis_Alarm", 1);
    feeder.set_one_pulse_a_tick('A', 100);
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run_to(11 + 55);
    feeder.input(0, true);
    feeder.run(200);
    EXPECT_EQ(feeder.coordinate('A'), stops ? 50 : 100) << option;
    EXPECT_EQ(feeder.get("STATUS.0"), 1) << option;
    feeder.set("Aaxis_Move_INC", 1);
    EXPECT_EQ(feeder.moving('A'), !stops) << option;
  }
}

TEST(Choices, HomeCoordinateIsZeroOrKept) {
  for (const auto& [option, kept] : {std::pair{"zero", false}, std::pair{"kept", true}}) {
    ReadySimple2 feeder(with("home_coordinate", option));
    feeder.set("Aaxis_Resoultion", 3000);
    feeder.set("Aaxis_Home_Speed", 20);
    feeder.set("Axis_GoHome_DIR", 1);
    feeder.set("DIN4_Aaxis_Home", 1);
    feeder.set("Aaxis_GoHome", 1);
    feeder.run(100);
    feeder.input(4, true);
    feeder.run(500);
    EXPECT_TRUE(feeder.bit("STATUS.8")) << option;
    EXPECT_EQ(feeder.coordinate('A') != 0, kept) << option;
  }
}

TEST(Choices, VelocityUnitIsLiteralOrAThousandTimesThat) {
  for (const auto& [option, pulses] : {std::pair{"literal", 0}, std::pair{"two_rpm_per_second", 1}}) {
    ReadySimple2 feeder(with("velocity_unit", option));
    feeder.set("Aaxis_DirectmRPM", 1'000'000);
    feeder.run(100);  // at 1000: 0.2 or 200 RPM a second, so 0.0005 or 0.53 turns of 3200 pulses
    EXPECT_EQ(feeder.coordinate('A') >= 500, pulses == 1) << option;
  }
}

TEST(Choices, VelocityCommitWaitsForTheHighWordOrNot) {
  for (const auto& [option, mode] : {std::pair{"waits_for_the_high_word", 0}, std::pair{"takes_effect", 1}}) {
    ReadySimple2 feeder(with("velocity_commit", option));
    feeder.set("Aaxis_DirectmRPM_L", 5000);
    EXPECT_EQ(feeder.get("Aaxis_Mode"), mode) << option;
    feeder.set("Aaxis_DirectmRPM_H", 0);
    EXPECT_EQ(feeder.get("Aaxis_Mode"), 1) << option;
  }
}

TEST(Choices, SwitchesAreSampledAtPowerUpOrAlways) {
  for (const auto& [option, baud] : {std::pair{"at_power_up", 19200}, std::pair{"always", 115200}}) {
    OneSimple2 feeder(with("switches_sampled", option));
    feeder.world().set_external_input(0, find_terminal(model(), "DIP1"), 1);
    EXPECT_EQ(feeder.device().line_settings().baud, baud) << option;
    feeder.world().switch_power(0, false);
    feeder.world().switch_power(0, true);
    EXPECT_EQ(feeder.device().line_settings().baud, 115200) << option;
  }
}

TEST(Choices, EepromTimeIsFiveOrOneMillisecondsAWord) {
  for (const auto& [option, ticks] : {std::pair{"5ms_a_word", 10}, std::pair{"1ms_a_word", 2}}) {
    OneSimple2 feeder(with("eeprom_time", option));
    feeder.set("PROG_MEM0", 1);  // two words, which begin with the next tick
    feeder.run(ticks);
    EXPECT_TRUE(feeder.bit("EEPROM_Writing")) << option;
    feeder.run(1);
    EXPECT_FALSE(feeder.bit("EEPROM_Writing")) << option;
  }
}

TEST(Choices, PasswordIsKeptOrForgotten) {
  for (const auto& [option, kept] : {std::pair{"yes", true}, std::pair{"no", false}}) {
    OneSimple2 feeder(with("password_kept", option));
    feeder.set("NEW_PWD", 1234);
    feeder.run(10);
    feeder.world().switch_power(0, false);
    feeder.world().switch_power(0, true);
    EXPECT_EQ(feeder.bit("PROG_UNLOCK"), !kept) << option;
    feeder.set("PWD_Input", 1234);
    EXPECT_EQ(feeder.bit("PROG_UNLOCK"), kept) << option;
  }
}

TEST(Choices, LockIsJudgedAtPowerUpAndInputOrAlways) {
  for (const auto& [option, unlocked] :
       {std::pair{"at_power_up_and_input", true}, std::pair{"always", false}}) {
    OneSimple2 feeder(with("lock_judged", option));
    feeder.set("NEW_PWD", 1234);
    EXPECT_EQ(feeder.bit("PROG_UNLOCK"), unlocked) << option;
    feeder.set("PWD_Input", 1);
    EXPECT_FALSE(feeder.bit("PROG_UNLOCK")) << option;
  }
}

TEST(Choices, LockedWritesAreAllowedOrIgnored) {
  for (const auto& [option, allowed] : {std::pair{"allowed", true}, std::pair{"ignored", false}}) {
    OneSimple2 feeder(with("locked_writes", option));
    feeder.set("MAIN_LINE3_DATA1", 5);
    feeder.set("MAIN_LINE4_CMD", 6);
    feeder.set("NEW_PWD", 1234);
    feeder.set("PWD_Input", 1);
    feeder.set("MAIN_LINE3_DATA1", 7);
    EXPECT_EQ(feeder.get("MAIN_LINE3_DATA1"), 0) << "nothing can be read";
    feeder.set("PWD_Input", 1234);
    EXPECT_EQ(feeder.get("MAIN_LINE3_DATA1"), allowed ? 7 : 5) << option;
    feeder.set("PWD_Input", 1);
    feeder.set("PROG_MAIN_Erase_ALL", 1);
    feeder.set("PWD_Input", 1234);
    EXPECT_EQ(feeder.get("MAIN_LINE4_CMD"), allowed ? 0 : 6) << option;
  }
}

TEST(Choices, ThoseOfTheLanguageReachTheInterpreter) {
  // What they do there is tested with the interpreter.
  const auto dialect = [](const std::string& choice, const std::string& option, Firmware firmware = 152) {
    Given given = with(choice, option);
    given.firmware = firmware;
    OneSimple2 feeder(given);
    return static_cast<const Simple2R3&>(feeder.device()).dialect();
  };
  using interpreter::simple2::Dialect;
  EXPECT_TRUE(dialect("wait_move_b_139", "as_move_inc_b_wait", 139).quirk_wait_move_b_is_move_inc_b_wait);
  EXPECT_FALSE(dialect("wait_move_b_139", "waits", 139).quirk_wait_move_b_is_move_inc_b_wait);
  EXPECT_EQ(dialect("loop_count", "passes"), Dialect{});
  EXPECT_EQ(dialect("loop_count", "further_passes").loop_count, Dialect::LoopCount::further_passes);
  EXPECT_EQ(dialect("loop_left", "remembered").loop_left, Dialect::LoopLeft::remembered);
  EXPECT_EQ(dialect("loop_nesting", "when_outer_starts").loop_nesting,
            Dialect::LoopNesting::when_outer_starts);
  EXPECT_EQ(dialect("unknown_command", "ends").unknown_command, Dialect::UnknownCommand::ends);
  EXPECT_EQ(dialect("after_last_line", "goes_on_at_0").after_last_line, Dialect::AfterLastLine::goes_on_at_0);
  EXPECT_EQ(dialect("delay_counts", "before_next_slot").delay_counts, Dialect::DelayCounts::before_next_slot);
}

}  // namespace
}  // namespace understudy::emulator::simple2_r3
