// The manual's listings on the whole controller, with its factory's values: where they end, and when.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/emulator/models/super_40nc/one_super40nc.h"

namespace understudy::emulator::models::super_40nc {
namespace samples_test {

using Set = std::vector<std::pair<std::string, Value>>;

constexpr const char* kPositions[] = {"D8117", "D8217", "D8317", "D8417"};

std::array<Value, 4> positions(const OneSuper40nc& one) {
  std::array<Value, 4> found{};
  for (std::size_t i = 0; i < found.size(); ++i) found[i] = one.get(kPositions[i]);
  return found;
}
using Places = std::array<Value, 4>;

/// Milliseconds until a program's contact falls.
Tick play(OneSuper40nc& one, const char* contact) {
  one.set(contact, 1);
  one.run(1);
  return 1 + one.run_while(contact);
}

TEST(Super40ncSamples, AllAreLoadedWithTheirSteps) {
  int loaded = 0;
  for (const char* group : {"L", "D", "S", "M"}) {
    for (int number = 1; number <= 27; ++number) {
      for (const char* variant : {"", "a", "b"}) {
        const std::string name = group + std::to_string(number) + variant;
        std::ifstream file(std::string(PROJECT_FOLDER) + "/tests/interpreter/super_40nc/samples/" + name +
                           ".lst");
        if (!file) continue;
        ++loaded;
        OneSuper40nc one({.program = sample(name)});
        EXPECT_NE(one.it().program_text(), "") << name;
        const std::string text = one.it().program_text();
        one.it().load_program(text);
        EXPECT_EQ(one.it().program_text(), text) << name;
        one.run(50);
      }
    }
  }
  EXPECT_GE(loaded, 69);
}

TEST(Super40ncSamples, SubroutinesEndInTheirTime) {
  OneSuper40nc one({.set = Set{{"D9003", 4}}, .program = sample("S2")});
  const Tick took = play(one, "M8000");
  EXPECT_NEAR(static_cast<double>(took), 25628, 3 * 24);
  EXPECT_EQ(positions(one), (Places{60000, 50000, 0, 0}));
  EXPECT_EQ(one.get("D8000"), 0);
}

/// Factory C21 is 0: all motion is void, and only seven waits are left.
TEST(Super40ncSamples, NothingMovesWithoutC21) {
  OneSuper40nc one({.program = sample("S2")});
  const Tick took = play(one, "M8000");
  EXPECT_NEAR(static_cast<double>(took), 3500, 40);
  EXPECT_EQ(positions(one), Places{});
  EXPECT_EQ(one.get("D8094"), 16);
}

TEST(Super40ncSamples, MovesTakeTheTimesOfTheirRamps) {
  struct Case {
    int distance;
    int rpm;
    double seconds;
  };
  for (const auto& [distance, rpm, seconds] :
       {Case{1000, 100, 0.160}, Case{1000, 200, 0.095}, Case{2000, 200, 0.170}, Case{5000, 100, 0.760},
        Case{5000, 500, 0.200}, Case{10000, 200, 0.770}, Case{15000, 100, 2.260}, Case{45000, 100, 6.760}}) {
    OneSuper40nc one({.program = "AREA X\nRPM K" + std::to_string(rpm) + "\nDRV K" +
                                 std::to_string(distance) + "\nEND\n"});
    EXPECT_NEAR(static_cast<double>(play(one, "M8100")), seconds * 1000, 5) << distance << " " << rpm;
    EXPECT_EQ(one.get("D8117"), distance);
  }
  for (const auto& [x, y, feed, seconds] :
       {std::tuple{20000, 25000, 50000, 0.715}, std::tuple{25000, 25000, 20000, 1.798}}) {
    OneSuper40nc one({.set = Set{{"D9003", 4}},
                      .program = "AREA C\nF K" + std::to_string(feed) + "\nLIN K" + std::to_string(x) + " K" +
                                 std::to_string(y) + "\nEND\n"});
    EXPECT_NEAR(static_cast<double>(play(one, "M8000")), seconds * 1000, 5);
    EXPECT_EQ(positions(one), (Places{x, y, 0, 0}));
  }
}

TEST(Super40ncSamples, ArcsEndAtTheirPlacesInTheirTime) {
  struct Case {
    const char* name;
    double seconds;
    Places end;
  };
  for (const auto& [name, seconds, end] :
       {Case{"M3", 0.715 + 0.955 + 1.319, {48000, 25000, 0, 0}},
        Case{"M4", 0.715 + 88.165 / 50 + 97.374 / 50 + 2 * 0.075, {20000, 25000, 0, 0}},
        Case{"M5",
             25.0 / 50 + (280.370 + 79.630) / 360 * 2 * M_PI * 10 / 50 + 3 * 0.075,
             {20000, 15000, 0, 0}}}) {
    OneSuper40nc one({.set = Set{{"D9003", 4}, {"D9016", 0}}, .program = sample(name)});
    EXPECT_NEAR(static_cast<double>(play(one, "M8000")), seconds * 1000, 12) << name;
    EXPECT_EQ(positions(one), end) << name;
    EXPECT_EQ(one.get("D8094"), 0) << name;
  }
}

TEST(Super40ncSamples, PlanesAreChosenByTheirInstructions) {
  OneSuper40nc one({.set = Set{{"D9003", 4}}, .program = sample("M6")});
  play(one, "M8000");
  EXPECT_EQ(positions(one), (Places{62000, 18000, 0, 0}));
}

TEST(Super40ncSamples, FourAxesGoOnALine) {
  OneSuper40nc one({.set = Set{{"D9003", 4}, {"D9028", 50}}, .program = sample("M2")});
  one.set("M8000", 1);
  one.run(2);
  one.run_while("M8120");
  EXPECT_EQ(positions(one), (Places{12150, 35500, 1500, 22300}));
  EXPECT_TRUE(one.output("Y8"));
  one.run(60);
  EXPECT_FALSE(one.output("Y8"));
  one.run_while("M8000");
  EXPECT_EQ(positions(one), Places{});
}

TEST(Super40ncSamples, ModesAreAbsoluteOrRelative) {
  for (const auto& [name, end] :
       {std::pair{"M8a", Places{42000, 23000, 0, 0}}, std::pair{"M8b", Places{42000, 23000, 0, 0}}}) {
    OneSuper40nc one({.set = Set{{"D9003", 4}}, .program = sample(name)});
    play(one, "M8000");
    EXPECT_EQ(positions(one), end) << name;
  }
}

TEST(Super40ncSamples, ThePlcDrivesAxes) {
  for (const auto& [name, second] :
       {std::pair{"M7a", Places{3000, 3000, 0, 0}}, std::pair{"M7b", Places{3000, 3000, 0, 0}}}) {
    OneSuper40nc one({.program = sample(name)});
    one.set("M100", 1);
    one.run(1000);
    EXPECT_EQ(positions(one), (Places{2200, 1500, 0, 0})) << name;
    one.set("M100", 0);
    one.run(1);
    one.set("M101", 1);
    one.run(1000);
    EXPECT_EQ(positions(one), second) << name;
  }
}

TEST(Super40ncSamples, AnAxisProgramReadsItsOwnField) {
  OneSuper40nc one({.program = sample("M13")});
  const Tick took = play(one, "M8200");
  EXPECT_NEAR(static_cast<double>(took), 2260 + 6760, 12);
  EXPECT_EQ(positions(one), (Places{0, 60000, 0, 0}));
}

TEST(Super40ncSamples, EachAxisOfALineHasItsTime) {
  OneSuper40nc one({.set = Set{{"D9003", 4}}, .program = sample("M12")});
  const Tick took = play(one, "M8000");
  EXPECT_NEAR(static_cast<double>(took), 271 + 260 + 550, 12);
  EXPECT_EQ(positions(one), (Places{6400, 7200, 8000, 8000}));
}

TEST(Super40ncSamples, HomIsWaitedFor) {
  world::PlantSetup plant;
  plant.home = world::PulseSpan{20000, 40000};
  plant.index = world::IndexSetup{.at = 0, .width = 1, .period = 4000};
  OneSuper40nc one({.set = Set{{"D9182", 500}}, .plant = {{0, plant}}, .program = sample("M15")});
  one.set("M8100", 1);
  one.run(300);
  EXPECT_TRUE(one.on("M8197"));
  EXPECT_TRUE(one.output("Y0"));
  one.run_while("M8100");
  EXPECT_FALSE(one.output("Y0"));
  EXPECT_TRUE(one.on("M8195"));
  EXPECT_EQ(one.get("D8117"), 500);
}

TEST(Super40ncSamples, TheWheelIsSelectedByTheProgram) {
  OneSuper40nc one({.set = Set{{"D9003", 4}}, .program = sample("M17")});
  one.set("M8000", 1);
  one.run(3);
  // No faster than X12, a count a tick.
  std::int32_t turned = 0;
  const auto turn_to = [&](std::int32_t counts) {
    for (; turned < counts; one.run(1)) one.input("MPG", ++turned);
    one.run(2);
  };
  turn_to(100);
  EXPECT_EQ(positions(one), (Places{200, 500, -1000, 0}));
  turn_to(500);
  EXPECT_EQ(positions(one), (Places{1000, 2500, -5000, 0}));
  turn_to(510);
  EXPECT_EQ(positions(one), (Places{1020, 2550, -5000, 0}));
  one.input("X12", 1);
  one.run(5);
  EXPECT_FALSE(one.on("M8000"));
  turn_to(600);
  EXPECT_EQ(positions(one), (Places{1020, 2550, -5000, 0}));
}

TEST(Super40ncSamples, SpeedsTakeTheirSignFromRest) {
  OneSuper40nc one({.program = sample("M19")});
  one.set("M8200", 1);
  const auto pps = [](double rpm) { return rpm * 4000 / 60; };
  struct Look {
    Tick at;
    double rpm;
  };
  Tick now = 0;
  for (const auto& [at, rpm] :
       {Look{1000, 100}, Look{3000, 50}, Look{5000, 350}, Look{6500, -150}, Look{8500, -30}}) {
    one.run(at - now);
    now = at;
    EXPECT_NEAR(one.device().axes()->speed_pps(1), pps(rpm), 1) << at;
  }
  one.run_while("M8200");
  one.run(10);
  EXPECT_FALSE(one.on("M8220"));
}

TEST(Super40ncSamples, StartsAndStopsOfEachOther) {
  OneSuper40nc one({.program = sample("M24") + "\nAREA Y\nDRV K1000\nEND\nAREA Z\nDRV K2000\nEND\n"});
  one.set("M101", 1);
  one.run(3);
  EXPECT_TRUE(one.on("M8200") && one.on("M8300"));
  EXPECT_FALSE(one.on("M8100"));
  one.run(2000);
  EXPECT_EQ(positions(one), (Places{0, 1000, 2000, 0}));
}

TEST(Super40ncSamples, PositionsAreSetWithoutMotion) {
  OneSuper40nc one({.program = sample("M26")});
  one.set("D400", 11);
  one.set("D401", -22);
  one.set("D402", 33);
  one.set("M200", 1);
  one.run(3);
  EXPECT_EQ(positions(one), (Places{11, -22, 33, 0}));
  EXPECT_EQ(one.get("D8140"), 0);
  one.set("M200", 0);
  one.set("M100", 1);
  one.run(3);
  EXPECT_EQ(positions(one), Places{});
}

/// At creep (20 rpm) behind the target, to the mark or to the end of X16.
TEST(Super40ncSamples, AMarkIsLookedForBehindTheTarget) {
  world::PlantSetup plant;
  plant.upper_limit = 10300;
  for (const bool has_mark : {true, false}) {
    Given given{.set = Set{{"D9003", 0}, {"D9163", 0}, {"D9164", 0}, {"D9190", 500}, {"D9191", 20}},
                .program = "AREA X\nRPM K100\nMRK K10000\nEND\n"};
    if (has_mark) given.plant[0] = plant;
    OneSuper40nc one(given);
    play(one, "M8100");
    EXPECT_EQ(one.get("D8117"), has_mark ? 10300 : 10500);
    EXPECT_TRUE(one.output("Y0"));
    EXPECT_EQ(one.get("D8094"), 0);
  }
}

}  // namespace samples_test
}  // namespace understudy::emulator::models::super_40nc
