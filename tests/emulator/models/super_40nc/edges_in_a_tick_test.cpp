// The effects of the chip's comparators, its latch and the pins LTC and CLR belong to their pulse. The table
// is kind of motion x kind of edge x effect, at speeds from one pulse in 100 ms to 4,000 in one, compared
// with closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

#include "emulator/models/super_40nc/rows/terminals.h"
#include "tests/emulator/models/super_40nc/one_super40nc.h"

namespace understudy::emulator::models::super_40nc {
namespace edges_in_a_tick_test {

/// Pulses per second, as revolutions per minute of this many pulses; X's pulse with the edge, an odd one.
struct Speed {
  Value pps, rpm, pulses_per_revolution, edge;
};
constexpr Speed kSpeeds[] = {
    {10, 3, 200, 7}, {1000, 100, 600, 137}, {100'000, 1000, 6000, 1237}, {4'000'000, 2000, 120'000, 25'001}};

enum class Motion : std::uint8_t {
  jog,
  drive,
  last_of_a_drive,  // the edge lies in the millisecond in which it ends
  line,
  wheel,
};
constexpr Motion kMotions[] = {Motion::jog, Motion::drive, Motion::last_of_a_drive, Motion::line,
                               Motion::wheel};

enum class Edge : std::uint8_t {
  dog,
  counter1,
  counter1_as_the_fifth,  // the axis itself has four comparators
  counter2_of_pulses,
  counter2_of_the_encoder,
  counter3_of_the_encoder,  // pulses minus counts, one count for two pulses
  counter3_of_the_wheel,
  counter4_of_pulses,
  counter4_of_the_wheel,
  remaining,
  ltc,
  clr,
};
constexpr Edge kEdges[] = {Edge::dog,
                           Edge::counter1,
                           Edge::counter1_as_the_fifth,
                           Edge::counter2_of_pulses,
                           Edge::counter2_of_the_encoder,
                           Edge::counter3_of_the_encoder,
                           Edge::counter3_of_the_wheel,
                           Edge::counter4_of_pulses,
                           Edge::counter4_of_the_wheel,
                           Edge::remaining,
                           Edge::ltc,
                           Edge::clr};

enum class Does : std::uint8_t { stops, latches, clears };

struct Cell {
  Motion motion;
  Edge edge;
  Does does;
  Speed by;

  bool is_switch() const { return edge == Edge::dog || edge == Edge::ltc || edge == Edge::clr; }
  bool is_of_the_wheel() const {
    return edge == Edge::counter4_of_the_wheel || edge == Edge::counter3_of_the_wheel;
  }
  bool can_be() const {
    if ((edge == Edge::clr) != (does == Does::clears)) return false;
    if (is_switch() && does == Does::stops) return false;
    // The wheel turns for its own motion; COUNTER3, which nothing follows, is then 0.
    if (edge == Edge::counter4_of_the_wheel && motion != Motion::wheel) return false;
    if (edge == Edge::counter3_of_the_wheel && motion == Motion::wheel) return false;
    return edge != Edge::remaining || motion == Motion::drive || motion == Motion::last_of_a_drive ||
           motion == Motion::line;
  }
  Value total() const {
    return by.edge + (motion == Motion::last_of_a_drive ? 1 + by.pps / 10'000 : 4 * by.edge);
  }
  std::string name() const {
    return "motion " + std::to_string(static_cast<int>(motion)) + " edge " +
           std::to_string(static_cast<int>(edge)) + " does " + std::to_string(static_cast<int>(does)) +
           " at " + std::to_string(by.pps);
  }
};

Given bench_of(const Cell& cell) {
  world::PlantSetup plant;
  plant.encoder_counts_per_revolution = cell.edge == Edge::counter3_of_the_encoder ? 500 : 1000;
  plant.pulses_per_revolution = 1000;
  Given given;
  if (cell.is_switch()) plant.home = world::PulseSpan{cell.by.edge, cell.by.edge + 900'000};
  if (cell.edge == Edge::ltc || cell.edge == Edge::clr) {
    plant.home_input = chip_pin_of(0, cell.edge == Edge::ltc ? kLatchPin : kClearPin);
    given.choices["pins_fitted"] = "also_clr_ltc_and_erc";
  }
  given.plant[0] = plant;
  const std::string total = std::to_string(cell.total());
  if (cell.motion == Motion::line) {
    given.set.emplace_back("D9003", 4);
    given.program = "AREA C\nF K" + std::to_string(cell.by.pps) + "\nLIN K" + total + " K" +
                    std::to_string(cell.total() / 3) + "\nEND\n";
  } else {
    given.program = "AREA X\nRPM K" + std::to_string(cell.by.rpm) + "\nDRV K" + total + "\nEND\n";
  }
  return given;
}

/// Sets a comparator: 3 to stop at once, 4 to latch, and 5 for everything else.
void compare(OneSuper40nc& one, const Cell& cell, Value source, Value number) {
  const bool stops = cell.does == Does::stops;
  const bool is_fifth = source > 3 || cell.edge == Edge::counter1_as_the_fifth;
  const int first = is_fifth ? 9146 : stops ? 9139 : 9143;
  one.set("D" + std::to_string(first), source);
  one.set("D" + std::to_string(first + 1), 1);
  one.set("D" + std::to_string(first + 2), stops ? 1 : 0);
  one.set(is_fifth ? "D8148" : stops ? "D8146" : "D8147", number);
  one.set("D9150", is_fifth ? 3 : 2);
}

void set_edge(OneSuper40nc& one, const Cell& cell) {
  const Value at = cell.by.edge;
  one.set("D9150", cell.edge == Edge::dog ? 1 : 0);
  switch (cell.edge) {
    case Edge::dog:
    case Edge::ltc: return;
    case Edge::clr: return one.set("D9127", 15);
    case Edge::counter1: return compare(one, cell, 0, at);
    case Edge::counter1_as_the_fifth:
      for (const auto& [method, action, value] : {std::tuple{"D9132", "D9133", "D8144"},
                                                  {"D9136", "D9137", "D8145"},
                                                  {"D9140", "D9141", "D8146"},
                                                  {"D9144", "D9145", "D8147"}}) {
        one.set(method, 1);
        one.set(action, 1);
        one.set(value, 90'000'000);
      }
      return compare(one, cell, 0, at);
    case Edge::counter2_of_pulses: one.set("D9123", 1); return compare(one, cell, 1, at);
    case Edge::counter2_of_the_encoder: one.set("D9123", 0); return compare(one, cell, 1, at);
    case Edge::counter3_of_the_encoder: one.set("D9124", 0); return compare(one, cell, 2, (at + 1) / 2);
    case Edge::counter3_of_the_wheel: one.set("D9124", 1); return compare(one, cell, 2, at);
    case Edge::counter4_of_pulses: one.set("D9125", 0); return compare(one, cell, 3, at);
    case Edge::counter4_of_the_wheel: one.set("D9125", 2); return compare(one, cell, 3, at);
    case Edge::remaining: return compare(one, cell, 4, cell.total() - at);
  }
}

void set_speed(OneSuper40nc& one, const Speed& by) {
  one.set("D9170", by.pulses_per_revolution);
  one.set("D9270", by.pulses_per_revolution);
  one.set("D9175", 3000);
  for (const char* const name : {"D9176", "D9177", "D9194", "D9195", "D9196"}) one.set(name, by.rpm);
}

/// Returns the counts of the wheel up to a tick: as evenly spaced as whole counts can be.
void turn(OneSuper40nc& one, const Speed& by, Tick ticks) {
  one.input("MPG", static_cast<std::int32_t>(by.pps * ticks / 1000));
}

/// Returns what D8165 has latched first.
Value move(OneSuper40nc& one, const Cell& cell) {
  const char* const contact = cell.motion == Motion::jog     ? "M8103"
                              : cell.motion == Motion::wheel ? "M8108"
                              : cell.motion == Motion::line  ? "M8000"
                                                             : "M8100";
  one.set(contact, 1);
  // A line accelerates on its path, at its own rate.
  const Tick max = 5 * cell.by.edge * 1000 / cell.by.pps + (cell.motion == Motion::line ? 4000 : 3);
  for (Tick ticks = 1; ticks <= max; ++ticks) {
    if (cell.motion == Motion::wheel) turn(one, cell.by, ticks);
    one.run(1);
    // COUNTER3 has 16 bits, so it reaches its number again.
    if (cell.does == Does::latches && one.get("D8165") != 0) break;
  }
  const Value latched = one.get("D8165");
  one.set(contact, 0);
  one.run(20);
  return latched;
}

void expect_closed_form(const Cell& cell) {
  SCOPED_TRACE(cell.name());
  OneSuper40nc one(bench_of(cell));
  set_speed(one, cell.by);
  set_edge(one, cell);
  one.run(3);
  const Value latched = move(one, cell);
  const Value gone = one.world().sent_pulses(0, 0);
  switch (cell.does) {
    case Does::stops:
      EXPECT_EQ(gone, cell.by.edge);
      EXPECT_EQ(one.get("D8094"), 23);
      return;
    case Does::latches:
      EXPECT_GE(gone, cell.by.edge);
      EXPECT_EQ(latched, cell.by.edge);
      return;
    case Does::clears: EXPECT_GT(gone, cell.by.edge); EXPECT_EQ(one.get("D8140"), gone - cell.by.edge);
  }
}

TEST(Super40ncEdgesInATick, AreOfTheirPulseInEveryCellOfTheTable) {
  for (const Speed& by : kSpeeds) {
    for (const Motion motion : kMotions) {
      for (const Edge edge : kEdges) {
        for (const Does does : {Does::stops, Does::latches, Does::clears}) {
          const Cell cell{motion, edge, does, by};
          if (cell.can_be()) expect_closed_form(cell);
          if (HasFailure()) return;
        }
      }
    }
  }
}

/// A latch reads all counters at its pulse; with D9x55 they restart there.
TEST(Super40ncEdgesInATick, ALatchReadsAndClearsAllCounters) {
  for (const Speed& by : kSpeeds) {
    for (const Edge edge : {Edge::dog, Edge::ltc, Edge::counter3_of_the_encoder, Edge::counter4_of_pulses}) {
      const Cell cell{Motion::drive, edge, Does::latches, by};
      SCOPED_TRACE(cell.name());
      OneSuper40nc one(bench_of(cell));
      set_speed(one, by);
      set_edge(one, cell);
      one.set("D9155", 15);
      one.run(3);
      one.set("M8100", 1);
      while (one.get("D8165") == 0 && one.now() < 5000) one.run(1);
      const Value gone = one.world().sent_pulses(0, 0);
      const Value counts = edge == Edge::counter3_of_the_encoder ? by.edge / 2 : by.edge;
      EXPECT_EQ(one.get("D8165"), by.edge);
      EXPECT_EQ(one.get("D8166"), counts);
      EXPECT_EQ(one.get("D8167"), by.edge - counts);
      EXPECT_EQ(one.get("D8168"), by.edge);
      if (edge == Edge::dog || edge == Edge::ltc) {
        EXPECT_EQ(one.get("D8140"), gone - by.edge);
        EXPECT_EQ(one.get("D8141"), gone - by.edge);
        EXPECT_EQ(one.get("D8143"), gone - by.edge);
      }
    }
  }
}

/// The wheel turns during a jog, by 37 counts per tick: X is where it is when the count arrives.
TEST(Super40ncEdgesInATick, AreOfTheMomentOfTheWheelsCount) {
  constexpr Value kCounts = 37;
  for (const Speed& by : kSpeeds) {
    for (const Value count : {kCounts * 5 + 11, kCounts * 8, kCounts * 3 + 36}) {
      SCOPED_TRACE(std::to_string(by.pps) + ", " + std::to_string(count));
      OneSuper40nc one;
      set_speed(one, by);
      for (const auto& [name, value] : {std::pair{"D9123", Value{2}},
                                        {"D9139", Value{1}},
                                        {"D9140", Value{1}},
                                        {"D9141", Value{1}},
                                        {"D8146", count}}) {
        one.set(name, value);
      }
      one.run(3);
      one.set("M8103", 1);
      for (int ticks = 1; ticks <= 20; ++ticks) {
        one.input("MPG", static_cast<std::int32_t>(kCounts * ticks));
        one.run(1);
      }
      EXPECT_EQ(one.world().sent_pulses(0, 0), by.pps * count / kCounts / 1000);
      EXPECT_EQ(one.get("D8094"), 23);
    }
  }
}

/// D9x46 = 5: between two ticks of a ramp the speed is a straight line, and is met at its point on that.
TEST(Super40ncEdgesInATick, ASpeedIsMetWhereTheRampHasIt) {
  for (const Speed& by : {kSpeeds[2], kSpeeds[3]}) {
    const auto begin = [&](OneSuper40nc& one) {
      set_speed(one, by);
      one.set("D9176", by.rpm / 10);
      one.set("D9168", 0);
      one.set("D9169", 0);
      one.run(3);
      one.set("M8103", 1);
    };
    OneSuper40nc top;
    begin(top);
    top.run(2000);
    for (const double part_of_top : {0.35, 0.5, 0.77}) {
      const Value number = std::llround(part_of_top * static_cast<double>(top.get("D8170")));
      OneSuper40nc twin;
      begin(twin);
      double speed_before = 0, place_before = 0, speed = 0, place = 0;
      for (int ticks = 0; ticks < 2000 && speed < static_cast<double>(number); ++ticks) {
        speed_before = std::exchange(speed, static_cast<double>(twin.get("D8170")));
        place_before = std::exchange(place, static_cast<double>(twin.world().sent_pulses(0, 0)));
        twin.run(1);
      }
      ASSERT_GE(speed, static_cast<double>(number));
      OneSuper40nc one;
      for (const auto& [name, value] :
           {std::pair{"D9146", Value{5}}, {"D9147", Value{1}}, {"D9148", Value{1}}, {"D8148", number}}) {
        one.set(name, value);
      }
      begin(one);
      one.run(2000);
      const double part = (static_cast<double>(number) - speed_before) / (speed - speed_before);
      EXPECT_NEAR(static_cast<double>(one.world().sent_pulses(0, 0)),
                  place_before + part * (place - place_before), 2 + (place - place_before) / 20)
          << by.pps << " " << number;
      EXPECT_EQ(one.get("D8094"), 23);
    }
  }
}

/// D9x09 = 2: while CLR is ON COUNTER1 stays 0, so it passes nothing, and counts from then on. It does not
/// matter whether that or CLR comes first.
TEST(Super40ncEdgesInATick, AHeldCounterPassesNothing) {
  const std::pair<const char*, Value> kHeld[] = {{"D9127", 15}, {"D9109", 2}};
  for (const Speed& by : kSpeeds) {
    for (const bool is_on_before : {false, true}) {
      const Cell cell{Motion::jog, Edge::clr, Does::clears, by};
      Given given = bench_of(cell);
      given.plant[0].home = world::PulseSpan{-1'000'000, by.edge};
      OneSuper40nc one(given);
      set_speed(one, by);
      for (const auto& [name, value] : {std::pair{"D9123", Value{1}},
                                        {"D9139", Value{0}},
                                        {"D9140", Value{1}},
                                        {"D9141", Value{1}},
                                        {"D8146", by.edge - 2},
                                        {"D9143", Value{1}},
                                        {"D9144", Value{1}},
                                        {"D9145", Value{1}},
                                        {"D8147", by.edge - 3}}) {
        one.set(name, value);
      }
      if (is_on_before) one.run(3);
      for (const auto& [name, value] : kHeld) one.set(name, value);
      one.run(3);
      one.set("M8103", 1);
      one.run(6 * by.edge * 1000 / by.pps);
      // CLR goes off after the edge; COUNTER2 is the first to reach its number.
      EXPECT_EQ(one.world().sent_pulses(0, 0), by.edge + 1 + by.edge - 3) << by.pps;
      EXPECT_EQ(one.get("D8140"), by.edge - 3);
      EXPECT_EQ(one.get("D8141"), by.edge - 3);
    }
  }
}

/// D9x30 stops COUNTER2: a stopped counter passes nothing.
TEST(Super40ncEdgesInATick, ACounterThatIsStoppedPassesNothing) {
  OneSuper40nc one({.set = {{"D9130", 1}, {"D9123", 1}, {"D9139", 1}, {"D9140", 1}, {"D9141", 1}}});
  one.set("D8146", 100);
  one.run(3);
  one.set("M8103", 1);
  one.run(500);
  EXPECT_EQ(one.get("D8141"), 0);
  EXPECT_GT(one.get("D8140"), 100);
  EXPECT_TRUE(one.on("M8120"));
}

}  // namespace edges_in_a_tick_test
}  // namespace understudy::emulator::models::super_40nc
