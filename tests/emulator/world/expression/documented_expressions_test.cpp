// The examples of docs/expressions.md have the values on the page.
#include <gtest/gtest.h>

#include <fstream>

#include "emulator/world/expression/tolerance.h"
#include "emulator/world/probe/probes.h"
#include "tests/emulator/world/expression/bench_of_names.h"
#include "tests/emulator/world/two_devices.h"

namespace understudy::emulator::world {
namespace documented_expressions_test {

struct Row {
  std::string written;
  std::string meaning;
};

// The rows below "| expression | result |", and so on.
std::vector<Row> table_under(const std::string& heading) {
  std::ifstream page(std::string(PROJECT_FOLDER) + "/docs/expressions.md");
  std::string line;
  while (std::getline(page, line) && line != heading) {
  }
  std::getline(page, line);  // |---|---|
  std::vector<Row> rows;
  while (std::getline(page, line) && line.starts_with("| ")) {
    const std::size_t middle = line.rfind(" | ");
    rows.push_back({line.substr(2, middle - 2), line.substr(middle + 3, line.size() - 2 - middle - 3)});
  }
  return rows;
}

// "`on`, `3s`": on and 3s.
std::vector<std::string> code_in(const std::string& text) {
  std::vector<std::string> codes;
  for (std::size_t begin = text.find('`'); begin != std::string::npos;) {
    const std::size_t end = text.find('`', begin + 1);
    codes.push_back(text.substr(begin + 1, end - begin - 1));
    begin = text.find('`', end + 1);
  }
  return codes;
}

TEST(DocumentedExpressions, GiveTheResultsOnThePage) {
  const BenchOfNames bench = a_feeder();
  const std::vector<Row> rows = table_under("| expression | result |");
  ASSERT_EQ(rows.size(), 15U);
  for (const Row& row : rows) {
    const std::string result = outcome(code_in(row.written).at(0), bench);
    if (row.meaning.starts_with("error: ")) {
      EXPECT_TRUE(result.starts_with("refused: ") || result.starts_with("no result: ")) << row.written;
      EXPECT_NE(result.find(row.meaning.substr(7)), std::string::npos) << row.written << ": " << result;
    } else {
      EXPECT_EQ(result, row.meaning) << row.written;
    }
  }
}

TEST(DocumentedExpressions, EveryLiteralAndNameOnThePageIsAccepted) {
  const BenchOfNames bench = a_feeder();
  std::size_t taken = 0;
  for (const char* heading : {"| literal | is |", "| name | is |"}) {
    for (const Row& row : table_under(heading)) {
      for (const std::string& code : code_in(row.written)) {
        EXPECT_NO_THROW(parse_expression(code, bench)) << code;
        ++taken;
      }
    }
  }
  EXPECT_EQ(taken, 19U + 10U);
}

/// A Simple2-R3's axis with all the switches that it can have; the others belong to a larger controller.
TEST(DocumentedExpressions, EveryNameOfAWorldIsKnown) {
  const World world = make_world();
  const Probes probes(world);
  std::size_t taken = 0;
  for (const Row& row : table_under("| name in a world | is |")) {
    for (const std::string& code : code_in(row.written)) {
      if (code.starts_with("mill.")) continue;
      EXPECT_NO_THROW(probes.resolve(code)) << code;
      ++taken;
    }
  }
  EXPECT_EQ(taken, 25U);
}

TEST(DocumentedExpressions, EveryToleranceOnThePageIsAccepted) {
  const std::vector<Row> rows = table_under("| written | holds for |");
  ASSERT_EQ(rows.size(), 5U);
  for (const Row& row : rows) {
    for (const std::string& code : code_in(row.written)) {
      const Unit unit = code.find('s') == std::string::npos ? Unit::none : Unit::nanoseconds;
      EXPECT_NO_THROW(parse_tolerance(code, unit)) << code;
    }
  }
}

}  // namespace documented_expressions_test
}  // namespace understudy::emulator::world
