// The generated documentation matches the tables of today.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "emulator/device/describe/fidelity_page.h"
#include "emulator/device/model.h"
#include "emulator/models/models.h"
#include "emulator/models/slim/numbers.h"
#include "emulator/models/slim/parameters.h"
#include "emulator/world/bench_file/bench_file.h"

namespace understudy::emulator {
namespace documentation_test {

std::string contents(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(Documentation, FidelityPagesMatchTheCurrentTables) {
  for (const Model* model : models::all_models()) {
    const std::string path =
        std::string(PROJECT_FOLDER) + "/docs/fidelity/" + std::string(model->name) + ".md";
    EXPECT_EQ(contents(path), fidelity_page(*model))
        << "run: understudy describe " << model->name << " choices --format markdown > " << path;
  }
}

TEST(Documentation, TheExampleInTheBenchPageIsValid) {
  const std::string page = contents(std::string(PROJECT_FOLDER) + "/docs/bench.md");
  const std::size_t begin = page.find("```yaml\n");
  ASSERT_NE(begin, std::string::npos);
  const std::size_t first = begin + 8;
  const world::Bench bench = world::parse_bench(
      models::all_models(), page.substr(first, page.find("```\n", first) - first), "bench.md", "/tmp");
  EXPECT_EQ(bench.devices.size(), 2U);
  EXPECT_EQ(bench.wires.size(), 1U);
}

TEST(Documentation, TheSlimPageHasTheParametersOfTheTable) {
  const std::string page = contents(std::string(PROJECT_FOLDER) + "/docs/slim.md");
  for (const models::slim::ParameterDefinition& row : models::slim::kParameters) {
    const std::string name = "\n| " + std::string(row.name) + " | " + std::string(row.alias);
    const std::size_t at = page.find(name);
    ASSERT_NE(at, std::string::npos) << row.name;
    const std::string line = page.substr(at + 1, page.find('\n', at + 1) - at - 1);
    // PN50 depends on the number of modules.
    const std::string factory = row.name == "PN50" ? "by `modules`" : models::slim::text_of_real(row.factory);
    EXPECT_NE(line.find(" | " + factory + " |"), std::string::npos) << line;
  }
}

/// Each line of the page that ends in a register's name, and each list of addresses.
TEST(Documentation, TheSuper40ncPageHasTheAddressesOfTheMap) {
  const Model* const model = find_model(models::all_models(), "super-40nc");
  ASSERT_NE(model, nullptr);
  const std::string page = contents(std::string(PROJECT_FOLDER) + "/docs/super-40nc.md");
  const auto address = [&](std::string_view name) {
    const auto found = model->registers->find(name, model->firmwares.back());
    EXPECT_TRUE(found) << name;
    return found ? std::to_string(found->place.address()) : "";
  };
  const std::string claims[] = {
      "-r " + address("D8117") + " -c 1 -1 ./nc.port      # -> [" + address("D8117") + "]: 0; D8117",
      "-r " + address("M8000") + " -c 10 -1 ./nc.port         # -> [" + address("M8000") + "]: 0",
      "| `D8117`, `D8217`, `D8317`, `D8417` | positions of X, Y, Z, U in 0.001 mm | registers " +
          address("D8117") + ", " + address("D8217") + ", " + address("D8317") + ", " + address("D8417") +
          " |",
      "| `Y0`, `S0`, `M0`, `M8000` | contacts | coils " + address("Y0") + ", " + address("S0") + ", " +
          address("M0") + ", " + address("M8000") + " on |",
      "coil " + address("coil.T5") + ", registers " + address("holding.T5") + " and "};
  for (const std::string& claim : claims) EXPECT_NE(page.find(claim), std::string::npos) << claim;
}

TEST(Documentation, TheShippedBenchesAreValid) {
  for (const char* name :
       {"quickstart.yaml", "two_stations.yaml", "slim_quickstart.yaml", "super40nc_quickstart.yaml"}) {
    EXPECT_NO_THROW(
        world::load_bench(models::all_models(), std::string(PROJECT_FOLDER) + "/scenarios/" + name))
        << name;
  }
}

}  // namespace documentation_test
}  // namespace understudy::emulator
