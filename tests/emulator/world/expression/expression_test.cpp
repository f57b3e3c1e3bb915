// The values of expressions. Names have the values of a_feeder(); the calculation follows each case.
#include "emulator/world/expression/expression.h"

#include <gtest/gtest.h>

#include "tests/emulator/world/expression/bench_of_names.h"

namespace understudy::emulator::world {
namespace expression_test {

struct Case {
  std::string_view text;
  std::string_view result;
};

void expect_outcomes(const std::vector<Case>& cases) {
  const BenchOfNames bench = a_feeder();
  for (const Case& c : cases) EXPECT_EQ(outcome(c.text, bench), c.result) << c.text;
}

TEST(Expression, LiteralsHaveTheirValues) {
  expect_outcomes({
      {"0", "0"},
      {"42", "42"},
      {"007", "7"},  // decimal, unlike C
      {"1_000_000", "1000000"},
      {"0xC001", "49153"},
      {"0xff_FF", "65535"},
      {"0b1010", "10"},
      {"0b1111_0000", "240"},
      {"9223372036854775807", "9223372036854775807"},
      {"0x7FFFFFFFFFFFFFFF", "9223372036854775807"},
      {"true", "1"},
      {"false", "0"},
      {"on", "1"},
      {"off", "0"},
      {"1.5", "1.5"},
      {"1.5e3", "1500"},
      {"2e3", "2000"},
      {"25E-1", "2.5"},
      {"1_000.5", "1000.5"},
  });
}

TEST(Expression, DurationsAreNanosecondsAndVoltagesMillivolts) {
  expect_outcomes({
      {"250ms / 1ns", "250000000"}, {"3s / 1ns", "3000000000"},    {"750us / 1ns", "750000"},
      {"2min / 1s", "120"},         {"1h / 1min", "60"},           {"1.5s / 1ms", "1500"},
      {"0.75ms == 750us", "1"},     {"250 ms == 250ms", "1"},      {"1_000ms == 1s", "1"},
      {"2.5V / 1mV", "2500"},       {"300mV == 0.3V", "1"},        {"10 V / 1mV", "10000"},
      {"12.34V / 1mV", "12340"},    {"2.500V == 2500mV", "1"},     {"7.0mV / 1mV", "7"},
      {"-300mV < 0", "1"},          {"(3s + 50ms) / 1ms", "3050"}, {"3 * 50ms == 150ms", "1"},
      {"50ms * 3 == 150ms", "1"},   {"1s / 4 == 250ms", "1"},      {"3050ms % 1s == 50ms", "1"},
      {"min(3s, 2min) / 1s", "3"},  {"abs(-3s) == 3s", "1"},       {"(b ? 1s : 2s) == 2s", "1"},
      {"0 + 3s == 3s", "1"},        {"max(0, 3s) == 3s", "1"},     {"1.5 * 1s == 1500ms", "1"},
  });
}

TEST(Expression, NamesHaveTheirValues) {
  expect_outcomes({
      {"feeder.Cord_A", "32000"},
      {"feeder.STATUS.4", "1"},
      {"feeder.A.pulses > 12000", "1"},
      {"feeder.A.speed <= 1.5e3", "0"},  // 1500.25
      {"feeder.A.speed <= 1500.25", "1"},
      {"feeder[\"Logic Position X\"] == -400", "1"},
      {"feeder['Logic Position X'] == -400",
       "1"},  // quotes of either kind, because the surrounding file has its own
      {"[\"mill-2\"].D8097", "3"},
      {"[\"feeder\"][\"STATUS\"].4", "1"},
      {"time >= 3.05s", "1"},
      {"time > 3.05s", "0"},
      {"time == 3050ms", "1"},
      {"feeder.AIN_1 == 2.5V", "1"},
      {"feeder.STATUS.4 == 0 || feeder.DOUT_4", "1"},
      {"a\n  and\tnot b", "1"},  // a folded line of a file
  });
}

TEST(Expression, OperatorsBindAsInC) {
  expect_outcomes({
      {"2 + 3 * 4", "14"},
      {"(2 + 3) * 4", "20"},
      {"20 - 5 - 3", "12"},   // (20 - 5) - 3
      {"100 / 5 / 2", "10"},  // (100 / 5) / 2
      {"-7 / 2", "-3"},       // towards zero
      {"-7 % 2", "-1"},       // -7 - 2 * -3
      {"7 % -2", "1"},
      {"1 << 2 + 1", "8"},  // 1 << 3
      {"-8 >> 1", "-4"},
      {"-1 >> 63", "-1"},
      {"1 << 62", "4611686018427387904"},
      {"-1 << 63", "-9223372036854775808"},
      {"1 | 6 ^ 2 & 3", "5"},  // 2 & 3 = 2, 6 ^ 2 = 4, 1 | 4 = 5
      {"~0", "-1"},
      {"~0x0F & 0xFF", "240"},
      {"- - 5", "5"},
      {"!a", "0"},
      {"!!a", "1"},
      {"!b && a", "1"},      // (!b) && a
      {"1 || 0 && 0", "1"},  // 1 || (0 && 0)
      {"a && 3", "1"},       // true is 1, not 3
      {"0 || 7", "1"},
      {"1 < 2 && 2 < 3", "1"},
      {"b ? 1 : 2", "2"},
      {"a ? b ? 1 : 2 : 3", "2"},
      {"b ? 1 : a ? 2 : 3", "2"},
      {"a == 5 ? 10 : 20", "10"},
      {"a or b and b", "1"},
      {"not b", "1"},
      {"not (a == b)", "1"},
      {"min(3, 1, 2)", "1"},
      {"max(3, 1.5, 7)", "7"},
      {"min(1, 1.5)", "1"},
      {"abs(c)", "7"},
      {"abs(-1.5)", "1.5"},
      {"min(a, b) + max(a, b)", "5"},
      {"(feeder.STATUS & 0x10) != 0", "1"},
      {"((((((((1))))))))", "1"},
  });
}

TEST(Expression, ARealOperandMakesTheResultReal) {
  expect_outcomes({
      {"7 / 2", "3"},
      {"7 / 2.0", "3.5"},
      {"7.0 / 2", "3.5"},
      {"1.5 + 1", "2.5"},
      {"2 * 0.25", "0.5"},
      {"1 - 0.5", "0.5"},
      {"-(0.5)", "-0.5"},
      {"4.0 == 4", "1"},
      {"0.5 && 1", "1"},
      {"!0.0", "1"},
      {"(b ? 1.5 : 2) | 1", "3"},  // refused only if the real one is chosen
      {"min(1.5, 1) << 2", "4"},
      {"1e300 * 1e300 > 0 || 1", "no result: column 7 of '1e300 * 1e300 > 0 || 1': the result is too large"},
  });
}

TEST(Expression, WholeAndRealNumbersAreComparedExactly) {
  expect_outcomes({
      // 2^53 + 1 is not a real number: a comparison of real numbers would take it for 2^53.
      {"9007199254740993 == 9007199254740992.0", "0"},
      {"9007199254740993 > 9007199254740992.0", "1"},
      {"largest == 9223372036854775807.0", "0"},  // the literal is 2^63
      {"largest < 9223372036854775807.0", "1"},
      {"smallest == -9223372036854775808.0", "1"},
      {"-3 > -3.5", "1"},
      {"-3 < -2.5", "1"},
  });
}

TEST(Expression, TolerancesIncludeBothEnds) {
  expect_outcomes({
      {"3050 == 3050 +- 2", "1"},
      {"3048 == 3050 +- 2", "1"},
      {"3052 == 3050 +- 2", "1"},
      {"3047 == 3050 +- 2", "0"},
      {"3053 == 3050 +- 2", "0"},
      {"3053 != 3050 +- 2", "1"},
      {"3052 != 3050 +- 2", "0"},
      {"-3 == 0 +- 3", "1"},
      {"time == 3s +- 50ms", "1"},
      {"time == 3s +- 49.999999ms", "0"},
      {"32320 == 32000 +- 1%", "1"},  // 1% is 320
      {"32321 == 32000 +- 1%", "0"},
      {"-32320 == -32000 +- 1%", "1"},
      {"10057 == 10000 +- 0.57%", "1"},  // 57; 10000 * 0.57 as real numbers is a little less than 5700
      {"10058 == 10000 +- 0.57%", "0"},
      {"151 == 150 +- 1%", "1"},  // 1.5
      {"152 == 150 +- 1%", "0"},
      {"time == 3s +- 2%", "1"},  // 60 ms
      {"feeder.A.speed == 1500 +- 0.25", "1"},
      {"feeder.A.speed == 1500 +- 0.2", "0"},
      {"1.6 == 1.5 +- 0.1", "1"},
      {"7 == 5 + 1 +- 3 % 2", "1"},  // with a space it is a remainder: 6 +- 1
      {"a == 5 +- 2 && b == 0 +- 1", "1"},
      {"largest == 9223372036854775806 +- 2", "1"},  // the upper end exceeds 64 bits
      {"smallest == -9223372036854775807 +- 9", "1"},
      {"a == 5 +- b", "1"},
      {"a == 5 +- c", "no result: column 8 of 'a == 5 +- c': a tolerance below zero (-7)  (a is 5, c is -7)"},
  });
}

TEST(Expression, WithoutAResultItSaysWhyAndWithWhichValues) {
  expect_outcomes({
      {"a / b", "no result: column 3 of 'a / b': division by zero  (a is 5, b is 0)"},
      {"1 + 7 % b", "no result: column 7 of '1 + 7 % b': division by zero  (b is 0)"},
      {"1.0 / b", "no result: column 5 of '1.0 / b': division by zero  (b is 0)"},
      {"largest + 1",
       "no result: column 9 of 'largest + 1': the result does not fit into 64 bits  (largest is "
       "9223372036854775807)"},
      {"smallest - 1",
       "no result: column 10 of 'smallest - 1': the result does not fit into 64 bits  (smallest is "
       "-9223372036854775808)"},
      {"-smallest",
       "no result: column 1 of '-smallest': the result does not fit into 64 bits  (smallest is "
       "-9223372036854775808)"},
      {"abs(smallest)",
       "no result: column 1 of 'abs(smallest)': the result does not fit into 64 bits  (smallest is "
       "-9223372036854775808)"},
      {"smallest / -1",
       "no result: column 10 of 'smallest / -1': the result does not fit into 64 bits  (smallest is "
       "-9223372036854775808)"},
      {"smallest % -1", "0"},
      {"3037000500 * 3037000500",  // just above the root of 2^63
       "no result: column 12 of '3037000500 * 3037000500': the result does not fit into 64 bits"},
      {"1 << 63", "no result: column 3 of '1 << 63': the result does not fit into 64 bits"},
      {"1 << 64", "no result: column 3 of '1 << 64': a shift by 64 places; expected 0 to 63"},
      {"1 >> c", "no result: column 3 of '1 >> c': a shift by -7 places; expected 0 to 63  (c is -7)"},
      {"feeder.A.speed & 1",
       "no result: column 16 of 'feeder.A.speed & 1': bits, shifts and '%' require whole numbers  "
       "(feeder.A.speed is 1500.25)"},
      {"~feeder.A.speed",
       "no result: column 1 of '~feeder.A.speed': bits, shifts and '%' require whole numbers  "
       "(feeder.A.speed is 1500.25)"},
  });
}

TEST(Expression, WhatDecidesNothingIsNotEvaluated) {
  expect_outcomes({
      {"b != 0 && a / b > 1", "0"},
      {"b == 0 || a / b > 1", "1"},
      {"b ? a / b : -1", "-1"},
      {"a ? -1 : a / b", "-1"},
      {"b && (a / b || a / b)", "0"},
  });
  const BenchOfNames bench = a_feeder();
  evaluate(parse_expression("b && a || c", bench), bench);
  EXPECT_EQ(bench.reads_of("b"), 1);
  EXPECT_EQ(bench.reads_of("a"), 0);
  EXPECT_EQ(bench.reads_of("c"), 1);
}

TEST(Expression, FollowsTheValuesItWatches) {
  BenchOfNames bench = a_feeder();
  const Expression expression = parse_expression("feeder.STATUS.4 == 0 && time >= 4s", bench);
  EXPECT_FALSE(is_true(expression, bench));
  bench.set("feeder.STATUS.4", 0);
  EXPECT_FALSE(is_true(expression, bench));
  bench.set("time", 4'000'000'000);
  EXPECT_TRUE(is_true(expression, bench));
}

TEST(Expression, ListsEachHandleItDependsOnOnceAndInOrder) {
  const BenchOfNames bench = a_feeder();
  const Expression expression =
      parse_expression("time > 1s && (feeder.Cord_A == a || feeder['Cord_A'] < time / 1ms)", bench);
  EXPECT_EQ(names_in(expression),
            (std::vector<std::int32_t>{bench.handle_of("time"), bench.handle_of("feeder.Cord_A"),
                                       bench.handle_of("a")}));
  EXPECT_TRUE(names_in(parse_expression("1 + 1", bench)).empty());
}

TEST(Expression, IsExplainedWithTheCurrentValues) {
  const BenchOfNames bench = a_feeder();
  const std::vector<Case> cases = {
      {"feeder.STATUS.4 == 0", "feeder.STATUS.4 == 0  (feeder.STATUS.4 is 1)"},
      {"time < 3s && feeder.AIN_1 > 3V",
       "time < 3s && feeder.AIN_1 > 3V  (time is 3.05s, feeder.AIN_1 is 2.5V)"},
      {"feeder['Logic Position X'] == feeder.Cord_A",
       "feeder['Logic Position X'] == feeder.Cord_A  (feeder['Logic Position X'] is -400, feeder.Cord_A is "
       "32000)"},
      {"feeder.A.speed > 2e3", "feeder.A.speed > 2e3  (feeder.A.speed is 1500.25)"},
      {"a + a == a", "a + a == a  (a is 5)"},
      {"1 == 2", "1 == 2"},
      {"b == 1 &&\n a", "b == 1 &&  a  (b is 0, a is 5)"},
  };
  for (const Case& c : cases) {
    const Expression expression = parse_expression(c.text, bench);
    EXPECT_EQ(explain(expression, bench), c.result);
    EXPECT_EQ(explain(expression, bench).substr(0, to_text(expression).size()), to_text(expression));
  }
}

TEST(Expression, AValueThatIsNotANumberIsRefused) {
  BenchOfNames bench = a_feeder();
  for (const double nothing :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    bench.set("a", nothing);
    EXPECT_EQ(outcome("b + a", bench).substr(0, 65),
              "no result: column 5 of 'b + a': a is not a finite number  (b is 0");
  }
}

TEST(Expression, CanBeCopiedAndOutlivesItsText) {
  const BenchOfNames bench = a_feeder();
  Expression expression;
  EXPECT_EQ(evaluate(expression, bench), 0) << "one that was not parsed";
  {
    const std::string text = "a + 1";
    expression = parse_expression(text, bench);
  }
  const Expression copy = expression;
  expression = parse_expression("b", bench);
  EXPECT_EQ(evaluate(copy, bench), 6);
  EXPECT_EQ(to_text(copy), "a + 1");
  EXPECT_EQ(evaluate(expression, bench), 0);
}

}  // namespace expression_test
}  // namespace understudy::emulator::world
