// Modbus ASCII on a line: a described model, as hosts meet it. The checksums of the frames are pymodbus's.
#include "emulator/world/stations/ascii_station.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "emulator/play/performing/run.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/play/results/result_text.h"
#include "emulator/serve/ports/modbus_tcp.h"
#include "emulator/world/coverage/controller_coverage.h"
#include "emulator/world/frames/frame_log.h"
#include "emulator/world/protocol/line_protocol.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/world.h"
#include "tests/emulator/model_file/described.h"

namespace understudy::emulator::world {
namespace ascii_station_test {

using namespace std::chrono_literals;
using model_file::described_models;
using model_file::model_with;
using model_file::quoted_scalar;
using model_file::with_described;

const std::string kModel =
    model_with("address,name,min,max,default,access\n0,A,0,100,7,\n1,B,0,100,0,\n2,C,,,0,R\n",
               "line: { framing: ascii, baud: 9600 }\n");

std::string bench_text(const std::string& line = "", const std::string& more = "") {
  return "understudy: 1\nlines:\n  a: { " + line + "stations: [ { name: it, model: " + quoted_scalar(kModel) +
         ", address: 17 } ] }\n" + more;
}

Bench bench_of(const std::string& text) { return parse_bench(with_described(), text, "b.yaml", "."); }

/// A world with a host on its only line.
struct Rig {
  explicit Rig(const std::string& text = bench_text("timing: instant, ")) : world(bench_of(text), {}, {}) {
    world.host_opened(0);
  }

  /// Sends characters, waits, and returns what came back.
  std::string exchange(const std::string& characters, SimTime wait = 2s) {
    send(characters);
    world.advance_to(world.now() + wait);
    return taken();
  }
  void send(const std::string& characters) {
    world.receive(0, {reinterpret_cast<const std::uint8_t*>(characters.data()), characters.size()});
  }
  std::string taken() {
    const auto output = world.line(0).line.output();
    const std::string text(output.begin(), output.end());
    world.take_output(0, output.size());
    return text;
  }

  World world;
};

TEST(AsciiStation, AnswersItsFrames) {
  Rig rig;
  struct Exchange {
    const char* meaning;
    const char* request;
    const char* reply;
  };
  const Exchange kExchanges[] = {
      {"read A and B", ":110300000002EA\r\n", ":11030400070000E1\r\n"},
      {"B = 3", ":110600010003E5\r\n", ":110600010003E5\r\n"},
      {"read B", ":110300010001EA\r\n", ":1103020003E7\r\n"},
      {"beyond the range", ":1106000003E8FE\r\n", ":11860366\r\n"},
      {"a hole", ":110300050001E6\r\n", ":1183026A\r\n"},
      {"a function that it has not, and a byte", ":110700E8\r\n", ":11870167\r\n"},
      {"a function that it has not", ":1107E8\r\n", ":11870167\r\n"},
      {"another station", ":120300000002E9\r\n", ""},
      {"a broadcast: B = 4", ":000600010004F5\r\n", ""},
      {"read B, in small letters", ":110300010001ea\r\n", ":1103020004E6\r\n"},
      {"a wrong LRC", ":110300010001EB\r\n", ""},
      {"an RTU frame", "\x11\x03", ""},
      {"noise before a frame", "\xFF:11:110300010001EA\r\n", ":1103020004E6\r\n"},
  };
  for (const Exchange& one : kExchanges) EXPECT_EQ(rig.exchange(one.request), one.reply) << one.meaning;
}

/// At 9600 7E1 a character has ten bits.
TEST(AsciiStation, TakesTheTimeOfItsCharacters) {
  Rig rig(bench_text());
  EXPECT_EQ(pty::to_string(rig.world.line(0).line.options().settings), "9600 7E1");
  const std::string request = ":110300010001EA\r\n";
  const std::string reply = ":1103020000EA\r\n";
  const auto time_of = [](std::size_t characters) {
    return SimTime{static_cast<std::int64_t>(characters) * 10 * 1'000'000'000 / 9600};
  };
  rig.send(request);
  rig.world.advance_to(time_of(request.size() + reply.size()) - 1us);
  EXPECT_EQ(rig.taken(), reply.substr(0, reply.size() - 1));
  rig.world.advance_to(time_of(request.size() + reply.size()) + 1us);
  EXPECT_EQ(rig.taken(), "\n");
}

TEST(AsciiStation, WaitsASecondBetweenCharacters) {
  Rig rig;
  EXPECT_EQ(rig.exchange(":1103", 999ms), "");
  EXPECT_EQ(rig.exchange("00010001EA\r\n"), ":1103020000EA\r\n");
  EXPECT_EQ(rig.exchange(":1103", 1001ms), "");
  EXPECT_EQ(rig.exchange("00010001EA\r\n"), "");
  EXPECT_EQ(rig.world.line(0).stations[0]->dropped_bytes(), 17U);
}

TEST(AsciiStation, ContinuesFromASnapshot) {
  Rig rig;
  rig.exchange(":110600010009DF\r\n:1103");
  const WorldState state = save(rig.world);
  Rig other;
  restore(other.world, state);
  EXPECT_EQ(other.exchange("00010001EA\r\n", 10ms), rig.exchange("00010001EA\r\n", 10ms));
  EXPECT_EQ(hash(rig.world), hash(other.world));
}

TEST(AsciiStation, IsShownInWords) {
  Rig rig;
  FrameLog log(rig.world);
  rig.exchange(":110600010003E5\r\n");
  rig.exchange(":110300010001EB\r\n");
  rig.exchange(":110300050001E6\r\n");
  std::string text;
  for (const std::string& line : log.last(10)) text += line.substr(line.find(' ') + 1) + "\n";
  EXPECT_EQ(
      text,
      "a -> write 0x0001 it.B = 3\na <- done\n"
      "a -> 3A 31 31 30 33 30 30 30 31 30 30 30 31 45 42 0D 0A  (dropped: bad LRC)\n"
      "a -> read 0x0005 0x0005\na <- exception 2 (illegal data address): there is no register at 0x0005; the "
      "last is 0x0002 C\n");
}

TEST(AsciiStation, HasTheFaultsOfModbusFrames) {
  Rig rig(bench_text("timing: instant, ",
                     "faults:\n  - { corrupt_checksum: it, function: 3, nth: 1 }\n"
                     "  - { exception: it, function: 6, code: 4, nth: 1 }\n"));
  EXPECT_EQ(rig.exchange(":110300010001EA\r\n"), ":1103020000E0\r\n");
  EXPECT_EQ(rig.exchange(":110300010001EA\r\n"), ":1103020000EA\r\n");
  EXPECT_EQ(rig.exchange(":110600010003E5\r\n"), ":11860465\r\n");
  EXPECT_EQ(rig.exchange(":110600010003E5\r\n"), ":110600010003E5\r\n");
  EXPECT_THROW(bench_of(bench_text("", "faults: [ { early_reply: it } ]\n")), FileError);
}

TEST(AsciiStation, SharesItsLineWithItsLikeOnly) {
  const std::string other = model_with("address,name\n0,A\n", "");
  try {
    bench_of(
        "understudy: 1\nlines:\n  a:\n    stations:\n      - { name: it, model: " + quoted_scalar(kModel) +
        ", address: 1 }\n      - { name: its, model: " + quoted_scalar(other) + ", address: 2 }\n");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_NE(
        std::string(error.what())
            .find("'its' speaks Modbus, but the line speaks Modbus ASCII; expected one protocol on a line"),
        std::string::npos)
        << error.what();
  }
}

TEST(AsciiStation, IsAskedByTheHostOfScenarios) {
  std::string bench = "bench:\n";
  std::string rest = bench_text();
  rest.erase(0, rest.find('\n') + 1);  // the line `understudy: 1`
  for (std::size_t begin = 0; begin < rest.size();) {
    const std::size_t end = rest.find('\n', begin);
    bench += "  " + rest.substr(begin, end - begin) + "\n";
    begin = end + 1;
  }
  const std::string text = "understudy: 1\nname: test\n" + bench +
                           "steps:\n"
                           "  - write: { it.B: 42 }\n"
                           "  - wait: { until: it.A == 7 && it.B == 42, poll: 20ms, within: 1s }\n"
                           "  - write: { it.B: 101 }\n    exception: 3\n"
                           "  - send: { bytes: 3A 31 31 30 33 30 30 30 31 30 30 30 31 45 41 0D 0A,\n"
                           "            reply: 3A 31 31 30 33 30 32 30 30 32 41 43 30 0D 0A }\n";
  const play::Scenario scenario = play::parse_scenarios(with_described(), text, "s.yaml").front();
  const play::ScenarioResult result = play::run_scenario(scenario, {}).front();
  std::string why;
  for (const std::string& line : play::failure_lines(result)) why += line + "\n";
  EXPECT_EQ(result.verdict, play::ScenarioResult::Verdict::passed) << why;
}

TEST(AsciiStation, IsAskedThroughAGateway) {
  Rig rig;
  serve::ModbusTcp gateway({.is_ascii = true});
  const std::vector<std::uint8_t> request{0, 9, 0, 0, 0, 6, 0x11, 3, 0, 0, 0, 2};
  ASSERT_TRUE(gateway.receive_from_client(request));
  const auto frame = gateway.take_for_line(1024);
  EXPECT_EQ(std::string(frame.begin(), frame.end()), ":110300000002EA\r\n");
  for (const char* const noise : {"\n", ":1103\r\n", ":120300000002E9\r\n"})
    for (const char c : std::string(noise))
      gateway.receive_from_line(std::array{static_cast<std::uint8_t>(c)});
  EXPECT_TRUE(gateway.waits());
  for (const char c : rig.exchange({frame.begin(), frame.end()}))
    gateway.receive_from_line(std::array{static_cast<std::uint8_t>(c)});
  EXPECT_EQ(gateway.take_for_client(), (std::vector<std::uint8_t>{0, 9, 0, 0, 0, 7, 0x11, 3, 4, 0, 7, 0, 0}));
}

TEST(AsciiLine, HasItsOwnSettings) {
  const auto settings = [](const std::string& line) {
    const Model& model = described_models().parse(
        model_with("address,name\n0,A\n", "line: { framing: ascii" + line + " }\n"), "m.yaml");
    pty::LineSettings made = model.line.ports[0].settings;
    made.baud = model.line.ports[0].bauds[0];
    return pty::to_string(made);
  };
  EXPECT_EQ(settings(""), "19200 7E1");
  EXPECT_EQ(settings(", parity: none, stop_bits: 2"), "19200 7N2");
  EXPECT_EQ(settings(", data_bits: 8, parity: none"), "19200 8N1");
  const auto wrong = [](const std::string& line) {
    return model_file::diagnostic_about(model_with("address,name\n0,A\n", "line: { " + line + " }\n"));
  };
  EXPECT_EQ(
      wrong("data_bits: 7"),
      "m.yaml:6:20: line.data_bits: Modbus RTU frames have bytes of 8 bits; expected 8, or `framing: ascii`");
  EXPECT_EQ(wrong("framing: ascii, silence: 2ms"),
            "m.yaml:6:34: line.silence: ends Modbus RTU frames; expected no `silence` with `framing: ascii`");
  EXPECT_EQ(wrong("framing: asci"), "m.yaml:6:18: line.framing: 'asci' is not valid; the nearest is 'ascii'");
}

}  // namespace ascii_station_test
}  // namespace understudy::emulator::world
