// Every row of the table, with lines that have its form and lines that do not.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "interpreter/slim/commands.h"
#include "interpreter/slim/parse.h"
#include "interpreter/slim/text_of.h"
#include "tests/interpreter/slim/row_cases.h"

namespace understudy::interpreter::slim {
namespace rows_test {

TEST(SlimRows, AllHaveACase) {
  std::set<std::string_view> with_case;
  for (const RowCase& row : kRowCases) with_case.insert(row.syntax);
  for (const CommandRow& row : kCommands) EXPECT_TRUE(with_case.contains(row.syntax)) << row.syntax;
  EXPECT_EQ(with_case.size(), kCommands.size());
}

TEST(SlimRows, TakeTheirForm) {
  for (const RowCase& row : kRowCases) {
    const ParseResult result = parse_line(row.accepted);
    ASSERT_EQ(result.error, Error::none) << row.accepted;
    ASSERT_TRUE(result.line.command) << row.accepted;
    const Command& command = *result.line.command;
    EXPECT_EQ(kCommands[static_cast<std::size_t>(command.row)].syntax, row.syntax) << row.accepted;
    EXPECT_EQ(command.module >= 0, kCommands[static_cast<std::size_t>(command.row)].takes_module())
        << row.accepted;
  }
}

TEST(SlimRows, RefuseOtherFormsWithTheErrorsNumber) {
  for (const RowCase& row : kRowCases) {
    std::string_view rest = row.refused;
    while (!rest.empty()) {
      const std::size_t bar = rest.find(" | ");
      const std::string_view line = rest.substr(2, bar == std::string_view::npos ? bar : bar - 2);
      EXPECT_EQ(static_cast<int>(parse_line(line).error), rest[0] - '0') << line;
      rest = bar == std::string_view::npos ? std::string_view() : rest.substr(bar + 3);
    }
  }
}

TEST(SlimRows, ReadBackFromTheirText) {
  for (const RowCase& row : kRowCases) {
    const ParseResult result = parse_line(row.accepted);
    ASSERT_EQ(result.error, Error::none) << row.accepted;
    EXPECT_EQ(parse_line(text_of(result.line)), result) << row.accepted << " -> " << text_of(result.line);
  }
}

}  // namespace rows_test
}  // namespace understudy::interpreter::slim
