// Whatever stands in a bench file: it is a bench, or it gets one complaint. Nothing crashes.
#include <gtest/gtest.h>

#include <random>

#include "tests/emulator/bench/bench_texts.h"

namespace understudy::emulator {
namespace {

/// True if it is a bench or gets a complaint that begins with file and line.
bool is_handled(const std::string& text) {
  try {
    parse(text);
  } catch (const BenchError& error) {
    const std::string what = error.what();
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

TEST(BenchMutation, EveryBeginningOfAFileIsHandled) {
  for (const std::string& seed : {kFullBench, kDisturbedBench}) {
    ASSERT_EQ(complaint(seed), "");
    for (std::size_t size = 0; size <= seed.size(); ++size) {
      EXPECT_TRUE(is_handled(seed.substr(0, size))) << "the first " << size << " bytes of\n" << seed;
    }
  }
}

TEST(BenchMutation, EveryByteMayBeAnyOther) {
  std::mt19937 random(4711);
  const std::string bytes("\0\n\t:-[}\"|&*!#\x80\xFF", 15);
  for (const std::string& seed : {kFullBench, kDisturbedBench}) {
    for (std::size_t i = 0; i < seed.size(); ++i) {
      std::string text = seed;
      for (int times = 0; times < 4; ++times) {
        text[i] = bytes[random() % bytes.size()];
        EXPECT_TRUE(is_handled(text)) << "byte " << i << " is " << static_cast<int>(text[i]);
      }
    }
  }
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
    std::string text = any_seed(random);
    const int changes = 1 + static_cast<int>(random() % 4);
    for (int change = 0; change < changes; ++change) {
      const std::size_t from = random() % text.size();
      const std::size_t length = random() % 40;
      const std::size_t to = random() % text.size();
      switch (random() % 4) {
        case 0: text.erase(from, length); break;
        case 1: text.insert(to, text.substr(from, length)); break;
        case 2: text.replace(to, length, text.substr(from, length)); break;
        default: text.insert(to, words[random() % std::size(words)]); break;
      }
      if (text.empty()) text = "x";
    }
    EXPECT_TRUE(is_handled(text)) << "round " << round << ":\n" << text;
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
    EXPECT_NE(complaint(text), "") << text.substr(0, 60);
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

}  // namespace
}  // namespace understudy::emulator
