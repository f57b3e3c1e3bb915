// `understudy exec`: a user's command with a bench.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <fstream>
#include <set>
#include <sstream>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace exec_test {

namespace fs = std::filesystem;

constexpr const char* kOne = R"(understudy: 1
lines:
  rs485:
    link: ./never-made.port
    stations: [ { name: feeder, model: simple2-r3, address: 1 } ]
)";

constexpr const char* kTwo = R"(understudy: 1
lines:
  rs-485: { stations: [ { name: feeder, model: simple2-r3, address: 1 } ] }
  panel: { stations: [ { name: turner, model: simple2-r3, address: 2 } ] }
)";

class Exec : public testing::Test {
 protected:
  const std::string& bench() const { return bench_; }
  const PrivateFolder& folder() const { return folder_; }
  /// This program, for scripts.
  static Environment known() { return {{"U", UNDERSTUDY_BINARY}}; }

  Finished exec(const Words& flags, const Words& command) const {
    Words words{"exec", bench()};
    words.insert(words.end(), flags.begin(), flags.end());
    words.emplace_back("--");
    words.insert(words.end(), command.begin(), command.end());
    return understudy(words, known());
  }
  Finished script(const std::string& text, const Words& flags = {}) const {
    return exec(flags, {"/bin/sh", "-c", text});
  }
  std::string read(const std::string& name) const {
    std::ifstream file(folder_ / name);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

 private:
  PrivateFolder folder_;
  const std::string bench_ = folder_.write("bench.yaml", kOne);
};

// --- the command's environment ---------------------------------------------------------------------

TEST_F(Exec, GivesThePortsAndTheControlSocket) {
  const std::string two = folder().write("two.yaml", kTwo);
  const Finished finished =
      understudy({"exec", two, "--", "/bin/sh", "-c",
                  "test \"$UNDERSTUDY_PORT\" = \"$UNDERSTUDY_PORT_RS_485\" && "
                  "$U poll $UNDERSTUDY_PORT --model simple2-r3 HW_Code && "
                  "$U poll $UNDERSTUDY_PORT_PANEL --model simple2-r3 --station 2 HW_Code && "
                  "$U ctl set turner.Aaxis_Speed=321 && "
                  "$U poll $UNDERSTUDY_PORT_PANEL --model simple2-r3 --station 2 Aaxis_Speed"},
                 known());
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_EQ(finished.output, "HW_Code 49153\nHW_Code 49153\nAaxis_Speed 321\n");  // C001 hex
  EXPECT_EQ(finished.errors, "");
}

TEST_F(Exec, LeavesTheCommandsWordsAsTheyAre) {
  const Finished finished =
      exec({}, {"/bin/sh", "-c", "printf '<%s>' \"$@\"", "sh", "--timeout", "-h", "--", "", "a b", "*"});
  EXPECT_EQ(finished.output, "<--timeout><-h><--><><a b><*>");
  EXPECT_EQ(finished.exit_code, 0);
}

TEST_F(Exec, LeavesItsInputAndItsSignalsAsTheyWere) {
  // A serving process ignores SIGPIPE (13), and blocks SIGTERM (15), SIGINT, SIGHUP, SIGCHLD.
  const Finished finished = script("grep -E '^Sig(Blk|Ign)' /proc/self/status");
  const Finished plain = run({"grep", "-E", "^Sig(Blk|Ign)", "/proc/self/status"});
  EXPECT_EQ(finished.output, plain.output);
}

TEST_F(Exec, KeepsItsPlacesToItselfAndTidiesUp) {
  const Finished finished = script("dirname $UNDERSTUDY_PORT; ls -A $(dirname $UNDERSTUDY_PORT) | sort");
  const auto lines = lines_of(finished.output);
  ASSERT_EQ(lines.size(), 5U) << finished.output;
  EXPECT_EQ(lines[1] + " " + lines[2] + " " + lines[3] + " " + lines[4],
            ".rs485.port.lock control recording rs485.port");
  EXPECT_FALSE(fs::exists(lines[0]));
  EXPECT_FALSE(fs::exists(folder() / "never-made.port"));
}

TEST_F(Exec, RunsSideBySide) {
  std::vector<std::unique_ptr<Process>> jobs;
  for (int i = 0; i < 8; ++i) {
    const std::string number = std::to_string(100 + i);
    jobs.push_back(std::make_unique<Process>(
        Words{UNDERSTUDY_BINARY, "exec", bench(), "--", "/bin/sh", "-c",
              "$U poll $UNDERSTUDY_PORT --model simple2-r3 Aaxis_Speed=" + number +
                  " && sleep 0.3 && $U poll $UNDERSTUDY_PORT --model simple2-r3 Aaxis_Speed"},
        known()));
  }
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(jobs[static_cast<std::size_t>(i)]->wait(kPatience), 0)
        << jobs[static_cast<std::size_t>(i)]->errors();
    EXPECT_EQ(jobs[static_cast<std::size_t>(i)]->output(), "Aaxis_Speed " + std::to_string(100 + i) + "\n");
  }
}

TEST_F(Exec, MakesLinksAndASocketWhereRequested) {
  fs::create_directory(folder() / "links");
  const Finished finished = script("echo $UNDERSTUDY_PORT $UNDERSTUDY_CONTROL",
                                   {"--links", folder() / "links", "--control", folder() / "socket"});
  EXPECT_EQ(finished.output, folder() / "links/never-made.port" + " " + (folder() / "socket") + "\n");
}

TEST_F(Exec, MovesAClockThatStandsThroughTheControlSocket) {
  const Finished finished = script(
      "$U ctl set Aaxis_SVON=1 Aaxis_Pulse=3200 Aaxis_Speed=200 Aaxis_Move_INC=1 && $U ctl advance 60s >&2 "
      "&& "
      "$U ctl get Cord_A",
      {"--speed", "manual"});
  EXPECT_EQ(finished.output, "Cord_A 3200\n") << finished.errors;
}

// --- how it ends -----------------------------------------------------------------------------------

struct Ending {
  const char* name;
  Words command;
  int exit_code;
};

class ExecEnding : public Exec, public testing::WithParamInterface<Ending> {};

TEST_P(ExecEnding, IsTheCommands) {
  const Finished finished = exec({}, GetParam().command);
  EXPECT_EQ(finished.exit_code, GetParam().exit_code) << finished.errors;
}

INSTANTIATE_TEST_SUITE_P(Of, ExecEnding,
                         testing::Values(Ending{"Success", {"true"}, 0}, Ending{"Failure", {"false"}, 1},
                                         Ending{"Code", {"sh", "-c", "exit 77"}, 77},
                                         Ending{"Terminated", {"sh", "-c", "kill -TERM $$"}, 128 + 15},
                                         Ending{"Killed", {"sh", "-c", "kill -KILL $$"}, 128 + 9},
                                         Ending{"NoSuchProgram", {"no-such-program"}, 127},
                                         Ending{"NoProgram", {"/etc/passwd"}, 127}),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

TEST_F(Exec, SaysWhyItCouldNotStart) {
  const Finished finished = exec({}, {"no-such-program"});
  EXPECT_EQ(lines_of(finished.errors).size(), 1U) << finished.errors;
  EXPECT_NE(finished.errors.find("no-such-program"), std::string::npos) << finished.errors;
}

TEST_F(Exec, KeepsARecordingOfARunThatFailed) {
  const Finished finished = script("$U poll $UNDERSTUDY_PORT --model simple2-r3 HW_Code; exit 3");
  EXPECT_EQ(finished.exit_code, 3);
  const std::string reported = "understudy replay ";
  const auto at = finished.errors.find(reported);
  ASSERT_NE(at, std::string::npos) << finished.errors;
  const std::string path = lines_of(finished.errors.substr(at + reported.size())).at(0);
  const Finished again = understudy({"replay", path});
  EXPECT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_NE(again.output.find(": the same: "), std::string::npos) << again.output;
  EXPECT_TRUE(fs::remove_all(fs::path(path).parent_path()) > 0);
}

TEST_F(Exec, SaysHowToRunAFailureAgainWhereverItIsRecorded) {
  const std::string recording = folder() / "recording";
  const Finished failed = script("exit 3", {"--record", recording});
  EXPECT_EQ(failed.exit_code, 3);
  EXPECT_EQ(failed.errors, "understudy: exec: to run this again: understudy replay " + recording + "\n");
  EXPECT_EQ(understudy({"replay", recording}).exit_code, 0);
  EXPECT_EQ(script("true", {"--record", recording}).errors, "");
  EXPECT_EQ(exec({"--record", recording}, {"no-such-program"}).errors.find("again"), std::string::npos);
}

TEST_F(Exec, EndsACommandThatTakesTooLong) {
  const Finished finished = script("sleep 60", {"--timeout", "200ms", "--record", folder() / "recording"});
  EXPECT_EQ(finished.exit_code, 124);
  const auto reported = lines_of(finished.errors);
  ASSERT_EQ(reported.size(), 2U) << finished.errors;
  EXPECT_NE(reported[0].find("longer than 200ms"), std::string::npos) << reported[0];
  EXPECT_EQ(reported[1],
            "understudy: exec: to run this again: understudy replay " + (folder() / "recording"));
}

TEST_F(Exec, PassesSignalsOn) {
  for (const int signal_number : {SIGTERM, SIGINT, SIGHUP}) {
    Process process({UNDERSTUDY_BINARY, "exec", bench(), "--record", folder() / "recording", "--", "/bin/sh",
                     "-c",
                     "trap 'echo asked; exit 5' TERM INT HUP; echo ready; while :; do sleep 0.02; done"});
    ASSERT_TRUE(eventually([&] { return process.output() == "ready\n"; })) << process.errors();
    process.send(signal_number);
    EXPECT_EQ(process.wait(kPatience), 5) << signal_number;
    EXPECT_EQ(process.output(), "ready\nasked\n");
  }
}

bool is_present(const std::string& pid) { return fs::exists("/proc/" + pid); }

TEST_F(Exec, LeavesNothingBehindThatTheCommandStarted) {
  const Finished finished = script("sleep 600 & echo $!; (sleep 600 & echo $!); echo $$");
  EXPECT_EQ(finished.exit_code, 0);
  const auto pids = lines_of(finished.output);
  ASSERT_EQ(pids.size(), 3U);
  for (const std::string& pid : pids) EXPECT_FALSE(is_present(pid)) << pid;
}

TEST_F(Exec, KillsWhatDoesNotWantToEnd) {
  const auto began = std::chrono::steady_clock::now();
  const Finished finished =
      script("trap '' TERM; echo $$; while :; do sleep 0.1; done", {"--timeout", "100ms"});
  const auto took = std::chrono::steady_clock::now() - began;
  EXPECT_EQ(finished.exit_code, 124);
  EXPECT_FALSE(is_present(lines_of(finished.output).at(0)));
  EXPECT_GE(took, std::chrono::milliseconds(5'000));  // its grace period
}

TEST_F(Exec, TakesTheCommandAlongWhenItIsKilled) {
  Process process({UNDERSTUDY_BINARY, "exec", bench(), "--", "/bin/sh", "-c", "echo $$; exec sleep 600"});
  ASSERT_TRUE(eventually([&] { return process.output().ends_with('\n'); }));
  const std::string pid = lines_of(process.output()).at(0);
  process.send(SIGKILL);
  process.wait(kPatience);
  EXPECT_TRUE(eventually([&] {
    std::ifstream status("/proc/" + pid + "/stat");  // there may be no process to reap it
    std::string word;
    return !(status >> word >> word >> word) || word == "Z";
  }));
}

// --- bad usage -------------------------------------------------------------------------------------

TEST_F(Exec, RefusesBadUsageBeforeAnythingRuns) {
  const std::string mark = folder() / "ran";
  const std::string same =
      folder().write("same.yaml",
                     "understudy: 1\nlines:\n  a-b: { stations: [ { name: x, model: simple2-r3 } ] }\n"
                     "  a_b: { stations: [ { name: y, model: simple2-r3 } ] }\n");
  const std::string broken = folder().write("broken.yaml", "understudy: 1\nlines: 5\n");
  struct Case {
    Words words;
    const char* reported;
  };
  for (const Case& bad :
       {Case{{"exec", bench()}, "--"}, Case{{"exec", bench(), "touch", mark}, "--"},
        Case{{"exec", "--", "touch", mark}, "bench"},
        Case{{"exec", broken, "--", "touch", mark}, "broken.yaml:2"},
        Case{{"exec", same, "--", "touch", mark}, "UNDERSTUDY_PORT_A_B"},
        Case{{"exec", bench(), "--timeout", "soon", "--", "touch", mark}, "30s"},
        Case{{"exec", bench(), "--speed", "fast", "--", "touch", mark}, "10x"},
        Case{{"exec", bench(), "--with", folder() / "none.yaml", "--", "touch", mark}, "none.yaml"}}) {
    const Finished finished = understudy(bad.words);
    EXPECT_EQ(finished.exit_code, 2) << finished.errors;
    EXPECT_EQ(lines_of(finished.errors).size(), 1U) << finished.errors;
    EXPECT_NE(finished.errors.find(bad.reported), std::string::npos) << finished.errors;
  }
  EXPECT_FALSE(fs::exists(mark));
}

// --- with a scenario alongside ---------------------------------------------------------------------

class ExecWith : public Exec {
 protected:
  /// The scenario's steps, one per line.
  Finished with(const std::string& steps, const std::string& text, Words flags = {}) const {
    const std::string path =
        folder().write("beside.yaml", "understudy: 1\nname: beside\nbench: bench.yaml\nsteps:\n" + steps);
    flags.insert(flags.end(), {"--with", path, "--record", folder() / "recording"});
    return script(text, flags);
  }
};

constexpr const char* kMove =
    "P='$U poll '$UNDERSTUDY_PORT' --model simple2-r3'; eval $P Aaxis_SVON=1 && eval $P Aaxis_Pulse=3200 && "
    "eval $P Aaxis_Speed=200 && eval $P Aaxis_Move_INC=1";

TEST_F(ExecWith, LooksAtWhatTheCommandDoes) {
  // At 200 RPM, one revolution of 3200 pulses takes 300 ms. AccTime and DecTime of 0 count as 1 (10 ms),
  // which adds half of both.
  const Finished finished = with(
      "- never: feeder.A.pulses > 3200\n"
      "- wait: { until: feeder.Aaxis_SVON == 1, within: 60s }\n"
      "- wait: { until: feeder.STATUS.4 == 1, within: 60s }\n"
      "- wait: { until: feeder.STATUS.4 == 0, within: 5s, takes: 310ms +- 2ms }\n"
      "- assert: feeder.A.pulses == 3200\n",
      kMove);
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_NE(finished.errors.find("ok "), std::string::npos) << finished.errors;
}

TEST_F(ExecWith, FailsWhereTheScenarioDoes) {
  const Finished finished = with(
      "- never: feeder.A.pulses > 100\n- wait: { until: feeder.A.pulses > 0, within: 60s }\n- advance: 1s\n",
      kMove);
  EXPECT_EQ(finished.exit_code, 1);
  EXPECT_NE(finished.errors.find("beside.yaml:5"), std::string::npos) << finished.errors;
}

TEST_F(ExecWith, LetsTheCommandsExitCodeWin) {
  EXPECT_EQ(with("- assert: feeder.STATUS.4 == 1\n", "exit 9").exit_code, 9);
  EXPECT_EQ(with("- assert: feeder.STATUS.4 == 0\n", "exit 9").exit_code, 9);
}

TEST_F(ExecWith, GivesInputsAndFaults) {
  const Finished finished = with("- input: { feeder.DIN_3: on }\n",
                                 "for i in $(seq 300); do $U poll $UNDERSTUDY_PORT --model simple2-r3 DIN_3 "
                                 "| grep 1$ && break; sleep 0.1; done");
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_NE(finished.output.find("DIN_3 1\n"), std::string::npos) << finished.output;
}

TEST_F(ExecWith, IsGivenUpWithTheCommand) {
  const std::string long_wait = "- wait: { until: feeder.A.pulses == 1, within: 1000s }\n";
  const Finished late = with(long_wait, "sleep 60", {"--timeout", "300ms"});
  EXPECT_EQ(late.exit_code, 124);
  EXPECT_NE(late.errors.find("did not run to its end"), std::string::npos) << late.errors;
  EXPECT_EQ(with(long_wait, "kill -KILL $$").exit_code, 128 + 9);
  // The command succeeds, but nobody is left to advance time.
  EXPECT_EQ(with(long_wait, "true", {"--speed", "manual"}).exit_code, 1);
}

TEST_F(ExecWith, StopsTheCommandAndContinues) {
  const std::string stop = "- host: stop\n- advance: 10ms\n";
  const Finished passed = with(stop + "- assert: feeder.STATUS.4 == 0\n", "exec sleep 60");
  EXPECT_EQ(passed.exit_code, 0) << passed.errors;
  EXPECT_NE(passed.errors.find("ok "), std::string::npos) << passed.errors;
  const Finished failed = with(stop + "- assert: feeder.STATUS.4 == 1\n", "exec sleep 60");
  EXPECT_EQ(failed.exit_code, 1) << failed.errors;
  EXPECT_NE(failed.errors.find("'feeder.STATUS.4 == 1' does not hold"), std::string::npos) << failed.errors;
}

TEST_F(ExecWith, RefusesStepsThatAreTheCommands) {
  for (const char* step :
       {"- write: { feeder.Aaxis_SVON: 1 }", "- expect: { feeder.Cord_A: 0 }", "- send: { bytes: 01 03 }",
        "- wait: { until: feeder.STATUS.4 == 0, within: 4s, poll: 20ms }",
        "- fork: { one: [ { advance: 1ms } ] }"}) {
    const Finished finished = with(std::string("- advance: 1ms\n") + step + "\n", "echo ran");
    EXPECT_EQ(finished.exit_code, 2) << step << finished.errors;
    EXPECT_EQ(finished.output, "");
    EXPECT_EQ(lines_of(finished.errors).size(), 1U) << finished.errors;
    EXPECT_NE(finished.errors.find("beside.yaml:6: "), std::string::npos) << finished.errors;
  }
}

TEST_F(ExecWith, RefusesAScenarioOfAnotherBench) {
  folder().write("two.yaml", kTwo);
  const std::string path = folder().write(
      "other.yaml", "understudy: 1\nname: other\nbench: two.yaml\nsteps:\n- assert: turner.STATUS.4 == 0\n");
  const Finished finished = script("echo ran", {"--with", path});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_EQ(finished.output, "");
  EXPECT_NE(finished.errors.find("other.yaml: bench: "), std::string::npos) << finished.errors;
}

}  // namespace exec_test
}  // namespace understudy::acceptance
