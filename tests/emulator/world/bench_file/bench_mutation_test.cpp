// Any text as a bench file is a bench or gets one diagnostic. Nothing crashes.
#include <gtest/gtest.h>

#include <random>

#include "emulator/world/bench_file/yaml_fields.h"
#include "tests/emulator/world/bench_file/bench_texts.h"
#include "tests/emulator/world/bench_file/mutated_text.h"

namespace understudy::emulator::world {
namespace bench_mutation_test {

/// Returns true if it is a bench or gets a diagnostic that begins with file and line.
bool is_handled(const std::string& text) {
  try {
    parse(text);
  } catch (const BenchError& error) {
    const std::string what = without_columns(error.what());
    std::size_t at = std::string("bench.yaml:").size();
    const bool has_line = what.starts_with("bench.yaml:") && what[at] >= '1' && what[at] <= '9';
    while (at < what.size() && what[at] >= '0' && what[at] <= '9') ++at;
    EXPECT_TRUE(has_line && what.substr(at, 2) == ": ") << what;
    return has_line;
  } catch (const std::exception& other) {
    ADD_FAILURE() << other.what();
    return false;
  }
  return true;
}

const std::string& any_seed(std::mt19937& random) { return random() % 2 == 0 ? kFullBench : kDisturbedBench; }

const TryText kTryText = [](const std::string& text, const std::string& how) {
  EXPECT_TRUE(is_handled(text)) << how << ":\n" << text;
};

TEST(BenchMutation, EveryBeginningOfAFileIsHandled) {
  for (const std::string& whole : {kFullBench, kDisturbedBench}) {
    ASSERT_EQ(diagnostic(whole), "");
    try_every_beginning(whole, kTryText);
  }
}

TEST(BenchMutation, EveryByteMayBeAnyOther) {
  std::mt19937 random(4711);
  for (const std::string& whole : {kFullBench, kDisturbedBench}) try_every_byte(whole, random, 4, kTryText);
}

TEST(BenchMutation, PiecesMayBeMovedRepeatedAndLost) {
  std::mt19937 random(1234);
  const std::string words[] = {"\n",
                               "  ",
                               "- ",
                               ": ",
                               "{ ",
                               " }",
                               "[",
                               "]",
                               "#",
                               "'",
                               "\"",
                               "&a ",
                               "*a",
                               "<<: ",
                               "? ",
                               "| \n",
                               "> \n",
                               "---\n",
                               "...\n",
                               "!!str ",
                               "~",
                               "99999999999999999999",
                               "-0x7FFFFFFFFFFFFFFF",
                               "1e308",
                               "%",
                               "\xFF\xFE",
                               "\xEF\xBB\xBF",
                               "\\x00",
                               "->",
                               "."};
  for (int round = 0; round < 2000; ++round) {
    kTryText(with_pieces_moved(any_seed(random), random, words), "round " + std::to_string(round));
  }
}

TEST(BenchMutation, DeepNestingIsRefused) {
  const auto times = [](const std::string& piece, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += piece;
    return text;
  };
  std::string staircase = "understudy: 1\nlines:\n";
  for (std::size_t depth = 1; depth < 900; ++depth) staircase += std::string(depth, ' ') + "a:\n";
  for (const std::string& text :
       {"understudy: 1\nlines: " + times("[", 20000),
        "understudy: 1\nlines: " + times("[", 3000) + times("]", 3000), times("{a: ", 20000),
        times("- ", 20000), times("? ", 20000), times("[{a: ", 20000), staircase, times("&a ", 20000),
        times("!a ", 20000)}) {
    EXPECT_TRUE(is_handled(text)) << text.substr(0, 60);
    EXPECT_NE(diagnostic(text), "") << text.substr(0, 60);
  }
}

TEST(BenchMutation, ReferencesToReferencesDoNotExplode) {
  std::string bomb = "a: &a [x, x, x, x, x, x, x, x, x]\n";
  for (char name = 'b'; name < 'p'; ++name) {
    bomb += std::string(1, name) + ": &" + name + " [";
    for (int i = 0; i < 9; ++i) bomb += std::string(i > 0 ? ", " : "") + "*" + static_cast<char>(name - 1);
    bomb += "]\n";
  }
  EXPECT_TRUE(is_handled(bomb));
  EXPECT_TRUE(is_handled("understudy: 1\nlines: &l\n  a: *l\n"));
  EXPECT_TRUE(is_handled("understudy: 1\nlines: { a: &l { stations: &s [ *l, *s ] } }\n"));
  EXPECT_TRUE(is_handled("understudy: 1\nlines: { a: { stations: &s [ *s ] } }\n"));
  EXPECT_TRUE(is_handled("&a { understudy: 1, lines: *a, devices: *a }\n"));
}

TEST(BenchMutation, DefaultsThatHoldThemselvesHaveAnEnd) {
  const auto own = YamlFields::parse("&a { one: 1, more: *a }\n", "f.yaml", "file", "something");
  const auto defaults = YamlFields::parse("&a { two: 2, more: *a }\n", "f.yaml", "file", "something");
  YamlFields both = own.with_defaults(defaults);
  for (int depth = 0; depth < 10; ++depth) {
    EXPECT_EQ(both.at("one").text(), "1") << depth;
    EXPECT_EQ(both.at("two").text(), "2") << depth;
    both = both.at("more");
  }
}

}  // namespace bench_mutation_test
}  // namespace understudy::emulator::world
