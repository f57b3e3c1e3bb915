// RS-M8194H's tables compared with the facts from its manual: every address of every table.
#include <gtest/gtest.h>

#include <map>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"
#include "tests/interpreter/facts.h"

namespace understudy::emulator::models::rs_m8194h {
namespace rs_m8194h_table_test {

struct Item {
  Table table = Table::holding;
  int first = 0;
  int words = 1;  // or bits
  Fact fact{};
  bool is_hole() const {
    return fact.at("view_or_stored") == "zero" || fact.at("name").find("(undefined)") != std::string::npos;
  }
};

std::vector<Item> items() {
  std::vector<Item> made;
  for (const Fact& fact : read_facts(TEST_FACTS "/models/rs_m8194h/rs_m8194h_registers.csv")) {
    const std::string& span = fact.at("address_zero_based");
    const int first = std::stoi(span);
    const std::size_t dash = span.find('-');
    const int last = dash == std::string::npos ? first : std::stoi(span.substr(dash + 1));
    const int words = fact.at("width") == "32" ? 2 : 1;
    for (int at = first; at <= last; at += words) {
      made.push_back({.table = *table_called(fact.at("table")), .first = at, .words = words, .fact = fact});
    }
  }
  return made;
}

TEST(RsM8194hTables, EveryPrintedItemHasTheAttributesOfTheManual) {
  const RegisterMap& map = *rs_m8194h::model().registers;
  int there = 0;
  for (const Item& item : items()) {
    SCOPED_TRACE(item.fact.at("table") + " " + std::to_string(item.first));
    if (item.is_hole()) continue;
    const Place place = map.at(item.table, static_cast<std::uint16_t>(item.first), 300, false);
    ASSERT_TRUE(place);
    EXPECT_EQ(place.address(), item.first);
    EXPECT_EQ(width_of(place.row->type), std::stoi(item.fact.at("width")));
    const std::string& access = item.fact.at("access");
    EXPECT_EQ(place.row->access, access == "R/W" ? Access::read_write
                                 : access == "W" ? Access::write
                                                 : Access::read);
    EXPECT_EQ(place.row->persistent, item.fact.at("persistent") == "1");
    const std::string& type = item.fact.at("value_type");
    EXPECT_EQ(is_signed(place.row->type), type == "s32" || type == "f32");
    EXPECT_FALSE(place.row->section.empty());
    ++there;
  }
  EXPECT_GT(there, 2'900);
}

TEST(RsM8194hTables, HoldTheNumbersOfWordsThatTheManualHas) {
  std::map<Table, int> words;
  for (const Item& item : items()) {
    if (!item.is_hole()) words[item.table] += item.words;
  }
  EXPECT_EQ(words[Table::input], 125);
  EXPECT_EQ(words[Table::coil], 132);
}

TEST(RsM8194hTables, AnIdleBoxReadsWhatTheFactsSay) {
  OneRsm rsm;
  for (const Item& item : items()) {
    if (item.fact.at("access").empty() || item.fact.at("access") == "W" || item.fact.at("power_up").empty())
      continue;
    SCOPED_TRACE(item.fact.at("table") + " " + std::to_string(item.first) + " " + item.fact.at("name"));
    std::uint16_t words[2] = {0xAAAA, 0xAAAA};
    ASSERT_EQ(read_words(*rsm.device().register_bank(), item.table, static_cast<std::uint16_t>(item.first),
                         std::span(words).first(static_cast<std::size_t>(item.words))),
              Refusal::none);
    const std::uint32_t value = item.words == 2 ? std::uint32_t{words[0]} << 16 | words[1] : words[0];
    const std::string& wanted = item.fact.at("power_up");
    if (wanted == "kept") {
      EXPECT_EQ(value, 0u);
    } else {
      EXPECT_EQ(value, std::stoul(wanted, nullptr, 0)) << wanted;
    }
  }
}

TEST(RsM8194hTables, PairsComeWholeAtEveryAddressOfEveryTable) {
  OneRsm rsm;
  const RegisterBank& bank = *rsm.device().register_bank();
  for (const Item& item : items()) {
    if (item.words != 2) continue;
    std::uint16_t words[4]{};
    const auto at = static_cast<std::uint16_t>(item.first);
    const auto refused = [&](int offset, std::size_t count) {
      const Objection objection = read_request(bank, item.table, static_cast<std::uint16_t>(at + offset),
                                               std::span(words).first(count));
      return objection.cause == Cause::cut_pair;
    };
    ASSERT_TRUE(refused(0, 1)) << at;
    ASSERT_TRUE(refused(1, 1)) << at;
    ASSERT_FALSE(refused(0, 2)) << at;
  }
}

TEST(RsM8194hTables, TheOrderOfWordsIsThatOfRegister14) {
  OneRsm rsm;
  rsm.set("VAR100", 10000);
  rsm.set("MD1500", value_of_real(321.65F));
  EXPECT_EQ(rsm.ask("03 01 F4 00 02"), "03 04 00 00 27 10");
  EXPECT_EQ(rsm.ask("03 17 70 00 02"), "03 04 43 A0 D3 33");
  rsm.set("WORD_ORDER", 1);
  EXPECT_EQ(rsm.ask("03 01 F4 00 02"), "03 04 27 10 00 00");
  EXPECT_EQ(rsm.ask("03 17 70 00 02"), "03 04 D3 33 43 A0");
  EXPECT_EQ(rsm.ask("04 00 52 00 02"), "04 04 00 00 03 00");
  // Commands as well.
  EXPECT_EQ(rsm.ask(pdu_of("RSM_SET_LP XY 1000000", true)), "10 1F 40 00 04");
  rsm.run(1);
  EXPECT_EQ(rsm.get("LP_Y"), 1000000);
}

TEST(RsM8194hTables, HolesReadZeroAndTheEndIsTheEnd) {
  OneRsm rsm;
  EXPECT_EQ(rsm.ask("04 00 4D 00 02"), "04 04 00 00 00 00");
  EXPECT_EQ(rsm.ask("04 00 56 00 01"), "04 02 00 00");
  EXPECT_EQ(rsm.ask("03 00 0A 00 04"), "03 08 00 00 00 00 00 00 00 00");
  EXPECT_EQ(rsm.ask("04 00 A8 00 01"), "84 02");
  EXPECT_EQ(rsm.ask("01 00 84 00 01"), "81 02");
  EXPECT_EQ(rsm.ask("02 01 84 00 01"), "82 02");
  EXPECT_EQ(rsm.ask("02 01 7C 00 08"), rsm.ask("02 01 18 00 08"));  // U's signals, at both places
  EXPECT_EQ(rsm.ask("06 00 0A 00 01"), "86 02");
}

TEST(RsM8194hTables, HaveShortNamesForPeople) {
  const RegisterMap& map = *rs_m8194h::model().registers;
  for (const char* name : {"LP_X", "ABS_U", "CV_Y", "VAR5", "MD1500", "bVAR127", "EP_Z", "DI_ALL_X",
                           "ERROR_CODE_U", "HOME_STATE_Y", "FREE_BUFFER_SIZE"}) {
    EXPECT_TRUE(map.find(name, 300)) << name;
  }
  EXPECT_TRUE(map.find("MD1500", 300)->is_real());
}

/// Bits of DI_ALL and DI_SIGNAL while a pin conducts, and while it does not (12.5.2, 12.5.4).
struct Polarity {
  Pin pin;
  int all_bit;  // -1: none
  bool all_on;  // the bit while the pin conducts
  int signal_bit;
  bool signal_on;
};
constexpr Polarity kPolarities[] = {
    {Pin::limit_plus, 1, true, -1, false}, {Pin::limit_minus, 2, true, -1, false},
    {Pin::home, 5, false, 1, false},       {Pin::near_home, 6, false, 0, false},
    {Pin::in3, 7, false, 3, false},        {Pin::in_position, 8, false, 6, true},
    {Pin::index, 9, false, 2, false},      {Pin::alarm, -1, false, 7, true},
};

TEST(RsM8194hTables, EachInputShowsWithItsPolarity) {
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    for (const Polarity& row : kPolarities) {
      OneRsm rsm;
      const auto all = static_cast<std::uint16_t>(16 + axis);
      const auto signal = static_cast<std::uint16_t>(88 + axis);
      EXPECT_EQ(rsm.input_word(all), 0x03E0);
      EXPECT_EQ(rsm.input_word(signal), 0x000F);
      rsm.pin(axis, row.pin, true);
      rsm.run(2);
      Value wanted_all = 0x03E0;
      Value wanted_signal = 0x000F;
      if (row.all_bit >= 0) wanted_all ^= Value{1} << row.all_bit;
      if (row.signal_bit >= 0) wanted_signal ^= Value{1} << row.signal_bit;
      EXPECT_EQ(rsm.input_word(all), wanted_all) << axis << " " << static_cast<int>(row.pin);
      EXPECT_EQ(rsm.input_word(signal), wanted_signal) << axis << " " << static_cast<int>(row.pin);
    }
  }
}

TEST(RsM8194hTables, AlarmShowsOnceItIsEnabled) {
  OneRsm rsm;
  rsm.pin(2, Pin::alarm, true);
  rsm.run(2);
  EXPECT_EQ(rsm.get("DI_ALL_Z"), 0x03E0);
  rsm.send("RSM_SET_ALARM Z 1 0");
  EXPECT_EQ(rsm.get("DI_ALL_Z"), 0x03F0);
  rsm.send("RSM_SET_ALARM Z 1 1");
  EXPECT_EQ(rsm.get("DI_ALL_Z"), 0x03E0);
}

TEST(RsM8194hTerminals, GroupsAreNamedAsTheirChannels) {
  const auto& groups = rs_m8194h::model().terminal_groups;
  const auto& rows = rs_m8194h::model().terminals;
  ASSERT_EQ(groups.size(), 16U);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const std::string name = (i < 8 ? "DI_" : "DO_") + std::to_string(i < 8 ? 8 + i : i - 8);
    EXPECT_EQ(groups[i].name, name);
    for (int channel = 0; channel < groups[i].count; ++channel) {
      EXPECT_EQ(rows[static_cast<std::size_t>(groups[i].first + channel)].name,
                name + "_" + std::to_string(channel));
    }
    EXPECT_EQ(groups[i].count, 16);
  }
}

}  // namespace rs_m8194h_table_test
}  // namespace understudy::emulator::models::rs_m8194h
