// The counts of an observer of random programs compared with a naive evaluator that reads their listings word
// by word.
#include <gtest/gtest.h>

#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "interpreter/simple2/listing.h"
#include "tests/interpreter/program_counts.h"
#include "tests/interpreter/simple2/scripted_machine.h"

namespace understudy::interpreter::simple2 {
namespace counts_test {

using Random = std::mt19937;

int below(Random& random, int limit) { return static_cast<int>(random() % static_cast<unsigned>(limit)); }

/// The first words of lines are their labels: JMPn marks line n - 1.
std::vector<std::string> random_lines(Random& random) {
  const int count = 6 + below(random, 20);
  const auto flag = [&] { return "JMP" + std::to_string(1 + below(random, count)); };
  const auto memory = [&] { return "MEM" + std::to_string(1 + below(random, 4)); };
  const auto input = [&] { return "DIN_" + std::to_string(below(random, 4)); };
  std::vector<std::string> lines;
  for (int i = 1; i <= count; ++i) {
    std::string text;
    switch (below(random, 13)) {
      case 0: text = "NOP"; break;
      case 1:
      case 2: text = "VAR_Inc " + memory(); break;
      case 3: text = "VAR_Dec " + memory(); break;
      case 4: text = "Jump " + flag(); break;
      case 5: text = "Jump_IN_ON " + flag() + " " + input(); break;
      case 6: text = "Jump_IN_OFF " + flag() + " " + input(); break;
      case 7: text = "Wait_IO " + input() + (below(random, 2) == 0 ? " ON" : " OFF"); break;
      case 8: text = "Delay_mSec " + std::to_string(below(random, 9)); break;
      case 9: text = "VAR_GT " + memory() + " " + memory(); break;
      case 10: text = "VAR_EQ " + memory() + " " + memory(); break;
      case 11: text = "VAR_GT_0 " + flag() + " " + memory(); break;
      default: text = "VAR_LT " + memory() + " " + memory();
    }
    lines.push_back("JMP" + std::to_string(i) + ": " + text);
  }
  lines.push_back("JMP" + std::to_string(count + 1) + ": END");
  lines.push_back("JMP" + std::to_string(count + 2) + ": END");  // after a skipped END
  return lines;
}

class Naive {
 public:
  explicit Naive(const std::vector<std::string>& lines) : lines_(lines) {}

  void slot(std::int64_t now_ms, std::uint16_t inputs) {
    if (!runs || now_ms < until_ms_) return;
    std::istringstream words(lines_[at]);
    std::string label;
    std::string word;
    std::string first;
    std::string second;
    words >> label >> word >> first >> second;
    LineCount& count = counts[{0, static_cast<int>(at)}];
    const bool begins = !std::exchange(waits_, false);
    if (begins) ++count.runs;
    ++at;
    const auto is_on = [&](const std::string& input) { return (inputs >> (input.back() - '0') & 1) != 0; };
    if (word == "END") runs = false;
    if (word == "VAR_Inc") ++memory_[first.back() - '0'];
    if (word == "VAR_Dec") --memory_[first.back() - '0'];
    if (word == "Jump") jump(first);
    if (word == "Delay_mSec") until_ms_ = now_ms + std::stoi(first);
    if (word == "Jump_IN_ON" || word == "Jump_IN_OFF") {
      const bool jumps = is_on(second) == (word == "Jump_IN_ON");
      count.decide(jumps);
      if (jumps) jump(first);
    }
    if (word == "VAR_GT_0") {
      const bool jumps = memory_[second.back() - '0'] > 0;
      count.decide(jumps);
      if (jumps) jump(first);
    }
    if (word == "Wait_IO") {
      const bool is_over = is_on(first) == (second == "ON");
      if (begins) count.decide(is_over);
      if (is_over) return;
      --at;
      waits_ = true;
    }
    if (word == "VAR_GT" || word == "VAR_EQ" || word == "VAR_LT") {
      const int a = memory_[first.back() - '0'];
      const int b = memory_[second.back() - '0'];
      const bool holds = word == "VAR_GT" ? a > b : word == "VAR_EQ" ? a == b : a < b;
      count.decide(holds);
      if (!holds) ++at;
    }
  }

  bool runs = true;
  std::size_t at = 0;
  LineTally counts;

 private:
  void jump(const std::string& flag) { at = static_cast<std::size_t>(std::stoi(flag.substr(3)) - 1); }

  std::vector<std::string> lines_;
  int memory_[10]{};
  std::int64_t until_ms_ = 0;
  bool waits_ = false;
};

TEST(Simple2Counts, EqualThoseOfANaiveEvaluator) {
  constexpr int kPrograms = 1000;
  std::int64_t decided[2]{};
  for (int seed = 0; seed < kPrograms; ++seed) {
    Random random(static_cast<unsigned>(seed));
    const std::vector<std::string> lines = random_lines(random);
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    const Assembly assembly = assemble(text);
    ASSERT_TRUE(assembly.lines) << text << to_string(assembly.errors.at(0));
    ProgramRun run{Program(*assembly.lines)};
    ProgramCounts counts;
    run.machine.set_watch(&counts);
    Naive naive(lines);
    for (int slot = 0; slot < 300; ++slot) {
      if (below(random, 6) == 0) run.machine.inputs = static_cast<std::uint16_t>(below(random, 16));
      naive.slot(run.next_slot_ms, run.machine.inputs);
      run.slot();
      ASSERT_EQ(run.execution.running, naive.runs) << seed << "\n" << text;
    }
    ASSERT_EQ(counts.lines, naive.counts) << seed << "\n" << text;
    for (const auto& [place, count] : counts.lines) {
      decided[0] += count.no;
      decided[1] += count.yes;
    }
  }
  EXPECT_GT(decided[0], 10 * kPrograms);
  EXPECT_GT(decided[1], 10 * kPrograms);
}

TEST(Simple2Counts, ALoopDecidesAtTheEndOfEachPass) {
  const Assembly assembly = assemble("again: NOP\nLoop again 3\nEND\n");
  ProgramRun run{Program(*assembly.lines)};
  ProgramCounts counts;
  run.machine.set_watch(&counts);
  run.to_the_end();
  EXPECT_EQ(
      counts.lines,
      (LineTally{{{0, 0}, {.runs = 3}}, {{0, 1}, {.runs = 3, .yes = 2, .no = 1}}, {{0, 2}, {.runs = 1}}}));
}

}  // namespace counts_test
}  // namespace understudy::interpreter::simple2
