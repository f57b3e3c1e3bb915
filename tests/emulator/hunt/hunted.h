// Hunts in scenarios that are given as texts.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "emulator/hunt/found_file.h"
#include "emulator/hunt/hunt.h"
#include "emulator/models/models.h"
#include "emulator/play/performing/case_list.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/reading/scenario_file.h"

namespace understudy::emulator::hunt {

/// A controller that counts presses of a button, and counts a bouncing contact several times.
inline const std::string kPresses = R"(understudy: 1
name: one press, one part
bench: { lines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } } }
steps:
  - program:
      feeder: |
        again:  Wait_IO DIN_10 ON
                Counter_Increase 1
                Wait_IO DIN_10 OFF
                Jump again
  - write: { PROG_MAIN_RunTime_START: 0 }
  - say: the operator presses
  - input: { DIN_10: on }
  - advance: 20ms
  - say: the contact rests
  - advance: 130ms
  - input: { DIN_10: off }
  - advance: 150ms
  - expect: { Counter1_Value: 1 }
)";

/// A folder with a scenario file.
class HuntFolder {
 public:
  explicit HuntFolder(const std::string& scenario) {
    std::string pattern = testing::TempDir() + "understudy-hunt-XXXXXX";
    path_ = mkdtemp(pattern.data());
    write("scenario.yaml", scenario);
  }
  ~HuntFolder() { std::filesystem::remove_all(path_); }
  HuntFolder(const HuntFolder&) = delete;
  HuntFolder& operator=(const HuntFolder&) = delete;

  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(std::filesystem::path(*this / name).parent_path());
    std::ofstream(*this / name) << text;
  }

 private:
  std::string path_;
};

/// A finding, with the scenario that was written about it.
struct Found {
  std::string kind;
  std::string text;
  std::uint64_t course = 0;
  Course shrunk{};
  bool is_minimal = false;
  friend bool operator==(const Found&, const Found&) = default;
};

inline std::vector<Found> hunted(const HuntFolder& folder, const HuntOptions& options,
                                 Tally* tally = nullptr) {
  play::CaseList cases(models::all_models(), {});
  cases.add(folder / "scenario.yaml", [](const play::Scenario&) {});
  Hunt hunt(cases, models::all_models(), options);
  std::vector<Found> all;
  hunt.run([&](const Finding& finding) {
    all.push_back({.kind = finding.shrunk.outcome.kind,
                   .text = text_of_finding(*finding.course_player, finding.shrunk, {}, folder / "found"),
                   .course = finding.course,
                   .shrunk = finding.shrunk.course,
                   .is_minimal = finding.shrunk.is_minimal});
  });
  if (tally != nullptr) *tally = hunt.tally();
  return all;
}

/// Runs a scenario that was written to the folder `found`. Returns the failure, or an empty text.
inline std::string failure_of(const HuntFolder& folder, const std::string& text) {
  folder.write("found/one.yaml", text);
  const auto scenarios = play::load_scenarios(models::all_models(), folder / "found/one.yaml");
  const auto results = play::run_scenario(scenarios.at(0));
  return results.at(0).failure ? results[0].failure->what : "";
}

}  // namespace understudy::emulator::hunt
