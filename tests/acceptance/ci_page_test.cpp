// The recipes of docs/ci.md work as printed, in a project such as the page assumes.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>
#include <utility>

#include "tests/acceptance/page_blocks.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace ci_page_test {

namespace fs = std::filesystem;

std::vector<std::string> blocks(const std::string& language) { return page_blocks("ci.md", language); }

/// The project that the page assumes; each scenario expects a value of a register.
class Project {
 public:
  explicit Project(int expected) {
    fs::create_directory(folder_ / "tests");
    folder_.write("tests/bench.yaml",
                  "understudy: 1\nlines:\n  rs485: { link: ./slide.port, stations: [ { name: feeder, model: "
                  "simple2-r3, address: 1 } ] }\n");
    for (const char* name : {"a", "b", "c", "d"}) {
      folder_.write("tests/" + std::string(name) + ".yaml",
                    "understudy: 1\nbench: bench.yaml\nsteps:\n  - expect: { feeder.Aaxis_Speed: " +
                        std::to_string(expected) + " }\n");
    }
    fs::create_directory(folder_ / "hosts");
    folder_.write("hosts/bad_line.yaml",
                  "understudy: 1\nbench: ../tests/bench.yaml\n"
                  "vary: { pulses: [ 3200, 6400 ], nth: { from: 1, to: 4, step: 1 } }\n"
                  "steps:\n  - inject: { drop: feeder, nth: \"${nth}\" }\n  - host: { within: 60s }\n");
    fs::permissions(folder_.write("my_host", "#!/bin/sh\ntest -c \"$UNDERSTUDY_PORT\"\n"),
                    fs::perms::owner_exec, fs::perm_options::add);
  }

  Finished sh(const std::string& script) const {
    const char* const path = std::getenv("PATH");
    const std::string programs = fs::path(UNDERSTUDY_BINARY).parent_path().string();
    const Environment environment = {{"PATH", programs + ":" + (path == nullptr ? "/usr/bin:/bin" : path)},
                                     {"CI_NODE_INDEX", "2"},
                                     {"CI_NODE_TOTAL", "4"}};
    return run({"sh", "-c", "cd " + folder_.path() + "\n" + script}, environment);
  }
  bool has(const std::string& file) const { return fs::exists(folder_ / file); }

 private:
  PrivateFolder folder_;
};

TEST(CiPage, ThePlainShellRecipeRunsAsItStands) {
  const auto scripts = blocks("sh");
  ASSERT_GE(scripts.size(), 1U);
  ASSERT_NE(scripts[0].find("understudy exec "), std::string::npos);
  const Project good(0);
  const Finished passed = good.sh(scripts[0]);
  EXPECT_EQ(passed.exit_code, 0) << passed.output << passed.errors;
  EXPECT_NE(passed.output.find("4 passed, 0 failed"), std::string::npos) << passed.output;
  for (const char* file : {"results.xml", "report.html", "recordings/a.jsonl", "recordings/host.jsonl"}) {
    EXPECT_TRUE(good.has(file)) << file;
  }
  const Project bad(1);
  const Finished failed = bad.sh(scripts[0]);
  EXPECT_EQ(failed.exit_code, 1) << failed.output << failed.errors;
  EXPECT_TRUE(bad.has("report.html"));
  EXPECT_FALSE(bad.has("recordings/host.jsonl")) << "the script ends at the first failure";
}

TEST(CiPage, TheGithubRecipeRunsInItsContainer) {
  const YAML::Node job = YAML::Load(blocks("yaml").at(0))["jobs"]["scenarios"];
  EXPECT_EQ(job["container"].as<std::string>(), "debian:12");
  EXPECT_EQ(job["strategy"]["matrix"]["shard"].size(), 4U);
  for (const int expected : {0, 1}) {
    const Project project(expected);
    bool has_failed = false;
    int commands = 0;
    for (const YAML::Node& step : job["steps"]) {
      if (!step["run"]) continue;
      auto script = step["run"].as<std::string>();
      if (script.find("apt-get") != std::string::npos) {
        EXPECT_EQ(script.find("sudo"), std::string::npos) << "a container of Debian has none";
        continue;
      }
      const bool is_for_failures = step["if"] && step["if"].as<std::string>() == "failure()";
      if (is_for_failures != has_failed) continue;
      script = std::regex_replace(script, std::regex("\\$\\{\\{ matrix\\.shard \\}\\}"), "3");
      EXPECT_EQ(script.find("${{"), std::string::npos) << script;
      const Finished finished = project.sh("set -e\n" + script);
      ++commands;
      EXPECT_EQ(finished.exit_code, !is_for_failures && expected != 0 ? 1 : 0)
          << script << finished.output << finished.errors;
      if (is_for_failures) {
        EXPECT_NE(finished.output.find("the same"), std::string::npos) << finished.output;
      }
      has_failed = has_failed || finished.exit_code != 0;
    }
    EXPECT_EQ(commands, expected == 0 ? 3 : 2);
  }
}

TEST(CiPage, TheGitlabRecipeRunsInItsImage) {
  const YAML::Node job = YAML::Load(blocks("yaml").at(1))["machine"];
  EXPECT_EQ(job["image"].as<std::string>(), "debian:12");
  const Project project(0);
  ASSERT_EQ(job["script"].size(), 2U);
  for (const auto& [script, passed] :
       {std::pair(0, "1 passed, 0 failed"), std::pair(1, "2 passed, 0 failed")}) {
    const Finished finished = project.sh("set -e\n" + job["script"][script].as<std::string>());
    EXPECT_EQ(finished.exit_code, 0) << finished.errors;
    EXPECT_NE(finished.output.find(passed), std::string::npos) << finished.output;
  }
  for (const YAML::Node& path : job["artifacts"]["paths"]) EXPECT_TRUE(project.has(path.as<std::string>()));
  for (const YAML::Node& path : job["artifacts"]["reports"]["junit"])
    EXPECT_TRUE(project.has(path.as<std::string>()));
}

}  // namespace ci_page_test
}  // namespace understudy::acceptance
