// The parts of a device that steps, hosts and faults exercise, counted in the rows of its tables.
#include "emulator/world/coverage/controller_coverage.h"

#include <memory>

#include "emulator/world/coverage/touched.h"
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
