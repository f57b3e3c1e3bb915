// Random expressions: a tree is drawn, written with as few parentheses as possible, and evaluated by walking
// the tree with wider numbers; the text must give the same value.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "tests/emulator/world/expression/bench_of_names.h"

namespace understudy::emulator::world {
namespace random_expressions_test {

__extension__ using Wide = __int128;

struct NoResult {};

// The oracle's number: wide enough that overflow is detected afterwards instead of being predicted.
struct Amount {
  bool is_real = false;
  Wide whole = 0;
  double real = 0;
  double as_real() const { return is_real ? real : static_cast<double>(whole); }
  bool is_true() const { return is_real ? real != 0 : whole != 0; }
};

Amount whole(Wide value) {
  if (value > INT64_MAX || value < INT64_MIN) throw NoResult();
  return {false, value, 0};
}
Amount real(double value) {
  if (std::isinf(value) || std::isnan(value)) throw NoResult();
  return {true, 0, value};
}

struct Tree {
  std::string sign;  // "" for a leaf
  std::string leaf;
  Amount value;  // of the leaf
  std::vector<std::unique_ptr<Tree>> parts;
};

// From the table in docs/expressions.md; a higher one binds tighter.
int precedence(const Tree& tree) {
  static const std::vector<std::vector<std::string>> kLoosestFirst = {
      {"?"},        {"||"},     {"&&"},         {"|"}, {"^"}, {"&"}, {"==", "!=", "<", "<=", ">", ">="},
      {"<<", ">>"}, {"+", "-"}, {"*", "/", "%"}};
  if (tree.parts.size() == 1 && tree.sign != "abs") return 20;
  if (tree.sign.empty() || tree.sign == "min" || tree.sign == "max" || tree.sign == "abs") return 30;
  for (std::size_t i = 0; i < kLoosestFirst.size(); ++i) {
    for (const std::string& sign : kLoosestFirst[i]) {
      if (sign == tree.sign) return static_cast<int>(i);
    }
  }
  throw std::logic_error(tree.sign);
}

bool is_comparison(const Tree& tree) { return precedence(tree) == 6; }

Amount walk(const Tree& tree) {
  if (tree.sign.empty()) return tree.value;
  const std::string& sign = tree.sign;
  const Amount a = walk(*tree.parts[0]);
  if (sign == "&&") return whole(a.is_true() && walk(*tree.parts[1]).is_true());
  if (sign == "||") return whole(a.is_true() || walk(*tree.parts[1]).is_true());
  if (sign == "?") return walk(*tree.parts[a.is_true() ? 1 : 2]);
  if (sign == "!") return whole(!a.is_true());
  if (tree.parts.size() == 1) {
    if (sign == "~") {
      if (a.is_real) throw NoResult();
      return whole(-a.whole - 1);  // two's complement
    }
    const bool turn = sign == "-" || (a.is_real ? a.real < 0 : a.whole < 0);
    if (!turn) return a;
    return a.is_real ? real(-a.real) : whole(-a.whole);
  }
  const Amount b = walk(*tree.parts[1]);
  // x86's long double holds every 64-bit number and every double, so comparing there is exact.
  static_assert(std::numeric_limits<long double>::digits >= 64);
  const long double left = a.is_real ? static_cast<long double>(a.real) : static_cast<long double>(a.whole);
  const long double right = b.is_real ? static_cast<long double>(b.real) : static_cast<long double>(b.whole);
  if (sign == "==") return whole(left == right);
  if (sign == "!=") return whole(left != right);
  if (sign == "<") return whole(left < right);
  if (sign == "<=") return whole(left <= right);
  if (sign == ">") return whole(left > right);
  if (sign == ">=") return whole(left >= right);
  if (sign == "min") return right < left ? b : a;
  if (sign == "max") return right > left ? b : a;
  if (a.is_real || b.is_real) {
    if (sign == "+") return real(a.as_real() + b.as_real());
    if (sign == "-") return real(a.as_real() - b.as_real());
    if (sign == "*") return real(a.as_real() * b.as_real());
    if (sign == "/" && b.as_real() != 0) return real(a.as_real() / b.as_real());
    throw NoResult();
  }
  if (sign == "+") return whole(a.whole + b.whole);
  if (sign == "-") return whole(a.whole - b.whole);
  if (sign == "*") return whole(a.whole * b.whole);
  if (sign == "/" || sign == "%") {
    if (b.whole == 0) throw NoResult();
    return whole(sign == "/" ? a.whole / b.whole : a.whole % b.whole);
  }
  if (sign == "<<" || sign == ">>") {
    if (b.whole < 0 || b.whole > 63) throw NoResult();
    Wide power = 1;
    for (Wide i = 0; i < b.whole; ++i) power *= 2;
    if (sign == "<<") return whole(a.whole * power);
    return whole((a.whole - ((a.whole % power + power) % power)) / power);  // rounded down
  }
  // Bit by bit; a negative number is its residue modulo 2^64.
  const Wide modulus = static_cast<Wide>(UINT64_MAX) + 1;
  Wide bits = 0;
  Wide left_rest = (a.whole % modulus + modulus) % modulus;
  Wide right_rest = (b.whole % modulus + modulus) % modulus;
  for (Wide power = 1; power < modulus; power *= 2, left_rest /= 2, right_rest /= 2) {
    const Wide ones = left_rest % 2 + right_rest % 2;
    const bool bit = sign == "&" ? ones == 2 : sign == "|" ? ones > 0 : ones == 1;
    if (bit) bits += power;
  }
  return whole(bits > INT64_MAX ? bits - modulus : bits);
}

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  int below(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }

  std::unique_ptr<Tree> tree(int depth) {
    auto made = std::make_unique<Tree>();
    if (depth == 0 || below(8) == 0) {
      leaf(*made);
      return made;
    }
    static const std::vector<std::string> kSigns = {
        "?", "||", "&&", "|", "^", "&", "==", "!=", "<",  "<=", ">",  ">=",  "<<",  ">>", "+",
        "-", "*",  "/",  "%", "+", "-", "*",  "/",  "-1", "!1", "~1", "abs", "min", "max"};
    made->sign = kSigns[static_cast<std::size_t>(below(static_cast<int>(kSigns.size())))];
    int parts = made->sign == "?" ? 3 : made->sign == "abs" ? 1 : 2;
    if (made->sign.size() == 2 && made->sign[1] == '1') {
      made->sign.pop_back();
      parts = 1;
    }
    for (int i = 0; i < parts; ++i) made->parts.push_back(tree(depth - 1));
    return made;
  }

  std::string text(const Tree& tree) {
    if (tree.sign.empty()) return tree.leaf;
    const int own = precedence(tree);
    if (tree.sign == "abs" || tree.sign == "min" || tree.sign == "max") {
      std::string arguments;
      for (const auto& part : tree.parts) arguments += (arguments.empty() ? "" : ",") + space() + text(*part);
      return tree.sign + space() + "(" + arguments + space() + ")";
    }
    if (tree.sign == "?") {
      return part(*tree.parts[0], 1, tree) + space() + "?" + space() + part(*tree.parts[1], 0, tree) +
             space() + ":" + space() + part(*tree.parts[2], 0, tree);
    }
    if (tree.parts.size() == 1) return tree.sign + space() + part(*tree.parts[0], own, tree);
    // `a + -b` needs its space: `+-` is an operator.
    return part(*tree.parts[0], own, tree) + " " + tree.sign + " " + part(*tree.parts[1], own + 1, tree);
  }

 private:
  std::string part(const Tree& part, int min, const Tree& whole) {
    const int own = precedence(part);
    const int outer = precedence(whole);
    const bool trap = (outer >= 3 && outer <= 5 && is_comparison(part)) ||
                      (is_comparison(whole) && (is_comparison(part) || part.sign == "!"));
    if (own < min || trap || below(10) == 0) return "(" + space() + text(part) + space() + ")";
    return text(part);
  }

  std::string space() { return std::string(static_cast<std::size_t>(below(3) == 0 ? below(3) : 0), ' '); }

  void leaf(Tree& tree) {
    static const std::vector<std::pair<std::string, Wide>> kWholes = {{"0", 0},
                                                                      {"1", 1},
                                                                      {"2", 2},
                                                                      {"3", 3},
                                                                      {"7", 7},
                                                                      {"62", 62},
                                                                      {"63", 63},
                                                                      {"64", 64},
                                                                      {"0xFF", 255},
                                                                      {"0b1101", 13},
                                                                      {"true", 1},
                                                                      {"off", 0},
                                                                      {"9007199254740993", 9007199254740993},
                                                                      {"a", 5},
                                                                      {"b", 0},
                                                                      {"c", -7},
                                                                      {"largest", INT64_MAX},
                                                                      {"smallest", INT64_MIN},
                                                                      {"feeder['Logic Position X']", -400}};
    static const std::vector<std::pair<std::string, double>> kReals = {
        {"0.5", 0.5},
        {"1.0", 1},
        {"9007199254740992.0", 9007199254740992.0},
        {"1e300", 1e300},
        {"feeder.A.speed", 1500.25},
        {"9.3e18", 9.3e18}};
    if (below(6) == 0) {
      const auto& [leaf_text, value] =
          kReals[static_cast<std::size_t>(below(static_cast<int>(kReals.size())))];
      tree.leaf = leaf_text;
      tree.value = real(value);
    } else {
      const auto& [leaf_text, value] =
          kWholes[static_cast<std::size_t>(below(static_cast<int>(kWholes.size())))];
      tree.leaf = leaf_text;
      tree.value = whole(value);
    }
  }

  std::mt19937_64 random_;
};

TEST(RandomExpressions, GiveTheSameResultAsWalkingTheTree) {
  const BenchOfNames bench = a_feeder();
  int results = 0;
  int without_result = 0;
  int refused = 0;
  for (std::uint64_t seed = 1; seed <= 60'000; ++seed) {
    Draw draw(seed);
    const auto tree = draw.tree(1 + draw.below(5));
    const std::string text = draw.text(*tree);
    if (text.size() > 2'000) continue;
    Expression expression;
    try {
      expression = parse_expression(text, bench);
    } catch (const ExpressionError& error) {
      // Only bits of a value that is certainly real are refused before they are computed.
      EXPECT_NE(std::string(error.what()).find("' requires whole numbers"), std::string::npos)
          << seed << ": " << text << "\n"
          << error.what();
      ++refused;
      continue;
    }
    std::string expected;
    try {
      const Amount amount = walk(*tree);
      expected =
          amount.is_real ? number_text(amount.real) : number_text(static_cast<std::int64_t>(amount.whole));
      ++results;
    } catch (const NoResult&) {
      expected = "no result";
      ++without_result;
    }
    std::string came;
    try {
      const Number value = evaluate(expression, bench);
      came = number_text(value);
      ASSERT_EQ(evaluate(expression, bench), value);
    } catch (const ExpressionError&) {
      came = "no result";
    }
    ASSERT_EQ(came, expected) << seed << ": " << text;
  }
  // The random draw reaches each outcome often.
  EXPECT_GT(results, 20'000);
  EXPECT_GT(without_result, 5'000);
  EXPECT_GT(refused, 1'000);
  RecordProperty("results", results);
  RecordProperty("without_result", without_result);
  RecordProperty("refused", refused);
}

TEST(RandomExpressions, NamesInListsAllThatCanChangeTheResult) {
  // Unnamed values can change arbitrarily.
  const std::vector<std::string> names = {
      "a", "b", "c", "largest", "smallest", "feeder.A.speed", "feeder.Logic Position X"};
  for (std::uint64_t seed = 1; seed <= 3'000; ++seed) {
    BenchOfNames bench = a_feeder();
    Draw draw(seed);
    const std::string text = draw.text(*draw.tree(3));
    Expression expression;
    try {
      expression = parse_expression(text, bench);
    } catch (const ExpressionError&) {
      continue;
    }
    const std::string before = outcome(text, bench);
    const std::vector<std::int32_t> watched = names_in(expression);
    for (const std::string& name : names) {
      const bool is_watched =
          std::find(watched.begin(), watched.end(), bench.handle_of(name)) != watched.end();
      if (!is_watched) bench.set(name, draw.below(1000));
    }
    EXPECT_EQ(outcome(text, bench), before) << seed << ": " << text;
  }
}

}  // namespace random_expressions_test
}  // namespace understudy::emulator::world
