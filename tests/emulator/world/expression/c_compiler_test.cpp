// For the part of the language that is C, the C++ compiler is the oracle: each expression is compiled and
// parsed.
#include <gtest/gtest.h>

#include "tests/emulator/world/expression/bench_of_names.h"

// Compilers warn about these expressions, which are the subject of this test.
#pragma GCC diagnostic ignored "-Wparentheses"
#ifdef __clang__
#pragma GCC diagnostic ignored "-Wconstant-logical-operand"
#pragma GCC diagnostic ignored "-Wtautological-compare"
#else
#pragma GCC diagnostic ignored "-Wint-in-bool-context"
#pragma GCC diagnostic ignored "-Wbool-operation"
#endif

namespace understudy::emulator::world {
namespace c_compiler_test {

constexpr std::int64_t x = 37;
constexpr std::int64_t y = -5;
constexpr std::int64_t z = 0;
constexpr double r = 2.75;

struct Compiled {
  std::string_view text;
  double value;
};
#define BOTH(...) \
  Compiled { #__VA_ARGS__, static_cast < double>(__VA_ARGS__) }

TEST(ExpressionAsInC, GivesWhatTheCompilerGives) {
  const BenchOfNames bench({{"x", x}, {"y", y}, {"z", z}, {"r", r}});
  const std::vector<Compiled> cases = {
      BOTH(x + y * 3),
      BOTH(x - y - 3),
      BOTH(x - (y - 3)),
      BOTH(x / y),
      BOTH(x % y),
      BOTH(y / 2),
      BOTH(y % 2),
      BOTH(-x % 4),
      BOTH(-(x % 4)),
      BOTH(x * y / 3 % 7),
      BOTH(x / 3 * 3),
      BOTH(x + 1 << 2),
      BOTH(x << 2 + 1),
      BOTH(x << 2 << 1),
      BOTH(y >> 1),
      BOTH(y >> 1 + 1),
      BOTH(x >> 2 - 1 << 1),
      BOTH(x & 12 | 3),
      BOTH(x | 12 & 3),
      BOTH(x ^ 12 & 7),
      BOTH(x ^ 12 | 7),
      BOTH(x | 12 ^ 7),
      BOTH(x & y),
      BOTH(x | y),
      BOTH(x ^ y),
      BOTH(~x),
      BOTH(~x + 1),
      BOTH(-~x),
      BOTH(~-x),
      BOTH(x & 1 << 2),
      BOTH(x | 4 + 4),
      BOTH(x < y + 50),
      BOTH(x << 1 > 70),
      BOTH(x > 36 && y < 0),
      BOTH(x > 36 && y > 0 || z == 0),
      BOTH(z || x > 36 && y > 0),
      BOTH((z || x > 36) && y > 0),
      BOTH(x && y),
      BOTH(x && z || y),
      BOTH(z && x || z),
      BOTH(!x + 1),
      BOTH(!(x + 1)),
      BOTH(!z && x),
      BOTH(x == 37 ? 1 : 2),
      BOTH(z       ? 1
           : x > 3 ? 2
                   : 3),
      BOTH(x ? z ? 1 : 2 : 3),
      BOTH((z ? 1 : 2) + 3),
      BOTH(z ? 1 : 2 + 3),
      BOTH(x > 3 && z ? 4 : 5),
      BOTH((x > 3) + (y > 3) + (z == 0)),
      BOTH((x & 4) == 4),
      BOTH((x & 8) == 8),
      BOTH(x == 36 + 1),
      BOTH(x != 36 | 1),
      BOTH(r + x),
      BOTH(r * 2 - x / 2),
      BOTH(x / 2 * r),
      BOTH(x / (2 * r)),
      BOTH(-r),
      BOTH(r > 2),
      BOTH(r == 2.75),
      BOTH(r >= x || r < z),
      BOTH(!r),
      BOTH(1e3 + 2.5e-1),
      BOTH(0x1F + 0b101),
  };
  int compared = 0;
  for (const Compiled& c : cases) {
    if (c.text == "x != 36 | 1") {  // C accepts it, this language requires parentheses
      EXPECT_THROW(parse_expression(c.text, bench), ExpressionError);
      continue;
    }
    const Number value = evaluate(parse_expression(c.text, bench), bench);
    EXPECT_EQ(value.real(), c.value) << c.text;
    ++compared;
  }
  EXPECT_EQ(compared, 64);
}

}  // namespace c_compiler_test
}  // namespace understudy::emulator::world
