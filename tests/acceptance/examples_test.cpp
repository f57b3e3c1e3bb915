// The projects in examples/, run as their pages say, with the tools that they are for.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace examples_test {

namespace fs = std::filesystem;

constexpr Wait kBuilding{180'000};  // for a small program on a busy machine

/// Runs in the example's folder, with this understudy in PATH.
Finished in_example(const std::string& name, const std::string& command, Wait patience = kPatience) {
  const std::string folder = std::string(PROJECT_FOLDER) + "/examples/" + name;
  const char* const path = std::getenv("PATH");
  const std::string programs = fs::path(UNDERSTUDY_BINARY).parent_path().string();
  const Environment environment = {{"PATH", programs + ":" + (path == nullptr ? "/usr/bin:/bin" : path)},
                                   {"UNDERSTUDY", UNDERSTUDY_BINARY}};
  Process process({"sh", "-c", "cd " + folder + " && " + command}, environment);
  const int exit_code = process.wait(patience).value_or(-1);
  return {exit_code, process.output(), process.errors()};
}

/// The command after "$ ", or without it, must be on the example's page; otherwise the page is wrong.
void expect_on_page(const std::string& name, const std::string& command) {
  std::ifstream file(std::string(PROJECT_FOLDER) + "/examples/" + name + "/README.md");
  std::ostringstream page;
  page << file.rdbuf();
  EXPECT_NE(page.str().find("\n" + command + "\n"), std::string::npos) << command;
}

TEST(Examples, AShellScriptWithMbpoll) {
  if (run({"mbpoll", "-V"}).exit_code == 127) GTEST_SKIP() << "mbpoll is not installed";
  const std::string well = "understudy exec ../../scenarios/benches/slide.yaml -- ./feed.sh";
  expect_on_page("mbpoll", well);
  const Finished fed = in_example("mbpoll", well);
  EXPECT_EQ(fed.exit_code, 0) << fed.errors;
  EXPECT_EQ(fed.output, "feed.sh: axis A is at 3200\n");

  const std::string ill =
      "understudy exec ../../scenarios/benches/slide.yaml --with limit_stuck.yaml -- ./feed.sh";
  expect_on_page("mbpoll", ill);
  const Finished stuck = in_example("mbpoll", ill);
  EXPECT_EQ(stuck.exit_code, 1);
  EXPECT_NE(stuck.errors.find("feed.sh: axis A is at 0; expected 3200\n"), std::string::npos) << stuck.errors;
  const std::string word = "to run this again: understudy replay ";
  const std::size_t at = stuck.errors.find(word);
  ASSERT_NE(at, std::string::npos) << stuck.errors;
  const std::string recording = lines_of(stuck.errors.substr(at + word.size())).at(0);
  EXPECT_EQ(understudy({"replay", recording}).exit_code, 0);
  fs::remove_all(fs::path(recording).parent_path());
}

TEST(Examples, APythonScriptWithPymodbus) {
  const fs::path packages = "/usr/lib/python3/dist-packages";  // Debian's
  for (const char* const module : {"pymodbus", "serial"}) {
    if (!fs::exists(packages / module)) GTEST_SKIP() << "python3-" << module << " is not installed";
  }
  const std::string command = "understudy exec ../../scenarios/benches/slide.yaml --tty-shim -- ./feed.py";
  expect_on_page("pymodbus", command);
  const Finished fed = in_example("pymodbus", command);
  EXPECT_EQ(fed.exit_code, 0) << fed.errors;
  EXPECT_EQ(fed.output, "feed.py: axis A is at 3200\nfeed.py: axis A is at 0\n");
}

/// Builds a CMake project in its own folder, and runs its tests.
void expect_project_passes(const std::string& name, int tests) {
  const PrivateFolder folder;
  const std::string ctest = (fs::path(CMAKE_PROGRAM).parent_path() / "ctest").string();
  const Finished built = in_example(name,
                                    std::string(CMAKE_PROGRAM) + " -S . -B " + folder.path() + " && " +
                                        CMAKE_PROGRAM + " --build " + folder.path(),
                                    kBuilding);
  ASSERT_EQ(built.exit_code, 0) << built.output << built.errors;
  const Finished tested =
      in_example(name, ctest + " --test-dir " + folder.path() + " -j 4 --output-on-failure", kBuilding);
  EXPECT_EQ(tested.exit_code, 0) << tested.output << tested.errors;
  EXPECT_NE(tested.output.find("100% tests passed, 0 tests failed out of " + std::to_string(tests)),
            std::string::npos)
      << tested.output;
}

TEST(Examples, ACTestTest) { expect_project_passes("ctest", 3); }

TEST(Examples, AGoogleTestFixture) { expect_project_passes("googletest", 4); }

}  // namespace examples_test
}  // namespace understudy::acceptance
