// `check` and `schema` as scripts and editors use them for scenario files.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace scenario_files_test {

constexpr const char* kScenario =
    "understudy: 1\n"
    "bench: { lines: { a: { stations: [ { name: feeder, model: simple2-r3 } ] } } }\n"
    "cases: [ { speed: 100 }, { speed: 200 } ]\n"
    "steps:\n"
    "  - write: { feeder.Aaxis_Speed: \"${speed}\" }\n"
    "  - fork: { a: [ advance: 1ms ], b: [ include: rest.yaml ] }\n";
constexpr const char* kRest = "understudy: 1\nsteps: [ expect: { feeder.Cord_A: 0 }, say: done ]\n";

TEST(ScenarioFiles, AreCheckedWithoutBeingRun) {
  const PrivateFolder folder;
  const std::string rest = folder.write("rest.yaml", kRest);
  const std::string scenario = folder.write("good.yaml", kScenario);
  const Finished finished = understudy({"check", scenario, rest});
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_EQ(finished.errors, "");
  // In each of the two cases: write, fork, advance, expect and say.
  EXPECT_EQ(finished.output,
            scenario + ": 2 scenarios with 10 steps\n" + rest +
                ": steps to include; they are checked with the scenarios that include them\n");
}

TEST(ScenarioFiles, ABadOneIsReportedWithItsLine) {
  const PrivateFolder folder;
  folder.write("rest.yaml", kRest);
  std::string text = kScenario;
  text.replace(text.find("Aaxis_Speed"), 11, "Aaxis_Sped");
  const std::string path = folder.write("bad.yaml", text);
  const Finished finished = understudy({"check", path});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_EQ(finished.output, "");
  EXPECT_EQ(finished.errors, path +
                                 ":5:33: steps[0].write.feeder.Aaxis_Sped: feeder: no register is called "
                                 "'Aaxis_Sped'; the nearest is 'Aaxis_Speed'  (speed=100)\n");
}

TEST(ScenarioFiles, OfAFolderAreAllPlayed) {
  const PrivateFolder folder;
  for (const char* below : {"tests", "tests/benches", "tests/more", "tests/.git"}) {
    std::filesystem::create_directory(folder / below);
  }
  const std::string stations = "{ a: { stations: [ { name: feeder, model: simple2-r3 } ] } }\n";
  folder.write("tests/bench.yaml", "understudy: 1\nlines: " + stations);
  folder.write("tests/benches/other.yml", "understudy: 1\nlines: " + stations);
  folder.write("tests/rest.yaml", kRest);
  folder.write("tests/notes.txt", "nothing for us\n");
  folder.write("tests/.git/torn.yaml", "[");
  folder.write("tests/b.yaml", "understudy: 1\nbench: bench.yaml\nsteps: [ include: rest.yaml ]\n");
  folder.write("tests/more/a.yml", "understudy: 1\nbench: ../bench.yaml\nsteps: [ advance: 1ms ]\n");
  const Finished played = understudy({"run", folder / "tests"});
  EXPECT_EQ(played.exit_code, 0) << played.errors;
  const auto lines = lines_of(played.output);
  ASSERT_EQ(lines.size(), 3U) << played.output;
  EXPECT_EQ(lines[0].find("ok    " + (folder / "tests/b.yaml") + ": b ("), 0U) << lines[0];
  EXPECT_EQ(lines[1].find("ok    " + (folder / "tests/more/a.yml") + ": a ("), 0U) << lines[1];
  const Finished checked = understudy({"check", folder / "tests"});
  EXPECT_EQ(checked.exit_code, 0) << checked.errors;
  EXPECT_EQ(lines_of(checked.output).size(), 5U) << checked.output;

  const Finished none = understudy({"run", folder / "tests/benches"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_EQ(none.errors, (folder / "tests/benches") + ": folder: has no scenario; expected at least one\n");
  std::filesystem::create_directory(folder / "empty");
  EXPECT_EQ(understudy({"run", folder / "empty"}).errors,
            (folder / "empty") + ": folder: has no .yaml file; expected at least one\n");
  folder.write("tests/torn.yaml", "a: [");
  const Finished torn = understudy({"run", folder / "tests"});
  EXPECT_EQ(torn.exit_code, 2);
  EXPECT_EQ(torn.errors.find((folder / "tests/torn.yaml") + ":1:1: file: is not YAML: "), 0U) << torn.errors;
}

TEST(ScenarioFiles, TheirSchemaIsPrinted) {
  for (const std::string what : {"bench", "scenario"}) {
    const Finished finished = understudy({"schema", what});
    EXPECT_EQ(finished.exit_code, 0) << finished.errors;
    const auto schema = nlohmann::json::parse(finished.output);
    EXPECT_EQ(schema.at("$schema"), "http://json-schema.org/draft-07/schema#");
    EXPECT_TRUE(schema.at("properties").contains(what == "bench" ? "lines" : "steps"));
  }
  const Finished refused = understudy({"schema", "recording"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.errors, "understudy: 'recording' has no schema; expected bench, scenario or model\n");
}

}  // namespace scenario_files_test
}  // namespace understudy::acceptance
