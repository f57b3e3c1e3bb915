// A scenario does not save over the files that it reads, and no two cases save the same file. Such files are
// refused when they are read, before anything runs.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "emulator/models/models.h"
#include "emulator/play/performing/run.h"
#include "tests/emulator/play/performing/scenario_folder.h"

namespace understudy::emulator::play {
namespace scenario_outputs_test {

class ScenarioOutputs : public testing::Test {
 protected:
  ScenarioOutputs() {
    folder_.write("programmed.yaml",
                  "understudy: 1\nlines: { a: { stations: [ { name: feeder, model: simple2-r3,\n"
                  "  program: indexing.lst, nv: kept.json } ] } }\n");
    folder_.write("loading.yaml", "understudy: 1\nsteps:\n  - program: { feeder: indexing.lst }\n");
  }
  ScenarioFolder folder_;
};

TEST_F(ScenarioOutputs, AreNothingThatIsRead) {
  struct Case {
    std::string bench;
    std::string steps;
    std::string diagnostic;  // after the file's name
  };
  const std::string own = "; expected another path";
  const std::vector<Case> cases = {
      {"feeder.yaml", "  - save: { feeder: scenario.yaml }\n",
       "4: steps[0].save.feeder: scenario.yaml is the scenario itself" + own},
      {"feeder.yaml", "  - save: { feeder: ./feeder.yaml }\n",
       "4: steps[0].save.feeder: feeder.yaml is the bench itself" + own},
      {"programmed.yaml", "  - save: { feeder: indexing.lst }\n",
       "4: steps[0].save.feeder: indexing.lst is the program of 'feeder'" + own},
      // It does not exist yet, but the next run would read it.
      {"programmed.yaml", "  - save: { feeder: kept.json }\n",
       "4: steps[0].save.feeder: kept.json is the initial memory of 'feeder'" + own},
      {"feeder.yaml\nnv: { turner: after.json }", "  - save: { feeder: after.json }\n",
       "5: steps[0].save.feeder: after.json is the initial memory of 'turner'" + own},
      {"feeder.yaml", "  - program: { feeder: indexing.lst }\n  - save: { feeder: indexing.lst }\n",
       "5: steps[1].save.feeder: indexing.lst is a program that a step loads" + own},
      {"feeder.yaml", "  - memory: { feeder: after.json }\n  - save: { feeder: after.json }\n",
       "5: steps[1].save.feeder: after.json is a memory that a step compares with" + own},
      // A file that is read may also appear later.
      {"feeder.yaml", "  - save: { feeder: homing.yaml }\n  - include: homing.yaml\n",
       "4: steps[0].save.feeder: homing.yaml is a file of steps that is included" + own},
      {"feeder.yaml", "  - save: { feeder: indexing.lst }\n  - include: loading.yaml\n",
       "4: steps[0].save.feeder: indexing.lst is a program that a step loads" + own},
      {"feeder.yaml", "  - fork: { a: [ save: { feeder: feeder.yaml } ] }\n",
       "4: steps[0].fork.a[0].save.feeder: feeder.yaml is the bench itself" + own},
  };
  for (const Case& c : cases) {
    EXPECT_EQ(folder_.diagnostic("understudy: 1\nbench: " + c.bench + "\nsteps:\n" + c.steps),
              "scenario.yaml:" + c.diagnostic)
        << c.steps;
  }
}

TEST_F(ScenarioOutputs, MayBeWrittenAndReadAgainByTheSameCase) {
  EXPECT_EQ(folder_.diagnostic(ScenarioFolder::scenario_of("  - save: { feeder: new.json }\n"
                                                           "  - memory: { feeder: new.json }\n"
                                                           "  - save: { turner: new.json }\n")),
            "");
}

TEST_F(ScenarioOutputs, StayBelowTheScenariosFolder) {
  const auto diagnostic_of = [&](const std::string& file) {
    return folder_.diagnostic(ScenarioFolder::scenario_of("  - save: { feeder: '" + file + "' }\n"));
  };
  namespace fs = std::filesystem;
  const std::string own = fs::path(folder_.path("x")).parent_path().string();
  fs::create_directory(folder_.path("inner"));
  fs::create_directory_symlink("/tmp", folder_.path("elsewhere"));
  fs::create_symlink("/tmp/understudy-no-such-file", folder_.path("leads out.json"));
  fs::create_symlink("inner/new.json", folder_.path("leads in.json"));
  EXPECT_EQ(diagnostic_of("inner/new.json"), "");
  EXPECT_EQ(diagnostic_of("inner/../new.json"), "");
  EXPECT_EQ(diagnostic_of("leads in.json"), "");
  EXPECT_EQ(diagnostic_of("/tmp/new.json"),
            "scenario.yaml:4: steps[0].save.feeder: /tmp/new.json is outside " + own +
                "; expected a path in it (`--save-below FOLDER` allows another folder)");
  fs::create_directory(own + "-2");
  for (const std::string& path : {std::string("../new.json"), std::string("elsewhere/new.json"),
                                  std::string("leads out.json"), own + "-2/new.json"}) {
    EXPECT_NE(diagnostic_of(path).find(" is outside "), std::string::npos) << path;
  }
  fs::remove(own + "-2");
  const std::string scenario = ScenarioFolder::scenario_of("  - save: { feeder: /tmp/new.json }\n");
  EXPECT_EQ(parse_scenarios(models::all_models(), scenario, folder_.path("scenario.yaml"), "/tmp/").size(),
            1U);
  EXPECT_EQ(parse_scenarios(models::all_models(), scenario, folder_.path("scenario.yaml"), "/").size(), 1U);
  EXPECT_THROW(parse_scenarios(models::all_models(), scenario, folder_.path("scenario.yaml"), "/tmp/inner"),
               FileError);
}

TEST_F(ScenarioOutputs, ReplaceNothingButImages) {
  const std::string steps = "  - save: { feeder: there }\n";
  const std::string where = "scenario.yaml:4: steps[0].save.feeder: there cannot be written: ";
  folder_.write("there", "alias ls=ls\n");
  EXPECT_EQ(folder_.diagnostic(ScenarioFolder::scenario_of(steps)),
            where + "it is not an NV image; expected one to replace, or a free path");
  std::filesystem::remove(folder_.path("there"));
  ASSERT_EQ(::mkfifo(folder_.path("there").c_str(), 0600), 0);
  EXPECT_EQ(folder_.diagnostic(ScenarioFolder::scenario_of(steps)),
            where + "it is a pipe; expected a regular file, or a free path");
  // A file that has appeared there since it was read.
  std::filesystem::remove(folder_.path("there"));
  const auto scenario = folder_.parse(ScenarioFolder::scenario_of(steps));
  folder_.write("there", "precious");
  const auto results = run_scenario(scenario.front());
  ASSERT_TRUE(results.front().failure);
  EXPECT_NE(results.front().failure->what.find("it is not an NV image"), std::string::npos)
      << results.front().failure->what;
}

TEST_F(ScenarioOutputs, OfTwoCasesAreTwoFiles) {
  const auto diagnostic_of = [&](const std::string& file) {
    return folder_.diagnostic(
        "understudy: 1\nbench: feeder.yaml\ncases: [ { speed: 1 }, { speed: 2 } ]\nsteps:\n"
        "  - say: ${speed}\n  - save: { feeder: '" +
        file + "' }\n");
  };
  EXPECT_EQ(diagnostic_of("after-${speed}.json"), "");
  EXPECT_EQ(diagnostic_of("new.json"),
            "scenario.yaml:6: steps[1].save.feeder: new.json is what another case saves; expected another "
            "path  (speed=2)");
}

TEST_F(ScenarioOutputs, AreKnownBeforeTheRun) {
  const auto scenario = folder_.parse(ScenarioFolder::scenario_of(
      "  - save: { feeder: one.json }\n  - fork: { a: [ save: { feeder: two.json } ] }\n"));
  EXPECT_EQ(scenario.front().saved,
            (std::vector<std::string>{folder_.path("one.json"), folder_.path("two.json")}));
  ASSERT_EQ(scenario.front().files.size(), 2U);
  EXPECT_EQ(scenario.front().files[0].path, folder_.path("scenario.yaml"));
  EXPECT_EQ(scenario.front().files[1].path, folder_.path("feeder.yaml"));
}

TEST_F(ScenarioOutputs, ABenchIsNoScenarioAndAScenarioNoBench) {
  EXPECT_EQ(folder_.diagnostic(kTwoStations),
            "scenario.yaml:1: scenario: is a bench; expected a scenario (`understudy serve` serves benches)");
  folder_.write("play.yaml", ScenarioFolder::scenario_of("  - advance: 1ms\n"));
  EXPECT_EQ(folder_.diagnostic("understudy: 1\nbench: play.yaml\nsteps: [ advance: 1ms ]\n"),
            "scenario.yaml:2: bench: play.yaml is a scenario; expected a bench");
}

TEST_F(ScenarioOutputs, AReferenceToAnotherKindOfFileSaysWhichItIs) {
  folder_.write("play.yaml", ScenarioFolder::scenario_of("  - advance: 1ms\n"));
  folder_.write("bench.yaml", kTwoStations);
  folder_.write("model.yaml", "understudy: 1\nmodel: m\nregisters: feeder.yaml\n");
  const auto reported = [&](const std::string& bench, const std::string& step) {
    return folder_.diagnostic("understudy: 1\nbench: " + bench + "\nsteps: [ " + step + " ]\n");
  };
  EXPECT_EQ(reported("model.yaml", "advance: 1ms"),
            "scenario.yaml:2: bench: model.yaml is a model file; expected a bench");
  EXPECT_EQ(reported("feeder.yaml", "include: bench.yaml"),
            "scenario.yaml:3: steps[0].include: bench.yaml is a bench; expected a file of steps");
  EXPECT_EQ(reported("feeder.yaml", "include: play.yaml"),
            "scenario.yaml:3: steps[0].include: play.yaml is a scenario; expected a file of steps");
  EXPECT_EQ(reported("feeder.yaml", "include: model.yaml"),
            "scenario.yaml:3: steps[0].include: model.yaml is a model file; expected a file of steps");
}

}  // namespace scenario_outputs_test
}  // namespace understudy::emulator::play
