// Scenarios of a device on two lines: `via`, in virtual time and over real ports.
#include <gtest/gtest.h>

#include "emulator/play/executors/real_executor.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/play/results/result_text.h"
#include "tests/emulator/workbench/two_lines.h"

namespace understudy::emulator::workbench {
namespace ports_scenario_test {

/// The list of steps starts at line 10.
std::string scenario_text(const std::string& steps) {
  return "understudy: 1\nname: test\nbench:\n  lines:\n"
         "    pc: { timing: instant, stations: [ { device: mill, port: PC }, { device: lathe, address: 2 } ] "
         "}\n"
         "    hmi: { timing: instant, stations: [ { device: mill, port: HMI } ] }\n"
         "  devices: { mill: { model: workbench }, lathe: { model: workbench } }\n"
         "  # nothing\nsteps:\n" +
         steps;
}

std::vector<play::Scenario> read(const std::string& steps) {
  return play::parse_scenarios(kWorkbenchModels, scenario_text(steps), "test.yaml");
}

std::string diagnostic_of(const std::string& steps) {
  try {
    read(steps);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "none";
}

/// Empty if it passes.
std::string failure_of(const std::string& steps, const play::RunOptions& options = {}) {
  std::string text;
  for (const play::Scenario& scenario : read(steps)) {
    for (const play::ScenarioResult& result : play::run_scenario(scenario, options)) {
      for (const std::string& line : play::failure_lines(result)) text += line + "\n";
    }
  }
  return text;
}

const std::string kBothLines =
    "  - write: { mill.D0: 5 }\n    via: hmi\n"
    "  - expect: { mill.D0: 5 }\n    via: pc\n"
    "  - write: { mill.D0: 6, lathe.D0: 7 }\n"
    "  - expect: { mill.D0: 6 }\n    via: hmi\n"
    "  - expect: { lathe.D0: 7 }\n    via: pc\n"
    "  - wait: { until: mill.D0 == 6, within: 1s, poll: 20ms, via: hmi }\n"
    "  - write: { mill.Speed_X: 9999 }\n    exception: 3\n    via: hmi\n"
    "  - send: { line: hmi, bytes: 01 03 00 64 00 01 +crc, reply: 01 03 02 00 06 +crc }\n"
    "  - assert: [ mill.requests == 7, lathe.requests == 2 ]\n"
    // Its number is a register, and steps follow it.
    "  - write: { mill.Station: 9 }\n    via: hmi\n"
    "  - expect: { mill.Station: 9 }\n"
    "  - expect: { mill.Station: 9 }\n    via: hmi\n"
    "  - inject: { drop: hmi, name: gone }\n"
    "  - expect: { mill.D0: 6 }\n    reply: nothing\n    within: 50ms\n    via: hmi\n"
    "  - expect: { mill.D0: 6 }\n    via: pc\n"
    "  - clear: gone\n"
    "  - power: { mill: off }\n"
    "  - expect: { mill.D0: 6 }\n    reply: nothing\n    within: 50ms\n    via: hmi\n"
    "  - expect: { mill.D0: 6 }\n    reply: nothing\n    within: 50ms\n    via: pc\n";

TEST(Via, ChoosesTheLineOfAStep) { EXPECT_EQ(failure_of(kBothLines), ""); }

TEST(Via, ChoosesThePortInRealTimeToo) {
  EXPECT_EQ(failure_of(kBothLines, {.make_executor = play::make_real_executor}), "");
}

TEST(Via, IsReportedInTheStepAndItsFailure) {
  EXPECT_EQ(read("  - write: { mill.D0: 5 }\n    via: hmi\n").front().steps.front().text,
            "write mill.D0=5 via hmi");
  EXPECT_EQ(
      read("  - wait: { until: mill.D0 == 6, within: 1s, poll: 20ms, via: hmi }\n").front().steps[0].text,
      "wait until mill.D0 == 6 within 1s, polled every 20ms via hmi");
  const std::string dropped =
      failure_of("  - inject: { drop: hmi }\n  - write: { mill.D0: 5 }\n    via: hmi\n");
  EXPECT_NE(dropped.find("write mill.D0 on line hmi: no reply; expected success"), std::string::npos)
      << dropped;
  const std::string usual = failure_of("  - inject: { drop: pc }\n  - expect: { mill.D0: 0 }\n");
  EXPECT_NE(usual.find("read mill.D0 on line pc: no reply; expected success"), std::string::npos) << usual;
  const std::string alone = failure_of("  - inject: { drop: pc }\n  - expect: { lathe.D0: 0 }\n");
  EXPECT_NE(alone.find("read lathe.D0: no reply; expected success"), std::string::npos) << alone;
}

TEST(Via, IsRefusedWhereItCannotBe) {
  const std::pair<std::string, std::string> cases[] = {
      {"  - write: { mill.D0: 5 }\n    via: usb\n",
       "test.yaml:11:10: steps[0].via: no line is called 'usb'; expected one of pc, hmi"},
      {"  - expect: { mill.D0: 5, lathe.D0: 1 }\n    via: hmi\n",
       "test.yaml:11:10: steps[0].via: lathe is not on line 'hmi'; expected pc"},
      {"  - wait: { until: mill.D0 == lathe.D0, within: 1s, poll: 20ms, via: hmi }\n",
       "test.yaml:10:70: steps[0].wait.via: lathe is not on line 'hmi'; expected pc"},
      {"  - wait: { until: mill.D0 == 1, within: 1s, via: hmi }\n",
       "test.yaml:10:51: steps[0].wait.via: has no effect without `poll`, because only `poll` reads over a "
       "line; expected both"},
      {"  - advance: 1ms\n    via: hmi\n",
       "test.yaml:11:10: steps[0].via: is not a key here; expected one of advance"},
      {"  - write: { mill.D0: 5 }\n    via: usb\n  - expect: { mill.D0: 5 }\n    via: usb\n",
       "test.yaml:11:10: steps[0].via: no line is called 'usb'; expected one of pc, hmi\n"
       "test.yaml:13:10: steps[1].via: no line is called 'usb'; expected one of pc, hmi"},
  };
  for (const auto& [steps, diagnostic] : cases) EXPECT_EQ(diagnostic_of(steps), diagnostic) << steps;
}

}  // namespace ports_scenario_test
}  // namespace understudy::emulator::workbench
