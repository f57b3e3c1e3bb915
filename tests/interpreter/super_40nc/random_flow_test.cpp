// Step programs of random flow compared with a naive evaluator, which reads the listing's words at each line
// and searches for labels and partners.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <sstream>

#include "tests/interpreter/program_counts.h"
#include "tests/interpreter/super_40nc/running.h"

namespace understudy::interpreter::super_40nc {
namespace random_flow_test {

using Random = std::mt19937;
using Words = std::vector<std::string>;

int below(Random& random, int limit) { return static_cast<int>(random() % static_cast<unsigned>(limit)); }

/// The possible lines of a program, over M0 to M7, D0 to D7 and four labels and subroutines.
class Writer {
 public:
  explicit Writer(Random& random) : random_(random) {}

  std::vector<std::string> program() {
    body(12 + below(random_, 25), 0);
    lines_.push_back("END");
    for (int i = 0; i < 4; ++i) {
      if (below(random_, 6) == 0) continue;  // a label that is missing
      lines_.push_back("LAB K" + std::to_string(10 + i));
      body(1 + below(random_, 5), 1);
      lines_.push_back(below(random_, 8) == 0 ? "END" : "RET");
    }
    return lines_;
  }

 private:
  std::string number(const char* letter) { return letter + std::to_string(below(random_, 8)); }

  void group() {
    constexpr const char* kLoads[] = {"LD M", "LDI M"};
    lines_.push_back(number(kLoads[below(random_, 2)]));
    for (int i = below(random_, 3); i > 0; --i) {
      constexpr const char* kMore[] = {"AND M", "ANI M", "OR M", "ORI M"};
      lines_.push_back(number(kMore[below(random_, 4)]));
      if (below(random_, 3) == 0) {
        lines_.push_back("LD> " + number("D") + " K" + std::to_string(below(random_, 5)));
        lines_.push_back(below(random_, 2) == 0 ? "ANB" : "ORB");
      }
    }
  }

  void body(int count, int depth) {
    for (int i = 0; i < count; ++i) {
      switch (below(random_, 17)) {
        case 0: lines_.push_back("SET " + number("M")); break;
        case 1: lines_.push_back("RST " + number("M")); break;
        case 2: lines_.push_back("INC " + number("D")); break;
        case 3: lines_.push_back("DEC " + number("D")); break;
        case 4: lines_.push_back("ADD " + number("D") + " K3 " + number("D")); break;
        case 5:
          lines_.push_back("TMR " +
                           (below(random_, 2) == 0 ? number("D") : "K" + std::to_string(below(random_, 9))));
          break;
        case 6: lines_.push_back(number(below(random_, 2) == 0 ? "WAT M" : "WTN M")); break;
        case 7: lines_.push_back("LAB K" + std::to_string(below(random_, 6))); break;
        case 8: lines_.push_back("JMP K" + std::to_string(below(random_, 7))); break;
        case 9:
        case 10:
          group();
          lines_.push_back((below(random_, 2) == 0 ? "CJ K" : "CJN K") + std::to_string(below(random_, 7)));
          if (below(random_, 3) == 0) lines_.push_back("CJN K" + std::to_string(below(random_, 7)));
          break;
        case 11:
        case 12:
          lines_.push_back("CAL K" + std::to_string(10 + below(random_, 4)) +
                           (below(random_, 2) == 0   ? ""
                            : below(random_, 2) == 0 ? " K2"
                                                     : " " + number("D")));
          break;
        case 13:
        case 14:
          if (depth >= 4) break;
          group();
          lines_.push_back("IF");
          body(below(random_, 4), depth + 1);
          if (below(random_, 2) == 0) {
            lines_.push_back("ELSE");
            body(below(random_, 4), depth + 1);
          }
          lines_.push_back("ENDI");
          break;
        case 15: lines_.push_back("NOP"); break;
        default: lines_.push_back("MOV K" + std::to_string(below(random_, 4)) + " " + number("D"));
      }
    }
  }

  Random& random_;
  std::vector<std::string> lines_;
};

class Naive {
 public:
  explicit Naive(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) {
      std::istringstream words(line);
      lines_.push_back({std::istream_iterator<std::string>(words), {}});
    }
  }

  void tick() {
    int budget = 64;
    while (runs) {
      if (budget-- <= 0 && !goes_on_with_contacts()) return;
      LineCount& count = counts[{1, static_cast<int>(at)}];  // of area X
      if (!waits_) ++count.runs;
      const bool begins = !std::exchange(waits_, false);
      const Words words = lines_[at];
      if (begins && decides(words[0])) count.decide(decision(words));
      if (!line()) return;
    }
  }

  bool runs = true;
  int code = 0;
  std::map<std::string, std::int32_t> values;  // of M0.., D0..
  std::size_t at = 0;
  LineTally counts;

 private:
  static bool decides(const std::string& word) {
    return word.starts_with("LD") || word == "AND" || word == "ANI" || word == "OR" || word == "ORI" ||
           word == "CJ" || word == "CJN" || word == "IF" || word == "WAT" || word == "WTN";
  }
  bool decision(const Words& words) {
    const std::string& word = words[0];
    if (word == "LD>") return value(words[1]) > value(words[2]);
    if (word == "CJ" || word == "IF") return blocks_.back();
    if (word == "CJN") return !blocks_.back();
    const bool wants_off = word == "LDI" || word == "ANI" || word == "ORI" || word == "WTN";
    return (value(words[1]) == 0) == wants_off;
  }
  struct Pass {
    std::size_t back;
    std::size_t label;
    int left;
  };

  std::int32_t value(const std::string& word) {
    return word[0] == 'K' ? std::stoi(word.substr(1)) : values[word];
  }
  bool goes_on_with_contacts() const {
    const std::string& word = lines_[at][0];
    return word.starts_with("AN") || word.starts_with("OR") || word == "CJ" || word == "CJN" || word == "IF";
  }
  bool stop(int with) {
    runs = false;
    code = with;
    return false;
  }
  bool go(std::size_t to) {
    at = to;
    return false;
  }
  bool next() {
    ++at;
    return true;
  }
  /// Returns the line of a label; past the end if there is none.
  std::size_t label(const std::string& name) const {
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (lines_[i][0] == "LAB" && lines_[i][1] == name) return i;
    }
    return lines_.size();
  }
  bool jump(const std::string& name) {
    const std::size_t to = label(name);
    return to == lines_.size() ? stop(3) : go(to);
  }
  /// From an IF or ELSE to its ELSE or ENDI.
  std::size_t partner(bool may_be_else) const {
    int depth = 0;
    for (std::size_t i = at + 1;; ++i) {
      const std::string& word = lines_.at(i)[0];
      if (word == "IF") ++depth;
      if (depth == 0 && (word == "ENDI" || (may_be_else && word == "ELSE"))) return i;
      if (word == "ENDI") --depth;
    }
  }

  /// Returns false if the slice has ended.
  bool line() {
    const Words& words = lines_[at];
    const std::string& word = words[0];
    if (word == "END") return stop(0);
    if (word == "LD") blocks_.push_back(value(words[1]) != 0);
    if (word == "LDI") blocks_.push_back(value(words[1]) == 0);
    if (word == "LD>") blocks_.push_back(value(words[1]) > value(words[2]));
    if (word == "AND") blocks_.back() = blocks_.back() && value(words[1]) != 0;
    if (word == "ANI") blocks_.back() = blocks_.back() && value(words[1]) == 0;
    if (word == "OR") blocks_.back() = blocks_.back() || value(words[1]) != 0;
    if (word == "ORI") blocks_.back() = blocks_.back() || value(words[1]) == 0;
    if (word == "ANB" || word == "ORB") {
      const bool last = blocks_.back();
      blocks_.pop_back();
      blocks_.back() = word == "ANB" ? blocks_.back() && last : blocks_.back() || last;
    }
    if (word == "SET") values[words[1]] = 1;
    if (word == "RST") values[words[1]] = 0;
    if (word == "INC") ++values[words[1]];
    if (word == "DEC") --values[words[1]];
    if (word == "MOV") values[words[2]] = value(words[1]);
    if (word == "ADD") values[words[3]] = value(words[1]) + value(words[2]);
    if (word == "JMP") return jump(words[1]);
    if (word == "CJ" && blocks_.back()) return jump(words[1]);
    if (word == "CJN" && !blocks_.back()) return jump(words[1]);
    if (word == "IF" && !blocks_.back()) {
      at = partner(true);
      if (lines_[at][0] == "ELSE") ++at;
      return true;
    }
    if (word == "ELSE") {
      at = partner(false);
      return true;
    }
    if (word == "CAL") return call(words);
    if (word == "RET") return back();
    if (word == "WAT" && value(words[1]) == 0) return wait();
    if (word == "WTN" && value(words[1]) != 0) return wait();
    if (word == "TMR") return time(words);
    return next();
  }

  bool call(const Words& words) {
    const int passes = words.size() < 3 ? 1 : value(words[2]);
    if (passes <= 0) return next();
    const std::size_t to = label(words[1]);
    if (to == lines_.size()) return stop(3);
    if (passes_.size() == 16) return stop(5);
    passes_.push_back({at + 1, to, passes});
    return go(to);
  }
  bool back() {
    if (passes_.empty()) return stop(5);
    Pass& pass = passes_.back();
    if (--pass.left > 0) return go(pass.label);
    const std::size_t to = pass.back;
    passes_.pop_back();
    return go(to);
  }
  bool time(const Words& words) {
    if (until_ == 0) {
      until_ = value(words[1]);
      if (until_ > 0) return wait();
      until_ = 0;
      return next();
    }
    return --until_ == 0 ? next() : wait();
  }
  bool wait() {
    waits_ = true;
    return false;
  }

  std::vector<Words> lines_;
  std::vector<bool> blocks_;
  std::vector<Pass> passes_;
  int until_ = 0;
  bool waits_ = false;
};

TEST(Super40ncRandomFlow, EqualsANaiveEvaluator) {
  constexpr int kPrograms = 3000;
  constexpr int kTicks = 150;
  std::map<int, int> endings;
  for (int seed = 0; seed < kPrograms; ++seed) {
    Random random(static_cast<unsigned>(seed));
    const std::vector<std::string> lines = Writer(random).program();
    std::string text = "AREA X\n";
    for (const std::string& line : lines) text += line + "\n";
    const Checked checked = check(text);
    ASSERT_TRUE(checked.program) << seed << "\n" << text << to_string(checked.errors.at(0));
    Running running(text);
    ProgramCounts counts;
    running.machine.set_watch(&counts);
    Naive naive(lines);
    running.start(Area::x);
    for (int tick = 0; tick < kTicks; ++tick) {
      const int changed = below(random, 40);  // another area's
      if (changed < 8) {
        const bool on = random() % 2 != 0;
        running.machine.set(m(changed), on);
        naive.values["M" + std::to_string(changed)] = on ? 1 : 0;
      }
      running.tick();
      naive.tick();
      const std::string where = std::to_string(seed) + " tick " + std::to_string(tick) + "\n";
      for (int i = 0; i < 8; ++i) {
        ASSERT_EQ(running.machine.contact(m(i)) ? 1 : 0, naive.values["M" + std::to_string(i)])
            << where << list(*checked.program);
        ASSERT_EQ(running.machine.value(d(i)), naive.values["D" + std::to_string(i)])
            << where << list(*checked.program);
      }
      ASSERT_EQ(running.phase(Area::x) != Phase::idle, naive.runs) << where << list(*checked.program);
      if (naive.runs) {
        ASSERT_EQ(running.codes[1].line_at(running.state(Area::x).step), static_cast<int>(naive.at))
            << where << list(*checked.program);
        continue;
      }
      ASSERT_EQ(running.machine.codes.empty() ? 0 : running.machine.codes.back()[0], naive.code)
          << where << list(*checked.program);
      break;
    }
    ASSERT_EQ(counts.lines, naive.counts) << seed << "\n" << list(*checked.program);
    ++endings[naive.runs ? -1 : naive.code];
  }
  for (const int ending : {-1, 0, 3, 5}) EXPECT_GT(endings[ending], kPrograms / 50) << ending;
}

}  // namespace random_flow_test
}  // namespace understudy::interpreter::super_40nc
