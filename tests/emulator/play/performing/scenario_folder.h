// A folder with a bench of two controllers and the other files that scenarios name. Reads scenarios in it.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "emulator/device/memory/nv_image.h"
#include "emulator/models/models.h"
#include "emulator/play/reading/scenario_file.h"
#include "tests/emulator/world/bench_file/without_columns.h"

namespace understudy::emulator::play {

inline const std::string kTwoStations = R"(understudy: 1
lines:
  rs485:
    stations:
      - { name: feeder, model: simple2-r3, address: 1 }
      - { name: turner, model: simple2-r3, address: 2 }
plant:
  feeder.A: { travel: [-20000, 20000], home: { at: 0, width: 200 } }
  turner.B: { encoder: { per_revolution: 400, on: wheel } }
)";

class ScenarioFolder {
 public:
  ScenarioFolder() {
    std::string pattern = testing::TempDir() + "understudy-scenario-XXXXXX";
    path_ = mkdtemp(pattern.data());
    write("feeder.yaml", kTwoStations);
    write("indexing.lst", "        SVON_A\n        END\n");
    write("after.json",
          to_json({.model = "simple2-r3", .firmware = "1.52", .registers = {{"PROG_MEM31", 7}}}));
    write("homing.yaml", "understudy: 1\nsteps:\n  - write: { feeder.Aaxis_SVON: 1 }\n  - advance: 5ms\n");
  }
  ~ScenarioFolder() { std::filesystem::remove_all(path_); }
  ScenarioFolder(const ScenarioFolder&) = delete;
  ScenarioFolder& operator=(const ScenarioFolder&) = delete;

  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
    std::ofstream(path(name)) << text;
    return path(name);
  }
  std::string path(const std::string& name) const { return path_ + "/" + name; }

  /// Reads a text as "scenario.yaml" in that folder.
  std::vector<Scenario> parse(const std::string& text) const {
    return parse_scenarios(models::all_models(), text, path("scenario.yaml"));
  }
  /// Reads a scenario that has only steps, which begin in its fourth line.
  Steps steps(const std::string& steps) const { return parse(scenario_of(steps)).front().steps; }
  static std::string scenario_of(const std::string& steps) {
    return "understudy: 1\nbench: feeder.yaml\nsteps:\n" + steps;
  }
  /// Returns the error of a text, without the folder's path; empty if there is none.
  std::string diagnostic(const std::string& text) const {
    try {
      parse(text);
      return "";
    } catch (const FileError& error) {
      std::string what = world::without_columns(error.what());
      for (std::size_t at = 0; (at = what.find(path_ + "/")) != std::string::npos;) {
        what.erase(at, path_.size() + 1);
      }
      return what;
    }
  }

 private:
  std::string path_;
};

/// Returns the steps' own descriptions, including the continuations of a fork.
inline std::vector<std::string> texts_of(const Steps& steps) {
  std::vector<std::string> texts;
  for (const Step& step : steps) {
    texts.push_back(step.text);
    const auto* const fork = std::get_if<ForkStep>(&step.what);
    if (fork == nullptr) continue;
    for (const ForkStep::Branch& branch : fork->branches) {
      for (const std::string& text : texts_of(branch.steps)) texts.push_back(branch.name + ": " + text);
    }
  }
  return texts;
}

}  // namespace understudy::emulator::play
