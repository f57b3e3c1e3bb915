// `check` and `schema` as scripts and editors use them for scenario files.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace {

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
  EXPECT_EQ(finished.output, scenario + ": 2 scenarios with 10 steps\n" + rest +
                                 ": steps to include; they are checked with the scenarios that do\n");
}

TEST(ScenarioFiles, ABadOneIsToldOfWithItsLine) {
  const PrivateFolder folder;
  folder.write("rest.yaml", kRest);
  std::string text = kScenario;
  text.replace(text.find("Aaxis_Speed"), 11, "Aaxis_Sped");
  const std::string path = folder.write("bad.yaml", text);
  const Finished finished = understudy({"check", path});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_EQ(finished.output, "");
  EXPECT_EQ(finished.errors, path +
                                 ":5: steps[0].write.feeder.Aaxis_Sped: feeder: no register is called "
                                 "'Aaxis_Sped'; the nearest is 'Aaxis_Speed'  (speed=100)\n");
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
  EXPECT_EQ(refused.errors, "understudy: 'recording' has no schema; expected bench or scenario\n");
}

}  // namespace
}  // namespace understudy::acceptance
