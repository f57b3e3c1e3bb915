// Correct bench files.
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/models/models.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/emulator/world/bench_file/bench_texts.h"

namespace understudy::emulator::world {
namespace bench_file_test {

TEST(BenchFile, LinesHaveTheirLinkSpeedTimingAndStationsInOrder) {
  const Bench bench = parse(kFullBench);
  ASSERT_EQ(bench.lines.size(), 2u);
  const LineSetup& first = bench.lines[0];
  EXPECT_EQ(first.name, "rs485");
  EXPECT_EQ(first.link, "/benches/feeder.port");
  EXPECT_EQ(first.baud, 19200);
  EXPECT_EQ(first.timing, pty::Timing::wire);
  ASSERT_EQ(first.stations.size(), 2u);
  EXPECT_EQ(bench.devices.at(first.stations[0].device).settings.name, "feeder");
  EXPECT_EQ(bench.devices.at(first.stations[1].device).settings.name, "turner");
  const LineSetup& second = bench.lines[1];
  EXPECT_EQ(second.name, "second");
  EXPECT_EQ(second.link, "");
  EXPECT_EQ(second.baud, 115200);
  EXPECT_EQ(second.timing, pty::Timing::instant);
  ASSERT_EQ(second.stations.size(), 1u);
}

TEST(BenchFile, DevicesHaveWhatWasWrittenInlineOrUnderDevices) {
  const Bench bench = parse(kFullBench);
  ASSERT_EQ(bench.devices.size(), 3u);
  const DeviceSetup& feeder = bench.devices[bench.lines[0].stations[0].device];
  EXPECT_EQ(feeder.model, find_model(models::all_models(), "simple2-r3"));
  EXPECT_EQ(feeder.settings.firmware, 152);
  EXPECT_EQ(feeder.settings.address, 1);
  EXPECT_EQ(feeder.settings.bauds, std::vector{19200});
  EXPECT_TRUE(feeder.settings.set.empty());
  const DeviceSetup& turner = bench.devices[bench.lines[0].stations[1].device];
  EXPECT_EQ(turner.settings.firmware, 140);
  EXPECT_EQ(turner.settings.address, 2);
  EXPECT_EQ(turner.settings.set, (std::vector<std::pair<std::string, Value>>{
                                     {"Aaxis_Speed", 200}, {"Aaxis_Pulse", -32000}, {"DOUT_ALL", 127}}));
  EXPECT_EQ(turner.settings.choices,
            (std::map<std::string, std::string>{{"servo_at_power_up", "on"}, {"limit_reaction", "none"}}));
  const DeviceSetup& lone = bench.devices[bench.lines[1].stations[0].device];
  EXPECT_EQ(lone.settings.name, "lone-one_3");
  EXPECT_EQ(lone.settings.address, 1);
  EXPECT_EQ(lone.settings.bauds, std::vector{115200});
}

TEST(BenchFile, MachinesHaveTheirTravelSwitchesAndEncoder) {
  const Bench bench = parse(kFullBench);
  ASSERT_EQ(bench.machines.size(), 2u);
  const MachineSetup& a = bench.machines[0];
  EXPECT_EQ(bench.devices.at(a.device).settings.name, "feeder");
  EXPECT_EQ(a.axis, 0);
  ASSERT_TRUE(a.plant.travel && a.plant.home);
  EXPECT_EQ(a.plant.travel->first, -20000);
  EXPECT_EQ(a.plant.travel->last, 20000);
  EXPECT_EQ(a.plant.home->first, 0);
  EXPECT_EQ(a.plant.home->last, 199);
  EXPECT_EQ(a.plant.lower_limit, -18000);
  EXPECT_EQ(a.plant.upper_limit, 18000);
  EXPECT_EQ(a.plant.encoder_counts_per_revolution, 4000);
  EXPECT_EQ(a.plant.pulses_per_revolution, 3200) << "the factory value";
  const MachineSetup& b = bench.machines[1];
  EXPECT_EQ(bench.devices.at(b.device).settings.name, "turner");
  EXPECT_EQ(b.axis, 1);
  EXPECT_FALSE(b.plant.travel);
  EXPECT_FALSE(b.plant.home);
  EXPECT_FALSE(b.plant.lower_limit);
  EXPECT_EQ(b.plant.upper_limit, 5);
  EXPECT_EQ(b.plant.encoder_counts_per_revolution, 10000);
  EXPECT_EQ(b.plant.pulses_per_revolution, 800);
}

TEST(BenchFile, WiresJoinAnOutputToAnInput) {
  const Bench bench = parse(kFullBench);
  ASSERT_EQ(bench.wires.size(), 2u);
  const auto name = [&](std::size_t device, int terminal) {
    const DeviceSetup& setup = bench.devices.at(device);
    return setup.settings.name + "." +
           std::string(setup.model->terminals[static_cast<std::size_t>(terminal)].name);
  };
  EXPECT_EQ(name(bench.wires[0].from_device, bench.wires[0].from_terminal), "feeder.DOUT_4");
  EXPECT_EQ(name(bench.wires[0].to_device, bench.wires[0].to_terminal), "turner.DIN_10");
  EXPECT_EQ(name(bench.wires[1].from_device, bench.wires[1].from_terminal), "turner.DOUT_0");
  EXPECT_EQ(name(bench.wires[1].to_device, bench.wires[1].to_terminal), "feeder.DIN_9");
}

TEST(BenchFile, ALineListensWhereItSays) {
  const auto line_of = [](const std::string& keys) {
    return parse_bench(
               models::all_models(),
               "understudy: 1\nlines: { a: { " + keys + "stations: [ { name: x, model: simple2-r3 } ] } }\n",
               "bench.yaml", "/benches")
        .lines[0];
  };
  const LineSetup plain = line_of("");
  EXPECT_TRUE(plain.has_pty);
  EXPECT_TRUE(plain.tcp.empty());
  const LineSetup both = line_of("listen: [ 'rtu://:0', 'rfc2217://192.168.1.2:5021' ], ");
  ASSERT_EQ(both.tcp.size(), 2U);
  EXPECT_EQ(to_string(both.tcp[0]), "rtu://127.0.0.1:0");
  EXPECT_EQ(to_string(both.tcp[1]), "rfc2217://192.168.1.2:5021");
  EXPECT_TRUE(both.has_pty);
  const LineSetup only = line_of("listen: modbus-tcp://:502, pty: false, ");
  ASSERT_EQ(only.tcp.size(), 1U);
  EXPECT_EQ(to_string(only.tcp[0]), "modbus-tcp://127.0.0.1:502");
  EXPECT_FALSE(only.has_pty);
}

TEST(BenchFile, LinksAreRelativeToTheFilesFolder) {
  const auto link_of = [](const std::string& link, const std::string& folder) {
    return parse_bench(models::all_models(),
                       "understudy: 1\nlines: { a: { link: " + link +
                           ", stations: [ { name: x, model: simple2-r3 } ] } }",
                       "b.yaml", folder)
        .lines.at(0)
        .link;
  };
  EXPECT_EQ(link_of("./x.port", "/benches"), "/benches/x.port");
  EXPECT_EQ(link_of("x.port", "benches/sub"), "benches/sub/x.port");
  EXPECT_EQ(link_of("../x.port", "/benches/sub"), "/benches/x.port");
  EXPECT_EQ(link_of("/dev/shm/x.port", "/benches"), "/dev/shm/x.port");
  EXPECT_EQ(link_of("x.port", ""), "x.port");
}

TEST(BenchFile, AFileIsReadAsItsText) {
  std::string folder = "/tmp/bench-file-XXXXXX";
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  const std::string path = folder + "/bench.yaml";
  std::ofstream(path) << kFullBench;
  EXPECT_EQ(load_bench(models::all_models(), path).lines.at(0).link, folder + "/feeder.port");
  std::ofstream(path)
      << "understudy: 1\nline: {}\nlines: { a: { stations: [ { name: x, model: simple2-r3 } ] } }\n";
  try {
    load_bench(models::all_models(), path);
    ADD_FAILURE() << "it has an unknown key";
  } catch (const BenchError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with(path + ":2:7: line: ")) << error.what();
  }
  std::filesystem::remove_all(folder);
}

TEST(BenchFile, WhatIsNoReadableFileIsRefused) {
  const std::string none = "cannot be read (No such file or directory)";
  for (const auto& [path, why] : std::vector<std::pair<std::string, std::string>>{
           {"/nowhere/bench.yaml", none},
           {"/tmp", "is not a regular file"},
           {"", none},
           {"/dev/null/x", "cannot be read (Not a directory)"}}) {
    try {
      load_bench(models::all_models(), path);
      ADD_FAILURE() << path;
    } catch (const BenchError& error) {
      EXPECT_EQ(error.what(), path + ": bench: " + why + "; expected a bench file");
    }
  }
}

TEST(BenchFile, WindowsLineEndsAndAByteOrderMarkDoNoHarm) {
  std::string text = "\xEF\xBB\xBF";
  for (const char c : kFullBench) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(diagnostic(text), "");
}

TEST(FindTerminal, KnowsTheModelsTerminalsAndAxes) {
  const Model& model = *find_model(models::all_models(), "simple2-r3");
  for (int i = 0; i <= 10; ++i) {
    const int terminal = find_terminal(model, "DIN_" + std::to_string(i));
    ASSERT_GE(terminal, 0) << i;
    EXPECT_EQ(model.terminals[static_cast<std::size_t>(terminal)].kind, TerminalRow::Kind::digital_in);
  }
  for (int i = 0; i <= 6; ++i) {
    const int terminal = find_terminal(model, "DOUT_" + std::to_string(i));
    ASSERT_GE(terminal, 0) << i;
    EXPECT_EQ(model.terminals[static_cast<std::size_t>(terminal)].kind, TerminalRow::Kind::digital_out);
  }
  for (const char* name : {"DIN_11", "DOUT_7", "DIN_", "din_1", "", "A"})
    EXPECT_EQ(find_terminal(model, name), -1);
  EXPECT_EQ(find_axis(model, "A"), 0);
  EXPECT_EQ(find_axis(model, "B"), 1);
  for (const char* name : {"a", "C", "", "AB"}) EXPECT_EQ(find_axis(model, name), -1);
}

}  // namespace bench_file_test
}  // namespace understudy::emulator::world
