// Cells, lines and flags of a program.
#include "interpreter/simple2/program.h"

#include <gtest/gtest.h>

#include <random>

#include "interpreter/simple2/instructions.h"

namespace understudy::interpreter::simple2 {
namespace program_test {

TEST(Simple2Program, IsEmptyAtFirst) {
  const Program program;
  for (int cell = 0; cell < kLineCount * kCellsPerLine; ++cell) ASSERT_EQ(program.cell(cell), 0);
  for (int flag = 0; flag < 256; ++flag) {
    EXPECT_EQ(program.line_with_flag(static_cast<std::uint8_t>(flag)), std::nullopt);
  }
}

TEST(Simple2Program, HasFourCellsALineInTheOrderOfTheRegisters) {
  Program program;
  for (int cell = 0; cell < 1024; ++cell) program.set_cell(cell, static_cast<std::uint8_t>(cell * 7));
  for (int cell = 0; cell < 1024; ++cell) ASSERT_EQ(program.cell(cell), static_cast<std::uint8_t>(cell * 7));
  EXPECT_EQ(program.line(1), (Line{28, 35, 42, 49}));
  EXPECT_EQ(program, Program(program.lines()));
}

TEST(Simple2Program, GivesAFlagToTheLastLineThatHasIt) {
  Program program;
  program.set_cell(4 * 9 + 3, 5);
  program.set_cell(4 * 3 + 3, 5);  // later in time, earlier in the program
  EXPECT_EQ(program.line_with_flag(5), 9);
  program.set_cell(4 * 255 + 3, 5);
  EXPECT_EQ(program.line_with_flag(5), 255);
  program.set_cell(4 * 255 + 3, 0);
  program.set_cell(4 * 9 + 3, 6);
  EXPECT_EQ(program.line_with_flag(5), 3);
  EXPECT_EQ(program.line_with_flag(6), 9);
}

TEST(Simple2Program, KnowsOnlyFlags1To64) {
  Program program;
  for (int line = 0; line < 256; ++line) program.set_cell(4 * line + 3, static_cast<std::uint8_t>(line));
  for (int flag = 0; flag < 256; ++flag) {
    const auto line = program.line_with_flag(static_cast<std::uint8_t>(flag));
    EXPECT_EQ(line.has_value(), flag >= 1 && flag <= 64) << flag;
    EXPECT_EQ(line.value_or(flag), flag);
  }
}

// Cells written at random, compared with a program made of its lines at once.
TEST(Simple2Program, ItsFlagsAreThoseOfItsLinesAfterAnyWrites) {
  constexpr std::uint8_t kEnd = opcode_of("END");
  std::mt19937_64 random(5);
  const auto below = [&](int many) { return std::uniform_int_distribution<int>(0, many - 1)(random); };
  for (const auto after_end : {FlagRules::AfterEnd::count, FlagRules::AfterEnd::do_not_count}) {
    const FlagRules rules{.after_end = after_end};
    Program program({}, rules);
    for (int write = 0; write < 20'000; ++write) {
      const int column = below(4);
      const int value = column == 3 ? below(4) * below(30) : below(8) == 0 ? kEnd : below(256);
      program.set_cell(4 * below(40) + column, static_cast<std::uint8_t>(value));
      ASSERT_EQ(program, Program(program.lines(), rules)) << write;
    }
  }
}

}  // namespace program_test
}  // namespace understudy::interpreter::simple2
