// With every choice, a device is a value: quiet ticks can be skipped, and a world that is saved and restored
// elsewhere continues in the same way. Each option runs the same random acts three times (seeded;
// UNDERSTUDY_SEED overrides).
#include <gtest/gtest.h>

#include <cstdlib>

#include "emulator/models/models.h"
#include "emulator/models/simple2_r3/choices.h"
#include "emulator/world/snapshot.h"
#include "tests/emulator/world/busy_acts.h"
#include "tests/sanitized.h"

namespace understudy::emulator::models::simple2_r3 {
namespace choices_state_test {

constexpr int kActs = 40;
constexpr std::size_t kActsBetweenSaves = 7;

std::uint64_t seed() {
  const char* given = std::getenv("UNDERSTUDY_SEED");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : 91'001;
}

struct Chosen {
  std::string id;
  std::string option;
};

std::unique_ptr<world::World> world_of(const Chosen& chosen) {
  world::Bench bench =
      world::parse_bench(all_models(), world::two_devices("instant", 19'200), "two.yaml", ".");
  for (world::DeviceSetup& device : bench.devices) device.settings.choices[chosen.id] = chosen.option;
  return std::make_unique<world::World>(bench, world::WorldOptions{}, [](const std::string&) {});
}

/// Hashes of a life, just before each of its acts.
using Life = std::vector<std::uint64_t>;

Life live(world::World& world, const std::vector<world::Act>& acts) {
  Life life;
  for (const world::Act& act : acts) {
    world.advance_to(act.at);
    life.push_back(world::hash(world));
    act.carry_out(world);
  }
  return life;
}

Life live_in_single_ticks(const Chosen& chosen, const std::vector<world::Act>& acts) {
  const auto world = world_of(chosen);
  world->set_bulk_ticks(false);
  return live(*world, acts);
}

/// Again and again another world takes over, at any place within the acts.
Life live_in_many_worlds(const Chosen& chosen, const std::vector<world::Act>& acts) {
  auto world = world_of(chosen);
  Life life;
  for (std::size_t i = 0; i < acts.size(); ++i) {
    if (i % kActsBetweenSaves == kActsBetweenSaves - 1) {
      world->advance_to(world->now() + (acts[i].at - world->now()) / 2);
      auto next = world_of(chosen);
      world::restore(*next, world::save(*world));
      world = std::move(next);
    }
    world->advance_to(acts[i].at);
    life.push_back(world::hash(*world));
    acts[i].carry_out(*world);
  }
  return life;
}

TEST(ChoicesState, EveryOptionsStateIsSavedAndNeedsNoTickThatIsQuiet) {
  std::cout << "seed " << seed() << "\n";
  std::size_t lives = 0, options_seen = 0;
  for (const ChoiceRow& row : kChoices) {
    const auto options = options_of(row);
    for (std::size_t i = options.size() == 1 ? 1 : 0; i < options.size(); ++i) {
      if (++options_seen % (is_sanitized() ? 4U : 1U) != 0) continue;
      const Chosen chosen{std::string(row.id), std::string(options[i])};
      const std::vector<world::Act> acts = world::BusyActs(seed() + lives++).make(kActs);
      const Life life = live(*world_of(chosen), acts);
      EXPECT_EQ(life, live_in_single_ticks(chosen, acts)) << chosen.id << ": " << chosen.option;
      EXPECT_EQ(life, live_in_many_worlds(chosen, acts)) << chosen.id << ": " << chosen.option;
    }
  }
  EXPECT_GT(lives, fewer_if_sanitized(150u, 5u));
}

}  // namespace choices_state_test
}  // namespace understudy::emulator::models::simple2_r3
