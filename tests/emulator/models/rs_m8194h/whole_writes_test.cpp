// Writes to the tables that one of the choices treats as one message: two words for a group of FRnet outputs,
// and coils that switch servos.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "emulator/device/user_program.h"
#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace whole_writes_test {

using Choices = std::map<std::string, std::string>;
const Choices kOneNumber{{"frnet_group_write", "one_number_for_the_first"}};
const Choices kOneNumberAsALine{{"frnet_group_write", "one_number_for_the_first"},
                                {"table_writes", "become_lines"}};
const Choices kServos{{"servo_coils", "switch_the_servos"}};

std::string groups(OneRsm& rsm) { return rsm.ask("03 00 00 00 08"); }

TEST(RsM8194hWholeWrites, TwoWordsAreANumberForTheirFirstGroup) {
  OneRsm rsm({.choices = kOneNumber});
  rsm.set("VAR511", -2);
  EXPECT_EQ(rsm.ask("10 00 00 00 02 04 00 00 FF FF"), "10 00 00 00 02");
  EXPECT_EQ(rsm.ask("10 00 01 00 02 04 7F FF 01 FF"), "10 00 01 00 02");  // VAR511
  // There is no group after the last one: CALL_MP follows, which is not meant.
  EXPECT_EQ(rsm.ask("10 00 07 00 02 04 00 00 00 05"), "10 00 07 00 02");
  EXPECT_EQ(groups(rsm), "03 10 FF FF FF FE 00 00 00 00 00 00 00 00 00 00 00 05");
  rsm.run(20);
  EXPECT_EQ(rsm.get("CALL_MP"), 0);
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 30);
  // Other counts are as usual.
  EXPECT_EQ(rsm.ask("06 00 03 00 04"), "06 00 03 00 04");
  EXPECT_EQ(rsm.ask("10 00 04 00 03 06 00 06 00 07 00 08"), "10 00 04 00 03");
  EXPECT_EQ(groups(rsm), "03 10 FF FF FF FE 00 00 00 04 00 06 00 07 00 08 00 05");
}

TEST(RsM8194hWholeWrites, ItsWordsComeInTheOrderOfRegister14) {
  OneRsm rsm({.choices = kOneNumber});
  rsm.set("WORD_ORDER", 1);
  EXPECT_EQ(rsm.ask("10 00 02 00 02 04 12 34 00 00"), "10 00 02 00 02");
  EXPECT_EQ(groups(rsm), "03 10 00 00 00 00 12 34 00 00 00 00 00 00 00 00 00 00");
}

TEST(RsM8194hWholeWrites, NumbersThatAreNeitherWordNorVariableAreRefused) {
  for (const Choices& choices : {kOneNumber, kOneNumberAsALine}) {
    OneRsm rsm({.choices = choices});
    if (choices.size() > 1) rsm.send("RSM_MP_CREATE 1");
    for (const char* const number : {"00 01 00 00", "7F FF 02 00", "7F FE FF FF", "FF FF FF FF"}) {
      EXPECT_EQ(rsm.ask("10 00 00 00 02 04 " + std::string(number)), "90 03") << number;
      EXPECT_EQ(rsm.get("IllegalFuncErr"), 2);
    }
    EXPECT_EQ(groups(rsm), "03 10 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00");
    if (choices.size() > 1) rsm.send("RSM_MACRO_MP_CLOSE");
    EXPECT_EQ(rsm.device().user_program()->program_text(), "");
  }
}

TEST(RsM8194hWholeWrites, InADownloadTheNumberIsOneLine) {
  OneRsm rsm({.choices = kOneNumberAsALine});
  rsm.send("RSM_MP_CREATE 1");  // eight lines
  for (int i = 0; i < 7; ++i) rsm.send("RSM_MACRO_SET_VAR VAR9 1");
  EXPECT_EQ(rsm.ask("10 00 02 00 02 04 7F FF 00 03"), "10 00 02 00 02");
  EXPECT_EQ(rsm.ask("10 00 02 00 02 04 00 00 00 03"), "90 03");  // the ninth
  EXPECT_EQ(rsm.get("IllegalFuncErr"), 3);
  rsm.send("RSM_MACRO_MP_CLOSE");
  EXPECT_TRUE(rsm.device().user_program()->program_text().ends_with("  RSM_MACRO_FRNET_OUT 2 VAR3\nEND\n"));
  EXPECT_EQ(groups(rsm), "03 10 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00");
}

TEST(RsM8194hWholeWrites, CoilsSwitchServosAndTheOutputsBeforeThem) {
  OneRsm rsm({.choices = kServos});
  EXPECT_EQ(rsm.ask("05 00 82 FF 00"), "05 00 82 FF 00");  // Z
  EXPECT_EQ(rsm.ask("01 00 80 00 04"), "01 01 04");
  EXPECT_EQ(rsm.ports().servo_on(2), true);
  // The last two outputs of group 7, then X, Y and Z.
  EXPECT_EQ(rsm.ask("0F 00 7E 00 05 01 0E"), "0F 00 7E 00 05");
  EXPECT_EQ(rsm.ask("01 00 7E 00 06"), "01 01 0E");
  EXPECT_EQ(rsm.get("holding.FRnet DO group 7"), 0x8000);
  EXPECT_EQ(rsm.ask("05 00 83 FF 00"), "05 00 83 FF 00");
  EXPECT_EQ(rsm.ask("05 00 83 00 00"), "05 00 83 00 00");
  // There is nothing after U, and nothing is done in part.
  EXPECT_EQ(rsm.ask("0F 00 83 00 02 01 03"), "8F 02");
  EXPECT_EQ(rsm.ask("01 00 80 00 04"), "01 01 03");
}

TEST(RsM8194hWholeWrites, WithoutTheChoiceServoCoilsAreOnlyRead) {
  OneRsm rsm;
  EXPECT_EQ(rsm.ask("05 00 82 FF 00"), "85 02");
  EXPECT_EQ(rsm.ask("0F 00 7E 00 05 01 0E"), "8F 02");
  EXPECT_EQ(rsm.ask("01 00 7E 00 06"), "01 01 00");
}

}  // namespace whole_writes_test
}  // namespace understudy::emulator::models::rs_m8194h
