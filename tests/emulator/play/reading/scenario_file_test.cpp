// Scenario files as a whole: benches, cases, parameters, loops and includes.
#include <gtest/gtest.h>

#include "tests/emulator/play/performing/scenario_folder.h"

namespace understudy::emulator::play {
namespace scenario_file_test {

using namespace std::chrono_literals;
using Strings = std::vector<std::string>;

class ScenarioFile : public testing::Test {
 protected:
  Strings texts(const std::string& steps) const { return texts_of(folder_.steps(steps)); }
  Strings names(const std::string& text) const {
    Strings names;
    for (const Scenario& scenario : folder_.parse(text)) names.push_back(scenario.name);
    return names;
  }

  ScenarioFolder folder_;
};

TEST_F(ScenarioFile, SaysWhatItIsPlayedOn) {
  const auto scenarios = folder_.parse(
      "understudy: 1\nname: two of them\nbench: feeder.yaml\ngap: 1500us\nseed: 18\nsteps: [ advance: 1ms "
      "]\n");
  ASSERT_EQ(scenarios.size(), 1U);
  const Scenario& scenario = scenarios.front();
  EXPECT_EQ(scenario.name, "two of them");
  EXPECT_EQ(scenario.file, folder_.path("scenario.yaml"));
  EXPECT_EQ(scenario.bench.devices.size(), 2U);
  EXPECT_EQ(scenario.bench.machines.size(), 2U);
  EXPECT_EQ(scenario.gap, 1500us);
  EXPECT_EQ(scenario.seed, 18U);
}

TEST_F(ScenarioFile, IsCalledByItsFileWithoutAName) {
  EXPECT_EQ(names("understudy: 1\nbench: feeder.yaml\nsteps: [ advance: 1ms ]\n"), Strings{"scenario"});
}

TEST_F(ScenarioFile, TheBenchMayStandInIt) {
  const auto scenarios = folder_.parse(
      "understudy: 1\n"
      "parameters: { version: 1.40 }\n"
      "bench:\n"
      "  lines: { a: { stations: [ { name: lone, model: simple2-r3, firmware: \"${version}\" } ] } }\n"
      "steps: [ expect: { Cord_A: 0, 0x1014: 0, lone.STATUS.4: 0 } ]\n");
  EXPECT_EQ(scenarios.at(0).bench.devices.at(0).settings.firmware, 140);
  // If there is only one device, its name can be omitted.
  EXPECT_EQ(texts_of(scenarios.at(0).steps), Strings{"expect Cord_A: 0, 0x1014: 0, lone.STATUS.4: 0"});
}

TEST_F(ScenarioFile, FirmwareAndMemoryMayDifferFromTheBench) {
  const std::string head = "understudy: 1\nbench: feeder.yaml\nsteps: [ advance: 1ms ]\n";
  const auto all = folder_.parse(head + "firmware: 1.40\n").at(0).bench.devices;
  EXPECT_EQ(all.at(0).settings.firmware, 140);
  EXPECT_EQ(all.at(1).settings.firmware, 140);
  const auto one = folder_.parse(head + "firmware: { turner: 1.39 }\n").at(0).bench.devices;
  EXPECT_EQ(one.at(0).settings.firmware, 0);  // the newest
  EXPECT_EQ(one.at(1).settings.firmware, 139);
  const auto kept = folder_.parse(head + "nv: { turner: after.json }\n").at(0).bench.devices;
  EXPECT_FALSE(kept.at(0).settings.nv);
  ASSERT_TRUE(kept.at(1).settings.nv);
  EXPECT_EQ(kept.at(1).settings.nv->registers.at(0).second, 7);
  EXPECT_EQ(kept.at(1).nv_path, "");  // running does not change the file
}

TEST_F(ScenarioFile, EachCaseIsAScenario) {
  const auto scenarios = folder_.parse(
      "understudy: 1\nname: a move\nbench: feeder.yaml\n"
      "parameters: { speed: 200, ramp: 5 }\n"
      "cases:\n  - { speed: 100, takes: 6000ms }\n  - { takes: 250ms }\n"
      "steps:\n"
      "  - write: { feeder.Aaxis_Speed: \"${speed}\", feeder.Aaxis_AccTime: \"${ramp}\" }\n"
      "  - advance: ${takes}\n");
  ASSERT_EQ(scenarios.size(), 2U);
  EXPECT_EQ(scenarios[0].name, "a move (speed=100, takes=6000ms)");
  EXPECT_EQ(texts_of(scenarios[0].steps),
            (Strings{"write feeder.Aaxis_Speed=100, feeder.Aaxis_AccTime=5", "advance 6s"}));
  EXPECT_EQ(scenarios[1].name, "a move (takes=250ms)");
  EXPECT_EQ(texts_of(scenarios[1].steps),
            (Strings{"write feeder.Aaxis_Speed=200, feeder.Aaxis_AccTime=5", "advance 250ms"}));
}

TEST_F(ScenarioFile, CasesMayNameThemselves) {
  EXPECT_EQ(names("understudy: 1\nname: going ${way}\nbench: feeder.yaml\n"
                  "cases: [ { way: up }, { way: down } ]\nsteps: [ say: \"${way}\" ]\n"),
            (Strings{"going up", "going down"}));
}

TEST_F(ScenarioFile, DefaultsMayUseWhatIsDefinedBefore) {
  const auto scenarios = folder_.parse(
      "understudy: 1\nbench: feeder.yaml\nparameters: { a: 3, b: \"${a * 2}\", c: \"${b + 1}\" }\n"
      "cases: [ { a: 3 }, { a: 10 }, { b: 4, a: 1 } ]\nsteps: [ say: \"${a} ${b} ${c}\" ]\n");
  EXPECT_EQ(scenarios.at(0).steps.at(0).text, "say 3 6 7");
  EXPECT_EQ(scenarios.at(1).steps.at(0).text, "say 10 20 21");
  EXPECT_EQ(scenarios.at(2).steps.at(0).text, "say 1 4 5");
}

TEST_F(ScenarioFile, LoopsAreUnrolled) {
  EXPECT_EQ(texts("  - repeat:\n      times: 3\n      as: i\n      steps:\n"
                  "        - write: { \"feeder.MAIN_LINE${i - 1}_CMD\": \"${i * 10}\" }\n"),
            (Strings{"write feeder.MAIN_LINE0_CMD=10", "write feeder.MAIN_LINE1_CMD=20",
                     "write feeder.MAIN_LINE2_CMD=30"}));
  EXPECT_EQ(texts("  - repeat: { times: 2, steps: [ advance: 1ms, say: x ] }\n"),
            (Strings{"advance 1ms", "say x", "advance 1ms", "say x"}));
  EXPECT_EQ(
      texts("  - for: { each: [ A, B ], as: axis, steps: [ expect: { \"feeder.Cord_${axis}\": 0 } ] }\n"),
      (Strings{"expect feeder.Cord_A: 0", "expect feeder.Cord_B: 0"}));
  EXPECT_EQ(texts("  - for:\n      each: [ { n: 1, t: 5ms }, { n: 2, t: 9ms } ]\n"
                  "      steps: [ say: \"${n}\", advance: \"${t * n}\" ]\n"),
            (Strings{"say 1", "advance 5ms", "say 2", "advance 18ms"}));
  EXPECT_EQ(texts("  - for:\n      each: [ 2, 3 ]\n      as: n\n      steps:\n"
                  "        - repeat: { times: \"${n}\", as: i, steps: [ say: \"${n}/${i}\" ] }\n"),
            (Strings{"say 2/1", "say 2/2", "say 3/1", "say 3/2", "say 3/3"}));
}

TEST_F(ScenarioFile, IncludedStepsSeeTheParametersOfTheirPlace) {
  folder_.write(
      "parts/move.yaml",
      "understudy: 1\nsteps:\n  - write: { feeder.Aaxis_Pulse: \"${far}\" }\n  - include: rest.yaml\n");
  folder_.write("parts/rest.yaml", "understudy: 1\nsteps:\n  - say: ${far + 1}\n");
  EXPECT_EQ(texts("  - for: { each: [ 5, 7 ], as: far, steps: [ include: parts/move.yaml ] }\n"),
            (Strings{"write feeder.Aaxis_Pulse=5", "say 6", "write feeder.Aaxis_Pulse=7", "say 8"}));
}

TEST_F(ScenarioFile, PathsAreRelativeToTheFileThatNamesThem) {
  folder_.write("parts/load.yaml", "understudy: 1\nsteps:\n  - program: { feeder: its.lst }\n");
  const std::string listing = folder_.write("parts/its.lst", "END\n");
  const Steps steps = folder_.steps("  - include: parts/load.yaml\n");
  EXPECT_EQ(std::get<ProgramStep>(steps.at(0).what).file, listing);
}

TEST_F(ScenarioFile, ReferencesOfYamlAreSteps) {
  EXPECT_EQ(texts("  - &pause { advance: 2ms }\n  - say: x\n  - *pause\n"),
            (Strings{"advance 2ms", "say x", "advance 2ms"}));
}

TEST_F(ScenarioFile, AHundredThousandStepsAreEnough) {
  // 1000 * 100, and not one more.
  const std::string loop =
      "  - repeat: { times: 1000, steps: [ repeat: { times: 100, steps: [ say: x ] } ] }\n";
  EXPECT_EQ(folder_.steps(loop).size(), 100'000U);
  EXPECT_EQ(folder_.diagnostic(ScenarioFolder::scenario_of(loop + "  - say: y\n")),
            "scenario.yaml:5: steps[1]: is one step too many; expected at most 100000 including all loops "
            "and cases");
}

TEST_F(ScenarioFile, StepsMayNotGrowBeyondAllBounds) {
  // A few short lines, but 64 MiB of text after some 6,700 steps, because each is part of its step's text.
  const std::string scenario =
      "understudy: 1\nbench: feeder.yaml\nparameters:\n  a: " + std::string(100, 'x') +
      "\n  b: ${a}${a}${a}${a}${a}${a}${a}${a}${a}${a}\n  c: ${b}${b}${b}${b}${b}\nsteps:\n";
  const std::string beyond =
      "scenario.yaml:8: steps[0].repeat.steps[0]: is too large: the steps exceed 64 MiB; expected "
      "less, including all loops and cases";
  EXPECT_EQ(folder_.diagnostic(scenario + "  - repeat: { times: 6000, steps: [ { say: '${c}' } ] }\n"), "");
  EXPECT_EQ(folder_.diagnostic(scenario + "  - repeat: { times: 99999, steps: [ { say: '${c}' } ] }\n"),
            beyond);
  // A program is counted with all its comments, wherever they come from.
  folder_.write("long.lst", std::string(1 << 20, ';') + "\n        END\n");
  EXPECT_EQ(folder_.diagnostic(ScenarioFolder::scenario_of(
                "  - repeat: { times: 99999, steps: [ program: { feeder: long.lst } ] }\n")),
            "scenario.yaml:4: steps[0].repeat.steps[0]: is too large: the steps exceed 64 MiB; "
            "expected less, including all loops and cases");
}

TEST_F(ScenarioFile, KindsAreRecognizedByTheirKeys) {
  const auto kind = [&](const std::string& text) { return kind_of_file(folder_.write("some.yaml", text)); };
  EXPECT_EQ(kind(kTwoStations), FileKind::bench);
  EXPECT_EQ(kind("understudy: 1\nbench: x\nsteps: []\n"), FileKind::scenario);
  EXPECT_EQ(kind("understudy: 1\nname: x\nsteps: []\n"), FileKind::scenario);
  EXPECT_EQ(kind("understudy: 1\nbench: x\n"), FileKind::scenario);
  EXPECT_EQ(kind("understudy: 1\nsteps: []\n"), FileKind::steps);
  EXPECT_EQ(kind("understudy: 1\n"), FileKind::bench);
  EXPECT_EQ(kind("understudy: 1\nregisters: l.csv\n"), FileKind::model);
  EXPECT_EQ(kind("understudy: 1\nmodel: x\naxes: {}\n"), FileKind::model) << "its list was forgotten";
  EXPECT_EQ(kind("understudy: 1\nmodel: x\nlines: {}\n"), FileKind::bench);
}

}  // namespace scenario_file_test
}  // namespace understudy::emulator::play
