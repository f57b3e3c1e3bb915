// Many ticks in one step are the same as one by one: random courses of jogs, zero returns, writes, inputs and
// timers. UNDERSTUDY_SEED and UNDERSTUDY_COURSES override.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "tests/emulator/models/super_40nc/one_super40nc.h"
#include "tests/emulator/world/same_world.h"

namespace understudy::emulator::models::super_40nc {
namespace crossing_test {

constexpr const char* kPlc =
    "AREA PLC\nLD M1\nOUT T0 K700\nLD T0\nOUT Y20\nLDP X20\nINC D0\nLD M2\nOUT C0 K3\nLD C0\nSET Y21\nEND\n";
constexpr const char* kCuriousPlc =
    "AREA PLC\nLD>= D8117 K1000\nOUT Y20\nLD M8220\nOUT Y21\nLD M1\nOUT T1 K300\nMOV T1 D5\nEND\n";

struct Act {
  std::string name;  // a register, or a terminal
  Value value = 0;
  bool is_input = false;
};

Act draw(std::mt19937_64& random) {
  const auto below = [&](int most) { return std::uniform_int_distribution<int>(0, most - 1)(random); };
  const std::string axis = std::to_string(1 + below(4));
  switch (below(10)) {
    case 0:
    case 1: return {"M8" + axis + "0" + std::to_string(3 + below(2)), below(2)};
    case 2: return {"M8" + axis + "06", below(2)};
    case 3: return {"D8" + axis + "17", below(20000) - 10000};
    case 4: return {"M" + std::to_string(1 + below(2)), below(2)};
    case 5: return {"X" + std::to_string(below(30)), below(2), true};
    case 6: return {"D8022", below(3)};
    case 7: return {"M8" + axis + "02", below(2)};
    case 8: return {"M8" + axis + "05", below(2)};
    default: return {"MPG", below(200), true};
  }
}

std::uint64_t number_from(const char* name, std::uint64_t usual) {
  const char* const given = std::getenv(name);
  return given != nullptr ? std::strtoull(given, nullptr, 10) : usual;
}

TEST(Super40ncCrossing, IsTheSameAsSingleTicks) {
  const std::uint64_t first = number_from("UNDERSTUDY_SEED", 1);
  std::uint64_t ticks_crossed = 0;
  for (std::uint64_t seed = first; seed < first + number_from("UNDERSTUDY_COURSES", 60); ++seed) {
    std::mt19937_64 random(seed);
    Given given{.set = {{"D9128", 0}}, .program = seed % 3 == 0 ? "" : seed % 3 == 1 ? kPlc : kCuriousPlc};
    world::PlantSetup plant;
    plant.home = world::PulseSpan{3000, 5000};
    plant.upper_limit = 9000;
    plant.lower_limit = -7000;
    plant.encoder_counts_per_revolution = 1000;
    plant.pulses_per_revolution = 4000;
    given.plant[0] = plant;
    if (seed % 2 == 0) given.set.emplace_back("D9200", 3);  // Y turned round
    given.plant[1] = plant;
    OneSuper40nc single(given);
    OneSuper40nc crossed(given);
    single.world().set_bulk_ticks(false);
    for (int acts = 0; acts < 30; ++acts) {
      const Act act = draw(random);
      for (OneSuper40nc* const one : {&single, &crossed}) {
        if (act.is_input) {
          one->input(act.name, static_cast<std::int32_t>(act.value));
        } else {
          one->set(act.name, act.value);
        }
      }
      const Tick ticks = std::uniform_int_distribution<Tick>(1, acts % 5 == 0 ? 3000 : 200)(random);
      single.run(ticks);
      crossed.run(ticks);
      const auto a = single.device().save_state();
      const auto b = crossed.device().save_state();
      ASSERT_EQ(single.device().state_difference(a, b), "") << "seed " << seed << ", " << act.name;
      ASSERT_TRUE(world::same_state(single.world(), crossed.world())) << "seed " << seed << ", " << act.name;
    }
    ticks_crossed += crossed.world().ticks_crossed();
    EXPECT_EQ(single.world().ticks_crossed(), 0U);
  }
  EXPECT_GT(ticks_crossed, 10'000U) << "worth something only if much is";
}

/// A settled PLC and standing axes cost next to nothing: an hour of it.
TEST(Super40ncCrossing, ASettledDeviceCostsNoTicks) {
  OneSuper40nc one({.program = kPlc});
  one.set("M1", 1);
  one.run(3'600'000);
  EXPECT_TRUE(one.output("Y20"));
}

}  // namespace crossing_test
}  // namespace understudy::emulator::models::super_40nc
