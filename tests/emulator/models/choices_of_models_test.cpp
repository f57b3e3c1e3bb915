// The choices of each model: the rows are complete, and each option makes a device.
#include <gtest/gtest.h>

#include <cstddef>
#include <set>
#include <string>
#include <string_view>

#include "base/choices.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/models/models.h"

namespace understudy::emulator::models {
namespace choices_of_models_test {

TEST(ChoicesOfModels, EveryRowOfEveryModelSaysEverything) {
  for (const Model* model : all_models()) {
    std::set<std::string_view> ids;
    ASSERT_FALSE(model->choices.empty()) << model->name;
    for (const ChoiceRow& row : model->choices) {
      EXPECT_TRUE(ids.insert(row.id).second) << row.id << " appears twice";
      EXPECT_EQ(row.id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string_view::npos)
          << row.id;
      EXPECT_FALSE(row.section.empty()) << row.id;
      EXPECT_FALSE(row.question.empty()) << row.id;
      EXPECT_FALSE(row.why.empty()) << row.id;
      EXPECT_FALSE(to_string(row.confidence).empty()) << row.id;
      std::set<std::string_view> options;
      for (const std::string_view option : options_of(row)) {
        EXPECT_FALSE(option.empty()) << row.id;
        EXPECT_EQ(option.find(' '), std::string_view::npos) << row.id << ": " << option;
        EXPECT_TRUE(options.insert(option).second) << row.id << ": " << option << " appears twice";
      }
    }
  }
}

TEST(ChoicesOfModels, EveryOptionOfEveryModelMakesADevice) {
  for (const Model* model : all_models()) {
    for (const ChoiceRow& row : model->choices) {
      const auto options = options_of(row);
      for (std::size_t i = 0; i < options.size(); ++i) {
        DeviceSettings settings;
        settings.choices[std::string(row.id)] = std::string(options[i]);
        const auto device = make_device(*model, settings);
        EXPECT_EQ(device->choice(static_cast<std::size_t>(&row - model->choices.data())), i) << row.id;
      }
    }
  }
}

}  // namespace choices_of_models_test
}  // namespace understudy::emulator::models
