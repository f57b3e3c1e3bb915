// The instruction table compared with the facts from the manual (instructions.csv).
#include "interpreter/super_40nc/instructions.h"

#include <gtest/gtest.h>

#include "tests/interpreter/facts.h"

namespace understudy::interpreter::super_40nc {
namespace instructions_test {

std::vector<Fact> facts() { return read_facts(TEST_FACTS "/super_40nc/instructions.csv"); }

std::string in_plc(ConditionUse how) {
  switch (how) {
    case ConditionUse::nothing: return "";
    case ConditionUse::contact: return "contact";
    case ConditionUse::every_scan: return "every_scan";
    case ConditionUse::every_scan_on_or_off: return "every_scan_on_or_off";
    case ConditionUse::rising_edge: return "rising_edge";
    case ConditionUse::falling_edge: return "falling_edge";
    case ConditionUse::level: return "level";
  }
  return "";
}

std::string areas_of(Areas areas) {
  std::string text = has(areas, Area::plc) ? "P" : "";
  for (const AreaRow& row : kAreas) {
    if (row.area != Area::plc && has(areas, row.area)) text += row.letter;
  }
  return text;
}

TEST(Super40ncInstructions, AreTheManualsInItsOrder) {
  const std::vector<Fact> all = facts();
  ASSERT_EQ(all.size(), 97u);
  ASSERT_EQ(kInstructions.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Fact& fact = all[i];
    const InstructionRow& row = kInstructions[i];
    const std::string name(row.mnemonic);
    EXPECT_EQ(name, fact.at("mnemonic"));
    EXPECT_EQ(row.group == Group::undocumented, fact.at("group") == "Motion (undocumented)") << name;
    EXPECT_FALSE(row.meaning.empty()) << name;
    EXPECT_FALSE(row.section.empty()) << name;
    EXPECT_EQ(areas_of(row.areas & ~row.void_in), fact.at("areas")) << name;
    EXPECT_EQ(areas_of(row.void_in), fact.at("void_in")) << name;
    if (fact.at("steps").empty()) continue;
    EXPECT_EQ(std::to_string(row.steps), fact.at("steps")) << name;
    // The manual prints four fields for CWR and CCWR, the last of them without a meaning.
    const bool has_dead_field = name == "CWR" || name == "CCWR";
    EXPECT_EQ(std::to_string(row.fields() + (has_dead_field ? 1 : 0)), fact.at("fields")) << name;
    EXPECT_EQ(in_plc(row.in_plc), fact.at("in_plc")) << name;
    EXPECT_EQ(row.ends_single_step, fact.at("single_step") == "yes") << name;
    EXPECT_EQ(row.waits == Waits::no, fact.at("waits") == "no") << name;
  }
}

}  // namespace instructions_test
}  // namespace understudy::interpreter::super_40nc
