// The names of parameters compared with the manual's table.
#include "interpreter/simple2/parameter_names.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/interpreter/facts.h"

namespace understudy::interpreter::simple2 {
namespace parameter_names_test {

bool is_defined(int number) { return number <= 158 || (number >= 167 && number <= 182); }

TEST(Simple2ParameterNames, AreThereForWhatTheManualDefines) {
  std::set<std::string> names;
  for (int number = 0; number < 256; ++number) {
    const auto name = parameter_name(static_cast<std::uint8_t>(number));
    EXPECT_EQ(name.has_value(), is_defined(number)) << number;
    if (!name) continue;
    EXPECT_TRUE(names.insert(*name).second) << *name;
    EXPECT_EQ(parameter_number(*name), number) << *name;
  }
}

TEST(Simple2ParameterNames, TakeThoseOfTheManualInEitherCase) {
  for (const Fact& fact : read_facts(std::string(TEST_FACTS) + "/simple2/parameter_names.csv")) {
    const int number = std::stoi(fact.at("number"));
    std::string name = fact.at("name");
    EXPECT_EQ(parameter_number(name), number) << name;
    EXPECT_EQ(parameter_number("DAT" + fact.at("number")), number);
    for (char& c : name) c = static_cast<char>(std::toupper(c));
    EXPECT_EQ(parameter_number(name), number) << name;
  }
}

TEST(Simple2ParameterNames, CarryTheNumberOfTheParameter) {
  EXPECT_EQ(parameter_name(0), "MEM0");
  EXPECT_EQ(parameter_name(31), "MEM31");
  EXPECT_EQ(parameter_name(32), "VAR32");
  EXPECT_EQ(parameter_name(63), "VAR63");
  EXPECT_EQ(parameter_name(64), "DAT64");
  EXPECT_EQ(parameter_name(143), "DAT143");
  EXPECT_EQ(parameter_name(154), "Cord_A");
  EXPECT_EQ(parameter_name(182), "Baxis_SyncRPM");
}

TEST(Simple2ParameterNames, RefuseNumbersThatBelongToAnotherName) {
  for (const char* name : {"MEM32", "VAR0", "VAR31", "VAR64", "DAT63", "DAT159", "DAT166", "DAT183", "MEM",
                           "MEM-1", "MEM1x", "MEM256", "MEM4294967296", "Cord_C", "", "7"}) {
    EXPECT_EQ(parameter_number(name), std::nullopt) << name;
  }
}

}  // namespace parameter_names_test
}  // namespace understudy::interpreter::simple2
