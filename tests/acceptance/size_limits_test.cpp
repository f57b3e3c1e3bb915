// A limit on the size of files is an error like a full disk, reported in one line: it does not end any
// command abruptly.
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace size_limits_test {

namespace fs = std::filesystem;

class SizeLimits : public testing::Test {
 protected:
  SizeLimits() {
    folder_.write("bench.yaml",
                  "understudy: 1\nlines: { a: { stations: [ { name: feeder, model: simple2-r3 } ] } }\n");
    folder_.write(
        "grid.yaml",
        "understudy: 1\nname: grid ${n}\nbench: bench.yaml\nvary: { n: { from: 1, to: 60, step: 1 } }\n"
        "steps: [ advance: 1ms ]\n");
    folder_.write("move.yaml",
                  "understudy: 1\nname: move\nbench: bench.yaml\nsteps:\n  - write: { Aaxis_SVON: 1 }\n"
                  "  - write: { Aaxis_Speed: 200, Aaxis_Pulse: 3200, Aaxis_Move_INC: 1 }\n  - advance: 2s\n"
                  "  - repeat: { times: 60, steps: [ expect: { Cord_A: 3200 } ] }\n");
    EXPECT_EQ(understudy({"run", at("move.yaml"), "--record", at("kept"), "--trace", at("kept")}).exit_code,
              0);
    std::string list = "address,name\n";
    for (int i = 0; i < 400; ++i) list += std::to_string(i) + ",REGISTER_" + std::to_string(i) + "\n";
    folder_.write("list.csv", list);
  }
  std::string at(const std::string& name) const { return folder_ / name; }
  /// Runs with a limit of this many kilobytes for each file. Messages go through pipes.
  Finished limited(int kilobytes, const Words& words) const {
    Words command{"bash", "-c", "ulimit -f " + std::to_string(kilobytes) + "; exec \"$@\"", "bash",
                  UNDERSTUDY_BINARY};
    for (const std::string& word : words)
      command.push_back(word.starts_with("@") ? at(word.substr(1)) : word);
    return run(command);
  }
  std::string content(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(at(name), std::ios::binary).rdbuf();
    return text.str();
  }

  PrivateFolder folder_;
};

TEST_F(SizeLimits, AreReportedByEveryCommandThatWrites) {
  struct Case {
    int kilobytes;
    Words words;
    std::string says;
  };
  const std::vector<Case> cases = {
      {4, {"run", "@grid.yaml", "--results", "@rows.jsonl"}, "--results: "},
      {4, {"run", "@grid.yaml", "--results", "@rows.sqlite"}, "--results: "},
      {4, {"run", "@grid.yaml", "--junit", "@junit.xml"}, "--junit: "},
      {4, {"run", "@grid.yaml", "--report", "@report.html"}, "--report: "},
      {1, {"run", "@move.yaml", "--record", "@limited"}, "File too large"},
      {1, {"run", "@move.yaml", "--trace", "@limited"}, "File too large"},
      {1, {"run", "@move.yaml", "--capture", "@limited"}, "File too large"},
      {1, {"replay", "@kept/move.jsonl", "--trace", "@t.csv"}, "File too large"},
      {1, {"replay", "@kept/move.jsonl", "--capture", "@c.txt"}, "File too large"},
      {1, {"replay", "@kept/move.jsonl", "--report", "@r.html"}, "--report: "},
      {1, {"import", "@list.csv", "-o", "@made.yaml"}, "File too large"},
      {8, {"init", "@first"}, "File too large"},
      {1, {"plot", "@kept/move.csv", "-o", "@p.png"}, "plot: "},
  };
  for (const Case& c : cases) {
    const Finished finished = limited(c.kilobytes, c.words);
    const std::string what = testing::PrintToString(c.words) + ": " + finished.errors;
    EXPECT_EQ(finished.exit_code, 3) << what;
    EXPECT_NE(finished.errors.find(c.says), std::string::npos) << what;
  }
  // What was written stays complete, and the run continues there.
  const std::string rows = content("rows.jsonl");
  ASSERT_FALSE(rows.empty());
  EXPECT_EQ(rows.back(), '\n');
  const Finished further = understudy({"run", at("grid.yaml"), "--results", at("rows.jsonl"), "--resume"});
  EXPECT_EQ(further.exit_code, 0) << further.errors;
  EXPECT_EQ(lines_of(content("rows.jsonl")).size(), 60U);
  EXPECT_FALSE(fs::exists(at("made.yaml")));
}

TEST_F(SizeLimits, DoNotStopDevicesThatRun) {
  const Finished finished = limited(
      64, {"exec", "@bench.yaml", "--speed", "manual", "--trace", "@t.csv", "--nv", "@nv", "--", "bash", "-c",
           std::string(UNDERSTUDY_BINARY) + " ctl set Aaxis_SVON=1 Aaxis_Speed=1 Aaxis_Pulse=100000; " +
               UNDERSTUDY_BINARY + " ctl set Aaxis_Move_INC=1; " + UNDERSTUDY_BINARY + " ctl advance 100s; " +
               UNDERSTUDY_BINARY + " ctl get HW_Code"});
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_NE(finished.output.find("HW_Code 49153"), std::string::npos) << finished.output;
  EXPECT_NE(finished.errors.find("the trace ended early: File too large"), std::string::npos)
      << finished.errors;
}

// Programs that we start have the limit's own signal, as if we had not changed it.
TEST_F(SizeLimits, AreTheCommandsOwnBehindExec) {
  const Finished finished = limited(
      64, {"exec", "@bench.yaml", "--", "dd", "if=/dev/zero", "of=" + at("large"), "bs=1024", "count=100"});
  EXPECT_EQ(finished.exit_code, 128 + SIGXFSZ) << finished.errors;
}

}  // namespace size_limits_test
}  // namespace understudy::acceptance
