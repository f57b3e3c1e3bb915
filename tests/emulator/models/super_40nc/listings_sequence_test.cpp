// The manual's listings of branches, subroutines and waits on the whole controller.
#include <gtest/gtest.h>

#include "tests/emulator/models/super_40nc/listings.h"

namespace understudy::emulator::models::super_40nc {
namespace listings_sequence_test {

const Set kOfC{{"D9003", 4}};

void s1(const std::string& program) {
  for (const bool x12 : {false, true}) {
    OneSuper40nc one({.set = kOfC, .program = program});
    put(one, "X12", x12);
    one.set("Y1", 1);
    const Places there{x12 ? 5000 : 10'000, 0, 0, 0};
    const double seconds = x12 ? 0.760 : 0.770;
    const Value line = x12 ? 6 : 16;
    one.set("M8000", 1);
    one.run(500);
    EXPECT_FALSE(one.on("Y0"));
    one.run(1000);
    EXPECT_EQ(one.on("Y0"), x12);  // while it waits
    one.run_while("M8000");
    EXPECT_FALSE(one.on("Y0") || one.on("Y1"));
    expect_legs(one, 0, {{line, seconds, there}, {21, 2.000, there}, {22, seconds, {}}});
  }
}

/// Times by the formula; C21 = 0 leaves only the waits.
void s2(const std::string& program) {
  OneSuper40nc one({.set = kOfC, .program = program});
  std::vector<Leg> legs{{1, 1.798, {25'000, 25'000, 0, 0}}};
  Places at{25'000, 25'000, 0, 0};
  double sum = 1.798;
  const auto call = [&] {
    at[2] = -10'000;
    legs.push_back({18, move_s(10'000, 10'000), at});
    legs.push_back({22, 0.500, at});
    at[2] = 0;
    legs.push_back({23, move_s(10'000, 10'000), at});
    at[0] += 5000;
    legs.push_back({28, move_s(5000, 10'000), at});
    sum += 3.045;
  };
  for (int pass = 0; pass < 5; ++pass) call();
  at[1] = 50'000;
  legs.push_back({8, move_s(25'000, 10'000), at});
  sum += 2.515;
  for (int pass = 0; pass < 2; ++pass) call();
  EXPECT_NEAR(sum, 25.628, 0.0005);  // as calculated by hand
  const Tick begin = one.now();
  expect_legs(one, 0, legs);
  EXPECT_NEAR(static_cast<double>(one.now() - begin), 25'628, 60);  // 30 lines, up to two scans each
  EXPECT_EQ(positions(one), (Places{60'000, 50'000, 0, 0}));
  EXPECT_EQ(one.get("D8000"), 0);

  OneSuper40nc without({.program = program});
  const Tick start = without.now();
  const std::vector<Lap> found = laps(without, 0);
  EXPECT_EQ(std::count_if(found.begin(), found.end(), [](const Lap& lap) { return lap.step == 22; }), 7);
  EXPECT_NEAR(static_cast<double>(without.now() - start), 3500, 40);
  EXPECT_EQ(positions(without), Places{});
  EXPECT_EQ(without.get("D8094"), 16);
}

void s3(const std::string& program) {
  const char* const kPlc = "\nAREA PLC\nLD M50\nSTP K1\nEND\n";
  for (const char* stop : {"M8102", "M8002", "M50"}) {
    OneSuper40nc one({.program = program + kPlc});
    std::vector<Leg> legs;
    for (int round = 0; round < 3; ++round) {
      legs.push_back({5, 0.095, {1000, 0, 0, 0}});
      legs.push_back({9, 0.095, {2000, 0, 0, 0}});
      legs.push_back({13, 0.170, {}});
    }
    expect_legs(one, 1, legs, 1200);
    EXPECT_TRUE(one.on("M8100")) << "it does not end";
    one.run(57);
    one.set(stop, 1);
    one.run(1);
    const Places stands = positions(one);
    EXPECT_FALSE(one.on("M8100")) << stop;
    EXPECT_EQ(one.get("D8100"), 0);
    one.run(500);
    EXPECT_EQ(positions(one), stands) << stop;
  }
}

void s4(const std::string& program) {
  for (const bool x0 : {false, true}) {
    OneSuper40nc one({.set = kOfC, .program = program});
    put(one, "X0", x0);
    if (x0) {
      expect_legs(one, 0, {{11, move_s(500, 20'000), {300, 400, 0, 0}}});
    } else {
      expect_legs(one, 0, {{4, move_s(std::hypot(100, 200), 10'000), {100, 200, 0, 0}}});
    }
  }
}

void s5(const std::string& program) {
  for (const bool m100 : {false, true}) {
    OneSuper40nc one({.program = program});
    put(one, "M100", m100);
    run_through(one, "M8000");
    EXPECT_EQ(one.on("M20"), m100);
    EXPECT_EQ(one.on("M30"), !m100);
  }
}

void s6(const std::string& program) {
  OneSuper40nc one({.set = kOfC, .program = program});
  const double seconds = move_s(2500 * std::sqrt(2.0), 5000);
  one.set("M8000", 1);
  one.run(static_cast<Tick>(seconds * 1000) + 3);
  for (int look = 0; look < 5; ++look) {
    EXPECT_EQ(positions(one), (Places{2500, 2500, 0, 0}));
    EXPECT_EQ(one.get("D8000"), 5);
    one.run(777);
  }
  one.set("M50", 1);
  EXPECT_NEAR(static_cast<double>(one.run_while("M8000")), seconds * 1000, kTolerance_ms);
  EXPECT_EQ(positions(one), Places{});
}

void s7(const std::string& program) {
  OneSuper40nc one({.set = kOfC, .program = program});
  one.set("D8117", 250);
  one.input("X14", 1);
  one.set("M8000", 1);
  one.run(1);
  for (int look = 0; look < 5; ++look) {
    EXPECT_TRUE(one.on("Y10"));
    one.run(100);
  }
  EXPECT_EQ(one.get("D8117"), 250);
  one.input("X14", 0);
  one.run(1);
  EXPECT_FALSE(one.on("Y10"));
  one.run_while("M8000");
  EXPECT_EQ(positions(one), Places{});
}

void s8(const std::string& program) {
  OneSuper40nc one({.set = kOfC, .program = program});
  expect_legs(one, 0, {{1, 5.832, {3000, 5000, 0, 0}}, {5, 2.000, {3000, 5000, 0, 0}}, {6, 5.832, {}}});
}

constexpr Listing kListings[] = {{"S1", s1}, {"S2", s2}, {"S3", s3}, {"S4", s4},
                                 {"S5", s5}, {"S6", s6}, {"S7", s7}, {"S8", s8}};

class SequenceListing : public testing::TestWithParam<Listing> {};
TEST_P(SequenceListing, DoesWhatTheManualSays) { GetParam().holds(sample(GetParam().name)); }
INSTANTIATE_TEST_SUITE_P(Of, SequenceListing, testing::ValuesIn(kListings), name_of_listing);

TEST(SequenceListings, AreAllHere) { expect_all_of('S', 1, 99, kListings); }

}  // namespace listings_sequence_test
}  // namespace understudy::emulator::models::super_40nc
