// The parts of a device that steps, hosts and faults exercise, counted in the rows of its tables.
#include "emulator/world/coverage/controller_coverage.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>

#include "emulator/world/coverage/touched.h"
#include "tests/emulator/model_file/described.h"
#include "tests/emulator/play/performing/played.h"

namespace understudy::emulator::world {
namespace controller_coverage_test {

class Keeper final : public play::Observer {
 public:
  Keeper(World& world, TouchedReport& kept) : coverage_(world), kept_(kept) {}
  void world_restored(std::size_t /*steps*/) override { coverage_.world_restored(); }
  void finish(play::ScenarioResult& /*result*/) override { kept_ = coverage_.report(); }

 private:
  ControllerCoverage coverage_;
  TouchedReport& kept_;
};

/// Plays a scenario and returns what it has touched.
TouchedReport touched(const play::Scenario& scenario) {
  TouchedReport kept;
  play::RunOptions options;
  options.observers.push_back([&](World& world) { return std::make_unique<Keeper>(world, kept); });
  const play::ScenarioResult result = play::run_scenario(scenario, options).front();
  EXPECT_TRUE(play::has_passed(result)) << play::why(result);
  return kept;
}

TouchedReport touched(const std::string& steps) { return touched(play::scenario_of(steps)); }

/// Returns the counts of a row: "2 0 -".
std::string counts(const TouchedReport& report, const std::string& table, const std::string& row) {
  std::string text;
  for (const auto& [model, tables] : report.models) {
    for (const TouchedTable& one : tables) {
      if (one.name != table) continue;
      for (const TouchedRow& of : one.rows) {
        if (of.name != row) continue;
        for (const std::int64_t counted : of.counts)
          text += (text.empty() ? "" : " ") + (counted == kCannotBe ? "-" : std::to_string(counted));
      }
    }
  }
  return text;
}

TEST(ControllerCoverage, CountsWhatAHostReadsAndWrites) {
  const TouchedReport report = touched(
      "  - input: { feeder.DIN_9: on }\n"
      "  - send: { bytes: 01 03 00 00 00 02 +crc, within: 100ms }\n"
      "  - send: { bytes: 01 06 10 14 00 01 +crc, within: 100ms }\n"
      "  - send: { bytes: 01 03 00 00 00 01 +crc, within: 100ms }\n"
      "  - send: { bytes: 02 03 00 00 00 01 +crc, reply: nothing }\n"   // to another station
      "  - send: { bytes: 01 03 00 00 00 01 00 00, reply: nothing }\n"  // with a wrong checksum
      "  - send: { bytes: 01 06 00 01 00 05 +crc, within: 100ms }\n"    // read-only
      "  - send: { bytes: 01 03 7F 00 00 01 +crc, within: 100ms }\n");  // nothing exists there
  EXPECT_EQ(counts(report, "registers", "STATUS"), "2 - -");
  EXPECT_EQ(counts(report, "registers", "HW_Code"), "1 - 1");
  EXPECT_EQ(counts(report, "registers", "Aaxis_SVON"), "0 1 -");
  EXPECT_EQ(counts(report, "bits", "STATUS.A_servo"), "1 1");
  EXPECT_EQ(counts(report, "bits", "STATUS.A_alarm"), "0 2");
  EXPECT_EQ(counts(report, "functions", "3 read holding"), "2 1");
  EXPECT_EQ(counts(report, "functions", "6 write one holding"), "1 1");
  EXPECT_EQ(counts(report, "exceptions", "2 (illegal data address)"), "2");
  EXPECT_EQ(counts(report, "exceptions", "3 (illegal data value)"), "0");
  EXPECT_EQ(report.untouched().front().row, "STATUS.A_alarm");
}

/// A device whose rotary switch is at 0 answers every number; station 0 is a broadcast to others.
TEST(ControllerCoverage, CountsWhatTheDeviceExecutedWhateverTheNumberIs) {
  struct Case {
    int address;
    int station;
    const char* exceptions;
  };
  for (const Case& c : {Case{1, 1, "1"}, Case{0, 0, "1"}, Case{0, 1, "1"}, Case{1, 0, "0"}}) {
    const std::string reply = c.address != 0 && c.station == 0 ? "reply: nothing, " : "";
    const std::string to = "  - send: { bytes: 0" + std::to_string(c.station) + " 06 10 0";
    const TouchedReport report =
        touched(play::parse_scenarios(models::all_models(),
                                      "understudy: 1\nbench: { lines: { a: { stations: [ { name: f, model: "
                                      "simple2-r3, address: " +
                                          std::to_string(c.address) + " } ] } } }\nsteps:\n" + to +
                                          "2 00 07 +crc, " + reply + "within: 100ms }\n" + to +
                                          "3 FF FF +crc, " + reply + "within: 100ms }\n",
                                      "test.yaml")
                    .front());
    EXPECT_EQ(counts(report, "registers", "Aaxis_Speed"), "0 1 -") << c.address << " " << c.station;
    EXPECT_EQ(counts(report, "registers", "Aaxis_AccTime"), "0 0 1") << c.address << " " << c.station;
    EXPECT_EQ(counts(report, "functions", "6 write one holding"), "1 1") << c.address << " " << c.station;
    EXPECT_EQ(counts(report, "exceptions", "3 (illegal data value)"), c.exceptions)
        << c.address << " " << c.station;
  }
}

TEST(ControllerCoverage, CountsFunctionsThatAreMoreThanOneAccess) {
  const std::string model = model_file::quoted_scalar(
      model_file::model_with("address,name,access,type,min,max,default\n"
                             "0,FLAGS,R/W,u16,,,0x0012\n"
                             "1,LEVEL,R/W,u16,0,100,7\n",
                             "line: { functions: [3, 17, 22, 23], server_id: me }\n"));
  const TouchedReport report =
      touched(play::parse_scenarios(
                  model_file::with_described(),
                  "understudy: 1\nbench: { lines: { a: { stations: [ { name: it, model: " + model +
                      " } ] } } }\nsteps:\n"
                      "  - send: { bytes: 01 11 +crc, within: 100ms }\n"
                      "  - send: { bytes: 01 16 00 00 00 F2 00 25 +crc, within: 100ms }\n"
                      "  - send: { bytes: 01 17 00 00 00 01 00 01 00 01 02 00 09 +crc, within: 100ms }\n"
                      "  - send: { bytes: 01 17 00 00 00 01 00 01 00 01 02 00 FF +crc, within: 100ms }\n"
                      "  - inject: { drop: it, of: request, address: LEVEL }\n"
                      "  - send: { bytes: 01 17 00 00 00 01 00 01 00 01 02 00 0A +crc, reply: nothing }\n",
                  "test.yaml")
                  .front());
  EXPECT_EQ(counts(report, "functions", "17"), "1 0");
  EXPECT_EQ(counts(report, "functions", "22"), "1 0");
  EXPECT_EQ(counts(report, "functions", "23"), "1 1");
  EXPECT_EQ(counts(report, "registers", "FLAGS"), "1 1 1");
  EXPECT_EQ(counts(report, "registers", "LEVEL"), "0 1 1");
}

TEST(ControllerCoverage, CountsFaultsByMotion) {
  const TouchedReport report =
      touched("  - inject: { stall: feeder.A }\n" + play::kServoOn + play::kExampleMove +
              "  - advance: 500ms\n"
              "  - inject: { stall: feeder.A }\n"
              "  - inject: { drop: feeder, nth: 1 }\n"
              "  - send: { bytes: 01 03 00 00 00 01 +crc, reply: nothing }\n");
  EXPECT_EQ(counts(report, "faults", "stall"), "1 1");
  EXPECT_EQ(counts(report, "faults", "drop"), "0 1");
  EXPECT_EQ(counts(report, "faults", "noise"), "0 0");
}

TEST(ControllerCoverage, CountsInstructionsThatHaveRun) {
  const TouchedReport report =
      touched(play::parse_scenarios(
                  models::all_models(),
                  "understudy: 1\nbench: { lines: { a: { stations: [ { name: m, model: simple2-r3, program: "
                  "\"Out DOUT_1 ON\\nWait_IO DIN_3 ON\\nEND\\n\" } ] } } }\n"
                  "steps:\n  - write: { m.PROG_MAIN_RunTime_START: 0 }\n  - advance: 100ms\n",
                  "test.yaml")
                  .front());
  EXPECT_EQ(counts(report, "instructions", "Out"), "1 - -");
  EXPECT_EQ(counts(report, "instructions", "Wait_IO"), "1 0 1");
  EXPECT_EQ(counts(report, "instructions", "END"), "0 - -");
  EXPECT_EQ(counts(report, "instructions", "NOP"), "0 - -");
}

/// Returns a count by the name of its column.
std::string count_in(const TouchedReport& report, const std::string& table, const std::string& row,
                     const std::string& column) {
  for (const auto& [model, tables] : report.models) {
    for (const TouchedTable& one : tables) {
      if (one.name != table) continue;
      const auto place = std::find(one.columns.begin(), one.columns.end(), column) - one.columns.begin();
      for (const TouchedRow& of : one.rows) {
        if (of.name != row) continue;
        const std::int64_t counted = of.counts.at(static_cast<std::size_t>(place));
        return counted == kCannotBe ? "-" : std::to_string(counted);
      }
    }
  }
  return "none";
}

play::Scenario of_model(const std::string& model, const std::string& program, const std::string& steps) {
  return play::parse_scenarios(
             models::all_models(),
             "understudy: 1\nbench: { lines: { a: { stations: [ { name: m, model: " + model +
                 (program.empty() ? "" : ", program: \"" + program + "\"") + " } ] } } }\nsteps:\n" + steps,
             "test.yaml")
      .front();
}

TEST(ControllerCoverage, CountsTheCellsOfASimple2R3) {
  const TouchedReport report = touched(play::kServoOn + play::kExampleMove +
                                       "  - advance: 200ms\n"
                                       "  - write: { feeder.Aaxis_STOP: 1 }\n"
                                       "  - advance: 10ms\n"
                                       "  - write: { feeder.Aaxis_STOP: 1 }\n"
                                       "  - write: { feeder.Aaxis_DirectmRPM: 60000 }\n"
                                       "  - advance: 100ms\n");
  const std::string table = "reactions of axes";
  EXPECT_EQ(count_in(report, table, "position, standing", "move towards"), "0");
  EXPECT_EQ(count_in(report, table, "position, standing", "move away"), "1");
  EXPECT_EQ(count_in(report, table, "position, moving", "stop"), "1");
  EXPECT_EQ(count_in(report, table, "position, standing", "stop"), "1");
  EXPECT_EQ(count_in(report, table, "position, standing", "velocity away"), "1");
  EXPECT_EQ(count_in(report, table, "velocity, moving", "stop"), "0");
  EXPECT_EQ(count_in(report, table, "position, turning", "stop"), "none") << "a move does not turn";
  EXPECT_EQ(count_in(report, table, "homing, moving", "alarm gone"), "-");
}

TEST(ControllerCoverage, CountsLimitsThatAMoveMeets) {
  // A switch that the machine reaches on its way, and an input that comes on by itself.
  const std::string bench =
      "understudy: 1\nbench:\n"
      "  lines: { a: { stations: [ { name: m, model: simple2-r3, set: { DIN2_Aaxis_UP_Limit: 1 } } ] } }\n"
      "  plant: { m.A: { travel: [-9000, 9000], limits: { lower: -8000, upper: 2000 } } }\n"
      "steps:\n"
      "  - write: { m.Aaxis_SVON: 1 }\n"
      "  - write: { m.Aaxis_Pulse: 5000, m.Aaxis_Speed: 200, m.Aaxis_AccTime: 1, m.Aaxis_DecTime: 1 }\n"
      "  - write: { m.Aaxis_Move_INC: 1 }\n"
      "  - advance: 2s\n";
  const auto counted = [&](const std::string& steps, const std::string& row, const std::string& column) {
    return count_in(touched(play::parse_scenarios(models::all_models(), bench + steps, "test.yaml").front()),
                    "reactions of axes", row, column);
  };
  EXPECT_EQ(counted("", "position, moving", "limit ahead"), "1");
  EXPECT_EQ(counted("", "position, standing", "limit ahead"), "0");
  const std::string back = "  - write: { m.Aaxis_Pulse: -500, m.Aaxis_Move_INC: 1 }\n  - advance: 1s\n";
  EXPECT_EQ(counted(back, "position, leaving", "limit gone"), "1");
  EXPECT_EQ(
      counted(back + "  - input: { m.DIN_2: on }\n  - advance: 10ms\n", "position, standing", "limit ahead"),
      "1");
}

TEST(ControllerCoverage, CountsTheCellsOfASuper40nc) {
  const TouchedReport report =
      touched(of_model("super-40nc", "AREA U\\nVDRV K150\\nTMR K100\\nVDRV K0\\nEND\\nAREA PLC\\nEND\\n",
                       "  - write: { m.M8400: 1 }\n  - advance: 2s\n"));
  const std::string table = "requests for axes";
  EXPECT_EQ(count_in(report, table, "vdrv", "vdrv 0"), "1");
  EXPECT_EQ(count_in(report, table, "vdrv", "stop"), "0");
  EXPECT_NE(count_in(report, table, "nobody", "vdrv"), "0");
  EXPECT_EQ(count_in(report, "errors", "division by zero", "in a step program"), "0");
  const TouchedReport failed =
      touched(of_model("super-40nc", "AREA U\\nDIV K1 K0 D100\\nEND\\nAREA PLC\\nEND\\n",
                       "  - write: { m.M8400: 1 }\n  - advance: 2s\n"));
  EXPECT_EQ(count_in(failed, "errors", "division by zero", "in a step program"), "1");
  EXPECT_EQ(count_in(failed, "errors", "division by zero", "outside step programs"), "0");
}

TEST(ControllerCoverage, CountsTheCellsOfAnRsM8194h) {
  const TouchedReport report = touched(of_model("rs-m8194h", "",
                                                "  - command: { m: RSM_FIXED_MOVE X 100000 }\n"
                                                "  - advance: 50ms\n"
                                                "  - command: { m: RSM_STOP_SLOWLY XY }\n"
                                                "  - advance: 500ms\n"
                                                "  - command: { m: RSM_FIXED_MOVE X 1000 }\n"
                                                "  - advance: 50ms\n"));
  EXPECT_NE(count_in(report, "starts of drives", "idle", "command"), "0");
  EXPECT_NE(count_in(report, "starts of drives", "lock", "command"), "0");
  EXPECT_EQ(count_in(report, "starts of drives", "homing", "command"), "0");
  EXPECT_EQ(count_in(report, "starts of drives", "hold", "external"), "-");
  EXPECT_EQ(count_in(report, "stops of axes", "single", "STOP_SLOWLY"), "1");
  EXPECT_EQ(count_in(report, "stops of axes", "idle", "STOP_SLOWLY"), "1");
  EXPECT_EQ(count_in(report, "stops of axes", "single", "STOP_SUDDENLY"), "0");
  EXPECT_EQ(count_in(report, "errors", "soft stop", "occurred"), "2");
  EXPECT_EQ(count_in(report, "errors", "alarm", "occurred"), "0");
  EXPECT_EQ(count_in(report, "errors", "reserved", "occurred"), "none");
}

TEST(ControllerCoverage, CountsTheCellsOfASlim) {
  const TouchedReport report = touched(of_model("slim", "WT 5000\\nRET\\n",
                                                "  - send: { text: JGF }\n"
                                                "  - send: { text: G }\n"
                                                "  - advance: 100ms\n"
                                                "  - send: { text: REDO }\n"
                                                "  - send: { text: TAPZ }\n"
                                                "  - advance: 500ms\n"
                                                "  - send: { text: TAREDO }\n"
                                                "  - advance: 500ms\n"));
  EXPECT_EQ(count_in(report, "tasks", "jog", "TAPZ"), "1");
  EXPECT_EQ(count_in(report, "tasks", "program waits for time", "TAPZ"), "1");
  EXPECT_EQ(count_in(report, "tasks", "program waits for time", "TAREDO"), "1");
  EXPECT_EQ(count_in(report, "tasks", "jog", "REDO"), "0") << "without a pause it resumes nothing";
  EXPECT_EQ(count_in(report, "tasks", "move", "TAPZ"), "0");
  EXPECT_EQ(count_in(report, "pauses", "no pause", "REDO"), "1");
  EXPECT_EQ(count_in(report, "pauses", "no pause", "TAPZ"), "1");
  EXPECT_EQ(count_in(report, "pauses", "TAPZ", "TAREDO"), "1");
  EXPECT_EQ(count_in(report, "errors", "not allowed", "occurred"), "0");
  EXPECT_EQ(count_in(touched(of_model("slim", "", "  - send: { text: XYZ }\n  - advance: 100ms\n")), "errors",
                     "syntax", "occurred"),
            "1");
}

TEST(ControllerCoverage, CountsChoicesThatTheDeviceHasAskedFor) {
  const TouchedReport none = touched("  - advance: 10ms\n");
  EXPECT_EQ(counts(none, "choices", "aclr_again"), "0");
  EXPECT_EQ(counts(none, "choices", "boot_time"), "") << "it is looked up at power-up, and kept";
  EXPECT_EQ(counts(none, "choices", "exceptions"), "0");
  EXPECT_EQ(counts(none, "choices", "reply_delay"), "") << "it has one option";
  const TouchedReport report = touched(
      "  - write: { feeder.Aaxis_ACLR: 1 }\n"
      "  - advance: 10ms\n"
      "  - write: { feeder.Aaxis_ACLR: 1 }\n"
      "  - send: { bytes: 01 03 7F 00 00 01 +crc, within: 100ms }\n");
  EXPECT_EQ(counts(report, "choices", "aclr_again"), "1");
  EXPECT_EQ(counts(report, "choices", "exceptions"), "1");
}

/// A choice that the device does ask for, and of which coverage says that it never has, would be a gap that
/// no suite can close.
TEST(ControllerCoverage, SeesEachChoiceOfASlim) {
  const TouchedReport report = touched(of_model("slim", "", "  - send: { text: FOO }\n  - advance: 10ms\n"));
  EXPECT_EQ(counts(report, "choices", "error_codes"), "1");
  // These belong to the language's own table.
  EXPECT_EQ(counts(report, "choices", "longest_line"), "1");
  EXPECT_EQ(counts(report, "choices", "call_depth"), "0");
}

TEST(ControllerCoverage, CountsCommandsOfTextAndOfWindows) {
  const TouchedReport slim =
      touched(play::parse_scenarios(
                  models::all_models(),
                  "understudy: 1\nbench: { lines: { a: { stations: [ { name: s, model: slim } ] } } }\n"
                  "steps:\n  - send: { text: MA 100 }\n  - send: { text: T1MA 100 }\n  - advance: 10ms\n",
                  "test.yaml")
                  .front());
  EXPECT_EQ(counts(slim, "commands", "MA"), "1 0");
  EXPECT_EQ(counts(slim, "commands", "TpMA"), "1 0");
  EXPECT_EQ(counts(slim, "commands", "MR"), "0 0");
  const TouchedReport rs =
      touched(play::parse_scenarios(
                  models::all_models(),
                  "understudy: 1\nbench: { lines: { a: { stations: [ { name: r, model: rs-m8194h } ] } } }\n"
                  "steps:\n  - command: { r: RSM_SET_MAX_V XY 16000 }\n  - advance: 10ms\n",
                  "test.yaml")
                  .front());
  EXPECT_EQ(counts(rs, "commands", "RSM_SET_MAX_V"), "1 0");
  EXPECT_EQ(counts(rs, "commands", "RSM_FIXED_MOVE"), "0 0");
  EXPECT_EQ(counts(rs, "commands", "RSM_MACRO_TIMER"), "") << "no host can send it";
  EXPECT_EQ(counts(rs, "instructions", "RSM_SET_MAX_V"), "") << "no macro can have it";
}

TEST(ControllerCoverage, ChangesNothing) {
  const std::string steps = play::kServoOn + play::kExampleMove + "  - advance: 5s\n";
  const auto hash = [&](bool is_counted) {
    play::RunOptions options{.with_hash = true};
    TouchedReport kept;
    if (is_counted)
      options.observers.push_back([&](World& world) { return std::make_unique<Keeper>(world, kept); });
    return play::played(steps, "", options).outcome_hash;
  };
  EXPECT_EQ(hash(true), hash(false));
}

}  // namespace controller_coverage_test
}  // namespace understudy::emulator::world
