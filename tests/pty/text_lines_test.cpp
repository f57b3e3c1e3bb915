#include "pty/text_lines.h"

#include <gtest/gtest.h>

#include <vector>

namespace understudy::pty {
namespace text_lines_test {

using What = ReceivedText::What;

/// The result of characters, one after another: "[text]" for a line, "<long>", "<esc>"; echoes next to it.
struct Heard {
  std::string events;
  std::string echo;
  std::uint64_t dropped = 0;
};

Heard receive(const std::string& characters, const TextLineRules& rules = {}) {
  TextLines lines;
  Heard heard;
  std::uint64_t number = 0;
  for (const char character : characters) {
    ++number;
    const SimTime at{1000 * static_cast<std::int64_t>(number)};
    const auto outcome = lines.push({at, at, static_cast<std::uint8_t>(character), number}, rules);
    heard.echo += outcome.echo;
    if (!outcome.received) continue;
    EXPECT_EQ(outcome.received->last_character, number);
    EXPECT_EQ(outcome.received->end, at);
    switch (outcome.received->what) {
      case What::line: heard.events += "[" + outcome.received->text + "]"; break;
      case What::overlong: heard.events += "<long>"; break;
      case What::escape: heard.events += "<esc>"; break;
      case What::hold: heard.events += "<hold>"; break;
      case What::release: heard.events += "<go on>"; break;
    }
  }
  heard.dropped = lines.dropped_bytes();
  return heard;
}

TEST(TextLines, WhereALineEnds) {
  struct Case {
    std::string characters;
    std::string events;
  };
  const std::vector<Case> cases{
      {"MA 1\r", "[MA 1]"},
      {"MA 1\r\n?PE\r\n", "[MA 1][?PE]"},
      {"MA 1\n?PE\n", "[MA 1][?PE]"},
      {"\r", "[]"},
      {"\r\r", "[][]"},
      {"\n", ""},
      {"\r\n\n", "[]"},
      {"A\n\r", "[A][]"},  // LF ends A, the CR after it an empty line
      {"A", ""},
      {"A\x1B"
       "B\r",
       "<esc>[B]"},
      {"\x1B\x1B", "<esc><esc>"},
      {"A\bB\r", "[A\bB]"},  // without an echo there is no editing
      {std::string("A\0B\r", 4), std::string("[A\0B]", 5)},
      {"\xFF\x80\r", "[\xFF\x80]"},
  };
  for (const Case& wanted : cases)
    EXPECT_EQ(receive(wanted.characters).events, wanted.events) << wanted.characters;
}

TEST(TextLines, ALineMayReachTheLimitAndATooLongOneIsReportedAtEnd) {
  const TextLineRules five{.longest = 5};
  EXPECT_EQ(receive("12345\rA\r", five).events, "[12345][A]");
  EXPECT_EQ(receive("123456", five).events, "");
  EXPECT_EQ(receive("123456\r\nA\r", five).events, "<long>[A]");
  EXPECT_EQ(receive("123456789012345\nA\n", five).events, "<long>[A]");
  EXPECT_EQ(receive("123456789012345\n", five).dropped, 15u);
  EXPECT_EQ(receive("123456\x1B"
                    "A\r",
                    five)
                .events,
            "<esc>[A]");
  EXPECT_EQ(receive(std::string(127, 'x') + "\r").events, "[" + std::string(127, 'x') + "]");
  EXPECT_EQ(receive(std::string(128, 'x') + "\r").events, "<long>");
}

TEST(TextLines, WhatIsTypedIsEchoedAndCanBeTakenBack) {
  const TextLineRules typed{.longest = 5, .echoes = true};
  const Heard heard = receive("AC\bB\x7F\x7F\x7F\bMA\r\n", typed);
  EXPECT_EQ(heard.events, "[MA]");
  // A, C, back over C, B, back over B and over A, and twice nothing is left; LF after CR is not echoed.
  EXPECT_EQ(heard.echo, "AC\b \bB\b \b\b \bMA\r\n");
  EXPECT_EQ(receive("A\n", typed).echo, "A\r\n");
  EXPECT_EQ(receive("A\x1B", typed).echo, "A");
}

TEST(TextLines, WhereOnlyCrEndsALineAnLfIsNothing) {
  const TextLineRules rules{.longest = 5, .echoes = true, .line_feed_ends = false};
  EXPECT_EQ(receive("M\nA\n\r\n\nB\n", rules).events, "[MA]");
  EXPECT_EQ(receive("\n\r\r\n", rules).events, "[][]");
  EXPECT_EQ(receive("12345\n\r", rules).events, "[12345]");  // it does not count
  EXPECT_EQ(receive("M\nA\n\r\n", rules).echo, "MA\r\n");
}

TEST(TextLines, WhatSteersTheFlowIsInNoLine) {
  const TextLineRules rules{.longest = 5, .echoes = true, .has_flow_control = true, .echoed_end = "\r"};
  const Heard heard = receive(
      "M\x13"
      "A\x11\x11\r",
      rules);
  EXPECT_EQ(heard.events, "<hold><go on><go on>[MA]");
  EXPECT_EQ(heard.echo, "MA\r");
  EXPECT_EQ(heard.dropped, 0u);
  EXPECT_EQ(receive("\r\x13\nA\r", rules).events, "[]<hold>[A]");  // the LF still follows the CR
  EXPECT_EQ(receive("M\x13"
                    "A\r")
                .events,
            "[M\x13"
            "A]");  // where it has no effect
}

TEST(TextLines, WhatIsForgottenIsInNoLine) {
  TextLines lines;
  lines.push({.value = 'A'}, {});
  lines.reset();
  lines.push({.value = 'B'}, {});
  EXPECT_EQ(lines.push({.value = '\r'}, {}).received->text, "B");
}

TEST(TextLines, ContinuesFromItsStateAsItDid) {
  const std::string characters = "A\r\nBCDEFG\rH\x1BI\bJ\r\n\nK";
  const TextLineRules rules{.longest = 5, .echoes = true};
  TextLines lines;
  for (const char character : characters) {
    TextLines other;
    other.restore(lines.save());
    const TimedByte byte{.value = static_cast<std::uint8_t>(character)};
    const auto one = lines.push(byte, rules);
    const auto two = other.push(byte, rules);
    EXPECT_EQ(one.echo, two.echo);
    ASSERT_EQ(one.received.has_value(), two.received.has_value());
    if (one.received) {
      EXPECT_EQ(one.received->text, two.received->text);
    }
    EXPECT_EQ(lines.save(), other.save());
  }
}

TEST(TextLines, RefusesStatesThatCannotBe) {
  const std::vector<TextLines::State> states{
      {.text = "A\r"},
      {.text = "A", .is_overlong = true},
      {.text = "A", .was_return = true},
      {.text = std::string(TextLines::kLongest + 1, 'x')},
  };
  for (const auto& state : states) {
    TextLines lines;
    EXPECT_THROW(lines.restore(state), std::invalid_argument);
    EXPECT_EQ(lines.save(), TextLines::State{});
  }
}

}  // namespace text_lines_test
}  // namespace understudy::pty
