// Each choice with several options has a scenario that shows their difference, and there are no others.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "emulator/device/describe/describe.h"
#include "emulator/device/model.h"
#include "emulator/models/models.h"
#include "tests/emulator/play/performing/choice_check.h"
#include "tests/sanitized.h"

namespace understudy::emulator::play {
namespace choice_scenarios_test {

namespace fs = std::filesystem;

const fs::path kFolder = PROJECT_FOLDER "/docs/fidelity/proofs";

using Proofs = std::map<std::string, std::vector<Proof>>;  // by file, below the project's folder

Proofs proofs_of(const Model& model) {
  Proofs proofs;
  for (const auto& entry : fs::directory_iterator(kFolder / model.name)) {
    if (entry.path().extension() != ".yaml") continue;
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    proofs[fs::relative(entry.path(), PROJECT_FOLDER).string()] =
        proofs_in(text.str(), entry.path().string());
  }
  return proofs;
}

TEST(ChoiceScenarios, TellTheOptionsOfEveryRowApart) {
  std::size_t rows = 0;
  for (const Model* const model : models::all_models()) {
    Proofs proofs = proofs_of(*model);
    for (const ChoiceRow& row : model->choices) {
      if (options_of(row).size() < 2) continue;
      const std::string file = scenario_of_choice(*model, row);
      auto& there = proofs[file];
      const auto proof =
          std::find_if(there.begin(), there.end(), [&](const Proof& one) { return one.id == row.id; });
      if (proof == there.end()) {
        ADD_FAILURE() << row.id << ": "
                      << (file.empty() ? "no row of kProofs has its section" : file + " has no play of it");
        continue;
      }
      if (++rows % (is_sanitized() ? 4 : 1) != 0) continue;
      for (const std::string& diagnostic : diagnostics_of_proof(row, *proof)) ADD_FAILURE() << diagnostic;
    }
  }
}

TEST(ChoiceScenarios, AreOfRowsThatThereAre) {
  for (const Model* const model : models::all_models()) {
    std::map<std::string, std::set<std::string>> expected;
    for (const ChoiceRow& row : model->choices) {
      const std::string file = scenario_of_choice(*model, row);
      if (!file.empty()) expected[file].emplace(row.id);
    }
    for (const auto& [file, proofs] : proofs_of(*model)) {
      for (const Proof& proof : proofs) {
        EXPECT_EQ(expected[file].erase(proof.id), 1U)
            << file << ": " << proof.id << " is not a choice of its sections with several options";
      }
    }
  }
}

}  // namespace choice_scenarios_test
}  // namespace understudy::emulator::play
