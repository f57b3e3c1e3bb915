// Random days of a SUPER-40NC in three worlds: one runs tick by tick, one skips many ticks in one step, and
// one is sometimes replaced by a snapshot of the first. They stay equal, in the middle of everything:
// programs of all areas, arcs, homing, the wheel, files, recipes, power and frames on both lines.
// UNDERSTUDY_SEED and UNDERSTUDY_COURSES override.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "emulator/world/snapshot.h"
#include "tests/emulator/models/super_40nc/listings.h"
#include "tests/emulator/world/same_world.h"
#include "tests/sanitized.h"

namespace understudy::emulator::models::super_40nc {
namespace super_40nc_fast_forward_test {

/// They settle: only counters change in a scan.
constexpr const char* kPlc =
    "AREA PLC\nLD M1\nOUT T0 K700\nLD T0\nOUT Y20\nLDP X20\nINC D0\nLD M2\nOUT C0 K3\nLD C0\nSET Y21\nEND\n";
constexpr const char* kCuriousPlc =
    "AREA PLC\nLD>= D8117 K1000\nOUT Y20\nLD M8220\nOUT Y21\nLD M1\nOUT T1 K300\nMOV T1 D5\nEND\n";
constexpr const char* kActingPlc =
    "AREA PLC\nLD M1\nOUT T60 K400\nLDP T60\nINC D600\nLD X20\nPJG * * * K1\nLD X21\nMJG * * K1\nLDP X22\n"
    "MOV D600 D9002\nLD X23\nSTP * * * K1\nLD M2\nRPM K100 * K200\nDRV * * K3000\nEND\n";
/// C owns X and Y.
constexpr const char* kSteps =
    "AREA C\nF K30000\nXYP\nLIN K2000 K1000\nLAB K1\nCCW K4000 K1000 K1000\nCW * * K500 K-700\nTMR K333\n"
    "LIN K2000 K1000\nINCC\nC3P K300 K900 K2000 K100\nABSC\nDRV K1000 K-800\nWTN X24\nLIN K2000 K1000\nJMP "
    "K1\nEND\n"
    "FILE 3\nF K10000\nLIN K500\nTMR K2000\nLIN K-500\nEND\n"
    "AREA Z\nHOM K1\nRPM K200\nDRV K4000\nMRK K5000\nINC D700\nMOV D700 D9002\nEND\n"
    "AREA U\nVDRV K150\nTMR K700\nVDRV K-60\nVDRV K0\nMPG K3\nWAT X25\nMPG K0\nSTR * * K1\nEND\n";

struct Act {
  std::string name;  // a register, a terminal, the power, or a frame
  Value value = 0;
};

Act draw(std::mt19937_64& random) {
  const auto below = [&](int max) { return std::uniform_int_distribution<int>(0, max - 1)(random); };
  const std::string axis = std::to_string(1 + below(4));
  switch (below(22)) {
    case 0:
    case 1: return {"M8" + axis + "0" + std::to_string(3 + below(2)), below(2)};
    case 2: return {"M8" + axis + "06", below(2)};
    case 3: return {"D8" + axis + "17", below(20000) - 10000};
    case 4: return {"M" + std::to_string(1 + below(2)), below(2)};
    case 5: return {"X" + std::to_string(below(30)), below(2)};
    case 6: return {"D8022", below(3)};
    case 7: return {"M8" + axis + "02", below(2)};
    case 8: return {"M8" + axis + "05", below(2)};
    case 9:
    case 10: return {"MPG", below(200)};
    case 11:
    case 12:
    case 13: return {"M8" + std::to_string(below(5)) + "00", below(4) == 0 ? 0 : 1};
    case 14: return {"M8006", below(2)};
    case 15: return {"M85" + std::to_string(88 + below(10)), below(2)};
    case 16: return {"M800" + std::to_string(below(2) * 3 + 1), below(4) == 0 ? 1 : 0};
    case 17: return {"M8002", below(3) == 0 ? 1 : 0};
    case 18: return {below(2) == 0 ? "D9001" : "D9002", below(4)};
    case 19: return {"D8005", below(200)};
    case 20: return {"frame", below(2)};
    default: return {below(6) == 0 ? "power" : "D8020", below(5)};
  }
}

void act_on(OneSuper40nc& one, const Act& act) {
  if (act.name == "power") {
    one.world().switch_power(0, false);
    one.world().switch_power(0, true);
  } else if (act.name == "frame") {
    one.world().receive(static_cast<std::size_t>(act.value), world::hex("00 03 1E 00 00 02 C3 F2"));
  } else if (act.name[0] == 'X' || act.name == "MPG") {
    one.input(act.name, static_cast<std::int32_t>(act.value));
  } else {
    one.set(act.name, act.value);
  }
}

Given drawn(std::uint64_t seed) {
  Given given{
      .set = {{"D9003", 2}, {"D9390", 200}, {"D9157", 1}, {"D9156", 90}, {"D9257", 2}, {"D9256", 60}}};
  given.set.emplace_back("D9128", 0);
  const char* const plcs[] = {"", kPlc, kCuriousPlc, kActingPlc};
  given.program = plcs[seed % 4];
  if (seed % 3 != 0) given.program += kSteps;
  world::PlantSetup plant;
  plant.home = world::PulseSpan{3000, 5000};
  plant.upper_limit = 9000;
  plant.lower_limit = -7000;
  plant.encoder_counts_per_revolution = 1000;
  plant.pulses_per_revolution = 4000;
  plant.index = world::IndexSetup{.at = 0, .width = 1, .period = 4000};
  given.plant[0] = plant;
  if (seed % 2 == 0) given.set.emplace_back("D9200", 3);  // Y reversed
  given.plant[1] = given.plant[2] = plant;
  return given;
}

std::uint64_t number_from(const char* name, std::uint64_t usual) {
  const char* const given = std::getenv(name);
  return given != nullptr ? std::strtoull(given, nullptr, 10) : usual;
}

TEST(Super40ncFastForward, IsTheSameAsSingleTicks) {
  const std::uint64_t first = number_from("UNDERSTUDY_SEED", 1);
  std::uint64_t ticks_skipped = 0;
  for (std::uint64_t seed = first;
       seed < first + number_from("UNDERSTUDY_COURSES", fewer_if_sanitized(60U, 4U)); ++seed) {
    std::mt19937_64 random(seed);
    const Given given = drawn(seed);
    OneSuper40nc single(given);
    OneSuper40nc skipped(given);
    OneSuper40nc restored(given);
    single.world().set_bulk_ticks(false);
    for (int acts = 0; acts < 40; ++acts) {
      const Act act = draw(random);
      for (OneSuper40nc* const one : {&single, &skipped, &restored}) act_on(*one, act);
      const Tick ticks = std::uniform_int_distribution<Tick>(1, acts % 5 == 0 ? 3000 : 200)(random);
      const Tick before = std::uniform_int_distribution<Tick>(0, ticks)(random);
      for (Tick i = 0; i < before; ++i) single.run(1);
      if (acts % 3 == 0) {
        world::restore(restored.world(), world::save(single.world()));
      } else {
        restored.run(before);
      }
      for (Tick i = before; i < ticks; ++i) single.run(1);
      restored.run(ticks - before);
      skipped.run(ticks);
      for (OneSuper40nc* const other : {&skipped, &restored}) {
        ASSERT_TRUE(world::same_state(single.world(), other->world()))
            << "seed " << seed << ", act " << acts << " " << act.name << " = " << act.value << ", "
            << (other == &skipped ? "crossed" : "restored");
      }
    }
    ticks_skipped += skipped.world().ticks_skipped();
    EXPECT_EQ(single.world().ticks_skipped(), 0U);
  }
  EXPECT_GT(ticks_skipped, 10'000U) << "meaningful only if much is";
}

/// Also if an input has changed since the last tick.
TEST(Super40ncFastForward, ARestoredWorldIsTheOneThatWasSaved) {
  for (const std::string input : {"X0", "X1", "X4", "X7", "X20", "ALM_Y", "CEMG", "PLC_RUN"}) {
    OneSuper40nc one(drawn(7));
    one.set("M8103", 1);
    one.run(300);
    one.input(input, input == "PLC_RUN" ? 0 : 1);
    const world::WorldState saved = world::save(one.world());
    world::restore(one.world(), saved);
    EXPECT_EQ(world::difference(one.world(), saved, world::save(one.world())), "") << input;
    OneSuper40nc other(drawn(7));
    world::restore(other.world(), saved);
    EXPECT_EQ(world::difference(one.world(), saved, world::save(other.world())), "") << input;
    for (OneSuper40nc* each : {&one, &other}) each->run(100);
    EXPECT_TRUE(world::same_state(one.world(), other.world())) << input;
  }
}

/// A settled PLC and axes at rest cost almost nothing: an hour of it.
TEST(Super40ncFastForward, ASettledDeviceCostsNoTicks) {
  OneSuper40nc one({.program = kPlc});
  one.set("M1", 1);
  one.run(3'600'000);
  EXPECT_TRUE(one.output("Y20"));
}

}  // namespace super_40nc_fast_forward_test
}  // namespace understudy::emulator::models::super_40nc
