// SUPER-40NC's 13 homing modes (《X20.》), to the pulse. The DOG is from 50,000 to 70,000, the limit at
// 100,000, a C signal at every multiple of 4,000; from 500 rpm the axis decelerates within 833 pulses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/emulator/models/super_40nc/one_super40nc.h"
#include "tests/sanitized.h"

namespace understudy::emulator::models::super_40nc {
namespace homing_test {

constexpr int kBraking = 833;

Given machine(int direction, int stands_at = 0) {
  world::PlantSetup plant;
  plant.home = direction > 0 ? world::PulseSpan{50000, 70000} : world::PulseSpan{-70000, -50000};
  plant.upper_limit = 99000;
  plant.lower_limit = -99000;
  plant.index = world::IndexSetup{.at = 0, .width = 1, .period = 4000};
  plant.position_pulses = stands_at;
  return {.plant = {{0, plant}}};
}

/// This lets D8140 show where it stopped: it keeps its pulses.
void prepare(OneSuper40nc& one, int mode, int direction) {
  one.set("D9121", mode);
  one.set("D9181", direction > 0 ? 0 : 1);
  one.set("D9128", 0);
  one.set("D9182", 1234);
}

struct Case {
  int mode;
  int end;
  int tolerance;  // where it ends with a ramp
};
constexpr Case kCases[] = {
    {0, 50000 + kBraking, 1}, {1, 50000, 0},  {2, 52000, 0}, {3, 52000 + kBraking, 1}, {4, 48000, 0},
    {5, 48000 - kBraking, 1}, {6, 98999, 0},  {7, 96000, 0}, {8, 96000 - kBraking, 1}, {9, 50000, 0},
    {10, 52000, 0},           {11, 48000, 0}, {12, 96000, 0}};

TEST(Super40ncHoming, EndsWhereTheModeSays) {
  for (const Case& each : kCases) {
    for (const int direction : {+1, -1}) {
      OneSuper40nc one(machine(direction));
      prepare(one, each.mode, direction);
      one.set("M8105", 1);
      one.run(2);
      EXPECT_TRUE(one.on("M8197")) << each.mode;
      EXPECT_FALSE(one.on("M8195"));
      one.run_while("M8197");
      EXPECT_TRUE(one.on("M8195")) << each.mode;
      EXPECT_NEAR(static_cast<double>(one.get("D8140")), direction * each.end, each.tolerance)
          << "mode " << each.mode << " way " << direction;
      EXPECT_EQ(one.get("D8117"), 1234);
      EXPECT_EQ(one.get("D8094"), 0);
    }
  }
}

// --- from everywhere, at two speeds, with one and with several C signals
// ------------------------------------

struct Search {
  int mode;
  int from;    // all positions are in the direction of the search
  int count;   // of C signals
  double rpm;  // X21
};
struct Found {
  double end = 0;
  bool is_home = true;
};

/// From the manual's text alone. Ramps down are as long as ramps up: if an axis starts to decelerate before
/// it has completed its ramp, it needs the same distance again.
Found by_hand(const Search& search) {
  const double slope = 5000 * 4000 / 60.0 / 0.5;
  const double speed = search.rpm * 4000 / 60;
  const double ramp = speed * speed / (2 * slope);
  constexpr double kDog = 50'000, kDogEnd = 70'000, kLimit = 99'000, kIndex = 4000;
  const double others = kIndex * (search.count - 1);
  const auto behind = [&](double at, double from) { return at + std::min(ramp, at - from); };
  const auto before = [&](double at, double from) { return at - std::min(ramp, from - at); };
  const auto index_below = [&](double at) { return std::ceil(at / kIndex - 1) * kIndex; };
  double from = search.from;
  const bool is_by_limit = (search.mode >= 6 && search.mode <= 8) || search.mode == 12;
  if (from >= kLimit && !is_by_limit) return {from, false};  // it does not start
  if (is_by_limit) {
    const double turns_at = from >= kLimit ? from : behind(kLimit, from);
    const double index = index_below(turns_at) - others;
    if (search.mode == 6) return {kLimit - 1};
    // The way back to it is blocked beyond the limit.
    if (search.mode == 12) return {index, index < kLimit};
    return {search.mode == 8 ? before(index, turns_at) : index};
  }
  if (from > kDogEnd) return {kLimit, false};
  while (from >= kDog) from -= 5;  // X25
  const double turns_at = behind(kDog, from);
  const double index_on_dog = index_below(kDog + kIndex) + others;
  const double index_below_it = index_below(turns_at) - others;
  const bool is_off_again = turns_at > kDogEnd;
  switch (search.mode) {
    case 0: return {turns_at};
    case 1: return {kDog, !is_off_again};
    case 2:
    case 10: return {index_on_dog};
    case 3: return {behind(index_on_dog, from)};
    case 4:
    case 11: return {index_below_it, !is_off_again};
    case 5: return {before(index_below_it, turns_at), !is_off_again};
    default: return {kDog};  // 9
  }
}

TEST(Super40ncHoming, EndsAlikeFromEverywhere) {
  int number = 0;
  for (int mode = 0; mode <= 12; ++mode) {
    const bool is_by_ramp = mode == 0 || mode == 3 || mode == 5 || mode == 8;
    for (const int from : {-99'000, 0, 49'990, 50'000, 61'234, 69'990, 75'000, 99'000}) {
      for (const int count : {1, 3}) {
        for (const double rpm : {300.0, 3000.0}) {
          if (is_sanitized() && ++number % 3 != 0) continue;
          const int direction = (from / 10 + mode + count) % 2 == 0 ? +1 : -1;
          const Found expected = by_hand({mode, from, count, rpm});
          OneSuper40nc one(machine(direction, direction * from));
          prepare(one, mode, direction);
          one.set("D9122", count - 1);
          one.set("D9179", static_cast<Value>(rpm));
          one.press("M8105");
          for (int looks = 0; looks < 300 && one.on("M8197"); ++looks) one.run(200);
          const std::string which = "mode " + std::to_string(mode) + " from " +
                                    std::to_string(direction * from) + ", C " + std::to_string(count) +
                                    ", rpm " + std::to_string(rpm);
          EXPECT_EQ(one.on("M8195"), expected.is_home) << which;
          EXPECT_EQ(one.get("D8094"), expected.is_home ? 0 : 15) << which;
          if (!expected.is_home && expected.end != 99'000) continue;  // it stays wherever it has stopped
          EXPECT_NEAR(static_cast<double>(one.get("D8140")), direction * (expected.end - from),
                      is_by_ramp ? 1 + rpm / 500 : 0)
              << which;
        }
      }
    }
  }
}

/// The manual's second example (《X32.》): downwards, to the DOG's edge, which is displayed as -100.000.
TEST(Super40ncHoming, SecondExampleShowsItsPlace) {
  OneSuper40nc one(machine(-1));
  one.set("D9121", 1);
  one.set("D9181", 1);
  one.set("D9182", -100'000);
  one.press("M8105");
  one.run_while("M8197");
  EXPECT_TRUE(one.on("M8195"));
  EXPECT_EQ(one.get("D8117"), -100'000);
  EXPECT_EQ(one.get("D8140"), -100'000);
}

TEST(Super40ncHoming, LeavesTheDogFirst) {
  for (const Case& each : {kCases[1], kCases[4], kCases[9], kCases[11]}) {
    for (const int from : {50000, 55000, 70000}) {
      OneSuper40nc one(machine(+1, from));
      prepare(one, each.mode, +1);
      one.press("M8105");
      one.run_while("M8197");
      EXPECT_TRUE(one.on("M8195"));
      EXPECT_EQ(one.get("D8140"), each.end - from) << each.mode << " " << from;
    }
  }
}

/// The manual's first example (《X32.》): the third C signal after the reversal, and an offset.
TEST(Super40ncHoming, WorkedExampleEndsAtItsPlace) {
  Given given = machine(+1);
  given.plant[0].lower_limit.reset();
  OneSuper40nc one(given);
  prepare(one, 4, +1);
  one.set("D9122", 2);
  one.set("D9183", -200000);
  one.press("M8105");
  one.run_while("M8197");
  EXPECT_EQ(one.get("D8140"), -160000);
  EXPECT_EQ(one.get("D8171"), 3);
  EXPECT_TRUE(one.on("M8195"));
}

TEST(Super40ncHoming, SetsItsCounters) {
  OneSuper40nc one(machine(-1));
  one.set("D9121", 1);
  one.set("D9181", 1);
  one.set("D9182", -100000);
  one.set("D9171", 2);
  one.set("D8117", 55);
  one.set("D8143", 5);
  one.press("M8105");
  one.run_while("M8197");
  EXPECT_EQ(one.get("D8117"), -100000);
  EXPECT_EQ(one.get("D8140"), -200000);
  EXPECT_EQ(one.get("D8143"), 0);
}

TEST(Super40ncHoming, ALatchTakesTheDogsEdge) {
  OneSuper40nc one(machine(+1));
  prepare(one, 0, +1);
  one.press("M8105");
  one.run_while("M8197");
  EXPECT_EQ(one.get("D8165"), 50000);
}

void expect_failure(OneSuper40nc& one, Value code) {
  one.run_while("M8197");
  EXPECT_FALSE(one.on("M8195"));
  EXPECT_FALSE(one.on("M8197"));
  EXPECT_EQ(one.on("M8124"), code != 0);
  EXPECT_EQ(one.get("D8094"), code);
}

TEST(Super40ncHoming, FailsAtTheLimit) {
  for (const int mode : {0, 1, 2, 3, 4, 5, 9, 10, 11}) {
    Given given = machine(+1);
    given.plant[0].home.reset();
    OneSuper40nc one(given);
    prepare(one, mode, +1);
    one.press("M8105");
    expect_failure(one, 15);
    EXPECT_EQ(one.get("D8140"), 99000) << mode;
  }
}

TEST(Super40ncHoming, FailsOnAShortPlate) {
  for (const auto& [mode, code] :
       {std::pair{0, 0}, std::pair{1, 15}, std::pair{4, 15}, std::pair{5, 15}, std::pair{11, 15}}) {
    Given given = machine(+1);
    given.plant[0].home = world::PulseSpan{50000, 50100};
    OneSuper40nc one(given);
    prepare(one, mode, +1);
    one.press("M8105");
    one.run_while("M8197");
    EXPECT_EQ(one.on("M8195"), code == 0) << mode;
    EXPECT_EQ(one.get("D8094"), code) << mode;
  }
}

TEST(Super40ncHoming, NeedsTheLimitThatItLooksFor) {
  for (const int mode : {6, 7, 8, 12}) {
    OneSuper40nc one(machine(+1));
    prepare(one, mode, +1);
    one.set("D9163", 0);
    one.press("M8105");
    expect_failure(one, 15);
    EXPECT_EQ(one.get("D8140"), 0);
  }
}

TEST(Super40ncHoming, FailsOrIsGivenUpByWhatStopsIt) {
  for (const auto& [contact, code] : {std::pair{"M8102", 0}, std::pair{"M8584", 0}, std::pair{"M8002", 19}}) {
    OneSuper40nc one(machine(+1));
    prepare(one, 4, +1);
    one.press("M8105");
    one.run(200);
    one.set(contact, 1);
    one.run(1);
    expect_failure(one, code);
  }
  OneSuper40nc one(machine(+1));
  prepare(one, 4, +1);
  one.press("M8105");
  one.run(200);
  one.input("ALM_X", 1);
  one.run(1);
  expect_failure(one, 15);
}

TEST(Super40ncHoming, OrdersWaitForEachOther) {
  Given given = machine(+1);
  given.plant[1] = given.plant[2] = given.plant[0];
  OneSuper40nc one(given);
  one.set("D9199", 2);
  one.set("D9299", 4);
  one.set("D9399", 2);
  one.press("M8592");
  EXPECT_TRUE(one.on("M8197") && one.on("M8397"));
  EXPECT_FALSE(one.on("M8297"));
  one.run_while("M8197");
  one.run(2);
  EXPECT_TRUE(one.on("M8297"));
  one.run_while("M8297");
  for (const char* done : {"M8195", "M8295", "M8395"}) EXPECT_TRUE(one.on(done)) << done;
  EXPECT_FALSE(one.on("M8495"));
}

TEST(Super40ncHoming, NoFurtherOrderFollowsAFailure) {
  Given given = machine(+1);
  given.plant[1] = given.plant[0];
  given.plant[0].home.reset();
  OneSuper40nc one(given);
  one.set("D9199", 1);
  one.set("D9299", 2);
  one.press("M8592");
  one.run_while("M8197");
  one.run(100);
  EXPECT_FALSE(one.on("M8297"));
  EXPECT_FALSE(one.on("M8295"));
}

}  // namespace homing_test
}  // namespace understudy::emulator::models::super_40nc
