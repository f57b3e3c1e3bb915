// The commands of the window by name, for each code of the manual and in both word orders.
#include "emulator/models/rs_m8194h/command_names.h"

#include <map>
#include <random>

#include "emulator/device/program_error.h"
#include "tests/emulator/models/rs_m8194h/one_rsm.h"
#include "tests/interpreter/facts.h"

namespace understudy::emulator::models::rs_m8194h {
namespace command_names_test {

using Words = std::vector<std::uint16_t>;

constexpr WindowForm kForms[] = {{.firmware = 300, .low_word_first = false},
                                 {.firmware = 300, .low_word_first = true}};

std::string name_in(const std::string& text) { return text.substr(0, text.find(' ')); }

std::string diagnostic_of(const std::string& text) {
  try {
    command_names().words_of(text, kForms[0]);
  } catch (const ProgramError& error) {
    return in_line(error.first());
  }
  return "none";
}

/// A parameter from the manual's table: its number of registers, and a valid random value.
struct Allowed {
  std::string name;
  std::string rule;
  std::string type;
  int registers = 1;
  std::int64_t min = 0;
  std::int64_t max = 0;
  std::vector<std::int64_t> list{};
};

std::map<int, std::vector<Allowed>> parameters_by_low_byte() {
  std::map<int, std::vector<Allowed>> all;
  for (const Fact& fact : read_facts(PROJECT_FOLDER "/tests/interpreter/rs_m8194h/parameters.csv")) {
    Allowed one{.name = fact.at("parameter"),
                .rule = fact.at("rule"),
                .type = fact.at("type"),
                .registers = std::stoi(fact.at("registers"))};
    if (!fact.at("least").empty()) one.min = std::stoll(fact.at("least"));
    if (!fact.at("most").empty()) one.max = std::stoll(fact.at("most"));
    std::string list = fact.at("list");
    while (!list.empty()) {
      std::size_t used = 0;
      one.list.push_back(std::stoll(list, &used));
      list.erase(0, used);
    }
    all[std::stoi(fact.at("low"), nullptr, 16)].push_back(one);
  }
  return all;
}

/// A message as a host writes it: the code, then each parameter, in the requested word order.
class Message {
 public:
  explicit Message(std::uint16_t code) : words_{code} {}
  void add(std::uint32_t value, int registers, bool low_word_first) {
    const auto high = static_cast<std::uint16_t>(value >> 16);
    const auto low = static_cast<std::uint16_t>(value);
    if (registers == 1) {
      words_.push_back(low);
    } else {
      words_.insert(words_.end(), {low_word_first ? low : high, low_word_first ? high : low});
    }
  }
  const Words& words() const { return words_; }

 private:
  Words words_;
};

std::uint32_t good_value(const Allowed& one, std::int64_t& free_axis, std::mt19937& random) {
  if (one.rule.starts_with("one axis")) {
    const std::int64_t axis = free_axis;
    free_axis *= 2;
    return static_cast<std::uint32_t>(axis);
  }
  if (one.rule == "operator") return one.type == "W" ? 0x3C : '+';
  if (one.rule == "if used") return 1;
  if (one.name == "Lp" || one.name == "Wp") return static_cast<std::uint32_t>(one.max);
  if (!one.list.empty()) return static_cast<std::uint32_t>(one.list[random() % one.list.size()]);
  const auto count = static_cast<std::uint64_t>(one.max - one.min) + 1;
  return static_cast<std::uint32_t>(one.min + static_cast<std::int64_t>(random() % count));
}

TEST(RsM8194hCommandNames, EveryCodesTextMeansItsMessageInBothOrders) {
  std::mt19937 random(17);  // NOLINT(cert-msc51-cpp): the same in every run
  const auto parameters = parameters_by_low_byte();
  int codes = 0;
  for (const Fact& fact : read_facts(PROJECT_FOLDER "/tests/interpreter/rs_m8194h/commands.csv")) {
    const auto code = static_cast<std::uint16_t>(std::stoul(fact.at("code"), nullptr, 16));
    const auto found = parameters.find(code & 0xFF);
    ++codes;
    int taken = 0;
    for (int i = 0; i < 50; ++i) {
      Message high_first(code);
      Message low_first(code);
      std::int64_t free_axis = 1;
      for (const Allowed& one : found == parameters.end() ? std::vector<Allowed>{} : found->second) {
        const std::uint32_t value = good_value(one, free_axis, random);
        high_first.add(value, one.registers, false);
        low_first.add(value, one.registers, true);
      }
      const auto text = command_names().text_of(high_first.words(), kForms[0]);
      EXPECT_EQ(command_names().text_of(low_first.words(), kForms[1]), text) << fact.at("code");
      // One parameter can forbid another's value.
      if (!text) continue;
      ++taken;
      EXPECT_EQ(name_in(*text), fact.at("name"));
      EXPECT_EQ(command_names().words_of(*text, kForms[0]), high_first.words()) << *text;
      EXPECT_EQ(command_names().words_of(*text, kForms[1]), low_first.words()) << *text;
    }
    EXPECT_GT(taken, 0) << fact.at("code") << " " << fact.at("name");
  }
  EXPECT_EQ(codes, 229);
}

TEST(RsM8194hCommandNames, EveryPrintedFrameHasItsName) {
  int frames = 0;
  for (const Fact& fact : read_facts(PROJECT_FOLDER "/tests/interpreter/rs_m8194h/frames.csv")) {
    const world::Bytes bytes = world::hex(fact.at("frame"));
    const bool is_window = fact.at("direction") == "request" && bytes.size() > 9 && bytes[1] == 0x10 &&
                           bytes[2] == 0x1F && bytes[3] == 0x40;
    if (!is_window) continue;
    ++frames;
    Words words;
    for (std::size_t at = 7; at + 3 < bytes.size(); at += 2) {
      words.push_back(static_cast<std::uint16_t>(bytes[at] << 8 | bytes[at + 1]));
    }
    const auto text = command_names().text_of(words, kForms[0]);
    ASSERT_TRUE(text) << fact.at("frame");
    EXPECT_EQ(command_names().words_of(*text, kForms[0]), words) << *text;
  }
  EXPECT_GT(frames, 150);
}

TEST(RsM8194hCommandNames, WhatIsNoCommandHasNone) {
  const Words kNone[] = {{},
                         {0x0A66},                       // no code
                         {0x0B4E, 1, 0, 5},              // is not even half of a code
                         {0x0A4E, 1, 0},                 // one register too few
                         {0x0A4E, 1, 0, 5, 6},           // one too many
                         {0x0A4E, 0, 0, 5},              // no axis
                         {0x0A0C, 1, 6},                 // out of range
                         {0x0CD7, 0, 1, 0x3C3C, 0, 2}};  // no operator
  for (const Words& words : kNone) EXPECT_EQ(command_names().text_of(words, kForms[0]), std::nullopt);
}

TEST(RsM8194hCommandNames, AWrongTextIsReportedWithItsPlace) {
  EXPECT_EQ(diagnostic_of("RSM_FIXED_MOV X 1"),
            "column 1: 'RSM_FIXED_MOV' is not a command; the nearest is 'RSM_FIXED_MOVE'");
  EXPECT_EQ(diagnostic_of("RSM_SET_PULSE_MODE X 6"),
            "column 22: parameter nMode: '6' does not fit; expected 0 to 5");
  EXPECT_EQ(diagnostic_of(""), "column 1: is empty; expected a command");
}

TEST(RsM8194hCommandNames, ADeviceIsAskedForItsOrderOfWords) {
  OneRsm rsm;
  const std::string_view text = "RSM_FIXED_MOVE X -1000";
  const WindowMessage high_first = window_message(rsm.device(), text);
  EXPECT_EQ(high_first.first, 8000);
  EXPECT_EQ(high_first.words, (Words{0x0A4E, 1, 0xFFFF, 0xFC18}));
  rsm.set("WORD_ORDER", 1);
  const WindowMessage low_first = window_message(rsm.device(), text);
  EXPECT_EQ(low_first.words, (Words{0x0A4E, 1, 0xFC18, 0xFFFF}));
  EXPECT_EQ(window_text(rsm.device(), Table::holding, 8000, low_first.words), text);
  EXPECT_EQ(window_text(rsm.device(), Table::holding, 8001, low_first.words), std::nullopt);
}

TEST(RsM8194hCommandNames, ADeviceIsAskedForItsChoices) {
  OneRsm tables({.choices = {{"word_order_scope", "tables"}}});
  tables.set("WORD_ORDER", 1);
  const WindowMessage move = window_message(tables.device(), "RSM_FIXED_MOVE X -1000");
  EXPECT_EQ(move.words, (Words{0x0A4E, 1, 0xFFFF, 0xFC18}));
  EXPECT_EQ(window_text(tables.device(), Table::holding, 8000, move.words), "RSM_FIXED_MOVE X -1000");

  OneRsm swapped({.choices = {{"swapped_codes", "of_12_3"}}});
  const std::string mix = "RSM_MIX_2D_CONTINUE 1 1 0 0 100 0";
  const WindowMessage segment = window_message(swapped.device(), mix);
  EXPECT_EQ(segment.words[0], 0x0AFD);
  EXPECT_EQ(window_text(swapped.device(), Table::holding, 8000, segment.words), mix);

  OneRsm listed({.choices = {{"if_operator", "as_in_the_table"}}});
  const WindowMessage line = window_message(listed.device(), "RSM_MACRO_IF VAR1 >= VAR2");
  EXPECT_EQ(line.words[3], 0x3D3E);
  EXPECT_EQ(window_text(listed.device(), Table::holding, 8000, line.words), "RSM_MACRO_IF VAR1 >= VAR2");
}

}  // namespace command_names_test
}  // namespace understudy::emulator::models::rs_m8194h
