// Choices: what a manual leaves open, as data.
#include "base/choices.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace understudy {
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

constexpr ChoiceRow kLanguage[] = {
    {"room", "1", "how much", "100_lines|25_lines|4", Confidence::proposal, "why"},
    {"case", "1", "which", "upper|either", Confidence::proposal, "why"},
};
using Options = OptionsOf<kLanguage>;

TEST(Choices, OptionsThatAreNumbersAreReadFromTheirNames) {
  constexpr Options::Numbers kRoom = Options::numbers("room");
  EXPECT_EQ(Options{}.number(kRoom), 100);
  EXPECT_EQ(Options{Options::named("room", "25_lines")}.number(kRoom), 25);
  EXPECT_EQ(Options{Options::named("room", "4")}.number(kRoom), 4);
  EXPECT_ANY_THROW(Options::numbers("case"));
}

TEST(Choices, ALanguageNotesTheRowsThatItAsksFor) {
  const std::vector<std::uint8_t> chosen{1, 1};
  std::vector<std::uint8_t> asked{0, 0};
  const Options options(chosen, asked.data());
  EXPECT_TRUE(options.chose(Options::named("case", "either")));
  EXPECT_EQ(asked, (std::vector<std::uint8_t>{0, 1}));
  EXPECT_EQ(options.number(Options::numbers("room")), 25);
  EXPECT_EQ(asked, (std::vector<std::uint8_t>{1, 1}));
}

}  // namespace choices_test
}  // namespace understudy
