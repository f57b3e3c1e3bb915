// The schema of one bench's scenarios accepts its names and rejects misspelt ones.
#include "emulator/play/schema/bench_names.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "emulator/models/models.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/play/schema/json_schema.h"
#include "emulator/world/bench_file/bench_file.h"
#include "tests/emulator/play/schema/schema_check.h"
#include "tests/sanitized.h"

namespace understudy::emulator::play {
namespace bench_names_test {

constexpr const char* kTwoModels =
    "understudy: 1\n"
    "lines:\n"
    "  rs485: { stations: [ { name: feeder, model: simple2-r3 } ] }\n"
    "  text: { stations: [ { name: robot, model: slim, modules: 2 } ] }\n";
constexpr const char* kOneDevice =
    "understudy: 1\nlines: { com: { stations: [ { name: cell, model: rs-m8194h } ] } }\n";

std::string diagnostic_of(const std::string& bench, const std::string& step) {
  static std::map<std::string, std::string> schemas;
  std::string& schema = schemas[bench];
  if (schema.empty())
    schema =
        scenario_schema(models::all_models(), world::parse_bench(models::all_models(), bench, "b.yaml", "."));
  return schema_diagnostic(schema, "understudy: 1\nbench: b.yaml\nsteps: [ " + step + " ]\n");
}

TEST(BenchNames, OfTheBenchSuit) {
  for (const char* step : {
           "write: { feeder.Aaxis_Speed: 1 }",
           "write: { feeder.Aaxis_Pulse_L: 1 }",
           "expect: { feeder.STATUS.4: 0 }",
           "expect: { feeder.Aaxis_Speed.3: 0, feeder.Aaxis_Pulse_L.3: 0, feeder.PROG_VAR7.0: 0 }",
           "inject: { drop: rs485 }",
           "inject: { drop: feeder }",
           "expect: { feeder.0x0E04: 0 }",
           "expect: { robot.T1PE: 50 }",
           "write: { \"${name}\": 1 }",
           "input: { feeder.DIN_10: 1 }",
           "inject: { stall: feeder.A }",
           "inject: { stuck: feeder.DIN_10, level: on }",
           "power: { robot: cycle }",
           "program: { feeder: x.lst }",
           "{ send: { text: TX=0, line: text } }",
           "{ expect: { feeder.Cord_A: 0 }, via: rs485 }",
       }) {
    EXPECT_EQ(diagnostic_of(kTwoModels, step), "") << step;
  }
  for (const char* step : {"write: { LP_X: 0 }", "write: { cell.LP_X: 0 }", "input: { LMTP_X: 1 }",
                           "expect: { input.82: 0 }", "command: { cell: RSM_FIXED_MOVE X 1 }"}) {
    EXPECT_EQ(diagnostic_of(kOneDevice, step), "") << step;
  }
}

TEST(BenchNames, MisspeltOnesDoNotSuit) {
  for (const char* step : {
           "write: { feeder.Aaxis_Sped: 1 }",
           "write: { Aaxis_Speed: 1 }",  // two devices: whose is it?
           "write: { feder.Aaxis_Speed: 1 }",
           "expect: { feeder.Cord_C: 0 }",
           "expect: { feeder.STAUTS.4: 0 }",
           "inject: { drop: rs484 }",
           "input: { feeder.DIN_99: 1 }",
           "input: { feeder.Cord_A: 1 }",
           "inject: { stall: feeder.Q }",
           "inject: { power_cut: fedeer }",
           "power: { robt: cycle }",
           "program: { feder: x.lst }",
           "{ send: { text: TX=0, line: txt } }",
           "{ expect: { feeder.Cord_A: 0 }, via: rs484 }",
       }) {
    EXPECT_NE(diagnostic_of(kTwoModels, step), "") << step;
  }
  for (const char* step : {"write: { LPX: 0 }", "write: { cel.LP_X: 0 }", "input: { LMTP_V: 1 }",
                           "command: { cel: RSM_STOP X }"}) {
    EXPECT_NE(diagnostic_of(kOneDevice, step), "") << step;
  }
}

/// The names in the shipped scenarios are in the schema of their bench: an editor underlines nothing that can
/// run.
TEST(BenchNames, SuitEveryShippedScenario) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(PROJECT_FOLDER "/scenarios")) {
    const std::string path = entry.path().string();
    if (entry.path().extension() != ".yaml") continue;
    if (kind_of_file(path) != FileKind::scenario) continue;
    if (++count % (is_sanitized() ? 15 : 1) != 0) continue;
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    const auto scenarios = load_scenarios(models::all_models(), path, "/");
    ASSERT_FALSE(scenarios.empty()) << path;
    EXPECT_EQ(schema_diagnostic(scenario_schema(models::all_models(), scenarios.front().bench), text.str()),
              "")
        << path;
  }
  EXPECT_GE(count, 60U);
}

}  // namespace bench_names_test
}  // namespace understudy::emulator::play
