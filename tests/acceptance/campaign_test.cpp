// Campaigns as users run them: killed and resumed, in shards, at a terminal, with constant memory.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <regex>
#include <set>
#include <sstream>
#include <thread>

#include "tests/acceptance/at_terminal.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace campaign_test {

namespace fs = std::filesystem;

std::string contents(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// Any number of cases; every tenth speed fails at one step, and every fiftieth at another one.
std::string campaign(int cases) {
  return "understudy: 1\nname: speeds\n"
         "bench: { lines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } } }\n"
         "vary: { speed: { from: 1, to: " +
         std::to_string(cases) +
         ", step: 1 } }\nsteps:\n"
         "  - write: { feeder.Aaxis_Pulse: \"${speed}\" }\n"
         "  - assert: feeder.Aaxis_Pulse % 50 != 0\n"
         "  - assert: feeder.Aaxis_Pulse % 10 != 0\n"
         "  - advance: 10ms\n";
}

class Campaign : public testing::Test {
 protected:
  std::string file(int cases) const { return folder_.write("campaign.yaml", campaign(cases)); }
  std::vector<std::string> rows(const std::string& name) const {
    auto all = lines_of(contents(folder_ / name));
    // Only the paths of recordings differ between runs.
    const std::regex recording("\"recording\":(null|\"[^\"]*\")");
    for (std::string& row : all) row = std::regex_replace(row, recording, "");
    return all;
  }
  /// "97 passed, 3 failed" by verdict, as Python's sqlite3 sees it.
  std::string sqlite(const std::string& name, const std::string& question) const {
    return run({"python3", "-c",
                "import sqlite3, sys\nfor row in sqlite3.connect(sys.argv[1]).execute(sys.argv[2]): "
                "print(*row)",
                folder_ / name, question})
        .output;
  }
  std::set<std::string> recordings(const std::string& name) const {
    std::set<std::string> all;
    if (!fs::exists(folder_ / name)) return all;
    for (const auto& entry : fs::directory_iterator(folder_ / name)) all.insert(entry.path().filename());
    return all;
  }

  PrivateFolder folder_;
};

TEST_F(Campaign, OnlyTheFirstFailureOfEachKindIsKept) {
  const Finished finished = understudy({"run", file(100), "--failures", folder_ / "failures", "--results",
                                        folder_ / "all.sqlite", "--report", folder_ / "page.html"});
  EXPECT_EQ(finished.exit_code, 1) << finished.errors;
  EXPECT_NE(finished.output.find("8 failed in the same way: "), std::string::npos) << finished.output;
  EXPECT_NE(finished.output.find("2 failed in the same way: "), std::string::npos);
  EXPECT_NE(finished.output.find("90 passed, 10 failed; "), std::string::npos);
  EXPECT_EQ(std::count(finished.output.begin(), finished.output.end(), '\n') < 60, true) << finished.output;
  const std::string page = contents(folder_ / "page.html");
  EXPECT_NE(page.find("98 of these are not shown"), std::string::npos);
  const auto kept = recordings("failures");
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_TRUE(kept.begin()->starts_with("speeds_speed_10-")) << *kept.begin();
  EXPECT_TRUE(kept.rbegin()->starts_with("speeds_speed_50-")) << *kept.rbegin();
  for (const std::string& recording : kept) {
    const Finished replayed = understudy({"replay", folder_ / ("failures/" + recording)});
    EXPECT_EQ(replayed.exit_code, 0) << replayed.errors;
  }
  EXPECT_EQ(sqlite("all.sqlite", "SELECT count(*), count(recording), count(DISTINCT kind) FROM results"),
            "100 2 2\n");
  EXPECT_EQ(
      sqlite("all.sqlite", "SELECT min(speed), max(speed), count(*) FROM cases WHERE verdict = 'failed'"),
      "10 100 10\n");
  // The case that a failure names can be run alone.
  const std::regex alone("understudy run (\\S+) --filter ([0-9a-f]{16})");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(finished.output, found, alone)) << finished.output;
  const Finished one = understudy({"run", found[1], "--filter", found[2]});
  EXPECT_NE(one.output.find("speeds (speed=10)"), std::string::npos) << one.output;
  EXPECT_NE(one.output.find("0 passed, 1 failed; "), std::string::npos) << one.output;
}

TEST_F(Campaign, ARecordingWithoutRoomIsReportedWithItsFlag) {
  const Words command{"run", file(20), "--failures", folder_ / "failures"};
  EXPECT_EQ(understudy(command).exit_code, 1);
  const std::string kept = folder_ / ("failures/" + *recordings("failures").begin());
  fs::remove(kept);
  fs::create_directory(kept);
  const Finished finished = understudy(command);
  EXPECT_EQ(finished.exit_code, 3);
  EXPECT_TRUE(finished.errors.starts_with("understudy: --failures: " + kept + " cannot be written: "))
      << finished.errors;
}

TEST_F(Campaign, CasesOfAListKeepTheirFirstFailuresToo) {
  const std::string scenario = folder_.write(
      "rows.yaml",
      "understudy: 1\nbench: { lines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } } }\n"
      "cases: [ { n: 1 }, { n: 2 }, { n: 0 }, { n: 3 } ]\nsteps: [ expect: { feeder.Aaxis_Pulse: \"${n}\" } "
      "]\n");
  const Finished finished = understudy({"run", scenario, "--failures", folder_ / "failures"});
  EXPECT_EQ(recordings("failures"), std::set<std::string>{"rows_n_1.jsonl"});
  EXPECT_NE(
      finished.output.find("it failed in the same way as this case, whose recording is kept: rows (n=1)"),
      std::string::npos)
      << finished.output;
  EXPECT_NE(finished.output.find("ok    " + scenario + ": rows (n=0)"), std::string::npos);
  understudy({"run", scenario, "--record", folder_ / "all"});
  EXPECT_EQ(recordings("all").size(), 4U);
  EXPECT_EQ(understudy({"run", scenario, "--record", folder_ / "all", "--failures", folder_ / "failures"})
                .exit_code,
            2);
}

TEST_F(Campaign, ThreadsAndKindsOfFilesMakeNoDifference) {
  const std::string scenario = file(400);
  for (const char* jobs : {"1", "7"}) {
    understudy({"run", scenario, "--jobs", jobs, "--results",
                folder_ / (std::string("of_") + jobs + ".jsonl"), "--results",
                folder_ / (std::string("of_") + jobs + ".sqlite")});
  }
  EXPECT_EQ(rows("of_1.jsonl").size(), 400U);
  EXPECT_EQ(rows("of_7.jsonl"), rows("of_1.jsonl"));
  const std::string question =
      "SELECT name, case_id, parameters, verdict, hash, simulated_s, kind FROM results";
  EXPECT_EQ(sqlite("of_7.sqlite", question), sqlite("of_1.sqlite", question));
}

TEST_F(Campaign, ShardsAreThePartsOfTheWhole) {
  const std::string scenario = file(200);
  understudy({"run", scenario, "--results", folder_ / "whole.jsonl"});
  std::vector<std::string> parts;
  for (int i = 1; i <= 6; ++i) {
    const std::string name = "part" + std::to_string(i) + ".jsonl";
    understudy({"run", scenario, "--shard", std::to_string(i) + "/6", "--results", folder_ / name});
    const auto more = rows(name);
    EXPECT_TRUE(more.size() == 33 || more.size() == 34) << more.size();
    parts.insert(parts.end(), more.begin(), more.end());
  }
  auto whole = rows("whole.jsonl");
  std::sort(parts.begin(), parts.end());
  std::sort(whole.begin(), whole.end());
  EXPECT_EQ(parts, whole);
}

TEST_F(Campaign, OneThatIsKilledContinues) {
  constexpr int kCases = 12'000;
  constexpr int kKills = 4;
  constexpr unsigned kSeed = 20'008;
  const std::string scenario = file(kCases);
  understudy({"run", scenario, "--jobs", "2", "--results", folder_ / "whole.jsonl"});
  for (const std::string kind : {"jsonl", "sqlite"}) {
    std::mt19937 random(kSeed);
    const std::string results = folder_ / ("killed." + kind);
    const Words command{"run", scenario, "--jobs", "2", "--results", results, "--resume"};
    int killed = 0;
    for (int kill = 0; kill < kKills; ++kill) {
      Words words{UNDERSTUDY_BINARY};
      words.insert(words.end(), command.begin(), command.end());
      Process process(words);
      // In the middle: some are present, but not all.
      const auto played = [&] { return fs::exists(results) ? fs::file_size(results) : 0; };
      const auto before = played();
      const auto more = kind == "jsonl" ? random() % 100'000 : 1;  // a database grows by what is committed
      eventually([&] { return played() >= before + more || process.wait(Wait(0)); }, Wait(20'000));
      // A database grows when it is committed.
      if (kind == "sqlite") std::this_thread::sleep_for(std::chrono::milliseconds(20 + random() % 40));
      process.send(SIGKILL);
      if (process.wait(kPatience) == 128 + SIGKILL) ++killed;
    }
    EXPECT_GT(killed, 0) << "it always ended before it was killed";
    const Finished last = understudy(command);
    EXPECT_EQ(last.exit_code, 1) << last.errors;
    const std::regex left_out("([0-9]+) skipped, because they ran earlier; ([0-9]+) of them failed");
    const std::regex played("([0-9]+) passed, ([0-9]+) failed; ");
    std::smatch before;
    std::smatch now;
    ASSERT_TRUE(std::regex_search(last.output, before, left_out)) << kind << last.output;
    ASSERT_TRUE(std::regex_search(last.output, now, played)) << last.output;
    EXPECT_EQ(std::stoi(before[1]) + std::stoi(now[1]) + std::stoi(now[2]), kCases) << last.output;
    EXPECT_EQ(std::stoi(before[2]) + std::stoi(now[2]), kCases / 10) << last.output;
    if (kind == "jsonl") {
      EXPECT_EQ(rows("killed.jsonl"), rows("whole.jsonl"));
    } else {
      EXPECT_EQ(sqlite("killed.sqlite", "PRAGMA integrity_check"), "ok\n");
      EXPECT_EQ(sqlite("killed.sqlite",
                       "SELECT count(*), count(DISTINCT case_id), sum(verdict = 'failed') FROM results"),
                "12000 12000 1200\n");
    }
    EXPECT_NE(understudy(command).output.find("12000 skipped, because they ran earlier; 1200 of them failed"),
              std::string::npos);
  }
}

TEST_F(Campaign, WhatHasChangedIsPlayedAgain) {
  const std::string scenario = file(20);
  const Words command{"run", scenario, "--results", folder_ / "rows.jsonl", "--resume"};
  understudy(command);
  EXPECT_NE(understudy(command).output.find("20 skipped"), std::string::npos);
  folder_.write("campaign.yaml", campaign(20) + "  - advance: 1ms\n");
  EXPECT_NE(understudy(command).output.find("18 passed, 2 failed; "), std::string::npos);
  EXPECT_EQ(rows("rows.jsonl").size(), 40U);
  Words seeded = command;
  seeded.insert(seeded.end(), {"--seed", "9"});
  EXPECT_NE(understudy(seeded).output.find("18 passed, 2 failed; "), std::string::npos);
  // If there are more cases, only new ones run.
  folder_.write("campaign.yaml", campaign(20));
  EXPECT_NE(understudy(command).output.find("20 skipped"), std::string::npos);
}

TEST_F(Campaign, AnUnreadableCaseIsReportedAndTheOthersRun) {
  const std::string scenario = folder_.write(
      "late.yaml",
      "understudy: 1\nname: late\nbench: { lines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } "
      "] } } }\n"
      "vary: { n: { from: 1, to: 3000, step: 1 } }\n"
      "steps:\n  - write: { feeder.Aaxis_AccTime: \"${n * (4000 / (abs(n - 1778) + 1) / 4000 * 4 + 1)}\" "
      "}\n");
  const Finished checked = understudy({"check", scenario});
  EXPECT_EQ(checked.exit_code, 0) << checked.output << checked.errors;
  EXPECT_NE(checked.output.find("3000 scenarios (1000 of them checked)"), std::string::npos)
      << checked.output;
  const Finished finished =
      understudy({"run", scenario, "--results", folder_ / "rows.sqlite", "--junit", folder_ / "rows.xml"});
  EXPECT_EQ(finished.exit_code, 2) << finished.output;
  EXPECT_NE(finished.output.find(": steps[0].write.feeder.Aaxis_AccTime: 8890 is out of range"),
            std::string::npos)
      << finished.output;
  EXPECT_NE(finished.output.find("2999 passed, 1 failed, 1 of them could not be read; "), std::string::npos)
      << finished.output;
  EXPECT_EQ(sqlite("rows.sqlite", "SELECT n, verdict, hash FROM cases WHERE verdict <> 'passed'"),
            "1778 unreadable None\n");
  EXPECT_NE(contents(folder_ / "rows.xml").find("failures=\"0\" errors=\"1\""), std::string::npos);
}

/// The peak memory in KiB, like /usr/bin/time, measured by Python.
long max_memory(const Words& arguments) {
  Words command{"python3", "-c",
                "import resource, subprocess, sys\nsubprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL)\n"
                "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)",
                UNDERSTUDY_BINARY};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const Finished finished = run(command);
  return finished.output.empty() ? 0 : std::stol(finished.output);
}

TEST_F(Campaign, MemoryDoesNotGrowWithTheNumberOfCases) {
  const auto memory = [&](int cases) {
    return max_memory({"run", file(cases), "--jobs", "2", "--results", folder_ / "rows.jsonl", "--results",
                       folder_ / "rows.sqlite", "--junit", folder_ / "rows.xml", "--report",
                       folder_ / "page.html"});
  };
  // Until here, the allocator of each thread grows to its size.
  const long few = memory(10'000);
  const long many = memory(40'000);
  ASSERT_GT(few, 0);
  // A result, with its steps and names, takes more than 1 KiB. What the allocator keeps differs by 5 MiB from
  // run to run, however many cases there are.
  EXPECT_LT(many - few, 8000) << few << " KiB for 10000, " << many << " KiB for 40000";
}

TEST_F(Campaign, TheExampleIsWhatItSays) {
  const std::string example = std::string(PROJECT_FOLDER) + "/examples/campaign";
  const Finished checked = understudy({"check", example});
  EXPECT_NE(checked.output.find("move.yaml: 100000 scenarios"), std::string::npos)
      << checked.output << checked.errors;
  const Finished finished = understudy({"run", example, "--shard", "77/500"});
  EXPECT_EQ(finished.exit_code, 0) << finished.output;
  EXPECT_NE(finished.output.find("200 passed, 0 failed; "), std::string::npos) << finished.output;
}

TEST_F(Campaign, ProgressIsForTerminalsOnly) {
  const std::string scenario =
      folder_.write("slow.yaml",
                    "understudy: 1\nname: slow\nbench: { lines: { rs485: { stations: [ { name: feeder, "
                    "model: simple2-r3 } ] } } }\n"
                    "vary: { n: [ 1, 2, 3 ] }\nsteps:\n  - advance: 800ms\n  - assert: ${n} != 1\n");
  const Words run{UNDERSTUDY_BINARY, "run", scenario, "--real-time", "--jobs", "1"};
  AtTerminal watched(run, {{"TERM", "xterm"}, {"CI", ""}});
  EXPECT_TRUE(watched.shows("1 of 3 played, 1 failed, ")) << watched.screen();
  EXPECT_TRUE(watched.shows("/s, ")) << watched.screen();
  EXPECT_TRUE(watched.shows(" s left")) << watched.screen();
  EXPECT_TRUE(watched.shows("2 passed, 1 failed")) << watched.screen();
  AtTerminal in_ci(run, {{"TERM", "xterm"}, {"CI", "true"}});
  EXPECT_TRUE(in_ci.shows("2 passed, 1 failed")) << in_ci.screen();
  EXPECT_EQ(in_ci.screen().find(" played, "), std::string::npos) << in_ci.screen();
}

TEST_F(Campaign, RecipesComeToTheSameAsOneRun) {
  const std::string script = std::string(PROJECT_FOLDER) + "/recipes/campaign/try_all.sh";
  for (const char* recipe : {"gitlab", "github", "parallel"}) {
    Process process({script, UNDERSTUDY_BINARY, recipe});
    const auto exit_code = process.wait(4 * kPatience);  // eight shards, one after another
    if (exit_code == 77) continue;                       // a required program is not installed
    EXPECT_EQ(exit_code, 0) << recipe << process.output() << process.errors();
    EXPECT_NE(process.output().find(": as one run without shards"), std::string::npos) << process.output();
  }
}

TEST_F(Campaign, FlagsThatMakeNoSenseAreRefused) {
  const std::string scenario = file(3);
  struct Row {
    Words flags;
    const char* diagnostic;
    int code;
  };
  folder_.write("other.jsonl", "not a row\n");
  for (const Row& row : std::vector<Row>{
           {{"--resume"}, "--resume: needs the list of the cases that have run; expected --results FILE", 2},
           {{"--results", "rows.csv"},
            "--results: rows.csv: has an unknown format; expected FILE.jsonl or FILE.sqlite",
            2},
           {{"--results", scenario}, "the scenario itself", 2},
           {{"--results", folder_ / "other.jsonl", "--resume"},
            "other.jsonl cannot be written: it is not a results file; expected one to replace, or a free "
            "path",
            3},
           {{"--results", folder_ / "no/rows.jsonl"}, "cannot be written: No such file or directory", 3},
           {{"--results", folder_ / "r.jsonl", "--results", folder_ / "r.jsonl"},
            "what --results writes",
            2}}) {
    Words words{"run", scenario};
    words.insert(words.end(), row.flags.begin(), row.flags.end());
    const Finished finished = understudy(words);
    EXPECT_EQ(finished.exit_code, row.code) << finished.errors;
    EXPECT_NE(finished.errors.find(row.diagnostic), std::string::npos) << finished.errors;
  }
}

}  // namespace campaign_test
}  // namespace understudy::acceptance
