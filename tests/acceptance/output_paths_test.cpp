// A path that is given for a file to write, but is one that is read, or that something else writes: told in
// one line, and nothing is lost.
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBench =
    "understudy: 1\nlines: { a: { stations: [ { name: feeder, model: simple2-r3, program: blink.lst } ] } "
    "}\n";
constexpr const char* kScenario = "understudy: 1\nbench: bench.yaml\nsteps: [ include: rest.yaml ]\n";
constexpr const char* kRest = "understudy: 1\nsteps: [ advance: 1ms ]\n";
constexpr const char* kSaving = "understudy: 1\nbench: bench.yaml\nsteps: [ save: { feeder: kept.json } ]\n";

class OutputPaths : public testing::Test {
 protected:
  OutputPaths() {
    folder_.write("bench.yaml", kBench);
    folder_.write("blink.lst", "        Out 4 1\n        END\n");
    folder_.write("play.yaml", kScenario);
    folder_.write("rest.yaml", kRest);
    folder_.write("save.yaml", kSaving);
    fs::create_symlink("play.yaml", at("linked.yaml"));
    before_ = contents();
  }
  std::string at(const std::string& name) const { return folder_ / name; }

  /// All files with what is in them.
  std::string contents() const {
    std::string all;
    std::set<fs::path> paths;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) paths.insert(entry.path());
    for (const fs::path& path : paths) {
      std::ostringstream text;
      if (fs::is_regular_file(path)) text << std::ifstream(path).rdbuf();
      all += path.string() + ":\n" + text.str();
    }
    return all;
  }

  PrivateFolder folder_;
  std::string before_;
};

TEST_F(OutputPaths, AreRefusedWhereSomethingWouldBeLost) {
  struct Case {
    Words words;  // names of files begin with @
    std::string says;
  };
  const std::vector<Case> cases = {
      {{"run", "@play.yaml", "--junit", "@play.yaml"}, "--junit: @play.yaml: is the scenario itself"},
      {{"run", "@play.yaml", "--junit", "@linked.yaml"}, "--junit: @linked.yaml: is the scenario itself"},
      {{"run", "@play.yaml", "--report", "@bench.yaml"}, "--report: @bench.yaml: is the bench itself"},
      {{"run", "@play.yaml", "--report", "@rest.yaml"}, "--report: @rest.yaml: is a file of steps that is"},
      {{"run", "@play.yaml", "--junit", "@blink.lst"}, "--junit: @blink.lst: is the program of 'feeder'"},
      {{"run", "@play.yaml", "--junit", "@x", "--report", "@x"}, "--report: @x: is what --junit writes"},
      {{"run", "@play.yaml", "--junit", "@x.jsonl", "--record", "@."},
       "--record: @.: holds x.jsonl, which is what --junit writes; expected a folder of its own"},
      {{"run", "@save.yaml", "--junit", "@kept.json"}, "--junit: @kept.json: is what @save.yaml saves"},
      // What is left out of this run is read all the same.
      {{"run", "@play.yaml", "@save.yaml", "--filter", "play", "--junit", "@save.yaml"},
       "--junit: @save.yaml: is the scenario itself"},
      {{"run", "@save.yaml", "@save.yaml"}, "@save.yaml: save: @kept.json is what @save.yaml saves"},
      {{"serve", "@bench.yaml", "--capture", "@bench.yaml"}, "--capture: @bench.yaml: is the bench itself"},
      {{"serve", "@bench.yaml", "--record", "@blink.lst"}, "--record: @blink.lst: is the program of"},
      {{"serve", "@bench.yaml", "--trace", "@t.csv", "--capture", "@t.csv"},
       "--trace: @t.csv: is what --capture writes"},
      {{"serve", "@bench.yaml", "--record", "@r", "--capture", "@r.1"},
       "--record: @r.1: is what --capture writes"},
      {{"serve", "@bench.yaml", "--nv", "@.", "--record", "@feeder.json"},
       "--record: @feeder.json: is the memory of 'feeder'"},
      {{"exec", "@bench.yaml", "--with", "@play.yaml", "--record", "@rest.yaml", "--", "true"},
       "--record: @rest.yaml: is a file of steps that is included"},
      {{"exec", "@bench.yaml", "--with", "@save.yaml", "--capture", "@kept.json", "--", "true"},
       "--with: save: @kept.json: is what --capture writes"},
  };
  const auto with_paths = [&](std::string text) {
    for (std::size_t i = 0; (i = text.find('@', i)) != std::string::npos;) {
      text.replace(i, 1, folder_.path() + "/");
      i += folder_.path().size();
    }
    return text;
  };
  for (const Case& c : cases) {
    Words words;
    for (const std::string& word : c.words) words.push_back(with_paths(word));
    const Finished finished = understudy(words);
    EXPECT_EQ(finished.exit_code, 2) << c.says;
    EXPECT_EQ(finished.output, "") << c.says;
    EXPECT_EQ(lines_of(finished.errors).size(), 1U) << finished.errors;
    EXPECT_TRUE(finished.errors.starts_with("understudy: " + with_paths(c.says))) << finished.errors;
    EXPECT_EQ(contents(), before_) << c.says;
  }
}

TEST_F(OutputPaths, OfSnapshotsAreNoneOfTheDaemonsOwn) {
  const RunningUnderstudy daemon({"--trace", at("t.csv"), "--record", at("r.jsonl"), "--nv", at("nv")});
  for (const auto& [name, what] : {std::pair<std::string, std::string>{"t.csv", "what --trace writes"},
                                   {"r.jsonl", "what --record writes"},
                                   {"r.jsonl.1", "what --record writes"},
                                   {"nv/device.json", "the memory of 'device'"}}) {
    const Finished finished = daemon.ctl({"snapshot", at(name)});
    EXPECT_EQ(finished.exit_code, 2) << finished.output;
    EXPECT_EQ(finished.errors, "understudy: ctl snapshot: " + at(name) + ": file: is " + what +
                                   "; expected a path of its own\n");
  }
  // Over an older snapshot is well.
  for (int time = 0; time < 2; ++time) EXPECT_EQ(daemon.ctl({"snapshot", at("now")}).exit_code, 0);
}

/// The folder that a `run` has locked; empty before it has.
std::string spool_of(const Process& process) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator("/proc/" + std::to_string(process.pid()) + "/fd", error)) {
    const std::string path = fs::read_symlink(entry.path(), error).string();
    if (path.ends_with("/spool")) return path;
  }
  return "";
}

TEST(RunSpool, OfAKilledRunIsRemovedByTheNext) {
  const PrivateFolder folder;
  folder.write("bench.yaml",
               "understudy: 1\nlines: { a: { stations: [ { name: feeder, model: simple2-r3 } ] } }\n");
  const std::string slow =
      folder.write("slow.yaml", "understudy: 1\nbench: bench.yaml\nsteps: [ advance: 60s ]\n");
  const std::string fast =
      folder.write("fast.yaml", "understudy: 1\nbench: bench.yaml\nsteps: [ advance: 1ms ]\n");
  Process living({UNDERSTUDY_BINARY, "run", slow, "--real-time"});
  Process killed({UNDERSTUDY_BINARY, "run", slow, "--real-time"});
  ASSERT_TRUE(eventually([&] { return !spool_of(living).empty() && !spool_of(killed).empty(); }));
  const std::string of_living = spool_of(living);
  const std::string of_killed = spool_of(killed);
  killed.send(SIGKILL);
  EXPECT_EQ(killed.wait(kPatience), 128 + SIGKILL);
  EXPECT_EQ(understudy({"run", fast}).exit_code, 0);
  EXPECT_TRUE(fs::exists(of_living));
  EXPECT_FALSE(fs::exists(fs::path(of_killed).parent_path()));
  living.send(SIGKILL);
  EXPECT_EQ(living.wait(kPatience), 128 + SIGKILL);
  EXPECT_EQ(understudy({"run", fast}).exit_code, 0);
  EXPECT_FALSE(fs::exists(fs::path(of_living).parent_path()));
}

}  // namespace
}  // namespace understudy::acceptance
