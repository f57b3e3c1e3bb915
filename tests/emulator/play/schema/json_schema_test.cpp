// The schemas accept what the readers accept, and reject what the readers reject because of its form.
#include "emulator/play/schema/json_schema.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "emulator/device/describe/describe.h"
#include "emulator/models/models.h"
#include "emulator/play/reading/step_rows.h"
#include "tests/emulator/play/performing/scenario_folder.h"
#include "tests/emulator/play/schema/schema_check.h"
#include "tests/emulator/world/bench_file/bench_texts.h"

namespace understudy::emulator::play {
namespace json_schema_test {

std::string contents(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string of_bench(const std::string& text) {
  static const std::string schema = bench_schema(models::all_models());
  return schema_diagnostic(schema, text);
}
std::string of_scenario(const std::string& text) {
  static const std::string schema = scenario_schema(models::all_models());
  return schema_diagnostic(schema, text);
}

std::vector<std::string> examples_of(const std::string& page) {
  const std::string text = contents(std::string(PROJECT_FOLDER) + "/docs/" + page);
  std::vector<std::string> blocks;
  const std::string begin = "```yaml\n";
  for (std::size_t at = 0; (at = text.find(begin, at)) != std::string::npos;) {
    at += begin.size();
    blocks.push_back(text.substr(at, text.find("```\n", at) - at));
  }
  return blocks;
}

TEST(JsonSchema, SuitsEveryShippedFile) {
  for (const char* const folder : {PROJECT_FOLDER "/scenarios", PROJECT_FOLDER "/docs/fidelity/proofs"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (entry.path().extension() != ".yaml") continue;
      const std::string path = entry.path().string();
      const FileKind kind = kind_of_file(path);
      if (kind == FileKind::steps) continue;
      EXPECT_EQ(kind == FileKind::bench ? of_bench(contents(path)) : of_scenario(contents(path)), "") << path;
    }
  }
}

TEST(JsonSchema, SuitsEveryExampleOfTheDocumentation) {
  EXPECT_EQ(of_bench(world::kFullBench), "");
  for (const std::string& example : examples_of("bench.md")) EXPECT_EQ(of_bench(example), "") << example;
  for (const std::string& example : examples_of("scenarios.md")) {
    const bool is_whole = example.starts_with("understudy: 1");
    EXPECT_EQ(of_scenario(is_whole ? example : ScenarioFolder::scenario_of(example)), "") << example;
  }
  for (const std::string& example : examples_of("campaigns.md"))
    EXPECT_EQ(of_scenario(example), "") << example;
  EXPECT_EQ(of_scenario(contents(PROJECT_FOLDER "/examples/campaign/move.yaml")), "");
}

/// The schema rejects what readers reject because of its form.
TEST(JsonSchema, RefusesBenchesOfAnotherForm) {
  const std::string station = "stations: [ { name: x, model: simple2-r3 } ]";
  const auto with_line = [](const std::string& line) {
    return "understudy: 1\nlines: { a: { " + line + " } }\n";
  };
  EXPECT_EQ(of_bench(with_line(station)), "");
  for (const std::string& bad :
       {std::string("lines: { a: { " + station + " } }\n"), std::string("understudy: 1\n"),
        std::string("understudy: 2\nlines: { a: { " + station + " } }\n"),
        std::string("understudy: 1\nlines: [ a ]\n"), with_line("link: x"), with_line(station + ", speed: 5"),
        with_line(station + ", baud: 0"), with_line(station + ", baud: fast"),
        with_line(station + ", timing: slow"), with_line("stations: []"),
        with_line("stations: [ { name: x } ]"), with_line("stations: [ { device: x, model: simple2-r3 } ]"),
        with_line(station) + "plant: { x.A: { travel: [ 1 ] } }\n",
        with_line(station) + "plant: { x.A: { travels: [ 1, 2 ] } }\n",
        with_line(station) + "plant: { x.A: { home: { at: 0 } } }\n", with_line(station) + "wires: x\n",
        with_line(station) + "faults: [ stall ]\n"}) {
    EXPECT_NE(of_bench(bad), "") << bad;
    EXPECT_THROW(world::parse(bad), FileError) << bad;
  }
}

// Blocks of text that a memory begins with, by kind and name.
TEST(JsonSchema, KnowsBlocksOfAMemory) {
  const auto with_nv = [](const std::string& model, const std::string& nv) {
    return "understudy: 1\nlines: { a: { stations: [ { name: x, model: " + model + ", nv: " + nv +
           " } ] } }\n";
  };
  const std::string taken =
      with_nv("super-40nc", "{ D500: 5, recipes: { '01': \"D501 7\\n\", '02': \"\" } }");
  EXPECT_EQ(of_bench(taken), "");
  EXPECT_NO_THROW(world::parse(taken));
  for (const std::string& bad : {with_nv("super-40nc", "{ recipes: { '01': [ D501 7 ] } }"),
                                 with_nv("super-40nc", "{ recipes: { '01': { D501: 7 } } }"),
                                 with_nv("super-40nc", "{ recipes: [ a ] }")}) {
    EXPECT_NE(of_bench(bad), "") << bad;
    EXPECT_THROW(world::parse(bad), FileError) << bad;
  }
}

TEST(JsonSchema, RefusesScenariosOfAnotherForm) {
  const ScenarioFolder folder;
  for (const std::string step : {"- advance",
                                 "- {}",
                                 "- { advance: 1 }",
                                 "- { advanc: 1ms }",
                                 "- { advance: 1ms, say: x }",
                                 "- { advance: 1ms, exception: 3 }",
                                 "- write: [ 1 ]",
                                 "- wait: { until: time > 1s }",
                                 "- wait: { within: 1s }",
                                 "- wait: { until: time > 1s, within: 1s, poll: 5 }",
                                 "- assert: { what: time > 1s }",
                                 "- never: { name: x }",
                                 "- send: { reply: 01 }",
                                 "- power: { feeder: down }",
                                 "- reset: all",
                                 "- repeat: { times: 2 }",
                                 "- repeat: { times: 0, steps: [ advance: 1ms ] }",
                                 "- repeat: { times: 2, steps: [ advance: 1 ] }",
                                 "- fork: { a: [] }",
                                 "- for: { each: [], as: i, steps: [] }",
                                 "- include: [ a ]",
                                 "- { write: { feeder.Aaxis_SVON: 1 }, exception: 0 }"}) {
    const std::string text = ScenarioFolder::scenario_of(step + "\n");
    EXPECT_NE(of_scenario(text), "") << step;
    EXPECT_NE(folder.diagnostic(text), "") << step;
  }
  const std::string good = ScenarioFolder::scenario_of("- advance: 1ms\n");
  EXPECT_EQ(of_scenario(good), "");
  for (const std::string more :
       {"nam: x\n", "gap: 5\n", "seed: -1\n", "cases: {}\n", "parameters: [ a ]\n", "vary: [ 1 ]\n",
        "vary: { a: 5 }\n", "vary: { a: { from: 1, to: 2 } }\n", "vary: { a: { between: [ 1 ] } }\n"}) {
    EXPECT_NE(of_scenario(good + more), "") << more;
    EXPECT_NE(folder.diagnostic(good + more), "") << more;
  }
}

TEST(JsonSchema, ParametersMayStandForAnyValueOfAScenario) {
  EXPECT_EQ(of_scenario(ScenarioFolder::scenario_of("- advance: ${t}\n"
                                                    "- repeat: { times: \"${n}\", steps: [ say: x ] }\n"
                                                    "- power: { feeder: \"${to}\" }\n"
                                                    "- { write: { a: 1 }, exception: \"${e}\" }\n")),
            "");
  EXPECT_NE(
      of_bench("understudy: 1\nlines: { a: { baud: \"${b}\", stations: [ { name: x, model: m } ] } }\n"), "");
}

std::set<std::string> kinds_of_texts(const Model& model) {
  std::set<std::string> kinds;
  const auto sheet = describe(model, "blocks", SheetFormat::csv);
  for (const auto& row : sheet.value().rows) kinds.insert(row.front());
  return kinds;
}

/// The kinds of named texts are those of the device's own table; anything else is underlined.
TEST(JsonSchema, KnowsTheKindsOfTextsOfEachModel) {
  std::set<std::string> all{"filez"};
  for (const Model* const model : models::all_models()) all.merge(kinds_of_texts(*model));
  EXPECT_GE(all.size(), 8U);
  for (const Model* const model : models::all_models()) {
    const std::set<std::string> own = kinds_of_texts(*model);
    for (const std::string& kind : all) {
      const auto with = [&](const std::string& nv) {
        return "understudy: 1\nlines: { a: { stations: [ { name: x, model: " + std::string(model->name) +
               ", nv: { " + nv + " } } ] } }\n";
      };
      const bool is_known = own.contains(kind);
      EXPECT_EQ(of_bench(with(kind + ": { \"1\": \"text\" }")).empty(), is_known)
          << model->name << " " << kind;
      EXPECT_EQ(of_bench(with(kind + ": text")).empty(), !is_known) << model->name << " " << kind;
      EXPECT_EQ(of_scenario("understudy: 1\nname: n\nbench:\n  devices: { x: { model: " +
                            std::string(model->name) + ", nv: { " + kind +
                            ": { \"1\": t } } } }\n  lines: { a: { stations: [ { device: x } ] } }\n"
                            "steps: [ advance: 1ms ]\n")
                    .empty(),
                is_known)
          << model->name << " " << kind;
    }
    EXPECT_EQ(of_bench("understudy: 1\nlines: { a: { stations: [ { name: x, model: " +
                       std::string(model->name) + ", nv: kept.json } ] } }\n"),
              "");
  }
  // The blocks of a user's own model are unknown.
  EXPECT_EQ(
      of_bench(
          "understudy: 1\nlines: { a: { stations: [ { name: x, model: own.yaml, nv: { files: { a: b } } } "
          "] } }\n"),
      "");
}

TEST(JsonSchema, DescribesEveryKindOfStep) {
  const std::string schema = scenario_schema(models::all_models());
  for (const StepRow& row : step_rows()) {
    EXPECT_NE(schema.find("\"" + std::string(row.key.doc) + "\""), std::string::npos) << row.key.key;
    EXPECT_TRUE(row.key.doc.ends_with('.')) << row.key.key;
  }
}

}  // namespace json_schema_test
}  // namespace understudy::emulator::play
