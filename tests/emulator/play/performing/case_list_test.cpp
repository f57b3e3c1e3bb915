// Which cases of which files run: patterns, IDs, shards; each case is read only when its turn comes.
#include "emulator/play/performing/case_list.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/emulator/play/performing/scenario_folder.h"

namespace understudy::emulator::play {
namespace case_list_test {

using Strings = std::vector<std::string>;

TEST(Shards, AreWrittenAsPartOfHowMany) {
  struct Row {
    const char* text;
    std::uint64_t number;  // 0: refused
    std::uint64_t of;
  };
  for (const Row& row : std::vector<Row>{{"1/1", 1, 1},
                                         {"2/4", 2, 4},
                                         {"4/4", 4, 4},
                                         {"5/4", 0, 0},
                                         {"0/4", 0, 0},
                                         {"-1/4", 0, 0},
                                         {"1", 0, 0},
                                         {"/4", 0, 0},
                                         {"1/", 0, 0},
                                         {"", 0, 0},
                                         {"1/2/3", 0, 0},
                                         {"a/b", 0, 0},
                                         {"1/0", 0, 0}}) {
    const auto shard = parse_shard(row.text);
    EXPECT_EQ(shard.has_value(), row.number != 0) << row.text;
    if (!shard) continue;
    EXPECT_EQ(shard->number, row.number) << row.text;
    EXPECT_EQ(shard->of, row.of) << row.text;
  }
}

TEST(Patterns, MatchNamesOrAreAnIdentity) {
  const Case which{.values = {{"n", "1"}}};
  const std::uint64_t identity = identity_of(which);
  struct Row {
    std::string pattern;
    const char* name;
    bool matches;
  };
  for (const Row& row : std::vector<Row>{{"", "a move", true},
                                         {"*", "a move", true},
                                         {"*move*", "a move", true},
                                         {"? move", "a move", true},
                                         {"[ab] move", "a move", true},
                                         {"[bc] move", "a move", false},
                                         {"move", "a move", false},
                                         {"a [1] move", "a [1] move", true},  // also without changes
                                         {identity_text(identity), "a move", true},
                                         {identity_text(identity).substr(0, 8) + "*", "a move", false},
                                         {identity_text(identity + 1), "a move", false}}) {
    EXPECT_EQ(matches(row.pattern, row.name, identity), row.matches) << row.pattern;
  }
}

class CaseListOf : public testing::Test {
 protected:
  CaseListOf() {
    std::string names;
    for (const char* name : {"a move", "home from anywhere", "a long move", "EEPROM busy", "move (n=1)"}) {
      names += std::string(names.empty() ? "" : ", ") + "{ n: \"" + name + "\" }";
    }
    folder_.write("five.yaml", "understudy: 1\nname: \"${n}\"\nbench: feeder.yaml\ncases: [ " + names +
                                   " ]\nsteps: [ advance: 1ms ]\n");
    folder_.write("grid.yaml",
                  "understudy: 1\nname: grid\nbench: feeder.yaml\nvary: { a: [ 1, 2, 3 ], b: { from: 1, to: "
                  "7, step: 1 } "
                  "}\nsteps: [ say: \"${a} ${b}\" ]\n");
    folder_.write("one.yaml", "understudy: 1\nname: one\nbench: feeder.yaml\nsteps: [ advance: 1ms ]\n");
  }

  CaseList& case_list(const Strings& files, std::optional<std::uint64_t> seed = {}) {
    case_list_.emplace(models::all_models(), ReadingOptions{.save_below = "", .seed = seed});
    for (const std::string& file : files) case_list_->add(folder_.path(file), [](const Scenario&) {});
    return *case_list_;
  }
  Strings names(const CaseList& of, const std::string& pattern, Shard shard) {
    Selection selection(of, pattern, shard);
    CaseReader reader(of);
    Strings found;
    while (const auto which_case = selection.next()) {
      found.push_back(reader.read(*which_case)->name);
      EXPECT_EQ(reader.name_of(*which_case), found.back());
    }
    EXPECT_EQ(Selection::count(of, pattern, shard), found.size())
        << pattern << shard.number << "/" << shard.of;
    return found;
  }

  ScenarioFolder folder_;
  std::optional<CaseList> case_list_;
};

TEST_F(CaseListOf, PatternsAndShardsChooseInOrder) {
  const CaseList& five = case_list({"five.yaml"});
  struct Row {
    const char* pattern;
    Shard shard;
    Strings chosen;
  };
  for (const Row& row : std::vector<Row>{
           {"", {1, 1}, {"a move", "home from anywhere", "a long move", "EEPROM busy", "move (n=1)"}},
           {"*move*", {1, 1}, {"a move", "a long move", "move (n=1)"}},
           {"a*", {1, 1}, {"a move", "a long move"}},
           {"[Eh]*", {1, 1}, {"home from anywhere", "EEPROM busy"}},
           {"nothing", {1, 1}, {}},
           {"", {1, 2}, {"a move", "a long move", "move (n=1)"}},
           {"", {2, 2}, {"home from anywhere", "EEPROM busy"}},
           {"*move*", {2, 2}, {"a long move"}},
           {"", {5, 7}, {"move (n=1)"}},
           {"", {7, 7}, {}}}) {
    EXPECT_EQ(names(five, row.pattern, row.shard), row.chosen) << row.pattern << row.shard.number;
  }
}

TEST_F(CaseListOf, FilesCaseByCaseOneAfterTheOther) {
  const CaseList& all = case_list({"one.yaml", "grid.yaml", "five.yaml"});
  EXPECT_EQ(all.cases(), 27U);
  const Strings found = names(all, "", {});
  ASSERT_EQ(found.size(), 27U);
  EXPECT_EQ(found[0], "one");
  EXPECT_EQ(found[1], "grid (a=1, b=1)");
  EXPECT_EQ(found[2], "grid (a=1, b=2)");
  EXPECT_EQ(found[21], "grid (a=3, b=7)");
  EXPECT_EQ(found[22], "a move");
}

TEST_F(CaseListOf, EveryCaseIsInExactlyOneShard) {
  const CaseList& all = case_list({"one.yaml", "grid.yaml", "five.yaml"});
  const Strings whole = names(all, "", {});
  for (std::uint64_t of = 1; of < 31; ++of) {
    std::multiset<std::string> seen;
    for (std::uint64_t number = 1; number <= of; ++number) {
      for (const std::string& name : names(all, "", {number, of})) seen.insert(name);
    }
    EXPECT_EQ(seen, std::multiset<std::string>(whole.begin(), whole.end())) << of;
  }
}

TEST_F(CaseListOf, ACaseIsFoundByItsIdentity) {
  const CaseList& all = case_list({"one.yaml", "grid.yaml"});
  const std::string identity = identity_text(identity_of(Case{.values = {{"b", "5"}, {"a", "2"}}}));
  EXPECT_EQ(names(all, identity, {}), Strings{"grid (a=2, b=5)"});
  EXPECT_EQ(names(all, "grid (a=2, b=5)", {}), Strings{"grid (a=2, b=5)"});
}

TEST_F(CaseListOf, MoreThanCanBeHeldIsReadAgain) {
  std::string rows;
  for (int i = 0; i < 1500; ++i) rows += "  - { n: " + std::to_string(i) + " }\n";
  folder_.write("many.yaml", "understudy: 1\nname: \"many ${n}\"\nbench: feeder.yaml\ncases:\n" + rows +
                                 "steps: [ say: \"${n}\" ]\n");
  const CaseList& all = case_list({"one.yaml", "many.yaml"});
  const Strings found = names(all, "", {});
  ASSERT_EQ(found.size(), 1501U);
  EXPECT_EQ(found[1500], "many 1499");
  folder_.write("many.yaml", "understudy: 1\nbench: feeder.yaml\nsteps: [ advance: 1ms ]\n");
  CaseReader reader(all);
  EXPECT_THROW(reader.read({.file = 1, .number = 3}), FileError) << "it is another file now";
  EXPECT_EQ(reader.read({.file = 0, .number = 0})->name, "one");
}

TEST_F(CaseListOf, WhatAFileIsMadeOfIsKnown) {
  const auto made_of = [&](std::optional<std::uint64_t> seed = {}) {
    return case_list({"grid.yaml"}, seed).made_of(0);
  };
  const std::uint64_t before = made_of();
  EXPECT_EQ(made_of(), before);
  EXPECT_NE(made_of(5), before) << "another seed";
  folder_.write("feeder.yaml", kTwoStations + "# a remark\n");
  EXPECT_NE(made_of(), before) << "another bench";
  folder_.write("feeder.yaml", kTwoStations);
  EXPECT_EQ(made_of(), before);
}

TEST_F(CaseListOf, TwoCasesNeverSaveOneFile) {
  // Only cases that are checked beforehand differ; others are discovered when they are read.
  folder_.write(
      "save.yaml",
      "understudy: 1\nname: save\nbench: feeder.yaml\nvary: { a: { from: 0, to: 3999, step: 1 } }\n"
      "steps:\n  - say: \"${a}\"\n  - save: { feeder: \"after-${a / 3999 * 10000 + a % 1331}.json\" }\n");
  const CaseList& all = case_list({"save.yaml"});
  CaseReader reader(all);
  const auto number_of_first = std::uint64_t{17};
  EXPECT_EQ(reader.read({.file = 0, .number = number_of_first})->saved.size(), 1U);
  EXPECT_NO_THROW(reader.read({.file = 0, .number = number_of_first})) << "it can run again";
  CaseReader other(all);
  try {
    other.read({.file = 0, .number = number_of_first + 1331});
    ADD_FAILURE() << "expected it to throw";
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("after-17.json is also saved by another case"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace case_list_test
}  // namespace understudy::emulator::play
