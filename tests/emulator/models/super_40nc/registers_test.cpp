// Every contact and register of the SUPER-40NC compared with the facts from its manual.
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "tests/emulator/models/super_40nc/one_super40nc.h"
#include "tests/interpreter/facts.h"

namespace understudy::emulator::models::super_40nc {
namespace registers_test {

/// A row of the manual's tables: consecutive devices of one kind.
struct RegisterFact {
  Table table = Table::coil;
  int address = 0;
  int count = 1;
  std::string first_name;
  std::string letter;
  int first = 0;
  bool is_read_only = false;
  bool is_kept = false;
  Value power_up = 0;
  std::string effect;

  int words() const { return table == Table::holding ? 2 : 1; }
  int address_of(int index) const { return address + index * words(); }
  std::string name_of(int index) const {
    const std::string name = letter + std::to_string(first + index);
    if (letter != "T" && letter != "C") return name;
    return (table == Table::coil ? "coil." : "holding.") + name;
  }
};

std::vector<RegisterFact> facts() {
  std::vector<RegisterFact> made;
  for (const Fact& fact : read_facts(TEST_FACTS "/models/super_40nc/super_40nc_registers.csv")) {
    RegisterFact row;
    row.table = fact.at("table") == "coil"       ? Table::coil
                : fact.at("table") == "discrete" ? Table::discrete
                                                 : Table::holding;
    row.letter = fact.at("device");
    row.first = std::stoi(fact.at("first"));
    row.count = std::stoi(fact.at("last")) - row.first + 1;
    row.address = std::stoi(fact.at("address"));
    row.is_read_only = fact.at("access") == "R";
    row.is_kept = fact.at("kept") == "1";
    row.power_up = std::stoll(fact.at("power_up"));
    row.effect = fact.at("effect");
    made.push_back(row);
  }
  EXPECT_EQ(made.size(), 1285U);
  return made;
}

TEST(Super40ncRegisters, AreThoseOfTheManualAndNoOthers) {
  std::map<std::pair<Table, int>, int> wanted;
  for (const RegisterFact& fact : facts()) {
    for (int i = 0; i < fact.count; ++i) ++wanted[{fact.table, fact.address_of(i)}];
  }
  for (const auto& [place, times] : wanted) EXPECT_EQ(times, 1);
  std::map<Table, int> counts;
  for (const RegisterRow& row : register_rows(model())) {
    for (int i = 0; i < row.count; ++i) {
      EXPECT_EQ(wanted.count({row.table, row.address + i * row.stride}), 1U)
          << row.name << " " << row.address;
      ++counts[row.table];
    }
  }
  EXPECT_EQ(counts[Table::coil], 1468);
  EXPECT_EQ(counts[Table::discrete], 48);
  EXPECT_EQ(counts[Table::holding], 4196);
}

TEST(Super40ncRegisters, HaveTheManualsNamesAccessAndMemory) {
  for (const RegisterFact& fact : facts()) {
    for (int i = 0; i < fact.count; ++i) {
      const auto found = find_register(model(), fact.name_of(i), 0);
      ASSERT_TRUE(found) << fact.name_of(i);
      const RegisterRow& row = *found->place.row;
      ASSERT_EQ(found->place.address(), fact.address_of(i)) << fact.name_of(i);
      ASSERT_EQ(row.table, fact.table) << fact.name_of(i);
      ASSERT_EQ(row.persistent, fact.is_kept) << fact.name_of(i);
      ASSERT_EQ(row.access == Access::read, fact.is_read_only) << fact.name_of(i);
      ASSERT_EQ(row.type, fact.table == Table::holding ? Type::s32 : Type::bit) << fact.name_of(i);
    }
  }
}

TEST(Super40ncRegisters, HaveTheirValuesAtPowerUp) {
  const OneSuper40nc one;
  for (const RegisterFact& fact : facts()) {
    for (int i = 0; i < fact.count; ++i) {
      ASSERT_EQ(one.get(fact.name_of(i)), fact.power_up) << fact.name_of(i);
    }
  }
}

/// One for each kind of row: stored values read back, and computed values stay.
TEST(Super40ncRegisters, StoreWhatIsWrittenOrIgnoreIt) {
  for (const RegisterFact& fact : facts()) {
    if (fact.table == Table::discrete) continue;
    if (fact.effect == "acts" || fact.effect == "acts_power_cycle") continue;
    OneSuper40nc one;
    const Value value = fact.table == Table::coil ? 1 : 1234567;
    const std::string name = fact.name_of(fact.count - 1);
    const Value before = one.get(name);
    std::array<std::uint16_t, 2> words{static_cast<std::uint16_t>(value),
                                       static_cast<std::uint16_t>(value >> 16)};
    const auto address = static_cast<std::uint16_t>(fact.address_of(fact.count - 1));
    ASSERT_EQ(write_words(*one.device().register_bank(), fact.table, address,
                          std::span(words).first(static_cast<std::size_t>(fact.words()))),
              Refusal::none)
        << name;
    // The chip's registers keep what is written until a motion starts.
    const bool is_shown = name == "D8019" || name == "M8003" || name == "M8022" || name == "M8023";
    const bool is_cell = fact.effect == "stored" || (!fact.is_read_only && !is_shown);
    ASSERT_EQ(one.get(name), is_cell ? value : before) << name;
  }
}

TEST(Super40ncRegisters, LatchedOnesOutliveThePower) {
  OneSuper40nc one;
  const auto facts_now = facts();
  const auto is_tried = [](const RegisterFact& fact) {
    return fact.table != Table::discrete && !fact.is_read_only && (fact.effect == "stored" || fact.is_kept);
  };
  // D9000 to D9002 change where the rest is found.
  const auto is_apart = [](const std::string& name) {
    return name == "D9001" || name == "D9002" || name == "D9045" || name == "D9000";
  };
  for (const RegisterFact& fact : facts_now) {
    const std::string name = fact.name_of(0);
    if (is_tried(fact) && !is_apart(name)) one.set(name, fact.table == Table::coil ? 1 : 7);
  }
  one.world().switch_power(0, false);
  one.run(10);
  one.world().switch_power(0, true);
  for (const RegisterFact& fact : facts_now) {
    const std::string name = fact.name_of(0);
    if (!is_tried(fact) || is_apart(name)) continue;
    const Value written = fact.table == Table::coil ? 1 : 7;
    EXPECT_EQ(one.get(name), fact.is_kept ? written : fact.power_up) << name;
  }
}

TEST(Super40ncRegisters, ParametersReturnToTheFactorysValues) {
  OneSuper40nc one;
  const auto facts_now = facts();
  const auto is_parameter = [](const RegisterFact& fact) {
    return fact.letter == "D" && fact.first >= 9000 && !fact.is_read_only;
  };
  for (const RegisterFact& fact : facts_now) {
    if (is_parameter(fact) && fact.first > 9002) one.set(fact.name_of(0), 3);
  }
  one.set("D500", 77);
  one.press("M8008");
  for (const RegisterFact& fact : facts_now) {
    if (!is_parameter(fact)) continue;
    EXPECT_EQ(one.get(fact.name_of(0)), fact.power_up) << fact.name_of(0);
  }
  EXPECT_EQ(one.get("D500"), 77);
  EXPECT_EQ(one.get("D9042"), 1500);
}

TEST(Super40ncRegisters, LimitsFollowTheirParametersAtOnce) {
  OneSuper40nc one;
  one.set("D9171", 8);
  one.set("D9172", 5);
  EXPECT_EQ(one.get("D8144"), 15999998);  // 9,999,999 by 8/5, away from 0
  one.set("D9185", 1000);
  EXPECT_EQ(one.get("D8144"), 1600);
  EXPECT_EQ(one.get("D8145"), -15999998);
  one.set("D9263", 2);
  EXPECT_EQ(one.get("D8218"), 2);
  one.set("D9185", 9999999);
  one.set("D9171", 131072);
  one.set("D9172", 1);  // beyond 28 bits: it wraps (《X35.》)
  constexpr Value kPulses = Value{9999999} * 131072;
  constexpr Value kRange = Value{1} << 28;
  EXPECT_EQ(one.get("D8144"), ((kPulses + kRange / 2) % kRange) - kRange / 2);
}

TEST(Super40ncRegisters, OutputVoltagesAreLimited) {
  OneSuper40nc one;
  const int vout2 = find_terminal(model(), "Vout2");
  for (const auto& [written, stored, millivolts] :
       {std::tuple{500, 500, 1650}, std::tuple{1001, 1000, 3300}, std::tuple{-1, 0, 0}}) {
    one.set("D8004", written);
    EXPECT_EQ(one.get("D8004"), stored);
    EXPECT_EQ(one.device().terminals()->analog_level(vout2), millivolts);
  }
  one.input("VR3", 1000);
  one.run(1);
  EXPECT_EQ(one.get("D8093"), 1000);
}

/// Many in a request equal each on its own: in rows, between rows, views of other state, from any first bit
/// or word to any last one.
TEST(Super40ncRegisters, AreReadManyAtOnceAsOneByOne) {
  OneSuper40nc one({.program = "AREA X\nRPM K100\nDRV K50000\nEND\nAREA PLC\nLD M8120\nOUT Y3\nEND\n"});
  std::mt19937 random(20241125);
  const auto any = [&](int below) { return static_cast<int>(random() % static_cast<unsigned>(below)); };
  for (int i = 0; i < 300; ++i) {
    one.set("M" + std::to_string(any(512)), any(2));
    one.set("D" + std::to_string(any(1000)), static_cast<std::int32_t>(random()));
  }
  for (const char* contact : {"M8100", "M8203", "M8500", "M8699", "M8012", "S5", "coil.T9"})
    one.set(contact, 1);
  one.input("X13", 1);
  one.input("ALM_U", 1);
  one.run(700);
  const RegisterBank& bank = *one.device().register_bank();
  struct Range {
    Table table;
    int first, last;
  };
  const Range kRanges[] = {
      {Table::coil, 0, 31},         {Table::coil, 200, 327},      {Table::coil, 1000, 1511},
      {Table::coil, 2000, 2699},    {Table::discrete, 0, 47},     {Table::holding, 0, 2127},
      {Table::holding, 2500, 2563}, {Table::holding, 7000, 8199}, {Table::holding, 9000, 9999}};
  for (int round = 0; round < 3000; ++round) {
    const Range& range = kRanges[any(std::size(kRanges))];
    const int max = range.table == Table::holding ? 125 : 800;
    const int first = range.first + any(range.last - range.first + 1);
    const int count = 1 + any(std::min(max, range.last - first + 1));
    const auto alone = [&](int i) {
      const Place place = bank.at(range.table, static_cast<std::uint16_t>(first + i));
      return static_cast<std::uint16_t>(read_value(bank, place));
    };
    const auto address = static_cast<std::uint16_t>(first);
    if (range.table == Table::holding) {
      std::vector<std::uint16_t> words(static_cast<std::size_t>(count));
      ASSERT_FALSE(read_request(bank, range.table, address, words));
      for (int i = 0; i < count; ++i) ASSERT_EQ(words[static_cast<std::size_t>(i)], alone(i)) << first + i;
      continue;
    }
    std::vector<std::uint8_t> packed(static_cast<std::size_t>(count + 7) / 8, 0xFF);
    ASSERT_FALSE(read_bits_request(bank, range.table, address, static_cast<std::size_t>(count), packed));
    for (int i = 0; i < 8 * static_cast<int>(packed.size()); ++i) {
      const int bit = packed[static_cast<std::size_t>(i / 8)] >> i % 8 & 1;
      ASSERT_EQ(bit, i < count ? alone(i) : 0) << first + i << " of " << first << " and " << count;
    }
  }
}

TEST(Super40ncRegisters, CapacitiesFollowTheLinesOfAFile) {
  OneSuper40nc one;
  for (const auto& [lines, of_c, files] : {std::tuple{1000, 1000, 30}, std::tuple{7000, 1500, 4},
                                           std::tuple{0, 1, 30000}, std::tuple{99999, 1500, 1}}) {
    one.set("D9045", lines);
    EXPECT_EQ(one.get("D9042"), of_c) << lines;
    EXPECT_EQ(one.get("D9043"), files) << lines;
  }
}

}  // namespace registers_test
}  // namespace understudy::emulator::models::super_40nc
