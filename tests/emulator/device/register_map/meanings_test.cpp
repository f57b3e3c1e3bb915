// What registers stand for: every one of our own models has words for it, by which people find it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "emulator/device/describe/describe.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/register_names.h"
#include "emulator/models/models.h"

namespace understudy::emulator {
namespace meanings_test {

const Model& model_of(std::string_view name) { return *find_model(models::all_models(), name); }

/// A register by its name, if no other table has that name as well.
std::string meaning(const Model& model, std::string_view name) {
  const auto found = model.registers->find(name, UINT16_MAX);
  return found ? meaning_of(*found->place.row, found->place.index) : "nothing has this name";
}
std::string heading(const Model& model, std::string_view name) {
  const auto found = model.registers->find(name, UINT16_MAX);
  return found ? heading_of(*found->place.row, found->place.index) : "nothing has this name";
}

TEST(Meanings, EveryRegisterHasOneAndAHeadingOfTheManual) {
  for (const char* name : {"simple2-r3", "super-40nc", "rs-m8194h"}) {
    int registers = 0;
    for (const RegisterRow& row : register_rows(model_of(name))) {
      ASSERT_TRUE(row.meanings.empty() || static_cast<int>(row.meanings.size()) == row.count) << row.name;
      ASSERT_TRUE(row.axis_names.empty() || static_cast<int>(row.axis_names.size()) == row.count) << row.name;
      for (int index = 0; index < row.count; ++index, ++registers) {
        const std::string what = std::string(name) + " " + RegisterMap::name_of(row, index);
        const std::string reported = meaning_of(row, index);
        EXPECT_FALSE(reported.empty()) << what;
        EXPECT_EQ(reported.find("{}"), std::string::npos) << what << ": " << reported;
        EXPECT_LE(reported.size(), 110U) << what << ": " << reported;
        for (const char letter : reported)
          EXPECT_TRUE(letter >= ' ' && letter <= '~') << what << ": " << reported;
        // What the manual does not name stands at least in one of its sections.
        EXPECT_FALSE(heading_of(row, index).empty() && row.section.empty()) << what;
      }
    }
    EXPECT_GT(registers, 1000) << name;
  }
}

TEST(Meanings, NameTheAxisAndTheNumber) {
  const Model& simple2 = model_of("simple2-r3");
  EXPECT_EQ(meaning(simple2, "Cord_B"), "coordinate of axis B: position in pulses sent");
  EXPECT_EQ(meaning(simple2, "Parms_Speed16"), "speed of position set 16");
  EXPECT_EQ(heading(simple2, "Aaxis_AccTime"), "A 軸加速時間");
  const Model& super40 = model_of("super-40nc");
  EXPECT_EQ(meaning(super40, "D8217"), "Y: present position in work coordinates");
  EXPECT_EQ(meaning(super40, "M8404"), "U: jogs in the negative direction while on");
  EXPECT_EQ(meaning(super40, "M8571"), "manual page, key: homing of U");
  EXPECT_EQ(heading(super40, "M8571"), "手動頁 U 軸 HOME 鍵");
  EXPECT_EQ(meaning(super40, "M8027"), "reserved");
  EXPECT_EQ(meaning(super40, "D9018"), "swaps CW and CCW in XZ");
  const Model& rsm = model_of("rs-m8194h");
  EXPECT_EQ(meaning(rsm, "holding.Logic Position Z"), "position of axis Z by the pulses sent");
  EXPECT_EQ(meaning(rsm, "VAR511"), "variable VAR511 of macros");
  EXPECT_EQ(heading(rsm, "U DRIVING"), "U 軸的驅動狀態");
}

/// Two registers of a manual rarely stand for the same. Where they do, their meanings would not help.
TEST(Meanings, TellSimple2sRegistersApart) {
  std::map<std::string, std::string> names;
  for (const RegisterRow& row : register_rows(model_of("simple2-r3"))) {
    for (int index = 0; index < row.count; ++index) {
      const auto [known, is_new] = names.emplace(meaning_of(row, index), RegisterMap::name_of(row, index));
      EXPECT_TRUE(is_new) << known->first << ": " << known->second << ", "
                          << RegisterMap::name_of(row, index);
    }
  }
}

TEST(Meanings, StandInTheSheetsOfDescribe) {
  for (const char* what : {"registers", "parameters"}) {
    const Sheet sheet = *describe(model_of("simple2-r3"), what, SheetFormat::json);
    const auto column = std::find(sheet.columns.begin(), sheet.columns.end(), "meaning");
    ASSERT_NE(column, sheet.columns.end()) << what;
    const auto place = static_cast<std::size_t>(column - sheet.columns.begin());
    for (const auto& row : sheet.rows) EXPECT_NE(row.at(place), "") << what << " " << row.at(0);
  }
}

}  // namespace meanings_test
}  // namespace understudy::emulator
