#include "emulator/world/bench_file/yaml_text.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::world {
namespace yaml_text_test {

YamlFields parsed(const std::string& text) { return YamlFields::parse(text, "f.yaml", "file", "something"); }

/// Returns true if both are the same tree of texts.
bool are_same(const YamlFields& a, const YamlFields& b) {
  if (a.is_scalar()) return b.is_scalar() && a.text() == b.text();
  if (a.is_list()) {
    const auto of_a = a.elements();
    if (!b.is_list() || b.elements().size() != of_a.size()) return false;
    for (std::size_t i = 0; i < of_a.size(); ++i) {
      if (!are_same(of_a[i], b.elements()[i])) return false;
    }
    return true;
  }
  if (!a.is_map()) return !b.is_scalar() && !b.is_list() && !b.is_map();
  const auto of_a = a.entries();
  if (!b.is_map() || b.entries().size() != of_a.size()) return false;
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    if (of_a[i].first != b.entries()[i].first || !are_same(of_a[i].second, b.entries()[i].second))
      return false;
  }
  return true;
}

constexpr const char* kTrees[] = {
    "a: 1\n",
    "a: { b: [ 1, on, -2.5, 0x10, 20ms ], c: feeder.STATUS.4 == 0 && time > 3s }\n",
    "a: [ '', ' x', 'x ', '{', 'a: b', 'a #b', '#', '- x', '?', 'null', '~', '\"', '\\', '%', '@', '&', '*' "
    "]\n",
    "a: [ null, {}, [], \"\\t\", \"\\u00e9\", \"line\\rend\", \"\\x01\", '!x', '|', '>', \"a,b\", \"[b]\" "
    "]\n",
    "'a b': 1\n'c: d': 2\n'': 3\n",
    "a: |\n  first\n    second\n\n  third\n",
    "a: |-\n  first\n  second\n",
    "a: { b: \"one\\ntwo\\n\", c: [ { d: \"one\\ntwo\" }, { e: \" x\\ny\\n\" }, { f: \"x\\n\\n\" } ] }\n",
    "a: { long: { aaaaaaaaaaaaaaaaaaaaaaaaaa: 1111111111111111, bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb: "
    "222222222222222222, "
    "c: [ { ddddddddddddddddddddddddddddddd: 33333333333333333333333333333333, "
    "eeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeee: "
    "[ 1, 2, 3 ] }, 4444444444444444444444444444444444 ] } }\n",
};

TEST(YamlText, ItIsReadAsTheSameTree) {
  for (const char* const tree : kTrees) {
    const YamlFields whole = parsed(tree);
    std::string block;
    for (const auto& [key, value] : whole.entries()) block += block_text(key, value, "", "");
    EXPECT_TRUE(are_same(whole, parsed(block))) << tree << block;
    EXPECT_TRUE(are_same(whole, parsed("x: " + flow_text(whole) + "\n").at("x"))) << flow_text(whole);
  }
}

TEST(YamlText, ShortValuesStayOnOneLine) {
  const YamlFields whole =
      parsed("inject:\n  drop: feeder\n  nth: 2\nprogram:\n  feeder: |\n    SVON_A\n    END\n");
  EXPECT_EQ(block_text("inject", whole.at("inject"), "    ", "  - "),
            "  - inject: { drop: feeder, nth: 2 }\n");
  EXPECT_EQ(block_text("program", whole.at("program"), "    ", "  - "),
            "  - program:\n      feeder: |\n        SVON_A\n        END\n");
}

TEST(YamlFields, SettledNodesNeedNoRule) {
  class Rule final : public ScalarRule {
   public:
    std::string apply(const std::string& written) const override { return written == "${key}" ? "k" : "7"; }
  };
  const YamlFields whole = parsed("\"${key}\": { a: \"${x}\", b: [ 1, \"${x}\" ] }\n");
  std::optional<YamlFields> settled;
  {
    const Rule rule;
    settled = whole.with_rule(&rule).settled([](const YamlFields& part) -> std::optional<std::string> {
      return part.is_list() ? std::optional<std::string>("list") : std::nullopt;
    });
  }
  EXPECT_EQ(flow_text(*settled), "{ k: { a: 7, b: list } }");
  EXPECT_EQ(settled->at("k").at("b").place().column, whole.at("${key}").at("b").place().column);
  EXPECT_EQ(flow_text(settled->at("k").with_entry("c", "9")), "{ a: 7, b: list, c: 9 }");
  EXPECT_EQ(flow_text(settled->at("k").under("up")), "{ up: { a: 7, b: list } }");
}

TEST(YamlFields, AnAliasInsideItselfIsRefused) {
  EXPECT_THROW(parsed("a: &x { b: *x }\n").settled(), FileError);
}

}  // namespace yaml_text_test
}  // namespace understudy::emulator::world
