// The table of instructions against what was read out of the manual (instructions.csv), and where each may
// stand.
#include "interpreter/super_40nc/instructions.h"

#include <gtest/gtest.h>

#include "interpreter/super_40nc/listing.h"
#include "tests/interpreter/facts.h"

namespace understudy::interpreter::super_40nc {
namespace instructions_test {

std::vector<Fact> facts() { return read_facts(TEST_FACTS "/super_40nc/instructions.csv"); }

std::string in_plc(InPlc how) {
  switch (how) {
    case InPlc::nothing: return "";
    case InPlc::contact: return "contact";
    case InPlc::every_scan: return "every_scan";
    case InPlc::every_scan_on_or_off: return "every_scan_on_or_off";
    case InPlc::rising_edge: return "rising_edge";
    case InPlc::falling_edge: return "falling_edge";
    case InPlc::level: return "level";
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
    // CWR and CCWR have four fields in print, the last of them without a meaning.
    const bool has_dead_field = name == "CWR" || name == "CCWR";
    EXPECT_EQ(std::to_string(row.fields() + (has_dead_field ? 1 : 0)), fact.at("fields")) << name;
    EXPECT_EQ(in_plc(row.in_plc), fact.at("in_plc")) << name;
    EXPECT_EQ(row.ends_single_step, fact.at("single_step") == "yes") << name;
    EXPECT_EQ(row.waits == Waits::no, fact.at("waits") == "no") << name;
  }
}

/// A line that is right but for its area.
std::string line_of(const InstructionRow& row) {
  std::string line(row.mnemonic);
  for (const Slot slot : row.slots) {
    switch (slot) {
      case Slot::none: break;
      case Slot::contact: line += " X1"; break;
      case Slot::bit:
      case Slot::resettable: line += " Y1"; break;
      case Slot::timer: line += " T1"; break;
      case Slot::source:
      case Slot::preset:
      case Slot::label:
      case Slot::times:
      case Slot::amount:
      case Slot::needed: line += " K1"; break;
      case Slot::target:
      case Slot::range: line += " D1"; break;
    }
  }
  return line;
}

/// A program in which it stands as it should.
std::string program_with(const InstructionRow& row, const AreaRow& area) {
  const bool is_plc = area.area == Area::plc;
  std::string text = "AREA " + std::string(area.name) + "\n";
  const Op op = row.op;
  const bool is_part = (op >= Op::ld && op <= Op::orb) || (op >= Op::ld_equal && op <= Op::or_ge);
  if (is_plc || is_part || op == Op::cj || op == Op::cjn || op == Op::if_ || op == Op::else_ ||
      op == Op::endi) {
    text += "LD X0\n";
  }
  if (op == Op::anb || op == Op::orb) text += "LD X1\n";
  if (op == Op::mrd || op == Op::mpp) text += "MPS\n";
  if (op == Op::else_ || op == Op::endi) text += "IF\n";
  text += line_of(row) + "\n";
  if (is_part && !is_plc) text += "CJ K1\n";
  if (op == Op::if_ || op == Op::else_) text += "ENDI\n";
  return text + "END\n";
}

TEST(Super40ncInstructions, StandWhereTheManualLetsThem) {
  int refused = 0;
  for (const Fact& fact : facts()) {
    const auto row = std::find_if(kInstructions.begin(), kInstructions.end(),
                                  [&](const InstructionRow& r) { return r.mnemonic == fact.at("mnemonic"); });
    for (const AreaRow& area : kAreas) {
      const std::string text = program_with(*row, area);
      const Checked checked = check(text);
      const bool may = fact.at("areas").find(area.letter) != std::string::npos ||
                       fact.at("void_in").find(area.letter) != std::string::npos;
      EXPECT_EQ(checked.program.has_value(), may)
          << text << (checked.errors.empty() ? "" : to_string(checked.errors[0]));
      if (may) continue;
      ++refused;
      ASSERT_FALSE(checked.errors.empty()) << text;
      const Code code = row->group == Group::undocumented ? Code::unknown : Code::wrong_area;
      const bool is_said = std::any_of(checked.errors.begin(), checked.errors.end(),
                                       [&](const Complaint& error) { return error.code == code; });
      EXPECT_TRUE(is_said) << text;
    }
  }
  EXPECT_GT(refused, 150);
}

/// Each slot takes the letters of the manual's table and no others.
TEST(Super40ncInstructions, TakeTheOperandsOfTheirFields) {
  struct Letters {
    Slot slot;
    std::string_view letters;  // and * for unset
  };
  constexpr Letters kTaken[] = {{Slot::contact, "XYMTC"}, {Slot::bit, "YM"},      {Slot::resettable, "YMTC"},
                                {Slot::timer, "TC"},      {Slot::preset, "KD"},   {Slot::source, "KTCD"},
                                {Slot::target, "D"},      {Slot::range, "YMTCD"}, {Slot::label, "K"},
                                {Slot::times, "KD*"},     {Slot::amount, "KD*"},  {Slot::needed, "KD"},
                                {Slot::none, "*"}};
  for (const InstructionRow& row : kInstructions) {
    if (row.group == Group::undocumented) continue;
    const AreaRow* area = nullptr;
    for (const AreaRow& some : kAreas) {
      if (area == nullptr && has(row.areas, some.area)) area = &some;
    }
    for (std::size_t i = 0; i < row.slots.size(); ++i) {
      const auto taken = std::find_if(std::begin(kTaken), std::end(kTaken),
                                      [&](const Letters& letters) { return letters.slot == row.slots[i]; });
      for (const char letter : std::string("KXYMTCD*")) {
        std::string right = line_of(row);
        std::string wrong(row.mnemonic);
        std::size_t at = right.find(' ');
        for (std::size_t field = 0; field < row.slots.size(); ++field) {
          std::string is =
              at == std::string::npos ? "*" : right.substr(at + 1, right.find(' ', at + 1) - at - 1);
          if (field == i) is = letter == '*' ? "*" : std::string(1, letter) + "1";
          // Both ends of a range are of one kind.
          if (row.op == Op::zrst && field < 2 && letter != '*') is = std::string(1, letter) + "1";
          wrong += ' ' + is;
          at = at == std::string::npos ? at : right.find(' ', at + 1);
        }
        std::string text = program_with(row, *area);
        text.replace(text.find(right + "\n"), right.size(), wrong);
        // OUT T has a preset, OUT Y has none; they are two instructions.
        const bool is_other_out = (row.op == Op::out && i == 0 && (letter == 'T' || letter == 'C')) ||
                                  (row.op == Op::out_tc && i == 0);
        if (is_other_out) continue;
        EXPECT_EQ(check(text).program.has_value(), taken->letters.find(letter) != std::string_view::npos)
            << text;
      }
    }
  }
}

}  // namespace instructions_test
}  // namespace understudy::interpreter::super_40nc
