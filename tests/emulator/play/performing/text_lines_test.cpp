// Steps with lines of text, in virtual time and over a real pty: the same verdicts.
#include <gtest/gtest.h>

#include "emulator/models/models.h"
#include "emulator/play/executors/real_executor.h"
#include "emulator/world/protocol/received_lines.h"
#include "tests/emulator/play/performing/played.h"
#include "tests/emulator/world/bench_file/without_columns.h"
#include "tests/emulator/world/stations/echo_box.h"

namespace understudy::emulator::play {
namespace text_lines_test {

using Strings = std::vector<std::string>;

std::string text_scenario(const std::string& steps, const std::string& timing = "wire") {
  return "understudy: 1\n"
         "name: test\n"
         "bench: { lines: { serial: { timing: " +
         timing + ", stations: [ { name: robot, model: echo-box, firmware: " +
         (steps.find("HELLO") == std::string::npos ? "1.01" : "1.00") + " } ] } } }\nsteps:\n" + steps;
}

struct Outcome {
  bool has_passed = false;
  std::string why;
};

Outcome play_text(const std::string& steps, bool is_real, const std::string& timing = "wire") {
  const Scenario scenario =
      parse_scenarios(world::models_and_echo_box(), text_scenario(steps, timing), "test.yaml").front();
  RunOptions options;
  if (is_real) options.make_executor = [](const Scenario& of) { return make_real_executor(of); };
  const ScenarioResult result = run_scenario(scenario, options).front();
  return {has_passed(result), result.failure ? result.failure->what : std::string()};
}

std::string refusal(const std::string& steps) {
  try {
    parse_scenarios(world::models_and_echo_box(), text_scenario(steps), "test.yaml");
  } catch (const FileError& error) {
    return world::without_columns(error.what());
  }
  return "";
}

TEST(ReceivedTextLines, EndWithEitherOrBoth) {
  EXPECT_EQ(world::lines_in("").lines, Strings{});
  EXPECT_EQ(world::lines_in("a\r\nb\rc\nd").lines, (Strings{"a", "b", "c", "d"}));
  EXPECT_EQ(world::lines_in("a\r\nb\rc\nd").finished, 3u);
  EXPECT_EQ(world::lines_in("a\r\nb\rc\nd").ends, (std::vector<std::size_t>{3, 5, 7}));
  EXPECT_EQ(world::lines_in("\r\n\r\n").lines, (Strings{"", ""}));
  EXPECT_EQ(world::lines_in("\na\n").lines, Strings{"a"});  // the LF belongs to the line before
}

const Strings kPassing{
    "  - send: { text: SAY a, reply: a }\n",
    "  - send: { line: serial, text: LIST 3, reply: [ line 1, line 2, line 3 ] }\n",
    "  - send: { text: N0=5, reply: nothing, within: 50ms }\n  - send: { text: \"?N0\", reply: \"5\" }\n",
    "  - send: { text: \"\", reply: ERR 1 }\n",
    // Without a reply, the device has received it when the step ends.
    "  - send: { text: N0=6 }\n  - expect: { robot.N0: 6, robot.R0: 0 +- 0.5 }\n  - assert: N0 == 6\n",
    "  - send: { text: R0=2.5 }\n  - wait: { until: robot.R0 == 2.5, within: 1s }\n",
    // Without a request, at its time; several lines that arrive at once are received one after another.
    "  - send: { text: AT 300 }\n  - hear: { text: TICK 300, within: 1s }\n  - assert: time >= 300ms\n",
    "  - send: { text: AT 200 }\n  - hear: { text: nothing, within: 50ms }\n",
    "  - send: { text: LIST 3 }\n  - advance: 100ms\n  - hear: { text: line 1 }\n"
    "  - hear: { text: [ line 2, line 3 ] }\n",
    // Text that nobody has received before the next line is sent is discarded.
    "  - send: { text: SAY a }\n  - advance: 100ms\n  - send: { text: SAY b, reply: b }\n",
    "  - send: { bytes: 1B, reply: 42 52 45 41 4B 0D 0A }\n",
    // An echo is part of the received text.
    "  - send: { text: ECHO=1 }\n  - send: { text: SAY a, reply: [ SAY a, a ] }\n",
    "  - advance: 50ms\n  - send: { text: SAY a, reply: a }\n  - power: { robot: cycle }\n  - hear: { text: "
    "HELLO }\n",
    "  - send: { text: AT 150 }\n  - send: { text: SAY b, reply: b }\n  - hear: { text: TICK 150, within: 1s "
    "}\n",
    "  - inject: { drop: robot, nth: 1 }\n  - send: { text: SAY a, reply: nothing, within: 100ms }\n"
    "  - send: { text: SAY b, reply: b }\n",
    "  - inject: { delay: robot, by: 200ms, nth: 1 }\n  - send: { text: SAY a, reply: nothing, within: 100ms "
    "}\n"
    "  - hear: { text: a, within: 1s }\n",
    "  - inject: { truncate: robot, keep: 5, of: request, nth: 1 }\n"
    "  - send: { text: SAY abc, reply: nothing, within: 100ms }\n  - send: { text: d, reply: ad }\n",
};

struct Failing {
  std::string steps;
  std::string what;
};
const std::vector<Failing> kFailing{
    {"  - send: { text: SAY a, reply: b }\n", "the reply is \"a\"; expected \"b\""},
    {"  - send: { text: LIST 3, reply: line 1 }\n",
     "the reply is \"line 1\", \"line 2\"; expected \"line 1\""},
    {"  - send: { text: LIST 1, reply: [ line 1, line 2 ], within: 100ms }\n",
     "the reply is \"line 1\"; expected \"line 1\", \"line 2\""},
    {"  - send: { text: N0=1, reply: OK, within: 100ms }\n", "the reply is nothing; expected \"OK\""},
    {"  - send: { text: SAY a, reply: nothing, within: 100ms }\n", "the reply is \"a\"; expected nothing"},
    {"  - hear: { text: HELLO, within: 100ms }\n  - hear: { text: a, within: 50ms }\n",
     "received nothing; expected \"a\""},
    {"  - send: { text: N0=6 }\n  - expect: { robot.N0: 7 }\n", "robot.N0 is 6; expected 7"},
};

TEST(TextSteps, HoldInFreeTime) {
  for (const char* timing : {"wire", "instant"}) {
    for (const std::string& steps : kPassing) {
      const Outcome outcome = play_text(steps, false, timing);
      EXPECT_TRUE(outcome.has_passed) << timing << "\n" << steps << outcome.why;
    }
  }
}

TEST(TextSteps, FailInFreeTimeWithWhatCame) {
  for (const Failing& wanted : kFailing) {
    const Outcome outcome = play_text(wanted.steps, false);
    EXPECT_FALSE(outcome.has_passed) << wanted.steps;
    EXPECT_EQ(outcome.why, wanted.what) << wanted.steps;
  }
}

/// Over a pty the wall clock counts: on a machine that pauses for a moment, a pause ends a reply, and a power
/// cut comes later in the text that is being sent. So a verdict that differs gets two more attempts.
Outcome play_really(const std::string& steps, const std::string& expected_why) {
  Outcome outcome;
  for (int attempt = 0; attempt < 3; ++attempt) {
    outcome = play_text(steps, true);
    if (outcome.why == expected_why) break;
  }
  return outcome;
}

TEST(TextSteps, HaveTheSameVerdictsOverARealPty) {
  for (const std::string& steps : kPassing) {
    const Outcome outcome = play_really(steps, "");
    EXPECT_TRUE(outcome.has_passed) << steps << outcome.why;
  }
  for (const Failing& wanted : kFailing) {
    const Outcome outcome = play_really(wanted.steps, wanted.what);
    EXPECT_FALSE(outcome.has_passed) << wanted.steps;
    EXPECT_EQ(outcome.why, wanted.what) << wanted.steps;
  }
}

TEST(TextSteps, TakesRunsFromTheLineThatWasReceived) {
  // "AT 300" and its CR are seven characters: received at 7.29 ms, so from tick 8 on.
  const std::string steps =
      "  - send: { text: AT 300 }\n"
      "  - wait: { until: time >= 300ms, within: 1s, takes: 292ms }\n";
  const Outcome outcome = play_text(steps, false);
  EXPECT_TRUE(outcome.has_passed) << outcome.why;
}

TEST(TextSteps, ForksContinueFromWhatWasReceived) {
  const Outcome outcome = play_text(
      "  - send: { text: LIST 2 }\n  - advance: 100ms\n  - snapshot: heard\n  - hear: { text: line 1 }\n"
      "  - restore: heard\n  - hear: { text: [ line 1, line 2 ] }\n",
      false);
  EXPECT_TRUE(outcome.has_passed) << outcome.why;
}

TEST(TextSteps, WhatTheyCannotSayIsReportedBeforehand) {
  EXPECT_EQ(refusal("  - send: { text: a, bytes: 01 }\n"),
            "test.yaml:5: steps[0].send.bytes: is not a key here; expected one of line, text, reply, within");
  EXPECT_EQ(refusal("  - send: { text: \"a\\rb\" }\n"),
            "test.yaml:5: steps[0].send.text: has several lines; expected one line, without its end");
  EXPECT_EQ(refusal("  - hear: { within: 1s }\n").substr(0, 28), "test.yaml:5: steps[0].hear: ");
  EXPECT_EQ(refusal("  - hear: { text: a, within: 0s }\n"),
            "test.yaml:5: steps[0].hear.within: takes no time; expected a duration above 0");
  EXPECT_NE(refusal("  - write: { robot.N0: 1 }\n").find("is not a register"), std::string::npos);
  EXPECT_NE(refusal("  - expect: { robot.N1: 1 }\n").find("robot has no value called 'N1'"),
            std::string::npos);
  const std::string modbus =
      "understudy: 1\nbench: { lines: { a: { stations: [ { name: f, model: simple2-r3 } ] } } }\nsteps:\n"
      "  - send: { text: a }\n";
  try {
    parse_scenarios(models::all_models(), modbus, "test.yaml");
    ADD_FAILURE();
  } catch (const FileError& error) {
    EXPECT_EQ(
        world::without_columns(error.what()),
        "test.yaml:4: steps[0].send: line 'a' carries Modbus frames; expected a line that carries text, or "
        "`bytes`");
  }
}

}  // namespace text_lines_test
}  // namespace understudy::emulator::play
