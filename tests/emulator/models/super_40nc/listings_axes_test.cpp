// The manual's listings of single axes and of programs that act on each other, on the whole controller.
#include <gtest/gtest.h>

#include "tests/emulator/models/super_40nc/listings.h"

namespace understudy::emulator::models::super_40nc {
namespace listings_axes_test {

const Set kOfC{{"D9003", 4}};

/// The PLC has just commanded a DRV: each axis reaches its position in its own time; 0 s: it does not move.
void expect_drives(OneSuper40nc& one, const std::array<double, 4>& seconds, const Places& end) {
  std::array<Tick, 4> took{};
  for (Tick tick = 1; tick < 20'000; ++tick) {
    one.run(1);
    bool moves = false;
    for (std::size_t axis = 0; axis < 4; ++axis) {
      if (!one.on("M8" + std::to_string(axis + 1) + "20")) continue;
      moves = true;
      took[axis] = tick;
    }
    if (!moves) break;
  }
  for (std::size_t axis = 0; axis < 4; ++axis) {
    EXPECT_NEAR(static_cast<double>(took[axis]), seconds[axis] * 1000, seconds[axis] > 0 ? kTolerance_ms : 0)
        << "axis " << axis;
  }
  EXPECT_EQ(positions(one), end);
}

void m9(const std::string& program) {
  OneSuper40nc one({.program = program});
  one.input("X10", 1);
  expect_drives(one, {0, drive_s(1500, 200), drive_s(3000, 300), 0}, {0, 1500, 3000, 0});
  one.input("X10", 0);  // the limit of U
  one.run(2);
  one.input("X11", 1);
  expect_drives(one, {drive_s(4000, 100), 0, 0, drive_s(6500, 400)}, {4000, 1500, 3000, 6500});
}

void m10(const std::string& program) {
  OneSuper40nc one({.program = program});
  expect_legs(one, 1, {{4, drive_s(2500, 200), {2500, 0, 0, 0}}, {12, drive_s(1300, 200), {1200, 0, 0, 0}}});
}

void m11(const std::string& program) {
  OneSuper40nc one({.program = program});
  one.set("D400", -1000);
  one.set("D401", 7000);
  one.input("X12", 1);
  expect_drives(one, {drive_s(2000, 100), drive_s(3000, 150), drive_s(4000, 200), drive_s(5000, 250)},
                {2000, 3000, 4000, 5000});
  one.input("X13", 1);
  expect_drives(one, {drive_s(3000, 300), drive_s(4000, 350), 0, 0}, {-1000, 7000, 4000, 5000});
  one.input("X14", 1);
  expect_drives(one, {drive_s(1000, 100), drive_s(7000, 100), drive_s(4000, 100), drive_s(5000, 100)}, {});
}

void m12(const std::string& program) {
  OneSuper40nc one({.set = kOfC, .program = program});
  expect_legs(one, 0,
              {{4, 0.271, {2800, 5500, 4000, 0}},
               {8, 0.260, {2800, 7200, 4000, 8000}},
               {16, 0.550, {6400, 7200, 8000, 8000}}});
}

void m13(const std::string& program) {
  OneSuper40nc one({.program = program});
  expect_legs(one, 2, {{4, 2.260, {0, 15'000, 0, 0}}, {12, 6.760, {0, 60'000, 0, 0}}});
}

void m14(const std::string& program) {
  Given given{.program = program};
  for (int axis = 0; axis < 4; ++axis) {
    given.plant[axis].home = world::PulseSpan{10'000 * (axis + 1), 10'000 * (axis + 1) + 9000};
    given.plant[axis].index = world::IndexSetup{.at = 0, .width = 1, .period = 4000};
  }
  // Mode 4: after the DOG's edge, at the first C signal on the way back.
  const Places at{8000, 20'000, 28'000, 40'000};
  for (const bool all : {true, false}) {
    OneSuper40nc one(given);
    for (int axis = 1; axis <= 4; ++axis) {
      const std::string x = std::to_string(axis);
      one.set("D9" + x + "28", 0);  // COUNTER1 keeps its pulses
      one.set("D9" + x + "82", 100 * axis);
    }
    one.input(all ? "X12" : "X13", 1);
    one.run(2);
    for (int axis = 1; axis <= 4; ++axis) {
      const std::string x = std::to_string(axis);
      const bool homes = all || axis % 2 == 1;
      EXPECT_EQ(one.on("M8" + x + "97"), homes) << axis;
    }
    one.run(20'000);
    for (int axis = 1; axis <= 4; ++axis) {
      const std::string x = std::to_string(axis);
      const bool homes = all || axis % 2 == 1;
      EXPECT_EQ(one.on("M8" + x + "95"), homes) << axis;
      EXPECT_EQ(one.get("D8" + x + "17"), homes ? 100 * axis : 0) << axis;
      EXPECT_EQ(one.get("D8" + x + "40"), homes ? at[static_cast<std::size_t>(axis - 1)] : 0) << axis;
    }
  }
}

void m15(const std::string& program) {
  world::PlantSetup plant;
  plant.home = world::PulseSpan{20'000, 40'000};
  plant.index = world::IndexSetup{.at = 0, .width = 1, .period = 4000};
  OneSuper40nc one({.set = Set{{"D9182", 500}}, .plant = {{0, plant}}, .program = program});
  one.set("M8100", 1);
  const Pulse pulse = pulse_of(one, "Y0");
  EXPECT_NEAR(static_cast<double>(pulse.before), drive_s(1200, 100) * 1000, kTolerance_ms);
  EXPECT_FALSE(one.on("M8197") || one.on("M8100"));
  EXPECT_TRUE(one.on("M8195"));
  EXPECT_EQ(positions(one), (Places{500, 0, 0, 0}));
  one.set("M8100", 1);
  bool homed = false;
  while (one.run(1), one.on("M8100")) {
    EXPECT_EQ(one.output("Y0"), one.on("M8197") || homed);
    homed = one.on("M8197");
  }
}

void m16(const std::string& program) {
  OneSuper40nc one({.program = program});
  one.run(1);
  struct Act {
    const char* input;
    bool on;
    Value axis;   // D8020
    Value ratio;  // D8021
  };
  std::int32_t turned = 0;
  Places at{};
  for (const auto& [input, on, axis, ratio] : {Act{"X16", true, 1, 0},
                                               {"X17", true, 2, 0},
                                               {"X17", false, 2, 0},
                                               {"X20", true, 2, 1},
                                               {"X18", true, 3, 1},
                                               {"X21", true, 3, 2},
                                               {"X21", false, 3, 2},
                                               {"X19", true, 4, 2},
                                               {"X20", false, 4, 0},
                                               {"X19", false, 4, 0},
                                               {"X16", false, 0, 0},
                                               {"X17", true, 2, 0}}) {
    put(one, input, on);
    one.run(2);
    EXPECT_EQ(one.get("D8020"), axis) << input << on;
    EXPECT_EQ(one.get("D8021"), ratio) << input << on;
    for (int count = 0; count < 3; ++count) {  // one per tick, as X12 allows
      one.input("MPG", ++turned);
      one.run(1);
    }
    one.run(1);
    const Value lengths[] = {1, 10, 100};
    if (axis > 0) at[static_cast<std::size_t>(axis - 1)] += 3 * lengths[ratio];
    EXPECT_EQ(positions(one), at) << input << on;
  }
}

void m17(const std::string& program) {
  OneSuper40nc one({.set = kOfC, .program = program});
  one.set("M8000", 1);
  one.run(3);
  // No faster than X12, one count per tick.
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

/// To the target, then at creep speed (20 rpm) during the search; a mark ends it at once.
double mark_s(double distance, double rpm, double creep_distance, bool has_mark) {
  const double v = pps_of(rpm);
  const double creep = pps_of(20);
  const double ramps = v * v / (2 * kSlope) + (v * v - creep * creep) / (2 * kSlope);
  const double last_ramp = has_mark ? 0 : creep / (2 * kSlope);
  return v / kSlope + (v - creep) / kSlope + (distance - ramps) / v + creep_distance / creep + last_ramp;
}

void m18(const std::string& program) {
  const Set set{{"D9003", 4}, {"D9163", 0}, {"D9164", 0}, {"D9263", 0}, {"D9264", 0}, {"D9190", 300}};
  for (const bool has_marks : {true, false}) {
    Given given{.set = set, .program = program};
    if (has_marks) {
      given.plant[1].upper_limit = 10'200;
      given.plant[1].lower_limit = -100;
    }
    OneSuper40nc one(given);
    one.set("D8117", 77);
    one.set("D8217", 77);
    const Value up = has_marks ? 10'200 : 10'500;
    const Value down = has_marks ? -100 : 0;
    expect_legs(one, 0,
                {{9, mark_s(5000, 50, 300, false), {5300, 0, 0, 0}},
                 {15, mark_s(10'000, 100, static_cast<double>(up - 10'000), has_marks), {5300, up, 0, 0}},
                 {21, mark_s(10'000, 100, has_marks ? 300 : 500, has_marks), {5300, down, 0, 0}}});
    EXPECT_EQ(one.get("D9290"), -500);
    EXPECT_EQ(one.get("D8094"), 0);
  }
}

void m19(const std::string& program) {
  OneSuper40nc one({.program = program});
  one.set("M8200", 1);
  struct Look {
    Tick at;
    double rpm;
  };
  Tick now = 0;
  for (const auto& [at, rpm] : {Look{1000, 100},
                                {1990, 100},
                                {2020, 50},
                                {3990, 50},
                                {4060, 350},
                                {5590, 350},
                                {5700, -150},
                                {7100, -150},
                                {7180, -30},
                                {9100, -30}}) {
    one.run(at - now);
    now = at;
    EXPECT_NEAR(one.device().axes()->speed_pps(1), pps_of(rpm), 1) << at;
  }
  // 2000 + 2000 + 1600 ms, a ramp from 350 rpm, 1500 + 2000 ms, a ramp from 30 rpm.
  const Tick end = now + one.run_while("M8200");
  EXPECT_NEAR(static_cast<double>(end), 9100 + (pps_of(350) + pps_of(30)) / kSlope * 1000, 2 * kTolerance_ms);
  one.run(1);
  EXPECT_FALSE(one.on("M8220"));
  EXPECT_EQ(one.get("D8000"), 0);
}

void m20(const std::string& program) {
  for (const auto& [selected, rpm] : {std::pair{0, 50.0}, {1, 100.0}, {2, 250.0}}) {
    OneSuper40nc one({.program = program});
    one.set("D8022", selected);
    for (const auto& [input, first, way] : {std::tuple{"X0", 0, +1}, {"X1", 2, -1}}) {
      one.input(input, 1);
      one.run(1000);
      for (int axis = 0; axis < 4; ++axis) {
        const bool runs = axis / 2 == first / 2;
        EXPECT_NEAR(one.device().axes()->speed_pps(axis), runs ? way * pps_of(rpm) : 0, 1) << axis;
      }
      one.input(input, 0);
      const double ramp_s = pps_of(rpm) / kSlope;
      one.run(static_cast<Tick>(ramp_s * 1000) - 1);
      const std::string status = first == 0 ? "M8120" : "M8320";
      EXPECT_TRUE(one.on(status));
      one.run(3);
      EXPECT_FALSE(one.on(status));
      const double distance = pps_of(rpm) * 1.0;  // a ramp up and one down
      const Places at = positions(one);
      EXPECT_NEAR(static_cast<double>(at[static_cast<std::size_t>(first)]), way * distance,
                  pps_of(rpm) * 0.002);
      EXPECT_EQ(at[static_cast<std::size_t>(first)], at[static_cast<std::size_t>(first) + 1]);
    }
  }
}

void m21(const std::string& program) {
  OneSuper40nc one({.program = program});
  one.set("M8100", 1);
  one.run(2);
  EXPECT_FALSE(one.on("Y0"));  // the printed comparison is true at once
  const Tick took = 2 + one.run_while("M8100");
  EXPECT_NEAR(static_cast<double>(took), 760 + 760, 2 * kTolerance_ms);
  EXPECT_EQ(positions(one), Places{});
  // From above it is never true.
  one.set("D8117", 4900);
  one.set("M8100", 1);
  one.run(2000);
  EXPECT_EQ(positions(one), (Places{5000, 0, 0, 0}));
  EXPECT_TRUE(one.on("Y0") && one.on("M8100"));
  // The intended comparison: Y0 goes OFF when X passes 4.800.
  std::string meant = program;
  meant.replace(meant.find("LD<="), 4, "LD>=");
  OneSuper40nc other({.program = meant});
  other.set("M8100", 1);
  const Pulse pulse = pulse_of(other, "Y0");
  EXPECT_EQ(pulse.before, 1);
  EXPECT_NEAR(static_cast<double>(other.get("D8117")), 4800, pps_of(100) / 1000 + 1);
  other.run_while("M8100");
  EXPECT_EQ(positions(other), Places{});
}

constexpr const char* kFiveThatRun =
    "\nAREA C\nLAB K1\nTMR K100\nJMP K1\nEND\nAREA X\nLAB K1\nDRV K90000\nDRV K0\nJMP K1\nEND\n"
    "AREA Y\nLAB K1\nDRV K90000\nDRV K0\nJMP K1\nEND\nAREA Z\nVDRV K100\nTMR K9000\nEND\n"
    "AREA U\nVDRV K-100\nTMR K9000\nEND\n";
const char* const kContacts[] = {"M8000", "M8100", "M8200", "M8300", "M8400"};
const char* const kPointers[] = {"D8000", "D8100", "D8200", "D8300", "D8400"};

void m22(const std::string& program) {
  for (const bool all : {true, false}) {
    OneSuper40nc one({.program = program + kFiveThatRun});
    for (const char* contact : kContacts) one.set(contact, 1);
    one.run(700);
    for (const char* contact : kContacts) EXPECT_TRUE(one.on(contact));
    const Places before = positions(one);
    put(one, all ? "X13" : "M100", true);
    one.run(1);
    const Places after = positions(one);
    one.run(300);
    for (std::size_t i = 0; i < 5; ++i) {
      const bool stops = all || i == 2 || i == 3;
      EXPECT_EQ(one.on(kContacts[i]), !stops) << kContacts[i];
      if (stops) {
        EXPECT_EQ(one.get(kPointers[i]), 0);
      }
      if (i == 0) continue;
      EXPECT_EQ(after[i - 1] == before[i - 1], stops) << "at once: " << kContacts[i];
      EXPECT_EQ(positions(one)[i - 1] == before[i - 1], stops) << kContacts[i];
    }
  }
}

void m23(const std::string& program) {
  for (const bool m20 : {true, false}) {
    OneSuper40nc one({.program = program + "\nAREA Y\nDRV K90000\nEND\n"});
    put(one, "M20", m20);
    one.set("M8200", 1);
    one.run(500);
    const Value y = one.get("D8217");
    EXPECT_GT(y, 0);
    if (m20) {
      run_through(one, "M8100");
      EXPECT_FALSE(one.on("M8200"));
      EXPECT_NEAR(static_cast<double>(one.get("D8217")), static_cast<double>(y), pps_of(100) * 0.002);
      const Value stands = one.get("D8217");
      one.run(100);
      EXPECT_EQ(one.get("D8217"), stands);
      EXPECT_EQ(one.get("D8117"), 0);
    } else {
      one.set("M8100", 1);
      EXPECT_NEAR(static_cast<double>(one.run_while("M8100")), 2260, kTolerance_ms);
      EXPECT_EQ(one.get("D8117"), 15'000);
      EXPECT_TRUE(one.on("M8200"));
    }
  }
}

void m24(const std::string& program) {
  for (const bool all : {true, false}) {
    OneSuper40nc one({.program = program + kFiveThatRun});
    put(one, all ? "X12" : "M101", true);
    one.run(2);
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(one.on(kContacts[i]), all || i == 2 || i == 3) << i;
    one.run(500);
    for (std::size_t i = 1; i < 5; ++i) {
      EXPECT_EQ(positions(one)[i - 1] != 0, all || i == 2 || i == 3) << i;
    }
  }
}

void m25(const std::string& program) {
  OneSuper40nc one({.set = Set{{"D9003", 3}}, .program = program + "\nAREA U\nDRV K1000\nEND\n"});
  const Places there{5000, 8500, -4200, 0};
  const double path = std::sqrt(5000.0 * 5000 + 8500.0 * 8500 + 4200.0 * 4200);
  expect_legs(one, 0, {{1, move_s(path, 12'000), there}});
  EXPECT_TRUE(one.on("M8400"));  // C has already ended
  EXPECT_NEAR(static_cast<double>(one.run_while("M8400")), 160, kTolerance_ms);
  EXPECT_EQ(positions(one), (Places{5000, 8500, -4200, 1000}));
}

void m26(const std::string& program) {
  OneSuper40nc one({.program = program});
  for (const auto& [name, value] : {std::pair{"D400", 11}, {"D401", -22}, {"D402", 33}}) one.set(name, value);
  one.set("D8417", 44);
  one.set("M200", 1);
  one.run(1);
  EXPECT_EQ(positions(one), (Places{11, -22, 33, 44}));
  one.set("M200", 0);
  one.set("M100", 1);
  one.run(1);
  EXPECT_EQ(positions(one), Places{});
  for (const char* counter : {"D8140", "D8240", "D8340", "D8440"}) EXPECT_EQ(one.get(counter), 0);
}

void m27(const std::string& program) {
  OneSuper40nc one({.set = kOfC, .program = program});
  one.set("D8117", 500);
  one.set("D8217", -700);
  expect_legs(one, 0, {{4, drive_s(24'000, 100), {13'000, 24'000, 0, 0}}});
  EXPECT_EQ(one.get("D8140"), 13'000);  // from where the axes were
  EXPECT_EQ(one.get("D8240"), 24'000);
}

constexpr Listing kListings[] = {{"M9", m9},   {"M10", m10}, {"M11", m11}, {"M12", m12}, {"M13", m13},
                                 {"M14", m14}, {"M15", m15}, {"M16", m16}, {"M17", m17}, {"M18", m18},
                                 {"M19", m19}, {"M20", m20}, {"M21", m21}, {"M22", m22}, {"M23", m23},
                                 {"M24", m24}, {"M25", m25}, {"M26", m26}, {"M27", m27}};

class AxisListing : public testing::TestWithParam<Listing> {};
TEST_P(AxisListing, DoesWhatTheManualSays) { GetParam().holds(sample(GetParam().name)); }
INSTANTIATE_TEST_SUITE_P(Of, AxisListing, testing::ValuesIn(kListings), name_of_listing);

TEST(AxisListings, AreAllHere) { expect_all_of('M', 9, 99, kListings); }

}  // namespace listings_axes_test
}  // namespace understudy::emulator::models::super_40nc
