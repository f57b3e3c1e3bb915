// A path for an output file that is also read, or that something else writes: the error is one line, and
// nothing is lost.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <tuple>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace output_paths_test {

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
    folder_.write("table.csv", "time,A.pulses\n");
    fs::create_symlink("table.csv", at("table.png"));
    before_ = contents();
  }
  std::string at(const std::string& name) const { return folder_ / name; }

  /// Returns all files with their contents.
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
       "--record: @.: holds x.jsonl, which is what --junit writes; expected another folder"},
      {{"run", "@save.yaml", "--junit", "@kept.json"}, "--junit: @kept.json: is what @save.yaml saves"},
      // Files that this run leaves out are still read.
      {{"run", "@play.yaml", "@save.yaml", "--filter", "play", "--junit", "@save.yaml"},
       "--junit: @save.yaml: is the scenario itself"},
      {{"run", "@save.yaml", "@save.yaml"}, "@save.yaml: save: @kept.json is what @save.yaml saves"},
      {{"serve", "@bench.yaml", "--capture", "@bench.yaml"}, "--capture: @bench.yaml: is the bench itself"},
      {{"serve", "--model", "simple2-r3", "--link", "@p.port", "--capture", "@p.port"},
       "--capture: @p.port: is the link of line 'line'"},
      {{"serve", "@bench.yaml", "--control", "@c", "--record", "@c"}, "--record: @c: is the control socket"},
      {{"plot", "@table.csv", "--output", "@table.png"}, "--output: @table.png: is the trace itself"},
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
    EXPECT_EQ(finished.errors,
              "understudy: ctl snapshot: " + at(name) + ": file: is " + what + "; expected another path\n");
  }
  // Overwriting an older snapshot is allowed.
  for (int time = 0; time < 2; ++time) EXPECT_EQ(daemon.ctl({"snapshot", at("now")}).exit_code, 0);
}

TEST_F(OutputPaths, OfSnapshotsAreNotTheDaemonsLinkPortOrSocket) {
  const RunningUnderstudy daemon;
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  fs::create_symlink("pipe", at("to it"));
  for (const auto& [path, why] :
       {std::pair<std::string, std::string>{daemon.port(), "is the link of line 'line'"},
        {daemon.ports()[0].pty, "is the port of line 'line'"},
        {daemon.control(), "is the control socket"},
        {at("pipe"), "cannot be written (it is a pipe"},
        {at("to it"), "cannot be written (it is a pipe"}}) {
    const Finished finished = daemon.ctl({"snapshot", path});
    EXPECT_EQ(finished.exit_code, 2) << path;
    EXPECT_TRUE(finished.errors.starts_with("understudy: ctl snapshot: " + path + ": file: " + why))
        << finished.errors;
  }
  EXPECT_TRUE(fs::is_symlink(daemon.port()));
  EXPECT_TRUE(fs::is_socket(daemon.control()));
  EXPECT_TRUE(fs::is_fifo(at("pipe")));
  EXPECT_EQ(daemon.ctl({"status"}).exit_code, 0);
}

TEST_F(OutputPaths, OfARunsFilesAreNothingThatALinkThereLeadsTo) {
  fs::create_directory(at("kept"));
  for (const char* const ending : {".csv", ".pcapng", ".jsonl"}) {
    fs::create_symlink("../bench.yaml", at("kept") + "/play" + ending);
  }
  const std::string before = contents();
  for (const char* const flag : {"--trace", "--capture", "--record"}) {
    const Finished finished = understudy({"run", at("play.yaml"), flag, at("kept")});
    EXPECT_EQ(finished.exit_code, 3) << flag;
    EXPECT_NE(finished.errors.find(std::string(flag) + ": " + at("kept") + "/play."), std::string::npos)
        << finished.errors;
    EXPECT_NE(finished.errors.find("expected another path"), std::string::npos) << finished.errors;
    EXPECT_EQ(contents(), before) << flag;
  }
}

TEST_F(OutputPaths, KeepTheEarlierFilesWhereOneIsNotAvailable) {
  folder_.write("old.txt", "# simulated seconds, in (from the host) or out, line, bytes, # remark\n");
  folder_.write("old.jsonl", R"({"understudy":1,"kind":"recording"})");
  folder_.write("old.csv", "time_ms\n");
  folder_.write("old.xml", "<testsuites/>");
  const std::string before = contents();
  const std::vector<Words> cases = {
      {"serve", at("bench.yaml"), "--capture", at("old.txt"), "--record", at("none/r")},
      {"serve", at("bench.yaml"), "--record", at("old.jsonl"), "--trace", at("none/t.csv")},
      {"serve", at("bench.yaml"), "--trace", at("old.csv"), "--record", at("none/r")},
      {"run", at("play.yaml"), "--junit", at("old.xml"), "--report", at("none/page")},
  };
  for (const Words& words : cases) {
    const Finished finished = understudy(words);
    EXPECT_EQ(finished.exit_code, 3) << finished.errors;
    EXPECT_NE(finished.errors.find("cannot be written: No such file or directory"), std::string::npos)
        << finished.errors;
    EXPECT_EQ(contents(), before) << words[2];
  }
}

TEST_F(OutputPaths, OfAGrowingFileBelongToOneProgram) {
  const RunningUnderstudy first({"--record", at("r.jsonl"), "--trace", at("t.csv")});
  for (const auto& [flag, name] :
       {std::pair<std::string, std::string>{"--record", "r.jsonl"}, {"--trace", "t.csv"}}) {
    const std::string had = [&, &name = name] {
      std::ostringstream text;
      text << std::ifstream(at(name)).rdbuf();
      return text.str();
    }();
    const Finished second = understudy({"serve", at("bench.yaml"), flag, at(name)});
    EXPECT_EQ(second.exit_code, 3);
    EXPECT_NE(second.errors.find(": another program is writing it; expected another path\n"),
              std::string::npos)
        << second.errors;
    std::ostringstream has;
    has << std::ifstream(at(name)).rdbuf();
    EXPECT_TRUE(has.str().starts_with(had)) << flag;
  }
}

TEST_F(OutputPaths, ReportAtOnceWhatCannotBeWritten) {
  ASSERT_EQ(::mkfifo(at("pipe.csv").c_str(), 0600), 0);
  for (const std::string flag : {"--record", "--trace", "--capture"}) {
    const Finished finished = understudy({"serve", at("bench.yaml"), flag, at("pipe.csv")});
    EXPECT_EQ(finished.exit_code, 3);
    EXPECT_NE(finished.errors.find("it is a pipe; expected a regular file, or a free path"),
              std::string::npos)
        << finished.errors;
    // A full disk, simulated by a limit on the size of files; messages go through a pipe.
    const Finished full = run({"bash", "-c", "(ulimit -f 0; exec \"$@\") 2>&1 | cat; exit ${PIPESTATUS[0]}",
                               "bash", UNDERSTUDY_BINARY, "serve", at("bench.yaml"), flag, at("new.csv")});
    EXPECT_EQ(full.exit_code, 3) << flag;
    EXPECT_NE(full.output.find("cannot be written: File too large"), std::string::npos) << full.output;
  }
}

/// Returns the folder that a `run` has locked; empty before that.
std::string spool_of(const Process& process) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator("/proc/" + std::to_string(process.pid()) + "/fd", error)) {
    const std::string path = fs::read_symlink(entry.path(), error).string();
    if (path.ends_with("/spool")) return path;
  }
  return "";
}

TEST_F(OutputPaths, KeepTheEarlierFileIfTheDiskIsFull) {
  ASSERT_EQ(understudy({"run", at("play.yaml"), "--record", at("recordings")}).exit_code, 0);
  std::string recording;
  for (const auto& entry : fs::recursive_directory_iterator(at("recordings")))
    if (entry.is_regular_file()) recording = entry.path();
  const std::string old_page = "<!DOCTYPE html>an old page", old_picture = "<svg>an old picture</svg>";
  for (const auto& [flag, name, old] : {std::tuple{"--export", "old.html", old_page},
                                        {"--report", "old.html", old_page},
                                        {"--picture", "old.svg", old_picture}}) {
    // No file may grow beyond 1 KiB.
    const Words words{
        "bash", "-c",    "ulimit -f 1; exec \"$@\"", "bash", UNDERSTUDY_BINARY, "replay", recording,
        flag,   at(name)};
    std::ofstream(at(name)) << old;
    const Finished full = run(words);
    EXPECT_EQ(full.exit_code, 3) << flag << full.errors;
    EXPECT_NE(full.errors.find("File too large"), std::string::npos) << full.errors;
    std::ostringstream kept;
    kept << std::ifstream(at(name)).rdbuf();
    EXPECT_EQ(kept.str(), old) << flag;
    fs::remove(at(name));
    EXPECT_EQ(run(words).exit_code, 3) << flag;
    EXPECT_FALSE(fs::exists(at(name))) << "an empty file would look like a result";
  }
}

TEST_F(OutputPaths, AStandardOutputThatCannotBeWrittenIsReported) {
  for (const char* target : {">&-", ">/dev/full"}) {
    for (const Words& words :
         {Words{"--version"}, Words{"check", at("play.yaml")}, Words{"run", at("play.yaml")}}) {
      Words command{"bash", "-c", std::string("exec \"$@\" ") + target, "bash", UNDERSTUDY_BINARY};
      command.insert(command.end(), words.begin(), words.end());
      const Finished finished = run(command);
      EXPECT_EQ(finished.exit_code, 3) << words.front() << target;
      EXPECT_EQ(finished.errors, "understudy: standard output cannot be written\n")
          << words.front() << target;
    }
  }
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

}  // namespace output_paths_test
}  // namespace understudy::acceptance
