// Wrong bench files: each error is one line with its place, the error and what was expected.
#include <gtest/gtest.h>

#include "tests/emulator/world/bench_file/bench_texts.h"

namespace understudy::emulator::world {
namespace bench_errors_test {

struct Bad {
  std::string text;
  std::string diagnostic;  // after "bench.yaml:"
};

void expect_diagnostics(const std::vector<Bad>& files) {
  for (const Bad& file : files)
    EXPECT_EQ(diagnostic(file.text), "bench.yaml:" + file.diagnostic) << file.text;
}

/// A file whose fifth line is a station.
std::string with_station(const std::string& station) {
  return "understudy: 1\nlines:\n  a:\n    stations:\n      - " + station + "\n";
}

/// A file whose fifth line adds something to a valid station.
std::string with(const std::string& more) {
  return with_station("{ name: x, model: simple2-r3, " + more + " }");
}

/// A valid file of five lines, and the rest from the sixth on.
std::string and_then(const std::string& more) {
  return with_station("{ name: x, model: simple2-r3 }") + more;
}

/// A file whose third line describes a line.
std::string with_line(const std::string& line) { return "understudy: 1\nlines:\n  a: { " + line + " }\n"; }

const std::string kStation = "stations: [ { name: x, model: simple2-r3 } ]";
const std::string kLines = "lines: { a: { " + kStation + " } }\n";

TEST(BenchErrors, AFileThatIsNoMap) {
  const std::string no_map = "1: bench: the file is not a map; expected `understudy: 1` and `lines:`";
  expect_diagnostics({
      {"", no_map},
      {" \n\n", no_map},
      {"# only a remark\n", no_map},
      {"hello", no_map},
      {"- 1\n- 2\n", no_map},
      {"~", no_map},
      {std::string("\0\x01\x02\xFF", 4), no_map},
  });
}

TEST(BenchErrors, AFileThatIsNoYaml) {
  for (const auto& [text, line] :
       std::vector<std::pair<std::string, int>>{{"understudy: 1\nlines: [ a\n", 3},
                                                {"understudy: 1\n\tlines: x\n", 2},
                                                {"understudy: 1\nlines: *nobody\n", 2},
                                                {"understudy: 1\nlines: }\n", 2},
                                                {std::string("understudy: 1\n\0", 15), 2},
                                                {"%YAML 9.9\n---\nunderstudy: 1\n", 1}}) {
    const std::string got = diagnostic(text);
    EXPECT_TRUE(got.starts_with("bench.yaml:" + std::to_string(line) + ": bench: is not YAML: ")) << got;
  }
}

TEST(BenchErrors, TheFormatsVersion) {
  expect_diagnostics({
      {kLines, "1: bench: 'understudy' is missing; expected it here"},
      {"understudy: 2\n" + kLines, "1: understudy: '2' is not valid; expected 1"},
      {"understudy: one\n" + kLines, "1: understudy: 'one' is not valid; expected 1"},
      {"understudy: [1]\n" + kLines, "1: understudy: expected a word or a number"},
      {"understudy: 1.0\n" + kLines, "1: understudy: '1.0' is not valid; expected 1"},
      {"understudy: 99999999999999999999\n" + kLines,
       "1: understudy: '99999999999999999999' is not valid; expected 1"},
  });
}

TEST(BenchErrors, KeysThatAreUnknownOrGivenTwice) {
  expect_diagnostics({
      {"understudy: 1\nline: {}\n" + kLines,
       "2: line: is not a key here; expected one of understudy, lines, devices, plant, wires, inputs, "
       "faults, "
       "seed (the nearest is 'lines')"},
      {"understudy: 1\n" + kLines + "lines: {}\n", "3: lines: is given twice; expected it only once"},
      {"understudy: 1\nunderstudy: 1\n" + kLines, "2: understudy: is given twice; expected it only once"},
      {with_line("speed: 1, " + kStation),
       "3: lines.a.speed: is not a key here; expected one of link, listen, pty, baud, baud_tolerance, "
       "byte_timeout, timing, echo, stations"},
      {with("adress: 2"),
       "5: lines.a.stations[0].adress: is not a key here; expected one of name, model, address, port, "
       "firmware, "
       "modules, set, "
       "choices, dip, program, nv (the nearest is 'address')"},
      {with("address:2"),
       "5: lines.a.stations[0].address:2: has no space after its ':'; expected `address: 2`"},
      {with("set: { Aaxis_Speed:1 }"),
       "5: lines.a.stations[0].set.Aaxis_Speed:1: has no space after its ':'; expected `key: value`"},
      {with("model: simple2-r3"), "5: lines.a.stations[0].model: is given twice; expected it only once"},
      {with("set: { Aaxis_Speed: 1, Aaxis_Speed: 2 }"),
       "5: lines.a.stations[0].set.Aaxis_Speed: is given twice; expected it only once"},
      {and_then("devices:\n  x2: { model: simple2-r3, address: 2 }\n"),
       "7: devices.x2.address: is not a key here; expected one of model, firmware, modules, set, choices, "
       "dip, "
       "program, "
       "nv"},
      {and_then("plant:\n  x.A: { travels: [0, 1] }\n"),
       "7: plant.x.A.travels: is not a key here; expected one of position, travel, home, near_home, "
       "mark, limits, encoder, "
       "drive "
       "(the "
       "nearest is "
       "'travel')"},
      {and_then("plant:\n  x.A: {}\n  x.A: {}\n"), "8: plant.x.A: is given twice; expected it only once"},
  });
}

TEST(BenchErrors, Lines) {
  expect_diagnostics({
      {"understudy: 1\n", "1: bench: 'lines' is missing; expected it here"},
      {"understudy: 1\nlines: {}\n", "2: lines: has no lines; expected at least one"},
      {"understudy: 1\nlines: [ a ]\n", "2: lines: expected a map, as in `key: value`"},
      {"understudy: 1\nlines: a\n", "2: lines: expected a map, as in `key: value`"},
      {"understudy: 1\nlines:\n  a.b: { " + kStation + " }\n",
       "3: lines.a.b: 'a.b' is not a name; expected letters, digits, _ and -"},
      // No file can have this name: ports and memories are named after devices.
      {"understudy: 1\nlines:\n  " + std::string(101, 'a') + ": { " + kStation + " }\n",
       "3: lines." + std::string(101, 'a') + ": has a name of 101 characters; expected at most 100"},
      {"understudy: 1\nlines:\n  a: { link: /tmp/" + std::string(201, 'p') + ", " + kStation + " }\n",
       "3: lines.a.link: has a name of 201 characters; expected at most 200"},
      {with_line(""), "3: lines.a: 'stations' is missing; expected it here"},
      {with_line("stations: []"), "3: lines.a.stations: is empty; expected at least one station"},
      {with_line("stations: {}"), "3: lines.a.stations: expected a list, as in `[ a, b ]`"},
      {with_line("baud: 0, " + kStation),
       "3: lines.a.baud: '0' is not valid; expected a whole number from 1 to 4000000"},
      {with_line("baud: 9600, " + kStation),
       "3: lines.a.stations[0]: baud: 9600 is not a speed of simple2-r3; expected one of 19200, 115200"},
      {with_line("baud_tolerance: 11%, " + kStation),
       "3: lines.a.baud_tolerance: '11%' is not valid; expected 0% to 10%, as in 2%"},
      {with_line("listen: tcp://:1, " + kStation),
       "3: lines.a.listen: 'tcp://:1'"
       " is not an address; expected rtu://HOST:PORT, rfc2217://HOST:PORT or modbus-tcp://HOST:PORT, such as "
       "rtu://127.0.0.1:5020"},
      {with_line("byte_timeout: 9ms, " + kStation),
       "3: lines.a.byte_timeout: '9ms' is not valid; expected 10ms to 60s, as in 200ms"},
      {with_line("byte_timeout: 61s, " + kStation),
       "3: lines.a.byte_timeout: '61s' is not valid; expected 10ms to 60s, as in 200ms"},
      {with_line("echo: true, " + kStation), "3: lines.a.echo: 'true' is not valid; expected on or off"},
      {with_line("listen: [ 'rtu://:1', 'rtu://here' ], " + kStation),
       "3: lines.a.listen[1]: 'rtu://here'"
       " is not an address; expected rtu://HOST:PORT, rfc2217://HOST:PORT or modbus-tcp://HOST:PORT, such as "
       "rtu://127.0.0.1:5020"},
      {with_line("listen: 'rtu://:99999', " + kStation),
       "3: lines.a.listen: 'rtu://:99999' has port 99999; expected 0 to 65535"},
      {with_line("listen: [ 'rtu://:1', 'rfc2217://127.0.0.1:1' ], " + kStation),
       "3: lines.a.listen[1]: appears twice; expected it only once"},
      {with_line("listen: 'modbus-tcp://:1', stations: [ { name: x, model: slim } ]"),
       "3: lines.a.listen: the line carries lines of text, not Modbus; expected rtu:// or rfc2217://, which "
       "carry any bytes"},
      {with_line("pty: false, " + kStation),
       "3: lines.a.pty: leaves the line without a port; expected `listen`"},
      {with_line("pty: false, link: p, listen: 'rtu://:0', " + kStation),
       "3: lines.a.link: needs a pseudo-terminal, but `pty` is false; expected one of the two"},
      {with_line("timing: fast, " + kStation),
       "3: lines.a.timing: 'fast' is not a timing; expected wire or instant"},
      {with_line("link: '', " + kStation), "3: lines.a.link: is empty; expected a path"},
      {with_line("link: \"a\\nb\", " + kStation),
       "3: lines.a.link: has a control character; expected a path without one"},
      {with_line("link: [ a ], " + kStation), "3: lines.a.link: expected a word or a number"},
      {with_line("link: \"tcp://:1502\", " + kStation),
       "3: lines.a.link: 'tcp://:1502' is a network address; expected a path for a pseudo-terminal "
       "(`listen` has addresses)"},
      {with_line("link: /, " + kStation),
       "3: lines.a.link: '/' is a folder; expected the path of a link in this folder"},
      {with_line("link: ., " + kStation),
       "3: lines.a.link: '.' is a folder; expected the path of a link in this folder"},
      {with_line("link: /tmp, " + kStation),
       "3: lines.a.link: '/tmp' is a folder; expected the path of a link in this folder"},
      {with_line("link: /dev/null, " + kStation),
       "3: lines.a.link: '/dev/null' is a device file of this machine; expected a free path"},
      {with_station("{ name: time, model: simple2-r3 }"),
       "5: lines.a.stations[0].name: means simulated time in conditions; expected another name"},
      {with_line("link: ./p, " + kStation) +
           "  b: { link: sub/../p, stations: [ { name: y, model: simple2-r3 } ] }\n",
       "4: lines.b.link: line 'a' has the same link; expected another path"},
  });
}

TEST(BenchErrors, Stations) {
  const std::string at = "5: lines.a.stations[0]";
  expect_diagnostics({
      {with_station("{ model: simple2-r3 }"), at + ": 'name' is missing; expected it here"},
      {with_station("{ name: x }"), at + ": 'model' is missing; expected it here"},
      {with_station("[ x ]"), at + ": expected a map, as in `key: value`"},
      {with_station("{ name: x, model: simple2-r4 }"),
       at + ".model: 'simple2-r4' is not a model; the nearest is 'simple2-r3'"},
      {with_station("{ name: x, model: [ a ] }"), at + ".model: expected a word or a number"},
      {with_station("{ name: 'x y', model: simple2-r3 }"),
       at + ".name: 'x y' is not a name; expected letters, digits, _ and -"},
      {with_station("{ name: '', model: simple2-r3 }"),
       at + ".name: '' is not a name; expected letters, digits, _ and -"},
      {with("firmware: 1.5"),
       at + ".firmware: '1.5' is unknown for simple2-r3; expected one of 1.39, 1.40, 1.41, 1.42, 1.50, 1.51, "
            "1.52"},
      {with("firmware: 1.43"), at +
                                   ".firmware: '1.43' is unknown for simple2-r3; expected one of 1.39, 1.40, "
                                   "1.41, 1.42, 1.50, 1.51, 1.52"},
      {with("address: 16"), at + ".address: '16' is not valid; expected a whole number from 0 to 15"},
      {with("address: -1"), at + ".address: '-1' is not valid; expected a whole number from 0 to 15"},
      {with("address: 1.0"), at + ".address: '1.0' is not valid; expected a whole number from 0 to 15"},
      {and_then("      - { name: y, model: simple2-r3 }\n"),
       "6: lines.a.stations[1]: address 1 is taken on this line; expected another address"},
      {and_then("      - { name: x, model: simple2-r3, address: 2 }\n"),
       "6: lines.a.stations[1].name: two devices are called 'x'; expected a different name"},
  });
}

TEST(BenchErrors, AStationThatIsJustAWord) {
  EXPECT_EQ(diagnostic(with_station("feeder")),
            "bench.yaml:5: lines.a.stations[0]: expected a map, as in `key: value`");
}

TEST(BenchErrors, Devices) {
  const std::string mill = "devices:\n  mill: { model: simple2-r3 }\n";
  expect_diagnostics({
      {with_station("{ device: x }"),
       "5: lines.a.stations[0].device: no device is called 'x'; there is none"},
      {with_station("{ device: mil }") + mill,
       "5: lines.a.stations[0].device: no device is called 'mil'; the nearest is 'mill'"},
      {and_then(mill), "7: devices.mill: the device is not on a line; expected a station that names it"},
      {with_station("{ device: mill }\n      - { device: mill, address: 2 }") + mill,
       "6: lines.a.stations[1]: the device is already on a line; expected it on only one line"},
      {and_then("devices: [ mill ]\n"), "6: devices: expected a map, as in `key: value`"},
      {and_then("devices:\n  x: { model: simple2-r3 }\n"),
       "5: lines.a.stations[0].name: two devices are called 'x'; expected a different name"},
  });
}

TEST(BenchErrors, ValuesAndChoices) {
  const std::string at = "5: lines.a.stations[0]";
  const std::string max = "expected a whole number from -2147483648 to 4294967295";
  expect_diagnostics({
      {with("set: { Aaxis_AccTime: 3001 }"),
       at + ".set.Aaxis_AccTime: 3001 is out of range; expected 0 to 3000"},
      {with("set: { Aaxis_AccTim: 3 }"),
       at + ".set.Aaxis_AccTim: no register is called 'Aaxis_AccTim'; the nearest is 'Aaxis_AccTime'"},
      {with("set: { HW_Code: 3 }"), at + ".set.HW_Code: cannot be written; it is read-only"},
      {with("set: { Aaxis_Pulse: 1e3 }"), at + ".set.Aaxis_Pulse: '1e3' is not valid; " + max},
      {with("set: { Aaxis_Pulse: 4294967296 }"), at + ".set.Aaxis_Pulse: '4294967296' is not valid; " + max},
      {with("set: { Aaxis_Pulse: --1 }"), at + ".set.Aaxis_Pulse: '--1' is not valid; " + max},
      {with("set: { Aaxis_Pulse: 0x }"), at + ".set.Aaxis_Pulse: '0x' is not valid; " + max},
      {with("set: { Aaxis_Pulse: 0x-1 }"), at + ".set.Aaxis_Pulse: '0x-1' is not valid; " + max},
      {with("set: [ 1 ]"), at + ".set: expected a map, as in `key: value`"},
      {with("choices: { stopp: x }"),
       at + ".choices.stopp: no choice is called 'stopp'; the nearest is 'stop'"},
      {with("choices: { servo_at_power_up: maybe }"),
       at + ".choices.servo_at_power_up: choice 'servo_at_power_up' has no option 'maybe'; expected one of "
            "off|on"},
      {with("choices: [ stop ]"), at + ".choices: expected a map, as in `key: value`"},
  });
}

TEST(BenchErrors, Machines) {
  const auto plant = [](const std::string& text) { return and_then("plant:\n  " + text + "\n"); };
  const std::string far = "expected a whole number from -1000000000000 to 1000000000000";
  expect_diagnostics({
      {plant("y.A: {}"), "7: plant.y.A: no device is called 'y'; expected 'x'"},
      {plant("x.C: {}"), "7: plant.x.C: 'C' is not an axis of simple2-r3; expected one of A, B"},
      {plant("x: {}"), "7: plant.x: 'x' does not name a device; expected a name like feeder.A"},
      {plant("x.A: [ 1 ]"), "7: plant.x.A: expected a map, as in `key: value`"},
      {plant("x.A: { travel: [ 5, -5 ] }"),
       "7: plant.x.A.travel: ends before it begins; expected the lower position first"},
      {plant("x.A: { travel: [ 5 ] }"),
       "7: plant.x.A.travel: expected two positions, as in `[ -20000, 20000 ]`"},
      {plant("x.A: { travel: [ 5, 9 ] }"),
       "7: plant.x.A.travel: does not include position 0, where the machine starts; expected a range with "
       "this position"},
      {plant("x.A: { travel: [ -9e99, 9 ] }"), "7: plant.x.A.travel[0]: '-9e99' is not valid; " + far},
      {plant("x.A: { travel: [ -9, 9223372036854775808 ] }"),
       "7: plant.x.A.travel[1]: '9223372036854775808' is not valid; " + far},
      {plant("x.A: { home: { at: 0 } }"), "7: plant.x.A.home: 'width' is missing; expected it here"},
      {plant("x.A: { home: { at: 0, width: 0 } }"),
       "7: plant.x.A.home.width: '0' is not valid; expected a whole number from 1 to 1000000000000"},
      {plant("x.A: { limits: { lower: 5, upper: 5 } }"),
       "7: plant.x.A.limits: the lower limit is not below the upper one; expected `lower` below `upper`"},
      {plant("x.A: { encoder: { per_revolution: 0 } }"),
       "7: plant.x.A.encoder.per_revolution: '0' is not valid; expected a whole number from 1 to "
       "10000000"},
  });
}

TEST(BenchErrors, Wires) {
  const auto wires = [](const std::string& text) { return and_then("wires: " + text + "\n"); };
  expect_diagnostics({
      {wires("[ x.DOUT_4 ]"),
       "6: wires[0]: expected `DEVICE.OUTPUT -> DEVICE.INPUT`, or `DEVICE.AXIS.SWITCH -> DEVICE.INPUT`, or "
       "`DEVICE.OUTPUT -> DEVICE.AXIS.alarm_clear`"},
      {wires("[ y.DOUT_4 -> x.DIN_1 ]"), "6: wires[0]: no device is called 'y'; expected 'x'"},
      {wires("[ x.DIN_4 -> x.DIN_1 ]"),
       "6: wires[0]: 'DIN_4' is not an output of simple2-r3; expected one of DOUT_0, DOUT_1, DOUT_2, DOUT_3, "
       "DOUT_4, DOUT_5, DOUT_6"},
      {wires("[ x.DOUT_4 -> x.DOUT_1 ]"),
       "6: wires[0]: 'DOUT_1' is not an input of simple2-r3; expected one such as 'DIN_0'"},
      {wires("[ x.DOUT_4 -> x.DIN_1, x.DOUT_4 -> x ]"),
       "6: wires[1]: 'x' does not name a device; expected a name like turner.DIN_10"},
      {wires("[ -> ]"),
       "6: wires[0]: '' does not name a device; expected a name like feeder.DOUT_4\n"
       "bench.yaml:6: wires[0]: '' does not name a device; expected a name like turner.DIN_10"},
      {wires("x.DOUT_4 -> x.DIN_1"), "6: wires: expected a list, as in `[ a, b ]`"},
      {wires("[ { a: b } ]"), "6: wires[0]: expected a word or a number"},
  });
}

TEST(BenchErrors, AreOneLineWhateverIsQuotedInThem) {
  for (const std::string& text :
       {with_station("{ name: x, model: \"a\\nb\" }"), with_station("{ name: \"a\\nb\", model: simple2-r3 }"),
        with("set: { \"a\\nb\": 1 }"), with("firmware: \"1\\n2\""), with("address: \"1\\n2\""),
        "understudy: 1\n\"li\\nnes\": 1\n" + kLines, and_then("wires: [ \"x.DOUT\\n -> x.DIN_1\" ]\n"),
        and_then("plant:\n  \"x.\\nA\": {}\n"), with("choices: { stop: \"a\\nb\" }")}) {
    const std::string got = diagnostic(text);
    EXPECT_NE(got, "");
    EXPECT_EQ(got.find('\n'), std::string::npos) << got;
  }
}

}  // namespace bench_errors_test
}  // namespace understudy::emulator::world
