// The counts of an observer of random programs compared with a naive evaluator that reads their lines word by
// word.
#include <gtest/gtest.h>

#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/interpreter/program_counts.h"
#include "tests/interpreter/slim/scripted_machine.h"

namespace understudy::interpreter::slim {
namespace counts_test {

using Random = std::mt19937;

int below(Random& random, int limit) { return static_cast<int>(random() % static_cast<unsigned>(limit)); }

/// Line n has the label $Ln.
std::vector<std::string> random_lines(Random& random) {
  const int count = 6 + below(random, 20);
  const auto label = [&] { return "$L" + std::to_string(below(random, count)); };
  const auto number = [&](int limit) { return std::to_string(below(random, limit)); };
  const auto input = [&] { return std::to_string(1 + below(random, 4)); };
  std::vector<std::string> lines;
  for (int i = 0; i < count; ++i) {
    std::string text;
    switch (below(random, 15)) {
      case 0:
      case 1: text = "N" + number(3) + "=" + number(2); break;
      case 2: text = "SET P1"; break;
      case 3: text = "JP " + label(); break;
      case 4: text = "JI " + input() + "," + label(); break;
      case 5: text = "JNI " + input() + "," + label(); break;
      case 6: text = "JZ N" + number(3) + "," + label(); break;
      case 7: text = "JNZ N" + number(3) + "," + label(); break;
      case 8: text = "JTI " + input() + "," + number(6) + "," + label(); break;
      case 9: text = "WI " + input(); break;
      case 10: text = "WNI " + input(); break;
      case 11: text = "WT " + number(5); break;
      case 12: text = "CALL " + label(); break;
      case 13: text = below(random, 3) == 0 ? "RET" : "CLR P2"; break;
      default: text = "DN";
    }
    lines.push_back("$L" + std::to_string(i) + " " + text);
  }
  return lines;
}

class Naive {
 public:
  explicit Naive(const std::vector<std::string>& lines) {
    for (std::string line : lines) {
      for (char& c : line) c = c == ',' || c == '=' ? ' ' : c;
      std::istringstream words(line);
      lines_.push_back({std::istream_iterator<std::string>(words), {}});
    }
  }

  void tick(std::int64_t now_ms, const std::set<int>& inputs, bool is_chain_busy) {
    if (!runs) return;
    if (times_) {
      if (now_ms < until_ms_) return;
      times_ = false;
      next();
    }
    if (runs) line(now_ms, inputs, is_chain_busy);
  }

  bool runs = true;
  LineTally counts;

 private:
  void go(std::size_t to) {
    at_ = to;
    waits_ = false;
    if (at_ >= lines_.size()) runs = false;
  }
  void next() { go(at_ + 1); }
  void jump(const std::string& label) { go(static_cast<std::size_t>(std::stoi(label.substr(2)))); }

  void line(std::int64_t now_ms, const std::set<int>& inputs, bool is_chain_busy) {
    const std::vector<std::string>& words = lines_[at_];
    const std::string& word = words[1];
    LineCount& count = counts[{0, static_cast<int>(at_)}];
    const bool begins = !waits_;
    if (begins) ++count.runs;
    const auto is_on = [&] { return inputs.contains(std::stoi(words[2])); };
    const auto jump_if = [&](bool jumps) {
      count.decide(jumps);
      jumps ? jump(words[3]) : next();
    };
    if (word == "JP") return jump(words[2]);
    if (word == "JI") return jump_if(is_on());
    if (word == "JNI") return jump_if(!is_on());
    if (word == "JZ") return jump_if(numbers_[words[2]] == 0);
    if (word == "JNZ") return jump_if(numbers_[words[2]] != 0);
    if (word == "JTI") {
      if (begins) until_ms_ = now_ms + std::stoi(words[3]);
      waits_ = !is_on() && now_ms < until_ms_;
      if (waits_) return;
      count.decide(is_on());
      return is_on() ? jump(words[4]) : next();
    }
    if (word == "WI" || word == "WNI" || word == "DN") {
      const bool is_over = word == "DN" ? !is_chain_busy : is_on() == (word == "WI");
      if (begins) count.decide(is_over);
      waits_ = true;
      if (is_over) next();
      return;
    }
    if (word == "WT") {
      times_ = words[2] != "0";
      until_ms_ = now_ms + std::stoi(words[2]);
      if (!times_) next();
      return;
    }
    if (word == "CALL") {
      if (calls_.size() == 16) runs = false;
      calls_.push_back(at_ + 1);
      return jump(words[2]);
    }
    if (word == "RET") {
      if (calls_.empty()) {
        runs = false;
        return;
      }
      const std::size_t to = calls_.back();
      calls_.pop_back();
      return go(to);
    }
    if (word.starts_with("N")) numbers_[word] = std::stoi(words[2]);
    next();
  }

  std::vector<std::vector<std::string>> lines_;
  std::map<std::string, int> numbers_;
  std::vector<std::size_t> calls_;
  std::size_t at_ = 0;
  std::int64_t until_ms_ = 0;
  bool waits_ = false;
  bool times_ = false;  // waits for a time
};

TEST(SlimCounts, EqualThoseOfANaiveEvaluator) {
  constexpr int kPrograms = 1000;
  std::int64_t decided[2]{};
  for (int seed = 0; seed < kPrograms; ++seed) {
    Random random(static_cast<unsigned>(seed));
    const std::vector<std::string> lines = random_lines(random);
    ProgramRun run(lines);
    ProgramCounts counts;
    run.machine.set_watch(&counts);
    Naive naive(lines);
    ASSERT_EQ(start(run.execution, run.program, nullptr, run.options), Error::none);
    std::string text = std::to_string(seed) + "\n";
    for (const std::string& line : lines) text += line + "\n";
    for (int tick = 1; tick < 300; ++tick) {
      if (below(random, 4) == 0) run.machine.inputs = {1 + below(random, 4), 1 + below(random, 4)};
      if (below(random, 4) == 0) {
        run.machine.waiting = below(random, 2) == 0 ? std::set<std::string>{"DN"} : std::set<std::string>{};
      }
      run.machine.now_ms = tick;
      step(run.execution, tick, run.program, run.options, run.machine);
      naive.tick(tick, run.machine.inputs, !run.machine.waiting.empty());
      ASSERT_EQ(run.execution.running, naive.runs) << text << "at " << tick;
    }
    ASSERT_EQ(counts.lines, naive.counts) << text;
    for (const auto& [place, count] : counts.lines) {
      decided[0] += count.no;
      decided[1] += count.yes;
    }
  }
  EXPECT_GT(decided[0], 10 * kPrograms);
  EXPECT_GT(decided[1], 10 * kPrograms);
}

}  // namespace counts_test
}  // namespace understudy::interpreter::slim
