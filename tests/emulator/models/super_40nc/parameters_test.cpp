// The effects of SUPER-40NC's parameters: direction, mask, backlash, counters and their sources, ramps and
// sections, units.
#include <gtest/gtest.h>

#include <cmath>

#include "emulator/models/super_40nc/model.h"
#include "tests/emulator/models/super_40nc/one_super40nc.h"

namespace understudy::emulator::models::super_40nc {
namespace parameters_test {

Given with_encoder() {
  world::PlantSetup plant;
  plant.encoder_counts_per_revolution = 1000;  // one count for 4 pulses
  plant.pulses_per_revolution = 4000;
  return {.plant = {{0, plant}}};
}

/// DRV of the PLC, from rest to rest.
void drive(OneSuper40nc& one, Value target) {
  one.set("D100", target);
  one.press("M0");
  one.run_while("M8120");
  one.run(2);
}
constexpr const char* kDrive = "AREA PLC\nLD M0\nRPM K500\nDRV D100\nEND\n";

TEST(Super40ncParameters, DirectionTurnsTheMotorOnly) {
  for (const int mode : {1, 3, 5, 6, 7}) {
    Given given = with_encoder();
    given.program = kDrive;
    OneSuper40nc one(given);
    one.set("D9100", mode);
    drive(one, 4000);
    const bool turned = mode == 3 || mode == 6;
    EXPECT_EQ(one.get("D8117"), 4000);
    EXPECT_EQ(one.get("D8141"), turned ? -1000 : 1000) << mode;
  }
  Given given = with_encoder();
  given.program = kDrive;
  OneSuper40nc one(given);
  EXPECT_EQ(one.ask(0, "00 06 23 F1 00 01"),
            "00 06 23 F1 00 01");  // the manual's wrong address: the high half
  drive(one, 4000);
  EXPECT_EQ(one.get("D8141"), 1000);
}

TEST(Super40ncParameters, AMaskedAxisCountsAndStands) {
  Given given = with_encoder();
  given.program = kDrive;
  OneSuper40nc one(given);
  one.set("D9117", 1);
  drive(one, 4000);
  EXPECT_EQ(one.get("D8140"), 4000);
  EXPECT_EQ(one.get("D8141"), 0);
}

TEST(Super40ncParameters, CountersHaveTheirSources) {
  struct Case {
    std::vector<std::pair<std::string, Value>> set;
    std::array<Value, 3> counters;  // 2 to 4, after 4000 pulses
  };
  for (const auto& [set, counters] :
       {Case{{}, {1000, 3000, 4000}}, Case{{{"D9113", 1}}, {-1000, 5000, 4000}},
        Case{{{"D9119", 1}}, {0, 4000, 4000}}, Case{{{"D9123", 1}, {"D9125", 1}}, {4000, 3000, 1000}},
        Case{{{"D9125", 3}}, {1000, 3000, 0}}, Case{{{"D9130", 7}}, {0, 0, 0}},
        Case{{{"D9130", 2}}, {1000, 0, 4000}}, Case{{{"D9126", 1}}, {1000, 3000, 4000}}}) {
    Given given = with_encoder();
    given.program = kDrive;
    OneSuper40nc one(given);
    for (const auto& [name, value] : set) one.set(name, value);
    drive(one, 4000);
    EXPECT_EQ(one.get("D8141"), counters[0]);
    EXPECT_EQ(one.get("D8142"), counters[1]);
    EXPECT_EQ(one.get("D8143"), counters[2]);
  }
}

TEST(Super40ncParameters, BacklashComesFirstAtAReversal) {
  for (const int kind : {0, 1}) {
    Given given = with_encoder();
    given.program = kDrive;
    OneSuper40nc one(given);
    one.set("D9156", 400);
    one.set("D9157", kind);
    drive(one, 4000);
    EXPECT_EQ(one.get("D8141"), 1000);  // the first motion: the play is unknown
    one.set("D100", 0);
    one.set("M0", 1);
    one.run(20);
    EXPECT_EQ(one.get("D8164") == 7, kind == 1);
    one.run_while("M8120");
    one.run(2);
    one.set("M0", 0);
    EXPECT_EQ(one.get("D8140"), 0);
    EXPECT_EQ(one.get("D8141"), kind == 1 ? -100 : 0);  // the motor went further
  }
}

TEST(Super40ncParameters, TheWheelKnowsNoBacklash) {
  OneSuper40nc one(with_encoder());
  one.set("D9156", 400);
  one.set("D9157", 1);
  one.set("M8108", 1);
  one.run(2);
  one.input("MPG", 80);
  one.run(5);
  one.input("MPG", 40);
  one.run(5);
  EXPECT_EQ(one.get("D8117"), 40);
  EXPECT_EQ(one.get("D8141"), 10);
  one.set("M8108", 0);
  one.run(2);
  one.set("M8103", 1);  // in the other direction: 400 pulses come first
  one.run(20);
  EXPECT_EQ(one.get("D8164"), 7);
  EXPECT_EQ(one.get("D8117"), 40);
}

/// 400 pulses at 20 rpm (1333 pps) take 300 ms, during which a path waits; Y has 200, which end before that.
/// D9x57 = 1: where an axis reverses; 2: at every start.
TEST(Super40ncParameters, BacklashComesBeforeAPath) {
  struct Row {
    std::int64_t x, y;                      // where C moves
    std::int64_t pulses_x[3], pulses_y[3];  // of backlash, by D9x57
  };
  constexpr Row kRows[] = {{1000, 0, {0, 0, 400}, {0, 0, 0}},
                           {2000, 500, {0, 0, 400}, {0, 0, 200}},
                           {1000, 1000, {0, -400, -400}, {0, 0, 200}},
                           {1000, 0, {0, 0, 0}, {0, -200, -200}},
                           {3000, 500, {0, 400, 400}, {0, 200, 200}}};
  for (const int kind : {0, 1, 2}) {
    OneSuper40nc one(with_encoder());
    for (const char* name : {"D9157", "D9257"}) one.set(name, kind);
    one.set("D9156", 400);
    one.set("D9256", 200);
    one.set("D9003", 4);
    one.it().load_program("AREA C\nF K20000\nLIN D100 D101\nEND");
    std::int64_t all_x = 0;
    std::int64_t all_y = 0;
    for (const Row& row : kRows) {
      one.set("D100", row.x);
      one.set("D101", row.y);
      const Value before = one.get("D8117");
      const Value before_y = one.get("D8217");
      one.set("M8000", 1);
      const std::int64_t x = row.pulses_x[kind];
      const std::int64_t y = row.pulses_y[kind];
      const Tick waits = x != 0 ? 300 : y != 0 ? 150 : 0;
      one.run(1 + waits / 2);
      if (waits > 0) {
        EXPECT_EQ(one.get("D8164"), x != 0 ? 7 : 0) << kind << ", to " << row.x;
        EXPECT_EQ(one.get("D8264") == 7, x == 0) << kind << ", to " << row.x;  // 200 have been sent in 150 ms
      }
      one.run(waits / 2);
      EXPECT_NEAR(static_cast<double>(one.get("D8117") - before), 0, 1) << kind << ", to " << row.x;
      EXPECT_NEAR(static_cast<double>(one.get("D8217") - before_y), 0, 1);
      one.run(20);
      EXPECT_NE(one.get("D8117") + one.get("D8217"), before + before_y) << kind << ", to " << row.x;
      one.run_while("M8000");
      one.run(2);
      EXPECT_EQ(one.get("D8117"), row.x);
      EXPECT_EQ(one.get("D8217"), row.y);
      all_x += x;
      all_y += y;
      EXPECT_EQ(one.it().parts().axes.chips.chip(0).backlash_sent, all_x) << kind << ", to " << row.x;
      EXPECT_EQ(one.it().parts().axes.chips.chip(1).backlash_sent, all_y) << kind << ", to " << row.x;
      EXPECT_EQ(one.get("D8141"), (row.x + all_x) / 4) << kind;  // the encoder has 1 count in 4 pulses
    }
  }
}

/// A circle reverses both axes, and nothing is corrected on it; afterwards the last direction of each counts.
TEST(Super40ncParameters, AnArcIsNotCorrectedWithin) {
  OneSuper40nc one(with_encoder());
  for (const char* name : {"D9157", "D9257"}) one.set(name, 1);
  for (const char* name : {"D9156", "D9256"}) one.set(name, 40);
  one.set("D9003", 4);
  one.it().load_program("AREA C\nXYP\nF K20000\nCCW * * K-1000 K0\nLIN K-100 K100\nEND");
  one.set("M8000", 1);
  one.run_while("M8000");
  // It ends moving up and to the right: X reverses for the line.
  EXPECT_EQ(one.it().parts().axes.chips.chip(0).backlash_sent, -40);
  EXPECT_EQ(one.it().parts().axes.chips.chip(1).backlash_sent, 0);
  EXPECT_EQ(one.get("D8117"), -100);
}

/// A pause stops within it and continues; a stop leaves the rest to the next start.
TEST(Super40ncParameters, BacklashBeforeAPathCanBeHeld) {
  OneSuper40nc one(with_encoder());
  one.set("D9157", 1);
  one.set("D9156", 400);
  one.set("D9003", 4);
  one.it().load_program("AREA C\nF K20000\nLIN D100\nEND");
  const auto go = [&](Value to) {
    one.set("D100", to);
    one.set("M8000", 1);
  };
  go(1000);
  one.run_while("M8000");
  go(0);
  one.run(150);
  one.set("M8006", 1);
  one.run(5);
  const std::int64_t held_at = one.it().parts().axes.chips.chip(0).backlash_sent;
  EXPECT_NEAR(static_cast<double>(held_at), -200, 4);
  EXPECT_EQ(one.get("D8164"), 0);
  EXPECT_TRUE(one.on("M8022"));
  one.run(500);
  EXPECT_EQ(one.it().parts().axes.chips.chip(0).backlash_sent, held_at);
  EXPECT_EQ(one.get("D8117"), 1000);
  one.set("M8006", 0);
  one.set("M8000", 1);
  one.run(100);
  EXPECT_EQ(one.get("D8164"), 7);
  one.set("M8002", 1);
  one.run(2);
  one.set("M8002", 0);
  one.run(100);
  const std::int64_t stopped_at = one.it().parts().axes.chips.chip(0).backlash_sent;
  EXPECT_NEAR(static_cast<double>(stopped_at), -334, 5);
  EXPECT_EQ(one.get("D8117"), 1000);
  go(0);
  one.run_while("M8000");
  EXPECT_EQ(one.it().parts().axes.chips.chip(0).backlash_sent, -400);
  EXPECT_EQ(one.get("D8117"), 0);
}

/// 400 pulses at 20 rpm (1333 pps) come before each of two moves in one direction, and before the return.
TEST(Super40ncParameters, SlipComesFirstAtEveryStart) {
  OneSuper40nc one(with_encoder());
  one.set("D9156", 400);
  one.set("D9157", 2);
  one.it().load_program("AREA X\nRPM K100\nDRV D100\nEND");
  Value encoder = 0;
  for (const Value target : {4000, 8000, 0}) {
    const Value before = one.get("D8117");
    one.set("D100", target);
    one.set("M8100", 1);
    one.run(20);
    EXPECT_EQ(one.get("D8164"), 7) << target;
    one.run_while("M8100");
    one.run(2);
    EXPECT_EQ(one.get("D8117"), target);
    encoder += (target - before + (target > before ? 400 : -400)) / 4;
    EXPECT_EQ(one.get("D8141"), encoder) << target;
  }
}

TEST(Super40ncParameters, LengthsAreRoundedFromTheirAbsoluteTarget) {
  OneSuper40nc one({.program = "AREA X\nINCC\nLAB K1\nDRV K10\nINC D0\nLD< D0 K30\nCJ K1\nEND\n"});
  one.set("D9171", 1);
  one.set("D9172", 36);  // 0.28 pulses each time
  one.set("M8100", 1);
  one.run(1);
  one.run_while("M8100");
  EXPECT_EQ(one.get("D8140"), 8);  // 300 / 36 = 8.33
}

TEST(Super40ncParameters, RampsHaveTheirTimesAndSections) {
  const auto pps = [](double rpm) { return rpm * 4000 / 60; };
  struct Case {
    int up_ms;
    int down_ms;
    int section;
  };
  for (const auto& [up_ms, down_ms, section] :
       {Case{500, 500, 1}, Case{1000, 500, 1}, Case{500, 1000, 1}, Case{500, 500, 20000}}) {
    OneSuper40nc one({.program = kDrive});
    one.set("D9166", up_ms);
    one.set("D9167", down_ms);
    one.set("D9168", section);
    one.set("D9169", section);
    one.set("D100", 40000);
    one.set("M0", 1);
    one.run(1);
    const Tick took = 1 + one.run_while("M8120");
    const double top = pps(500);
    const double start = pps(1);
    const double step = 300 / std::floor(300 * 65535 / top);
    const auto ramp_s = [&](int ms) {
      return (top - start + 2 * section * step) / (pps(5000) / (ms / 1000.0));
    };
    const double mean = (top + start) / 2;
    const double ramps = mean * (ramp_s(up_ms) + ramp_s(down_ms));
    const double expected = ramp_s(up_ms) + ramp_s(down_ms) + (40000 - ramps) / top;
    EXPECT_NEAR(static_cast<double>(took), expected * 1000, 3) << up_ms << " " << down_ms << " " << section;
    EXPECT_EQ(one.get("D8117"), 40000);
  }
}

/// Above twice the acceleration the ramp starts too late, and is cut off at the target.
TEST(Super40ncParameters, ALongDecelerationIsCutOff) {
  OneSuper40nc one({.program = kDrive});
  one.set("D9167", 2000);
  one.set("D100", 40000);
  one.set("M0", 1);
  one.run(1);
  double last_pps = 0;
  while (one.on("M8120")) {
    last_pps = one.device().axes()->speed_pps(0);
    one.run(1);
  }
  // Calculated with 1000 ms, decelerated with 2000 ms: half of the speed's square is left.
  EXPECT_NEAR(last_pps, 33333.0 / std::sqrt(2.0), 300);
  EXPECT_EQ(one.get("D8117"), 40000);
}

TEST(Super40ncParameters, TheDefaultSpeedNeedsAPowerCycle) {
  OneSuper40nc one({.program = "AREA X\nDRV K60000\nEND\n"});
  const auto speed = [&] {
    one.set("M8100", 1);
    one.run(400);
    const double found = one.device().axes()->speed_pps(0);
    one.press("M8102");
    return std::lround(found);
  };
  EXPECT_EQ(speed(), 6667);
  one.set("D9178", 200);
  EXPECT_EQ(speed(), 6667);
  one.world().switch_power(0, false);
  one.world().switch_power(0, true);
  EXPECT_EQ(speed(), 13333);
}

TEST(Super40ncParameters, ThePanelsNumbersNameTheirRegisters) {
  std::map<std::string, const NamedParameterRow*> rows;
  for (const NamedParameterRow& row : model().named_parameters) rows[std::string(row.number)] = &row;
  EXPECT_EQ(rows.size(), 20U + 4 * 44U);
  EXPECT_EQ(rows["C22"]->name, "D9011");
  EXPECT_EQ(rows["C25"]->name, "D9018");
  EXPECT_EQ(rows["X14"]->name, "D9178");
  EXPECT_EQ(rows["X14"]->factory, "100");
  EXPECT_NE(rows["X14"]->meaning.find("500"), std::string_view::npos);
  EXPECT_EQ(rows["U61"]->name, "D9465");
  EXPECT_EQ(rows["C1"]->persistent, false);
}

/// The chip's registers after a start: 500 rpm, from 1 rpm, 666,667 pps per second.
TEST(Super40ncParameters, AStartIsMirrored) {
  OneSuper40nc one({.program = kDrive});
  drive(one, -4000);
  const double step = 300 / std::floor(300 * 65535 / (500 * 4000 / 60.0));
  EXPECT_EQ(one.get("D8120"), 0x53);
  EXPECT_EQ(one.get("D8121"), -4000);
  EXPECT_EQ(one.get("D8122"), std::lround(4000 / 60.0 / step));
  EXPECT_EQ(one.get("D8123"), std::lround(500 * 4000 / 60.0 / step));
  EXPECT_EQ(one.get("D8124"), std::lround(step * 19660800 / (4 * 666666.667)) - 1);
  EXPECT_EQ(one.get("D8126"), std::lround(300 / step) - 1);
  EXPECT_EQ(one.get("D8128"), 65);
  EXPECT_EQ(one.get("D8153"), one.get("D8123"));
  EXPECT_EQ(one.get("D8158"), 65);
  one.set("D8121", 7);
  EXPECT_EQ(one.get("D8121"), 7);
  drive(one, -4100);
  EXPECT_EQ(one.get("D8121"), -100);
}

}  // namespace parameters_test
}  // namespace understudy::emulator::models::super_40nc
