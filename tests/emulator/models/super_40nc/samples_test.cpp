// The manual's listings are loaded with their printed steps; moves take the times of the factory ramps; and a
// mark is searched for after the target. listings_*_test.cpp test the effect of each listing.
#include <gtest/gtest.h>

#include "tests/emulator/models/super_40nc/listings.h"

namespace understudy::emulator::models::super_40nc {
namespace samples_test {

TEST(Super40ncSamples, AllAreLoadedWithTheirSteps) {
  int loaded = 0;
  for (const auto& file : std::filesystem::directory_iterator(std::string(PROJECT_FOLDER) +
                                                              "/tests/interpreter/super_40nc/samples")) {
    const std::string name = file.path().stem();
    ++loaded;
    OneSuper40nc one({.program = sample(name)});
    EXPECT_NE(one.it().program_text(), "") << name;
    const std::string text = one.it().program_text();
    one.it().load_program(text);
    EXPECT_EQ(one.it().program_text(), text) << name;
  }
  EXPECT_EQ(loaded, 69);
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
    expect_legs(one, 1, {{4, seconds, {distance, 0, 0, 0}}});
  }
  for (const auto& [x, y, feed, seconds] :
       {std::tuple{20000, 25000, 50000, 0.715}, std::tuple{25000, 25000, 20000, 1.798}}) {
    OneSuper40nc one({.set = Set{{"D9003", 4}},
                      .program = "AREA C\nF K" + std::to_string(feed) + "\nLIN K" + std::to_string(x) + " K" +
                                 std::to_string(y) + "\nEND\n"});
    expect_legs(one, 0, {{1, seconds, {x, y, 0, 0}}});
  }
}

/// At creep speed (20 rpm) after the target, to the mark or to the end of X16.
TEST(Super40ncSamples, AMarkIsLookedForBehindTheTarget) {
  world::PlantSetup plant;
  plant.upper_limit = 10300;
  for (const bool has_mark : {true, false}) {
    Given given{.set = Set{{"D9003", 0}, {"D9163", 0}, {"D9164", 0}, {"D9190", 500}, {"D9191", 20}},
                .program = "AREA X\nRPM K100\nMRK K10000\nEND\n"};
    if (has_mark) given.plant[0] = plant;
    OneSuper40nc one(given);
    laps(one, 1);
    EXPECT_EQ(one.get("D8117"), has_mark ? 10300 : 10500);
    EXPECT_TRUE(one.output("Y0"));
    EXPECT_EQ(one.get("D8094"), 0);
  }
}

}  // namespace samples_test
}  // namespace understudy::emulator::models::super_40nc
