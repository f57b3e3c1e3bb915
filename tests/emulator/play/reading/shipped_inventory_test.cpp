// The inventory of each shipped bench, alone or in a scenario, equals that of its world.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "emulator/models/models.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/world/bench_file/bench_file.h"
#include "tests/emulator/world/view/same_inventory.h"
#include "tests/sanitized.h"

namespace understudy::emulator::play {
namespace shipped_inventory_test {

TEST(ShippedInventory, IsThatOfTheWorldMadeOfTheBench) {
  int benches = 0;
  int scenarios = 0;
  for (const char* const folder : {PROJECT_FOLDER "/scenarios", PROJECT_FOLDER "/docs/fidelity/proofs"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (entry.path().extension() != ".yaml") continue;
      const std::string path = entry.path().string();
      SCOPED_TRACE(path);
      const FileKind kind = kind_of_file(path);
      if (kind == FileKind::bench) {
        world::expect_same_inventory(world::load_bench(models::all_models(), path));
        ++benches;
      } else if (kind == FileKind::scenario) {
        for (const Scenario& scenario : load_scenarios(models::all_models(), path)) {
          if (++scenarios % (is_sanitized() ? 5 : 1) == 0) world::expect_same_inventory(scenario.bench);
        }
      }
    }
  }
  EXPECT_GE(benches, 6);
  EXPECT_GE(scenarios, 1000);
}

}  // namespace shipped_inventory_test
}  // namespace understudy::emulator::play
