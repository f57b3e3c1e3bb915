// Texts that are not expressions, and their messages: one line, the column, what was expected.
#include <gtest/gtest.h>

#include "tests/emulator/world/expression/bench_of_names.h"

namespace understudy::emulator::world {
namespace refusals_test {

struct Refusal {
  std::string text;
  std::size_t column;
  std::string_view reason;
};

void expect_refusals(const std::vector<Refusal>& cases) {
  const BenchOfNames bench = a_feeder();
  for (const Refusal& c : cases) {
    try {
      parse_expression(c.text, bench);
      ADD_FAILURE() << c.text << " was taken";
    } catch (const ExpressionError& error) {
      const std::string line = error.what();
      EXPECT_EQ(error.column, c.column) << line;
      EXPECT_EQ(line.find("column " + std::to_string(c.column) + " of '"), 0U) << line;
      const std::size_t reason = line.rfind(c.reason);
      EXPECT_TRUE(reason != std::string::npos && reason + c.reason.size() == line.size())
          << line << "\n  was expected to end in: " << c.reason;
    }
  }
}

TEST(ExpressionRefusals, AnUnknownNameComesWithTheNearestKnownOne) {
  expect_refusals({
      {"feeder.STATSU == 0", 1, "'feeder.STATSU' is not known; the nearest is 'feeder.STATUS'"},
      {"1 + fedeer.Cord_A", 5, "'fedeer.Cord_A' is not known; the nearest is 'feeder.Cord_A'"},
      {"feeder['Logic Position Y'] > 0", 1,
       "'feeder.Logic Position Y' is not known; the nearest is 'feeder.Logic Position X'"},
      {"tme > 3s", 1, "'tme' is not known; the nearest is 'time'"},
      {"mim(1, 2)", 1, "no function is called 'mim'; the nearest is 'min'"},
      {"feeder.A(1)", 1, "no function is called 'feeder.A'; expected one of abs, max, min"},
  });
}

TEST(ExpressionRefusals, AnUnexpectedBeginningOrEndIsRefused) {
  expect_refusals({
      {"", 1, "unexpected end; expected a name, a number or '('"},
      {"  ", 3, "unexpected end; expected a name, a number or '('"},
      {"feeder.STATUS ==", 17, "unexpected end; expected a name, a number or '('"},
      {"== 3", 1, "unexpected '=='; expected a name, a number or '('"},
      {"(1 + 2", 7, "unexpected end; expected ')'"},
      {"1 + 2)", 6, "unexpected ')'; expected an operator or the end"},
      {"a b", 3, "unexpected 'b'; expected an operator or the end"},
      {"1 2", 3, "unexpected '2'; expected an operator or the end"},
      {"a ? 1", 6, "unexpected end; expected ':'"},
      {"a : 1", 3, "unexpected ':'; expected an operator or the end"},
      {"min(1)", 6, "unexpected ')'; expected ',' and another value"},
      {"min()", 5, "unexpected ')'; expected a name, a number or '('"},
      {"abs(1, 2)", 6, "unexpected ','; expected ')'"},
      {"1 + + 2", 5, "unexpected '+'; expected a name, a number or '('"},
      {"1,5", 2, "unexpected ','; expected an operator or the end"},
      {"a = 5", 3, "'=' is not an operator; expected '==' to compare"},
      {"a <> 5", 3, "'<>' is not an operator; expected '!='"},
      {"a; b", 2, "unexpected ';'; expected an operator or the end"},
      {"a $ b", 3, "'$' cannot be part of an expression"},
      {"a == ${n}", 6, "'$' cannot be part of an expression"},
      {"a ≤ 5", 3, "'≤' cannot be part of an expression"},
      {"feeder['≤'] $", 13, "'$' cannot be part of an expression"},  // columns count characters, not bytes
      {"1 ≥ 2", 3, "'≥' cannot be part of an expression"},
      {"a\n== $", 6, "'$' cannot be part of an expression"},
  });
}

TEST(ExpressionRefusals, InvalidNumbersAndNamesAreRefused) {
  expect_refusals({
      {"a > 5m", 5,
       "'5m' is not a number; expected digits, and optionally a unit: ns, us, ms, s, min, h, mV or V"},
      {"12abc", 1,
       "'12abc' is not a number; expected digits, and optionally a unit: ns, us, ms, s, min, h, mV or V"},
      {"0xG", 1, "'0xG' is not a whole number of 64 bits"},
      {"0x", 1, "'0x' is not a whole number of 64 bits"},
      {"0b", 1, "'0b' is not a whole number of 64 bits"},
      {"0b12", 1, "'0b12' is not a whole number of 64 bits"},
      {"9223372036854775808", 1, "'9223372036854775808' is not a whole number of 64 bits"},
      {"0x8000000000000000", 1, "'0x8000000000000000' is not a whole number of 64 bits"},
      {"1__0", 2, "'_' in a number; expected it between two digits only"},
      {"1_", 2, "'_' in a number; expected it between two digits only"},
      {"1_.5", 2, "'_' in a number; expected it between two digits only"},
      {"1e999", 1, "'1e999' is too large for a real number"},
      {"1e-999", 1, "'1e-999' is too large for a real number"},
      {"1e3s", 1, "'1e3s' has an exponent and a unit; expected one of them"},
      {"0.5ns", 1, "'0.5ns' is finer than a nanosecond or longer than a century"},
      {"9999999h", 1, "'9999999h' is finer than a nanosecond or longer than a century"},
      {"0.5mV", 1, "'0.5mV' is finer than a millivolt or more than a million volts"},
      {"2.5001V", 1, "'2.5001V' is finer than a millivolt or more than a million volts"},
      {"1000000V", 1, "'1000000V' is finer than a millivolt or more than a million volts"},
      {".5", 1, "unexpected '.'; expected a name, a number or '('"},
      {"5.", 2, "unexpected '.'; expected an operator or the end"},
      {"1.5.5", 4, "unexpected '.'; expected an operator or the end"},
      {"feeder.", 7, "expected a name or a bit number after '.'"},
      {"feeder. STATUS", 7, "expected a name or a bit number after '.'"},
      {"feeder[5]", 7, "'[' without a name; expected a quoted one, [\"Like This\"]"},
      {"feeder[\"X", 8, "the quoted name is not closed"},
      {"feeder[\"\"]", 8, "an empty name"},
      {"feeder[\"X\"", 11, "expected ']' after the quoted name"},
  });
}

TEST(ExpressionRefusals, PitfallsOfCNeedParentheses) {
  expect_refusals({
      {"a & 4 == 4", 3,
       "'&' next to a comparison needs parentheses, because the comparison comes first: (a & b) == c"},
      {"a == 4 & 4", 8,
       "'&' next to a comparison needs parentheses, because the comparison comes first: (a & b) == c"},
      {"a | b != 0", 3,
       "'|' next to a comparison needs parentheses, because the comparison comes first: (a | b) == c"},
      {"a ^ b < 0", 3,
       "'^' next to a comparison needs parentheses, because the comparison comes first: (a ^ b) == c"},
      {"0 < a < 10", 7, "comparisons do not chain; write a < b && b < c"},
      {"a == b == c", 8, "comparisons do not chain; write a == b && b == c"},
      {"a < b == true", 7, "comparisons do not chain; write a == b && b == c"},
      {"not a == b", 7, "'!' next to '==' needs parentheses: !(a == b), or (!a) == b"},
      {"!a < b", 4, "'!' next to '<' needs parentheses: !(a < b), or (!a) < b"},
      {"a == !b", 3, "'!' next to '==' needs parentheses: !(a == b), or (!a) == b"},
  });
}

TEST(ExpressionRefusals, UnitsThatDoNotFitAreRefused) {
  expect_refusals({
      {"time > 3", 6, "'>' between a duration and a number; a duration is written like 250ms"},
      {"feeder.Cord_A == 3s", 15, "'==' between a number and a duration; a duration is written like 250ms"},
      {"feeder.Cord_A == 0s", 15, "'==' between a number and a duration; a duration is written like 250ms"},
      {"feeder.AIN_1 > 2", 14, "'>' between a voltage and a number; a voltage is written like 2.5V"},
      {"feeder.AIN_1 > 2s", 14, "'>' between a voltage and a duration; a voltage is written like 2.5V"},
      {"time + 5 > 3s", 6, "'+' between a duration and a number; a duration is written like 250ms"},
      {"time == 3s +- 5", 12, "'+-' between a duration and a number; a duration is written like 250ms"},
      {"0 == time +- 5", 11, "'+-' between a duration and a number; a duration is written like 250ms"},
      {"time * 3s > 0", 6, "'*' between a duration and a duration; expected one number without a unit"},
      {"1 / 3s", 3, "'/' between a number and a duration; a duration is written like 250ms"},
      {"time % 7 == 0", 6, "'%' between a duration and a number; a duration is written like 250ms"},
      {"time & 1", 6, "'&' requires numbers without a unit, not a duration"},
      {"1 << 3s", 3, "'<<' requires numbers without a unit, not a duration"},
      {"~time", 1, "'~' requires numbers without a unit, not a duration"},
      {"min(time, 5)", 9, "',' between a duration and a number; a duration is written like 250ms"},
      {"a ? 3s : 5", 8, "':' between a duration and a number; a duration is written like 250ms"},
      {"(a ? 3s : 0) == 5", 14, "'==' between a duration and a number; a duration is written like 250ms"},
  });
}

TEST(ExpressionRefusals, BitOperatorsOnRealNumbersAreRefused) {
  expect_refusals({
      {"a & 1.5", 3, "'&' requires whole numbers"},
      {"1.5 << 2", 5, "'<<' requires whole numbers"},
      {"(a + 1.5) | 1", 11, "'|' requires whole numbers"},
      {"(a ? 1.5 : 2.5) & 1", 17, "'&' requires whole numbers"},
      {"min(1.5, 2.5) | 1", 15, "'|' requires whole numbers"},
      {"7 % 2.0", 3, "'%' requires whole numbers"},
      {"~1.5", 1, "'~' requires whole numbers"},
      {"(time * 0.5) % 1s", 14, "'%' requires whole numbers"},
  });
}

TEST(ExpressionRefusals, MisplacedTolerancesAreRefused) {
  constexpr std::string_view place =
      "'+-' is not allowed here; expected it once, after '==' or '!=' and a value, as in x == 3050 +- 2";
  expect_refusals({
      {"a <= 5 +- 2", 8, place},
      {"a +- 2", 3, place},
      {"5+-2", 2, place},  // not 5 + -2: the same text means the same after `==`
      {"a == 5 +- 2 +- 1", 13, place},
      {"a == (5 +- 2)", 9, place},
      {"a == 5 +- 1s%", 11, "'%' after a duration; expected a number"},
      {"a == 5 +- 2000000%", 11, "expected a tolerance of at most a million percent"},
      {"a == 5 +- 5%3", 13, "unexpected '3'; expected an operator or the end"},
      {"a == 1..5", 7, "a range is not allowed here; expected low <= x && x <= high"},
      {"a..b", 2, "a range is not allowed here; expected low <= x && x <= high"},
  });
}

TEST(ExpressionRefusals, ShowThePlaceInALongText) {
  const BenchOfNames bench = a_feeder();
  const std::string text =
      "feeder.STATUS.4 == 0 && feeder.Cord_A == 32000 &&\n  feeder.DOUT_4 && feeder.STATSU == 0 && " +
      std::string(60, '-') + "1 == 1";
  EXPECT_EQ(outcome(text, bench),
            "refused: column 70 of '...r.Cord_A == 32000 &&   feeder.DOUT_4 && feeder.STATSU == 0 && "
            "---------------...': 'feeder.STATSU' is not known; the nearest is 'feeder.STATUS'");
}

TEST(ExpressionRefusals, WhatIsTooLongOrTooDeepIsRefused) {
  const BenchOfNames bench = a_feeder();
  const auto repeated = [](const std::string& text, int times) {
    std::string result;
    for (int i = 0; i < times; ++i) result += text;
    return result;
  };
  // A level counts as a whole.
  EXPECT_EQ(outcome(repeated("(", 63) + "1" + repeated(")", 63), bench), "1");
  EXPECT_NE(outcome(repeated("(", 64) + "1" + repeated(")", 64), bench).find("nested too deeply"),
            std::string::npos);
  EXPECT_EQ(outcome(repeated("-", 62) + "1", bench), "1");
  EXPECT_NE(outcome(repeated("-", 64) + "1", bench).find("nested too deeply"), std::string::npos);
  EXPECT_EQ(outcome(repeated("0 ? 1 : ", 63) + "7", bench), "7");
  EXPECT_NE(outcome(repeated("0 ? 1 : ", 64) + "7", bench).find("nested too deeply"), std::string::npos);
  // Three values wait at each level: 63 at the 21st.
  EXPECT_EQ(outcome(repeated("1 + 1 * (0 == ", 20) + "1" + repeated(")", 20), bench), "1");
  EXPECT_NE(
      outcome(repeated("1 + 1 * (0 == ", 22) + "1" + repeated(")", 22), bench).find("nested too deeply"),
      std::string::npos);
  // Length alone needs no depth.
  EXPECT_EQ(outcome("1" + repeated("+1", 999), bench), "1000");
  EXPECT_EQ(outcome("0" + repeated("||0", 666), bench), "0");
  EXPECT_EQ(outcome("0" + repeated("+(0?1:2)", 200), bench), "400");
  EXPECT_EQ(outcome("0" + repeated("- -1", 300), bench), "300");
  EXPECT_EQ(outcome("0" + repeated("+abs(-1)", 200), bench), "200");
  EXPECT_EQ(outcome("0" + repeated("+(1==1+-0)", 180), bench), "180");
  EXPECT_EQ(outcome("0" + repeated("+(1==1+-0%)", 160), bench), "160");
  EXPECT_EQ(outcome("1" + repeated("+1", 1000), bench).find("refused: column 1 of '1+1+1"), 0U);
  EXPECT_NE(outcome("1" + repeated("+1", 1000), bench).find("too long (2001 bytes); expected at most 2000"),
            std::string::npos);
}

}  // namespace refusals_test
}  // namespace understudy::emulator::world
