// The command table compared with the facts from the manual (commands.csv).
#include "interpreter/slim/commands.h"

#include <gtest/gtest.h>

#include "tests/interpreter/facts.h"

namespace understudy::interpreter::slim {
namespace commands_test {

std::string_view mark(Printed printed) {
  switch (printed) {
    case Printed::no: return "n";
    case Printed::yes: return "y";
    case Printed::nothing: return "?";
  }
  return "";
}

TEST(SlimCommands, AreTheManualsInItsOrder) {
  const std::vector<Fact> facts = read_facts(TEST_FACTS "/slim/commands.csv");
  ASSERT_EQ(facts.size(), 169u);
  ASSERT_EQ(kCommands.size(), facts.size());
  for (std::size_t i = 0; i < facts.size(); ++i) {
    const Fact& fact = facts[i];
    const CommandRow& row = kCommands[i];
    EXPECT_EQ(row.command, fact.at("command")) << i;
    EXPECT_EQ(row.syntax, fact.at("syntax")) << i;
    EXPECT_EQ(row.meaning, fact.at("meaning")) << i;
    EXPECT_EQ(row.group, fact.at("group")) << i;
    EXPECT_EQ(mark(row.program), fact.at("program(y/n/?)")) << i;
    EXPECT_EQ(mark(row.immediate), fact.at("immediate(y/n/?)")) << i;
    EXPECT_EQ(mark(row.external), fact.at("external(y/n/?)")) << i;
  }
}

}  // namespace commands_test
}  // namespace understudy::interpreter::slim
