// Values with tolerances and ranges: both ends are within.
#include "emulator/world/expression/tolerance.h"

#include <gtest/gtest.h>

namespace understudy::emulator::world {
namespace tolerance_test {

struct Case {
  std::string_view text;
  Unit unit;
  std::vector<Number> within;
  std::vector<Number> without;
};

constexpr std::int64_t kMs = 1'000'000;  // in nanoseconds

TEST(Tolerance, HoldsUpToBothEnds) {
  const std::vector<Case> cases = {
      {"32000", Unit::none, {32000, 32000.0}, {31999, 32001, 32000.5}},
      {"0xC001", Unit::none, {49153}, {49152}},
      {"0b101", Unit::none, {5}, {4}},
      {"on", Unit::none, {1}, {0, 2}},
      {"off", Unit::none, {0}, {1}},
      {"false", Unit::none, {0}, {1}},
      {"-5", Unit::none, {-5}, {5, -4}},
      {"3 * 3200 + 1", Unit::none, {9601}, {9600}},
      {"0x10 | 0x02", Unit::none, {18}, {16}},
      {"3 > 2 ? 7 : 8", Unit::none, {7}, {8}},
      {"3050ms +- 2ms", Unit::nanoseconds, {3048 * kMs, 3052 * kMs}, {3048 * kMs - 1, 3052 * kMs + 1}},
      {"3.05s +- 0.1%", Unit::nanoseconds, {3'046'950'000, 3'053'050'000}, {3'046'949'999, 3'053'050'001}},
      {"250 ms", Unit::nanoseconds, {250 * kMs}, {250 * kMs + 1}},
      {"0 +- 2ms", Unit::nanoseconds, {-2 * kMs, 2 * kMs}, {2 * kMs + 1}},
      {"32000 +- 1%", Unit::none, {31680, 32320}, {31679, 32321}},
      {"-32000 +- 1%", Unit::none, {-31680, -32320}, {-31679, -32321}},
      {"150 +- 1%", Unit::none, {149, 151, 151.5, 148.5}, {148, 152, 151.75}},
      {"10000 +- 0.57%", Unit::none, {9943, 10057}, {9942, 10058}},
      {"100 +- 0%", Unit::none, {100}, {99, 101}},
      {"100 +- 200%", Unit::none, {-100, 300}, {-101, 301}},
      {"10 * 10 +- 10 / 2", Unit::none, {95, 105}, {94, 106}},
      {"7 +- 5 % 3", Unit::none, {5, 9}, {4, 10}},  // a space before it: a remainder, 2
      {"100..200", Unit::none, {100, 150, 200}, {99, 201, 99.5}},
      {"100 .. 200", Unit::none, {100, 200}, {99, 201}},
      {"-20..-10", Unit::none, {-20, -10}, {-21, -9}},
      {"5..5", Unit::none, {5}, {4, 6}},
      {"1.5..2.5", Unit::none, {2, 1.5, 2.5}, {1, 3}},
      {"0x10..0x1F", Unit::none, {16, 31}, {15, 32}},
      {"100..", Unit::none, {100, INT64_MAX}, {99, INT64_MIN}},
      {"..200", Unit::none, {200, INT64_MIN}, {201}},
      {"..4s", Unit::nanoseconds, {0, 4000 * kMs}, {4000 * kMs + 1}},
      {"3s..4s", Unit::nanoseconds, {3000 * kMs, 4000 * kMs}, {2999 * kMs}},
      {"0..4s", Unit::nanoseconds, {0, 4000 * kMs}, {-1}},
      {"2.5V +- 100mV", Unit::millivolts, {2400, 2600}, {2399, 2601}},
      {"0", Unit::millivolts, {0}, {1}},
      {"1500.5 +- 0.5", Unit::none, {1500, 1501, 1500.25}, {1499, 1502, 1501.25}},
      {"9223372036854775807 +- 5", Unit::none, {INT64_MAX, INT64_MAX - 5}, {INT64_MAX - 6}},
  };
  for (const Case& c : cases) {
    const Tolerance tolerance = parse_tolerance(c.text, c.unit);
    EXPECT_EQ(tolerance.text, c.text);
    for (const Number value : c.within)
      EXPECT_TRUE(tolerance.holds(value)) << c.text << ": " << number_text(value);
    for (const Number value : c.without) {
      EXPECT_FALSE(tolerance.holds(value)) << c.text << ": " << number_text(value);
    }
  }
}

TEST(Tolerance, TextIsAsWrittenOnOneLine) {
  EXPECT_EQ(parse_tolerance("  3050ms +- 2ms\n", Unit::nanoseconds).text, "3050ms +- 2ms");
  EXPECT_EQ(parse_tolerance("3050ms\n+- 2ms", Unit::nanoseconds).text, "3050ms +- 2ms");
}

TEST(Tolerance, RefusesInOneLine) {
  struct {
    std::string_view text;
    Unit unit;
    std::string_view line;
  } const cases[] = {
      {"", Unit::none, "column 1 of '': unexpected end; expected a name, a number or '('"},
      {"..", Unit::none, "column 3 of '..': unexpected end; expected a name, a number or '('"},
      {"3050", Unit::nanoseconds,
       "column 1 of '3050': a number where a duration is expected, such as 3050ms"},
      {"3050ms +- 2", Unit::nanoseconds,
       "column 11 of '3050ms +- 2': a number where a duration is expected, such as 3050ms"},
      {"3s", Unit::none, "column 1 of '3s': a duration where a number is expected, without a unit"},
      {"3s", Unit::millivolts, "column 1 of '3s': a duration where a voltage is expected, such as 2.5V"},
      {"5 +- -2", Unit::none, "column 3 of '5 +- -2': a tolerance below zero (-2)"},
      {"200..100", Unit::none, "column 1 of '200..100': the range ends before it begins"},
      {"1..2..3", Unit::none,
       "column 5 of '1..2..3': a range is not allowed here; expected low <= x && x <= high"},
      {"5 +- 2 +- 1", Unit::none,
       "column 8 of '5 +- 2 +- 1': '+-' is not allowed here; expected it once, after '==' or '!=' and a "
       "value, "
       "as in "
       "x == 3050 +- 2"},
      {"feeder.Cord_A", Unit::none,
       "column 1 of 'feeder.Cord_A': a name, 'feeder.Cord_A', where a value, a tolerance or a range is "
       "expected"},
      {"5 / 0", Unit::none, "column 3 of '5 / 0': division by zero"},
      {"5 +- 1 / 0", Unit::none, "column 8 of '5 +- 1 / 0': division by zero"},
      {"5 +- 1% 2", Unit::none, "column 9 of '5 +- 1% 2': unexpected '2'; expected an operator or the end"},
      {"5 +- 1ms%", Unit::none, "column 6 of '5 +- 1ms%': '%' after a duration; expected a number"},
      {"five", Unit::none,
       "column 1 of 'five': a name, 'five', where a value, a tolerance or a range is expected"},
  };
  for (const auto& c : cases) {
    try {
      parse_tolerance(c.text, c.unit);
      ADD_FAILURE() << c.text << " was taken";
    } catch (const ExpressionError& error) {
      EXPECT_EQ(error.what(), c.line);
    }
  }
}

}  // namespace tolerance_test
}  // namespace understudy::emulator::world
