// Each choice that can be made otherwise has a scenario that tells its options apart, and there is no other.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "emulator/device/model.h"
#include "emulator/models/models.h"
#include "tests/emulator/play/performing/choice_check.h"

namespace understudy::emulator::play {
namespace choice_scenarios_test {

namespace fs = std::filesystem;

const fs::path kFolder = PROJECT_FOLDER "/scenarios/choices";

/// Where the scenario of a row is: "MODEL/ID.yaml".
std::string place_of(const Model& model, const ChoiceRow& row) {
  return std::string(model.name) + "/" + std::string(row.id) + ".yaml";
}

TEST(ChoiceScenarios, TellTheOptionsOfEveryRowApart) {
  for (const Model* const model : models::all_models()) {
    for (const ChoiceRow& row : model->choices) {
      if (options_of(row).size() < 2) continue;
      const fs::path path = kFolder / place_of(*model, row);
      std::ifstream file(path);
      if (!file) {
        ADD_FAILURE() << row.id << ": scenarios/choices/" << place_of(*model, row) << " is missing";
        continue;
      }
      std::ostringstream text;
      text << file.rdbuf();
      for (const std::string& complaint : complaints_of_choice(row, text.str(), path.string())) {
        ADD_FAILURE() << complaint;
      }
    }
  }
}

TEST(ChoiceScenarios, AreOfRowsThatThereAre) {
  std::set<std::string> known;
  for (const Model* const model : models::all_models()) {
    for (const ChoiceRow& row : model->choices) {
      if (options_of(row).size() > 1) known.insert(place_of(*model, row));
    }
  }
  for (const auto& entry : fs::recursive_directory_iterator(kFolder)) {
    if (entry.is_directory()) continue;
    const std::string place = fs::relative(entry.path(), kFolder).string();
    EXPECT_TRUE(known.contains(place)) << place << ": no model has such a choice with several options";
  }
}

}  // namespace choice_scenarios_test
}  // namespace understudy::emulator::play
