// The Simple2-R3's tables compared with its manual: every address, name, range, parameter number.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "emulator/device/device.h"
#include "emulator/device/register_map/access.h"
#include "emulator/models/models.h"
#include "tests/emulator/device/register_map/register_facts.h"

namespace understudy::emulator::models::simple2_r3 {
namespace simple2_r3_table_test {

const Model& simple2() { return *find_model(all_models(), "simple2-r3"); }

constexpr Firmware kOldest = 139;
constexpr Firmware kNewest = 152;

TEST(Simple2Registers, ThereAre1418WordsOfWhichThreeCameWithFirmware151) {
  const auto facts = simple2_r3_registers();
  std::set<std::uint16_t> addresses;
  std::set<std::uint16_t> late;
  for (const RegisterFact& fact : facts) {
    addresses.insert(fact.address);
    if (fact.since != 0) late.insert(fact.address);
  }
  EXPECT_EQ(addresses.size(), 1418u);
  EXPECT_EQ(late, (std::set<std::uint16_t>{0xFF07, 0xFF08, 0xFF09}));
}

TEST(Simple2Registers, ExactlyTheManualsAddressesExistInEveryFirmware) {
  std::map<std::uint16_t, int> since;
  for (const RegisterFact& fact : simple2_r3_registers()) since[fact.address] = fact.since;
  for (const Firmware firmware : simple2().firmwares) {
    int there = 0;
    for (unsigned address = 0; address <= 0xFFFF; ++address) {
      const auto fact = since.find(static_cast<std::uint16_t>(address));
      const bool wanted = fact != since.end() && firmware >= fact->second;
      const Place place =
          simple2().registers->at(Table::holding, static_cast<std::uint16_t>(address), firmware, true);
      EXPECT_EQ(static_cast<bool>(place), wanted) << std::hex << address << " in firmware " << firmware;
      if (place) ++there;
    }
    EXPECT_EQ(there, firmware < 151 ? 1415 : 1418) << firmware;
  }
}

TEST(Simple2Registers, NoOtherTableHasAnything) {
  for (const Table table : {Table::input, Table::coil, Table::discrete}) {
    for (unsigned address = 0; address <= 0xFFFF; ++address) {
      EXPECT_FALSE(simple2().registers->at(table, static_cast<std::uint16_t>(address), kNewest, true));
    }
  }
}

TEST(Simple2Registers, EachHasTheAttributesThatTheManualGives) {
  for (const RegisterFact& fact : simple2_r3_registers()) {
    SCOPED_TRACE(fact.name);
    const Place place = simple2().registers->at(Table::holding, fact.address, kNewest, true);
    ASSERT_TRUE(place);
    const RegisterRow& row = *place.row;
    EXPECT_EQ(row.access, fact.access());
    EXPECT_EQ(is_32_bit(row.type), fact.is_32_bit);
    EXPECT_EQ(is_signed(row.type), fact.is_signed);
    EXPECT_EQ(row.ranged, fact.min.has_value());
    EXPECT_EQ(row.min, fact.min.value_or(0));
    EXPECT_EQ(row.max, fact.max.value_or(0));
    EXPECT_EQ(row.unit, fact.unit);
    EXPECT_EQ(row.persistent, fact.persistent);
    const auto bits = static_cast<std::uint32_t>(row.factory);
    EXPECT_EQ(static_cast<std::uint16_t>(fact.half == 'H' ? bits >> 16 : bits), fact.factory_word);
    EXPECT_FALSE(row.section.empty());
    const Place::Part part = fact.half == 'L'   ? Place::Part::low
                             : fact.half == 'H' ? Place::Part::high
                                                : Place::Part::whole;
    EXPECT_EQ(place.part, part);
    EXPECT_EQ(place.address(), fact.address - (fact.half == 'H' ? 1 : 0));
  }
}

TEST(Simple2Registers, EachIsFoundByEverySpellingOfTheManual) {
  for (const RegisterFact& fact : simple2_r3_registers()) {
    const Place there = simple2().registers->at(Table::holding, fact.address, kNewest, true);
    ASSERT_TRUE(there);
    for (const std::string& name : {fact.name, fact.other_name}) {
      // 0xF02A is printed with the name of 0xF029 again; that name means the first one.
      if (name.empty() || (fact.address == 0xF02A && name == "Axis_SyncRPM")) continue;
      const auto found = simple2().registers->find(name, kNewest);
      ASSERT_TRUE(found) << name;
      EXPECT_EQ(found->place.slot, there.slot) << name;
      EXPECT_EQ(found->place.part, there.part) << name;
      EXPECT_EQ(found->bit, -1) << name;
      if (!fact.is_32_bit) continue;
      const auto whole = simple2().registers->find(without_half(name), kNewest);
      ASSERT_TRUE(whole) << without_half(name);
      EXPECT_EQ(whole->place.slot, there.slot) << name;
      EXPECT_EQ(whole->place.part, Place::Part::whole) << name;
    }
  }
}

TEST(Simple2Registers, NamesOfNewerFirmwareAreUnknownToOlderOnes) {
  for (const char* name : {"PWD_Input", "PWD_INPUT", "PROG_UNLOCK", "NEW_PWD"}) {
    EXPECT_TRUE(simple2().registers->find(name, kNewest)) << name;
    EXPECT_TRUE(simple2().registers->find(name, 151)) << name;
    EXPECT_FALSE(simple2().registers->find(name, 150)) << name;
    EXPECT_FALSE(simple2().registers->find(name, kOldest)) << name;
  }
}

TEST(Simple2Registers, EveryQuantityHasAPlaceOfItsOwnInTheImage) {
  std::map<int, std::string> owners;
  for (const RegisterFact& fact : simple2_r3_registers()) {
    if (fact.half == 'H') continue;
    const Place place = simple2().registers->at(Table::holding, fact.address, kNewest, true);
    ASSERT_TRUE(place);
    EXPECT_GE(place.slot, 0);
    EXPECT_LT(place.slot, simple2().registers->slot_count());
    const auto [owner, is_new] = owners.emplace(place.slot, fact.name);
    EXPECT_TRUE(is_new) << fact.name << " and " << owner->second;
  }
  EXPECT_EQ(owners.size(), 1418u - 111u);  // 111 quantities take two addresses
  EXPECT_EQ(simple2().registers->slot_count(), 1418 - 111);
}

TEST(Simple2Parameters, AreThe175NumbersOfTheManual) {
  std::map<int, Place> places;
  for (const ParameterRow& row : simple2().parameters) {
    for (int i = 0; i < row.count; ++i) {
      for (const RegisterRow& candidate : simple2().registers->rows()) {
        if (candidate.name != row.register_name) continue;
        const auto at = static_cast<std::uint16_t>(candidate.address + i * candidate.stride);
        const Place place = simple2().registers->at(Table::holding, at, kNewest, true);
        EXPECT_TRUE(place) << row.register_name << " " << i;
        EXPECT_TRUE(places.emplace(row.first + i, place).second) << row.first + i << " appears twice";
      }
    }
  }
  const auto facts = read_facts(TEST_FACTS "/models/simple2_r3/simple2_r3_parameters.csv");
  ASSERT_EQ(facts.size(), 175u);
  EXPECT_EQ(places.size(), facts.size());
  for (const Fact& fact : facts) {
    const auto place = places.find(std::stoi(fact.at("number")));
    ASSERT_NE(place, places.end()) << "parameter " << fact.at("number");
    const RegisterRow& row = *place->second.row;
    EXPECT_EQ(place->second.address(), std::stoi(fact.at("address"), nullptr, 16)) << fact.at("number");
    EXPECT_EQ(is_32_bit(row.type), fact.at("width") == "32") << fact.at("number");
    EXPECT_EQ(row.persistent, fact.at("persistent") == "1") << fact.at("number");
  }
}

}  // namespace simple2_r3_table_test
}  // namespace understudy::emulator::models::simple2_r3
