// JUnit XML, read back by an independent parser: Python's.
#include "emulator/play/results/junit.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace understudy::emulator::play {
namespace junit_test {

using Verdict = ScenarioResult::Verdict;

/// Every element on a line, by its depth: tag, attributes in alphabetical order, text. An error if it is not
/// well-formed.
constexpr const char* kReader = R"(
import sys, xml.etree.ElementTree as tree
def show(element, depth):
    attributes = ' '.join('%s=%r' % pair for pair in sorted(element.attrib.items()))
    text = (element.text or '').strip()
    print('  ' * depth + ' '.join(part for part in (element.tag, attributes, repr(text) if text else '') if part))
    for child in element: show(child, depth + 1)
show(tree.parse(sys.argv[1]).getroot(), 0)
)";

std::string read_back(const std::string& xml) {
  const std::filesystem::path folder = testing::TempDir();
  const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
  const std::string file = folder / ("understudy-" + name + std::to_string(getpid()) + ".xml");
  const std::string script = file + ".py";
  std::ofstream(file) << xml;
  std::ofstream(script) << kReader;
  const std::string command = "PYTHONIOENCODING=utf-8 python3 " + script + " " + file + " 2>&1";
  std::string output;
  if (FILE* const pipe = popen(command.c_str(), "r")) {
    for (int c = 0; (c = fgetc(pipe)) != EOF;) output += static_cast<char>(c);
    pclose(pipe);
  }
  std::filesystem::remove(file);
  std::filesystem::remove(script);
  return output;
}

const std::vector<ScenarioResult> kResults = {
    {.name = "a move",
     .file = "b.yaml",
     .steps = {{"b.yaml", 5, "write a=1", SimTime{0}, SimTime{9'916'666}}},
     .simulated = SimTime{3'075'000'000},
     .lint_findings = {"rs485: 2 requests <soon>"}},
    {.verdict = Verdict::failed,
     .name = "it's \"<odd>\" & more",
     .file = "a.yaml",
     .steps = {{"a.yaml", 3, "advance 1s", SimTime{0}, SimTime{1'000'000'000}},
               {"a.yaml", 4, "assert x < 1 ]]>", SimTime{1'000'000'000}, SimTime{1'000'000'000}, true}},
     .failure = Failure{.at = SimTime{1'000'000'000}, .what = "'x < 1' does not hold", .expected = "x < 1"},
     .simulated = SimTime{1'000'000'000}},
    {.verdict = Verdict::not_reached, .name = "it / a branch", .file = "a.yaml"},
    {.name = "another", .file = "b.yaml", .simulated = SimTime{25}},
};

TEST(Junit, IsReadBackAsItWasMeant) {
  EXPECT_EQ(
      read_back(junit_text(kResults)),
      "testsuites errors='0' failures='1' name='understudy' skipped='1' tests='4' time='4.075000025'\n"
      "  testsuite errors='0' failures='0' name='b.yaml' skipped='0' tests='2' time='3.075000025'\n"
      "    testcase classname='b.yaml' name='a move' time='3.075000000'\n"
      "      system-out '0s to 9.916666ms  b.yaml:5  write a=1\\nlint: rs485: 2 requests <soon>'\n"
      "    testcase classname='b.yaml' name='another' time='0.000000025'\n"
      "  testsuite errors='0' failures='1' name='a.yaml' skipped='1' tests='2' time='1.000000000'\n"
      "    testcase classname='a.yaml' name='it\\'s \"<odd>\" & more' time='1.000000000'\n"
      "      failure message=\"'x < 1' does not hold\" type='expectation' \"a.yaml:4: assert x < 1 ]]>\\n  "
      "'x < 1' does not hold\\n  expected: x < 1\"\n"
      "      system-out '0s to 1s  a.yaml:3  advance 1s\\n1s to 1s  a.yaml:4  assert x < 1 ]]>  FAILED'\n"
      "    testcase classname='a.yaml' name='it / a branch' time='0.000000000'\n"
      "      skipped message='a step before its fork failed'\n");
}

TEST(Junit, OfNothingIsWellFormedToo) {
  EXPECT_EQ(
      read_back(junit_text({})),
      "testsuites errors='0' failures='0' name='understudy' skipped='0' tests='0' time='0.000000000'\n");
}

TEST(Junit, WhatXmlCannotHoldIsReplaced) {
  struct Case {
    std::string text;
    std::string escaped;
  };
  const std::string kReplaced = "\xEF\xBF\xBD";
  const std::vector<Case> cases = {
      {"plain", "plain"},
      {"<&>\"'", "&lt;&amp;&gt;&quot;'"},
      {"\t\n", "\t\n"},
      {"\r", "&#13;"},
      {std::string("\0", 1), kReplaced},
      {"\x1B[31m", kReplaced + "[31m"},
      {"\xE9\x9B\xBB", "\xE9\x9B\xBB"},                                     // U+96FB
      {"\xF0\x9F\x98\x80", "\xF0\x9F\x98\x80"},                             // U+1F600
      {"\xC0\x80", kReplaced + kReplaced},                                  // NUL, two bytes long
      {"\xED\xA0\x80", kReplaced + kReplaced + kReplaced},                  // half a surrogate pair
      {"\xEF\xBF\xBF", kReplaced + kReplaced + kReplaced},                  // U+FFFF
      {"\xF4\x90\x80\x80", kReplaced + kReplaced + kReplaced + kReplaced},  // beyond U+10FFFF
      {"\xE9\x9B", kReplaced + kReplaced},                                  // truncated
      {"\xFF", kReplaced},
  };
  for (const Case& c : cases) EXPECT_EQ(xml_escaped(c.text), c.escaped) << testing::PrintToString(c.text);
}

TEST(Junit, NoByteMakesItUnreadable) {
  std::string all;
  for (int first = 0; first < 256; ++first) {
    for (const char second : {'a', '\x80', '\xBF', '<', '\0'}) all += {static_cast<char>(first), second};
  }
  const std::vector<ScenarioResult> results = {
      {.verdict = Verdict::failed,
       .name = all,
       .file = all,
       .steps = {{all, 1, all, SimTime{0}, SimTime{0}, true}},
       .failure = Failure{.what = all, .expected = all, .came = all, .details = {all}, .frames = {all}}}};
  const std::string text = read_back(junit_text(results));
  EXPECT_EQ(text.find("Error"), std::string::npos) << text.substr(0, 2000);
  EXPECT_EQ(text.find("testsuites"), 0U);
}

TEST(Junit, OfManyCasesOnlyTheFirstFailureIsAtLength) {
  const auto varied = [](ScenarioResult result) {
    result.which.is_varied = true;
    return result;
  };
  ScenarioResult alike = kResults[1];
  alike.like = "it's \"<odd>\" & more";
  ScenarioResult unreadable{.verdict = Verdict::failed, .name = "wrong", .file = "a.yaml"};
  unreadable.is_unreadable = true;
  unreadable.failure = Failure{.what = "a.yaml:3:1: vary.x: 7 is too much"};
  unreadable.like = "another";
  const std::string text =
      read_back(junit_text(std::vector{varied(kResults[0]), varied(alike), varied(unreadable)}));
  EXPECT_EQ(text,
            "testsuites errors='1' failures='1' name='understudy' skipped='0' tests='3' time='4.075000000'\n"
            "  testsuite errors='0' failures='0' name='b.yaml' skipped='0' tests='1' time='3.075000000'\n"
            "    testcase classname='b.yaml' name='a move' time='3.075000000'\n"
            "      system-out 'lint: rs485: 2 requests <soon>'\n"
            "  testsuite errors='1' failures='1' name='a.yaml' skipped='0' tests='2' time='1.000000000'\n"
            "    testcase classname='a.yaml' name='it\\'s \"<odd>\" & more' time='1.000000000'\n"
            "      failure message=\"'x < 1' does not hold\" type='expectation'\n"
            "    testcase classname='a.yaml' name='wrong' time='0.000000000'\n"
            "      error message='a.yaml:3:1: vary.x: 7 is too much' type='case'\n");
  const std::string first = read_back(junit_text(std::vector{varied(kResults[1])}));
  EXPECT_NE(first.find("expected: x < 1"), std::string::npos) << first;
}

TEST(Junit, SuitesOfFilesThatComeAgainStayTogether) {
  Junit junit;
  for (int i = 0; i < 30; ++i) {
    junit.add({.name = "case " + std::to_string(i), .file = i % 3 == 0 ? "a.yaml" : "b.yaml"});
  }
  std::string text;
  junit.write([&](std::string_view piece) { text += piece; });
  std::vector<std::size_t> places;
  for (int i = 0; i < 30; i += 3) places.push_back(text.find("name=\"case " + std::to_string(i) + "\""));
  for (int i = 0; i < 30; ++i) {
    if (i % 3 != 0) places.push_back(text.find("name=\"case " + std::to_string(i) + "\""));
  }
  EXPECT_TRUE(std::is_sorted(places.begin(), places.end()));
  EXPECT_LT(places.back(), text.size());
}

}  // namespace junit_test
}  // namespace understudy::emulator::play
