// Wrong scenario files: each error is one line with its place, the error and what was expected.
#include <gtest/gtest.h>

#include "tests/emulator/play/performing/scenario_folder.h"

namespace understudy::emulator::play {
namespace scenario_errors_test {

struct Bad {
  std::string text;
  std::string diagnostic;
};

class ScenarioErrors : public testing::Test {
 protected:
  void expect_diagnostics(const std::vector<Bad>& files) const {
    for (const Bad& file : files) {
      EXPECT_EQ(folder_.diagnostic(file.text), "scenario.yaml:" + file.diagnostic) << file.text;
    }
  }
  /// Errors of single steps; the step is in line 4.
  void expect_step_diagnostics(const std::vector<Bad>& steps) const {
    for (const Bad& step : steps) {
      EXPECT_EQ(folder_.diagnostic(ScenarioFolder::scenario_of("  - " + step.text + "\n")),
                "scenario.yaml:4: steps[0]" + step.diagnostic)
          << step.text;
    }
  }
  static std::string with(const std::string& keys) {
    return "understudy: 1\nbench: feeder.yaml\n" + keys + "\nsteps: [ advance: 1ms ]\n";
  }

  ScenarioFolder folder_;
};

TEST_F(ScenarioErrors, TheFileAsAWhole) {
  expect_diagnostics({
      {"", "1: scenario: the file is not a map; expected `understudy: 1`, `bench:` and `steps:`"},
      {"- advance: 1ms\n",
       "1: scenario: the file is not a map; expected `understudy: 1`, `bench:` and `steps:`"},
      {"bench: feeder.yaml\nsteps: [ say: x ]\n", "1: scenario: 'understudy' is missing; expected it here"},
      {"understudy: 2\nbench: feeder.yaml\nsteps: [ say: x ]\n",
       "1: understudy: '2' is not valid; expected 1"},
      {"understudy: 1\nsteps: [ advance: 1ms ]\n", "1: scenario: 'bench' is missing; expected it here"},
      {"understudy: 1\nbench: feeder.yaml\n", "1: scenario: 'steps' is missing; expected it here"},
      {"understudy: 1\nbench: feeder.yaml\nsteps: []\n", "3: steps: is empty; expected at least one step"},
      {"understudy: 1\nbench: feeder.yaml\nsteps: {}\n", "3: steps: expected a list, as in `[ a, b ]`"},
      {with("stepps: 1"),
       "3: stepps: is not a key here; expected one of understudy, name, bench, nv, firmware, gap, seed, "
       "parameters, environment, "
       "cases, choice, vary, hunt, steps, plays (the nearest is 'steps')"},
      {with("seed: 1\nseed: 2"), "4: seed: is given twice; expected it only once"},
      {with("seed: -1"), "3: seed: '-1' is not valid; expected a whole number from 0 to 9223372036854775807"},
      {with("gap: 5"), "3: gap: '5' is not a duration; expected one such as 250ms"},
      {with("name: [ a ]"), "3: name: expected a word or a number"},
      {"understudy: 1\n---\nunderstudy: 1\n",
       "2: scenario: a second document begins here; expected only one"},
  });
}

TEST_F(ScenarioErrors, TheBench) {
  expect_diagnostics({
      {"understudy: 1\nbench: ''\nsteps: []\n", "2: bench: is empty; expected a path"},
      {"understudy: 1\nbench: { line: {}, lines: { a: { stations: [ { name: x, model: simple2-r3 } ] } } "
       "}\nsteps: [ say: x ]\n",
       "2: bench.line: is not a key here; expected one of lines, devices, plant, wires, inputs, faults, "
       "seed (the nearest is 'lines')"},
      {"understudy: 1\nbench: { lines: { a: { stations: [ { name: x, model: simple2-r4 } ] } } }\nsteps: "
       "[]\n",
       "2: bench.lines.a.stations[0].model: 'simple2-r4' is not a model; the nearest is 'simple2-r3'"},
      {with("firmware: 1.5"),
       "3: firmware: '1.5' is unknown for simple2-r3; expected one of 1.39, 1.40, 1.41, 1.42, 1.50, 1.51, "
       "1.52"},
      {with("firmware: { feder: 1.52 }"),
       "3: firmware.feder: no device is called 'feder'; the nearest is 'feeder'"},
      {with("firmware: 1.43"),
       "3: firmware: '1.43' is unknown for simple2-r3; expected one of 1.39, 1.40, 1.41, 1.42, "
       "1.50, "
       "1.51, 1.52"},
      {with("nv: { feder: after.json }"),
       "3: nv.feder: no device is called 'feder'; the nearest is 'feeder'"},
      {with("nv: after.json"), "3: nv: expected a map, as in `key: value`"},
  });
  // Errors in other files are reported with their places.
  EXPECT_EQ(
      folder_.diagnostic("understudy: 1\nbench: none.yaml\nsteps: []\n"),
      "scenario.yaml:2: bench: none.yaml cannot be read (No such file or directory); expected a bench file");
  folder_.write("bad.yaml", "understudy: 1\nlines: {}\n");
  EXPECT_EQ(folder_.diagnostic("understudy: 1\nbench: bad.yaml\nsteps: []\n"),
            "bad.yaml:2: lines: has no lines; expected at least one");
  EXPECT_EQ(folder_.diagnostic(with("nv: { feeder: none.json }")),
            "scenario.yaml:3: nv.feeder: none.json cannot be read (No such file or directory); expected an "
            "NV image");
  folder_.write("torn.json", "{ \"understudy\": 1,");
  EXPECT_EQ(folder_.diagnostic(with("nv: { feeder: torn.json }")),
            "torn.json:1: is damaged or not JSON; expected an NV image");
}

TEST_F(ScenarioErrors, ParametersAndCases) {
  const std::string used = "name: ${a}";
  expect_diagnostics({
      {with("parameters: { a: 1 }"),
       "3: parameters.a: 'a' is not used; expected ${a} somewhere in the scenario"},
      {with("parameters: { a: 1, a: 2 }\n" + used), "3: parameters.a: is given twice; expected it only once"},
      {with("parameters: { and: 1 }"),
       "3: parameters.and: 'and' is not a parameter name; expected letters, digits and _, beginning with a "
       "letter"},
      {with("parameters: { a: [ 1 ] }\n" + used), "3: parameters.a: expected a word or a number"},
      {with("parameters: { a: \"${b}\", b: 1 }\n" + used),
       "3: parameters.a: column 1 of 'b': no parameter is called 'b'; there are none"},
      {with("cases: []"), "3: cases: is empty; expected at least one row"},
      {with("cases: [ {} ]"), "3: cases[0]: is empty; expected a parameter's value, as in `{ speed: 100 }`"},
      {with("cases: [ { a: 1 } ]"),
       "3: cases[0].a: 'a' is not used; expected ${a} somewhere in the scenario  (a=1)"},
      {with("cases: [ { a: 1 }, { b: 1 } ]\n" + used),
       "3: cases[1].b: is neither a parameter nor a name of the first case; expected 'a'"},
      {with("cases: [ { a: 1, b: 2 }, { a: 2 } ]\nname: ${a}${b}"),
       "4: name: column 1 of 'b': no parameter is called 'b'; expected 'a'  (a=2)"},
      {with("cases: [ { a: 1 }, { a: 1 } ]\n" + used),
       "3: cases[1]: makes a second scenario called '1'; expected different values  (a=1)"},
      {with("cases: [ { a: 1, a: 2 } ]\n" + used), "3: cases[0].a: is given twice; expected it only once"},
      {with("gap: ${a}"), "3: gap: column 1 of 'a': no parameter is called 'a'; there are none"},
      {"understudy: 1\nbench: feeder.yaml\nparameters: { a: 1 }\nsteps: [ { say: ${a} } ]\n",
       "4: scenario: is not YAML: a '{' inside braces begins a map; expected quotes around a ${...} between "
       "braces or "
       "brackets  (the line is 'steps: [ { say: ${a} } ]')"},
  });
}

TEST_F(ScenarioErrors, WhatIsNoStep) {
  expect_step_diagnostics({
      {"advance", ": expected a step, as in `- advance: 250ms`"},
      {"{}", ": is empty; expected a step, as in `- advance: 250ms`"},
      {"wirte: { feeder.Aaxis_SVON: 1 }", ".wirte: is not a step; the nearest is 'write'"},
      {"{ advance: 1ms, say: x }", ".say: is a second step in one entry; expected `- ` before it"},
      {"{ advance: 1ms, exception: 3 }", ".exception: is not a key here; expected one of advance"},
      {"{ write: { feeder.Aaxis_SVON: 1 }, exeption: 3 }",
       ".exeption: is not a key here; expected one of write, exception, reply, within, via (the nearest "
       "is 'exception')"},
      {"{ write: { feeder.Aaxis_SVON: 1 }, reply: 1 }",
       ".reply: '1' is unknown; expected nothing (values that are read are compared without `reply`)"},
      {"{ write: { feeder.Aaxis_SVON: 1 }, within: 1s }",
       ".within: has no effect without `reply: nothing`; expected both"},
      {"{ write: { feeder.Aaxis_SVON: 1 }, reply: nothing, within: 0s }",
       ".within: takes no time; expected a duration above 0"},
      {"{ expect: { feeder.HW_Code: 1 }, reply: nothing, exception: 2 }",
       ".reply: an exception is a reply; expected one of the two"},
      {"{ write: { feeder.DOUT_ALL.1: 1 }, reply: nothing }",
       ".write.feeder.DOUT_ALL.1: the register of a bit is read before the write; expected whole registers "
       "with `reply: nothing`"},
      {"{ say: x, say: y }", ".say: is given twice; expected it only once"},
      {"advance: 0ms", ".advance: takes no time; expected a duration above 0"},
      {"advance: 250", ".advance: '250' is not a duration; expected one such as 250ms"},
      {"reset: all", ".reset: 'all' cannot be reset; expected peaks"},
      {"say: [ x ]", ".say: expected a word or a number"},
  });
}

/// A value that the device may treat in its own way can be written, to see the result.
TEST_F(ScenarioErrors, AreNotOfWhatADeviceTakes) {
  for (const char* const option : {"exception_03", "clamped"}) {
    const std::string text =
        "understudy: 1\nbench: { lines: { a: { stations: [ { name: it, model: simple2-r3, choices: "
        "{ write_out_of_range: " +
        std::string(option) +
        " } } ] } } }\n"
        "steps: [ write: { it.Aaxis_AccTime: 3001 } ]\n";
    if (std::string(option) == "clamped") {
      EXPECT_NO_THROW(folder_.parse(text));
    } else {
      EXPECT_THROW(folder_.parse(text), FileError);
    }
  }
}

TEST_F(ScenarioErrors, Registers) {
  expect_step_diagnostics({
      {"write: {}", ".write: is empty; expected registers, as in `{ feeder.Aaxis_SVON: 1 }`"},
      {"write: [ 1 ]", ".write: expected a map, as in `key: value`"},
      {"write: { feeder.Aaxis_SVNO: 1 }",
       ".write.feeder.Aaxis_SVNO: feeder: no register is called 'Aaxis_SVNO'; the nearest is 'Aaxis_SVON'"},
      {"write: { feder.Aaxis_SVON: 1 }",
       ".write.feder.Aaxis_SVON: no device is called 'feder'; the nearest is 'feeder'"},
      {"write: { Aaxis_SVON: 1 }",
       ".write.Aaxis_SVON: 'Aaxis_SVON' must begin with its device; expected one of feeder.Aaxis_SVON, "
       "turner.Aaxis_SVON"},
      {"write: { feeder.STATUS.16: 1 }",
       ".write.feeder.STATUS.16: feeder: register 'STATUS' has no bit '16'; expected 0 to 15, A_alarm, "
       "B_alarm, A_ready, B_ready, A_moving, B_moving, A_homing, B_homing, A_home_reached, B_home_reached, "
       "A_servo, B_servo, A_upper_limit, B_upper_limit, A_lower_limit, B_lower_limit"},
      {"write: { feeder.0x10000: 1 }",
       ".write.feeder.0x10000: '0x10000' is not a register number; expected 0 to 0xFFFF"},
      {"write: { feeder.12.3: 1 }",
       ".write.feeder.12.3: '12.3' is not a register number; expected 0 to 0xFFFF"},
      {"write: { 0x1014: 1 }",
       ".write.0x1014: '0x1014' must begin with its device; expected one of feeder.0x1014, turner.0x1014"},
      {"write: { feeder.Aaxis_SVON: 1, feeder.Aaxis_SVON: 0 }",
       ".write.feeder.Aaxis_SVON: is given twice; expected it only once"},
      {"write: { 'feeder[\"Cord_A\"': 1 }",
       ".write.feeder[\"Cord_A\": column 16 of 'feeder[\"Cord_A\"': expected ']' after the quoted name"},
      {"write: { feeder.HW_Code: 1 }",
       ".write.feeder.HW_Code: feeder.HW_Code cannot be written; it is read-only (use `exception:` if the "
       "step tests that)"},
      {"write: { feeder.Aaxis_AccTime: 3001 }",
       ".write.feeder.Aaxis_AccTime: 3001 is out of range for feeder.Aaxis_AccTime; expected 0 to 3000"},
      {"write: { feeder.Aaxis_AccTime: 2 * 1501 }",
       ".write.feeder.Aaxis_AccTime: 3002 is out of range for feeder.Aaxis_AccTime; expected 0 to 3000"},
      {"{ write: { feeder.Aaxis_AccTime: 65536 }, exception: 3 }",
       ".write.feeder.Aaxis_AccTime: 65536 is out of range for feeder.Aaxis_AccTime; expected 0 to 65535"},
      {"{ write: { feeder.Aaxis_SVON: 1 }, exception: 0 }",
       ".exception: '0' is not valid; expected a whole number from 1 to 255"},
      {"write: { feeder.0x1014: -1 }",
       ".write.feeder.0x1014: -1 is out of range for feeder.0x1014; expected 0 to 65535"},
      {"write: { feeder.DOUT_ALL.3: 2 }",
       ".write.feeder.DOUT_ALL.3: 2 is out of range for feeder.DOUT_ALL.3; expected 0 to 1"},
      {"write: { feeder.Aaxis_Pulse: 1.5 }",
       ".write.feeder.Aaxis_Pulse: 1.5 is not a whole number; expected one"},
      {"write: { feeder.Aaxis_Pulse: 5ms }",
       ".write.feeder.Aaxis_Pulse: is a duration; expected a number, or a condition"},
      {"write: { feeder.Aaxis_Pulse: 1 / 0 }",
       ".write.feeder.Aaxis_Pulse: column 3 of '1 / 0': division by zero"},
      {"write: { feeder.Aaxis_Pulse: 1 + }",
       ".write.feeder.Aaxis_Pulse: column 4 of '1 +': unexpected end; expected a name, a number or '('"},
      {"expect: { feeder.STATUS: 70000 }",
       ".expect.feeder.STATUS: feeder.STATUS is never 70000; expected a value in 0 to 65535"},
      {"expect: { feeder.STATUS.4: 2..3 }",
       ".expect.feeder.STATUS.4: feeder.STATUS.4 is never 2..3; expected a value in 0 to 1"},
      {"expect: { feeder.Cord_A: feeder.Cord_B }",
       ".expect.feeder.Cord_A: column 1 of 'feeder.Cord_B': a name, 'feeder.Cord_B', where a value, a "
       "tolerance "
       "or a range is expected"},
  });
}

TEST_F(ScenarioErrors, BytesAndLines) {
  const std::string hint =
      " is not a byte; expected bytes such as 01 03 00 01, with +crc at the end for the checksum";
  expect_step_diagnostics({
      {"send: { reply: 01 }", ".send: 'bytes' is missing; expected it here"},
      {"send: { bytes: '' }", ".send.bytes: has 0 bytes; expected 1 to 1024"},
      {"send: { bytes: 0 }", ".send.bytes: '0'" + hint},
      {"send: { bytes: 01 0G }", ".send.bytes: '0G'" + hint},
      {"send: { bytes: +crc }", ".send.bytes: '+crc'" + hint},
      {"send: { bytes: 01 +crc 02 }", ".send.bytes: '+crc'" + hint},
      {"send: { bytes: 01, reply: none }", ".send.reply: 'none'" + hint},
      {"send: { bytes: 01, within: 0ms }", ".send.within: takes no time; expected a duration above 0"},
      {"send: { bytes: 01, line: rs458 }", ".send.line: no line is called 'rs458'; the nearest is 'rs485'"},
      {"send: { byte: 01 }",
       ".send: 'bytes' is missing; expected it here\nscenario.yaml:4: steps[0].send.byte: is not a key here; "
       "expected one of line, bytes, reply, within (the nearest is 'bytes')"},
  });
  expect_diagnostics(
      {{"understudy: 1\nbench:\n  lines:\n    a: { stations: [ { name: x, model: simple2-r3 } ] }\n"
        "    b: { stations: [ { name: y, model: simple2-r3 } ] }\nsteps: [ send: { bytes: 01 } ]\n",
        "6: steps[0].send: 'line' is missing, but the bench has several lines; expected it here"}});
}

TEST_F(ScenarioErrors, Conditions) {
  const std::string until = "until: feeder.STATUS.4 == 0";
  expect_step_diagnostics({
      {"wait: { within: 1s }", ".wait: 'until' is missing; expected it here"},
      {"wait: { " + until + " }", ".wait: 'within' is missing; expected it here"},
      {"wait: { " + until + ", within: 0s }", ".wait.within: takes no time; expected a duration above 0"},
      {"wait: { " + until + ", within: 1s, takes: 5 }",
       ".wait.takes: column 1 of '5': a number where a duration is expected, such as 3050ms"},
      {"wait: { " + until + ", within: 1s, takes: 2s +- 1ms }",
       ".wait.takes: is longer than `within`, 1s; expected a shorter time"},
      {"wait: { " + until + ", within: 1s, poll: 0ms }",
       ".wait.poll: takes no time; expected a duration above 0"},
      {"wait: { until: feeder.A.pulses > 5, within: 1s, poll: 1ms }",
       ".wait.until: 'feeder.A.pulses' cannot be polled; expected registers only"},
      {"wait: { until: 1 == 1, within: 1s }",
       ".wait.until: '1 == 1' never changes; expected a condition that names something"},
      {"wait: { until: feeder.STATSU == 0, within: 1s }",
       ".wait.until: column 1 of 'feeder.STATSU == 0': feeder: no register is called 'STATSU'; the nearest "
       "is "
       "'STATUS'"},
      {"wait: { until: time > 3, within: 1s }",
       ".wait.until: column 6 of 'time > 3': '>' between a duration and a number; a duration is written like "
       "250ms"},
      {"assert: feeder.A.pulse == 0",
       ".assert: column 1 of 'feeder.A.pulse == 0': axis A has no 'pulse'; the nearest is 'pulses'"},
      {"assert: []", ".assert: is empty; expected a condition"},
      {"assert: [ feeder.power, time ]", ".assert[1]: is a duration; expected a number, or a condition"},
      {"never: { name: x }", ".never: 'what' is missing; expected it here"},
      {"always: 1", ".always: '1' never changes; expected a condition that names something"},
      {"end: slow", ".end: no active `always` or `never` is called 'slow'; there is none"},
  });
  EXPECT_EQ(folder_.diagnostic(ScenarioFolder::scenario_of("  - never: { what: feeder.power, name: slow }\n"
                                                           "  - end: slwo\n")),
            "scenario.yaml:5: steps[1].end: no active `always` or `never` is called 'slwo'; the nearest "
            "is 'slow'");
  EXPECT_EQ(
      folder_.diagnostic(ScenarioFolder::scenario_of("  - never: feeder.power\n  - always: feeder.power\n")),
      "scenario.yaml:5: steps[1].always: 'feeder.power' is already active; expected another name, or an "
      "`end` first");
}

TEST_F(ScenarioErrors, FromOutside) {
  expect_step_diagnostics({
      {"input: {}", ".input: is empty; expected entries such as `{ feeder.DIN_10: on }`"},
      {"input: { feeder.DIN_99: on }",
       ".input.feeder.DIN_99: no input of feeder is called 'DIN_99'; the nearest is 'DIN_9'"},
      {"input: { feeder.DIN_1: high }", ".input.feeder.DIN_1: 'high' is not a level; expected on or off"},
      {"inject: {}", ".inject: is empty; expected a fault, as in `{ stall: feeder.A }`"},
      {"inject: { name: x }", ".inject: is empty; expected a fault, as in `{ stall: feeder.A }`"},
      {"inject: { stall: feeder.C }", ".inject: no axis of feeder is called 'C'; expected one of A, B"},
      {"inject: { stall: feeder.A, name: all }",
       ".inject.name: 'all' cannot be the name of a fault; expected another name"},
      {"clear: jam", ".clear: no fault in force here is called 'jam'; there is none"},
      {"power: { feeder: down }", ".power.feeder: 'down' is unknown; expected on, off or cycle"},
      {"power: { feder: on }", ".power.feder: no device is called 'feder'; the nearest is 'feeder'"},
      {"program: { feeder: none.lst }",
       ".program.feeder: none.lst cannot be read (No such file or directory); expected a listing"},
      {"memory: { feeder: none.json }",
       ".memory.feeder: none.json cannot be read (No such file or directory); expected an NV image"},
      {"save: { feeder: nowhere/x.json }",
       ".save.feeder: nowhere is not a folder; expected a folder for the file"},
      {"save: { feder: x.json }", ".save.feder: no device is called 'feder'; the nearest is 'feeder'"},
  });
  const auto diagnostic = [&](const std::string& steps) {
    return folder_.diagnostic(ScenarioFolder::scenario_of(steps));
  };
  const std::string jam = "  - inject: { stall: feeder.A, name: jam }\n";
  EXPECT_EQ(diagnostic(jam + "  - clear: jma\n"),
            "scenario.yaml:5: steps[1].clear: no fault in force here is called 'jma'; the nearest is 'jam'");
  EXPECT_EQ(diagnostic(jam + jam),
            "scenario.yaml:5: steps[1].inject.name: 'jam' is already in force; expected another name, or a "
            "`clear` first");
  EXPECT_EQ(diagnostic(jam + "  - clear: all\n  - clear: jam\n"),
            "scenario.yaml:6: steps[2].clear: no fault in force here is called 'jam'; there is none");
  folder_.write("bad.lst", "        SVON_A\n        Fly MEM0\n        END\n");
  EXPECT_TRUE(diagnostic("  - program: { feeder: bad.lst }\n").starts_with("bad.lst:2: mnemonic: "));
  EXPECT_TRUE(diagnostic("  - program:\n      feeder: |\n        SVON_A\n        Fly MEM0\n")
                  .starts_with("scenario.yaml:7: steps[0].program.feeder: mnemonic: "));
  folder_.write("mill.json",
                to_json({.model = "simple2-r3", .firmware = "1.52", .registers = {{"Aaxis_SVON", 1}}}));
  EXPECT_EQ(diagnostic("  - memory: { feeder: mill.json }\n"),
            "scenario.yaml:4: steps[0].memory.feeder: registers: 'Aaxis_SVON' is not persistent; expected a "
            "persistent register");
}

TEST_F(ScenarioErrors, TheCourseOfThings) {
  expect_step_diagnostics({
      {"snapshot: ''", ".snapshot: is empty; expected a name"},
      {"restore: homed", ".restore: no earlier snapshot is called 'homed'; there is none"},
      {"fork: {}", ".fork: is empty; expected branches by name"},
      {"fork: { a: [] }", ".fork.a: is empty; expected at least one step"},
      {"fork: { a: [ advance: 1ms ], a: [ advance: 1ms ] }",
       ".fork.a: is given twice; expected it only once"},
      {"repeat: { steps: [ advance: 1ms ] }", ".repeat: 'times' is missing; expected it here"},
      {"repeat: { times: 0, steps: [ advance: 1ms ] }",
       ".repeat.times: '0' is not valid; expected a whole number from 1 to 100000"},
      {"repeat: { times: 2, as: and, steps: [ advance: 1ms ] }",
       ".repeat.as: 'and' is not a parameter name; expected letters, digits and _, beginning with a letter"},
      {"repeat: { times: 2, as: i, steps: [ repeat: { times: 2, as: i, steps: [ advance: 1ms ] } ] }",
       ".repeat.steps[0].repeat.as: 'i' is already defined; expected another name"},
      {"for: { each: [], as: i, steps: [ advance: 1ms ] }",
       ".for.each: is empty; expected at least one value"},
      {"for: { each: [ 1 ], steps: [ advance: 1ms ] }", ".for: 'as' is missing; expected it here"},
      {"for: { each: [ { a: 1 } ], as: b, steps: [ advance: 1ms ] }",
       ".for.as: is not needed, because the rows name their values; expected no `as`"},
      {"for: { each: [ 1, 2 ], as: n, steps: [ advance: \"${m}ms\" ] }",
       ".for.steps[0].advance: column 1 of 'm': no parameter is called 'm'; expected 'n'"},
      {"include: none.yaml",
       ".include: none.yaml cannot be read (No such file or directory); expected a file of steps"},
      {"include: ''", ".include: is empty; expected a path"},
  });
  const auto diagnostic = [&](const std::string& steps) {
    return folder_.diagnostic(ScenarioFolder::scenario_of(steps));
  };
  // Names that a continuation defines do not exist next to it or after it.
  const std::string fork = "  - fork:\n      a: [ snapshot: inner ]\n";
  EXPECT_EQ(diagnostic(fork + "      b: [ restore: inner ]\n"),
            "scenario.yaml:6: steps[0].fork.b[0].restore: no earlier snapshot is called 'inner'; there "
            "is none");
  EXPECT_EQ(diagnostic(fork + "  - restore: inner\n"),
            "scenario.yaml:6: steps[1].restore: no earlier snapshot is called 'inner'; there is none");
  // The faults are the same as before.
  EXPECT_EQ(diagnostic("  - snapshot: well\n  - inject: { stall: feeder.A, name: jam }\n  - restore: well\n"
                       "  - clear: jam\n"),
            "scenario.yaml:7: steps[3].clear: no fault in force here is called 'jam'; there is none");
}

TEST_F(ScenarioErrors, IncludedFiles) {
  const auto diagnostic = [&](const std::string& file) {
    return folder_.diagnostic(ScenarioFolder::scenario_of("  - include: " + file + "\n"));
  };
  folder_.write("self.yaml", "understudy: 1\nsteps: [ include: self.yaml ]\n");
  EXPECT_EQ(diagnostic("self.yaml"),
            "self.yaml:2: steps[0].include: self.yaml includes itself; expected another file");
  folder_.write("a.yaml", "understudy: 1\nsteps: [ include: ./b.yaml ]\n");
  folder_.write("b.yaml", "understudy: 1\nsteps: [ include: sub/../a.yaml ]\n");
  EXPECT_EQ(diagnostic("a.yaml"),
            "b.yaml:2: steps[0].include: a.yaml includes itself; expected another file");
  folder_.write("scenario.yaml", ScenarioFolder::scenario_of("  - include: scenario.yaml\n"));
  EXPECT_EQ(diagnostic("scenario.yaml"),
            "scenario.yaml:4: steps[0].include: scenario.yaml includes itself; expected another file");
  folder_.write("key.yaml", "understudy: 1\nname: x\nsteps: [ advance: 1ms ]\n");
  EXPECT_EQ(diagnostic("key.yaml"), "key.yaml:2: name: is not a key here; expected one of understudy, steps");
  folder_.write("wrong.yaml", "understudy: 1\nsteps:\n  - advance: 1ms\n  - advance: 1\n");
  EXPECT_EQ(diagnostic("wrong.yaml"),
            "wrong.yaml:4: steps[1].advance: '1' is not a duration; expected one such as 250ms");
  for (int i = 0; i < 40; ++i) {
    folder_.write("deep" + std::to_string(i) + ".yaml",
                  "understudy: 1\nsteps: [ include: deep" + std::to_string(i + 1) + ".yaml ]\n");
  }
  // The scenario's own steps are the first level, those of deep30.yaml the 32nd.
  EXPECT_EQ(
      diagnostic("deep0.yaml"),
      "deep31.yaml:2: steps: is nested too deeply; expected at most 32 levels of loops, forks and includes");
}

TEST_F(ScenarioErrors, AreOneLineWhateverIsQuotedInThem) {
  for (const std::string step :
       {"\"a\\nb\": 1", "say: { \"a\\nb\": 1 }", "write: { \"feeder.a\\nb\": 1 }", "advance: \"1\\nms\"",
        "send: { bytes: \"a\\tb\\x1b\" }", "restore: \"a\\nb\"", "clear: \"a\\nb\"", "end: \"a\\nb\"",
        "wait: { until: \"feeder.a\\nb\", within: 1s }", "include: \"a\\nb\"", "power: { \"a\\nb\": on }"}) {
    const std::string got = folder_.diagnostic(ScenarioFolder::scenario_of("  - " + step + "\n"));
    EXPECT_NE(got, "") << step;
    EXPECT_EQ(got.find_first_of("\n\t\x1b"), std::string::npos) << got;
  }
}

}  // namespace scenario_errors_test
}  // namespace understudy::emulator::play
