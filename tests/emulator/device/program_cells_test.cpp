// Rows of numbers as text: printed rows are read back, and each wrong row is reported with its place.
#include "emulator/device/program_cells.h"

#include <gtest/gtest.h>

#include "emulator/device/program_error.h"

namespace understudy::emulator {
namespace program_cells_test {

constexpr CellForm kForm{
    .row = "CODE A B", .fewest = 2, .max = 3, .lowest = -5, .highest = 300, .max_rows = 3};

TEST(ProgramCells, AreReadAsTheyArePrinted) {
  const std::vector<CellRow> rows = read_cells("\n 1\t-5 300\r\n\n0 0\n7 8 9", kForm);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].cells, (std::vector<std::int64_t>{1, -5, 300}));
  EXPECT_EQ(rows[0].line, 2);
  EXPECT_EQ(rows[1].line, 4);
  EXPECT_EQ(rows[2].line, 5);
  EXPECT_EQ(to_text(rows), "1 -5 300\n0 0\n7 8 9\n");
  EXPECT_EQ(to_text(read_cells(to_text(rows), kForm)), to_text(rows));
  EXPECT_TRUE(read_cells("", kForm).empty());
}

TEST(ProgramCells, EachWrongRowHasItsPlace) {
  const std::pair<const char*, const char*> cases[] = {
      {"1 2\n 3\n", "2:3: fewer than two cells; expected CODE A B"},
      {"1 2 3 4\n", "1:7: more than three cells; expected CODE A B"},
      {"1  2 x\n", "1:6: 'x' is not a cell; expected -5 to 300"},
      {"1 301\n", "1:3: '301' is not a cell; expected -5 to 300"},
      {"-6 1\n", "1:1: '-6' is not a cell; expected -5 to 300"},
      {"99999999999999999999 1\n", "1:1: '99999999999999999999' is not a cell; expected -5 to 300"},
      {"1 2\n1 2\n1 2\n\n  1 2\n", "5:3: one line too many; expected at most 3"},
  };
  for (const auto& [text, mistake] : cases) {
    try {
      read_cells(text, kForm);
      ADD_FAILURE() << text;
    } catch (const ProgramError& error) {
      EXPECT_EQ("f:" + std::string(mistake), in_file(error.first(), "f")) << text;
    }
  }
}

TEST(ProgramMistakes, SayWhereTheyAreAsFarAsItIsKnown) {
  EXPECT_EQ(in_file({4, 9, "is wrong"}, "a.lst"), "a.lst:4:9: is wrong");
  EXPECT_EQ(in_file({4, 0, "is wrong"}, "a.lst"), "a.lst:4: is wrong");
  EXPECT_EQ(in_file({0, 0, "is wrong"}, "a.lst"), "a.lst: is wrong");
  EXPECT_EQ(in_text({4, 9, "is wrong"}), "line 4, column 9: is wrong");
  EXPECT_EQ(in_text({4, 0, "is wrong"}), "line 4: is wrong");
  EXPECT_EQ(in_text({0, 0, "is wrong"}), "is wrong");
}

}  // namespace program_cells_test
}  // namespace understudy::emulator
