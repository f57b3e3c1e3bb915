// The manual's listings of numbers and comparisons on the whole controller.
#include <gtest/gtest.h>

#include <limits>

#include "tests/emulator/models/super_40nc/listings.h"

namespace understudy::emulator::models::super_40nc {
namespace listings_data_test {

constexpr Value kMin = std::numeric_limits<std::int32_t>::min();
constexpr Value kMax = std::numeric_limits<std::int32_t>::max();
const Set kOfC{{"D9003", 4}};

Value wrapped(Value value) { return static_cast<std::int32_t>(static_cast<std::uint32_t>(value)); }

void d1(const std::string& program) {
  OneSuper40nc one({.program = program});
  one.set("D0", 5);
  one.run(3);
  EXPECT_EQ(one.get("D0"), 5);
  one.input("X0", 1);
  one.run(1);
  EXPECT_EQ(one.get("D0"), 100);
  one.set("D0", 5);  // a host's value lasts until the next scan
  one.run(1);
  EXPECT_EQ(one.get("D0"), 100);
  one.input("X0", 0);
  one.run(1);
  one.set("D0", 5);
  one.run(3);
  EXPECT_EQ(one.get("D0"), 5);
}

void d2(const std::string& program) {
  for (const Value from : {0, 1000}) {
    OneSuper40nc one({.program = program});
    one.set("D8117", from);
    one.set("D10", 77);
    one.set("M8100", 1);
    const Pulse pulse = pulse_of(one, "M10");
    EXPECT_EQ(pulse.before, 1);
    // The line that moves nothing still ends the slice.
    EXPECT_NEAR(static_cast<double>(pulse.lasts), from == 0 ? 1 : 160, from == 0 ? 0 : kTolerance_ms);
    EXPECT_EQ(one.get("D10"), 0);
    EXPECT_EQ(positions(one), Places{});
    EXPECT_FALSE(one.on("M8100"));
  }
}

void d3(const std::string& program) {
  OneSuper40nc one({.program = program});
  const auto all_on = [&] {
    for (int i = 0; i <= 12; ++i) one.set("M" + std::to_string(i), 1);
  };
  all_on();
  one.run(3);
  EXPECT_TRUE(one.on("M0"));
  one.input("X0", 1);
  one.run(1);
  for (int i = 0; i <= 12; ++i) EXPECT_EQ(one.on("M" + std::to_string(i)), i > 10) << i;
}

void d4(const std::string& program) {
  OneSuper40nc one({.program = program});
  for (const char* contact : {"M10", "M11"}) one.set(contact, 1);
  one.set("M8100", 1);
  const Pulse pulse = pulse_of(one, "M0");
  EXPECT_NEAR(static_cast<double>(pulse.lasts), 160, kTolerance_ms);
  for (const char* contact : {"M0", "M5", "M10"}) EXPECT_FALSE(one.on(contact)) << contact;
  EXPECT_TRUE(one.on("M11"));
  EXPECT_EQ(positions(one), (Places{1000, 0, 0, 0}));
}

void d5(const std::string& program) {
  OneSuper40nc one({.program = program});
  for (int i = 0; i <= 6; ++i) one.set("D" + std::to_string(i), 10 + i);
  one.run(3);
  EXPECT_EQ(one.get("D0"), 10);
  one.input("X0", 1);
  one.run(1);
  for (int i = 0; i <= 6; ++i) EXPECT_EQ(one.get("D" + std::to_string(i)), i < 5 ? 0 : 10 + i) << i;
}

void d6(const std::string& program) {
  OneSuper40nc one({.program = program});
  for (int i = 0; i <= 5; ++i) one.set("D" + std::to_string(i), 10 + i);
  one.set("M8100", 1);
  one.run(100);
  const Value on_the_way[] = {100, 11, 500, 13, 14, 15};
  for (int i = 0; i <= 5; ++i) EXPECT_EQ(one.get("D" + std::to_string(i)), on_the_way[i]);
  EXPECT_NEAR(100 + static_cast<double>(one.run_while("M8100")), 160, kTolerance_ms);
  for (int i = 0; i <= 5; ++i) EXPECT_EQ(one.get("D" + std::to_string(i)), i < 5 ? 0 : 15);
  EXPECT_EQ(positions(one), (Places{1000, 0, 0, 0}));
}

void d7(const std::string& program) {
  OneSuper40nc one({.program = program});
  const Value numbers[] = {0, 1, -1, 7, -7, 10, 46341, -65536, kMax, kMin};
  for (const char* input : {"X0", "X1", "X2"}) one.input(input, 1);
  for (const Value a : numbers) {
    for (const Value b : numbers) {
      for (const char* name : {"D0", "D2", "D4", "D7"}) one.set(name, a);
      for (const char* name : {"D5", "D8"}) one.set(name, b);
      one.set("D9", 111);
      one.set("D10", 222);
      one.input("X3", 0);
      one.run(1);
      EXPECT_EQ(one.get("D1"), wrapped(a + 1));
      EXPECT_EQ(one.get("D3"), wrapped(10 - a));
      EXPECT_EQ(one.get("D6"), wrapped(a * b)) << a << " * " << b;
      EXPECT_EQ(one.get("D9"), 111);  // X3 is OFF
      one.input("X3", 1);
      one.run(1);
      EXPECT_EQ(one.get("D9"), b == 0 ? 111 : wrapped(a / b)) << a << " / " << b;
      EXPECT_EQ(one.get("D10"), b == 0 ? 222 : a % b) << a << " / " << b;
      EXPECT_EQ(one.get("D8094") == 8, b == 0);
      if (b != 0) continue;
      one.input("PLC_RUN", 0);  // a code stays until the PLC starts again
      one.run(1);
      one.input("X3", 0);
      one.input("PLC_RUN", 1);
      one.run(1);
      EXPECT_EQ(one.get("D8094"), 0);
    }
  }
}

void d8(const std::string& program) {
  OneSuper40nc one({.set = kOfC, .program = program});
  const double path = std::hypot(std::hypot(20, 18), std::hypot(36, 9));
  expect_legs(one, 0, {{15, move_s(path, 50'000), {20, 18, 36, 9}}});
  const Value numbers[] = {20, 18, 36, 9, 0};
  for (int i = 0; i < 5; ++i) EXPECT_EQ(one.get("D" + std::to_string(i)), numbers[i]);
}

void d9(const std::string& program) {
  OneSuper40nc one({.program = program});
  one.set("D10", 100);
  one.set("D20", kMin + 3);
  one.input("X0", 1);
  one.run(40);
  EXPECT_EQ(one.get("D10"), 140);
  one.input("X0", 0);
  one.set("M100", 1);
  one.run(10);
  EXPECT_EQ(one.get("D10"), 140);
  EXPECT_EQ(one.get("D20"), wrapped(kMin + 3 - 10));
}

void d10(const std::string& program) {
  OneSuper40nc one({.set = kOfC, .program = program});
  expect_legs(one, 0, {{1, move_s(10'000 * std::sqrt(14.0), 20'000), {10'000, 20'000, 30'000, 0}}});
  one.run(20);
  EXPECT_EQ(one.get("D100"), 1);
  EXPECT_EQ(one.get("D200"), -1);
}

void d11a(const std::string& program) {
  OneSuper40nc one({.program = program});
  one.set("D10", -5);
  one.run(2);
  EXPECT_EQ(one.get("D10"), -5);
  one.input("X0", 1);
  for (const auto& [value, absolute] :
       {std::pair<Value, Value>{-5, 5}, {5, 5}, {0, 0}, {-kMax, kMax}, {kMin, kMin}}) {
    one.set("D10", value);
    one.run(1);
    EXPECT_EQ(one.get("D10"), absolute);
  }
}

void d11(const std::string& program) {
  for (const Value d0 : {-4000, 4000}) {
    OneSuper40nc one({.set = kOfC, .program = program});
    one.set("D0", d0);
    expect_legs(one, 0, {{2, move_s(std::hypot(4000, 10'000), 20'000), {4000, 10'000, 0, 0}}});
    EXPECT_EQ(one.get("D0"), 4000);
  }
}

/// Just below, at and above each other.
template <class Look>
void around(Value value, Look look) {
  for (const Value each : {value - 1, value, value + 1, kMin, kMax}) look(each);
}

void d12(const std::string& program) {
  OneSuper40nc one({.program = program});
  around(50, [&](Value d100) {
    one.set("D100", d100);
    one.run(1);
    EXPECT_EQ(one.on("Y0"), d100 == 50) << d100;
  });
  around(20, [&](Value c0) {
    one.set("holding.C0", c0);
    one.run(1);
    EXPECT_EQ(one.on("Y1"), c0 >= 21) << c0;
  });
  around(10, [&](Value d150) {
    for (const bool m0 : {false, true}) {
      one.set("D150", d150);
      one.set("M0", m0 ? 1 : 0);
      one.run(1);
      EXPECT_EQ(one.on("M10"), d150 != 10 && !m0) << d150;
    }
  });
  around(100, [&](Value c1) {
    for (const bool m2 : {false, true}) {
      one.set("holding.C1", c1);
      one.set("M2", m2 ? 1 : 0);
      one.set("M20", 0);
      one.run(1);
      EXPECT_EQ(one.on("M20"), c1 >= 100 || m2) << c1;
    }
  });
}

/// Three conditions of three comparisons each, at and next to their limits.
void d13(const std::string& program) {
  OneSuper40nc one({.set = kOfC, .program = program});
  int went[4] = {};
  for (unsigned states = 0; states < 512; ++states) {
    const auto bit = [&](unsigned number) { return (states >> number & 1U) != 0; };
    const Value d0 = bit(0) ? 7 : 8;
    const Value d2 = bit(1) ? 10 : 11;
    const Value c0 = bit(2) ? 100 : 101;
    const Value d50 = bit(3) ? 9 : 10;
    const Value d100 = bit(4) ? 101 : 100;
    const Value c2 = bit(5) ? 201 : 200;
    const Value d250 = bit(6) ? 1 : 0;
    const Value d300 = bit(7) ? 20 : 19;
    const Value c10 = bit(8) ? 200 : 201;
    const std::pair<const char*, Value> values[] = {
        {"D0", d0},     {"D1", 7},      {"D2", d2},     {"holding.C0", c0}, {"D50", d50},
        {"D100", d100}, {"D250", d250}, {"D300", d300}, {"holding.C2", c2}, {"holding.C10", c10}};
    for (const auto& [name, value] : values) one.set(name, value);
    for (const char* name : {"D8117", "D8217", "D8317", "D8417"}) one.set(name, 500);
    one.set("M8000", 1);
    one.run(1);
    one.run_while("M8000");
    Places end{500, 500, 500, 500};
    int branch = 3;
    if ((d0 == 7 && d2 == 10) || c0 == 100) {
      end = {1000, 2000, 3000, 4000};
      branch = 0;
    } else if ((d50 <= 9 && d100 >= 101) || c2 >= 201) {
      end = {1500, 2500, 3500, 4500};
      branch = 1;
    } else if ((d250 != 0 && d300 >= 20) || c10 <= 200) {
      end = {};
      branch = 2;
    }
    ++went[branch];
    ASSERT_EQ(positions(one), end) << states;
  }
  for (const int times : went) EXPECT_GT(times, 0);
}

void d14(const std::string& program) {
  OneSuper40nc one({.program = program});
  each_state(one, {"X0", "X3", "M5", "M20"}, [&](const std::vector<bool>& on) {
    for (const Value offset : {-1, 0, 1}) {
      one.set("Y10", 0);
      one.set("D20", 30);
      one.set("holding.C0", 30 + offset);
      one.set("D150", 100 + offset);
      one.set("holding.C20", 1000 + offset);
      one.set("D200", 50 + offset);
      one.run(1);
      EXPECT_EQ(one.on("Y5"), on[0] && offset == 0);
      EXPECT_EQ(one.on("M10"), !on[1] && offset < 0);
      EXPECT_EQ(one.on("Y10"), on[2] && offset <= 0);
      EXPECT_EQ(one.on("Y12"), on[3] && offset != 0);
    }
  });
}

void d15(const std::string& program) {
  OneSuper40nc one({.program = program});
  each_state(one, {"X1", "X3", "M5", "M10"}, [&](const std::vector<bool>& on) {
    for (const Value offset : {-1, 0, 1}) {
      one.set("D10", 5);
      one.set("D20", 5 + offset);
      one.set("holding.C0", 10 + offset);
      one.set("holding.C5", 100 + offset);
      one.set("D100", 199);
      one.run(1);
      EXPECT_EQ(one.on("Y0"), on[0] || offset == 0);
      EXPECT_EQ(one.on("M100"), on[1] || offset < 0);
      EXPECT_EQ(one.on("Y10"), (on[2] && on[3]) || offset >= 0);
      one.set("D100", 200);
      one.run(1);
      EXPECT_TRUE(one.on("Y10"));
    }
  });
}

constexpr Listing kListings[] = {{"D1", d1},   {"D2", d2},   {"D3", d3},   {"D4", d4},
                                 {"D5", d5},   {"D6", d6},   {"D7", d7},   {"D8", d8},
                                 {"D9", d9},   {"D10", d10}, {"D11", d11}, {"D11a", d11a},
                                 {"D12", d12}, {"D13", d13}, {"D14", d14}, {"D15", d15}};

class DataListing : public testing::TestWithParam<Listing> {};
TEST_P(DataListing, DoesWhatTheManualSays) { GetParam().holds(sample(GetParam().name)); }
INSTANTIATE_TEST_SUITE_P(Of, DataListing, testing::ValuesIn(kListings), name_of_listing);

TEST(DataListings, AreAllHere) { expect_all_of('D', 1, 99, kListings); }

}  // namespace listings_data_test
}  // namespace understudy::emulator::models::super_40nc
