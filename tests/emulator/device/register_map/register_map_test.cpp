// Places, names, and the maps that are refused.
#include "emulator/device/register_map/register_map.h"

#include <gtest/gtest.h>

#include "tests/emulator/device/register_map/toy_device.h"

namespace understudy::emulator {
namespace register_map_test {

using Part = Place::Part;

TEST(RegisterMap, KnowsWhatIsAtAnAddress) {
  const Toy toy(kToyRows);
  struct Case {
    std::uint16_t address;
    std::string_view row;  // nothing is there if it is empty
    int index;
    Part part;
  };
  const std::vector<Case> cases = {
      {0x000F, "", 0, {}},
      {0x0010, "Speed", 0, Part::whole},
      {0x0012, "Target", 0, Part::low},
      {0x0013, "Target", 0, Part::high},
      {0x0016, "Start", 0, Part::whole},
      {0x0018, "", 0, {}},
      {0x0020, "Cell{}", 0, Part::whole},
      {0x0021, "Far{}", 0, Part::low},
      {0x0022, "Far{}", 0, Part::high},
      {0x0023, "", 0, {}},
      {0x0028, "Cell{}", 2, Part::whole},
      {0x002A, "Far{}", 2, Part::high},
      {0x002C, "", 0, {}},
      {0xFFFF, "", 0, {}},
  };
  for (const Case& c : cases) {
    const Place place = toy.map.at(Table::holding, c.address, 200, true);
    ASSERT_EQ(static_cast<bool>(place), !c.row.empty()) << std::hex << c.address;
    if (!place) continue;
    EXPECT_EQ(place.row->name, c.row) << std::hex << c.address;
    EXPECT_EQ(place.index, c.index) << std::hex << c.address;
    EXPECT_EQ(place.part, c.part) << std::hex << c.address;
  }
}

TEST(RegisterMap, TheOrderOfWordsIsTheCallersAtEveryLook) {
  const Toy toy(kToyRows);
  EXPECT_EQ(toy.map.at(Table::holding, 0x0012, 200, true).part, Part::low);
  EXPECT_EQ(toy.map.at(Table::holding, 0x0013, 200, true).part, Part::high);
  EXPECT_EQ(toy.map.at(Table::holding, 0x0012, 200, false).part, Part::high);
  EXPECT_EQ(toy.map.at(Table::holding, 0x0013, 200, false).part, Part::low);
  EXPECT_EQ(toy.map.at(Table::holding, 0x0010, 200, false).part, Part::whole);
}

TEST(RegisterMap, FindsNamesAliasesHalvesAndBits) {
  const Toy toy(kToyRows);
  struct Case {
    std::string_view name;
    std::uint16_t address;
    int index;
    Part part;
    int bit;
  };
  const std::vector<Case> cases = {
      {"Speed", 0x0010, 0, Part::whole, -1},     {"Speed.0", 0x0010, 0, Part::whole, 0},
      {"Speed.15", 0x0010, 0, Part::whole, 15},  {"Target", 0x0012, 0, Part::whole, -1},
      {"Target.31", 0x0012, 0, Part::whole, 31}, {"Target_L", 0x0012, 0, Part::low, -1},
      {"Target_H", 0x0012, 0, Part::high, -1},   {"Target_H.15", 0x0012, 0, Part::high, 15},
      {"Goal", 0x0012, 0, Part::whole, -1},      {"Goal_H", 0x0012, 0, Part::high, -1},
      {"Cell1", 0x0020, 0, Part::whole, -1},     {"Cell3", 0x0028, 2, Part::whole, -1},
      {"Far2_RegL", 0x0025, 1, Part::low, -1},   {"Far2_RegH", 0x0025, 1, Part::high, -1},
      {"Far3.30", 0x0029, 2, Part::whole, 30},
  };
  for (const Case& c : cases) {
    const auto found = toy.map.find(c.name, 200);
    ASSERT_TRUE(found) << c.name;
    EXPECT_EQ(found->place.address(), c.address) << c.name;
    EXPECT_EQ(found->place.index, c.index) << c.name;
    EXPECT_EQ(found->place.part, c.part) << c.name;
    EXPECT_EQ(found->bit, c.bit) << c.name;
  }
}

TEST(RegisterMap, RefusesNamesThatAreNearlyRight) {
  const Toy toy(kToyRows);
  for (const char* name : {"",
                           ".",
                           ".4",
                           "speed",
                           "Speed ",
                           " Speed",
                           "Speed_L",
                           "Speed.",
                           "Speed.16",
                           "Speed.-1",
                           "Speed.+1",
                           "Speed.1.1",
                           "Speed.x",
                           "Speed.4x",
                           "Speed.99999999999999999999",
                           "Target_L.16",
                           "Target.32",
                           "Target_RegL",
                           "Cell",
                           "Cell{}",
                           "Cell0",
                           "Cell4",
                           "Cell01",
                           "Far1_L",
                           "Goal1"}) {
    EXPECT_FALSE(toy.map.find(name, 200)) << "'" << name << "'";
  }
}

TEST(RegisterMap, AnEmbeddedZeroByteDoesNotEndAName) {
  const Toy toy(kToyRows);
  EXPECT_FALSE(toy.map.find(std::string_view("Speed\0", 6), 200));
  EXPECT_FALSE(toy.map.find(std::string_view("Speed.1\0", 8), 200));
}

TEST(RegisterMap, HasNothingThatAFirmwareDoesNotHave) {
  const Toy toy(kToyRows);
  EXPECT_FALSE(toy.map.at(Table::holding, 0x0040, 199, true));
  EXPECT_TRUE(toy.map.at(Table::holding, 0x0040, 200, true));
  EXPECT_FALSE(toy.map.find("New", 199));
  EXPECT_TRUE(toy.map.find("New", 200));
}

TEST(RegisterMap, TablesAreSpacesOfTheirOwn) {
  const RegisterRow rows[] = {reg(0x0010, "Speed", Type::u16, Access::read_write), coil(0x0010, "Lamp")};
  const RegisterMap map(rows, {});
  EXPECT_EQ(map.at(Table::holding, 0x0010, 0, true).row->name, "Speed");
  EXPECT_EQ(map.at(Table::coil, 0x0010, 0, true).row->name, "Lamp");
  EXPECT_FALSE(map.at(Table::input, 0x0010, 0, true));
  EXPECT_FALSE(map.at(Table::discrete, 0x0010, 0, true));
}

TEST(RegisterMap, EveryQuantityHasItsOwnSlot) {
  const Toy toy(kToyRows);
  EXPECT_EQ(toy.map.slot_count(), 15);  // nine single rows, two rows of three
  std::vector<int> slots;
  for (const char* name : {"Speed", "Angle", "Target", "Count", "Start", "State", "Trim", "Bits", "Cell1",
                           "Cell2", "Cell3", "Far1", "Far2", "Far3", "New"}) {
    slots.push_back(toy.named(name).place.slot);
  }
  std::sort(slots.begin(), slots.end());
  EXPECT_EQ(std::unique(slots.begin(), slots.end()), slots.end());
  EXPECT_EQ(slots.front(), 0);
  EXPECT_EQ(slots.back(), 14);
}

TEST(RegisterMap, RefusesRowsThatClaimOneAddress) {
  const auto u16 = [](std::uint16_t address, std::string_view name) {
    return reg(address, name, Type::u16, Access::read_write);
  };
  const auto u32 = [](std::uint16_t address, std::string_view name) {
    return reg(address, name, Type::u32, Access::read_write);
  };
  struct Clash {
    std::vector<RegisterRow> rows;
    const char* what;
  };
  const std::vector<Clash> clashes = {
      {{u16(0x10, "a"), u16(0x10, "b")}, "b shares its address with a"},
      {{u32(0x10, "a"), u16(0x11, "b")}, "b shares its address with a"},
      {{u16(0x11, "a"), u32(0x10, "b")}, "b shares its address with a"},
      {{u32(0x10, "a"), u32(0x11, "b")}, "b shares its address with a"},
      {{u16(0x10, "a{}").times(4, 2, 0), u16(0x16, "b")}, "b shares its address with a3"},
      {{u16(0x10, "a{}").times(4, 2, 0), u16(0x11, "b{}").times(4, 1, 0)}, "b1 shares its address with a1"},
      {{u32(0x10, "a{}").times(2, 1, 0)}, "a{} has registers that overlap"},
      {{u16(0x10, "a{}").times(2, 0, 0)}, "a{} has registers that overlap"},
  };
  for (const Clash& clash : clashes) {
    try {
      const RegisterMap map(clash.rows, {});
      FAIL() << "taken, though " << clash.what;
    } catch (const std::logic_error& error) {
      EXPECT_STREQ(error.what(), (std::string("register map: ") + clash.what).c_str());
    }
  }
}

TEST(RegisterMap, RefusesRowsThatClaimOneName) {
  const auto u16 = [](std::uint16_t address, std::string_view name) {
    return reg(address, name, Type::u16, Access::read_write);
  };
  const auto u32 = [](std::uint16_t address, std::string_view name) {
    return reg(address, name, Type::u32, Access::read_write);
  };
  const std::vector<std::vector<RegisterRow>> bad = {
      {u16(0x10, "a"), u16(0x11, "a")},   {u16(0x10, "a").also("b"), u16(0x11, "b")},
      {u16(0x10, "a").also("a")},         {u32(0x10, "a"), u16(0x12, "a_L")},
      {u16(0x12, "a_H"), u32(0x10, "a")}, {u16(0x10, "a{}").times(3, 1, 0), u16(0x20, "a2")},
      {u16(0x10, "a").times(2, 1, 0)},  // a range without numbers
  };
  for (const auto& rows : bad) {
    EXPECT_THROW(RegisterMap(rows, {}).require_distinct_names(), std::logic_error)
        << rows[0].name << " and " << rows.back().name;
  }
}

TEST(RegisterMap, TouchingAddressesAndLikeNamesAreNoClash) {
  const RegisterRow rows[] = {
      reg(0x10, "a", Type::u32, Access::read_write),
      reg(0x12, "a{}", Type::u32, Access::read_write).times(2, 2, 0),
      reg(0x16, "a_", Type::u16, Access::read_write),
      reg(0xFFFF, "last", Type::u16, Access::read_write),
      reg(0x0000, "first", Type::u16, Access::read_write),
  };
  EXPECT_EQ(RegisterMap(rows, {}).slot_count(), 6);
}

TEST(RegisterMap, NumbersNamesFromTheRowsFirstNumberOn) {
  const RegisterRow row = reg(0x10, "LINE{}_CMD", Type::u16, Access::read_write).times(300, 1, 5);
  EXPECT_EQ(RegisterMap::name_of(row, 0), "LINE5_CMD");
  EXPECT_EQ(RegisterMap::name_of(row, 250), "LINE255_CMD");
  EXPECT_EQ(RegisterMap::name_of(row, 2, "{}th"), "7th");
  EXPECT_EQ(RegisterMap::name_of(row, 2, "plain"), "plain");
}

TEST(RegisterMap, SuggestsANameWithoutItsBit) {
  const Toy toy(kToyRows);
  const auto end = [&](const char* name) {
    const std::string diagnostic = toy.map.why_not(name, 100);
    return diagnostic.substr(diagnostic.find(';'));
  };
  EXPECT_EQ(end("Spedd"), "; the nearest is 'Speed'");
  EXPECT_EQ(end("Spedd.12"), "; the nearest is 'Speed'");
  EXPECT_EQ(end("Targt_L"), "; the nearest is 'Target_L'");
  EXPECT_EQ(end("Goall"), "; the nearest is 'Goal'");
}

}  // namespace register_map_test
}  // namespace understudy::emulator
