// `check --format`, `schema --bench` and `init`, as editors, CI services and newcomers use them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/acceptance/page_blocks.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace editors_test {

using nlohmann::json;

constexpr const char* kBench =
    "understudy: 1\nlines: { a: { stations: [ { name: feeder, model: simple2-r3 } ] } }\n";
constexpr const char* kBad =
    "understudy: 1\n"
    "bench: bench.yaml\n"
    "steps:\n"
    "  - write: { feeder.Aaxis_Sped: 1 }\n"
    "  - advance: 5 parsecs\n";

/// A folder with a valid bench, a scenario with two errors, and a file of neither kind.
struct Files {
  PrivateFolder folder;
  std::string bench = folder.write("bench.yaml", kBench);
  std::string bad = folder.write("bad, 100%.yaml", kBad);
  std::string torn = folder.write("torn.yaml", "a: [");
  std::vector<std::string> check(const std::string& format) const {
    return {"check", "--format", format, bench, bad, torn, folder / "missing.yaml"};
  }
};

TEST(CheckFormat, JsonHasEachFileAndEachMistakeWithItsPlace) {
  const Files files;
  const Finished finished = understudy(files.check("json"));
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_EQ(finished.errors, "");
  const json whole = json::parse(finished.output);
  ASSERT_EQ(whole["files"].size(), 4U);
  EXPECT_EQ(whole["findings"], 4);
  EXPECT_EQ(whole["files"][0], (json{{"file", files.bench},
                                     {"kind", "bench"},
                                     {"is", "a bench with 1 line and 1 device"},
                                     {"findings", json::array()}}));
  const json& bad = whole["files"][1];
  EXPECT_EQ(bad["kind"], "scenario");
  EXPECT_FALSE(bad.contains("is"));
  ASSERT_EQ(bad["findings"].size(), 2U);
  EXPECT_EQ(bad["findings"][0]["line"], 4);
  EXPECT_EQ(bad["findings"][0]["column"], 33);
  EXPECT_EQ(bad["findings"][0]["message"],
            "steps[0].write.feeder.Aaxis_Sped: feeder: no register is called 'Aaxis_Sped'; the nearest is "
            "'Aaxis_Speed'");
  EXPECT_EQ(bad["findings"][1]["line"], 5);
  EXPECT_EQ(whole["files"][2]["kind"], "file");
  EXPECT_EQ(whole["files"][3]["findings"][0]["file"], files.folder / "missing.yaml");
  EXPECT_FALSE(whole["files"][3]["findings"][0].contains("line"));
}

TEST(CheckFormat, GithubGetsOneLineForEachMistake) {
  const Files files;
  const Finished finished = understudy(files.check("github"));
  EXPECT_EQ(finished.exit_code, 2);
  const auto lines = lines_of(finished.output);
  ASSERT_EQ(lines.size(), 4U) << finished.output;
  // In a property, a comma, a colon and a percent sign are escaped; in the text only the percent sign.
  EXPECT_EQ(lines[0],
            "::error file=" + (files.folder / "bad%2C 100%25.yaml") +
                ",line=4,col=33,title=understudy check%3A scenario::steps[0].write.feeder.Aaxis_Sped: "
                "feeder: no register is called 'Aaxis_Sped'; the nearest is 'Aaxis_Speed'");
  EXPECT_EQ(understudy({"check", "--format", "github", files.bench}).output, "");
  // A path with "./" in it does not match any path in a repository.
  const Finished below = understudy({"check", "--format", "github", files.folder / "."});
  EXPECT_EQ(lines_of(below.output), (Words{lines[0], lines[1], lines[2]})) << below.output;
}

TEST(CheckFormat, SarifNamesItsRulesAndPlaces) {
  const Files files;
  const Finished finished = understudy(files.check("sarif"));
  EXPECT_EQ(finished.exit_code, 2);
  const json whole = json::parse(finished.output);
  EXPECT_EQ(whole["version"], "2.1.0");
  ASSERT_EQ(whole["runs"].size(), 1U);
  const json& run = whole["runs"][0];
  EXPECT_EQ(run["tool"]["driver"]["name"], "understudy");
  std::set<std::string> rules;
  for (const json& rule : run["tool"]["driver"]["rules"]) rules.insert(rule["id"]);
  ASSERT_EQ(run["results"].size(), 4U);
  for (const json& result : run["results"]) {
    EXPECT_EQ(rules.count(result["ruleId"]), 1U) << result;
    EXPECT_EQ(result["level"], "error");
  }
  const json& place = run["results"][0]["locations"][0]["physicalLocation"];
  EXPECT_EQ(place["artifactLocation"]["uri"], "file://" + (files.folder / "bad%2C%20100%25.yaml"));
  EXPECT_EQ(place["region"], (json{{"startLine", 4}, {"startColumn", 33}}));
  EXPECT_FALSE(run["results"][3]["locations"][0]["physicalLocation"].contains("region"));
}

TEST(CheckFormat, ProgramsHaveItToo) {
  const PrivateFolder folder;
  const std::string bad = folder.write("bad.lst", "LD M0\nNONSENSE\n");
  const Finished finished = understudy({"check", "--model", "super-40nc", "--format", "json", bad});
  EXPECT_EQ(finished.exit_code, 2);
  const json whole = json::parse(finished.output);
  EXPECT_EQ(whole["files"][0]["kind"], "program");
  EXPECT_GE(whole["files"][0]["findings"].size(), 1U);
}

TEST(CheckFormat, AnUnknownOneIsRefused) {
  const Finished finished = understudy({"check", "--format", "xml", "x.yaml"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_NE(finished.errors.find("'xml' is not a format; expected text, json, sarif or github"),
            std::string::npos)
      << finished.errors;
}

TEST(Init, WritesWhatChecksAndPlaysForEveryModel) {
  for (const char* model : {"simple2-r3", "slim", "rs-m8194h", "super-40nc"}) {
    const PrivateFolder folder;
    const std::string made = folder / "new/cell";
    const Finished finished = understudy({"init", "--model", model, made});
    EXPECT_EQ(finished.exit_code, 0) << finished.errors;
    EXPECT_EQ(finished.output, made + "/bench.yaml\n" + made + "/first_move.yaml\n" + made +
                                   "/bench.schema.json\n" + made +
                                   "/scenario.schema.json\nnext: understudy run " + made +
                                   "/first_move.yaml\n      understudy serve " + made + "/bench.yaml\n");
    const Finished checked = understudy({"check", made});
    EXPECT_EQ(checked.exit_code, 0) << checked.errors;
    const Finished played = understudy({"run", made + "/first_move.yaml"});
    EXPECT_EQ(played.exit_code, 0) << played.output << played.errors;
    EXPECT_NE(played.output.find("a first move"), std::string::npos) << played.output;
    // The modelines name the schemas next to the files.
    for (const auto& [file, schema] : {std::pair{"/bench.yaml", "./bench.schema.json"},
                                       std::pair{"/first_move.yaml", "./scenario.schema.json"}}) {
      std::ifstream text(made + file);
      std::string first;
      std::getline(text, first);
      EXPECT_EQ(first, std::string("# yaml-language-server: $schema=") + schema);
      EXPECT_TRUE(std::filesystem::exists(made + "/" + schema));
    }
  }
}

TEST(Init, OverwritesNothing) {
  const PrivateFolder folder;
  const std::string mine = folder.write("first_move.yaml", "mine\n");
  const Finished finished = understudy({"init", folder.path()});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_EQ(finished.errors, mine + ": file: already exists; expected a folder without it\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "bench.yaml"));
  EXPECT_EQ(understudy({"init", "--model", "simple3", folder / "other"}).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder / "other"));
}

TEST(Init, WritesAllOrNothing) {
  const PrivateFolder folder;
  // No file may exceed a few blocks, so the schemas do not fit.
  const Finished finished =
      run({"sh", "-c", "trap '' XFSZ; ulimit -f 8; exec " UNDERSTUDY_BINARY " init " + folder.path()});
  EXPECT_EQ(finished.exit_code, 3);
  EXPECT_EQ(finished.errors, "understudy: " + (folder / "bench.schema.json") +
                                 ": file: cannot be written (File too large); expected a new file\n");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(SchemaOfABench, ListsItsNames) {
  const Files files;
  const Finished finished = understudy({"schema", "scenario", "--bench", files.bench});
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  const json names = json::parse(finished.output)["definitions"]["registers"]["anyOf"][0]["enum"];
  EXPECT_EQ(std::count(names.begin(), names.end(), "feeder.Aaxis_Speed"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "Aaxis_Speed"), 1);  // there is only one device
  const Finished wrong = understudy({"schema", "bench", "--bench", files.bench});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.errors.find("--bench needs the format `scenario`"), std::string::npos) << wrong.errors;
  EXPECT_EQ(understudy({"schema", "scenario", "--bench", files.torn}).exit_code, 2);
}

/// In a user's first bench, the controller uses the inputs that its switches are wired to.
struct FirstBench {
  const char* bench;  // of scenarios/; "": what `init` writes
  const char* steps;
};

class FirstBenches : public testing::TestWithParam<FirstBench> {};

TEST_P(FirstBenches, StopAtASwitchThatIsPressed) {
  const PrivateFolder folder;
  std::string bench = std::string(PROJECT_FOLDER) + "/scenarios/" + GetParam().bench;
  if (GetParam().bench == std::string()) {
    ASSERT_EQ(understudy({"init", folder.path()}).exit_code, 0);
    bench = folder / "bench.yaml";
  }
  const std::string scenario =
      folder.write("pressed.yaml", "understudy: 1\nbench: " + bench + "\nsteps:\n" + GetParam().steps);
  const Finished played = understudy({"run", scenario});
  EXPECT_EQ(played.exit_code, 0) << played.output << played.errors;
}

constexpr const char* kPressedInAMove =
    "  - write: { feeder.Aaxis_SVON: 1 }\n"
    "  - write: { feeder.Aaxis_Pulse: 32000, feeder.Aaxis_Speed: 200, feeder.Aaxis_Move_INC: 1 }\n"
    "  - wait: { until: feeder.A.pulses > 5000, within: 5s }\n"
    "  - input: { feeder.DIN_2: on }\n"
    "  - wait: { until: feeder.A.speed == 0, within: 1s }\n"
    "  - assert: feeder.STATUS.12 == 1 and feeder.A.pulses < 10000\n";

INSTANTIATE_TEST_SUITE_P(, FirstBenches,
                         testing::Values(FirstBench{"quickstart.yaml", kPressedInAMove},
                                         FirstBench{"", kPressedInAMove},
                                         FirstBench{"rs_m8194h_quickstart.yaml",
                                                    "  - command: { cell: RSM_SET_V X 5000 }\n"
                                                    "  - command: { cell: RSM_FIXED_MOVE X 40000 }\n"
                                                    "  - wait: { until: cell.X.pulses > 5000, within: 9s }\n"
                                                    "  - input: { cell.LMTP_X: on }\n"
                                                    "  - wait: { until: cell.X.speed == 0, within: 1s }\n"
                                                    "  - assert: cell.X.pulses < 10000\n"}),
                         [](const auto& bench) { return "N" + std::to_string(bench.index); });

std::vector<std::string> blocks(const std::string& language) { return page_blocks("editors.md", language); }

TEST(EditorsPage, ItsCommandsRunAsTheyStand) {
  const PrivateFolder folder;
  const std::string programs = std::filesystem::path(UNDERSTUDY_BINARY).parent_path().string();
  const Environment environment = {{"PATH", programs + ":/usr/local/bin:/usr/bin:/bin"}};
  const auto scripts = blocks("sh");
  ASSERT_EQ(scripts.size(), 3U);
  for (const std::string& script : scripts) {
    const Finished finished = run({"sh", "-euc", "cd " + folder.path() + "\n" + script}, environment);
    EXPECT_EQ(finished.exit_code, 0) << script << finished.output << finished.errors;
  }
  std::ifstream findings(folder / "findings.json");
  EXPECT_EQ(json::parse(findings)["findings"], 0);
}

TEST(EditorsPage, ItsSettingsAreTheShippedOnes) {
  std::ifstream file(PROJECT_FOLDER "/recipes/vscode/settings.json");
  std::ostringstream text;
  text << file.rdbuf();
  ASSERT_EQ(blocks("json").size(), 1U);
  EXPECT_EQ(blocks("json").front(), text.str());
  EXPECT_TRUE(json::parse(text.str()).contains("yaml.schemas"));
}

}  // namespace editors_test
}  // namespace understudy::acceptance
