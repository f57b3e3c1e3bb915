// All errors of a file are reported at once, in the file's order, and each only once.
#include <gtest/gtest.h>

#include "emulator/world/bench_file/diagnostics.h"
#include "tests/emulator/play/performing/scenario_folder.h"
#include "tests/emulator/world/bench_file/bench_texts.h"

namespace understudy::emulator::world {
namespace all_diagnostics_test {

FileError error_at(int line, int column, const std::string& text) {
  return {FilePlace{"a.yaml", line, column}, text};
}

TEST(Diagnostics, AreReportedInTheFilesOrderAndOnce) {
  Diagnostics all;
  EXPECT_FALSE(all.attempt([] { throw error_at(7, 1, "late"); }));
  EXPECT_FALSE(all.attempt([] { throw error_at(2, 9, "right"); }));
  EXPECT_FALSE(all.attempt([] { throw error_at(2, 3, "left"); }));
  EXPECT_FALSE(all.attempt([] { throw error_at(7, 1, "late"); }));
  EXPECT_FALSE(all.attempt([] { throw AlreadyReported(); }));
  EXPECT_TRUE(all.attempt([] {}));
  try {
    all.throw_if_any();
    FAIL();
  } catch (const FileError& error) {
    EXPECT_STREQ(error.what(), "a.yaml:2:3: left\na.yaml:2:9: right\na.yaml:7:1: late");
  }
}

TEST(Diagnostics, AreTwentyAtMost) {
  Diagnostics all;
  for (int line = 1; line <= 25; ++line) all.add(error_at(line, 1, "wrong"));
  try {
    all.throw_if_any();
    FAIL();
  } catch (const FileError& error) {
    ASSERT_EQ(error.diagnostics().size(), 21U);
    EXPECT_EQ(error.diagnostics()[19].text, "a.yaml:20:1: wrong");
    EXPECT_EQ(error.diagnostics()[20].text, "and 5 more; the first 20 are shown");
  }
}

TEST(Diagnostics, CountThoseThatAPartHasLeftUntold) {
  Diagnostics part;
  for (int line = 1; line <= 25; ++line) part.add(error_at(line, 1, "wrong"));
  Diagnostics all;
  all.add(error_at(30, 1, "wrong too"));
  all.attempt([&] { part.throw_if_any(); });
  try {
    all.throw_if_any();
    FAIL();
  } catch (const FileError& error) {
    ASSERT_EQ(error.diagnostics().size(), 21U);
    EXPECT_EQ(error.diagnostics()[20].text, "and 6 more; the first 20 are shown");
  }
}

TEST(Diagnostics, EndTheReadingWhereTheyAreTooMany) {
  Diagnostics all;
  int tried = 0;
  EXPECT_THROW(all.require([&] {
    for (; tried < 100'000; ++tried) all.attempt([&] { throw error_at(tried + 1, 1, "wrong"); });
  }),
               FileError);
  EXPECT_LE(tried, 1000);
}

TEST(AllDiagnostics, OfABench) {
  EXPECT_EQ(diagnostic(R"(understudy: 2
lines:
  a:
    bud: 9600
    baud: fast
    link: tcp://:1502
    stations:
      - { name: x, model: simple2-r3, adress: 1, firmware: new, set: { Aaxis_Speed: fast, Aaxis_Pulse: 1 } }
      - { name: y, model: simple2-r4, address: 2 }
      - { name: z, model: simple2-r3, address: 1 }
plant:
  x.A: { travel: [ 5, 10 ], home: { at: 0 }, limit: { lower: 1 } }
  x.Q: {}
  y.A: { nonsense: 1 }
wires: [ x.DOUT_1 -> z.DIN_1, x.DOUT_1 -> y.DIN_99, x.DOUT_99 -> x.DIN_1 ]
seed: -1
)"),
            R"(bench.yaml:1: understudy: '2' is not valid; expected 1
bench.yaml:4: lines.a.bud: is not a key here; expected one of link, listen, pty, baud, baud_tolerance, byte_timeout, timing, echo, stations (the nearest is 'baud')
bench.yaml:5: lines.a.baud: 'fast' is not valid; expected a whole number from 1 to 4000000
bench.yaml:6: lines.a.link: 'tcp://:1502' is a network address; expected a path for a pseudo-terminal (`listen` has addresses)
bench.yaml:8: lines.a.stations[0].adress: is not a key here; expected one of name, model, address, port, firmware, modules, set, choices, dip, program, nv (the nearest is 'address')
bench.yaml:8: lines.a.stations[0].firmware: 'new' is unknown for simple2-r3; expected one of 1.39, 1.40, 1.41, 1.42, 1.50, 1.51, 1.52
bench.yaml:8: lines.a.stations[0].set.Aaxis_Speed: 'fast' is not valid; expected a whole number from -2147483648 to 4294967295
bench.yaml:9: lines.a.stations[1].model: 'simple2-r4' is not a model; the nearest is 'simple2-r3'
bench.yaml:10: lines.a.stations[2]: address 1 is taken on this line; expected another address
bench.yaml:12: plant.x.A.travel: does not include position 0, where the machine starts; expected a range with this position
bench.yaml:12: plant.x.A.home: 'width' is missing; expected it here
bench.yaml:12: plant.x.A.limit: is not a key here; expected one of position, travel, home, near_home, mark, limits, encoder, drive (the nearest is 'limits')
bench.yaml:13: plant.x.Q: 'Q' is not an axis of simple2-r3; expected one of A, B
bench.yaml:14: plant.y.A.nonsense: is not a key here; expected one of position, travel, home, near_home, mark, limits, encoder, drive
bench.yaml:15: wires[2]: 'DOUT_99' is not an output of simple2-r3; the nearest is 'DOUT_0'
bench.yaml:16: seed: '-1' is not valid; expected a whole number from 0 to 9223372036854775807)");
}

/// With columns.
std::string all_of(const std::string& text) {
  try {
    parse(text);
  } catch (const BenchError& error) {
    return error.what();
  }
  return "";
}

TEST(AllDiagnostics, OfWhatOneDeviceIsGiven) {
  EXPECT_EQ(
      all_of(R"(understudy: 1
lines:
  a:
    stations:
      - name: x
        model: simple2-r3
        firmware: "1.43"
        modules: 3
        set:
          Aaxis_AccTime: 3001
          Aaxis_DecTime: 5
          HW_Code: 1
          Aaxis_Sped: 2
        choices: { stopp: x, servo_at_power_up: maybe }
        dip: { DIP9: on, DIP1: perhaps, DIP8: off }
        program: "END\nNONSENSE\n"
)"),
      R"(bench.yaml:7:19: lines.a.stations[0].firmware: '1.43' is unknown for simple2-r3; expected one of 1.39, 1.40, 1.41, 1.42, 1.50, 1.51, 1.52
bench.yaml:8:18: lines.a.stations[0].modules: '3' is not valid; expected none, because simple2-r3 has no modules
bench.yaml:10:26: lines.a.stations[0].set.Aaxis_AccTime: 3001 is out of range; expected 0 to 3000
bench.yaml:12:20: lines.a.stations[0].set.HW_Code: cannot be written; it is read-only
bench.yaml:13:23: lines.a.stations[0].set.Aaxis_Sped: no register is called 'Aaxis_Sped'; the nearest is 'Aaxis_Speed'
bench.yaml:14:27: lines.a.stations[0].choices.stopp: no choice is called 'stopp'; the nearest is 'stop'
bench.yaml:14:49: lines.a.stations[0].choices.servo_at_power_up: choice 'servo_at_power_up' has no option 'maybe'; expected one of off|on
bench.yaml:15:22: lines.a.stations[0].dip.DIP9: 'DIP9' is not a switch of simple2-r3; the nearest is 'DIP1'
bench.yaml:15:32: lines.a.stations[0].dip.DIP1: 'perhaps' is neither on nor off; expected on or off
bench.yaml:15:47: lines.a.stations[0].dip.DIP8: 'DIP8' is not a switch of simple2-r3; the nearest is 'DIP1'
bench.yaml:16:18: lines.a.stations[0].program: line 2, column 1: mnemonic: no instruction is called 'NONSENSE'; expected an instruction, such as Delay_mSec)");
}

TEST(AllDiagnostics, OfAChainWhateverItsLengthIs) {
  const std::string bench =
      "understudy: 1\nlines: { a: { stations: [ { device: r } ] } }\ndevices:\n"
      "  r: { model: slim, modules: ";
  const std::string more = ", set: { T7VM: 100, NOTHING: 1 } }\n";
  const std::string nothing =
      ".set.NOTHING: is not a parameter or variable; expected one such as 'PR3', 'T1VM' or 'N0'";
  EXPECT_EQ(diagnostic(bench + "8" + more), "bench.yaml:4: devices.r" + nothing);
  EXPECT_EQ(diagnostic(bench + "9" + more),
            "bench.yaml:4: devices.r.modules: '9' is not valid; expected 1 to 8\n"
            "bench.yaml:4: devices.r" +
                nothing);
  EXPECT_EQ(diagnostic(bench + "many" + more),
            "bench.yaml:4: devices.r.modules: 'many' is not valid; expected a whole number from 1 to 255\n"
            "bench.yaml:4: devices.r" +
                nothing);
}

TEST(AllDiagnostics, OfADeviceWhoseModelIsWrong) {
  EXPECT_EQ(diagnostic(R"(understudy: 1
lines:
  a:
    stations:
      - { name: x, model: simple2-r3, address: 2 }
      - { name: y, model: simple2-r4, address: 2, firmware: new, modules: many, nv: "",
          set: { P: fast }, dip: { D: perhaps }, choices: { c: [ 1 ] }, program: /nowhere/x.lst }
      - { name: z, address: far }
plant: { y.A: { travel: x }, x.A: { travel: [ x, y ] } }
inputs: { y.DIN_1: maybe, x.DIN_1: maybe }
faults:
  - { stall: y.A, when: "y.A.pulses ==" }
  - { stall: x.B, when: "x.B.pulses ==" }
)"),
            R"(bench.yaml:6: lines.a.stations[1]: address 2 is taken on this line; expected another address
bench.yaml:6: lines.a.stations[1].model: 'simple2-r4' is not a model; the nearest is 'simple2-r3'
bench.yaml:6: lines.a.stations[1].firmware: 'new' is not a version; expected one with two decimals, like "1.52"
bench.yaml:6: lines.a.stations[1].modules: 'many' is not valid; expected a whole number from 1 to 255
bench.yaml:6: lines.a.stations[1].nv: is empty; expected a path
bench.yaml:7: lines.a.stations[1].set.P: 'fast' is not a number; expected one
bench.yaml:7: lines.a.stations[1].dip.D: 'perhaps' is neither on nor off; expected on or off
bench.yaml:7: lines.a.stations[1].choices.c: expected a word or a number
bench.yaml:7: lines.a.stations[1].program: /nowhere/x.lst cannot be read (No such file or directory); expected a listing
bench.yaml:8: lines.a.stations[2]: 'model' is missing; expected it here
bench.yaml:8: lines.a.stations[2].address: 'far' is not valid; expected a whole number from 0 to 255
bench.yaml:9: plant.y.A.travel: expected a list, as in `[ a, b ]`
bench.yaml:9: plant.x.A.travel[0]: 'x' is not valid; expected a whole number from -1000000000000 to 1000000000000
bench.yaml:9: plant.x.A.travel[1]: 'y' is not valid; expected a whole number from -1000000000000 to 1000000000000
bench.yaml:10: inputs.x.DIN_1: 'maybe' is not a level; expected on or off
bench.yaml:13: faults[1].when: column 14 of 'x.B.pulses ==': unexpected end; expected a name, a number or '(')");
}

TEST(AllDiagnostics, OfAMachine) {
  EXPECT_EQ(
      diagnostic(R"(understudy: 1
lines: { a: { stations: [ { name: x, model: simple2-r3 }, { name: y, model: simple2-r3, address: 2 } ] } }
plant:
  x.A:
    position: here
    travel: [ 5, 9 ]
    home: { at: x, width: -2, hysteresis: -1, contact: maybe, input: DIN_99, with: 1 }
    limits: { lower: x, upper: y, upper_input: DIN_99, lower_input: DIN_99 }
    encoder: { per_revolution: 0, on: moon, reversed: maybe }
    drive: { ready_after: soon, enabled_by: maybe, alarm_contact: maybe }
wires: [ x.A.home -> y.DIN_1 ]
faults:
  - { lost_steps: x.B, one_in: none, nth: some, when: "x.A.home ==" }
  - { lost_steps: y.B, one_in: none, nth: some, when: "y.A.homes" }
)"),
      R"(bench.yaml:5: plant.x.A.position: 'here' is not valid; expected a whole number from -1000000000000 to 1000000000000
bench.yaml:7: plant.x.A.home.at: 'x' is not valid; expected a whole number from -1000000000000 to 1000000000000
bench.yaml:7: plant.x.A.home.width: '-2' is not valid; expected a whole number from 1 to 1000000000000
bench.yaml:7: plant.x.A.home.hysteresis: '-1' is not valid; expected a whole number from 0 to 1000000000000
bench.yaml:7: plant.x.A.home.contact: 'maybe' is unknown; expected opens or closes
bench.yaml:7: plant.x.A.home.input: 'DIN_99' is not an input of simple2-r3; the nearest is 'DIN_9'
bench.yaml:7: plant.x.A.home.with: is not a key here; expected one of at, width, hysteresis, contact, input (the nearest is 'width')
bench.yaml:8: plant.x.A.limits.lower: 'x' is not valid; expected a whole number from -1000000000000 to 1000000000000
bench.yaml:8: plant.x.A.limits.upper: 'y' is not valid; expected a whole number from -1000000000000 to 1000000000000
bench.yaml:8: plant.x.A.limits.upper_input: 'DIN_99' is not an input of simple2-r3; the nearest is 'DIN_9'
bench.yaml:8: plant.x.A.limits.lower_input: 'DIN_99' is not an input of simple2-r3; the nearest is 'DIN_9'
bench.yaml:9: plant.x.A.encoder.per_revolution: '0' is not valid; expected a whole number from 1 to 10000000
bench.yaml:9: plant.x.A.encoder.on: 'moon' is unknown; expected wheel or machine
bench.yaml:9: plant.x.A.encoder.reversed: 'maybe' is unknown; expected true or false
bench.yaml:10: plant.x.A.drive.ready_after: 'soon' is not a duration of whole milliseconds; expected one such as 120ms
bench.yaml:10: plant.x.A.drive.enabled_by: 'maybe' is unknown; expected on or off
bench.yaml:10: plant.x.A.drive.alarm_contact: 'maybe' is unknown; expected opens or closes
bench.yaml:14: faults[1].one_in: 'none' is not valid; expected a whole number
bench.yaml:14: faults[1].nth: 'some' is not valid; expected a whole number, or a range such as 3..7
bench.yaml:14: faults[1].when: column 1 of 'y.A.homes': axis A has no 'homes'; the nearest is 'home')");
}

TEST(AllDiagnostics, OfTheKeysOfALine) {
  EXPECT_EQ(
      diagnostic(R"(understudy: 1
lines:
  a:
    speed: 3
    baud: 0
    pty: maybe
    echo: perhaps
    byte_timeout: soon
    baud_tolerance: lots
    timing: never
    link: ""
    listen: [ "modbus-tcp://:99999", "foo://x", rtu://:7, rtu://:7 ]
    stations: []
  b: { pty: off, stations: [] }
)"),
      R"(bench.yaml:4: lines.a.speed: is not a key here; expected one of link, listen, pty, baud, baud_tolerance, byte_timeout, timing, echo, stations
bench.yaml:5: lines.a.baud: '0' is not valid; expected a whole number from 1 to 4000000
bench.yaml:6: lines.a.pty: 'maybe' is neither on nor off; expected on or off
bench.yaml:7: lines.a.echo: 'perhaps' is not valid; expected on or off
bench.yaml:8: lines.a.byte_timeout: 'soon' is not valid; expected 10ms to 60s, as in 200ms
bench.yaml:9: lines.a.baud_tolerance: 'lots' is not valid; expected 0% to 10%, as in 2%
bench.yaml:10: lines.a.timing: 'never' is not a timing; expected wire or instant
bench.yaml:11: lines.a.link: is empty; expected a path
bench.yaml:12: lines.a.listen[0]: 'modbus-tcp://:99999' has port 99999; expected 0 to 65535
bench.yaml:12: lines.a.listen[1]: 'foo://x' is not an address; expected rtu://HOST:PORT, rfc2217://HOST:PORT or modbus-tcp://HOST:PORT, such as rtu://127.0.0.1:5020
bench.yaml:12: lines.a.listen[3]: appears twice; expected it only once
bench.yaml:13: lines.a.stations: is empty; expected at least one station
bench.yaml:14: lines.b.pty: leaves the line without a port; expected `listen`
bench.yaml:14: lines.b.stations: is empty; expected at least one station)");
}

TEST(AllDiagnostics, OfStationsAndOfWhatHasAWrongName) {
  EXPECT_EQ(diagnostic(R"(understudy: 1
lines:
  a:
    stations:
      - { name: "x y", model: simple2-r3, address: 900, port: RS999, set: { Aaxis_Sped: 1 } }
      - { model: simple2-r3, address: q, port: B, modules: 2 }
      - { device: nosuch, address: q, prt: 1 }
      - { name: u, model: simple2-r3, address: 3 }
devices:
  "p q": { model: simple2-r3, set: { a: b } }
)"),
            R"(bench.yaml:5: lines.a.stations[0].name: 'x y' is not a name; expected letters, digits, _ and -
bench.yaml:5: lines.a.stations[0].address: '900' is not valid; expected a whole number from 0 to 15
bench.yaml:5: lines.a.stations[0].port: 'RS999' is not a port of simple2-r3; expected 'RS485'
bench.yaml:5: lines.a.stations[0].set.Aaxis_Sped: no register is called 'Aaxis_Sped'; the nearest is 'Aaxis_Speed'
bench.yaml:6: lines.a.stations[1]: 'name' is missing; expected it here
bench.yaml:6: lines.a.stations[1].address: 'q' is not valid; expected a whole number from 0 to 15
bench.yaml:6: lines.a.stations[1].port: 'B' is not a port of simple2-r3; expected 'RS485'
bench.yaml:6: lines.a.stations[1].modules: '2' is not valid; expected none, because simple2-r3 has no modules
bench.yaml:7: lines.a.stations[2].device: no device is called 'nosuch'; expected one of p q, x y
bench.yaml:7: lines.a.stations[2].address: 'q' is not valid; expected a whole number from 0 to 255
bench.yaml:7: lines.a.stations[2].prt: is not a key here; expected one of device, address, port (the nearest is 'port')
bench.yaml:10: devices.p q: 'p q' is not a name; expected letters, digits, _ and -
bench.yaml:10: devices.p q.set.a: 'b' is not valid; expected a whole number from -2147483648 to 4294967295)");
}

TEST(AllDiagnostics, OfWhatStandsAtAWrongPlace) {
  EXPECT_EQ(diagnostic(R"(understudy: 1
lines: { a: { stations: [ { name: u, model: simple2-r3 } ] } }
plant:
  u.Q: { home: { at: x, width: 1 } }
  nosuch.A: { home: { at: y, width: 1, input: DIN_99 } }
wires: [ u.DOUT_99 -> u.DIN_99 ]
faults:
  - { lost_steps: u.C, one_in: none, nth: 1, nth: 2 }
  - { slip: u.A, pulses: [ 1 ], at: x }
)"),
            R"(bench.yaml:4: plant.u.Q: 'Q' is not an axis of simple2-r3; expected one of A, B
bench.yaml:4: plant.u.Q.home.at: 'x' is not valid; expected a whole number from -1000000000000 to 1000000000000
bench.yaml:5: plant.nosuch.A: no device is called 'nosuch'; expected 'u'
bench.yaml:5: plant.nosuch.A.home.at: 'y' is not valid; expected a whole number from -1000000000000 to 1000000000000
bench.yaml:6: wires[0]: 'DOUT_99' is not an output of simple2-r3; the nearest is 'DOUT_0'
bench.yaml:6: wires[0]: 'DIN_99' is not an input of simple2-r3; the nearest is 'DIN_9'
bench.yaml:8: faults[0]: no axis of u is called 'C'; expected one of A, B
bench.yaml:8: faults[0].one_in: 'none' is not valid; expected a whole number
bench.yaml:8: faults[0].nth: is given twice; expected it only once
bench.yaml:9: faults[1].pulses: expected a word or a number
bench.yaml:9: faults[1].at: 'x' is not valid; expected a duration such as 250ms)");
}

TEST(AllDiagnostics, OfAProgramInsideAreAtItsLines) {
  EXPECT_EQ(
      all_of(R"(understudy: 1
# A remark is a line too.
lines:
  a:
    stations:
      - name: x
        model: simple2-r3
        program: |
          END

          NONSENSE
          Delay_mSec x
)"),
      R"(bench.yaml:11:11: lines.a.stations[0].program: mnemonic: no instruction is called 'NONSENSE'; expected an instruction, such as Delay_mSec
bench.yaml:12:22: lines.a.stations[0].program: operand 1: 'x' is not a number; expected 0 to 65535)");
}

/// Of the steps on the two stations.
std::string diagnostics_of(const std::string& steps) {
  return play::ScenarioFolder().diagnostic("understudy: 1\nbench: feeder.yaml\nsteps:\n" + steps);
}

TEST(AllDiagnostics, OfStepsOnALine) {
  EXPECT_EQ(
      diagnostics_of(R"(  - write: { feeder.Nosuch: 1, turner.HW_Code: 1 }
    exception: many
    within: soon
    via: c
    at: 3
  - expect: { feeder.Nosuch: 1, turner.Aaxis_Speed: z }
    reply: word
    via: b
  - send: { line: c, bytes: zz, reply: yy, within: 0s, with: 1 }
  - hear: { line: q, within: x }
)"),
      R"(scenario.yaml:4: steps[0].write.feeder.Nosuch: feeder: no register is called 'Nosuch'; expected one such as 'STATUS'
scenario.yaml:4: steps[0].write.turner.HW_Code: turner.HW_Code cannot be written; it is read-only (use `exception:` if the step tests that)
scenario.yaml:5: steps[0].exception: 'many' is not valid; expected a whole number from 1 to 255
scenario.yaml:6: steps[0].within: has no effect without `reply: nothing`; expected both
scenario.yaml:7: steps[0].via: no line is called 'c'; expected 'rs485'
scenario.yaml:8: steps[0].at: is not a key here; expected one of write, exception, reply, within, via
scenario.yaml:9: steps[1].expect.feeder.Nosuch: feeder: no register is called 'Nosuch'; expected one such as 'STATUS'
scenario.yaml:9: steps[1].expect.turner.Aaxis_Speed: column 1 of 'z': a name, 'z', where a value, a tolerance or a range is expected
scenario.yaml:10: steps[1].reply: 'word' is unknown; expected nothing (values that are read are compared without `reply`)
scenario.yaml:11: steps[1].via: no line is called 'b'; expected 'rs485'
scenario.yaml:12: steps[2].send.line: no line is called 'c'; expected 'rs485'
scenario.yaml:12: steps[2].send.bytes: 'zz' is not a byte; expected bytes such as 01 03 00 01, with +crc at the end for the checksum
scenario.yaml:12: steps[2].send.reply: 'yy' is not a byte; expected bytes such as 01 03 00 01, with +crc at the end for the checksum
scenario.yaml:12: steps[2].send.within: takes no time; expected a duration above 0
scenario.yaml:12: steps[2].send.with: is not a key here; expected one of line, bytes, reply, within (the nearest is 'within')
scenario.yaml:13: steps[3].hear: 'text' is missing; expected it here
scenario.yaml:13: steps[3].hear.line: no line is called 'q'; expected 'rs485'
scenario.yaml:13: steps[3].hear.within: 'x' is not a duration; expected one such as 250ms)");
}

TEST(AllDiagnostics, OfStepsThatCheckAndContinue) {
  EXPECT_EQ(
      diagnostics_of(R"(  - wait: { until: feeder.Q, within: soon, poll: 1us, for: 3 }
  - assert: [ feeder.Q, turner.Q == 1 ]
  - always: { what: feeder.Q, of: 3 }
  - repeat: { times: many, steps: [ advance: 1 ], with: 1 }
  - for: { each: [ 1 ], as: n, steps: [ advance: "${n}" ], with: 1 }
)"),
      R"(scenario.yaml:4: steps[0].wait.until: column 1 of 'feeder.Q': feeder: no register is called 'Q'; expected one such as 'STATUS'
scenario.yaml:4: steps[0].wait.within: 'soon' is not a duration; expected one such as 250ms
scenario.yaml:4: steps[0].wait.poll: 1us is shorter than any request; expected 1ms or more
scenario.yaml:4: steps[0].wait.for: is not a key here; expected one of until, within, takes, poll, via
scenario.yaml:5: steps[1].assert[0]: column 1 of 'feeder.Q': feeder: no register is called 'Q'; expected one such as 'STATUS'
scenario.yaml:5: steps[1].assert[1]: column 1 of 'turner.Q == 1': turner: no register is called 'Q'; expected one such as 'STATUS'
scenario.yaml:6: steps[2].always.what: column 1 of 'feeder.Q': feeder: no register is called 'Q'; expected one such as 'STATUS'
scenario.yaml:6: steps[2].always.of: is not a key here; expected one of what, name
scenario.yaml:7: steps[3].repeat.times: 'many' is not valid; expected a whole number from 1 to 100000
scenario.yaml:7: steps[3].repeat.steps[0].advance: '1' is not a duration; expected one such as 250ms
scenario.yaml:7: steps[3].repeat.with: is not a key here; expected one of times, as, steps
scenario.yaml:8: steps[4].for.steps[0].advance: '1' is not a duration; expected one such as 250ms
scenario.yaml:8: steps[4].for.with: is not a key here; expected one of each, as, steps)");
}

TEST(AllDiagnostics, OfStepsThatActFromOutside) {
  EXPECT_EQ(
      diagnostics_of(R"(  - input: { feeder.DIN_99: on, turner.DIN_1: maybe }
  - turn: { feeder.A: 3, turner.MPG: 3 }
  - inject: { lost_steps: q.A, one_in: none, name: all }
  - power: { feeder: maybe, q: on }
    advance: soon
  - save: { feeder: nosuch/x.json, q: q.json }
  - program: { feeder: nosuch.lst, q: nosuch.lst }
    refused: false
  - program:
      feeder: |
        END
        NONSENSE
        Delay_mSec x
  - command: { feeder: MOVE, q: MOVE }
    via: c
)"),
      R"(scenario.yaml:4: steps[0].input.feeder.DIN_99: no input of feeder is called 'DIN_99'; the nearest is 'DIN_9'
scenario.yaml:4: steps[0].input.turner.DIN_1: 'maybe' is not a level; expected on or off
scenario.yaml:5: steps[1].turn.feeder.A: feeder.A has no hand wheel; expected `encoder: { on: wheel }` in `plant`
scenario.yaml:5: steps[1].turn.turner.MPG: no axis of turner is called 'MPG'; expected one of A, B
scenario.yaml:6: steps[2].inject: no device is called 'q'; expected one of feeder, turner
scenario.yaml:6: steps[2].inject.one_in: 'none' is not valid; expected a whole number
scenario.yaml:6: steps[2].inject.name: 'all' cannot be the name of a fault; expected another name
scenario.yaml:7: steps[3].power.feeder: 'maybe' is unknown; expected on, off or cycle
scenario.yaml:7: steps[3].power.q: no device is called 'q'; expected one of feeder, turner
scenario.yaml:8: steps[3].advance: is a second step in one entry; expected `- ` before it
scenario.yaml:9: steps[4].save.feeder: nosuch is not a folder; expected a folder for the file
scenario.yaml:9: steps[4].save.q: no device is called 'q'; expected one of feeder, turner
scenario.yaml:10: steps[5].program.feeder: nosuch.lst cannot be read (No such file or directory); expected a listing
scenario.yaml:10: steps[5].program.q: no device is called 'q'; expected one of feeder, turner
scenario.yaml:11: steps[5].refused: expected true, or part of the message about the first mistake
scenario.yaml:15: steps[6].program.feeder: mnemonic: no instruction is called 'NONSENSE'; expected an instruction, such as Delay_mSec
scenario.yaml:16: steps[6].program.feeder: operand 1: 'x' is not a number; expected 0 to 65535
scenario.yaml:17: steps[7].command.feeder: simple2-r3 has no named commands; expected registers to write
scenario.yaml:17: steps[7].command.q: no device is called 'q'; expected one of feeder, turner
scenario.yaml:18: steps[7].via: no line is called 'c'; expected 'rs485')");
}

TEST(AllDiagnostics, OfAScenario) {
  const play::ScenarioFolder folder;
  EXPECT_EQ(
      folder.diagnostic(R"(understudy: 1
bench: feeder.yaml
gap: soon
seeed: 1
steps:
  - write: { feeder.Aaxis_SVN: 1 }
  - inject: { stal: feeder.A, name: jam }
  - clear: jam
  - repeat: { times: 3, steps: [ advance: 1, fork: { a: [ wirte: 1 ], b: [ advance: 2 ] } ] }
  - advance: 1ms
  - expect: { feeder.Cord_A: x }
)"),
      R"(scenario.yaml:3: gap: 'soon' is not a duration; expected one such as 250ms
scenario.yaml:4: seeed: is not a key here; expected one of understudy, name, bench, nv, firmware, gap, seed, parameters, environment, cases, choice, vary, hunt, steps, plays (the nearest is 'seed')
scenario.yaml:6: steps[0].write.feeder.Aaxis_SVN: feeder: no register is called 'Aaxis_SVN'; the nearest is 'Aaxis_SVON'
scenario.yaml:7: steps[1].inject: )" +
          folder.diagnostic(play::ScenarioFolder::scenario_of("  - inject: { stal: feeder.A, name: jam }\n"))
              .substr(std::string("scenario.yaml:4: steps[0].inject: ").size()) +
          R"(
scenario.yaml:9: steps[3].repeat.steps[0].advance: '1' is not a duration; expected one such as 250ms
scenario.yaml:9: steps[3].repeat.steps[1].fork.a[0].wirte: is not a step; the nearest is 'write'
scenario.yaml:9: steps[3].repeat.steps[1].fork.b[0].advance: '2' is not a duration; expected one such as 250ms
scenario.yaml:11: steps[5].expect.feeder.Cord_A: )" +
          folder.diagnostic(play::ScenarioFolder::scenario_of("  - expect: { feeder.Cord_A: x }\n"))
              .substr(std::string("scenario.yaml:4: steps[0].expect.feeder.Cord_A: ").size()));
}

TEST(AllDiagnostics, OfAFaultInAScenario) {
  const play::ScenarioFolder folder;
  const std::string reported = folder.diagnostic(play::ScenarioFolder::scenario_of(
      "  - inject: { lost_steps: feeder.A, one_in: none, when: \"feeder.A.homes\" }\n"));
  EXPECT_EQ(reported,
            "scenario.yaml:4: steps[0].inject.one_in: 'none' is not valid; expected a whole number\n"
            "scenario.yaml:4: steps[0].inject.when: column 1 of 'feeder.A.homes': axis A has no 'homes'; the "
            "nearest is 'home'");
}

TEST(AllDiagnostics, OfCasesAreReportedForTheFirstOne) {
  const play::ScenarioFolder folder;
  EXPECT_EQ(
      folder.diagnostic("understudy: 1\nbench: feeder.yaml\ncases: [ { a: 1 }, { a: x }, { a: y } ]\nsteps:\n"
                        "  - advance: 1\n  - write: { feeder.Aaxis_Speed: \"${a}\" }\n"),
      "scenario.yaml:5: steps[0].advance: '1' is not a duration; expected one such as 250ms  (a=1)\n"
      "scenario.yaml:6: steps[1].write.feeder.Aaxis_Speed: column 1 of 'x': no device is called 'x'; "
      "expected one of feeder, turner  (a=x)\n"
      "scenario.yaml:6: steps[1].write.feeder.Aaxis_Speed: column 1 of 'y': no device is called 'y'; "
      "expected one of feeder, turner  (a=y)");
}

}  // namespace all_diagnostics_test
}  // namespace understudy::emulator::world
