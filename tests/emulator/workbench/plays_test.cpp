// Bits, reals, and registers of four tables in scenarios: written, read, waited for, polled, refused; the
// same in virtual and in real time; recorded, replayed, forked, traced, linted.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "emulator/play/executors/modbus_host.h"
#include "emulator/play/executors/real_executor.h"
#include "emulator/play/lint/lint.h"
#include "emulator/play/performing/performance_recorder.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/play/results/result_text.h"
#include "emulator/world/bench/bench_text.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/recording/replay.h"
#include "emulator/world/trace/trace_file.h"
#include "pty/rtu_crc.h"
#include "tests/emulator/workbench/workbench.h"
#include "tests/emulator/world/stations/pdus.h"

namespace understudy::emulator::workbench {
namespace plays_test {

using play::RunOptions;
using play::Scenario;
using play::ScenarioResult;

const ListedModel kModels[] = {&model()};

std::vector<Scenario> parsed(const std::string& steps) {
  return play::parse_scenarios(kModels,
                               "understudy: 1\nname: four tables\nbench: { lines: { rs485: { baud: 115200, "
                               "stations: [ { name: it, model: workbench } ] } } }\nsteps:\n" +
                                   steps,
                               "test.yaml");
}

std::string diagnostic_of(const std::string& step) {
  try {
    parsed("  - " + step + "\n");
    return "";
  } catch (const FileError& error) {
    const std::string text = error.what();
    return text.substr(text.find(": ") + 2);
  }
}

std::string why(const ScenarioResult& result) {
  std::string text;
  for (const std::string& line : play::failure_lines(result)) text += line + "\n";
  return text;
}

const std::string kAllKinds =
    "  - write: { it.Run: 1, it.Speed_X: 250, it.Speed_Y: 300 }\n"
    "  - write: { it.Gain_X: 2.5, it.Gain_Y: 0.1, it.Mode.PROGRAM: 6, it.Offset: -7 }\n"
    "  - write: { it.Output_0: 1, it.Output_1: 0, it.Output_2: 1 }\n"
    "  - write: { it.Output_9: it.Output_2 }\n"
    "  - expect: { it.Run: 1, it.Output_0: 1, it.Output_1: 0, it.Output_2: 1, it.Output_9: on }\n"
    "  - expect: { it.Gain_X: 2.5, it.Gain_Y: 0.1, it.Gain_Z: 1..2, it.Mode: 0x60, it.Offset: -7 }\n"
    "  - expect: { it.Always_On_X: 1, it.Input_3: 0, it.DRIVING_X: 0, it.DRIVING_Y: 0 }\n"
    "  - input: { it.IN3: on }\n"
    "  - expect: { it.Input_3: 1, it.discrete.0x0003: 1, it.discrete.4: 0 }\n"
    "  - expect: { it.Temperature: 21.5, it.Module_ID: 0x44, it.input.0x0014: 0x44, it.coil.0x0002: 1 }\n";

const std::string kMoves =
    "  - write: { it.holding.Position_Y: -70000 }\n"
    "  - expect: { it.input.Position_Y: -70000, it.holding.Position_Y: -70000 }\n"
    "  - write: { it.Servo_X: 1 }\n    exception: 2\n"
    "  - write: { it.coil.80: 1 }\n    exception: 2\n"
    "  - write: { it.Gain_Z: 11 }\n    exception: 3\n"
    "  - expect: { it.input.0x0015: 0 }\n    exception: 2\n"
    "  - write: { it.Command0: 0x0A01, it.Command1: 0, it.Command2: 0, it.Command3: 40000 }\n"
    "  - wait: { until: it.DRIVING_X == 1 and it.STATE.DRIVING, within: 1s }\n"
    "  - wait: { until: it.input.Position_X == 40000 and not it.DRIVING_X and it.Gain_Y == 0.1, within: 5s, "
    "poll: 50ms }\n"
    "  - assert: [ it.Gain_X == 2.5, it.coil.Output_2 == 1, it.STATE.DRIVING == 0, it.Temperature > 21.25 ]\n"
    "  - snapshot: moved\n"
    "  - fork:\n"
    "      on: [ write: { it.Output_5: 1 }, expect: { it.Output_5: 1, it.input.Position_X: 40000 } ]\n"
    "      off: [ expect: { it.Output_5: 0, it.Gain_Y: 0.1 } ]\n"
    "  - write: { it.Gain_Y: 3, it.Output_2: 0 }\n"
    "  - expect: { it.Gain_Y: 3, it.Output_2: 0 }\n";
const std::string kBack =
    "  - restore: moved\n"
    "  - expect: { it.Gain_Y: 0.1, it.Output_2: 1, it.holding.Position_Y: -70000 }\n";

void expect_passed(const std::vector<ScenarioResult>& results, std::size_t count) {
  EXPECT_EQ(results.size(), count);
  for (const ScenarioResult& result : results) {
    EXPECT_EQ(result.verdict, ScenarioResult::Verdict::passed) << result.name << "\n" << why(result);
  }
}

TEST(Plays, KnowEveryTableInFreeTime) {
  const Scenario scenario = parsed(kAllKinds + kMoves + kBack).front();
  RunOptions options{.with_hash = true};
  const auto results = run_scenario(scenario, options);
  expect_passed(results, 3);
  const auto again = run_scenario(scenario, options);
  for (std::size_t i = 0; i < results.size(); ++i) {
    EXPECT_EQ(results[i].outcome_hash, again[i].outcome_hash);
    EXPECT_NE(results[i].outcome_hash, 0U);
  }
}

TEST(Plays, KnowEveryTableInRealTimeWithLibmodbus) {
  const Scenario scenario = parsed(kAllKinds + kMoves).front();
  RunOptions options;
  options.make_executor = play::make_real_executor;
  expect_passed(run_scenario(scenario, options), 3);
}

TEST(Plays, AreRecordedAndReplayed) {
  const std::string folder = testing::TempDir() + "understudy-plays-" + std::to_string(getpid());
  std::filesystem::create_directories(folder);
  const Scenario scenario = parsed(kAllKinds + kMoves + kBack).front();
  RunOptions options;
  int count = 0;
  options.observers.push_back([&](world::World& world) {
    world::RecordingHeader header{.version = "1.2.3",
                                  .bench = world::to_text(scenario.bench),
                                  .options = {.strict_framing = true},
                                  .seed = scenario.bench.seed,
                                  .snapshot = {}};
    return std::make_unique<play::PerformanceRecorder>(world, std::move(header),
                                                       folder + "/" + std::to_string(count++) + ".jsonl");
  });
  for (const ScenarioResult& result : run_scenario(scenario, options)) {
    std::ifstream file(result.recording);
    const auto look = [&](world::World& world) {
      const auto& state = static_cast<const Workbench&>(world.device(0)).state;
      EXPECT_EQ(state.positions[1], -70000) << result.name;
      EXPECT_EQ(state.positions[0], 40000) << result.name;
    };
    const world::Replayed replayed = world::replay(kModels, file, result.recording, {}, {}, look);
    EXPECT_EQ(replayed.result.verdict, world::ReplayResult::Verdict::same) << replayed.result.difference;
    EXPECT_GT(replayed.result.bytes_sent, 10U);
  }
  std::filesystem::remove_all(folder);
}

TEST(Plays, AreLinted) {
  const Scenario scenario =
      parsed(
          "  - write: { it.Servo_X: 1 }\n    exception: 2\n"
          "  - write: { it.Servo_Y: 1, it.Servo_Z: 0 }\n    exception: 2\n"
          "  - repeat: { times: 20, as: n, steps: [ write: { it.Gain_X: \"${n % 2}.5\" } ] }\n")
          .front();
  RunOptions options;
  options.observers.push_back([](world::World& world) { return std::make_unique<play::Lint>(world); });
  const auto results = run_scenario(scenario, options);
  expect_passed(results, 1);
  std::string all;
  for (const std::string& finding : results.front().lint_findings) all += finding + "\n";
  for (const char* wanted :
       {"1 write to it.Servo_X, which is read-only", "1 write to it.Servo_Y, which is read-only",
        "1 write to it.Servo_Z, which is read-only", "changes of it.Gain_X, which is stored in EEPROM"}) {
    EXPECT_NE(all.find(wanted), std::string::npos) << wanted << " in\n" << all;
  }
}

// Findings about a command are reported with its name.
TEST(Plays, AreLintedWithTheNamesOfCommands) {
  const world::Bench bench = world::parse_bench(
      kModels,
      "understudy: 1\nlines: { a: { baud: 115200, stations: [ { name: it, model: workbench } ] } }\n",
      "bench.yaml", "/tmp");
  world::World world(bench, {}, {});
  play::Lint lint(world);
  world.host_settings(0, pty::HostSettings{.baud = 115200, .stop_bits = 1});
  std::vector<std::uint8_t> move{1, 0x10, 0x1F, 0x40, 0,    4,   8, kMove >> 8, kMove & 0xFF,
                                 0, 1,    0,    0,    0x03, 0xE8};
  pty::append_rtu_crc(move);
  world.receive(0, move, world.now());
  world.advance_to(std::chrono::milliseconds(3));
  world.receive(0, move, world.now());  // hardly after the reply
  world.advance_to(std::chrono::seconds(1));
  std::string all;
  for (const std::string& finding : lint.findings()) all += finding + "\n";
  EXPECT_NE(all.find("; first at 3ms (it: MOVE Y 1000)\n"), std::string::npos) << all;
}

TEST(Plays, AreTracedWithReals) {
  const std::string path = testing::TempDir() + "understudy-reals-" + std::to_string(getpid());
  for (const std::string ending : {".csv", ".vcd"}) {
    world::World world(parsed("  - advance: 1ms\n").front().bench, {}, {});
    {
      world::TraceFile trace(world, path + ending, {"it.Gain_Z", "it.Output_3"}, {});
      trace.begin();
      world.advance_to(std::chrono::milliseconds(2));
      const auto gain = world::find_register(world.known(), "it.Gain_Z");
      PreparedWrite write;
      ASSERT_EQ(prepare_value(*world.device(0).register_bank(), gain.place, value_of_real(0.1F), write),
                Refusal::none);
      world.write(0, write);
      world.advance_to(std::chrono::milliseconds(5));
    }
    std::ifstream file(path + ending);
    std::stringstream text;
    text << file.rdbuf();
    EXPECT_NE(text.str().find("21.5"), std::string::npos) << text.str();
    EXPECT_NE(text.str().find("1.5"), std::string::npos);
    EXPECT_NE(text.str().find("0.1"), std::string::npos);
    std::filesystem::remove(path + ending);
  }
}

TEST(Plays, WhatCannotBeWrittenIsAnErrorOfTheFile) {
  const std::pair<const char*, const char*> cases[] = {
      {"write: { it.Servo_X: 1 }",
       "it.Servo_X cannot be written; it is read-only (use `exception:` if the step tests that)"},
      {"write: { it.Module_ID: 1 }",
       "it.Module_ID cannot be written; no function writes to the table 'input'"},
      {"write: { it.discrete.0x0003: 1 }",
       "it.discrete.0x0003 cannot be written; no function writes to the table 'discrete'"},
      {"write: { it.Output_1: 2 }", "2 is out of range for it.Output_1; expected 0 to 1"},
      {"write: { it.coil.7: 2 }", "2 is out of range for it.coil.7; expected 0 to 1"},
      {"write: { it.Gain_X: 10.5 }", "10.5 is out of range for it.Gain_X; expected 0 to 10"},
      {"write: { it.Speed_X: 2.5 }", "2.5 is not a whole number; expected one"},
      {"write: { it.Position_X: 2 }",
       "it: 'Position_X' is in several tables; expected one of holding.Position_X, input.Position_X"},
      {"expect: { it.coil.0x10000: 1 }", "'0x10000' is not a register number; expected 0 to 0xFFFF"},
      {"expect: { it.Output_1: 2 }", "it.Output_1 is never 2; expected a value in 0 to 1"},
  };
  for (const auto& [step, wanted] : cases) {
    EXPECT_NE(diagnostic_of(step).find(wanted), std::string::npos) << step << ": " << diagnostic_of(step);
  }
}

TEST(Plays, DifferencesAreReported) {
  const auto result =
      run_scenario(parsed("  - expect: { it.Gain_X: 1.6, it.Output_4: 1, it.Speed_X: 100 }\n").front());
  ASSERT_TRUE(result.front().failure);
  EXPECT_EQ(result.front().failure->what, "it.Gain_X is 1.5; expected 1.6");
  EXPECT_EQ(result.front().failure->came, "it.Gain_X = 1.5, it.Output_4 = 0");
  std::string frames;
  for (const std::string& frame : result.front().failure->frames) frames += frame + "\n";
  EXPECT_NE(frames.find("read coil 0x0004 it.Output_4"), std::string::npos) << frames;
  EXPECT_NE(frames.find("it.Output_4 = 0"), std::string::npos) << frames;
}

TEST(Plays, FramesOfAHostAreThoseOfTheStandard) {
  using play::read_request;
  using play::write_request;
  const auto pdu = [](const std::vector<std::uint8_t>& frame) {
    return world::text(world::Bytes(frame.begin() + 1, frame.end() - 2));
  };
  using Words = std::vector<std::uint16_t>;
  EXPECT_EQ(pdu(read_request(1, Table::coil, 0x13, 2000)), "01 00 13 07 D0");
  EXPECT_EQ(pdu(read_request(1, Table::discrete, 0xC4, 22)), "02 00 C4 00 16");
  EXPECT_EQ(pdu(read_request(1, Table::holding, 0x6B, 3)), "03 00 6B 00 03");
  EXPECT_EQ(pdu(read_request(1, Table::input, 8, 1)), "04 00 08 00 01");
  EXPECT_EQ(pdu(write_request(1, Table::coil, 0xAC, Words{1})), "05 00 AC FF 00");
  EXPECT_EQ(pdu(write_request(1, Table::coil, 0xAC, Words{0})), "05 00 AC 00 00");
  EXPECT_EQ(pdu(write_request(1, Table::holding, 1, Words{3})), "06 00 01 00 03");
  EXPECT_EQ(pdu(write_request(1, Table::coil, 0x13, Words{1, 0, 1, 1, 0, 0, 1, 1, 1, 0})),
            "0F 00 13 00 0A 02 CD 01");
  EXPECT_EQ(pdu(write_request(1, Table::holding, 1, Words{10, 258})), "10 00 01 00 02 04 00 0A 01 02");
  EXPECT_THROW(write_request(1, Table::input, 1, Words{1}), std::logic_error);
}

}  // namespace plays_test
}  // namespace understudy::emulator::workbench
