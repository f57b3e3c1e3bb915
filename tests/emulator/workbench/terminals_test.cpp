// Terminals of every kind, hundreds of them: counted inputs, analog outputs, short pulses, groups; and what
// observers see of them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "emulator/serve/control/messages.h"
#include "emulator/serve/control/watch_table.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/outcome_hash.h"
#include "emulator/world/recording/recorder.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/trace/trace.h"
#include "tests/emulator/play/performing/played.h"
#include "tests/emulator/workbench/workbench.h"
#include "tests/emulator/world/same_world.h"

namespace understudy::emulator::workbench {
namespace terminals_test {

using namespace std::chrono_literals;
using Json = nlohmann::json;
using world::World;

const ListedModel kModels[] = {&model()};

const std::string kBench = "lines: { a: { timing: instant, stations: [ { name: it, model: workbench } ] } }";

world::Bench bench() { return world::parse_bench(kModels, "understudy: 1\n" + kBench, "bench.yaml", "/tmp"); }

Workbench& bench_of(World& world) { return static_cast<Workbench&>(world.device(0)); }

std::string scenario(const std::string& steps, const std::string& more = "") {
  return "understudy: 1\nname: test\nbench: { " + kBench + more + " }\nsteps:\n" + steps;
}

void expect_passes(const std::string& steps, const std::string& more = "") {
  const auto text = scenario(steps, more);
  const play::ScenarioResult result =
      play::run_scenario(play::parse_scenarios(kModels, text, "test.yaml").front(), {}).front();
  EXPECT_TRUE(play::has_passed(result)) << text << play::why(result);
}

std::string diagnostic_of(const std::string& steps) {
  try {
    play::parse_scenarios(kModels, scenario(steps), "test.yaml");
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

std::uint64_t outcome(const std::function<void(Workbench&)>& change) {
  World world(bench(), {}, {});
  world::OutcomeHash hash(world);
  change(bench_of(world));
  world.advance_to(1ms);
  return hash.value();
}

void set_register(Workbench& device, std::string_view name, Value value) {
  EXPECT_EQ(write_value(device, *device.map().find(name, device.firmware()), value), Refusal::none) << name;
}

TEST(TerminalsOfEveryKind, ASteppedTurnIsCountedEvenly) {
  expect_passes(
      "  - turn: { it.MPG: 400, it.EXPP: -100, in: 2s }\n"
      "  - advance: 500ms\n"
      "  - assert: [ it.MPG == 100, it.EXPP == -25 ]\n"
      "  - turn: { it.MPG: -7 }\n"
      "  - advance: 1ms\n"
      "  - assert: it.MPG == 93\n"
      "  - wait: { until: it.MPG == 393, within: 2s }\n"
      "  - assert: [ it.MPG == 393, it.EXPP == -100 ]\n"
      "  - advance: 3s\n"
      "  - assert: it.MPG == 393\n");
}

TEST(TerminalsOfEveryKind, AWheelOfAnAxisIsTurnedByAStepToo) {
  expect_passes(
      "  - turn: { it.B: 250, in: 100ms }\n"
      "  - advance: 50ms\n"
      "  - assert: it.B.encoder == 125\n"
      "  - advance: 1s\n"
      "  - assert: it.B.encoder == 250\n",
      ", plant: { it.B: { encoder: { per_revolution: 100, on: wheel } } }");
}

TEST(TerminalsOfEveryKind, ATurnOfSomethingElseIsRefused) {
  EXPECT_EQ(
      diagnostic_of("  - turn: { it.A: 4 }\n"),
      "test.yaml:5:19: steps[0].turn.it.A: it.A has no hand wheel; expected `encoder: { on: wheel }` in "
      "`plant`");
  EXPECT_EQ(diagnostic_of("  - turn: { it.MPG: many }\n").substr(0, 42),
            "test.yaml:5:21: steps[0].turn.it.MPG: 'man");
  EXPECT_EQ(diagnostic_of("  - turn: { it.MPG: 4, in: 2 }\n").substr(0, 35),
            "test.yaml:5:28: steps[0].turn.in: '");
  EXPECT_NE(diagnostic_of("  - turn: { in: 2s }\n").find("turns nothing; expected counts such as"),
            std::string::npos);
  EXPECT_NE(diagnostic_of("  - input: { it.MPG: 4 }\n")
                .find("it.MPG is a counted input; expected `turn` to change it"),
            std::string::npos);
}

TEST(TerminalsOfEveryKind, AWheelTurnsTheMotorThatFollowsIt) {
  World world(bench(), {}, {});
  Workbench& device = bench_of(world);
  world.advance_to(2ms);
  device.state.motors.motors[0].axis.follow({.numerator = 3});
  world.inject(world::find_fault(
      world.known(), {.kind = "turn", .place = "it.MPG", .fields = {{"counts", "400"}, {"in", "1s"}}}));
  world.advance_to(3s);
  EXPECT_EQ(world.sent_pulses(0, 0), 1200);
  EXPECT_EQ(device.output_pulses(kCompare), 120);
}

TEST(TerminalsOfEveryKind, CountsWrapAtThirtyTwoBits) {
  World world(bench(), {}, {});
  for (int i = 0; i < 5; ++i) {
    world.inject(world::find_fault(
        world.known(), {.kind = "turn", .place = "it.EXPP", .fields = {{"counts", "1000000000"}}}));
  }
  world.advance_to(2ms);
  EXPECT_EQ(world.device(0).input(kExternal), 5'000'000'000 - (std::int64_t{1} << 32));
}

TEST(TerminalsOfEveryKind, ATurnUnderWayIsKeptInASnapshot) {
  World world(bench(), {}, {});
  world.inject(world::find_fault(
      world.known(), {.kind = "turn", .place = "it.MPG", .fields = {{"counts", "1001"}, {"in", "1s"}}}));
  world.advance_to(333ms);
  World twin(bench(), {}, {});
  world::restore(twin, world::save(world));
  for (World* one : {&world, &twin}) {
    one->advance_to(2s);
    EXPECT_EQ(one->device(0).input(kHandWheel), 1001);
  }
  EXPECT_TRUE(world::same_state(world, twin));
}

TEST(TerminalsOfEveryKind, TheOutcomeCoversEveryOutput) {
  std::set<std::uint64_t> outcomes = {outcome([](Workbench&) {})};
  for (int i = 0; i < kPlainOutputs; ++i) {
    outcomes.insert(
        outcome([&](Workbench& device) { set_register(device, "Output_" + std::to_string(i), 1); }));
  }
  for (int word = 0; word < kOutputWords; ++word) {
    for (int i = 0; i < kBitsOfGroup; ++i) {
      outcomes.insert(outcome(
          [&](Workbench& device) { set_register(device, "DO_Word_" + std::to_string(word), 1 << i); }));
    }
  }
  outcomes.insert(outcome([](Workbench& device) { set_register(device, "Volts", 5); }));
  outcomes.insert(outcome([](Workbench& device) { ++device.state.motors.compared; }));
  EXPECT_EQ(outcomes.size(), std::size_t{1 + kPlainOutputs + kOutputWords * kBitsOfGroup + 2});
}

TEST(GroupedTerminals, AreSeenAsWordsAndOneByOne) {
  expect_passes(
      "  - input: { it.DI_3_0: on, it.DI_3_15: on }\n"
      "  - assert: [ it.DI_3 == 0x8001, it.DI_3_15 == 1, it.DI_3_14 == 0, it.DI_4 == 0 ]\n"
      "  - write: { it.DO_Word_7: 0x8421 }\n"
      "  - assert: [ it.DO_7 == 0x8421, it.DO_7_5 == 1, it.DO_7_4 == 0, it.DO_6 == 0 ]\n"
      "  - write: { it.Volts: 2500 }\n"
      "  - assert: [ it.VOUT == 2.5V, it.CMP.pulses == 0 ]\n");
}

TEST(GroupedTerminals, AreWordsInATraceUnlessAskedFor) {
  World world(bench(), {}, {});
  std::set<std::string> names;
  for (const auto& signal : world::trace_signals(world, {"it.DI_3_7"})) names.insert(signal.name);
  for (const char* there : {"it.IN0", "it.DI_0", "it.DI_11", "it.DO_7", "it.DI_3_7", "it.VOUT", "it.CMP",
                            "it.CMP.pulses", "it.MPG", "it.OUT79"}) {
    EXPECT_TRUE(names.contains(there)) << there;
  }
  for (const char* absent : {"it.DI_0_0", "it.DI_3_8", "it.DO_7_15"}) {
    EXPECT_FALSE(names.contains(absent)) << absent;
  }
}

TEST(GroupedTerminals, AreTracedBesideRealRegisters) {
  World world(bench(), {}, {});
  std::string text;
  {
    const auto signals = world::trace_signals(world, {});
    const world::Trace trace(world, signals,
                             world::vcd_format([&](std::string_view lines) { text += lines; }));
    world.set_external_input(0, find_terminal(model(), "DI_5_3"), 1);
    world.advance_to(3ms);
  }
  EXPECT_NE(text.find(" DI_5 $end"), std::string::npos);
  EXPECT_NE(text.find("\nb1000 "), std::string::npos) << text;
}

struct Served {
  Served() : daemon(bench(), options(), [](const std::string&) {}) {}
  static serve::DaemonOptions options() {
    serve::DaemonOptions made;
    made.speed.kind = serve::Speed::Kind::manual;
    made.watch_signals = false;
    return made;
  }
  Json ask(const Json& message) {
    Json reply;
    serve::handle_message(daemon, message.dump(),
                          [&](const std::string& line) { reply = Json::parse(line); });
    return reply;
  }
  serve::Daemon daemon;
};

TEST(GroupedTerminals, AreWordsInStatusAndWatch) {
  Served served;
  EXPECT_TRUE(served.ask({{"do", "input"}, {"values", {{"it.DI_3_0", 1}, {"it.DI_3_9", 1}}}})["ok"]);
  EXPECT_TRUE(served.ask({{"do", "turn"}, {"values", {{"it.MPG", 30}}}, {"in", "10ms"}})["ok"]);
  served.daemon.world().advance_to(5ms);
  const Json status = served.ask({{"do", "status"}});
  const Json& device = status["status"]["devices"][0];
  EXPECT_EQ(device["groups"]["DI_3"], 0x201);
  EXPECT_EQ(device["groups"]["DO_0"], 0);
  EXPECT_EQ(device["counts"]["MPG"], 15);
  EXPECT_EQ(device["counts"]["CMP.pulses"], 0);
  EXPECT_EQ(device["outputs"]["VOUT"], 0);
  EXPECT_FALSE(device["inputs"].contains("DI_3_0"));
  EXPECT_EQ(device["inputs"]["IN3"], 0);
  std::string table;
  for (const std::string& line : serve::watch_table(status.dump(), "", 0)) table += line + "\n";
  EXPECT_NE(table.find("  groups     DI_3 0x201\n"), std::string::npos) << table;
  EXPECT_NE(table.find("  counts     CMP.pulses 0  EXPP 0  MPG 15\n"), std::string::npos) << table;
  EXPECT_EQ(served.ask({{"do", "turn"}, {"values", {{"it.IN0", 30}}}})["error"],
            "no axis or counted input of it is called 'IN0'; expected one of A, B, MPG, EXPP");
}

}  // namespace terminals_test
}  // namespace understudy::emulator::workbench
