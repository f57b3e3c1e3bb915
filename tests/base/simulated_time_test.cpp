// Durations as people write them.
#include "base/simulated_time.h"

#include <gtest/gtest.h>

#include <random>

namespace understudy {
namespace simulated_time_test {

using namespace std::chrono_literals;

TEST(ParseDuration, TakesANumberAndAUnit) {
  const std::vector<std::pair<std::string_view, SimTime>> cases = {
      {"250ms", 250ms},
      {"3s", 3s},
      {"1.5s", 1500ms},
      {"40us", 40us},
      {"20ns", 20ns},
      {"2min", 120s},
      {"1h", 3600s},
      {"0s", 0s},
      {"0.75ms", 750us},
      {"0.000000001s", 1ns},
      {"1.000000001s", 1'000'000'001ns},
      {"3.050s", 3050ms},
      {"0.1us", 100ns},
      {"7.0ns", 7ns},
      {"1.5min", 90s},
      {"0.25h", 900s},
      {"007ms", 7ms},
      {"24h", 86'400s},
  };
  for (const auto& [text, time] : cases) EXPECT_EQ(parse_duration(text), time) << text;
}

TEST(ParseDuration, RefusesEverythingElse) {
  for (const char* text : {"",         " ",     "ms",    "s",       ".",    ".s",   "5",    "5.",   "-1s",
                           "+1s",      "1e3s",  "0x10s", "1.5.5s",  "1,5s", "s5",   "5S",   "5MS",  "5m",
                           "5 m s",    "5sec",  "5d",    " 5s",     "5s ",  "5s\n", "nans", "infs", "1.5ns",
                           "0.0001us", "0.1ns", "1s1s",  "1h30min", "--",   "5\0s", "٣s"}) {
    EXPECT_FALSE(parse_duration(text)) << "'" << text << "'";
  }
  EXPECT_FALSE(parse_duration(std::string_view("5\0s", 3)));
}

TEST(ParseDuration, RefusesWhatWouldOverflow) {
  for (const char* text :
       {"9223372036854775808ns", "18446744073709551616ns", "18446744073709551617ns", "9223372036854775808s",
        "9300000000s", "99999999999999999999999999999999s", "153722868min", "2562048h",
        "5124095576030432h",  // a little more than 2^64 ns: a small number if it wrapped
        "18446744074s", "307445735min"}) {
    EXPECT_FALSE(parse_duration(text)) << text;
  }
  const auto century = parse_duration("876000h");
  ASSERT_TRUE(century) << "a century is possible";
  EXPECT_EQ(*century, 876000h);
}

TEST(ParseDuration, NeverGivesANegativeTimeHoweverManyDigits) {
  for (const char* unit : {"ns", "us", "ms", "s", "min", "h"}) {
    std::string digits;
    for (int i = 0; i < 40; ++i) {
      digits += '9';
      const auto time = parse_duration(digits + unit);
      EXPECT_GT(time.value_or(1ns).count(), 0) << digits << unit;
      const auto fraction = parse_duration(digits + "." + digits + unit);
      EXPECT_GT(fraction.value_or(1ns).count(), 0) << digits << unit;
    }
    EXPECT_FALSE(parse_duration(digits + unit));
  }
}

TEST(FormatDuration, IsExactAndInTheUnitThatFits) {
  const std::vector<std::pair<SimTime, std::string_view>> cases = {
      {0ns, "0s"},        {1ns, "1ns"},     {999ns, "999ns"}, {1us, "1us"},       {750us, "750us"},
      {1ms, "1ms"},       {250ms, "250ms"}, {1s, "1s"},       {3050ms, "3.05s"},  {1'000'001us, "1.000001s"},
      {1250us, "1.25ms"}, {90s, "90s"},     {3600s, "3600s"}, {-250ms, "-250ms"}, {-1ns, "-1ns"},
  };
  for (const auto& [time, text] : cases) EXPECT_EQ(format_duration(time), text) << time.count();
}

TEST(FormatDuration, IsReadBackAsTheSameTime) {
  std::mt19937_64 random(20240229);
  std::vector<std::int64_t> times = {0,
                                     1,
                                     999,
                                     1'000,
                                     1'001,
                                     999'999,
                                     1'000'000,
                                     999'999'999,
                                     1'000'000'000,
                                     3'600'000'000'000,
                                     4'000'000'000'000'000};
  for (int bits = 1; bits < 61; ++bits) {
    for (int i = 0; i < 200; ++i) times.push_back(static_cast<std::int64_t>(random() >> (64 - bits)));
    times.push_back(std::int64_t{1} << bits);
    times.push_back((std::int64_t{1} << bits) / 1000 * 1000);
    times.push_back((std::int64_t{1} << bits) / 1'000'000 * 1'000'000);
  }
  for (const std::int64_t ns : times) {
    const std::string text = format_duration(SimTime{ns});
    EXPECT_EQ(parse_duration(text), SimTime{ns}) << text;
  }
}

TEST(Ticks, AreMilliseconds) {
  EXPECT_EQ(time_of(0), 0ns);
  EXPECT_EQ(time_of(3050), 3050ms);
  EXPECT_EQ(time_of(kNever), kForever);
  EXPECT_EQ(tick_at(0ns), 0);
  EXPECT_EQ(tick_at(999'999ns), 0);
  EXPECT_EQ(tick_at(1ms), 1);
  EXPECT_EQ(tick_at(3050ms + 999us), 3050);
}

}  // namespace simulated_time_test
}  // namespace understudy
