// The documentation that is made from tables is what the tables say today.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "emulator/bench/bench_file.h"
#include "emulator/describe/fidelity_page.h"
#include "emulator/devices/slim/numbers.h"
#include "emulator/devices/slim/parameters.h"
#include "emulator/model.h"

namespace understudy::emulator {
namespace {

std::string contents(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(Documentation, fidelity_pages_are_made_from_the_tables_of_today) {
  for (const Model* model : all_models()) {
    const std::string path =
        std::string(PROJECT_FOLDER) + "/docs/fidelity/" + std::string(model->name) + ".md";
    EXPECT_EQ(contents(path), fidelity_page(*model))
        << "run: understudy describe " << model->name << " choices --format markdown > " << path;
  }
}

TEST(Documentation, the_bench_in_the_bench_page_is_valid) {
  const std::string page = contents(std::string(PROJECT_FOLDER) + "/docs/bench.md");
  const std::size_t begin = page.find("```yaml\n");
  ASSERT_NE(begin, std::string::npos);
  const std::size_t first = begin + 8;
  const Bench bench = parse_bench(page.substr(first, page.find("```\n", first) - first), "bench.md", "/tmp");
  EXPECT_EQ(bench.devices.size(), 2U);
  EXPECT_EQ(bench.wires.size(), 1U);
}

TEST(Documentation, the_slim_page_has_the_parameters_of_the_table) {
  const std::string page = contents(std::string(PROJECT_FOLDER) + "/docs/slim.md");
  for (const slim::ParameterDefinition& row : slim::kParameters) {
    const std::string name = "\n| " + std::string(row.name) + " | " + std::string(row.alias);
    const std::size_t at = page.find(name);
    ASSERT_NE(at, std::string::npos) << row.name;
    const std::string line = page.substr(at + 1, page.find('\n', at + 1) - at - 1);
    // PN50 is by the number of modules.
    const std::string factory = row.name == "PN50" ? "by `modules`" : slim::text_of_real(row.factory);
    EXPECT_NE(line.find(" | " + factory + " |"), std::string::npos) << line;
  }
}

TEST(Documentation, the_shipped_benches_are_valid) {
  for (const char* name : {"quickstart.yaml", "two_stations.yaml", "slim_quickstart.yaml"}) {
    EXPECT_NO_THROW(load_bench(std::string(PROJECT_FOLDER) + "/scenarios/" + name)) << name;
  }
}

}  // namespace
}  // namespace understudy::emulator
