// Several plays in one file, and the options of a choice as cases.
#include <gtest/gtest.h>

#include "emulator/play/reading/shared_reading.h"
#include "emulator/play/scenario/case.h"
#include "tests/emulator/play/performing/scenario_folder.h"

namespace understudy::emulator::play {
namespace plays_test {

using namespace std::chrono_literals;
using Strings = std::vector<std::string>;

class SeveralPlays : public testing::Test {
 protected:
  Strings names(const std::string& text) const {
    Strings names;
    for (const Scenario& scenario : folder_.parse(text)) names.push_back(scenario.name);
    return names;
  }
  ScenarioFolder folder_;
};

const std::string kTwoPlays = R"(understudy: 1
bench:
  lines: { com: { timing: instant, stations: [ { device: d, address: 1 } ] } }
  devices: { d: { model: simple2-r3, set: { Aaxis_SVON: 1, Aaxis_Speed: 100 } } }
gap: 2ms
parameters: { far: 100 }
plays:
  - name: one
    steps: [ write: { Aaxis_Pulse: "${far}" } ]
  - name: "two at ${speed}"
    bench: { devices: { d: { firmware: 1.40, set: { Aaxis_Speed: 300 } } } }
    gap: 5ms
    cases: [ { speed: 1 }, { speed: 2 } ]
    steps: [ write: { Aaxis_Speed: "${speed}" } ]
)";

TEST_F(SeveralPlays, AreScenariosOneAfterTheOther) {
  EXPECT_EQ(names(kTwoPlays), (Strings{"one", "two at 1", "two at 2"}));
}

TEST_F(SeveralPlays, ShareWhatTheFileSaysAndChangeParts) {
  const auto scenarios = folder_.parse(kTwoPlays);
  ASSERT_EQ(scenarios.size(), 3U);
  using Set = std::vector<std::pair<std::string, std::int64_t>>;
  const auto settings = [&](std::size_t i) { return scenarios[i].bench.devices.at(0).settings; };
  EXPECT_EQ(settings(0).set, (Set{{"Aaxis_SVON", 1}, {"Aaxis_Speed", 100}}));
  EXPECT_EQ(settings(0).firmware, 0);
  EXPECT_EQ(scenarios[0].gap, 2ms);
  EXPECT_EQ(texts_of(scenarios[0].steps), Strings{"write Aaxis_Pulse=100"});
  EXPECT_EQ(settings(1).set, (Set{{"Aaxis_SVON", 1}, {"Aaxis_Speed", 300}}));
  EXPECT_EQ(settings(1).firmware, 140);
  EXPECT_EQ(scenarios[1].gap, 5ms);
}

TEST_F(SeveralPlays, AlikeCasesOfTwoPlaysAreNotOne) {
  const auto scenarios = folder_.parse(
      "understudy: 1\nbench: feeder.yaml\ncases: [ { speed: 1 } ]\nplays:\n"
      "  - { name: a, steps: [ write: { feeder.Aaxis_Speed: \"${speed}\" } ] }\n"
      "  - { name: b, steps: [ write: { turner.Aaxis_Speed: \"${speed}\" } ] }\n");
  ASSERT_EQ(scenarios.size(), 2U);
  EXPECT_EQ(scenarios[0].which.values, scenarios[1].which.values);
  EXPECT_NE(identity_of(scenarios[0].which), identity_of(scenarios[1].which));
}

TEST_F(SeveralPlays, AreReadByNumber) {
  SharedReading shared{.models = models::all_models(), .benches = {}, .included = {}};
  ScenarioFile file(kTwoPlays, folder_.path("scenario.yaml"), {}, shared);
  ASSERT_EQ(file.size(), 3U);
  EXPECT_EQ(file.name_of(0), "one");
  EXPECT_EQ(file.name_of(2), "two at 2");
  EXPECT_EQ(file.read(1).name, "two at 1");
  EXPECT_EQ(to_text(file.case_of(2)), "(speed=2)");
}

std::string of_choice(const std::string& choice, const std::string& steps = "advance: 1ms") {
  return "understudy: 1\nbench: feeder.yaml\nchoice: " + choice + "\nsteps: [ " + steps + " ]\n";
}

TEST_F(SeveralPlays, AChoiceMakesACaseOfEachOption) {
  const auto scenarios =
      folder_.parse(of_choice("{ loop_count: { passes: { speed: 1 }, further_passes: { speed: 2 } } }",
                              "write: { feeder.Aaxis_Speed: \"${speed}\" }"));
  ASSERT_EQ(scenarios.size(), 2U);
  EXPECT_EQ(scenarios[0].name, "loop_count: passes");
  EXPECT_EQ(scenarios[1].name, "loop_count: further_passes");
  for (const world::DeviceSetup& device : scenarios[1].bench.devices) {
    EXPECT_EQ(device.settings.choices.at("loop_count"), "further_passes");
  }
  EXPECT_EQ(texts_of(scenarios[1].steps), Strings{"write feeder.Aaxis_Speed=2"});
}

TEST_F(SeveralPlays, ADeviceMayKeepAnOptionOfItsOwn) {
  const auto scenarios = folder_.parse(
      "understudy: 1\nbench:\n  lines: { a: { stations: [\n"
      "    { name: one, model: simple2-r3, address: 1 },\n"
      "    { name: other, model: simple2-r3, address: 2, choices: { loop_count: passes } } ] } }\n"
      "choice: { loop_count: [ passes, further_passes ] }\nsteps: [ advance: 1ms ]\n");
  ASSERT_EQ(scenarios.size(), 2U);
  EXPECT_EQ(scenarios[1].bench.devices.at(0).settings.choices.at("loop_count"), "further_passes");
  EXPECT_EQ(scenarios[1].bench.devices.at(1).settings.choices.at("loop_count"), "passes");
}

TEST_F(SeveralPlays, WhatIsWrongIsReportedWhereItStands) {
  const std::string head = "understudy: 1\nbench: feeder.yaml\n";
  const struct {
    std::string text;
    std::string diagnostic;
  } kCases[] = {
      {head + "plays: []\n", "3: plays: is empty; expected at least one play"},
      {head + "plays: [ { name: a } ]\n", "3: plays[0]: 'steps' is missing; expected it here"},
      {head + "plays: [ { steps: [ advance: 1ms ] } ]\n",
       "3: plays[0]: 'name' is missing; expected a sentence that distinguishes this play from the others"},
      {head + "plays:\n  - { name: a, steps: [ advance: 1ms ] }\n  - { name: a, steps: [ advance: 1ms ] }\n",
       "5: plays[1]: is called 'a', like another play; expected a different name"},
      {head + "plays: [ { name: a, stepz: 1 } ]\n",
       "3: plays[0].stepz: is not a key here; expected one of name, bench, nv, firmware, gap, seed, "
       "parameters, environment, cases, choice, vary, hunt, steps (the nearest is 'steps')"},
      {head + "steps: [ advance: 1ms ]\nplays: [ { name: a, steps: [ advance: 1ms ] } ]\n",
       "3: steps: cannot be combined with `plays`; expected `steps` in each play"},
      {head + "parameters: { far: 1 }\nplays: [ { name: a, steps: [ advance: 1ms ] } ]\n",
       "3: parameters.far: 'far' is not used; expected ${far} in one of the plays"},
      {head + "parameters: { far: 1 }\nplays: [ { name: a, parameters: { near: 1 }, steps: [ advance: "
              "\"${far}ms\" ] } ]\n",
       "4: plays[0].parameters.near: 'near' is not used; expected ${near} somewhere in the scenario"},
      {"understudy: 1\nplays: [ { name: a, steps: [ advance: 1ms ] } ]\n",
       "2: plays[0]: 'bench' is missing; expected it here"},
      {of_choice("{ loop_cuont: [ passes ] }"),
       "3: choice.loop_cuont[0]: no device of the bench has the choice 'loop_cuont'; the nearest is "
       "'loop_count'  (option=passes)"},
      {of_choice("{ loop_count: [ passes, furter_passes ] }"),
       "3: choice.loop_count[1]: 'furter_passes' is not an option; the nearest is 'further_passes'  "
       "(option=furter_passes)"},
      {of_choice("{ loop_count: [] }"), "3: choice.loop_count: is empty; expected the options"},
      {of_choice("{ loop_count: [ passes ], boot_time: [ 1s ] }"),
       "3: choice: names 2 choices; expected one, as in `alarm_stop: [ at_once, by_ramp ]`"},
      {of_choice("{ loop_count: [ passes ] }\ncases: [ { speed: 1 } ]"),
       "3: choice: cannot be combined with `cases`; expected one of the two"},
      {of_choice("{ loop_count: { passes: { speed: 1 }, further_passes: { sped: 1 } } }"),
       "3: choice.loop_count.further_passes.sped: is neither a parameter nor a name of the first case; the "
       "nearest "
       "is "
       "'speed'"},
  };
  for (const auto& wrong : kCases) {
    EXPECT_EQ(folder_.diagnostic(wrong.text), "scenario.yaml:" + wrong.diagnostic) << wrong.text;
  }
}

}  // namespace plays_test
}  // namespace understudy::emulator::play
