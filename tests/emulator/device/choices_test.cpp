// Choices: what a manual leaves open, as data.
#include "emulator/device/choices.h"
#include "emulator/models/models.h"

#include <gtest/gtest.h>

#include <set>

#include "emulator/device/device.h"
#include "emulator/device/model.h"

namespace understudy::emulator {
namespace choices_test {

constexpr ChoiceRow kRows[] = {
    {"loop_count", "3.5", "how many passes", "passes|passes_plus_one|endless", Confidence::proposal, "why"},
    {"only_one", "1", "what", "this", Confidence::follows, "why"},
    {"servo", "2", "on or off", "off|on", Confidence::likely, "why"},
};

using Chosen = std::vector<std::uint8_t>;

std::string error_of(const std::map<std::string, std::string>& overrides) {
  try {
    resolve_choices(kRows, overrides);
  } catch (const ChoiceError& error) {
    return error.what();
  }
  return "";
}

TEST(Choices, AreOursUnlessSomebodySaysOtherwise) {
  EXPECT_EQ(resolve_choices(kRows, {}), (Chosen{0, 0, 0}));
  EXPECT_EQ(resolve_choices(kRows, {{"servo", "on"}}), (Chosen{0, 0, 1}));
  EXPECT_EQ(resolve_choices(kRows, {{"servo", "off"}, {"loop_count", "endless"}}), (Chosen{2, 0, 0}));
  EXPECT_EQ(resolve_choices(kRows, {{"only_one", "this"}}), (Chosen{0, 0, 0}));
  EXPECT_EQ(resolve_choices({}, {}), Chosen{});
}

TEST(Choices, OptionsAreSeparatedByBars) {
  EXPECT_EQ(options_of(kRows[0]), (std::vector<std::string_view>{"passes", "passes_plus_one", "endless"}));
  EXPECT_EQ(options_of(kRows[1]), std::vector<std::string_view>{"this"});
}

TEST(Choices, AnUnknownIdIsRefusedWithTheNearestOne) {
  EXPECT_EQ(error_of({{"loop_cuont", "passes"}}),
            "no choice is called 'loop_cuont'; the nearest is 'loop_count'");
  EXPECT_EQ(error_of({{"", "passes"}}),
            "no choice is called ''; expected one of loop_count, only_one, servo");
  EXPECT_EQ(error_of({{"Servo", "on"}}), "no choice is called 'Servo'; the nearest is 'servo'");
}

TEST(Choices, AnUnknownOptionIsRefusedWithThoseThereAre) {
  for (const char* option : {"maybe", "", "on|off", "off|on", "ON", "o", "onn"}) {
    EXPECT_EQ(error_of({{"servo", option}}),
              "choice 'servo' has no option '" + std::string(option) + "'; expected one of off|on");
  }
}

TEST(Choices, EveryRowOfEveryModelSaysEverything) {
  for (const Model* model : models::all_models()) {
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

TEST(Choices, EveryOptionOfEveryModelMakesADevice) {
  for (const Model* model : models::all_models()) {
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

}  // namespace choices_test
}  // namespace understudy::emulator
