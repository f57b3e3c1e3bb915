// `understudy run --on`: the model's own stop goes out first, however the run ends, and whatever it waits
// for.
#include <gtest/gtest.h>
#include <signal.h>

#include <string>
#include <vector>

#include "tests/acceptance/at_terminal.h"
#include "tests/acceptance/counting_box.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace on_stop_test {

constexpr int kMove = 0x1005;
constexpr int kAllStop = 0x100D;
const std::string kDrive = std::string(PROJECT_FOLDER) + "/examples/import/";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A move, and then these steps.
std::string moving(const PrivateFolder& folder, const std::string& steps) {
  return folder.write("case.yaml",
                      "understudy: 1\nbench:\n  lines:\n    line:\n      stations:\n"
                      "        - { name: box, model: simple2-r3 }\nsteps:\n"
                      "  - write: { box.Aaxis_Move_INC: 1 }\n" +
                          steps);
}

Words run_on(const std::string& file, const CountingBox& box, const Words& flags = {}) {
  Words words{UNDERSTUDY_BINARY, "run", file, "--on", "line=" + box.path(), "--allow-motion"};
  words.insert(words.end(), flags.begin(), flags.end());
  return words;
}

TEST(RunOnStops, AtEverySignalThatEndsPrograms) {
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGQUIT}) {
    const PrivateFolder folder;
    const CountingBox box;
    Process process(run_on(moving(folder, "  - advance: 60s\n"), box));
    ASSERT_TRUE(eventually([&] { return box.writes_to(kMove) == 1; }));
    process.send(signal_number);
    EXPECT_EQ(process.wait(kPatience), 1) << signal_number;
    EXPECT_GE(box.writes_to(kAllStop), 1) << signal_number;
    EXPECT_TRUE(has(process.errors(), "stop: box: ALL_STOP = 1: done")) << process.errors();
  }
}

/// A program that sleeps cannot stop anything.
TEST(RunOnStops, RefusesToSleep) {
  const PrivateFolder folder;
  const CountingBox box;
  AtTerminal terminal(run_on(moving(folder, "  - advance: 60s\n"), box));
  ASSERT_TRUE(eventually([&] { return box.writes_to(kMove) == 1; }));
  terminal.type("\x1a");
  EXPECT_TRUE(terminal.shows("Ctrl-Z is refused, because the machine may move; Ctrl-C stops it"));
  EXPECT_EQ(box.writes_to(kAllStop), 0);
  terminal.type("\x1c");
  EXPECT_TRUE(terminal.shows("stop: box: ALL_STOP = 1: done"));
  EXPECT_EQ(terminal.wait(kPatience), 1);
}

TEST(RunOnStops, WhileItWaitsForAReply) {
  const PrivateFolder folder;
  const CountingBox box;
  Process process(run_on(
      moving(folder, "  - send: { bytes: 05 03 00 00 00 01 +crc, reply: nothing, within: 60s }\n"), box));
  ASSERT_TRUE(eventually([&] { return box.writes_to(kMove) == 1; }));
  process.send(SIGTERM);
  EXPECT_EQ(process.wait(kPatience), 1);
  EXPECT_GE(box.writes_to(kAllStop), 1);
}

TEST(RunOnStops, WhileAQuestionStands) {
  enum class End { interrupt, hang_up };
  for (const End end : {End::interrupt, End::hang_up}) {
    const PrivateFolder folder;
    const CountingBox box;
    {
      AtTerminal terminal(run_on(moving(folder, "  - input: { box.DIN_2: on }\n"), box, {"--ask"}));
      ASSERT_TRUE(terminal.shows("please do this: input box.DIN_2 on; then press Enter"));
      EXPECT_EQ(box.writes_to(kMove), 1);
      EXPECT_EQ(box.writes_to(kAllStop), 0);
      if (end == End::interrupt) {
        terminal.type("\x03");
        EXPECT_TRUE(terminal.shows("stop: box: ALL_STOP = 1: done"));
        EXPECT_EQ(terminal.wait(kPatience), 1);
      }
    }
    EXPECT_TRUE(eventually([&] { return box.writes_to(kAllStop) >= 1; }));
  }
}

TEST(RunOnStops, WhileARigWorks) {
  const PrivateFolder folder;
  const CountingBox box;
  const std::string rig = folder.write("rig.sh", "case $1 in\ninput) echo > " + (folder / "works") +
                                                     "; exec sleep 600;;\n*) exit 3;;\nesac\n");
  Process process(run_on(moving(folder, "  - input: { box.DIN_2: on }\n"), box, {"--rig", "exec sh " + rig}));
  ASSERT_TRUE(eventually([&] { return std::filesystem::exists(folder / "works"); }));
  process.send(SIGTERM);
  EXPECT_EQ(process.wait(kPatience), 1);
  EXPECT_GE(box.writes_to(kAllStop), 1);
}

TEST(RunOnStops, TakesAnswersAtATerminal) {
  const PrivateFolder folder;
  const CountingBox box;
  AtTerminal terminal(run_on(moving(folder, "  - input: { box.DIN_2: on }\n  - input: { box.DIN_2: off }\n"),
                             box, {"--ask"}));
  ASSERT_TRUE(terminal.shows("please do this: input box.DIN_2 on"));
  terminal.type("\n");
  ASSERT_TRUE(terminal.shows("please do this: input box.DIN_2 off"));
  terminal.type("s\n");
  EXPECT_TRUE(terminal.shows("nobody did it: input box.DIN_2 off"));
  EXPECT_EQ(terminal.wait(kPatience), 0);
}

/// While a macro is being entered, an RS-M8194H refuses the stop, so the macro is closed first.
TEST(RunOnStops, AnRsM8194hWhoseMacroIsOpen) {
  const PrivateFolder folder;
  const auto served = RunningUnderstudy::of_bench(
      "understudy: 1\nlines:\n  line:\n    link: port\n    stations:\n      - { name: box, model: rs-m8194h "
      "}\n");
  const auto errors_of = [&](const std::string& steps) {
    const std::string file =
        folder.write("case.yaml",
                     "understudy: 1\nbench:\n  lines:\n    line:\n      stations:\n        - { name: box, "
                     "model: rs-m8194h }\n"
                     "steps:\n" +
                         steps + "  - command: { box: RSM_FIXED_MOVE X 0 }\n  - assert: box.LP_X == 1\n");
    return understudy({"run", file, "--on", "line=" + served->port(), "--allow-motion"}).errors;
  };
  EXPECT_EQ(errors_of(""), "stop: box: RSM_EMERGENCY_STOP 0: done\n");
  for (const char* const create : {"RSM_MP_CREATE 1", "RSM_MP_ISR_CREATE 1"}) {
    const std::string errors = errors_of(std::string("  - command: { box: ") + create + " }\n");
    EXPECT_TRUE(has(errors, "stop: box: RSM_EMERGENCY_STOP 0: REFUSED\n")) << create << errors;
    EXPECT_TRUE(errors.ends_with("stop: box: RSM_EMERGENCY_STOP 0: done\n")) << create << errors;
  }
}

/// A bit of the stop changes nothing else in its register.
TEST(RunOnStops, AModelThatAFileDescribes) {
  const PrivateFolder folder;
  const auto served = RunningUnderstudy::of_bench(
      "understudy: 1\nlines:\n  line:\n    link: port\n    stations:\n      - { name: drive, model: " +
      kDrive + "drive.yaml }\n");
  const std::string file = folder.write(
      "case.yaml",
      "understudy: 1\nbench:\n  lines:\n    line:\n      stations:\n        - { name: drive, model: " +
          kDrive +
          "drive.yaml }\nsteps:\n"
          "  - write: { drive.CONTROL.ENABLE: 1, drive.TARGET: 20000, drive.SPEED: 20 }\n"
          "  - write: { drive.CONTROL.START: 1 }\n"
          "  - wait: { until: drive.STATUS.BUSY == 1, within: 5s }\n"
          "  - expect: { drive.CONTROL: 0 }\n");
  const Finished on = understudy({"run", file, "--on", "line=" + served->port(), "--allow-motion"});
  EXPECT_EQ(on.exit_code, 1) << on.output << on.errors;
  EXPECT_TRUE(has(on.errors, "stop: drive: CONTROL.STOP = 1: done")) << on.errors;
  EXPECT_TRUE(eventually([&] { return has(served->ctl({"get", "STATUS.BUSY"}).output, "0"); }));
  EXPECT_TRUE(has(served->ctl({"get", "CONTROL.ENABLE"}).output, "1"));
}

TEST(RunOnStops, SaysThatAModelHasNoStop) {
  const PrivateFolder folder;
  const auto served = RunningUnderstudy::of_bench(
      "understudy: 1\nlines:\n  line:\n    link: port\n    stations:\n      - { name: oven, model: " +
      kDrive + "oven.yaml }\n");
  const std::string file = folder.write(
      "case.yaml",
      "understudy: 1\nbench:\n  lines:\n    line:\n      stations:\n        - { name: oven, model: " +
          kDrive + "oven.yaml }\nsteps:\n  - send: { bytes: 01 06 00 00 00 01 +crc }\n");
  const Finished on = understudy({"run", file, "--on", "line=" + served->port(), "--allow-motion"});
  EXPECT_EQ(on.exit_code, 0) << on.output << on.errors;
  EXPECT_TRUE(has(on.errors, "stop: oven: NOT SENT: oven-controller has no stop over the line")) << on.errors;
}

}  // namespace on_stop_test
}  // namespace understudy::acceptance
