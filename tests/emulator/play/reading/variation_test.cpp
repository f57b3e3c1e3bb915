// The values of one entry of `vary`: amounts, ranges, draws.
#include "emulator/play/reading/variation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "emulator/play/reading/amounts.h"
#include "tests/emulator/world/bench_file/without_columns.h"

namespace understudy::emulator::play {
namespace variation_test {

using Strings = std::vector<std::string>;

Variation of(const std::string& yaml, std::uint64_t seed = 0, bool overrides = false) {
  const auto root = world::YamlFields::parse("p: " + yaml + "\n", "f.yaml", "vary", "something");
  return Variation(root.at("p"), "p", seed, overrides);
}

Strings all_of(const Variation& variation) {
  Strings values;
  for (std::uint64_t i = 0; i < variation.count(); ++i) values.push_back(variation.value(i));
  return values;
}

TEST(Amounts, AreReadExactlyOrNotAtAll) {
  struct Row {
    const char* text;
    bool is_one;
    Amount::Kind kind{};
    std::int64_t digits = 0;
    int decimals = 0;
    std::int64_t unit = 1;
  };
  using enum Amount::Kind;
  for (const Row& row : std::vector<Row>{{"12", true, number, 12},
                                         {"-12", true, number, -12},
                                         {"0.50", true, number, 50, 2},
                                         {"1.5s", true, duration, 15, 1, 1'000'000'000},
                                         {"20 ms", true, duration, 20, 0, 1'000'000},
                                         {"2.5V", true, voltage, 25, 1, 1000},
                                         {"-300mV", true, voltage, -300, 0, 1},
                                         {"999999999999999", true, number, 999'999'999'999'999},
                                         {"9999999999999999", false},
                                         {"", false},
                                         {"-", false},
                                         {"1.", false},
                                         {".", false},
                                         {"1.2.3", false},
                                         {"0x10", false},
                                         {"1e3", false},
                                         {"12 parsecs", false},
                                         {"ms", false}}) {
    const auto amount = parse_amount(row.text);
    ASSERT_EQ(amount.has_value(), row.is_one) << row.text;
    if (!amount) continue;
    EXPECT_EQ(amount->kind, row.kind) << row.text;
    EXPECT_EQ(amount->digits, row.digits) << row.text;
    EXPECT_EQ(amount->decimals, row.decimals) << row.text;
    EXPECT_EQ(amount->unit, row.unit) << row.text;
  }
}

TEST(Variation, ListsAndRangesHaveTheirValuesInOrder) {
  struct Row {
    const char* yaml;
    Strings values;
  };
  for (const Row& row :
       std::vector<Row>{{"[ 100, 0x20, on, 20ms, a text ]", {"100", "0x20", "on", "20ms", "a text"}},
                        {"{ from: 1, to: 9, step: 2 }", {"1", "3", "5", "7", "9"}},
                        {"{ from: 1, to: 8, step: 3 }", {"1", "4", "7"}},  // none beyond the end
                        {"{ from: 5, to: 5, step: 1 }", {"5"}},
                        {"{ from: -4, to: 4, step: 4 }", {"-4", "0", "4"}},
                        {"{ from: 0.5, to: 1, step: 0.25 }", {"0.50", "0.75", "1.00"}},
                        {"{ from: -0.1, to: 0.1, step: 0.1 }", {"-0.1", "0.0", "0.1"}},
                        {"{ from: 1ms, to: 2ms, step: 500us }", {"1ms", "1.5ms", "2ms"}},
                        {"{ from: 999ms, to: 1s, step: 1ms }", {"999ms", "1s"}},
                        {"{ from: 0s, to: 1h, step: 30min }", {"0s", "1800s", "3600s"}},
                        {"{ from: 500mV, to: 2V, step: 0.5V }", {"500mV", "1V", "1.5V", "2V"}}}) {
    EXPECT_EQ(all_of(of(row.yaml)), row.values) << row.yaml;
  }
  const Variation large = of("{ from: 1, to: 100000000000, step: 1 }");
  EXPECT_EQ(large.count(), 100'000'000'000U);
  EXPECT_EQ(large.value(99'999'999'999), "100000000000");
}

TEST(Variation, SamplesAreDifferentAndWithinTheirBounds) {
  const Strings some = all_of(of("{ between: [ 1, 1000 ], samples: 100, seed: 7 }"));
  EXPECT_EQ(std::set(some.begin(), some.end()).size(), 100U);
  double sum = 0;
  for (const std::string& value : some) {
    EXPECT_GE(std::stoi(value), 1);
    EXPECT_LE(std::stoi(value), 1000);
    sum += std::stoi(value);
  }
  // 100 of 1 to 1000 without repetition: 500.5 on average, with a standard deviation of 27.4.
  EXPECT_NEAR(sum / 100, 500.5, 4 * 27.4);
  // All of them are each of them once.
  Strings all = all_of(of("{ between: [ 1, 30 ], samples: 30, seed: 7 }"));
  EXPECT_FALSE(std::is_sorted(all.begin(), all.end()));
  std::multiset<int> numbers;
  for (const std::string& value : all) numbers.insert(std::stoi(value));
  int expected = 0;
  for (const int number : numbers) EXPECT_EQ(number, ++expected);
}

TEST(Variation, SamplesAreTheSameForOneSeedAndNoOther) {
  const std::string yaml = "{ between: [ 0, 100000 ], samples: 50";
  const Strings of_7 = all_of(of(yaml + ", seed: 7 }", 3));
  EXPECT_EQ(all_of(of(yaml + ", seed: 7 }", 4)), of_7);
  EXPECT_NE(all_of(of(yaml + ", seed: 8 }")), of_7);
  EXPECT_EQ(all_of(of(yaml + " }", 7)), of_7) << "the scenario's seed is used instead";
  EXPECT_NE(all_of(of(yaml + ", seed: 7 }", 9, true)), of_7) << "a different one for all";
  // More samples begin with the same ones.
  const Strings more = all_of(of("{ between: [ 0, 100000 ], samples: 80, seed: 7 }"));
  EXPECT_TRUE(std::equal(of_7.begin(), of_7.end(), more.begin()));
}

TEST(Variation, DrawsAreAsFineAsTheirEndsAreWritten) {
  struct Row {
    const char* yaml;
    std::uint64_t places;
  };
  for (const Row& row : std::vector<Row>{{"{ between: [ 1, 9 ], samples: ", 9},
                                         {"{ between: [ 0.0, 1 ], samples: ", 11},
                                         {"{ between: [ 1ms, 20ms ], samples: ", 20},
                                         {"{ between: [ 0.5s, 1s ], samples: ", 6},
                                         {"{ between: [ 1s, 1001ms ], samples: ", 2},
                                         {"{ between: [ 0V, 1.0V ], samples: ", 11},
                                         {"{ between: [ 0, 100 ], step: 25, samples: ", 5},
                                         {"{ one_of: [ a, b, c ], samples: ", 3}}) {
    EXPECT_EQ(of(row.yaml + std::to_string(row.places) + " }").count(), row.places) << row.yaml;
    EXPECT_THROW(of(row.yaml + std::to_string(row.places + 1) + " }"), FileError) << row.yaml;
  }
}

TEST(Variation, WithoutSamplesOneIsDrawnForEachCase) {
  const Variation free = of("{ between: [ 1, 6 ], seed: 20 }");
  EXPECT_TRUE(free.is_free());
  EXPECT_EQ(free.count(), 1U);
  std::map<std::string, int> counts;
  for (std::uint64_t i = 0; i < 6000; ++i) ++counts[free.drawn_for(i)];
  ASSERT_EQ(counts.size(), 6U);
  // A die: 1000 of each, with a standard deviation of 28.9.
  for (const auto& [value, count] : counts) EXPECT_NEAR(count, 1000, 5 * 28.9) << value;
  EXPECT_EQ(free.drawn_for(17), of("{ between: [ 1, 6 ], seed: 20 }").drawn_for(17));
}

TEST(Shuffled, IsAPermutationOfAnyCount) {
  for (const std::uint64_t count : {1U, 2U, 3U, 4U, 5U, 15U, 16U, 17U, 255U, 257U, 1000U}) {
    std::set<std::uint64_t> seen;
    for (std::uint64_t i = 0; i < count; ++i) seen.insert(shuffled(i, count, 5));
    EXPECT_EQ(seen.size(), count);
    EXPECT_EQ(*seen.rbegin(), count - 1);
  }
  constexpr std::uint64_t kMany = std::uint64_t{1} << 62;
  EXPECT_LT(shuffled(kMany - 1, kMany, 5), kMany);
}

TEST(Variation, WhatIsWrongIsSaidWithItsPlace) {
  struct Row {
    const char* yaml;
    const char* diagnostic;
  };
  for (const Row& row : std::vector<Row>{
           {"5",
            "p: expected values, as in `[ 1, 2 ]`, `{ from: 1, to: 9, step: 2 }` or `{ between: [ 1, 9 ], "
            "samples: 5 }`"},
           {"[]", "p: is empty; expected at least one value"},
           {"[ 1, 2, 1 ]", "p[2]: '1' appears twice; expected each value once"},
           {"[ [ 1 ] ]", "p[0]: expected a value, such as 100, 20ms or on"},
           {"{ fro: 1 }",
            "p: has no values; expected `from`, `between` or `one_of`, as in `{ from: 1, to: 9, step: 2 }`"},
           {"{ from: 1, to: 9, stop: 2 }",
            "p.stop: is not a key here; expected one of from, to, step (the nearest is 'step')"},
           {"{ from: 9, to: 1, step: 1 }", "p.to: 1 is less than 9; expected the larger value second"},
           {"{ from: 1, to: 9, step: 0 }", "p.step: is 0; expected more than 0"},
           {"{ from: 1, to: 9ms, step: 1 }", "p.to: is a duration; expected a number as 1 is"},
           {"{ from: a, to: 9, step: 1 }",
            "p.from: 'a' is not an amount; expected a number, a duration or a voltage, such as 12, 0.5, 20ms "
            "or "
            "2.5V"},
           {"{ from: 0.5ns, to: 9ns, step: 1ns }",
            "p.from: '0.5ns' is too large or too fine; expected a value that can be counted"},
           {"{ from: -1ms, to: 1ms, step: 1ms }", "p.from: is negative; expected a duration"},
           {"{ between: [ 1, 2, 3 ] }", "p.between: expected two values, as in `[ 1, 9 ]`"},
           {"{ between: [ 1, 9 ], samples: 10 }",
            "p.samples: the range has only 9 values; expected at most that many"},
           {"{ one_of: [ a, a ] }", "p.one_of[1]: 'a' appears twice; expected each value once"}}) {
    try {
      of(row.yaml);
      ADD_FAILURE() << row.yaml;
    } catch (const FileError& error) {
      EXPECT_EQ(world::without_columns(error.what()), "f.yaml:1: " + std::string(row.diagnostic));
    }
  }
}

}  // namespace variation_test
}  // namespace understudy::emulator::play
