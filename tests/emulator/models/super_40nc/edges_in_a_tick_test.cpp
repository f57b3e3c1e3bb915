// What the comparators and the latch of the chip read, set or stop is of their pulse: by which counter, at
// which edge, at speeds from less than a pulse a millisecond to a hundred.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/emulator/models/super_40nc/one_super40nc.h"

namespace understudy::emulator::models::super_40nc {
namespace edges_in_a_tick_test {

constexpr Value kEdge = 1237;

struct EdgeCase {
  const char* what;
  std::vector<std::pair<std::string, Value>> set;
  bool stops = false;  // at the edge; else it latches there, and its counters begin anew
};
/// COUNTER2 counts the encoder, one count for each pulse; COUNTER4 the pulses.
const EdgeCase kCases[] = {
    {"DOG", {{"D9150", 1}, {"D9155", 15}}},
    {"comparator 4 of COUNTER1", {{"D9150", 2}, {"D9155", 15}, {"D9143", 0}, {"D9144", 1}, {"D8147", kEdge}}},
    {"comparator 4 of COUNTER2", {{"D9150", 2}, {"D9155", 15}, {"D9143", 1}, {"D9144", 2}, {"D8147", kEdge}}},
    {"comparator 5 of COUNTER4", {{"D9150", 3}, {"D9155", 15}, {"D9146", 3}, {"D9147", 1}, {"D8148", kEdge}}},
    {"stop of COUNTER1", {{"D9139", 0}, {"D9140", 1}, {"D9141", 1}, {"D8146", kEdge}}, true},
    {"stop of COUNTER2", {{"D9139", 1}, {"D9140", 5}, {"D9141", 1}, {"D8146", kEdge - 1}}, true},
    {"stop of COUNTER4", {{"D9139", 3}, {"D9140", 1}, {"D9141", 1}, {"D8146", kEdge}}, true},
};

TEST(Super40ncEdgesInATick, AreOfTheirPulseByEveryCounter) {
  for (const EdgeCase& each : kCases) {
    for (const Value rpm : {5, 60, 600}) {
      SCOPED_TRACE(std::string(each.what) + " at " + std::to_string(rpm));
      world::PlantSetup plant;
      plant.home = world::PulseSpan{kEdge, kEdge + 9000};
      plant.encoder_counts_per_revolution = plant.pulses_per_revolution = 1000;
      OneSuper40nc one({.plant = {{0, plant}}});
      one.set("D9195", rpm);  // the jog's
      one.set("D9194", rpm);
      one.set("D9196", rpm);
      const bool is_dog = std::string(each.what) == "DOG";
      if (!is_dog) one.set("D9150", 0);
      for (const auto& [name, value] : each.set) one.set(name, value);
      one.run(3);
      one.set("M8103", 1);
      for (int ticks = 0; ticks < 60'000 && one.get("D8140") < kEdge && one.get("D8165") == 0; ++ticks)
        one.run(1);
      one.run(50);
      one.set("M8103", 0);
      one.run(2000);
      const std::int64_t gone = one.world().sent_pulses(0, 0);
      if (each.stops) {
        EXPECT_EQ(gone, kEdge);
        EXPECT_EQ(one.get("D8094"), 23);
        continue;
      }
      EXPECT_GT(gone, kEdge);
      for (const char* const latched : {"D8165", "D8166", "D8168"})
        EXPECT_EQ(one.get(latched), kEdge) << latched;
      for (const char* const counter : {"D8140", "D8141", "D8143"}) {
        // The DOG is there once; a counter that begins anew comes to its value again and again.
        EXPECT_EQ(one.get(counter), is_dog ? gone - kEdge : gone % kEdge) << counter;
      }
    }
  }
}

}  // namespace edges_in_a_tick_test
}  // namespace understudy::emulator::models::super_40nc
