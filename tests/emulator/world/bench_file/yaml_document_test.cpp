// A text that is not YAML gets one line in plain words, with its line and column, at once.
#include "emulator/world/bench_file/yaml_document.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <array>
#include <string>

#include "base/files/file_error.h"
#include "tests/sanitized.h"

namespace understudy::emulator::world {
namespace yaml_document_test {

/// Returns the message about a text; empty if there is none.
std::string diagnostic(const std::string& text) {
  try {
    parse_yaml(text, "a.yaml", "bench");
    return "";
  } catch (const FileError& error) {
    return error.what();
  }
}

struct Bad {
  std::string text;
  std::string begin;  // of the diagnostic, after "a.yaml:"
};

TEST(YamlDocument, WhatIsNotYamlIsSaidInPlainWords) {
  const std::string not_yaml = ": bench: is not YAML: ";
  for (const auto& [text, begin] : std::vector<Bad>{
           {"a: 1\n\tb: 2\n", "2:1" + not_yaml + "a tab indents this line; expected spaces"},
           {"a:\n\t- 1\n", "2:2" + not_yaml + "a tab indents this line; expected spaces"},
           {"a:\n  b: 1\n c: 2\n", "3:2" + not_yaml + "this line is indented differently from those"},
           {"a:\n  - b: 1\n - c: 2\n", "3:2" + not_yaml + "this line is indented differently from those"},
           {"a:\n  b: 1\n   c: 2\n", "3:5" + not_yaml + "this key does not fit the previous line"},
           {"a: 1\nb\nc: 2\n", "3:2" + not_yaml + "this key does not fit the previous line"},
           {"a: b: c\n", "1:5" + not_yaml + "a second ': ' in one line"},
           {"a: [ 1, 2\nb: 3\n", "2:2" + not_yaml + "a '[' before this is not closed"},
           {"a: { b: 1\nc: 2\n", "2:2" + not_yaml + "a '{' before this is not closed"},
           {"a: { b: 1 c: 2 }\n", "1:12" + not_yaml + "a ',' is missing before this"},
           {"a: { b: 1\n     c: 2,\n     d: 3 }\n", "2:7" + not_yaml + "a ',' is missing before this"},
           {"a: [ { b: 1 } { b: 2 } ]\n", "1:15" + not_yaml + "a ',' is missing before this"},
           {"a: [ { b: 1 }\n { b: 2 } ]\n", "2:2" + not_yaml + "a ',' is missing before this"},
           {"a:1\nb: 2\n", "2:2" + not_yaml + "the previous line has no space after its ':'"},
           {"l:\n  - a:1\n    b: 2\n", "3:6" + not_yaml + "the previous line has no space after its ':'"},
           {"a: 1\nb:2\nc: 3\n", "3:2" + not_yaml + "the previous line has no space after its ':'"},
           {"a: ]\n", "1:4" + not_yaml + "there is no matching '[' or '{' before this"},
           {"a: 1\n}\n", "2:1" + not_yaml + "there is no matching '[' or '{' before this"},
           {"a: \"x\nb: 2\n", "1:4" + not_yaml + "a quote is not closed"},
           {"a: 1\nb: 'x\nc: 2\n", "2:4" + not_yaml + "a quote is not closed"},
           {"a: 'it''s\n", "1:4" + not_yaml + "a quote is not closed"},
           {"a: 'it's'\n", "1:8" + not_yaml + "more text follows a complete value"},
           {"a: \"x\" y\n", "1:8" + not_yaml + "more text follows a complete value"},
           {"a: @x\n", "1:4" + not_yaml + "a text cannot begin with this character"},
           {"a: *x\n", "1:4" + not_yaml + "no text before this has this anchor"},
           {"a: - 1\n", "1:4" + not_yaml + "a list's '- ' is not allowed here"},
           {"a: \"\\q\"\n", "1:7" + not_yaml + "this escape sequence does not exist"},
           {"a: |x\n", "1:5" + not_yaml + "something follows a '|' or '>'"},
           {"a: { b: ${c} }\n", "1:10" + not_yaml + "a '{' inside braces begins a map"},
           {"%YAML 9.9\n---\na: 1\n", "1:1" + not_yaml + "YAML major version too large"},
           {"a: 1\n---\nb: 1\n", "2:1: bench: a second document begins here; expected only one"},
           {"a: 1\n...\nb: 1\n", "3:1: bench: a second document begins here; expected only one"},
           {",", "1:1" + not_yaml + "this does not belong to the map before it"},
           {"# text\n, more\nunderstudy: 1\n",
            "2:1" + not_yaml + "this does not belong to the map before it"},
           {"- 1\na: 2\n", "2:1" + not_yaml + "this does not belong to the map before it"},
       }) {
    const std::string got = diagnostic(text);
    EXPECT_TRUE(got.starts_with("a.yaml:" + begin)) << text << got;
    EXPECT_EQ(got.find('\n'), std::string::npos) << got;
  }
}

TEST(YamlDocument, TheLineIsShown) {
  EXPECT_EQ(diagnostic("a: 1\n\tb: 2\r\n"),
            "a.yaml:2:1: bench: is not YAML: a tab indents this line; expected spaces  (the line is "
            "'\\x09b: 2')");
}

TEST(YamlDocument, GoodQuotesAreLeftAlone) {
  for (const char* text : {"a: 'it''s'\n", "a: \"x\\\"y\"\n", "a: \"x\n  y\"\n", "a: ''\n", "a: it's\n",
                           "'a': 1", "a: \"\\\\\"", "a: 'x' # isn't\n",
                           "\xEF\xBB\xBF"
                           "a: 'x'\r\n"}) {
    EXPECT_EQ(diagnostic(text), "") << text;
  }
}

/// All texts of up to `max` of these.
void try_all(const std::string& text, int max) {
  static constexpr std::array<const char*, 24> kTokens{
      ",",  ":",     "- ",    "? ", "[", "]",   "{",  "}",   "a",  ": ", "\n",   "\n  ",
      "\t", "---\n", "...\n", "\"", "'", "&a ", "*a", "!t ", "| ", "> ", "%Y\n", "# c\n"};
  diagnostic(text);
  if (max == 0) return;
  for (const char* token : kTokens) try_all(text + token, max - 1);
}

TEST(YamlDocument, AllFilesOfThreeTokensAreReadAtOnce) {
  // In a separate process, which is ended if it takes too much memory or time.
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const rlimit limit{.rlim_cur = rlim_t{1} << 30, .rlim_max = rlim_t{1} << 30};
    if (!is_sanitized()) setrlimit(RLIMIT_AS, &limit);
    alarm(120);
    try {
      try_all("", 3);
      _exit(0);
    } catch (...) {
      _exit(1);
    }
  }
  int status = -1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}

}  // namespace yaml_document_test
}  // namespace understudy::emulator::world
