// Commands by name: what a scenario sends, in virtual and in real time, and how frames are described.
#include <gtest/gtest.h>

#include "emulator/device/command_window.h"
#include "emulator/play/executors/modbus_host.h"
#include "emulator/play/executors/real_executor.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/play/results/result_text.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/frames/frame_log.h"
#include "pty/rtu_crc.h"
#include "tests/emulator/workbench/two_lines.h"

namespace understudy::emulator::workbench {
namespace window_names_test {

using Words = std::vector<std::uint16_t>;

std::string scenario_text(const std::string& steps) {
  return "understudy: 1\nname: commands\nbench:\n  lines:\n"
         "    pc: { timing: instant, stations: [ { device: mill, port: PC } ] }\n"
         "    hmi: { timing: instant, stations: [ { device: mill, port: HMI } ] }\n"
         "  devices: { mill: { model: workbench } }\nsteps:\n" +
         steps;
}

std::vector<play::Scenario> read(const std::string& steps) {
  return play::parse_scenarios(kWorkbenchModels, scenario_text(steps), "test.yaml");
}

std::string diagnostic_of(const std::string& steps) {
  try {
    read(steps);
  } catch (const FileError& error) {
    const std::string what = error.what();
    return what.substr(what.find(": ") + 2);
  }
  return "none";
}

/// Empty if it passes.
std::string failure_of(const std::string& steps, const play::RunOptions& options = {}) {
  std::string text;
  for (const play::ScenarioResult& result : play::run_scenario(read(steps).front(), options)) {
    for (const std::string& line : play::failure_lines(result)) text += line + "\n";
  }
  return text;
}

const std::string kCommands =
    "  - command: { mill: MOVE X -70000 }\n"
    "  - command: { mill: MOVE Y 1000 }\n    via: hmi\n"
    "  - assert: [ mill.STATE.WAITING == 2 ]\n"
    // The word order is read when the command is sent.
    "  - write: { mill.Word_Order: 1 }\n"
    "  - command: { mill: MOVE Z 65537 }\n"
    "  - command: { mill: STOP }\n    exception: 6\n"
    "  - write: { mill.Run: 1 }\n"
    "  - wait: { until: mill.input.Position_X == -70000 and mill.input.Position_Z == 65537, within: 10s }\n"
    "  - assert: [ mill.input.Position_Y == 1000, mill.Done == 3 ]\n";

TEST(WindowNames, AScenarioSendsCommandsByName) {
  EXPECT_EQ(failure_of(kCommands), "");
  const std::string silent = "  - command: { mill: MOVE X 5 }\n    reply: nothing\n    within: 20ms\n";
  EXPECT_EQ(failure_of("  - power: { mill: off }\n" + silent), "");
  EXPECT_NE(failure_of(silent).find("command mill: MOVE X 5 on line pc: done; expected no reply"),
            std::string::npos)
      << failure_of(silent);
}

TEST(WindowNames, TheSameInRealTimeWithLibmodbus) {
  play::RunOptions options;
  options.make_executor = play::make_real_executor;
  EXPECT_EQ(failure_of(kCommands, options), "");
}

TEST(WindowNames, AFailedCommandIsReportedByItsName) {
  const std::string text =
      failure_of("  - write: { mill.Absent: 1 }\n  - command: { mill: MOVE X 5 }\n    via: pc\n");
  EXPECT_NE(text.find("command mill: MOVE X 5 on line pc: exception 4 (device failure); expected success"),
            std::string::npos)
      << text;
  // And so are the frames.
  EXPECT_NE(text.find("-> command 0x1F40 mill: MOVE X 5"), std::string::npos) << text;
}

TEST(WindowNames, AFileThatIsWrongSaysWhere) {
  const std::pair<const char*, const char*> cases[] = {
      {"command: { mill: MOVE W 5 }",
       "steps[0].command.mill: column 6: 'W' is not an axis; expected X, Y or Z"},
      {"command: { mill: FLY }",
       "steps[0].command.mill: column 1: 'FLY' is not a command; expected MOVE or STOP"},
      {"command: { mil: STOP }", "steps[0].command.mil: no device is called 'mil'; the nearest is 'mill'"},
      {"command: {}", "steps[0].command: is empty; expected commands, as in `{ cell: MOVE X 1000 }`"},
      {"command: { mill: STOP }\n    via: rs485",
       "steps[0].via: no line is called 'rs485'; expected one of pc, hmi"},
  };
  for (const auto& [step, why] : cases) {
    EXPECT_EQ(diagnostic_of(std::string("  - ") + step + "\n"), why) << step;
  }
  EXPECT_EQ(read(kCommands).front().steps[4].text, "command mill: MOVE Z 65537");
  EXPECT_EQ(read(kCommands).front().steps[5].text, "command mill: STOP (exception 6)");
}

TEST(WindowNames, AModelWithoutThemHasNoCommands) {
  Model plain = model();
  plain.window = nullptr;
  EXPECT_THROW(window_message(plain, "STOP", {.firmware = 100}), ProgramError);
  DeviceSettings settings;
  settings.name = "it";
  const auto device = make_device(model(), settings);
  EXPECT_FALSE(window_text(*device, Table::holding, kWindow + 1, Words{kStop})) << "not its first word";
  EXPECT_FALSE(window_text(*device, Table::input, kWindow, Words{kStop})) << "another table";
}

TEST(WindowNames, AMessageAndItsTextMeanTheSame) {
  for (const bool low_word_first : {false, true}) {
    const WindowForm form{.firmware = 100, .low_word_first = low_word_first};
    for (const char* text : {"STOP", "MOVE X 0", "MOVE Y -1", "MOVE Z 2147483647", "MOVE X -2147483648"}) {
      const WindowMessage message = window_message(model(), text, form);
      EXPECT_EQ(message.first, kWindow);
      EXPECT_EQ(model().window->text_of(message.words, form), text);
    }
  }
  const Words high_first{kMove, 1, 0, 1000};
  EXPECT_EQ(window_message(model(), "MOVE Y 1000", {.firmware = 100}).words, high_first);
}

TEST(WindowNames, FramesAreDescribedWithThem) {
  world::World world(
      world::parse_bench(kWorkbenchModels,
                         "understudy: 1\nlines:\n  rs485: { timing: instant, stations: [ { name: "
                         "it, model: workbench } ] }\n",
                         "bench.yaml", "/tmp"),
      {}, {});
  const auto reported = [&](const std::vector<std::uint8_t>& request) {
    return world.line(0).request_text(request);
  };
  EXPECT_EQ(reported(play::message_request(1, kWindow, Words{kMove, 1, 0, 1000})),
            "command 0x1F40 it: MOVE Y 1000");
  EXPECT_EQ(reported(play::message_request(1, kWindow, Words{kStop})), "command 0x1F40 it: STOP");
  EXPECT_EQ(reported(play::write_request(1, Table::holding, kWindow, Words{kStop})),
            "command 0x1F40 it: STOP");
  EXPECT_EQ(reported(play::message_request(0, kWindow, Words{kStop})), "station 0: command 0x1F40 it: STOP");
  // Other messages are described as words.
  EXPECT_EQ(reported(play::message_request(1, kWindow, Words{7, 1})),
            "write 0x1F40 it.Command0 = 7, Command1 = 1");
  EXPECT_EQ(reported(play::message_request(1, kWindow + 1, Words{kStop})), "write 0x1F41 it.Command1 = 2562");
  // In the present word order.
  auto& bench = static_cast<Workbench&>(world.device(0));
  write_value(bench, *find_register(model(), "Word_Order", 100), 1);
  EXPECT_EQ(reported(play::message_request(1, kWindow, Words{kMove, 1, 1000, 0})),
            "command 0x1F40 it: MOVE Y 1000");
}

}  // namespace window_names_test
}  // namespace understudy::emulator::workbench
