// Every example of docs/scenarios.md is read, and every kind of step has one.
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "emulator/models/models.h"
#include "emulator/play/reading/step_rows.h"
#include "tests/emulator/play/performing/scenario_folder.h"
#include "tests/emulator/workbench/workbench.h"
#include "tests/emulator/world/stations/echo_box.h"

namespace understudy::emulator::play {
namespace scenarios_page_test {

std::vector<std::string> examples() {
  std::ifstream file(PROJECT_FOLDER "/docs/scenarios.md");
  std::ostringstream page;
  page << file.rdbuf();
  const std::string text = page.str();
  std::vector<std::string> blocks;
  const std::string begin = "```yaml\n";
  for (std::size_t at = 0; (at = text.find(begin, at)) != std::string::npos;) {
    at += begin.size();
    const std::size_t end = text.find("```\n", at);
    blocks.push_back(text.substr(at, end - at));
    at = end;
  }
  return blocks;
}

bool speaks_text(const std::string& example) { return example.find("hear:") != std::string::npos; }

/// Steps with a text-protocol device: the tests' own, whose N0 stands for the page's PE.
std::string diagnostic_of_text(std::string steps) {
  const std::string value = "robot.PE";
  for (std::size_t at = 0; (at = steps.find(value)) != std::string::npos;) {
    steps.replace(at, value.size(), "robot.N0");
  }
  try {
    parse_scenarios(world::models_and_echo_box(),
                    "understudy: 1\nname: page\nbench: { lines: { serial: { stations: "
                    "[ { name: robot, model: echo-box } ] } } }\nsteps:\n" +
                        steps,
                    "page.yaml");
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

/// Steps that send commands by name: to the tests' own controller, which has some.
std::string diagnostic_of_commands(const std::string& steps) {
  const ListedModel models[] = {&workbench::model()};
  try {
    parse_scenarios(models,
                    "understudy: 1\nname: page\nbench: { lines: { serial: { stations: "
                    "[ { name: cell, model: workbench } ] } } }\nsteps:\n" +
                        steps,
                    "page.yaml");
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

TEST(ScenariosPage, EveryExampleIsRead) {
  const ScenarioFolder folder;
  int files = 0;
  for (const std::string& example : examples()) {
    if (speaks_text(example)) {
      EXPECT_EQ(diagnostic_of_text(example), "") << example;
      continue;
    }
    if (example.find("command:") != std::string::npos) {
      EXPECT_EQ(diagnostic_of_commands(example), "") << example;
      continue;
    }
    const bool is_whole = example.starts_with("understudy: 1");
    files += is_whole ? 1 : 0;
    EXPECT_EQ(folder.diagnostic(is_whole ? example : ScenarioFolder::scenario_of(example)), "") << example;
  }
  EXPECT_EQ(files, 4);
}

TEST(ScenariosPage, TheCasesOfTheFirstExampleHaveTheNamesItSays) {
  const ScenarioFolder folder;
  const auto scenarios = folder.parse(examples().at(0));
  ASSERT_EQ(scenarios.size(), 2U);
  EXPECT_EQ(scenarios[0].name, "a move takes its time (speed=200, takes=3050ms)");
}

TEST(ScenariosPage, EveryKindOfStepHasAnExample) {
  std::string all;
  for (const std::string& example : examples()) all += "\n" + example;
  for (const StepRow& row : step_rows()) {
    EXPECT_NE(all.find("\n- " + std::string(row.key.key) + ":"), std::string::npos) << row.key.key;
    for (const world::Key& beside : row.beside) {
      EXPECT_NE(all.find("\n  " + std::string(beside.key) + ":"), std::string::npos) << beside.key;
    }
  }
}

}  // namespace scenarios_page_test
}  // namespace understudy::emulator::play
