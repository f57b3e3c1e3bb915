// Choices about persistent values: EEPROM, power cuts, factory reset, the password.
#include "tests/emulator/models/simple2_r3/choice_cases.h"

namespace understudy::emulator::models::simple2_r3 {
namespace choices_memory_test {

TEST(ChoicesMemory, TheSameValueIsNotSavedAgainOrIs) {
  for (const auto& [option, again] :
       each_option<bool>("eeprom_same_value", {{"not_saved_again", false}, {"saved_again", true}})) {
    OneSimple2 feeder(with("eeprom_same_value", option));
    feeder.set("PROG_MEM0", 7);
    EXPECT_TRUE(feeder.bit("EEPROM_Writing")) << option;
    feeder.run(50);
    EXPECT_FALSE(feeder.bit("EEPROM_Writing")) << option;
    feeder.set("PROG_MEM0", 7);
    EXPECT_EQ(feeder.bit("EEPROM_Writing"), again) << option;
    feeder.run(11);
    EXPECT_FALSE(feeder.bit("EEPROM_Writing")) << option;
    feeder.set("PROG_VAR0", 7);  // is not kept at all
    feeder.set("PROG_VAR0", 7);
    EXPECT_FALSE(feeder.bit("EEPROM_Writing")) << option;
  }
}

TEST(ChoicesMemory, AWriteWhileSavingIsQueuedOrNotSaved) {
  for (const auto& [option, saved] : each_option("write_while_saving", {{"queued", 3}, {"not_saved", 0}})) {
    OneSimple2 feeder(with("write_while_saving", option));
    feeder.write(0x8000, {1, 0, 2, 0});  // MEM0 and MEM1 by one request: both before anything is being saved
    feeder.set("PROG_MEM2", 3);
    EXPECT_EQ(feeder.get("PROG_MEM2"), 3) << option << ": until power-off";
    feeder.run(100);
    feeder.set("PROG_MEM3", 4);
    feeder.run(100);
    switch_off_and_on(feeder);
    EXPECT_EQ(feeder.get("PROG_MEM0"), 1) << option;
    EXPECT_EQ(feeder.get("PROG_MEM1"), 2) << option;
    EXPECT_EQ(feeder.get("PROG_MEM2"), saved) << option;
    EXPECT_EQ(feeder.get("PROG_MEM3"), 4) << option;
  }
}

TEST(ChoicesMemory, APowerCutLeavesTheOldOrTheNewValue) {
  for (const auto& [option, left] : each_option("power_cut", {{"old_value", -5}, {"new_value", 70'000}})) {
    OneSimple2 feeder(with("power_cut", option));
    feeder.set("PROG_MEM0", -5);
    feeder.run(20);
    feeder.set("PROG_MEM0", 70'000);  // both words are others
    feeder.set("PROG_MEM1", 9);
    feeder.run(3);
    switch_off_and_on(feeder);
    EXPECT_EQ(feeder.get("PROG_MEM0"), left) << option;
    EXPECT_EQ(feeder.get("PROG_MEM1"), 0) << option << ": its turn had not come";
    feeder.run(20);
    switch_off_and_on(feeder);
    EXPECT_EQ(feeder.get("PROG_MEM0"), left) << option << ": nothing was being written";
  }
}

TEST(ChoicesMemory, SwitchesAreSampledAtPowerUpOrAlways) {
  for (const auto& [option, baud] :
       each_option("switches_sampled", {{"at_power_up", 19200}, {"always", 115200}})) {
    OneSimple2 feeder(with("switches_sampled", option));
    feeder.world().set_external_input(0, find_terminal(model(), "DIP1"), 1);
    EXPECT_EQ(feeder.device().line_settings(0).baud, baud) << option;
    switch_off_and_on(feeder);
    EXPECT_EQ(feeder.device().line_settings(0).baud, 115200) << option;
  }
}

// --- the password ----------------------------------------------------------------------------------

TEST(ChoicesPassword, IsKeptOrForgotten) {
  for (const auto& [option, kept] : each_option<bool>("password_kept", {{"yes", true}, {"no", false}})) {
    OneSimple2 feeder(with("password_kept", option));
    feeder.set("NEW_PWD", 1234);
    feeder.run(10);
    switch_off_and_on(feeder);
    EXPECT_EQ(feeder.bit("PROG_UNLOCK"), !kept) << option;
    feeder.set("PWD_Input", 1234);
    EXPECT_EQ(feeder.bit("PROG_UNLOCK"), kept) << option;
  }
}

TEST(ChoicesPassword, FromTheFactoryIs0Or65535) {
  for (const auto& [option, password] : each_option("first_password", {{"0", 0}, {"65535", 65535}})) {
    OneSimple2 feeder(with("first_password", option));
    EXPECT_EQ(feeder.bit("PROG_UNLOCK"), password == 0) << option;
    feeder.set("PWD_Input", password);
    EXPECT_TRUE(feeder.bit("PROG_UNLOCK")) << option;
    feeder.set("NEW_PWD", 7);
    feeder.set("Factory_Reset", 1);
    feeder.set("PWD_Input", password);
    EXPECT_TRUE(feeder.bit("PROG_UNLOCK")) << option << ": the factory's again";
    EXPECT_EQ(feeder.get("NEW_PWD"), password) << option;
  }
}

TEST(ChoicesPassword, LockedWritesAreAllowedOrIgnored) {
  for (const auto& [option, allowed] :
       each_option<bool>("locked_writes", {{"allowed", true}, {"ignored", false}})) {
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

TEST(ChoicesPassword, LockedStartIsAllowedOrIgnored) {
  for (const auto& [option, allowed] :
       each_option<bool>("locked_start", {{"allowed", true}, {"ignored", false}})) {
    OneSimple2 feeder(with("locked_start", option));
    write_program(feeder, {{0x03, 1, 0, 1}});  // JMP1: Jump JMP1
    feeder.set("AutoStart_MainProg", 1);
    feeder.set("NEW_PWD", 1234);
    feeder.run(200);
    switch_off_and_on(feeder);
    EXPECT_FALSE(feeder.bit("PROG_UNLOCK"));
    feeder.run(2);
    EXPECT_TRUE(feeder.bit("PROG_MAIN_RunTime_Status")) << option << ": it always starts automatically";
    feeder.set("PROG_MAIN_RunTime_END", 1);
    feeder.set("PROG_MAIN_RunTime_START", 0);
    EXPECT_EQ(feeder.bit("PROG_MAIN_RunTime_Status"), allowed) << option;
    feeder.set("PWD_Input", 1234);
    feeder.set("PROG_MAIN_RunTime_START", 0);
    EXPECT_TRUE(feeder.bit("PROG_MAIN_RunTime_Status")) << option;
  }
}

}  // namespace choices_memory_test
}  // namespace understudy::emulator::models::simple2_r3
