#include "emulator/model_file/model_reader.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "emulator/model_file/model_schema.h"
#include "emulator/play/schema/json_schema.h"
#include "emulator/world/bench/bench_text.h"
#include "tests/emulator/model_file/described.h"
#include "tests/emulator/play/schema/schema_check.h"

namespace understudy::emulator::model_file {
namespace model_reader_test {

const std::string kList =
    "table,address,name,access,type,min,max,unit,persistent,default,bits\n"
    "holding,0,CONTROL,R/W,u16,,,,0,0,\"0 GO, 4-7 MODE\"\n"
    "holding,1,STATUS,R,u16,,,,0,0,0 BUSY\n"
    "holding,2,TARGET,R/W,s32,,,,0,0,\n"
    "holding,4,SPEED,R/W,u16,0,9000,pps,1,100,\n"
    "holding,5,RAMP,R/W,u16,,,10ms,0,0,\n"
    "holding,6,POSITION,R/W,s32,,,,0,0,\n"
    "holding,8,KEPT,R,u16,,,,1,0,\n"
    "holding,9,GAIN,R/W,f32,,,,0,1,\n"
    "holding,11,ORDER,W,u16,,,,0,0,\n"
    "input,0,TEMPERATURE,R,s16,,,,0,200,\n"
    "input,1,LEVEL,R,u16,,,,0,0,\n"
    "coil,0,RUN,R/W,bit,,,,0,0,\n"
    "discrete,0,SWITCH,R,bit,,,,0,0,\n";
constexpr int kLines = 17;  // comes before the part after the list

/// Returns the errors of a model with these further lines, without the position at the file's beginning.
std::string diagnostic(const std::string& more) { return diagnostic_about(model_with(kList, more)); }

std::string at(int line, int column, const std::string& text) {
  return "m.yaml:" + std::to_string(kLines + line) + ":" + std::to_string(column) + ": " + text;
}

/// An axis A with these keys, from the second of the lines on.
std::string axis(const std::string& keys) { return "axes:\n  A: { " + keys + " }\n"; }

struct WrongAxis {
  const char* keys;
  int column;
  const char* diagnostic;
};

TEST(ModelReader, SaysWhatIsWrongWithAnAxis) {
  const WrongAxis kWrong[] = {
      {"targt: TARGET", 15, "axes.A.targt: is not a key here; expected one of target, distance, speed,"},
      {"position: POSITON", 18,
       "axes.A.position: no register is called 'POSITON'; the nearest is 'POSITION'"},
      {"position: TARGET_L", 18,
       "axes.A.position: 'TARGET_L' is half of a register; expected the whole register"},
      {"position: STATUS.3", 18, "axes.A.position: 'STATUS.3' is a bit; expected a register"},
      {"position: KEPT", 18,
       "axes.A.position: 'KEPT' is persistent in the list; expected 0 there, because it shows "
       "A.position"},
      {"position: ORDER", 18,
       "axes.A.position: 'ORDER' is write-only; expected a register that hosts can read"},
      {"encoder: TARGET", 17,
       "axes.A.encoder: 'TARGET' is written by hosts; expected a register that hosts only "
       "read (R)"},
      {"busy: STATUS.16", 14, "axes.A.busy: register 'STATUS' has no bit '16'; expected 0 to 15, BUSY"},
      {"busy: CONTROL.MODE", 14,
       "axes.A.busy: 'CONTROL.MODE' is several bits; expected one bit, or a register"},
      {"busy: STATUS.BUSY, ready: STATUS.0", 34,
       "axes.A.ready: 'STATUS.0' already shows A.busy; expected another place for A.ready"},
      {"busy: STATUS, ready: STATUS.3", 29,
       "axes.A.ready: 'STATUS.3' already shows A.busy; expected another place for A.ready"},
      {"start: CONTROL.GO", 15, "axes.A.start: has no effect without `target`; expected both"},
      {"start: STATUS.2, target: TARGET, speed: SPEED", 15,
       "axes.A.start: 'STATUS' cannot be written; expected a register that hosts write"},
      {"start: TARGET, target: TARGET, speed: SPEED", 15,
       "axes.A.start: 'TARGET' has 32 bits, which hosts can write in halves; expected 16 bits, or a coil"},
      {"start: CONTROL == x, target: TARGET, speed: SPEED", 15,
       "axes.A.start: 'x' is not a number; expected a number, as in COMMAND == 2"},
      {"start: CONTROL.MODE == 16, target: TARGET, speed: SPEED", 15,
       "axes.A.start: '16' never occurs; expected 0 to 15"},
      {"stop: GAIN", 14, "axes.A.stop: 'GAIN' is a real number; expected a bit, or a whole number"},
      {"enable: STATUS.3, busy: STATUS.BUSY", 16, ""},  // see below
      {"forward: TEMPERATURE, speed: 5", 17,
       "axes.A.forward: 'TEMPERATURE' never changes; expected a register that hosts write, or an input"},
      {"acceleration_time: SPEED", 27,
       "axes.A.acceleration_time: 'SPEED' has the unit 'pps'; expected a unit of time in the list, such as "
       "ms, "
       "10ms or s"},
      {"acceleration_time: 250", 27,
       "axes.A.acceleration_time: '250' has no unit; expected a duration such as 250ms, or a register"},
      {"acceleration_time: RAMP, acceleration: 5", 27,
       "axes.A.acceleration_time: cannot be combined with `acceleration`; expected one of the two"},
      {"pulses_per_count: 0", 26,
       "axes.A.pulses_per_count: '0' is not valid; expected a whole number above 0, or a fraction such as "
       "25/4"},
      {"pps_per_count: -1", 23,
       "axes.A.pps_per_count: '-1' is not valid; expected a number above 0 and up to 1e9"},
      {"home: CONTROL.2, speed: 5", 14, "axes.A.home: needs a switch; expected `inputs: { home: ... }`"},
      {"inputs: { home: DI1 }", 24, "axes.A.inputs.home: 'DI1' is not an input; the model has no `inputs`"},
      {"while_busy: wait", 20,
       "axes.A.while_busy: 'wait' is not valid; expected one of replace, ignore, refuse"},
      {"while_disabled: refuse", 24, "axes.A.while_disabled: has no effect without `enable`; expected both"},
  };
  for (const WrongAxis& wrong : kWrong) {
    if (std::string(wrong.diagnostic).empty()) continue;
    const std::string came = diagnostic(axis(wrong.keys));
    const std::string expected = at(2, wrong.column, wrong.diagnostic);
    EXPECT_EQ(came.substr(0, expected.size()), expected) << wrong.keys << "\n" << came;
  }
}

struct WrongPart {
  const char* lines;
  int line;
  int column;
  const char* diagnostic;
};

TEST(ModelReader, SaysWhatIsWrongElsewhere) {
  const WrongPart kWrong[] = {
      {"lines: { }\n", 1, 8, "lines: is not a key here; expected one of understudy, model,"},
      {"line: { baud: 0 }\n", 1, 15,
       "line.baud: '0' is not valid; expected a whole number from 50 to 4000000"},
      {"line: { parity: mark }\n", 1, 17,
       "line.parity: 'mark' is not valid; expected one of none, even, odd"},
      {"line: { silence: 2s }\n", 1, 18,
       "line.silence: '2s' is not valid; expected a duration above 0 and up to 1s"},
      {"line: { stations: [5, 1] }\n", 1, 19,
       "line.stations: ends before it begins; expected a range such as [1, 247]"},
      {"line: { functions: [3, 7] }\n", 1, 24,
       "line.functions[1]: 7 is not a supported function; expected one of 1, 2, 3, 4, 5, 6, "},
      {"line: { most: { 23: 5 } }\n", 1, 21,
       "line.most.23: '23' is not in `functions`; expected one of these"},
      {"line: { most: { 3: 126 } }\n", 1, 20,
       "line.most.3: 126 is more than function 3 allows; expected 125 or fewer"},
      {"line: { most: { 6: 2 } }\n", 1, 20,
       "line.most.6: 2 is more than function 6 allows; expected 1 or fewer"},
      {"line: { silence: 0ms }\n", 1, 18,
       "line.silence: '0ms' is not valid; expected a duration above 0 and up to 1s"},
      {"outputs: { DO1: STATUS.3 }\nshows: { STATUS.2: SPEED > 5 }\n", 1, 17,
       "outputs.DO1: 'STATUS.3' never changes; expected a register that hosts write, or that shows a value"},
      {"axes: { A: { stop: SPEED == 9001 } }\n", 1, 20,
       "axes.A.stop: '9001' never occurs; expected 0 to 9000"},
      {"line: { station_in: TARGET }\n", 1, 21,
       "line.station_in: 'TARGET' cannot hold the station number; expected a 16-bit holding register"},
      {"line: { station_in: CONTROL }\n", 1, 21,
       "line.station_in: 'CONTROL' has the default 0; expected a default from 1 to 247 (`stations`)"},
      {"map: { holes: none }\n", 1, 15, "map.holes: 'none' is not valid; expected one of refused, zero"},
      {"bits: { STATUSS: { A: 0 } }\n", 1, 18,
       "bits.STATUSS: 'STATUSS' is not a register of the list; the nearest is "
       "'STATUS'"},
      {"bits: { STATUS: { A: 16 } }\n", 1, 22,
       "bits.STATUS.A: '16' is not a bit; expected 0 to 15, or a range such as 4-7"},
      {"bits: { STATUS: { A: 0 } }\n", 1, 22,
       "bits.STATUS.A: A shares a bit with another name; expected separate bits"},
      {"inputs: { DI1: CONTROL.0, DI2: CONTROL }\n", 1, 32,
       "inputs.DI2: 'CONTROL' is written by hosts; expected a register that hosts only read (R)"},
      {"inputs: { DI1: STATUS.1, DI2: STATUS.1 }\n", 1, 31,
       "inputs.DI2: 'STATUS.1' already shows DI1; expected another place for DI2"},
      {"outputs: { DO1: SPEED }\n", 1, 17,
       "outputs.DO1: 'SPEED' is not a bit; expected a bit, as in OUTPUTS.0"},
      {"inputs: { D: SWITCH }\noutputs: { D: RUN }\n", 2, 15,
       "outputs.D: 'D' is also an input; expected another "
       "name"},
      {"follows: { TEMPERATURE: { time_constant: 1s } }\n", 1, 25,
       "follows.TEMPERATURE: 'of' is missing; expected it here"},
      {"follows: { TEMPERATURE: { of: TEMPERATURE } }\n", 1, 31,
       "follows.TEMPERATURE.of: is the register itself; expected another register"},
      {"follows: { TEMPERATURE: { of: SPEED, rest: 5 } }\n", 1, 44,
       "follows.TEMPERATURE.rest: has no effect without `while`; expected both"},
      {"follows: { TEMPERATURE: { of: SPEED, rate: 0 } }\n", 1, 44,
       "follows.TEMPERATURE.rate: '0' is not valid; expected a number above 0"},
      {"follows: { TEMPERATURE: { of: SPEED, every: 0ms } }\n", 1, 45,
       "follows.TEMPERATURE.every: '0ms' is not valid; expected 1ms to 60s"},
      {"follows: { SPEED: { of: 5 } }\n", 1, 19,
       "follows.SPEED: 'SPEED' is written by hosts; expected a register that hosts only read (R)"},
      {"shows: { STATUS.1: TEMPERATURE>5 }\n", 1, 20,
       "shows.STATUS.1: '>' has no spaces around it; expected spaces, as in TEMPERATURE > LIMIT"},
      {"shows: { STATUS.1: SPEED > 5, SWITCH: STATUS > 0 }\n", 1, 39,
       "shows.SWITCH: compares a register that itself shows a comparison; expected other registers"},
      {"momentary: [ STATUS ]\n", 1, 14,
       "momentary[0]: 'STATUS' cannot be momentary; expected a 16-bit register or a coil that hosts can "
       "write"},
      {"momentary: [ RUN ]\naxes: { A: { forward: RUN, speed: 5 } }\n", 2, 23,
       "axes.A.forward: 'RUN' is momentary; expected a register that keeps what is written"},
      {"follows: { TEMPERATURE: { of: SPEED } }\naxes: { A: { forward: TEMPERATURE, speed: 5 } }\n", 2, 23,
       "axes.A.forward: 'TEMPERATURE' shows a value; expected a register that hosts write, or an "
       "input"},
  };
  for (const WrongPart& wrong : kWrong) {
    const std::string came = diagnostic(wrong.lines);
    const std::string expected = at(wrong.line, wrong.column, wrong.diagnostic);
    EXPECT_EQ(came.substr(0, expected.size()), expected) << wrong.lines << "\n" << came;
  }
}

TEST(ModelReader, SaysWhatIsWrongWithTheWhole) {
  EXPECT_EQ(diagnostic_about(""),
            "m.yaml:1:1: model: the file is not a map; expected `understudy: 1`, `model:` and `registers:`");
}

/// Values that are stored unchecked can exceed the range of the list, and so can displayed values.
TEST(ModelReader, KnowsWhichValuesMayBeThere) {
  EXPECT_EQ(diagnostic("axes: { A: { stop: SPEED == 9000 } }\n"), "");
  EXPECT_EQ(diagnostic("map: { out_of_range: stored }\naxes: { A: { stop: SPEED == 9001 } }\n"), "");
  EXPECT_NE(diagnostic("map: { out_of_range: clamped }\naxes: { A: { stop: SPEED == 9001 } }\n"), "");
  EXPECT_EQ(diagnostic("line: { most: { 3: 125, 6: 1, 1: 2000 } }\n"), "");
  EXPECT_EQ(diagnostic("outputs: { DO1: STATUS.3, DO2: CONTROL.3 }\nshows: { STATUS.3: SPEED > 5 }\n"), "");
}

TEST(ModelReader, TakesAnAxisWithEveryKey) {
  EXPECT_EQ(
      diagnostic("inputs: { UP: STATUS.8, DOWN: STATUS.9, HOME: SWITCH, ALARM: nowhere }\n"
                 "axes:\n"
                 "  A:\n"
                 "    target: TARGET\n"
                 "    distance: 500\n"
                 "    speed: SPEED\n"
                 "    start_speed: 10\n"
                 "    acceleration_time: RAMP\n"
                 "    deceleration: 4000\n"
                 "    rated_speed: 1000\n"
                 "    home_speed: GAIN\n"
                 "    stop_at_once: CONTROL.MODE == 7\n"
                 "    stop: ORDER == 0\n    start: ORDER == 1\n    start_relative: ORDER == 2\n"
                 "    enable: UP_IS_NO_REGISTER\n"),
      at(16, 13, "axes.A.enable: no register is called 'UP_IS_NO_REGISTER'; expected one such as 'CONTROL'"));
  const std::string all =
      "inputs: { UP: STATUS.8, DOWN: STATUS.9, HOME: SWITCH, ALARM: nowhere, V: LEVEL }\n"
      "outputs: { LAMP: RUN, VALVE: CONTROL.12 }\n"
      "momentary: [ ORDER ]\n"
      "axes:\n"
      "  A: { target: TARGET, distance: 500, speed: SPEED, start_speed: 10, acceleration_time: RAMP,\n"
      "       deceleration: 4000, rated_speed: 1000, home_speed: GAIN, stop_at_once: CONTROL.MODE == 7,\n"
      "       stop: ORDER == 3, enable: CONTROL.2, home: CONTROL.3, start: ORDER == 1, start_relative: ORDER "
      "== 2,\n"
      "       forward: RUN, backward: CONTROL.MODE == 1, position: POSITION, busy: STATUS.BUSY, ready: "
      "STATUS.1,\n"
      "       arrived: STATUS.2, homed: STATUS.3, enabled: STATUS.4, alarm: STATUS.5, at_upper_limit: "
      "STATUS.6,\n"
      "       at_lower_limit: STATUS.7, pulses_per_count: 25/4, pps_per_count: 0.5, home_way: plus,\n"
      "       home_position: -7, pulses_per_revolution: 400, while_busy: ignore, while_disabled: refuse,\n"
      "       inputs: { upper_limit: UP, lower_limit: DOWN, home: HOME, alarm: ALARM } }\n";
  EXPECT_EQ(diagnostic(all), "");
}

/// Each key is read: a value that is not a register, number, word or map is refused everywhere.
TEST(ModelReader, ReadsEveryKeyOfAnAxis) {
  for (const Key& row : kAxisKeys) {
    const std::string came = diagnostic(axis(std::string(row.key) + ": '?'"));
    EXPECT_NE(came.find("axes.A." + std::string(row.key) + ": "), std::string::npos)
        << row.key << ": " << came;
    EXPECT_EQ(came.find("is not a key"), std::string::npos) << row.key;
  }
}

/// An alias may be inside the node that it names.
TEST(ModelReader, IsNotCaughtInACircle) {
  EXPECT_NE(diagnostic("momentary: &m [ *m ]\n"), "");
  EXPECT_NE(diagnostic("axes: &a { A: *a }\n"), "");
  EXPECT_NE(diagnostic("bits: &b { STATUS: *b }\n"), "");
}

TEST(ModelSchema, SuitsTheExamplesAndThePage) {
  const std::string schema = play::file_schema("Understudy model", kModelKeys);
  const auto contents = [](const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(std::string(PROJECT_FOLDER) + path).rdbuf();
    return text.str();
  };
  for (const char* const example : {"/examples/import/drive.yaml", "/examples/import/oven.yaml"})
    EXPECT_EQ(play::schema_diagnostic(schema, contents(example)), "") << example;
  // The page shows one file in parts.
  const std::string page = contents("/docs/import.md");
  std::string whole;
  for (std::size_t at = 0; (at = page.find("```yaml\n", at)) != std::string::npos;) {
    at += 8;
    whole += page.substr(at, page.find("```\n", at) - at);
  }
  EXPECT_EQ(play::schema_diagnostic(schema, whole), "") << whole;
  EXPECT_NE(play::schema_diagnostic(schema, "understudy: 1\nmodel: m\nregisters: l.csv\naxis: {}\n"), "");
}

TEST(ModelFiles, GiveTheSameModelForTheSameText) {
  const std::string text = model_with(kList, axis("target: TARGET, speed: SPEED, start: CONTROL.GO"));
  const Model& model = described_models().parse(text, "m.yaml");
  EXPECT_EQ(&described_models().parse(text, "other.yaml"), &model);
  // It also shows its own text.
  EXPECT_EQ(&described_models().parse(std::string(model.description), "again.yaml"), &model);
}

TEST(ModelFiles, RefuseTheNameOfAModelThatThereIs) {
  EXPECT_EQ(diagnostic_about("understudy: 1\nmodel: slim\nregisters: \"address,name\\n0,A\\n\"\n"),
            "m.yaml:2:8: model: 'slim' is a built-in model; expected another name");
}

class ModelFilesInAFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = testing::TempDir() + "understudy-models-XXXXXX";
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  std::filesystem::path folder_;
};

TEST_F(ModelFilesInAFolder, AreNamedByBenches) {
  write("list.csv", kList);
  write("m.yaml", "understudy: 1\nmodel: one\nregisters: list.csv\n");
  const std::string bench_path = write(
      "bench.yaml",
      "understudy: 1\nlines: { a: { stations: [ { name: it, model: m.yaml, set: { SPEED: 7 } } ] } }\n");
  const world::Bench bench = world::load_bench(with_described(), bench_path);
  EXPECT_EQ(bench.devices[0].model->name, "one");
  std::vector<std::string> read;
  for (const FileClaim& claim : bench.files)
    read.push_back(std::filesystem::path(claim.path).filename().string());
  EXPECT_EQ(read, (std::vector<std::string>{"bench.yaml", "m.yaml", "list.csv"}));
  // As a text it is complete: it is the same bench wherever the files are.
  const std::string text = to_text(bench);
  std::filesystem::remove_all(folder_);
  const world::Bench again = world::parse_recorded_bench(with_described(), text);
  EXPECT_EQ(again.devices[0].model, bench.devices[0].model);
  EXPECT_EQ(to_text(again), text);
}

TEST_F(ModelFilesInAFolder, AreSaidToBeMissingWhereTheyAreNamed) {
  const std::string bench =
      write("bench.yaml", "understudy: 1\nlines: { a: { stations: [ { name: it, model: m.yaml } ] } }\n");
  const auto diagnostic_about_bench = [&] {
    try {
      world::load_bench(with_described(), bench);
      return std::string();
    } catch (const FileError& error) {
      return std::string(error.what());
    }
  };
  const std::string model = (folder_ / "m.yaml").string();
  EXPECT_EQ(diagnostic_about_bench(),
            bench + ":2:46: lines.a.stations[0].model: " + model +
                " cannot be read (No such file or directory); expected a model file");
  write("m.yaml", "understudy: 1\nmodel: one\nregisters: list.csv\n");
  EXPECT_EQ(diagnostic_about_bench(),
            model + ":3:12: registers: " + (folder_ / "list.csv").string() +
                " cannot be read (No such file or directory); expected a list of registers (CSV)");
  write("list.csv", "understudy: 1\nlines: {}\n");
  EXPECT_EQ(diagnostic_about_bench(), model + ":3:12: registers: " + (folder_ / "list.csv").string() +
                                          " is a bench; expected a list of registers (CSV)");
}

TEST(ModelFiles, InsideABenchAreReportedAtTheirLines) {
  const auto reported = [](const std::string& model) {
    try {
      world::parse_bench(with_described(),
                         "understudy: 1\nlines: { a: { stations: [ { device: d } ] } }\ndevices:\n  d:\n    "
                         "model: " +
                             model,
                         "bench.yaml", "/benches");
      return std::string();
    } catch (const FileError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(
      reported("|\n      understudy: 1\n      model: m\n      registers: |\n        table,address\n      "
               "axs: 1\n"),
      "bench.yaml:9:7: devices.d.model: registers: the list is empty; expected a line of headings, and a "
      "line for each register\nbench.yaml:10:12: devices.d.model: axs: is not a key here; expected one of "
      "understudy, model, title, firmware, registers, list, line, map, bits, inputs, outputs, axes, follows, "
      "shows, "
      "momentary (the nearest is 'axes')");
  EXPECT_EQ(reported("./list.csv\n"),
            "bench.yaml:5:12: devices.d.model: './list.csv' is a path; expected the path of a model file, "
            "NAME.yaml, or the name of a model");
}

TEST(ModelFiles, InARecordingHaveTheirListInside) {
  const std::string bench =
      R"({"understudy":1,"lines":{"a":{"stations":[{"device":"it"}]}},"devices":{"it":{"model":)" +
      quoted_scalar("understudy: 1\nmodel: one\nregisters: list.csv\n") + "}}}";
  try {
    world::parse_recorded_bench(with_described(), bench);
    FAIL() << "it was read";
  } catch (const FileError& error) {
    EXPECT_STREQ(error.what(),
                 "bench:1:87: devices.it.model: line 3, column 12: registers: is a path; expected the list "
                 "itself, because a recording contains everything");
  }
}

}  // namespace model_reader_test
}  // namespace understudy::emulator::model_file
