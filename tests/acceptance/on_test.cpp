// `understudy run --on`: scenarios with a real controller at the end of the line. `serve` is the controller,
// or a box that counts what it is asked for.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/acceptance/counting_box.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace on_test {

constexpr int kPulse = 0x1000;
constexpr int kMove = 0x1005;
constexpr int kAllStop = 0x100D;

std::string scenario(const std::string& steps, const std::string& model = "simple2-r3") {
  return "understudy: 1\nbench:\n  lines:\n    line:\n      stations:\n        - { name: box, model: " +
         model + " }\nsteps:\n" + steps;
}

Finished run_on(const PrivateFolder& folder, const std::string& text, const std::string& port,
                const Words& flags = {}) {
  Words words{"run", folder.write("case.yaml", text), "--on", "line=" + port};
  words.insert(words.end(), flags.begin(), flags.end());
  return understudy(words);
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

const std::string kMoveSteps =
    "  - write: { box.Aaxis_SVON: 1, box.Aaxis_Pulse: 3200, box.Aaxis_Speed: 60, box.Aaxis_AccTime: 1 }\n"
    "  - write: { box.Aaxis_Move_INC: 1 }\n"
    "  - wait: { until: box.STATUS.4 == 1, within: 1s }\n";

TEST(RunOn, PassesAsInSimulatedTime) {
  const PrivateFolder folder;
  const RunningUnderstudy served;
  const std::string text = scenario(kMoveSteps +
                                    "  - wait: { until: box.STATUS.4 == 0, within: 5s, takes: 500ms..3s }\n"
                                    "  - expect: { box.Cord_A: 3200 }\n"
                                    "  - assert: box.Cord_A == 3200 and box.Aaxis_Speed == 60\n");
  const Finished simulated = understudy({"run", folder.write("simulated.yaml", text)});
  EXPECT_EQ(simulated.exit_code, 0) << simulated.output << simulated.errors;
  const Finished on = run_on(folder, text, served.port(), {"--allow-motion"});
  EXPECT_EQ(on.exit_code, 0) << on.output << on.errors;
  EXPECT_TRUE(has(on.output, "1 passed, 0 failed;")) << on.output;
}

TEST(RunOn, FailsWhereTheControllerIsAnother) {
  const PrivateFolder folder;
  const auto served = RunningUnderstudy::of_bench(
      "understudy: 1\nlines:\n  line:\n    link: port\n    stations:\n"
      "      - { name: hidden, model: simple2-r3, choices: { version_encoding: bcd } }\n");
  const Finished on =
      run_on(folder, scenario("  - expect: { box.Version: 152, box.HW_Code: 0xC001 }\n"), served->port());
  EXPECT_EQ(on.exit_code, 1);
  EXPECT_TRUE(has(on.output, "box.Version is 338; expected 152")) << on.output;
}

TEST(RunOn, SendsOnlyReadsWithoutPermission) {
  const PrivateFolder folder;
  const CountingBox box;
  const Finished on = run_on(folder, scenario("  - assert: box.Cord_A == 0\n" + kMoveSteps), box.path());
  EXPECT_EQ(on.exit_code, 0) << on.output << on.errors;
  EXPECT_GT(box.reads(), 0);
  EXPECT_EQ(box.writes(), 0);
  EXPECT_TRUE(has(on.output, "can move an axis; it is sent only with --allow-motion")) << on.output;
}

TEST(RunOn, SendsNoMotionWithoutItsPermission) {
  const PrivateFolder folder;
  const CountingBox box;
  const std::string text = scenario(
      "  - write: { box.Aaxis_Pulse: 100 }\n"
      "  - expect: { box.HW_Code: 0 }\n"
      "  - write: { box.Aaxis_Move_INC: 1 }\n"
      "  - expect: { box.HW_Code: 1 }\n");
  const Finished on =
      run_on(folder, text, box.path(), {"--allow-writes", "--allow-memory", "--allow-outputs"});
  EXPECT_EQ(on.exit_code, 0) << on.output << on.errors;
  EXPECT_EQ(box.writes_to(kPulse), 1);
  EXPECT_EQ(box.writes_to(kMove), 0);
  EXPECT_EQ(box.writes(), 1);
  EXPECT_TRUE(has(on.output, "2 steps skipped")) << on.output;
}

TEST(RunOn, CallsAScenarioOfWhichNothingIsLeftNotTellable) {
  const PrivateFolder folder;
  const CountingBox box;
  const Finished on =
      run_on(folder, scenario("  - input: { box.DIN_2: on }\n  - expect: { box.DIN_2: 1 }\n"), box.path());
  EXPECT_EQ(on.exit_code, 0) << on.output << on.errors;
  EXPECT_TRUE(has(on.output, "0 passed, 0 failed, 1 not tellable")) << on.output;
  EXPECT_TRUE(has(on.output, "expected --rig COMMAND or --ask")) << on.output;
}

TEST(RunOn, SendsNothingBeyondTheEnvelope) {
  const PrivateFolder folder;
  const CountingBox box;
  const std::string limits = folder.write("limits.yaml",
                                          "understudy: 1\nlimits:\n  Aaxis_Pulse: -3200..3200\n"
                                          "  \"*_Speed\": 0..60\n");
  const Finished on = run_on(folder, scenario("  - write: { box.Aaxis_Pulse: 5000 }\n"), box.path(),
                             {"--allow-motion", "--envelope", limits});
  EXPECT_EQ(on.exit_code, 1);
  EXPECT_TRUE(has(on.output, "not sent, because Aaxis_Pulse = 5000 is beyond " + limits +
                                 ":3; "
                                 "expected -3200..3200"))
      << on.output;
  EXPECT_EQ(box.writes(), 0);
}

TEST(RunOn, PlansEveryRequestAndSendsNothing) {
  const PrivateFolder folder;
  const CountingBox box;
  const Finished on = run_on(folder, scenario(kMoveSteps), box.path(), {"--allow-motion", "--plan"});
  EXPECT_EQ(on.exit_code, 0) << on.errors;
  EXPECT_TRUE(has(on.output, "box.Aaxis_Move_INC = 1  [settings motion]")) << on.output;
  EXPECT_EQ(box.reads() + box.writes(), 0);
}

TEST(RunOn, StopsFirstWhenItFails) {
  const PrivateFolder folder;
  const CountingBox box;
  const Finished on =
      run_on(folder, scenario("  - write: { box.Aaxis_Move_INC: 1 }\n  - expect: { box.HW_Code: 7 }\n"),
             box.path(), {"--allow-motion"});
  EXPECT_EQ(on.exit_code, 1);
  EXPECT_EQ(box.writes_to(kMove), 1);
  EXPECT_GE(box.writes_to(kAllStop), 1);
  EXPECT_TRUE(has(on.errors, "stop: box: ALL_STOP = 1: done")) << on.errors;
}

TEST(RunOn, LetsARigDoWhatNeedsTheMachine) {
  const PrivateFolder folder;
  const RunningUnderstudy served;
  const std::string rig = folder.write("rig.sh",
                                       "case $1 in\n"
                                       "input) echo \"$@\" >> " +
                                           (folder / "calls") +
                                           "; exit 0;;\n"
                                           "*) exit 3;;\nesac\n");
  const Finished on =
      run_on(folder, scenario("  - input: { box.DIN_2: on }\n  - expect: { box.HW_Code: 0xC001 }\n"),
             served.port(), {"--rig", "sh " + rig});
  EXPECT_EQ(on.exit_code, 0) << on.output << on.errors;
  EXPECT_EQ(run({"cat", folder / "calls"}).output, "input box.DIN_2 on\n");
}

TEST(RunOn, TakesLinesOfTextAsQueries) {
  const PrivateFolder folder;
  const auto served = RunningUnderstudy::of_model("slim");
  const std::string text = scenario(
      "  - send: { line: line, text: \"CS 0\" }\n"
      "  - send: { line: line, text: \"MA 100\" }\n"
      "  - wait: { until: box.PE == 100, within: 5s }\n"
      "  - send: { line: line, text: \"?PE\", reply: \"100\" }\n",
      "slim");
  const Finished on = run_on(folder, text, served->port(), {"--allow-motion"});
  EXPECT_EQ(on.exit_code, 0) << on.output << on.errors;
  EXPECT_TRUE(has(on.output, "1 passed")) << on.output;
}

/// A query, or a stop, would become a line of the program.
TEST(RunOn, AsksNothingWhileAProgramIsEntered) {
  const PrivateFolder folder;
  const auto served = RunningUnderstudy::of_model("slim");
  const std::string text = scenario(
      "  - send: { line: line, text: \"CS 0\" }\n"
      "  - send: { line: line, text: \"PG\" }\n"
      "  - send: { line: line, text: \"MA 7\" }\n"
      "  - assert: box.PE == 0\n",
      "slim");
  const Finished on = run_on(folder, text, served->port(), {"--allow-motion"});
  EXPECT_EQ(on.exit_code, 0) << on.output << on.errors;
  EXPECT_TRUE(has(on.output, "a program is being entered on line line")) << on.output;
  EXPECT_TRUE(has(on.errors, "stop: box: TASTOP: sent")) << on.errors;
  const std::string program = served->ctl({"program"}).output;
  EXPECT_TRUE(has(program, "MA 7")) << program;
  EXPECT_FALSE(has(program, "?PE") || has(program, "TASTOP")) << program;
}

TEST(RunOn, TakesFurtherStepsInADialogue) {
  const PrivateFolder folder;
  const RunningUnderstudy served;
  const std::string file = folder.write("case.yaml", scenario("  - say: begins\n"));
  const std::string speed = served.ctl({"get", "Aaxis_Speed"}).output;
  const std::string messages = folder.write("messages",
                                            R"({"values": ["box.HW_Code"]}
{"step": {"expect": {"box.HW_Code": 1}}}
{"step": {"write": {"box.Aaxis_Speed": 60}}}
{"step": {"jump": 1}}
[]
)");
  const Finished on = run({"sh", "-c",
                           std::string(UNDERSTUDY_BINARY) + " run " + file + " --on line=" + served.port() +
                               " --dialogue < " + messages});
  EXPECT_EQ(on.exit_code, 0) << on.output << on.errors;
  const std::vector<std::string> lines = lines_of(on.output);
  ASSERT_GE(lines.size(), 5U) << on.output << on.errors;
  EXPECT_TRUE(has(lines[0], R"("values":{"box.HW_Code":49153})")) << on.output;
  EXPECT_TRUE(has(lines[1], R"("kind":"failed","error":"box.HW_Code is 49153; expected 1)")) << on.output;
  EXPECT_TRUE(has(lines[2], R"("kind":"skipped","error":)")) << on.output;
  EXPECT_TRUE(has(lines[3], R"("kind":"refused","error":"standard input)")) << on.output;
  EXPECT_TRUE(has(lines[4], R"("kind":"refused","error":"a message is not valid)")) << on.output;
  EXPECT_EQ(served.ctl({"get", "Aaxis_Speed"}).output, speed);
}

TEST(RunOn, SaysWhatWasTriedIfNothingAnswers) {
  const PrivateFolder folder;
  const RunningUnderstudy served;
  const Finished on = run_on(folder, scenario("  - expect: { box.HW_Code: 1 }\n"), served.port() + ",9600",
                             {"--reply-timeout", "20ms"});
  EXPECT_EQ(on.exit_code, 3);
  EXPECT_TRUE(has(on.errors, "station 1 did not answer at 9600 8E1")) << on.errors;
}

TEST(RunOn, RefusesALineThatNoBenchHas) {
  const PrivateFolder folder;
  const CountingBox box;
  const std::string file = folder.write("case.yaml", scenario("  - expect: { box.HW_Code: 0 }\n"));
  const Finished on = understudy({"run", file, "--on", "line=" + box.path(), "--on", "lime=" + box.path()});
  EXPECT_EQ(on.exit_code, 2) << on.output;
  EXPECT_TRUE(has(on.errors, "--on: no bench has a line called 'lime'; expected one of line")) << on.errors;
  EXPECT_EQ(box.reads(), 0);
}

TEST(RunOn, PlansWhatFollowsARequestThatIsNotAllowed) {
  const PrivateFolder folder;
  const CountingBox box;
  const std::string text = scenario(
      "  - write: { box.Aaxis_Pulse: 100 }\n"
      "  - write: { box.Aaxis_Move_INC: 1 }\n"
      "  - write: { box.Aaxis_Pulse: 200 }\n"
      "  - input: { box.DIN_2: on }\n"
      "  - expect: { box.HW_Code: 0 }\n");
  const Finished on = run_on(folder, text, box.path(), {"--allow-writes", "--plan"});
  EXPECT_EQ(on.exit_code, 0) << on.errors;
  std::size_t at = 0;
  for (const char* const part :
       {"box.Aaxis_Pulse = 100  [settings]\n", "box.Aaxis_Move_INC = 1  [settings motion]  NOT SENT: needs ",
        "box.Aaxis_Pulse = 200  [settings]  NOT SENT: follows",
        "you: input box.DIN_2 on  NOT DONE: needs --rig", "HW_Code  NOT SENT: follows"}) {
    const std::size_t found = on.output.find(part, at);
    ASSERT_NE(found, std::string::npos) << part << "\n" << on.output;
    at = found;
  }
  EXPECT_EQ(box.reads() + box.writes(), 0);
}

/// The reply of the first scenario has 37 bytes; it expects 5 of them.
TEST(RunOn, KeepsTheRestOfAReplyOutOfTheNextOne) {
  const PrivateFolder folder;
  const RunningUnderstudy served;
  const std::string longer = folder.write(
      "longer.yaml", scenario("  - send: { bytes: 01 03 10 00 00 10 +crc, reply: 01 83 02 +crc }\n"));
  const std::string next = folder.write("next.yaml", scenario("  - expect: { box.HW_Code: 0xC001 }\n"));
  for (int i = 0; i < 3; ++i) {
    const Finished on = understudy({"run", longer, next, "--on", "line=" + served.port()});
    EXPECT_TRUE(has(on.output, "1 passed, 1 failed")) << on.output << on.errors;
  }
}

TEST(RunOn, KeepsTheRestOfAListingOutOfTheNextAnswer) {
  const PrivateFolder folder;
  std::string program;
  for (int i = 0; i < 40; ++i) program += "N" + std::to_string(i) + "=" + std::to_string(i) + "\n";
  const auto served = RunningUnderstudy::of_bench(
      "understudy: 1\nlines:\n  line:\n    link: port\n    stations:\n"
      "      - { name: box, model: slim, program: " +
      folder.write("long.slim", program) + " }\n");
  const std::string listing =
      folder.write("listing.yaml", scenario("  - send: { text: \"ULP\", reply: \"x\" }\n", "slim"));
  const std::string next =
      folder.write("next.yaml", scenario("  - send: { text: \"?PE\", reply: \"0\" }\n", "slim"));
  for (int i = 0; i < 3; ++i) {
    const Finished on = understudy({"run", listing, next, "--on", "line=" + served->port()});
    EXPECT_TRUE(has(on.output, "1 passed, 1 failed")) << on.output << on.errors;
  }
}

TEST(RunOn, AsksForTheOrderOfWords) {
  const PrivateFolder folder;
  const auto served = RunningUnderstudy::of_bench(
      "understudy: 1\nlines:\n  line:\n    link: port\n    stations:\n"
      "      - { name: hidden, model: rs-m8194h, set: { WORD_ORDER: 1, VAR0: 70000 } }\n");
  const std::string text = scenario(
      "  - expect: { box.VAR0: 70000 }\n"
      "  - command: { box: RSM_SERVO_ON X }\n"
      "  - command: { box: RSM_SET_SV X 1000 }\n"
      "  - command: { box: RSM_SET_V X 1000 }\n"
      "  - command: { box: RSM_FIXED_MOVE X 900 }\n"
      "  - wait: { until: box.LP_X == 900, within: 10s }\n",
      "rs-m8194h");
  const Finished on = run_on(folder, text, served->port(), {"--allow-motion"});
  EXPECT_EQ(on.exit_code, 0) << on.output << on.errors;
}

TEST(RunOn, HasNoHashInItsResults) {
  const PrivateFolder folder;
  const CountingBox box;
  const Finished on = run_on(folder, scenario("  - expect: { box.HW_Code: 0 }\n"), box.path(),
                             {"--results", folder / "results.jsonl"});
  EXPECT_EQ(on.exit_code, 0) << on.output << on.errors;
  const std::string rows = run({"cat", folder / "results.jsonl"}).output;
  EXPECT_TRUE(has(rows, "\"verdict\"")) << rows;
  EXPECT_FALSE(has(rows, "0000000000000000")) << rows;
}

TEST(RunOn, ReportsTheSkippedStepsOfVariedCases) {
  const PrivateFolder folder;
  const CountingBox box;
  const std::string steps =
      scenario("  - expect: { box.HW_Code: 0 }\n  - write: { box.Aaxis_Pulse: \"${n}\" }\n");
  const std::string text = "understudy: 1\nvary: { n: [ 1, 2, 3 ] }\n" + steps.substr(steps.find("bench:"));
  const std::string junit = folder / "results.xml";
  const Finished on = run_on(folder, text, box.path(), {"--junit", junit});
  EXPECT_EQ(on.exit_code, 0) << on.errors;
  EXPECT_TRUE(has(on.output, "skipped in 3 of the cases: ")) << on.output;
  EXPECT_TRUE(has(on.output, "only with --allow-writes")) << on.output;
  std::ifstream file(junit);
  const std::string results{std::istreambuf_iterator<char>(file), {}};
  EXPECT_TRUE(has(results, "<system-out>skipped: ")) << results;
}

TEST(RunOn, ReusesOnlyRowsOfTheSameControllerAndPermissions) {
  const PrivateFolder folder;
  const CountingBox box;
  const std::string text = scenario("  - write: { box.Aaxis_Pulse: 100 }\n");
  const std::string rows = folder / "rows.jsonl";
  const std::string file = folder.write("box.yaml", text);
  const auto reuses = [&](const Words& flags) {
    Words words{"run", file, "--results", rows, "--resume"};
    words.insert(words.end(), flags.begin(), flags.end());
    const Finished finished = understudy(words);
    EXPECT_EQ(finished.exit_code, 0) << finished.errors;
    return has(finished.output, "1 skipped, because they ran earlier");
  };
  const Words on{"--on", "line=" + box.path()};
  const Words may_write{"--on", "line=" + box.path(), "--allow-writes"};
  EXPECT_FALSE(reuses({}));
  EXPECT_TRUE(reuses({}));
  EXPECT_FALSE(reuses({"--real-time"}));
  EXPECT_FALSE(reuses(on));
  EXPECT_TRUE(reuses(on));
  EXPECT_FALSE(reuses(may_write));
  EXPECT_TRUE(reuses(may_write));
  EXPECT_EQ(box.writes_to(0x1000), 1);
}

TEST(RunOn, RefusesFlagsThatNeedTruths) {
  const PrivateFolder folder;
  const Finished on = run_on(folder, scenario("  - say: nothing\n"), "/dev/null", {"--lint"});
  EXPECT_EQ(on.exit_code, 2);
  EXPECT_TRUE(has(on.errors, "--lint: needs the internal state of a simulated controller")) << on.errors;
}

}  // namespace on_test
}  // namespace understudy::acceptance
