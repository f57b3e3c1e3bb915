// Any text is accepted, or refused in one line; an accepted text gives a number or one line.
#include <gtest/gtest.h>

#include <random>

#include "emulator/world/expression/tolerance.h"
#include "tests/emulator/world/expression/bench_of_names.h"
#include "tests/sanitized.h"

namespace understudy::emulator::world {
namespace mutated_expressions_test {

const std::vector<std::string> kGood = {
    "feeder.STATUS.4 == 0 && time >= 250ms",
    "feeder[\"Logic Position X\"] == -400 +- 2",
    "(feeder.STATUS & 0x10) != 0 || not feeder.DOUT_4",
    "a ? min(b, c, 1.5e3) : max(abs(c) % 7, 1 << 62)",
    "feeder.AIN_1 == 2.5V +- 0.5% and time < 2min",
    "1_000 * (largest / 3) - ~smallest >> 2 ^ 0b1011",
    "3050ms +- 2ms",
    "32000 +- 1%",
    "-100..200",
    "..4s",
};
const std::vector<std::string> kPieces = {
    "+-",       "..",       "&&",     "||",       "<<",      ">>",       "==",
    "(",        ")",        "[\"",    "\"]",      "['",      ".",        ",",
    "?",        ":",        "-",      "!",        "~",       "%",        "/",
    "*",        "time",     "a",      "b",        "largest", "smallest", "feeder.",
    "min(",     "abs(",     "0x",     "0b1",      "1e",      "1.5",      "9223372036854775807",
    "64",       "ms",       "V",      "s",        "_",       "\n",       "\t",
    "\0",       "\x7f",     "\xff",   "\xc3\xa9", "${n}",    " and ",    " not ",
    "((((((((", "--------", "1e308*", "0 ? 1 : "};

std::string drawn(std::mt19937_64& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  std::string text;
  switch (below(4)) {
    case 0:  // bytes
      for (std::size_t n = below(40); n > 0; --n) text += static_cast<char>(below(256));
      break;
    case 1:  // pieces
      for (std::size_t n = below(30); n > 0; --n) text += kPieces[below(kPieces.size())];
      break;
    default:
      text = kGood[below(kGood.size())];
      for (std::size_t n = 1 + below(3); n > 0; --n) {
        const std::size_t at = below(text.size() + 1);
        switch (below(7)) {
          case 0: text.insert(at, kPieces[below(kPieces.size())]); break;
          case 1: text.erase(at, 1 + below(4)); break;
          case 2: text.insert(at, kGood[below(kGood.size())]); break;
          case 3:
            if (at < text.size()) text[at] = static_cast<char>(below(256));
            break;
          case 4: text += text.substr(at); break;
          default:  // another number
            for (std::size_t i = at; i < text.size(); ++i) {
              if (text[i] >= '0' && text[i] <= '9') text[i] = static_cast<char>('0' + below(10));
            }
        }
      }
  }
  return text;
}

void expect_one_line(const ExpressionError& error, const std::string& text) {
  const std::string line = error.what();
  EXPECT_EQ(line.find("column "), 0U) << text;
  for (const char c : line) {
    ASSERT_TRUE(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F) << text << "\n" << line;
  }
  EXPECT_GE(error.column, 1U);
  EXPECT_LE(error.column, text.size() + 1);
  EXPECT_LT(line.size(), 2'000U) << line;
}

TEST(MutatedExpressions, AreAcceptedOrRefusedInOneLine) {
  const BenchOfNames bench = a_feeder();
  std::mt19937_64 random(5);
  int taken = 0;
  int ranges = 0;
  for (int i = 0; i < fewer_if_sanitized(100'000, 5); ++i) {
    const std::string text = drawn(random);
    try {
      const Expression expression = parse_expression(text, bench);
      ++taken;
      EXPECT_EQ(explain(expression, bench).find('\n'), std::string::npos);
      try {
        const Number value = evaluate(expression, bench);
        // Its text is a number that reads back as the same number.
        const std::string result = number_text(value);
        if (result[0] != '-') {
          EXPECT_EQ(evaluate(parse_expression(result, bench), bench), value) << result;
        }
      } catch (const ExpressionError& error) {
        expect_one_line(error, text);
      }
    } catch (const ExpressionError& error) {
      expect_one_line(error, text);
    }
    for (const Unit unit : {Unit::none, Unit::nanoseconds}) {
      try {
        const Tolerance tolerance = parse_tolerance(text, unit);
        ++ranges;
        EXPECT_TRUE(!tolerance.low || tolerance.holds(*tolerance.low)) << text;
        EXPECT_TRUE(!tolerance.high || tolerance.holds(*tolerance.high)) << text;
      } catch (const ExpressionError& error) {
        expect_one_line(error, text);
      }
    }
  }
  EXPECT_GT(taken, fewer_if_sanitized(2'000, 5));
  EXPECT_GT(ranges, fewer_if_sanitized(1'000, 5));
  RecordProperty("taken", taken);
  RecordProperty("ranges", ranges);
}

}  // namespace mutated_expressions_test
}  // namespace understudy::emulator::world
