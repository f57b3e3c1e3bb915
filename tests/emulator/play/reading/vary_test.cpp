// `vary`: the number of cases, their order, their names, and their IDs.
#include <gtest/gtest.h>

#include <set>

#include "emulator/play/reading/shared_reading.h"
#include "tests/emulator/play/performing/scenario_folder.h"

namespace understudy::emulator::play {
namespace vary_test {

using Strings = std::vector<std::string>;

class Vary : public testing::Test {
 protected:
  /// A scenario that uses each of the parameters.
  static std::string text(const std::string& more, const Strings& names) {
    std::string message;
    for (const std::string& name : names) message += "${" + name + "} ";
    return "understudy: 1\nbench: feeder.yaml\n" + more + "steps: [ say: \"" + message + "\" ]\n";
  }
  std::unique_ptr<ScenarioFile> open(const std::string& text, std::optional<std::uint64_t> seed = {}) {
    return std::make_unique<ScenarioFile>(text, folder_.path("scenario.yaml"),
                                          ReadingOptions{.save_below = "", .seed = seed}, shared_);
  }
  Strings cases(ScenarioFile& file) {
    Strings all;
    for (std::uint64_t i = 0; i < file.size(); ++i) all.push_back(to_text(file.case_of(i)));
    return all;
  }
  std::set<std::uint64_t> identities(ScenarioFile& file) {
    std::set<std::uint64_t> all;
    for (std::uint64_t i = 0; i < file.size(); ++i) all.insert(identity_of(file.case_of(i)));
    return all;
  }

  ScenarioFolder folder_;
  SharedReading shared_{.models = models::all_models(), .benches = {}, .included = {}};
};

TEST_F(Vary, CombinesAllValuesTheLastOneFastest) {
  const auto file = open(text("vary: { a: [ 1, 2 ], b: { from: 5ms, to: 7ms, step: 1ms } }\n", {"a", "b"}));
  EXPECT_TRUE(file->is_varied());
  EXPECT_EQ(cases(*file), (Strings{"(a=1, b=5ms)", "(a=1, b=6ms)", "(a=1, b=7ms)", "(a=2, b=5ms)",
                                   "(a=2, b=6ms)", "(a=2, b=7ms)"}));
  EXPECT_EQ(file->name_of(4), "scenario (a=2, b=6ms)");
  EXPECT_EQ(file->read(4).steps.at(0).text, "say 2 6ms ");
  EXPECT_EQ(file->read(4).name, file->name_of(4));
}

TEST_F(Vary, MultipliesEachRowOfCases) {
  const auto file =
      open(text("cases: [ { c: x, d: 1 }, { c: y, d: 2 } ]\nvary: { a: [ 1, 2 ] }\n", {"a", "c", "d"}));
  EXPECT_EQ(cases(*file),
            (Strings{"(c=x, d=1, a=1)", "(c=x, d=1, a=2)", "(c=y, d=2, a=1)", "(c=y, d=2, a=2)"}));
}

TEST_F(Vary, DrawsOncePerCaseWhateverElseThereIs) {
  const std::string draw = ", d: { between: [ 1, 1000000 ] } }\n";
  const auto few = open(text("vary: { a: [ 1, 2 ]" + draw, {"a", "d"}));
  const auto more = open(text("vary: { a: [ 0, 2, 1 ]" + draw, {"a", "d"}));
  EXPECT_EQ(few->size(), 2U);
  EXPECT_EQ(to_text(few->case_of(0)), to_text(more->case_of(2)));
  EXPECT_EQ(to_text(few->case_of(1)), to_text(more->case_of(1)));
  EXPECT_NE(few->case_of(0).values[1], few->case_of(1).values[1]);
  // A different common seed draws different values.
  EXPECT_NE(to_text(open(text("vary: { a: [ 1, 2 ]" + draw, {"a", "d"}), 7)->case_of(0)),
            to_text(few->case_of(0)));
}

TEST_F(Vary, MayNumberMoreThanAnybodyCouldPlay) {
  const auto file = open(text(
      "vary: { a: { from: 1, to: 1000000, step: 1 }, b: { between: [ 0, 999999 ], samples: 1000000 } }\n",
      {"a", "b"}));
  EXPECT_EQ(file->size(), 1'000'000'000'000U);
  EXPECT_EQ(file->case_of(999'999'999'999).values[0].second, "1000000");
  EXPECT_EQ(file->read(999'999'999'999).name, file->name_of(999'999'999'999));
  EXPECT_EQ(folder_.diagnostic(
                text("vary: { a: { from: 1, to: 1000000, step: 1 }, b: { from: 0, to: 1000000, step: 1 } }\n",
                     {"a", "b"})),
            "scenario.yaml:3: vary.b: results in more than 1000000000000 cases; expected fewer");
}

TEST_F(Vary, EachCaseHasAnIdentityOfItsOwn) {
  const auto file = open(
      text("vary: { a: { from: 1, to: 300, step: 1 }, b: { from: 1, to: 300, step: 1 } }\n", {"a", "b"}));
  EXPECT_EQ(identities(*file).size(), 90'000U);
}

TEST_F(Vary, IdentitiesDependOnTheValuesAlone) {
  const auto file = open(text("vary: { a: [ 1, 2, 3 ], b: [ x, y ] }\n", {"a", "b"}));
  const auto turned = open(text("name: other\nvary: { b: [ y, x ], a: [ 3, 1, 2 ] }\n", {"a", "b"}));
  EXPECT_EQ(identities(*file), identities(*turned));
  const auto rows = open(text("cases: [ { b: y, a: 3 }, { a: 1, b: x } ]\n", {"a", "b"}));
  for (const std::uint64_t identity : identities(*rows)) EXPECT_TRUE(identities(*file).contains(identity));
  EXPECT_EQ(identity_text(identity_of(Case{.values = {{"a", "1"}, {"b", "x"}}})),
            identity_text(identity_of(Case{.values = {{"b", "x"}, {"a", "1"}}})));
  // Neither is a hash of the other's text.
  EXPECT_NE(identity_of(Case{.values = {{"a", "1b=x"}}}),
            identity_of(Case{.values = {{"a", "1"}, {"b", "x"}}}));
  // FNV-1a of "a=1:1", by another program.
  EXPECT_EQ(identity_text(identity_of(Case{.values = {{"a", "1"}}})), "23b37933adac6f6f");
}

TEST_F(Vary, NamesTellCasesApart) {
  struct Row {
    const char* name;
    const char* called;
  };
  for (const Row& row : std::vector<Row>{{"", "scenario (a=1, b=2)"},
                                         {"name: a move\n", "a move (a=1, b=2)"},
                                         {"name: \"${a} first\"\n", "1 first (b=2)"},
                                         {"name: \"${a + 1} first\"\n", "2 first (b=2)"},
                                         {"name: \"${b} and ${a}\"\n", "2 and 1"}}) {
    const auto file = open(text(row.name + std::string("vary: { a: [ 1 ], b: [ 2 ] }\n"), {"a", "b"}));
    EXPECT_EQ(file->name_of(0), row.called);
    EXPECT_EQ(file->read(0).name, row.called);
  }
}

TEST_F(Vary, ValuesGoWhereverParametersGo) {
  const auto file = open(
      "understudy: 1\nparameters: { far: \"${pulses * 2}\" }\n"
      "vary: { version: [ 1.40, 1.52 ], pulses: [ 5 ], kind: [ drop, busy ] }\n"
      "bench:\n"
      "  lines: { a: { stations: [ { name: lone, model: simple2-r3, firmware: \"${version}\" } ] } }\n"
      "steps:\n  - inject: { \"${kind}\": lone, nth: 2 }\n  - write: { lone.Aaxis_Pulse: \"${far}\" }\n");
  const Scenario scenario = file->read(3);
  EXPECT_EQ(scenario.bench.devices.at(0).settings.firmware, 152);
  EXPECT_EQ(texts_of(scenario.steps), (Strings{"inject busy lone nth=2", "write lone.Aaxis_Pulse=10"}));
}

TEST_F(Vary, TypicalCasesHaveEachListedValueAndBothEnds) {
  const auto file =
      open(text("cases: [ { r: p }, { r: q } ]\n"
                "vary: { a: [ k, l, m ], b: { from: 1, to: 100000, step: 1 }, "
                "c: { between: [ 0, 99 ], samples: 50, seed: 2 }, d: { between: [ 1, 6 ] } }\n",
                {"r", "a", "b", "c", "d"}));
  EXPECT_EQ(file->size(), 2U * 3 * 100'000 * 50);
  std::size_t count = 0;
  std::set<std::string> seen;
  file->check([&](const Scenario& scenario) {
    ++count;
    for (const auto& [name, value] : scenario.which.values) seen.insert(name + "=" + value);
  });
  EXPECT_LE(count, 1000U);
  for (const char* value : {"r=p", "r=q", "a=k", "a=l", "a=m", "b=1", "b=100000"}) {
    EXPECT_TRUE(seen.contains(value)) << value;
  }
  for (std::uint64_t i = 0; i < 50; ++i) {
    EXPECT_TRUE(seen.contains("c=" + file->case_of(i).values[3].second)) << i;
  }
  // For a few cases, all are read.
  std::size_t few = 0;
  open(text("vary: { a: { from: 1, to: 999, step: 1 } }\n", {"a"}))->check([&](const Scenario&) { ++few; });
  EXPECT_EQ(few, 999U);
}

TEST_F(Vary, WhatIsWrongIsSaidWithItsPlace) {
  struct Row {
    std::string text;
    const char* diagnostic;
  };
  for (const Row& row : std::vector<Row>{
           {text("vary: {}\n", {}),
            "3: vary: is empty; expected a parameter's values, as in `speed: [ 100, 200 ]`"},
           {text("vary: [ 1 ]\n", {}), "3: vary: expected a map, as in `key: value`"},
           {text("vary: { a: [ 1 ], a: [ 2 ] }\n", {"a"}),
            "3: vary.a: is given twice; expected it only once"},
           {text("vary: { a: [ 1 ] }\n", {}),
            "3: vary.a: 'a' is not used; expected ${a} somewhere in the scenario  (a=1)"},
           {text("vary: { a: [ \"${b}\" ] }\n", {"a"}),
            "3: vary.a[0]: column 1 of 'b': no parameter is called 'b'; there are none"},
           {text("vary: { \"a b\": [ 1 ] }\n", {}),
            "3: vary.a b: 'a b' is not a parameter name; expected letters, digits and _, beginning with a "
            "letter  (a b=1)"},
           {text("cases: [ { a: 1 } ]\nvary: { a: [ 1 ] }\n", {"a"}),
            "4: vary.a: is already in `cases`; expected it in only one of the two"},
           {text("vary: { a: { between: [ 1, 2 ] } }\n", {"a"}),
            "3: vary: does not set the number of cases; expected `samples: 100` next to a `between` or "
            "`one_of`"},
           {"understudy: 1\nbench: feeder.yaml\nvary: { ramp: [ 100, 5000 ] }\n"
            "steps: [ write: { feeder.Aaxis_AccTime: \"${ramp}\" } ]\n",
            "4: steps[0].write.feeder.Aaxis_AccTime: 5000 is out of range for feeder.Aaxis_AccTime; expected "
            "0 to 3000  (ramp=5000)"},
           {"understudy: 1\nbench: feeder.yaml\nvary: { a: [ 1, 2 ] }\n"
            "steps: [ say: \"${a}\", save: { feeder: same.json } ]\n",
            "4: steps[1].save.feeder: same.json is what another case saves; expected another path  (a=2)"}}) {
    EXPECT_EQ(folder_.diagnostic(row.text), "scenario.yaml:" + std::string(row.diagnostic)) << row.text;
  }
}

}  // namespace vary_test
}  // namespace understudy::emulator::play
