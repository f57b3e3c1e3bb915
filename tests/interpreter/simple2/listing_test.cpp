// Correct listings.
#include "interpreter/simple2/listing.h"

#include <gtest/gtest.h>

#include <random>

#include "interpreter/simple2/instructions.h"
#include "tests/interpreter/facts.h"
#include "tests/sanitized.h"

namespace understudy::interpreter::simple2 {
namespace listing_test {

/// The lines of a listing without errors.
Lines lines_of(std::string_view text) {
  const Assembly assembly = assemble(text);
  for (const ListingError& error : assembly.errors) ADD_FAILURE() << to_string(error) << "\n" << text;
  return assembly.lines.value_or(Lines{});
}

Lines lines_from(const std::vector<Line>& first) {
  Lines lines{};
  std::copy(first.begin(), first.end(), lines.begin());
  return lines;
}

void expect_round_trip(const Lines& lines) {
  const std::string text = disassemble(lines);
  const Lines again = lines_of(text);
  for (std::size_t i = 0; i < lines.size(); ++i)
    ASSERT_EQ(again[i], lines[i]) << "line " << i << "\n" << text;
  ASSERT_EQ(disassemble(again), text);
}

TEST(Simple2Listing, OfABlinkingOutputGivesTheCellsOfTheWorkedExample) {
  EXPECT_EQ(lines_of("; three pulses\n"
                     "blink:  Out DOUT_0 ON\n"
                     "        Delay_mSec 100\n"
                     "        Out DOUT_0, OFF   ; and off\n"
                     "\n"
                     "        delay_msec 0x64\r\n"
                     "        LOOP Blink 3\n"
                     "        END"),
            lines_from({{0x05, 0, 1, 1},
                        {0x02, 100, 0, 0},
                        {0x05, 0, 0, 0},
                        {0x02, 100, 0, 0},
                        {0x04, 1, 3, 0},
                        {0xFF, 0, 0, 0}}));
}

TEST(Simple2Listing, IsWrittenInTheManualsSpelling) {
  EXPECT_EQ(disassemble(lines_from({{0x05, 0, 1, 1},
                                    {0x02, 0xDC, 0x05, 0},
                                    {0x67, 3, 0xFB, 0},
                                    {0x01, 3, 0, 0},
                                    {0x73, 154, 32, 0},
                                    {0x09, 53, 1, 0},
                                    {0x88, 0xD4, 0xFE, 0},
                                    {0x24, 0, 0, 0},
                                    {0x04, 1, 3, 0}})),
            "JMP1:   Out DOUT_0 ON\n"
            "        Delay_mSec 1500\n"
            "        VAR_DirectAdd MEM3 -5\n"
            "        Wait_IO DIN_3 OFF\n"
            "        Cord_ALL Cord_A VAR32\n"
            "        Out_Array_Select 0b0110101 ON\n"
            "        VelRPM_A_Direct -300\n"
            "        Wait_Move_A @0\n"
            "        Loop JMP1 3\n");
}

TEST(Simple2Listing, ShowsWhatIsNoInstructionAsCells) {
  Lines lines{};
  lines[0] = {0x0A, 1, 2, 3};  // not in the list
  lines[1] = {0x00, 9, 0, 0};  // an operand that NOP does not have
  lines[2] = {0x05, 7, 1, 0};  // DOUT 7
  lines[40] = {0xFF, 0, 0, 0};
  EXPECT_EQ(disassemble(lines),
            "        .line 0x0A 1 2 3\n"
            "        .line 0x00 9 0 0  ; NOP\n"
            "        .line 0x05 7 1 0  ; Out\n"
            "        .at 40\n"
            "        END\n");
  expect_round_trip(lines);
}

TEST(Simple2Listing, LabelsOnlyTheLineThatHasTheFlag) {
  const Lines lines = lines_from({{0x00, 0, 0, 5}, {0x03, 5, 0, 200}, {0x00, 0, 0, 5}});
  EXPECT_EQ(disassemble(lines),
            "@5      NOP\n"
            "@200    Jump JMP5\n"
            "JMP5:   NOP\n");
  expect_round_trip(lines);
}

TEST(Simple2Listing, OfAnEmptyProgramIsEmpty) {
  EXPECT_EQ(disassemble(Lines{}), "");
  EXPECT_EQ(lines_of(""), Lines{});
  EXPECT_EQ(lines_of("; nothing\n\n   \n"), Lines{});
}

TEST(Simple2Listing, ReadsEveryMnemonicOfTheManual) {
  std::string text;
  std::vector<int> opcodes;
  for (const Fact& fact : read_facts(std::string(TEST_FACTS) + "/simple2/instructions.csv")) {
    text += fact.at("mnemonic");
    for (const char* column : {"data1", "data2"}) {
      const std::string& operand = fact.at(column);
      if (operand.starts_with("flag"))
        text += " @1";
      else if (operand.starts_with("param"))
        text += " VAR32";
      else if (operand != "N/A" && !operand.starts_with("amount_H"))
        text += " 1";
    }
    text += '\n';
    opcodes.push_back(std::stoi(fact.at("opcode"), nullptr, 16));
  }
  const Lines lines = lines_of(text);
  for (std::size_t i = 0; i < opcodes.size(); ++i) EXPECT_EQ(lines[i].command, opcodes[i]);
  expect_round_trip(lines);
}

TEST(Simple2Listing, GivesLabelsFlagsThatAreFree) {
  // JMP1 is on a line, 2 is only referred to, 3 is a cell.
  EXPECT_EQ(lines_of("JMP1: NOP\nfirst: Jump @2\n@3 NOP\nsecond: Jump second\nJump first"),
            lines_from({{0, 0, 0, 1}, {3, 2, 0, 4}, {0, 0, 0, 3}, {3, 5, 0, 5}, {3, 4, 0, 0}}));
}

TEST(Simple2Listing, LetsSeveralLabelsStandBeforeOneLine) {
  EXPECT_EQ(lines_of("a:\nb: c:@9 NOP\nJump a\nJump b\nJump c\nJump JMP9"),
            lines_from({{0, 0, 0, 9}, {3, 9, 0, 0}, {3, 9, 0, 0}, {3, 9, 0, 0}, {3, 9, 0, 0}}));
  EXPECT_EQ(lines_of("a: JMP9: NOP\nJump a"), lines_from({{0, 0, 0, 9}, {3, 9, 0, 0}}));
  EXPECT_EQ(lines_of("a: .line 0 1 2 9\nJump a"), lines_from({{0, 1, 2, 9}, {3, 9, 0, 0}}));
}

TEST(Simple2Listing, ContinuesWhereRequested) {
  Lines lines{};
  lines[255] = {0xFF, 0, 0, 0};
  lines[3] = {0x03, 1, 0, 0};
  lines[2] = {0x00, 0, 0, 1};
  EXPECT_EQ(lines_of(".at 255\nEND\n.at 2\nx: NOP\nJump x"), lines);
}

TEST(Simple2Listing, MayBeginWithAByteOrderMark) {
  EXPECT_EQ(lines_of("\xEF\xBB\xBF"
                     "END"),
            lines_from({{0xFF, 0, 0, 0}}));
}

TEST(Simple2Listing, TakesOperandsAtTheEndsOfTheirRanges) {
  EXPECT_EQ(lines_of("Delay_mSec 65535\nVelRPM_B_Direct -32768\nVelRPM_B_Direct 32767\nVAR_Direct 255 -128\n"
                     "VAR_Direct 160 127\nWait_IO DIN_10 1\nOut 6 0\nOut_Array 0b1111111\nLoop @64 255\n"
                     "PWM_A_Direct 100\nJump_STATUS_ON JMP64 15\nCounter_Clear 2\nWait_Move_B @255"),
            lines_from({{0x02, 255, 255, 0},
                        {0x89, 0, 0x80, 0},
                        {0x89, 0xFF, 0x7F, 0},
                        {0x6F, 255, 0x80, 0},
                        {0x6F, 160, 127, 0},
                        {0x01, 10, 1, 0},
                        {0x05, 6, 0, 0},
                        {0x08, 0x7F, 0, 0},
                        {0x04, 64, 255, 0},
                        {0x82, 100, 0, 0},
                        {0xC0, 64, 15, 0},
                        {0x50, 2, 0, 0},
                        {0x34, 255, 0, 0}}));
}

// --- any program converts without loss ----------------------------------------------------------

TEST(Simple2ListingRoundTrip, KeepsAnyCells) {
  std::mt19937 random(1);
  for (int count = 0; count < 200; ++count) {
    Lines lines{};
    const unsigned filled = random() % 4;  // none, some or all lines
    for (Line& line : lines) {
      if (random() % 3 >= filled) continue;
      line = {static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random()),
              static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random())};
    }
    expect_round_trip(lines);
  }
}

TEST(Simple2ListingRoundTrip, KeepsProgramsThatAreNearlyRight) {
  std::mt19937 random(2);
  for (int count = 0; count < 200; ++count) {
    Lines lines{};
    for (Line& line : lines) {
      const Instruction& instruction = kInstructions[random() % kInstructions.size()];
      line.command = instruction.opcode;
      if (instruction.data1 != Operand::none) line.data1 = static_cast<std::uint8_t>(random() % 66);
      if (instruction.data2 != Operand::none) line.data2 = static_cast<std::uint8_t>(random() % 12);
      if (random() % 2 == 0) line.flag = static_cast<std::uint8_t>(random() % 70);
    }
    expect_round_trip(lines);
  }
}

TEST(Simple2ListingRoundTrip, KeepsEveryValueOfEveryCellOfEveryCommand) {
  for (int command = 0; command < 256; command += is_sanitized() ? 5 : 1) {
    for (const int other : {0, 1, 7, 128}) {
      Lines by_data1{};
      Lines by_data2{};
      for (int value = 0; value < 256; ++value) {
        const auto cell = static_cast<std::uint8_t>(value);
        const auto fixed = static_cast<std::uint8_t>(other);
        by_data1[cell] = {static_cast<std::uint8_t>(command), cell, fixed, 0};
        by_data2[cell] = {static_cast<std::uint8_t>(command), fixed, cell, 0};
      }
      expect_round_trip(by_data1);
      expect_round_trip(by_data2);
    }
  }
}

}  // namespace listing_test
}  // namespace understudy::interpreter::simple2
