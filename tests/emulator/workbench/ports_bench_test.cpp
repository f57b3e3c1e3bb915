// A device with two ports in bench files: what is allowed, what is not, and where errors are reported.
#include <gtest/gtest.h>

#include "emulator/world/bench/bench_text.h"
#include "tests/emulator/workbench/two_lines.h"

namespace understudy::emulator::workbench {
namespace ports_bench_test {

using world::StationSetup;

TEST(PortsOfABench, AreThoseThatStationsName) {
  const world::Bench bench = workbench_bench(two_lines_text());
  ASSERT_EQ(bench.devices.size(), 1U);
  EXPECT_EQ(bench.lines[0].stations, (std::vector<StationSetup>{{0, 0}}));
  EXPECT_EQ(bench.lines[1].stations, (std::vector<StationSetup>{{0, 1}}));
  EXPECT_EQ(world::known_devices_of(bench)[0].lines, (std::vector<std::string>{"pc", "hmi"}));
  EXPECT_EQ(bench.devices[0].settings.address, std::nullopt) << "from its memory";
}

TEST(PortsOfABench, HaveSpeedsOfTheirOwn) {
  const TwoLines two(
      "understudy: 1\nlines:\n  a: { baud: 38400, stations: [ { name: mill, model: workbench, port: HMI } ] "
      "}\n"
      "  b: { baud: 9600, stations: [ { device: mill, address: 7 } ] }\n");
  EXPECT_EQ(pty::to_string(two.world.line(0).line.options().settings), "38400 8N1");
  EXPECT_EQ(pty::to_string(two.world.line(1).line.options().settings), "9600 8E1");
  EXPECT_EQ(two.bench.devices[0].settings.bauds, (std::vector{9600, 38400}));
  EXPECT_EQ(two.world.device(0).station_number(), 7);
  const TwoLines one("understudy: 1\nlines: { a: { stations: [ { name: mill, model: workbench } ] } }\n");
  EXPECT_EQ(pty::to_string(one.world.line(0).line.options().settings), "115200 8E1") << "its first port";
  EXPECT_EQ(pty::to_string(one.world.device(0).line_settings(1)), "19200 8N1") << "on no line";
}

TEST(PortsOfABench, ComeBackFromItsText) {
  const world::Bench bench = workbench_bench(two_lines_text("baud_tolerance: 1%, "));
  const std::string text = world::to_text(bench);
  EXPECT_NE(text.find(R"({"device":"mill","port":"HMI"})"), std::string::npos) << text;
  EXPECT_EQ(world::to_text(world::parse_recorded_bench(kWorkbenchModels, text)), text);
}

TEST(PortsOfABench, AreAllServedOfOneDevice) {
  DeviceSettings settings;
  settings.name = "device";
  const world::Bench bench = world::bench_of_one(model(), settings, "/tmp/P");
  ASSERT_EQ(bench.lines.size(), 2U);
  EXPECT_EQ(bench.lines[0].name + " " + bench.lines[0].link, "PC /tmp/P");
  EXPECT_EQ(bench.lines[1].name + " " + bench.lines[1].link, "HMI /tmp/P.HMI");
  EXPECT_EQ(bench.lines[1].stations, (std::vector<StationSetup>{{0, 1}}));
  EXPECT_EQ(world::bench_of_one(model(), settings, "").lines[1].link, "");
  for (const Model* single : models::all_models()) {
    if (single->line.ports.size() > 1) continue;
    const world::Bench of_one = world::bench_of_one(*single, settings, "/tmp/P");
    ASSERT_EQ(of_one.lines.size(), 1U) << single->name;
    EXPECT_EQ(of_one.lines[0].name + " " + of_one.lines[0].link, "line /tmp/P") << single->name;
  }
}

std::string diagnostics_of(const std::string& text) {
  try {
    workbench_bench(text);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "none";
}

/// Stations of the lines a and b, in flow style from line 3 on.
std::string lines_ab(const std::string& of_a, const std::string& of_b, const std::string& devices = "") {
  return "understudy: 1\nlines:\n  a: { stations: [ " + of_a + " ] }\n  b: { stations: [ " + of_b + " ] }\n" +
         devices;
}

TEST(PortsOfABench, AreRefusedWhereTheyCannotBe) {
  const std::string mill = "{ device: mill }";
  const std::string devices = "devices:\n  mill: { model: workbench }\n  lathe: { model: workbench }\n";
  const std::string one = "devices:\n  mill: { model: workbench }\n";
  struct Case {
    std::string text;
    std::string diagnostic;
  };
  const std::vector<Case> cases{
      {lines_ab(mill, "{ device: mill, port: RS422 }", one),
       "bench.yaml:4:42: lines.b.stations[0].port: 'RS422' is not a port of workbench; expected one of PC, "
       "HMI"},
      {lines_ab(mill, "{ device: mill, port: HMMI }", one),
       "bench.yaml:4:42: lines.b.stations[0].port: 'HMMI' is not a port of workbench; the nearest is 'HMI'"},
      {lines_ab(mill, mill, one),
       "bench.yaml:4:20: lines.b.stations[0]: the device's port PC is already on a line; expected another "
       "`port`, or the device on one line"},
      {lines_ab("{ device: mill, port: HMI }", "{ device: mill, port: HMI }", one),
       "bench.yaml:4:20: lines.b.stations[0]: the device's port HMI is already on a line; expected another "
       "`port`, or the device on one line"},
      {lines_ab("{ device: mill }, { device: mill, port: HMI }", "{ name: x, model: workbench }", one),
       "bench.yaml:3:38: lines.a.stations[1]: the device is already on this line, with its port PC; expected "
       "another line"},
      {lines_ab(mill, "{ device: mill, port: HMI }", devices),
       "bench.yaml:7:10: devices.lathe: the device is not on a line; expected a station that names it"},
      {lines_ab("{ device: mill }, { device: lathe }", "{ device: mill, port: HMI }", devices),
       "bench.yaml:3:38: lines.a.stations[1]: address 1 is taken on this line; expected another address"},
      {lines_ab("{ device: mill, address: 5 }, { device: lathe, address: 5 }", "{ device: mill, port: HMI }",
                devices),
       "bench.yaml:3:50: lines.a.stations[1]: address 5 is taken on this line; expected another address"},
      {lines_ab("{ device: mill }, { device: lathe, address: 5 }", "{ device: mill, port: HMI, address: 5 }",
                devices),
       "bench.yaml:3:38: lines.a.stations[1]: address 5 is taken on this line; expected another address"},
      // The register of its number can be set, which comes after the address; by number as well.
      {lines_ab(
           "{ device: mill, address: 4 }, { device: lathe, address: 5 }", "{ device: mill, port: HMI }",
           "devices:\n  mill: { model: workbench, set: { Station: 5 } }\n  lathe: { model: workbench }\n"),
       "bench.yaml:3:50: lines.a.stations[1]: address 5 is taken on this line; expected another address"},
      {lines_ab("{ device: mill }, { device: lathe, address: 5 }", "{ device: mill, port: HMI }",
                "devices:\n  mill: { model: workbench, nv: m.json, set: { 0x0033: 5 } }\n"
                "  lathe: { model: workbench }\n"),
       "bench.yaml:3:38: lines.a.stations[1]: address 5 is taken on this line; expected another address"},
      {lines_ab(
           "{ device: mill, address: 5 }, { device: lathe, address: 5 }", "{ device: mill, port: HMI }",
           "devices:\n  mill: { model: workbench, set: { Station: 4 } }\n  lathe: { model: workbench }\n"),
       "none"},
      {lines_ab("{ device: mill, address: 5 }", "{ device: mill, port: HMI, address: 6 }", one),
       "bench.yaml:4:56: lines.b.stations[0].address: the device has one station number, and on another line "
       "it is 5; expected the same number"},
      {lines_ab(mill, "{ device: mill, port: HMI, address: 248 }", one),
       "bench.yaml:4:56: lines.b.stations[0].address: '248' is not valid; expected a whole number from 0 "
       "to 247"},
      {lines_ab(mill, "{ device: mill, port: HMI }, { device: lathe, address: 2 }", devices),
       "bench.yaml:4:49: lines.b.stations[1]: 'mill' is on this line with HMI, an RS232 port, and must be "
       "alone on "
       "its "
       "line; expected no other station on it"},
      {"understudy: 1\nlines:\n  a: { stations: [ { device: mill } ] }\n"
       "  b: { baud: 300, stations: [ { device: mill, port: HMI } ] }\n" +
           one,
       "bench.yaml:4:31: lines.b.stations[0]: baud: 300 is not a speed of workbench (HMI); expected one of "
       "19200, 38400"},
      // All in one round.
      {lines_ab("{ device: mill, port: X }, { device: lathe }", "{ device: lathe }, { device: mil }",
                devices),
       "bench.yaml:3:42: lines.a.stations[0].port: 'X' is not a port of workbench; expected one of PC, "
       "HMI\nbench.yaml:3:47: lines.a.stations[1]: address 1 is taken on this line; expected another "
       "address\n"
       "bench.yaml:4:20: lines.b.stations[0]: the device's port PC is already on a line; expected "
       "another `port`, or the device on one line\nbench.yaml:4:49: lines.b.stations[1].device: no device is "
       "called 'mil'; the nearest is 'mill'"},
  };
  for (const auto& [text, diagnostic] : cases) EXPECT_EQ(diagnostics_of(text), diagnostic) << text;
}

TEST(PortsOfABench, AreNamedForModelsOfOneAsWell) {
  const auto diagnostic = [](const std::string& port) -> std::string {
    try {
      world::parse_bench(models::all_models(),
                         "understudy: 1\nlines: { a: { stations: [ { name: x, model: simple2-r3, port: " +
                             port + " } ] } }\n",
                         "bench.yaml", "/tmp");
    } catch (const std::exception& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(diagnostic("RS485"), "none");
  EXPECT_EQ(diagnostic("USB"),
            "bench.yaml:2:63: lines.a.stations[0].port: 'USB' is not a port of simple2-r3; expected 'RS485'");
}

TEST(PortsOfABench, LeaveANumberInAFileOpen) {
  const std::string devices =
      "devices:\n  mill: { model: workbench, nv: /tmp/none/m.json }\n  lathe: { model: workbench, nv: l.json "
      "}\n";
  EXPECT_EQ(
      diagnostics_of("understudy: 1\nlines:\n  a: { stations: [ { device: mill }, { device: lathe } ] }\n" +
                     devices),
      "none");
}

}  // namespace ports_bench_test
}  // namespace understudy::emulator::workbench
