// Choices about register reads, inputs and outputs.
#include "emulator/device/axes.h"
#include "tests/emulator/models/simple2_r3/choice_cases.h"

namespace understudy::emulator::models::simple2_r3 {
namespace choices_io_test {

TEST(ChoicesRegisters, VersionIsInHundredthsOrBcd) {
  for (const auto& [option, version] :
       each_option("version_encoding", {{"hundredths", 152}, {"bcd", 0x0152}})) {
    EXPECT_EQ(OneSimple2(with("version_encoding", option)).get("Version"), version) << option;
    Given older = with("version_encoding", option);
    older.firmware = 140;
    EXPECT_EQ(OneSimple2(older).get("Version"), option == "bcd" ? 0x0140 : 140) << option;
  }
}

TEST(ChoicesRegisters, TriggersReadOneWhileInProgressOrZero) {
  for (const auto& [option, read] :
       each_option("trigger_read_back", {{"one_while_in_progress", 1}, {"zero", 0}})) {
    ReadySimple2 feeder(with("trigger_read_back", option));
    feeder.set_one_pulse_a_tick('A', 100);
    feeder.set("Aaxis_Home_Speed", 20);
    for (const char* trigger : {"Aaxis_Move_INC", "Aaxis_Move_ABS", "Aaxis_GoHome"}) {
      feeder.set(trigger, 1);
      EXPECT_EQ(feeder.get(trigger), read) << option << ", " << trigger;
      EXPECT_TRUE(feeder.moving('A')) << option << ", " << trigger;
      feeder.set("Aaxis_STOP", 1);
      EXPECT_EQ(feeder.get(trigger), 0) << option << ", " << trigger;
    }
  }
}

TEST(ChoicesRegisters, CommandValuesAreShownOrNot) {
  for (const auto& [option, shown] :
       each_option<bool>("command_values", {{"shown", true}, {"not_shown", false}})) {
    ReadySimple2 feeder(with("command_values", option));
    feeder.set("Aaxis_DirectmRPM", 77);
    feeder.set("Aaxis_DirectPWM", 7);
    feeder.set("Parms_mRPM2", 5000);
    feeder.set("Aaxis_ParmsDirectmRPM", 2);
    EXPECT_EQ(feeder.get("Aaxis_Mode"), 1) << option;
    EXPECT_EQ(feeder.get("Aaxis_DirectmRPM"), shown ? 5000 : 77) << option;
    start_with_program(feeder, {{0x88, 3, 0, 0}, {0x82, 40, 0, 0}, {0xFF, 0, 0, 0}});  // 3 RPM, then PWM 40
    feeder.run(10);
    EXPECT_EQ(feeder.get("Aaxis_Mode"), 2) << option;
    EXPECT_EQ(feeder.get("Aaxis_DirectmRPM"), shown ? 3000 : 77) << option;
    EXPECT_EQ(feeder.get("Aaxis_DirectPWM"), shown ? 40 : 7) << option;
  }
}

TEST(ChoicesRegisters, ASetMoveLeavesTheAxissRegistersOrIsCopiedThere) {
  for (const char* command : {"ALL_ParmsMove_INC", "ALL_ParmsMove_ABS"}) {
    for (const auto& [option, copied] :
         each_option<bool>("set_move", {{"not_copied", false}, {"copied", true}})) {
      ReadySimple2 feeder(with("set_move", option));
      feeder.set_move('B', 1, 2, 3, 4);
      feeder.set("Parms_Pulse2", 5000);
      feeder.set("Parms_Speed2", 60);
      feeder.set("Parms_AccTime2", 7);
      feeder.set("Parms_DecTime2", 8);
      feeder.set(command, 2);
      EXPECT_TRUE(feeder.moving('B')) << option;
      EXPECT_EQ(feeder.get("Baxis_Pulse"), copied ? 5000 : 1) << option;
      EXPECT_EQ(feeder.get("Baxis_Speed"), copied ? 60 : 2) << option;
      EXPECT_EQ(feeder.get("Baxis_AccTime"), copied ? 7 : 3) << option;
      EXPECT_EQ(feeder.get("Baxis_DecTime"), copied ? 8 : 4) << option;
    }
  }
}

TEST(ChoicesRegisters, FactoryValuesAreUsefulOrTheLeast) {
  struct Row {
    const char* name;
    Value useful, min;
  };
  constexpr Row kRows[] = {{"Aaxis_SVON_Polarity", 1, 0},    {"Baxis_VelMode_ACC", 1000, 1},
                           {"Axis_EncSync_NUM", 1, 0},       {"Axis_EncSync_DEN", 1, 1},
                           {"Baxis_SyncRPM", 3000, 1},       {"ENCB_Resoultion", 3200, 1},
                           {"Parms_Pulse1", 0, 0},           {"PROG_MEM0", 0, 0},
                           {"Aaxis_Resoultion", 3200, 3200},  // the manual's
                           {"ADC_10V_A", 4000, 4000}};
  for (const auto& [option, useful] :
       each_option<bool>("factory_values", {{"useful", true}, {"least", false}})) {
    OneSimple2 feeder(with("factory_values", option));
    for (const Row& row : kRows) {
      EXPECT_EQ(feeder.get(row.name), useful ? row.useful : row.min) << option << ", " << row.name;
    }
    feeder.set("Baxis_VelMode_ACC", 5);
    feeder.set("Factory_Reset", 1);
    EXPECT_EQ(feeder.get("Baxis_VelMode_ACC"), useful ? 1000 : 1) << option;
  }
}

TEST(ChoicesOutputs, AnAssignmentTakesEffectAtOnceOrAtPowerUp) {
  for (const auto& [option, at_once] :
       each_option<bool>("assignment_effect", {{"at_once", true}, {"at_power_up", false}})) {
    OneSimple2 feeder(with("assignment_effect", option));
    feeder.set("DOUT0_Aaxis_SVON", 1);
    feeder.set("DIN9_Baxis_Home", 1);
    feeder.set("DIN1_Aaxis_Ready", 1);
    feeder.input(1, true);
    feeder.set("Aaxis_SVON", 1);
    feeder.run(50);
    EXPECT_EQ(feeder.output(0), at_once) << option;
    EXPECT_EQ(feeder.bit("STATUS.2"), at_once) << option;
    switch_off_and_on(feeder);
    feeder.set("Aaxis_SVON", 1);
    feeder.run(1);
    EXPECT_TRUE(feeder.output(0)) << option;
    EXPECT_TRUE(feeder.bit("STATUS.2")) << option;
    feeder.set("DOUT0_Aaxis_SVON", 0);
    EXPECT_EQ(feeder.output(0), !at_once) << option;
  }
}

TEST(ChoicesOutputs, AWriteUnderAFunctionIsRememberedOrIgnored) {
  for (const auto& [option, remembered] :
       each_option<bool>("write_under_function", {{"remembered", true}, {"ignored", false}})) {
    OneSimple2 feeder(with("write_under_function", option));
    feeder.set("DOUT1_Aaxis_ACLR", 1);
    feeder.set("DOUT_ALL", 0x7E);
    EXPECT_FALSE(feeder.output(1)) << option;
    feeder.set("DOUT1_Aaxis_ACLR", 0);
    EXPECT_EQ(feeder.get("DOUT_ALL"), remembered ? 0x7E : 0x7C) << option;
    feeder.set("DOUT3_Baxis_ACLR", 1);
    start_with_program(feeder, {{0x05, 3, 0, 0}, {0x05, 4, 0, 0}, {0xFF, 0, 0, 0}});  // Out 3 OFF, Out 4 OFF
    feeder.run(10);
    feeder.set("DOUT3_Baxis_ACLR", 0);
    EXPECT_EQ(feeder.get("DOUT_ALL"), remembered ? 0x66 : 0x6C) << option;
  }
}

TEST(ChoicesOutputs, ReadBackIsThePinsLevelOrWhatWasWritten) {
  for (const auto& [option, written] :
       each_option<bool>("output_read_back", {{"level_on_pin", false}, {"written_level", true}})) {
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

TEST(ChoicesInputs, StatusOfUnassignedInputsIsZeroOrThePinsLevel) {
  // A: alarm, Ready, upper, lower limit at DIN 0 to 3. B: 5 to 8.
  constexpr std::pair<int, Value> kPins[] = {{0, 1}, {1, 1 << 2}, {2, 1 << 12}, {3, 1 << 14},
                                             {5, 2}, {6, 1 << 3}, {7, 1 << 13}, {8, 1 << 15}};
  for (const auto& [option, shows_pin] :
       each_option<bool>("unassigned_input_status", {{"zero", false}, {"level_of_pin", true}})) {
    ReadySimple2 feeder(with("unassigned_input_status", option));
    for (const auto& [din, bit] : kPins) {
      feeder.input(din, true);
      feeder.run(1);
      EXPECT_EQ(feeder.get("STATUS"), kServoA | kServoB | (shows_pin ? bit : 0)) << option << ", DIN " << din;
      feeder.input(din, false);
    }
    feeder.input(0, true);
    feeder.input(2, true);
    feeder.set_one_pulse_a_tick('A', 100);
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run(200);
    EXPECT_EQ(feeder.coordinate('A'), 100) << "without a function they stop nothing";
    feeder.set("Aaxis_ALM_Polarity", 1);
    feeder.set("DIN0_Aaxis_Alarm", 1);
    EXPECT_FALSE(feeder.bit("STATUS.0")) << "with one, its polarity counts";
  }
}

TEST(ChoicesInputs, AnalogIsALineThroughBothPointsOrThroughZero) {
  // At 5 V the ADC is 2000: 200 + (2000 - 500) * 1800 / 3600 = 950, or 2000 * 2000 / 4100 = 975.6.
  for (const auto& [option, analog] :
       each_option("analog_scaling", {{"line_through_both_points", 950}, {"line_through_zero", 975}})) {
    OneSimple2 feeder(with("analog_scaling", option));
    feeder.set("ADC_1V_A", 500);
    feeder.set("ADC_10V_A", 4100);
    feeder.world().set_external_input(0, find_terminal(model(), "AIN_A"), 5000);
    feeder.run(1);
    EXPECT_EQ(feeder.get("Analog_A"), analog) << option;
    feeder.set("ADC_1V_A", 0);
    feeder.set("ADC_10V_A", 0);
    EXPECT_EQ(feeder.get("Analog_A"), 0) << option << ": no division by zero";
  }
}

TEST(ChoicesInputs, EncoderSpeedSaturatesOrWraps) {
  // A resolution of 1: 60 counts in 100 ms are 36000 RPM, 65536 - 36000 = 29536 too many for a sign.
  for (const auto& [option, rpm] :
       each_option("encoder_speed_overflow", {{"saturates", 32767}, {"wraps", -29536}})) {
    for (const int sign : {+1, -1}) {
      ReadySimple2 feeder(with("encoder_speed_overflow", option));
      feeder.set("ENCA_Resoultion", 1);
      feeder.set("Axis_EncSync_NUM", 0);  // what is fed past a machine wakes no device, but sync mode looks
      feeder.set("Aaxis_SyncMode", 1);
      feeder.device().axes()->set_encoder(0, sign * 60);
      feeder.run(1);
      EXPECT_EQ(feeder.get("ENCA_RPM"), sign > 0 ? rpm : rpm == 32767 ? -32768 : 29536) << option;
    }
  }
}

}  // namespace choices_io_test
}  // namespace understudy::emulator::models::simple2_r3
