// Every mnemonic in every area, with every kind of operand in every field, at the limits of its numbers, with
// unset and omitted fields, and alone: it is accepted, or refused with its code, step and column.
// instructions.csv and the manual's tables of devices say what is right, not the table of the program.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/super_40nc/listing.h"
#include "tests/interpreter/facts.h"
#include "tests/interpreter/super_40nc/running.h"

namespace understudy::interpreter::super_40nc {
namespace every_mnemonic_test {

/// The meaning of the column `operands`: the letters of each field, `*` for unset, `L` for a label. RST and
/// ZRST accept T and C as well (choice reset_timers_counters); a preset can be in a D.
using Fields = std::vector<std::string>;
const std::map<std::string, Fields>& operands() {
  static const Fields kFour(4, "KD*");
  static const std::map<std::string, Fields> kOperands = {
      {"none", {}},
      {"S1: X,Y,M,T,C", {"XYMTC"}},
      {"D1: Y,M (operand table prints none; example ALT Y6)", {"YM"}},
      {"D1: Y,M", {"YM"}},
      {"D1: Y,M (T,C not listed)", {"YMTC"}},
      {"D1: T,C; S2: preset K (D proposed)", {"TC", "KD"}},
      {"S1: K,T,C,D; D2: D", {"KTCD", "D"}},
      {"D1: Y,M,D; D2: Y,M,D (same kind)", {"YMTCD", "YMTCD"}},
      {"S1: K,T,C,D; D2: D; n3: K,T,C,D", {"KTCD", "D", "KTCD"}},
      {"S1: K,T,C,D; S2: K,T,C,D; D3: D", {"KTCD", "KTCD", "D"}},
      {"S1: K,T,C,D; S2: K,T,C,D", {"KTCD", "KTCD"}},
      {"D1: D", {"D"}},
      {"S1: K 0..9999999", {"L"}},
      {"S1: K label; S2: K,D count", {"L", "KD*"}},
      {"S1: K label", {"L"}},
      {"S1: K,D", {"KD"}},
      {"S1: K,D 0 = do not wait, 1 = wait", {"KD"}},
      {"1,2: end point K,D; 3: radius K,D", {"KD*", "KD*", "KD"}},
      {"1..4: K,D (X,Y,Z,U), ***** = axis unchanged", kFour},
      {"1,2: end point K,D; 3,4: centre relative to start K,D", kFour},
      {"1,2: mid point K,D; 3,4: end point K,D", kFour},
      {"1..4: K,D (X,Y,Z,U), ***** = axis unchanged (X/Y/Z/U programs read datum 1 only)", kFour},
      {"1..4: K,D 1 = home, 0/unset = none (X/Y/Z/U read datum 1)", kFour},
      {"1..4: K,D ratio, sign = direction, 0 = off (X/Y/Z/U read datum 1)", kFour},
      {"1..4: K,D (X,Y,Z,U), ***** = axis unchanged (X/Y/Z/U read datum 1: proposed)", kFour},
      {"1..4: K,D signed rpm, 0 = stop (X/Y/Z/U read datum 1)", kFour},
      {"1..4: K,D 1 = jog, 0/unset = none", kFour},
      {"1..4: K,D 1 = stop X/Y/Z/U program; all unset = stop C", kFour},
      {"1..4: K,D 1 = start X/Y/Z/U program; all unset = start C", kFour},
      {"1..4: K,D new position (X/Y/Z/U in every program)", kFour},
      {"not printed (proposed as PSET)", kFour}};
  return kOperands;
}

struct Place {
  const char* name;
  char letter;  // in the CSV
  int base;
};
constexpr Place kPlaces[] = {{"C", 'C', 0},    {"X", 'X', 1500}, {"Y", 'Y', 2000},
                             {"Z", 'Z', 2500}, {"U", 'U', 3000}, {"PLC", 'P', 3500}};

bool is_one_of(std::string_view word, std::string_view words) {
  return (" " + std::string(words) + " ").find(" " + std::string(word) + " ") != std::string::npos;
}
bool is_contact(const Fact& fact) {
  return fact.at("in_plc") == "contact" && !is_one_of(fact.at("mnemonic"), "MPS MRD MPP INV ANB ORB");
}
bool may_stand(const Fact& fact, const Place& place) {
  return (fact.at("areas") + fact.at("void_in")).find(place.letter) != std::string::npos;
}
/// Names without a description have none.
bool has_operands(const Fact& fact) { return fact.at("operands") != "not printed"; }

std::string right_operand(std::string_view letters) {
  const std::string_view first = letters == "L" ? "K" : letters.substr(0, 1);
  return std::string(first) + "1";
}

/// A correct program around a line, and the position of the line in it.
struct Around {
  std::string before;
  std::string behind;
  int steps_before;
  int line;  // of the text, from 1
};

Around around(const Fact& fact, const Place& place) {
  const std::string& name = fact.at("mnemonic");
  const bool is_plc = place.letter == 'P';
  Around made{"AREA " + std::string(place.name) + "\n", "END\n", 0, 0};
  const auto put = [&](const std::string& line) {
    made.before += line + "\n";
    ++made.steps_before;
  };
  const bool joins = is_one_of(name, "ANB ORB");
  const bool follows = is_contact(fact) || joins || is_one_of(name, "CJ CJN IF ELSE ENDI");
  if (is_plc || (follows && !is_one_of(name, "WAT WTN"))) put("LD X0");
  if (joins) put("LD X1");
  if (is_plc && is_one_of(name, "MRD MPP")) put("MPS");
  if (!is_plc && is_one_of(name, "ELSE ENDI")) put("IF");
  if (!is_plc && (is_contact(fact) || joins)) made.behind = "CJ K1\nEND\n";
  if (is_one_of(name, "IF ELSE")) made.behind = "ENDI\nEND\n";
  made.line = made.steps_before + 2;
  return made;
}

struct Refused {
  Code code;
  int column;
};

class Trial {
 public:
  Trial(const Fact& fact, const Place& place)
      : fact_(fact), place_(place), around_(around(fact, place)), step_(place.base + around_.steps_before) {}

  void takes(const std::string& line) const {
    const std::string text = around_.before + line + "\n" + around_.behind;
    const Checked checked = check(text);
    EXPECT_TRUE(checked.program) << text << (checked.errors.empty() ? "" : to_string(checked.errors.front()));
  }
  /// The line after it still has its step.
  void refuses(const std::string& line, Refused refused) const { refuses(line, refused, fact_.at("steps")); }
  void refuses(const std::string& line, Refused refused, const std::string& steps) const {
    const std::string text = around_.before + line + "\nNOP K1\n" + around_.behind;
    const Checked checked = check(text);
    EXPECT_FALSE(checked.program) << text;
    ASSERT_FALSE(checked.errors.empty()) << text;
    const Diagnostic& first = checked.errors.front();
    EXPECT_EQ(std::tuple(first.line, first.column, first.code, first.step),
              std::tuple(around_.line, refused.column, refused.code, step_))
        << text << to_string(first);
    const int behind = step_ + (steps.empty() ? 0 : std::stoi(steps));
    const bool is_told = std::any_of(checked.errors.begin(), checked.errors.end(), [&](const Diagnostic& e) {
      return e.line == around_.line + 1 && e.column == 5 && e.code == Code::unknown && e.step == behind;
    });
    EXPECT_TRUE(is_told) << text;
  }

 private:
  const Fact& fact_;
  const Place& place_;
  Around around_;
  int step_;
};

std::string line_of(const std::string& name, const Fields& words) {
  std::string line = name;
  for (const std::string& word : words) line += " " + word;
  return line;
}
int column_of(const std::string& name, const Fields& words, std::size_t field) {
  std::size_t column = name.size() + 2;
  for (std::size_t i = 0; i < field; ++i) column += words[i].size() + 1;
  return static_cast<int>(column);
}

Fields right_words(const Fact& fact) {
  Fields words;
  if (!has_operands(fact)) return words;
  for (const std::string& letters : operands().at(fact.at("operands")))
    words.push_back(right_operand(letters));
  return words;
}

std::vector<Fact> facts() { return read_facts(TEST_FACTS "/super_40nc/instructions.csv"); }

/// Calls it with every mnemonic in every area, and whether it is allowed there.
template <class Visit>
void everywhere(Visit visit) {
  const std::vector<Fact> all = facts();
  ASSERT_EQ(all.size(), 97u);
  for (const Fact& fact : all) {
    for (const Place& place : kPlaces) visit(fact, place, may_stand(fact, place));
  }
}
/// The same for the areas in which it is allowed.
template <class Visit>
void wherever_it_may(Visit visit) {
  everywhere([&](const Fact& fact, const Place& place, bool may) {
    if (may) visit(fact, place, Trial(fact, place));
  });
}

TEST(Super40ncEveryMnemonic, StandsInItsAreasAlone) {
  int refused = 0;
  everywhere([&](const Fact& fact, const Place& place, bool may) {
    const Trial trial(fact, place);
    const std::string line = line_of(fact.at("mnemonic"), right_words(fact));
    if (may) return trial.takes(line);
    ++refused;
    trial.refuses(line, {has_operands(fact) ? Code::wrong_area : Code::unknown, 1});
  });
  EXPECT_GT(refused, 150);
}

/// Every kind of operand in every field, while the others are right. S is a device without an instruction.
TEST(Super40ncEveryMnemonic, TakesTheKindsOfItsFields) {
  int tried = 0;
  wherever_it_may([&](const Fact& fact, const Place&, const Trial& trial) {
    const std::string& name = fact.at("mnemonic");
    const Fields right = right_words(fact);
    for (std::size_t field = 0; field < right.size(); ++field) {
      const std::string& letters = operands().at(fact.at("operands"))[field];
      for (const char letter : std::string_view("KXYMTCDSQ*")) {
        ++tried;
        Fields words = right;
        words[field] = letter == '*' ? "*" : std::string(1, letter) + "1";
        const int column = column_of(name, words, field);
        const bool is_taken =
            letters.find(letter == 'K' && letters == "L" ? 'L' : letter) != std::string::npos;
        if (name == "OUT" && (letter == 'T' || letter == 'C')) {
          trial.refuses(line_of(name, words), {Code::unknown, 1}, "2");  // OUTtc without its preset
        } else if (name == "ZRST" && is_taken && letter != 'Y') {
          trial.refuses(line_of(name, words), {Code::out_of_range, 1});  // its ends are of two kinds
          words = {words[field], words[field]};
          trial.takes(line_of(name, words));
        } else if (is_taken) {
          trial.takes(line_of(name, words));
        } else {
          trial.refuses(line_of(name, words), {Code::unknown, column});
        }
      }
    }
  });
  EXPECT_GT(tried, 5000);
}

/// The existing numbers. (接點元件編號一覽表, 暫存器元件編號一覽表.)
struct Numbers {
  char letter;
  std::vector<std::string> taken;
  std::vector<std::string> beyond;
};
const std::vector<Numbers>& numbers() {
  static const std::vector<Numbers> kNumbers = {
      {'K', {"-2147483648", "0", "2147483647"}, {"-2147483649", "2147483648", "99999999999999999999"}},
      {'X', {"0", "47"}, {"-1", "48"}},
      {'Y', {"0", "31"}, {"-1", "32"}},
      {'M', {"0", "511", "8000", "8699"}, {"-1", "512", "7999", "8700"}},
      {'T', {"0", "63"}, {"-1", "64"}},
      {'C', {"0", "31"}, {"-1", "32"}},
      {'D',
       {"0", "999", "8000", "8599", "9000", "9499"},
       {"-1", "1000", "7999", "8600", "8999", "9500", "4294967296"}},
  };
  return kNumbers;
}

TEST(Super40ncEveryMnemonic, TakesTheNumbersThatThereAre) {
  wherever_it_may([&](const Fact& fact, const Place&, const Trial& trial) {
    const std::string& name = fact.at("mnemonic");
    const Fields right = right_words(fact);
    for (std::size_t field = 0; field < right.size(); ++field) {
      const std::string& letters = operands().at(fact.at("operands"))[field];
      const auto line_with = [&](const std::string& word) {
        Fields words = right;
        words[field] = word;
        if (name == "ZRST") words = {word, word};
        return line_of(name, words);
      };
      const int column = name == "ZRST" ? 6 : column_of(name, right, field);
      if (letters == "L") {
        for (const char* label : {"K0", "K9999999"}) trial.takes(line_with(label));
        for (const char* label : {"K-1", "K10000000"})
          trial.refuses(line_with(label), {Code::unknown, column});
        continue;
      }
      for (const Numbers& of : numbers()) {
        if (letters.find(of.letter) == std::string::npos) continue;
        for (const std::string& n : of.taken) trial.takes(line_with(of.letter + n));
        for (const std::string& n : of.beyond) {
          const bool is_number = n.size() < 20;  // of 64 bits; otherwise it is not an operand
          trial.refuses(line_with(of.letter + n), {is_number ? Code::out_of_range : Code::unknown, column});
        }
      }
    }
  });
}

/// Fields at the end can be omitted if they may be unset; there are no more than its own, and never five.
TEST(Super40ncEveryMnemonic, HasItsFieldsAndNoMore) {
  wherever_it_may([&](const Fact& fact, const Place&, const Trial& trial) {
    const std::string& name = fact.at("mnemonic");
    const Fields right = right_words(fact);
    const Fields letters = operands().at(fact.at("operands"));
    for (std::size_t count = 0; count < right.size(); ++count) {
      const Fields some(right.begin(), right.begin() + static_cast<std::ptrdiff_t>(count));
      const bool may = std::all_of(letters.begin() + static_cast<std::ptrdiff_t>(count), letters.end(),
                                   [](const std::string& of) { return of.find('*') != std::string::npos; });
      if (may) {
        trial.takes(line_of(name, some));
      } else {
        trial.refuses(line_of(name, some), {Code::unknown, 1});
      }
    }
    Fields more = right;
    while (more.size() < 5) {
      more.emplace_back("K1");
      trial.refuses(line_of(name, more),
                    {Code::unknown, column_of(name, more, more.size() < 5 ? right.size() : 4)});
    }
    Fields unset = right;
    while (unset.size() < 4) unset.emplace_back("*****");
    trial.takes(line_of(name, unset));
  });
}

/// Alone between AREA and END: an instruction that needs a condition, a partner or a jump says so.
TEST(Super40ncEveryMnemonic, AloneSaysWhatItLacks) {
  wherever_it_may([&](const Fact& fact, const Place& place, const Trial&) {
    const std::string& name = fact.at("mnemonic");
    const std::string line = line_of(name, right_words(fact));
    const std::string text = "AREA " + std::string(place.name) + "\n" + line + "\nEND\n";
    const bool begins = is_contact(fact) && name.starts_with("LD");
    Code code = Code::none;
    int step = place.base;
    if (place.letter == 'P') {
      if (!begins && !is_one_of(name, "NOP END")) code = Code::logic;
    } else if (begins) {
      code = Code::logic;  // END is in the place of a jump
      step += std::stoi(fact.at("steps"));
    } else if (is_contact(fact) || is_one_of(name, "ANB ORB CJ CJN IF")) {
      code = Code::logic;
    } else if (is_one_of(name, "ELSE ENDI")) {
      code = Code::pairing;
    }
    const Checked checked = check(text);
    EXPECT_EQ(checked.program.has_value(), code == Code::none) << text;
    if (checked.errors.empty()) return;
    EXPECT_EQ(checked.errors[0].code, code) << text << to_string(checked.errors[0]);
    EXPECT_EQ(checked.errors[0].step, step) << text;
  });
}

// --- running ------------------------------------------------------------------------------------------

/// The effect of a line: codes with their steps, its requests, and whether the next line was reached.
struct Did {
  std::vector<std::array<int, 3>> codes;
  std::vector<std::string> asked;
  bool went_on = false;
};

Did run_in(const Place& place, const std::string& line, int owned_axes) {
  const bool is_plc = place.letter == 'P';
  const std::string c_waits = place.letter == 'C' ? "" : "AREA C\nWAT X40\nEND\n";
  Running running(c_waits + "AREA " + place.name + "\n" + (is_plc ? "LD M8003\n" : "") + line +
                  "\nMOV K7 D0\nEND\n");
  running.machine.registers[named::kOwnedAxes] = owned_axes;
  const auto at =
      std::find_if(kAreas.begin(), kAreas.end(), [&](const AreaRow& row) { return row.name == place.name; });
  if (is_plc) {
    running.run_plc();
    running.scan();
  } else {
    running.start(at->area);
    running.tick(20);
  }
  Did did{running.machine.codes, {}, running.machine.value(d(0)) == 7};
  const std::string own = std::string(place.name) + ": ";
  for (const std::string& message : running.machine.log) {
    if (message != own + "starts" && message != own + "ended") did.asked.push_back(message);
  }
  return did;
}

/// A line whose fields are all unset does nothing and is not waited for, except STP and STR, which mean C
/// then.
TEST(Super40ncEveryMnemonic, WithoutFieldsDoesNothing) {
  int tried = 0;
  wherever_it_may([&](const Fact& fact, const Place& place, const Trial&) {
    const std::string& name = fact.at("mnemonic");
    const Fields letters = operands().at(fact.at("operands"));
    if (letters != Fields(4, "KD*") || fact.at("void_in").find(place.letter) != std::string::npos) return;
    ++tried;
    const Did did = run_in(place, name + " * * * *", 4);
    EXPECT_EQ(did.codes.size(), 0u) << name << " in " << place.name;
    const bool ends_itself = name == "STP" && place.letter == 'C';
    EXPECT_EQ(did.went_on, !ends_itself) << name << " in " << place.name;
    std::vector<std::string> expected;
    if (name == "STP") expected = {"C: stop"};
    if (name == "STR" && place.letter != 'C') expected = {"C: starts"};
    EXPECT_EQ(did.asked, expected) << name << " in " << place.name;
  });
  EXPECT_GT(tried, 50);
}

/// A line that the CSV calls void in an area loads there, reports code 2 with its step, and the next line
/// runs.
TEST(Super40ncEveryMnemonic, IsVoidWhereTheManualSays) {
  int tried = 0;
  wherever_it_may([&](const Fact& fact, const Place& place, const Trial&) {
    if (fact.at("void_in").find(place.letter) == std::string::npos) return;
    ++tried;
    const Did did = run_in(place, line_of(fact.at("mnemonic"), right_words(fact)), 4);
    const int step = place.base + (place.letter == 'P' ? 1 : 0);
    const std::string& name = fact.at("mnemonic");
    EXPECT_EQ(did.codes, (std::vector<std::array<int, 3>>{{2, step, 0}})) << name << " in " << place.name;
    EXPECT_TRUE(did.went_on) << name << " in " << place.name;
    EXPECT_EQ(did.asked.size(), 0u) << name << " in " << place.name;
  });
  EXPECT_EQ(tried, 12);  // PJG and MJG in five step programs, CHK in C and the PLC
}

/// Axes that the program does not own: C21 = 0 for C, 4 for the programs of the axes. Lines that move axes
/// are void with code 16; other lines are not.
TEST(Super40ncEveryMnemonic, LeavesAxesAloneThatItDoesNotOwn) {
  constexpr std::string_view kMovers = "LIN CW CCW C3P CWR CCWR DRV HOM MPG MRK VDRV";
  int movers = 0;
  wherever_it_may([&](const Fact& fact, const Place& place, const Trial&) {
    const std::string& name = fact.at("mnemonic");
    if (fact.at("group") != "Motion" || place.letter == 'P') return;
    if (fact.at("void_in").find(place.letter) != std::string::npos || is_one_of(name, "STP STR")) return;
    const Did did = run_in(place, line_of(name, right_words(fact)), place.letter == 'C' ? 0 : 4);
    std::vector<std::array<int, 3>> codes;
    if (is_one_of(name, kMovers)) {
      ++movers;
      codes = {{16, place.base, 0}};
      EXPECT_EQ(did.asked.size(), 0u) << name << " in " << place.name;
    }
    EXPECT_EQ(did.codes, codes) << name << " in " << place.name;
    EXPECT_TRUE(did.went_on) << name << " in " << place.name;
  });
  EXPECT_EQ(movers, 11 + 4 * 5);
}

}  // namespace every_mnemonic_test
}  // namespace understudy::interpreter::super_40nc
