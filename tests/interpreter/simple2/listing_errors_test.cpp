// Wrong listings: each error with its place and its message.
#include <gtest/gtest.h>

#include <random>

#include "interpreter/simple2/listing.h"

namespace understudy::interpreter::simple2 {
namespace listing_errors_test {

std::vector<std::string> errors_of(std::string_view text) {
  const Assembly assembly = assemble(text);
  std::vector<std::string> messages;
  for (const ListingError& error : assembly.errors) messages.push_back(to_string(error));
  EXPECT_EQ(assembly.lines.has_value(), messages.empty()) << text;
  return messages;
}

struct WrongListing {
  std::string text;
  std::string message;
};

void expect_messages(const std::vector<WrongListing>& listings) {
  for (const auto& [text, message] : listings) {
    EXPECT_EQ(errors_of(text), std::vector<std::string>{message}) << text;
  }
}

constexpr const char* kFlag = "a label, JMP1 to JMP64, or @0 to @255";
constexpr const char* kParameter =
    "MEM0 to MEM31, VAR32 to VAR63, DAT64 to DAT158, DAT167 to DAT182, a register such as Cord_A, or a "
    "number from 0 "
    "to 255";

TEST(Simple2ListingError, NamesTheNearestInstruction) {
  expect_messages({
      {"NOP\n  Dely_mSec 5",
       "2:3: mnemonic: no instruction is called 'Dely_mSec'; expected an instruction (nearest: "
       "'Delay_mSec')"},
      {"MOVE_INC_C MEM0",
       "1:1: mnemonic: no instruction is called 'MOVE_INC_C'; expected an instruction (nearest: "
       "'Move_INC_A')"},
      {"Delay 5",
       "1:1: mnemonic: no instruction is called 'Delay'; expected an instruction (nearest: 'Delay_mSec')"},
      {"STOP", "1:1: mnemonic: no instruction is called 'STOP'; expected an instruction (nearest: 'STOP_A')"},
      {"goto 5", "1:1: mnemonic: no instruction is called 'goto'; expected Jump"},
      {"Mov 5",
       "1:1: mnemonic: no instruction is called 'Mov'; expected VAR_Copy, or VAR_Direct for a number"},
      {"Home_A", "1:1: mnemonic: no instruction is called 'Home_A'; expected Move_Home_A"},
      {"Xyzzy 5",
       "1:1: mnemonic: no instruction is called 'Xyzzy'; expected an instruction, such as Delay_mSec"},
      {"Out DOUT0 ON", "1:5: operand 1: 'DOUT0' is not valid; expected DOUT_0 to DOUT_6"},
      {".org 5", "1:1: mnemonic: no instruction is called '.org'; expected .at or .line"},
  });
}

TEST(Simple2ListingError, ReportsWhatAnOperandMayBe) {
  expect_messages({
      {"Wait_IO DIN_11 ON", "1:9: operand 1: 'DIN_11' does not exist; expected DIN_0 to DIN_10"},
      {"Wait_IO 11 ON", "1:9: operand 1: 11 is out of range; expected DIN_0 to DIN_10"},
      {"Wait_IO DIN_1 maybe", "1:15: operand 2: 'maybe' is not a level; expected ON or OFF"},
      {"Wait_IO DIN_1 2", "1:15: operand 2: '2' is not a level; expected ON or OFF"},
      {"Out DOUT_7 ON", "1:5: operand 1: 'DOUT_7' does not exist; expected DOUT_0 to DOUT_6"},
      {"Out DIN_1 ON", "1:5: operand 1: 'DIN_1' is not valid; expected DOUT_0 to DOUT_6"},
      {"Out_Array 128", "1:11: operand 1: 128 is out of range; expected 0 to 127"},
      {"Delay_mSec 65536", "1:12: operand 1: 65536 is out of range; expected 0 to 65535"},
      {"Delay_mSec -1", "1:12: operand 1: -1 is out of range; expected 0 to 65535"},
      {"Delay_mSec 99999999999", "1:12: operand 1: 99999999999 is out of range; expected 0 to 65535"},
      {"Delay_mSec 1.5s", "1:12: operand 1: '1.5s' is not a number; expected 0 to 65535"},
      {"VelRPM_A_Direct 32768", "1:17: operand 1: 32768 is out of range; expected -32768 to 32767"},
      {"VAR_Direct MEM0 128", "1:17: operand 2: 128 is out of range; expected -128 to 127"},
      {"VAR_Direct MEM0 -129", "1:17: operand 2: -129 is out of range; expected -128 to 127"},
      {"VAR_Direct MEM0 -", "1:17: operand 2: '-' is not a number; expected -128 to 127"},
      {"VAR_Direct MEM0 0x", "1:17: operand 2: '0x' is not a number; expected -128 to 127"},
      {"VAR_Inc MEM32",
       std::string("1:9: operand 1: no parameter is called 'MEM32'; expected ") + kParameter},
      {"VAR_Inc 256", std::string("1:9: operand 1: 256 is out of range; expected ") + kParameter},
      {"PWM_A_Direct 101", "1:14: operand 1: 101 is out of range; expected 0 to 100"},
      {"Counter_Clear 0", "1:15: operand 1: 0 is out of range; expected 1 to 2"},
      {"Timer_Stop 3", "1:12: operand 1: 3 is out of range; expected 1 to 2"},
      {"Jump_STATUS_ON @1 16", "1:19: operand 2: 16 is out of range; expected 0 to 15"},
      {"Loop @1 256", "1:9: operand 2: 256 is out of range; expected 0 to 255"},
  });
}

TEST(Simple2ListingError, ReportsHowManyOperandsThereAre) {
  expect_messages({
      {"Loop JMP1", std::string("1:1: operands: Loop has 1; expected 2: ") + kFlag + ", then 0 to 255"},
      {"Out DOUT_1 ON 5", "1:15: operands: Out has 3; expected 2: DOUT_0 to DOUT_6, then ON or OFF"},
      {"END 0", "1:5: operands: END has 1; expected none"},
      {"Delay_mSec", "1:1: operands: Delay_mSec has 0; expected 1: 0 to 65535"},
      {"Delay_mSec 1 0", "1:14: operands: Delay_mSec has 2; expected 1: 0 to 65535"},
  });
}

TEST(Simple2ListingError, FindsWhatIsWrongWithALabel) {
  expect_messages({
      {"a: NOP\nA: NOP", "2:1: label: 'A' appears twice; expected a different name from the one in line 1"},
      {"again: NOP\nJump agian",
       "2:6: operand 1: no line is labelled 'agian'; expected a label (nearest: 'again')"},
      {"Jump again", std::string("1:6: operand 1: no line is labelled 'again'; expected ") + kFlag},
      {"Jump 5", std::string("1:6: operand 1: '5' is not a flag; expected ") + kFlag},
      {"Jump JMP65", std::string("1:6: operand 1: 'JMP65' does not exist; expected ") + kFlag},
      {"Jump JMP0", std::string("1:6: operand 1: 'JMP0' does not exist; expected ") + kFlag},
      {"Jump @256", std::string("1:6: operand 1: '@256' does not exist; expected ") + kFlag},
      {"JMP65: NOP", "1:1: label: 'JMP65:' does not exist; expected JMP1: to JMP64:"},
      {"@256 NOP", "1:1: label: '@256' does not exist; expected @0 to @255"},
      {"@ NOP",
       "1:1: label: '@' is not a label; expected a name of letters, digits and '_' before ':', or @0 to "
       "@255"},
      {"5: NOP",
       "1:1: label: '5:' is not a label; expected a name of letters, digits and '_' before ':', or @0 to "
       "@255"},
      {"NOP\nlast:", "2:1: label: 'last:' does not mark a line; expected an instruction"},
      {"JMP4: @5 NOP", "1:7: label: the line already has a flag; expected JMP4 alone"},
      {"@5 .line 1 2 3 4", "1:16: label: the line already has a flag; expected JMP5 alone"},
      {"a: @200 NOP", "1:1: label: 'a' is on a line without a flag; expected @1 to @64, or none"},
      {"JMP5: NOP\n@5 END",
       "1:1: label: JMP5 leads to line 2, the last line with it; expected a flag that no other line has"},
      {"a: @5 NOP\n@5 END",
       "1:4: label: JMP5 leads to line 2, the last line with it; expected a flag that no other line has"},
      {"JMP5: NOP\nJMP5: NOP",
       "1:1: label: JMP5 leads to line 2, the last line with it; expected a flag that no other line has"},
  });
}

TEST(Simple2ListingError, FindsWhatIsWrongWithAPlace) {
  expect_messages({
      {".at 256", "1:5: .at: 256 is out of range; expected a line from 0 to 255"},
      {".at", "1:1: .at: needs one number; expected a line from 0 to 255"},
      {"NOP\n.at 0\nEND",
       "3:1: line: line 0 of the program is already defined in line 1; expected a free line"},
      {".line 1 2 3", "1:1: .line: needs four numbers; expected CMD DATA1 DATA2 JMP, each 0 to 255"},
      {".line 1 2 x 4", "1:11: .line: 'x' is not a number; expected CMD DATA1 DATA2 JMP, each 0 to 255"},
      {".line 1 2 3 256", "1:13: .line: 256 is out of range; expected CMD DATA1 DATA2 JMP, each 0 to 255"},
  });
}

TEST(Simple2ListingError, AllowsNoMoreThan256Lines) {
  std::string text;
  for (int line = 0; line < 256; ++line) text += "NOP\n";
  EXPECT_TRUE(errors_of(text).empty());
  text += "first: Jump first\nEND\n";
  EXPECT_EQ(errors_of(text), std::vector<std::string>{
                                 "257:8: line: the program is full; expected at most 256 lines, 0 to 255"});
}

TEST(Simple2ListingError, AllowsNoMoreThan64Flags) {
  std::string text;
  for (int label = 0; label < 64; ++label) text += "l" + std::to_string(label) + ": NOP\n";
  EXPECT_TRUE(errors_of(text).empty());
  EXPECT_EQ(
      errors_of(text + "  one_more: NOP"),
      std::vector<std::string>{"65:3: label: no flag is left for 'one_more'; expected at most 64 flags"});
}

TEST(Simple2ListingError, ReportsAllOfThemInTheOrderOfTheText) {
  EXPECT_EQ(errors_of("Jump nowhere\n"
                      "Ot DOUT_1 ON\n"
                      "Out DOUT_9 maybe\n"
                      "a: NOP\n"
                      "a: END 5\n"
                      "Jump a\n"),
            (std::vector<std::string>{
                std::string("1:6: operand 1: no line is labelled 'nowhere'; expected ") + kFlag,
                "2:1: mnemonic: no instruction is called 'Ot'; expected an instruction (nearest: 'Out')",
                "3:5: operand 1: 'DOUT_9' does not exist; expected DOUT_0 to DOUT_6",
                "3:12: operand 2: 'maybe' is not a level; expected ON or OFF",
                "5:1: label: 'a' appears twice; expected a different name from the one in line 4",
                "5:8: operands: END has 1; expected none",
            }));
}

TEST(Simple2ListingError, ComesFromAnyTextThatIsNoListingAndNothingWorseDoes) {
  constexpr std::string_view kPieces[] = {"Jump", "Loop",    "a",    ":",     "a:",
                                          "@",    "@5",      "@999", "JMP5",  "JMP5:",
                                          ".at",  ".line",   "255",  "-1",    "0x",
                                          "ON",   ";",       "\n",   "\n",    " ",
                                          " ",    " ",       ",",    "DIN_3", std::string_view("\0", 1),
                                          "\xFF", "Wait_IO", "END",  "MEM3"};
  std::mt19937 random(3);
  for (int count = 0; count < 4000; ++count) {
    std::string text;
    for (unsigned length = random() % 40; length > 0; --length)
      text += kPieces[random() % std::size(kPieces)];
    const Assembly assembly = assemble(text);
    ASSERT_EQ(assembly.lines.has_value(), assembly.errors.empty()) << text;
    if (!assembly.lines) continue;
    const Assembly again = assemble(disassemble(*assembly.lines));
    ASSERT_EQ(again.lines, assembly.lines) << text;
  }
}

}  // namespace listing_errors_test
}  // namespace understudy::interpreter::simple2
