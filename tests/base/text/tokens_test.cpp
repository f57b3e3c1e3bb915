#include "base/text/tokens.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace understudy {
namespace {

struct Case {
  const char* name;
  const char* text;
  Colon colon;
  std::vector<std::string> expected;  // "column text"
};

class Tokens : public testing::TestWithParam<Case> {};

TEST_P(Tokens, AreSplitAtBlanksAndCommas) {
  std::vector<std::string> found;
  for (const Token& token : tokens_of(GetParam().text, 7, GetParam().colon)) {
    EXPECT_EQ(token.line, 7);
    found.push_back(std::to_string(token.column) + " " + std::string(token.text));
  }
  EXPECT_EQ(found, GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    Lines, Tokens,
    testing::Values(Case{"nothing", "", Colon::is_a_letter, {}},
                    Case{"blanks", " \t\r,, ", Colon::is_a_letter, {}},
                    Case{"comment", "; LD X0", Colon::is_a_letter, {}},
                    Case{"words", "  LD\tX0,5 ; why", Colon::is_a_letter, {"3 LD", "6 X0", "9 5"}},
                    Case{"comment_at_once", "END;", Colon::is_a_letter, {"1 END"}},
                    Case{"colon_within", "a:b c:", Colon::is_a_letter, {"1 a:b", "5 c:"}},
                    Case{"colon_ends", "a:b c: :", Colon::ends_its_token, {"1 a:", "3 b", "5 c:", "8 :"}},
                    Case{"colon_later", "a b:", Colon::ends_its_token, {"1 a", "3 b:"}}),
    [](const auto& one) { return std::string(one.param.name); });

TEST(TokenCase, IsThatOfTheLettersAToZ) {
  EXPECT_EQ(upper_case("azAZ09_{`"), "AZAZ09_{`");
  EXPECT_TRUE(is_word("End", "eND"));
  EXPECT_FALSE(is_word("END", "ENDS"));
  EXPECT_FALSE(is_word("[", "{"));
}

}  // namespace
}  // namespace understudy
