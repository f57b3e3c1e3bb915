// Choices of the SUPER-40NC where they interact with the rest of it; docs/fidelity/proofs/super-40nc/ shows
// each one alone.
#include "emulator/models/super_40nc/rows/choices.h"

#include "tests/emulator/models/super_40nc/one_super40nc.h"

namespace understudy::emulator::models::super_40nc {
namespace choices_test {

using Writes = std::vector<std::pair<std::string, Value>>;

struct Step {
  Writes writes;
  Tick ticks = 1;
  std::vector<std::pair<std::string, std::int32_t>> inputs{};
};

struct Case {
  std::string id;
  std::string program;
  Writes set;
  std::vector<Step> steps;
  std::string shown;                                     // a register
  std::vector<std::pair<std::string, Value>> by_option;  // our option first
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      // A program's write beyond the range is refused as well: the value is unchanged.
      {"range_checks",
       "AREA X\nMOV K9 D9003\nEND",
       {},
       {{{{"M8100", 1}}, 5}},
       "D9003",
       {{"stored_limited_when_used", 9}, {"exception_3", 0}, {"nearest_one", 4}}},
      {"jog_selector",
       "",
       {{"D8022", 2}},
       {{{{"M8103", 1}}, 100}},
       "D8123",
       {{"d8022", 65500}, {"always_medium", 65533}, {"d8022_also_while_it_runs", 65500}}},
      // The keys in the table still jog.
      {"jog_aliases", "", {}, {{{{"M8560", 1}}, 5}}, "M8103", {{"jog_keys", 1}, {"plain_contacts", 1}}},
      {"jog_aliases", "", {}, {{{{"M8561", 1}}, 5}}, "M8104", {{"jog_keys", 1}, {"plain_contacts", 1}}},
      {"lock_scope",
       "",
       {{"D9198", 10000000}},
       {{{{"M8560", 1}}, 5}},
       "M8103",
       {{"keys", 0}, {"keys_and_d8020", 0}, {"nothing", 1}}},
      {"flash_time",
       "AREA PLC\nLD M8003\nINC D0\nEND",
       {},
       {{{}, 10}, {{{"D0", 0}, {"D9002", 1}}, 200}},
       "D0",
       {{"0", 200}, {"100_ms_without_a_scan", 100}}},
      // An EL while a soft limit pauses, and the other way round.
      {"soft_limit_resets",
       "AREA X\nNOP\nRPM K100\nDRV K5000\nEND",
       {},
       {{{{"M8100", 1}}, 100}, {{}, 5, {{"X1", 1}}}},
       "D8100",
       {{"reset", 0}, {"pauses_at_the_line", 0}}},
      {"el_resets",
       "AREA X\nNOP\nRPM K100\nDRV K5000\nEND",
       {{"D9185", 1000}},
       {{{{"M8100", 1}}, 600}},
       "D8100",
       {{"reset", 0}, {"pauses_at_the_line", 0}}},
      {"edge_contacts_fall",
       "",
       {{"D9121", 0}},
       {{{{"M8105", 1}}, 5}, {{}, 5, {{"X0", 1}}}},
       "M8105",
       {{"no", 1}, {"when_served", 0}, {"m8x05_behind_its_search", 1}}},
      {"edge_contacts_fall",
       "",
       {{"D9121", 0}},
       {{{{"M8105", 1}}, 5}, {{}, 500, {{"X0", 1}}}},
       "M8105",
       {{"no", 1}, {"when_served", 0}, {"m8x05_behind_its_search", 0}}},
  };
  return all;
}

TEST(Super40ncChoices, ShowTheirOtherEffects) {
  for (const Case& each : cases()) {
    std::vector<std::string_view> named;
    for (const auto& [option, value] : each.by_option) named.push_back(option);
    for (const ChoiceRow& row : kChoices) {
      if (row.id != each.id) continue;
      EXPECT_EQ(options_of(row), named) << each.id;
    }
    for (const auto& [option, value] : each.by_option) {
      OneSuper40nc one({.set = each.set, .program = each.program, .choices = {{each.id, option}}});
      for (const Step& step : each.steps) {
        for (const auto& [name, written] : step.writes) one.set(name, written);
        for (const auto& [terminal, level] : step.inputs) one.input(terminal, level);
        one.run(step.ticks);
      }
      EXPECT_EQ(one.get(each.shown), value) << each.id << ": " << option << ", " << each.shown;
    }
  }
}

TEST(Super40ncChoices, EachHasAnAlternative) {
  for (const ChoiceRow& row : kChoices) EXPECT_GT(options_of(row).size(), 1U) << row.id;
}

}  // namespace choices_test
}  // namespace understudy::emulator::models::super_40nc
