#include "emulator/world/expression/number.h"

#include <gtest/gtest.h>

namespace understudy::emulator::world {
namespace number_test {

TEST(Number, TextIsExactAndInItsUnit) {
  struct {
    Number number;
    Unit unit;
    std::string_view text;
  } const cases[] = {
      {0, Unit::none, "0"},
      {-5, Unit::none, "-5"},
      {INT64_MIN, Unit::none, "-9223372036854775808"},
      {1500.25, Unit::none, "1500.25"},
      {0.1, Unit::none, "0.1"},
      {1e300, Unit::none, "1e+300"},
      {3'050'000'000, Unit::nanoseconds, "3.05s"},
      {-250'000'000, Unit::nanoseconds, "-250ms"},
      {0, Unit::nanoseconds, "0s"},
      {INT64_MIN, Unit::nanoseconds, "-9223372036854775808ns"},
      {1.5, Unit::nanoseconds, "1.5ns"},
      {2500, Unit::millivolts, "2.5V"},
      {10000, Unit::millivolts, "10V"},
      {1001, Unit::millivolts, "1.001V"},
      {300, Unit::millivolts, "300mV"},
      {-999, Unit::millivolts, "-999mV"},
      {-1050, Unit::millivolts, "-1.05V"},
      {0, Unit::millivolts, "0V"},
      {INT64_MIN, Unit::millivolts, "-9223372036854775.808V"},
      {0.5, Unit::millivolts, "0.5mV"},
  };
  for (const auto& c : cases) EXPECT_EQ(number_text(c.number, c.unit), c.text);
}

TEST(Number, WholesAndRealsAreOrderedExactly) {
  // Strictly ascending; neighbours beyond 2^53 differ by less than real numbers can distinguish.
  const std::vector<Number> ascending = {-1e300,
                                         -9223372036854777856.0,  // the real number below -2^63
                                         INT64_MIN,
                                         INT64_MIN + 1,
                                         -9007199254740993,
                                         -9007199254740992.0,
                                         -2.5,
                                         -2,
                                         -1.5,
                                         -1,
                                         -0.5,
                                         0,
                                         5e-324,
                                         0.5,
                                         1,
                                         1.5,
                                         9007199254740992.0,
                                         9007199254740993,
                                         9223372036854774784.0,  // the real number below 2^63
                                         9223372036854774785,
                                         INT64_MAX,
                                         9223372036854775808.0,
                                         1e300};
  for (std::size_t i = 0; i < ascending.size(); ++i) {
    for (std::size_t j = 0; j < ascending.size(); ++j) {
      const Number a = ascending[i];
      const Number b = ascending[j];
      const std::string pair = number_text(a) + " and " + number_text(b);
      EXPECT_EQ(a < b, i < j) << pair;
      EXPECT_EQ(a > b, i > j) << pair;
      EXPECT_EQ(a == b, i == j) << pair;
      EXPECT_EQ(a <= b, i <= j) << pair;
    }
  }
  EXPECT_EQ(Number(INT64_MIN), Number(-9223372036854775808.0));
  EXPECT_EQ(Number(0), Number(-0.0));
  EXPECT_EQ(Number(7), Number(7.0));
}

TEST(Number, AShareIsWholeWhereItComesOutEven) {
  struct {
    Number number;
    double percent;
    Number share;
    bool whole;
  } const cases[] = {
      {32000, 1, 320, true},       {-32000, 1, 320, true}, {150, 1, 1.5, false},
      {10000, 0.57, 57, true},     {0, 50, 0, true},       {3'050'000'000, 0.1, 3'050'000, true},
      {1500.5, 10, 150.05, false}, {7, 100, 7, true},      {INT64_MIN, 100, 9223372036854775808.0, false}};
  for (const auto& c : cases) {
    const Number share = share_of(c.number, static_cast<std::int64_t>(c.percent * 1e6 + 0.5));
    EXPECT_EQ(share, c.share) << number_text(c.number) << " " << c.percent << "%";
    EXPECT_EQ(share.is_whole(), c.whole) << number_text(c.number) << " " << c.percent << "%";
  }
}

TEST(Number, BoundsBeyond64BitsExcludeNoWholeNumber) {
  struct {
    std::int64_t centre;
    std::int64_t tolerance;
  } const cases[] = {
      {INT64_MAX, 1},
      {INT64_MAX, INT64_MAX},
      {(std::int64_t{1} << 62) + 300, (std::int64_t{1} << 62) - 300},  // 2^63: rounds down twice
      {(std::int64_t{1} << 62) + 511, (std::int64_t{1} << 62) - 511}};
  for (const auto& c : cases) {
    const Bounds upper = bounds_around(c.centre, c.tolerance);
    EXPECT_GT(upper.high, INT64_MAX);
    EXPECT_EQ(upper.low, c.centre - c.tolerance);
    const Bounds lower = bounds_around(-c.centre, c.tolerance);
    EXPECT_LE(lower.low, -INT64_MAX);
    EXPECT_EQ(lower.high, -c.centre + c.tolerance);
  }
  EXPECT_THROW(bounds_around(5, -1), ArithmeticError);
  EXPECT_THROW(bounds_around(5, -0.5), ArithmeticError);
  EXPECT_THROW(bounds_around(1e308, 1e308), ArithmeticError);
}

}  // namespace number_test
}  // namespace understudy::emulator::world
