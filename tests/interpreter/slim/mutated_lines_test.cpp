// Lines that are nearly right: none does harm, and an accepted line reads back from its own text.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tests/interpreter/slim/row_cases.h"
#include "tests/interpreter/slim/scripted_machine.h"

namespace understudy::interpreter::slim {
namespace mutated_lines_test {

/// The same numbers everywhere (the constants are Knuth's, MMIX).
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  std::size_t below(std::size_t sides) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::size_t>(state_ >> 33) % sides;
  }

 private:
  std::uint64_t state_;
};

std::string_view any_line(Dice& dice) { return kRowCases[dice.below(kRowCases.size())].accepted; }

std::string mutated(Dice& dice) {
  static constexpr std::string_view kSigns = "0123456789.,=+-$\"#()? \tTNRPEVMAJGS\x1B\xE2\x80\x9C\xFF";
  std::string line(any_line(dice));
  for (std::size_t changes = 1 + dice.below(3); changes > 0; --changes) {
    const std::size_t at = dice.below(line.size() + 1);
    const char sign = kSigns[dice.below(kSigns.size())];
    switch (dice.below(6)) {
      case 0: line.insert(at, 1, sign); break;
      case 1: line.erase(at, 1); break;
      case 2:
        if (at < line.size()) line[at] = sign;
        break;
      case 3: line = line.substr(0, at) + std::string(any_line(dice)); break;
      case 4: line.insert(at, std::string(dice.below(20), '9')); break;
      default: line.insert(0, "T" + std::to_string(dice.below(10))); break;
    }
  }
  return line;
}

TEST(SlimMutatedLines, AreRefusedOrReadBack) {
  Dice dice(6);
  int understood = 0;
  for (int i = 0; i < 20'000; ++i) {
    const std::string line = mutated(dice);
    const ParseResult result = parse_line(line);
    if (result.error != Error::none) {
      EXPECT_TRUE(result.error == Error::syntax || result.error == Error::range) << line;
      EXPECT_EQ(result.line, ParsedLine{}) << line;
      continue;
    }
    ++understood;
    EXPECT_EQ(parse_line(text_of(result.line)), result) << line << " -> " << text_of(result.line);
  }
  // Neither result is rare; otherwise the test would prove little.
  EXPECT_GT(understood, 2'000);
  EXPECT_LT(understood, 18'000);
}

TEST(SlimMutatedLines, MakeProgramsThatComeToNoHarm) {
  Dice dice(60);
  for (int i = 0; i < 300; ++i) {
    ProgramRun run({"SET EV1 I,1", "ON EV1,0"}, {option("failed_line", "is_passed_over")});
    for (int line = 0; line < 30; ++line) {
      const std::string text = dice.below(3) == 0 ? "JP " + std::to_string(dice.below(30)) : mutated(dice);
      run.program.insert(run.program.size(), text);
    }
    ASSERT_EQ(run.begin(), Error::none);
    for (int ms = 0; ms < 300; ms += 3) {
      run.until(run.machine.now_ms + 3);
      run.machine.inputs = {static_cast<int>(dice.below(8)) + 1};
      run.machine.variables["N0"] = static_cast<double>(dice.below(3)) - 1;
      if (wants_number(run.execution)) give_number(run.execution, run.program, "3");
      EXPECT_LE(run.execution.stack.size(), 17u);
      EXPECT_LT(run.execution.line, run.program.size());
    }
  }
}

}  // namespace mutated_lines_test
}  // namespace understudy::interpreter::slim
