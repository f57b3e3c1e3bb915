// A model with a text protocol in the rest of the product: benches, names, control, scenarios, recordings,
// memories.
#include <gtest/gtest.h>

#include <sstream>

#include "emulator/device/describe/describe.h"
#include "emulator/device/memory/nv_file.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/named_values.h"
#include "emulator/models/models.h"
#include "emulator/serve/control/control_door.h"
#include "emulator/serve/control/messages.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/bench/bench_text.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/probe/probes.h"
#include "emulator/world/recording/recorder.h"
#include "emulator/world/recording/replay.h"
#include "emulator/world/trace/trace.h"
#include "tests/emulator/serve/control/daemon_rig.h"
#include "tests/emulator/world/bench_file/without_columns.h"
#include "tests/emulator/world/stations/echo_box.h"

namespace understudy::emulator::world {
namespace text_bench_test {

using namespace std::chrono_literals;

const std::string kBench =
    "understudy: 1\n"
    "lines:\n"
    "  serial:\n"
    "    timing: instant\n"
    "    stations:\n"
    "      - { name: robot, model: echo-box, firmware: 1.00, modules: 3, set: { N0: -7, R0: 0.25 } }\n"
    "  rs485:\n"
    "    stations: [ { name: feeder, model: simple2-r3, address: 2 } ]\n";

std::string refusal(const std::string& bench) {
  try {
    parse_bench(models_and_echo_box(), bench, "b.yaml", ".");
  } catch (const FileError& error) {
    return without_columns(error.what());
  }
  return "";
}

TEST(TextBench, ADeviceThatSpeaksTextStandsOnALineOfItsOwn) {
  const Bench bench = parse_bench(models_and_echo_box(), kBench, "b.yaml", ".");
  World world(bench, {}, {});
  EXPECT_EQ(world.line(0).protocol.messages(), "lines of text");
  EXPECT_EQ(world.line(1).protocol.messages(), "Modbus frames");
  EXPECT_EQ(pty::to_string(world.line(0).line.options().settings), "9600 8N1");
  EXPECT_EQ(world.device(0).named_values()->value_named("N0"), -7);
  EXPECT_EQ(world.device(0).named_values()->value_named("R0"), 0.25);
  EXPECT_EQ(world.device(0).named_values()->value_named("MODULES"), 3);
}

TEST(TextBench, IsTheSameBenchAsText) {
  Bench bench = parse_bench(models_and_echo_box(), kBench, "b.yaml", ".");
  bench.devices[0].settings.nv = NvImage{.model = "echo-box",
                                         .firmware = {},
                                         .registers = {{"N0", 5}},
                                         .reals = {{"R0", 2}, {"R0", 0.1}},
                                         .program = {"SAY a", "", "SAY b"}};
  bench.devices[0].settings.nv->reals = {{"R0", 2}};
  const Bench again = parse_bench(models_and_echo_box(), to_text(bench), "b.yaml", ".");
  EXPECT_EQ(to_text(again), to_text(bench));
  EXPECT_EQ(again.devices[0].settings.modules, 3);
  EXPECT_EQ(again.devices[0].settings.assignments, bench.devices[0].settings.assignments);
  EXPECT_EQ(again.devices[0].settings.nv, bench.devices[0].settings.nv);
}

TEST(TextBench, WhatSuchADeviceCannotBeIsReportedWithItsLine) {
  const auto with = [](const std::string& stations) {
    return "understudy: 1\nlines:\n  a:\n    stations:\n" + stations;
  };
  const std::string robot = "      - { name: r, model: echo-box";
  const std::string feeder = "      - { name: f, model: simple2-r3";
  EXPECT_EQ(refusal(with(robot + " }\n" + feeder + " }\n")),
            "b.yaml:6: lines.a.stations[1]: 'r' speaks text and must be alone on its line; expected no other "
            "station on it");
  EXPECT_EQ(refusal(with(feeder + " }\n" + robot + " }\n")),
            "b.yaml:6: lines.a.stations[1]: 'r' speaks text and must be alone on its line; expected no other "
            "station on it");
  EXPECT_EQ(refusal(with(robot + " }\n      - { name: s, model: echo-box }\n")),
            "b.yaml:6: lines.a.stations[1]: 's' speaks text and must be alone on its line; expected no other "
            "station on it");
  EXPECT_EQ(refusal(with(robot + ", address: 1 }\n")),
            "b.yaml:5: lines.a.stations[0].address: echo-box has no station number; expected no `address`");
  EXPECT_EQ(refusal(with(robot + ", modules: 9 }\n")),
            "b.yaml:5: lines.a.stations[0].modules: '9' is not valid; expected 1 to 8");
  EXPECT_EQ(refusal(with(feeder + ", modules: 2 }\n")),
            "b.yaml:5: lines.a.stations[0].modules: '2' is not valid; expected none, because simple2-r3 has "
            "no modules");
  EXPECT_EQ(refusal(with(robot + ", set: { N0: 40000 } }\n")),
            "b.yaml:5: lines.a.stations[0].set.N0: is out of range; expected -32768 to 32767");
  EXPECT_EQ(refusal(with(robot + ", set: { N0: fast } }\n")),
            "b.yaml:5: lines.a.stations[0].set.N0: 'fast' is not a number; expected one");
  EXPECT_EQ(
      refusal(with(robot + " }\nfaults: [ { busy: r } ]\n")),
      "b.yaml:6: faults[0]: busy: is a fault of Modbus frames, but r uses text; expected a different fault");
  EXPECT_EQ(refusal(with(robot + " }\nfaults: [ { drop: r, function: 3 } ]\n")),
            "b.yaml:6: faults[0].function: r speaks text, to which this field does not apply; expected no "
            "such field");
}

TEST(TextBench, CommandsAreDescribed) {
  const auto sheet = describe(echo_box(), "commands", SheetFormat::csv);
  EXPECT_EQ(format_sheet(*sheet, SheetFormat::csv),
            "command,syntax,meaning\n"
            "SAY,SAY WORDS,says WORDS\n"
            "AT,AT TICK,\"says \"\"TICK n\"\" when that tick has come\"\n"
            "LIST,LIST N,says N lines\n");
}

TEST(TextBench, ExpressionsKnowItsValues) {
  World world(parse_bench(models_and_echo_box(), kBench, "b.yaml", "."), {}, {});
  const Probes probes(world);
  const auto value = [&](const std::string& text) {
    return number_text(evaluate(parse_expression(text, probes), probes));
  };
  EXPECT_EQ(value("robot.N0 == -7 and robot.R0 * 4 == 1"), "1");
  EXPECT_EQ(value("robot.MODULES"), "3");
  EXPECT_EQ(value("robot.requests"), "0");
  try {
    value("robot.N1");
    ADD_FAILURE() << "it does not exist";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("robot has no value called 'N1'"), std::string::npos)
        << error.what();
  }
  world.switch_power(0, false);
  EXPECT_EQ(value("robot.N0"), "0");
}

TEST(TextBench, IsLookedAtAndSetPastItsLine) {
  const serve::TestFolder folder;
  serve::DaemonOptions options;
  options.speed = {.kind = serve::Speed::Kind::manual};
  options.door = serve::control_door(folder.path + "/control");
  options.watch_signals = false;
  serve::Daemon daemon(parse_bench(models_and_echo_box(), kBench, "b.yaml", folder.path), options,
                       [](const std::string&) {});
  const auto ask = [&](const std::string& message) {
    std::string reply;
    serve::handle_message(daemon, message, [&](const std::string& line) { reply = line; });
    return reply;
  };
  EXPECT_EQ(ask(R"({"do":"get","names":["robot.N0","robot.R0","feeder.STATUS"]})"),
            R"({"ok":true,"values":{"robot.N0":-7,"robot.R0":0.25,"feeder.STATUS":0}})");
  EXPECT_EQ(ask(R"({"do":"set","values":{"robot.N0":8,"robot.R0":1.5,"feeder.Aaxis_Speed":20}})"),
            R"({"ok":true})");
  EXPECT_EQ(ask(R"({"do":"get","names":["robot.N0","robot.R0","feeder.Aaxis_Speed"]})"),
            R"({"ok":true,"values":{"robot.N0":8,"robot.R0":1.5,"feeder.Aaxis_Speed":20}})");
  // All or nothing.
  EXPECT_EQ(ask(R"({"do":"set","values":{"robot.N0":9,"robot.R1":1}})"),
            R"({"ok":false,"error":"robot has no value called 'R1'; the nearest is 'R0'"})");
  EXPECT_EQ(ask(R"({"do":"set","values":{"robot.ECHO":5,"robot.N0":9}})"),
            R"({"ok":false,"error":"ECHO: is out of range; expected 0 or 1"})");
  EXPECT_EQ(ask(R"({"do":"get","names":["robot.N0"]})"), R"({"ok":true,"values":{"robot.N0":8}})");
  EXPECT_NE(ask(R"({"do":"status"})").find("\"ok\":true"), std::string::npos);
}

TEST(TextBench, ARecordingOfItIsPlayedBitForBit) {
  const Bench bench = parse_bench(models_and_echo_box(), kBench, "b.yaml", ".");
  std::string text;
  std::vector<std::byte> state;
  {
    World world(bench, {}, {});
    Recorder recorder(world,
                      {.version = "1", .bench = to_text(bench), .options = {}, .seed = 0, .snapshot = {}},
                      [&](std::string_view line) { text += line; });
    const auto transmit = [&](std::string_view line) {
      world.advance_to(world.now());  // earlier output comes first
      world.receive(0, std::vector<std::uint8_t>(line.begin(), line.end()));
      world.advance_to(world.now() + 33'333us);
    };
    transmit("SAY a\r");
    transmit("AT 250\rAT 2");
    EXPECT_EQ(world.assign(0, "R0", 0.1), std::nullopt);
    transmit("50\r?R0\r");
    world.switch_power(0, false);
    transmit("SAY b\r");
    world.switch_power(0, true);
    transmit("AT 250\r");
    world.load_program(0, "SAY c\n");
    transmit("?N0\rLIST 400\r");
    world.advance_to(9s);
    state = world.device(0).save_state();
  }
  bool is_same = false;
  std::istringstream file(text);
  const Replayed again = replay(models_and_echo_box(), file, "a.jsonl", {}, {},
                                [&](World& world) { is_same = world.device(0).save_state() == state; });
  EXPECT_EQ(again.result.verdict, ReplayResult::Verdict::same) << again.result.difference;
  EXPECT_TRUE(is_same);
  // HELLO twice, a, 0.1, TICK 250, -7 and 400 lines of 8 to 10 characters, with their ends.
  EXPECT_EQ(again.result.bytes_sent, 2 * 7u + 3 + 5 + 10 + 4 + 9 * 8 + 90 * 9 + 301 * 10);
}

TEST(TextBench, ATraceOfItHasItsValues) {
  World world(parse_bench(models_and_echo_box(), kBench, "b.yaml", "."), {}, {});
  const auto signals = trace_signals(world, {"robot.R0", "robot.N0"});
  EXPECT_EQ(signals[signals.size() - 2].name, "robot.R0");
  EXPECT_EQ(signals[signals.size() - 2].kind, TraceSignal::Kind::real);
  EXPECT_EQ(signals.back().kind, TraceSignal::Kind::whole);
}

TEST(TextBench, ItsMemoryIsAnImageWithRealsAndAProgram) {
  const NvImage image{.model = "echo-box",
                      .firmware = "1.01",
                      .registers = {{"N0", -3}},
                      .reals = {{"R0", 0.1}},
                      .program = {"SAY a", "SAY \"b\""}};
  DeviceSettings settings;
  settings.name = "robot";
  settings.nv = image;
  const auto device = make_device(echo_box(), settings);
  EXPECT_EQ(device->memory()->nv_image(), image);
  const std::string text = to_json(image);
  EXPECT_NE(text.find("\"R0\": 0.1\n"), std::string::npos) << text;
  EXPECT_EQ(parse_nv_image(text), image);
  for (const double value : {1.0 / 3, 1e-300, 123456789.125, -2.0, 5e-324}) {
    NvImage one = image;
    one.reals = {{"R0", value}};
    EXPECT_EQ(parse_nv_image(to_json(one)), one);
  }
}

TEST(TextBench, AnImageThatDoesNotSuitIsRefused) {
  const auto refusal_of = [](const Model& model, const NvImage& image) -> std::string {
    DeviceSettings settings;
    settings.name = "x";
    settings.nv = image;
    try {
      make_device(model, settings);
    } catch (const NvError& error) {
      return error.what();
    }
    return "";
  };
  const Model& simple2 = *find_model(models::all_models(), "simple2-r3");
  EXPECT_EQ(refusal_of(simple2, {.model = "simple2-r3", .firmware = {}, .reals = {{"R0", 1}}}),
            "reals: is not part of the memory of simple2-r3; expected none");
  EXPECT_EQ(refusal_of(simple2, {.model = "simple2-r3", .firmware = {}, .program = {"A"}}),
            "program: is not part of the memory of simple2-r3; expected none");
  EXPECT_EQ(refusal_of(echo_box(), {.model = "echo-box", .firmware = {}, .reals = {{"Q", 1}}}),
            "reals: 'Q' is not a name here; expected R0");
  const auto parse = [](const std::string& more) -> std::string {
    try {
      parse_nv_image(R"({"understudy":1,"kind":"nv-image","model":"m","firmware":"1.00","registers":{},)" +
                     more + "}");
    } catch (const NvError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(parse(R"("reals":{"R0":"1"})"), "reals: 'R0': is not a number; expected one");
  EXPECT_EQ(parse(R"("reals":[1])"), "reals: is not an object; expected names and values");
  EXPECT_EQ(parse(R"("reals":{"R0":1,"R0":2})"), "line 1: 'R0': appears twice; expected it only once");
  EXPECT_EQ(parse(R"("program":"A")"), "program: is not a list of lines; expected one");
  EXPECT_EQ(parse(R"("program":["A",1])"), "program: is not a list of lines; expected one");
}

}  // namespace text_bench_test
}  // namespace understudy::emulator::world
