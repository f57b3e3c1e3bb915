// Each kind of step: its text and its effect.
#include <gtest/gtest.h>

#include "tests/emulator/play/performing/scenario_folder.h"

namespace understudy::emulator::play {
namespace scenario_steps_test {

using namespace std::chrono_literals;
using Strings = std::vector<std::string>;
using Bytes = std::vector<std::uint8_t>;

class ScenarioSteps : public testing::Test {
 protected:
  /// The only step of a scenario of one.
  template <typename What>
  What only(const std::string& step) const {
    const Steps steps = folder_.steps("  - " + step + "\n");
    EXPECT_EQ(steps.size(), 1U) << step;
    const What* const what = std::get_if<What>(&steps.front().what);
    if (what == nullptr) ADD_FAILURE() << step << " is a different kind of step";
    return what == nullptr ? What{} : *what;
  }
  Strings texts(const std::string& steps) const { return texts_of(folder_.steps(steps)); }

  ScenarioFolder folder_;
};

TEST_F(ScenarioSteps, WriteKeepsTheOrderWritten) {
  const auto write = only<WriteStep>("write: { turner.Baxis_Speed: 200, feeder.Aaxis_SVON: on }");
  ASSERT_EQ(write.entries.size(), 2U);
  EXPECT_EQ(write.entries[0].target.device, 1U);
  EXPECT_EQ(write.entries[0].target.name, "turner.Baxis_Speed");
  EXPECT_EQ(write.entries[0].value, "200");
  EXPECT_EQ(write.entries[1].target.device, 0U);
  ASSERT_TRUE(write.entries[1].target.place);
  EXPECT_EQ(write.entries[1].target.place->place.address(), 0x1014);  // Aaxis_SVON
  EXPECT_EQ(write.answer.exception, std::nullopt);
}

TEST_F(ScenarioSteps, TargetsAreNamesHalvesBitsAndNumbers) {
  struct Row {
    std::string written;
    int address;
    int bit;
    bool is_named;
  };
  // STATUS is a 16-bit register; the manual's Aaxis_Pulse_H is the second word of Aaxis_Pulse.
  const Row rows[] = {{"feeder.Aaxis_SVON", 0x1014, -1, true},
                      {"feeder.0x1014", 0x1014, -1, false},
                      {"turner.4116", 4116, -1, false},
                      {"feeder.DOUT_ALL.3", -1, 3, true},
                      {"'feeder[\"Aaxis_SVON\"]'", 0x1014, -1, true}};
  for (const Row& row : rows) {
    const auto write = only<WriteStep>("write: { " + row.written + ": 1 }");
    const Target& target = write.entries.at(0).target;
    EXPECT_EQ(target.place.has_value(), row.is_named) << row.written;
    EXPECT_EQ(target.device, row.written.starts_with("turner") ? 1U : 0U) << row.written;
    if (!row.is_named) {
      EXPECT_EQ(target.address, row.address) << row.written;
      continue;
    }
    EXPECT_EQ(target.place->bit, row.bit) << row.written;
    if (row.address >= 0) {
      EXPECT_EQ(target.place->place.address(), row.address) << row.written;
    }
  }
}

TEST_F(ScenarioSteps, WriteTakesWhatADeviceRefusesWhereThatIsMeant) {
  // The maximum of Aaxis_AccTime is 3000, and HW_Code is read-only.
  EXPECT_EQ(only<WriteStep>("write: { feeder.Aaxis_AccTime: 3001 }\n    exception: 3").answer.exception, 3);
  EXPECT_EQ(only<WriteStep>("write: { feeder.HW_Code: 1 }\n    exception: 2").answer.exception, 2);
  EXPECT_EQ(only<WriteStep>("write: { feeder.Aaxis_AccTime: 3000 }").entries.at(0).value, "3000");
}

TEST_F(ScenarioSteps, ExpectTakesTolerances) {
  const auto expect =
      only<ExpectStep>("expect: { feeder.Cord_A: 32000 +- 1%, feeder.STATUS.4: off, turner.Cord_B: ..-5 }");
  ASSERT_EQ(expect.entries.size(), 3U);
  // 1% of 32000 is 320.
  EXPECT_EQ(expect.entries[0].value.low, world::Number(31680));
  EXPECT_EQ(expect.entries[0].value.high, world::Number(32320));
  EXPECT_EQ(expect.entries[1].value.high, world::Number(0));
  EXPECT_EQ(expect.entries[2].value.low, std::nullopt);
  EXPECT_EQ(expect.entries[2].value.high, world::Number(-5));
}

TEST_F(ScenarioSteps, WaitHasItsTimes) {
  const auto wait = only<WaitStep>(
      "wait: { until: feeder.STATUS.4 == 0 and turner.Cord_A > 5, within: 4s, takes: 3050ms +- 2ms, poll: "
      "20ms }");
  EXPECT_EQ(wait.until, "feeder.STATUS.4 == 0 and turner.Cord_A > 5");
  EXPECT_EQ(wait.within, 4s);
  ASSERT_TRUE(wait.takes);
  EXPECT_EQ(wait.takes->low, world::Number(std::int64_t{3'048'000'000}));
  EXPECT_EQ(wait.takes->high, world::Number(std::int64_t{3'052'000'000}));
  EXPECT_EQ(wait.poll, SimTime(20ms));
  const auto plain = only<WaitStep>("wait: { until: time >= 1s, within: 2s }");
  EXPECT_FALSE(plain.takes || plain.poll);
}

TEST_F(ScenarioSteps, ConditionsMaySpanLines) {
  EXPECT_EQ(texts("  - assert: >\n      feeder.STATUS.4 == 0 and\n      feeder.Cord_A == 0\n"),
            Strings{"assert feeder.STATUS.4 == 0 and feeder.Cord_A == 0 "});
}

TEST_F(ScenarioSteps, AssertTakesOneOrMany) {
  EXPECT_EQ(only<AssertStep>("assert: feeder.A.pulses == 0").expressions, Strings{"feeder.A.pulses == 0"});
  EXPECT_EQ(only<AssertStep>("assert: [ 1 + 1 == 2, feeder.power ]").expressions,
            (Strings{"1 + 1 == 2", "feeder.power"}));
}

TEST_F(ScenarioSteps, SpansAreNamedByTheirConditions) {
  const auto never = only<SpanStep>("never: feeder.A.pulses != 0");
  EXPECT_TRUE(never.never);
  EXPECT_EQ(never.name, "feeder.A.pulses != 0");
  const auto always = only<SpanStep>("always: { what: feeder.power, name: lively }");
  EXPECT_FALSE(always.never);
  EXPECT_EQ(always.expression, "feeder.power");
  EXPECT_EQ(always.name, "lively");
  EXPECT_EQ(texts("  - never: feeder.DOUT_0\n  - end: feeder.DOUT_0\n  - always: feeder.DOUT_0\n"),
            (Strings{"never feeder.DOUT_0", "end feeder.DOUT_0", "always feeder.DOUT_0"}));
}

TEST_F(ScenarioSteps, SendReadsBytesAndTheirChecksum) {
  // The manual's first example: 01 03 00 01 00 01 D5 CA.
  const Bytes request{0x01, 0x03, 0x00, 0x01, 0x00, 0x01, 0xD5, 0xCA};
  for (const char* bytes :
       {"01 03 00 01 00 01 D5 CA", "010300010001d5ca", "01 03 00 01 00 01 +crc", "0103 0001 0001 +crc"}) {
    EXPECT_EQ(only<SendStep>("send: { bytes: " + std::string(bytes) + " }").bytes, request) << bytes;
  }
  const auto whatever = only<SendStep>("send: { line: rs485, bytes: FF }");
  EXPECT_FALSE(whatever.reply);
  EXPECT_EQ(whatever.within, 500ms);
  EXPECT_EQ(only<SendStep>("send: { bytes: FF, reply: nothing }").reply, Bytes{});
  EXPECT_EQ(only<SendStep>("send: { bytes: FF, reply: 01 02, within: 20ms }").reply, (Bytes{1, 2}));
}

TEST_F(ScenarioSteps, InputsFaultsAndPower) {
  const auto input = only<InputStep>("input: { feeder.DIN_10: on, turner.AIN_A: 2.5V }");
  ASSERT_EQ(input.inputs.size(), 2U);
  EXPECT_EQ(input.inputs[0].level, 1);
  EXPECT_EQ(input.inputs[1].device, 1U);
  EXPECT_EQ(input.inputs[1].level, 2500);  // millivolts
  const auto inject = only<InjectStep>("inject: { name: jam, lost_steps: turner.B, one_in: 50 }");
  EXPECT_EQ(inject.fault,
            (world::Fault{.kind = world::Fault::Kind::lost_steps, .device = 1, .place = 1, .amount = 50}));
  EXPECT_EQ(inject.name, "jam");
  EXPECT_EQ(only<InjectStep>("inject: { stall: feeder.A }").name, "stall feeder.A");
  const auto power = only<PowerStep>("power: { turner: off, feeder: cycle }");
  EXPECT_EQ(power.devices, (std::vector<std::pair<std::size_t, PowerStep::To>>{{1, PowerStep::To::off},
                                                                               {0, PowerStep::To::cycle}}));
}

TEST_F(ScenarioSteps, FaultsAreClearedByNameTextOrAll) {
  EXPECT_EQ(texts("  - inject: { stall: feeder.A }\n"
                  "  - inject: { alarm: feeder.B, name: red }\n"
                  "  - clear: stall feeder.A\n"
                  "  - inject: { stall: turner.A }\n"
                  "  - clear: red\n"
                  "  - clear: all\n"),
            (Strings{"inject stall feeder.A", "inject alarm feeder.B as red", "clear stall feeder.A",
                     "inject stall turner.A", "clear red", "clear all"}));
}

TEST_F(ScenarioSteps, FaultsOfTheBenchCanBeCleared) {
  folder_.write("broken.yaml", kTwoStations + "faults: [ { stall: turner.B } ]\n");
  const auto scenarios =
      folder_.parse("understudy: 1\nbench: broken.yaml\nsteps:\n  - clear: stall turner.B\n");
  EXPECT_EQ(std::get<ClearStep>(scenarios.at(0).steps.at(0).what).name, "stall turner.B");
}

TEST_F(ScenarioSteps, ProgramsAndMemoriesAreFiles) {
  const auto program = only<ProgramStep>("program: { turner: indexing.lst }");
  EXPECT_EQ(program.device, 1U);
  EXPECT_EQ(program.text, "        SVON_A\n        END\n");
  EXPECT_EQ(program.file, folder_.path("indexing.lst"));
  EXPECT_EQ(only<ProgramStep>("program:\n      feeder: |\n        SVON_A\n        END\n").text,
            "SVON_A\nEND\n");
  const auto memory = only<MemoryStep>("memory: { feeder: after.json }");
  EXPECT_EQ(memory.what, MemoryStep::What::expect);
  EXPECT_EQ(memory.file, folder_.path("after.json"));
  // A file that an earlier step has saved exists by then.
  EXPECT_EQ(texts("  - save: { feeder: new.json }\n  - memory: { turner: ./new.json }\n"),
            (Strings{"save feeder new.json", "memory turner ./new.json"}));
}

TEST_F(ScenarioSteps, ForksContinueFromOneState) {
  const Steps steps = folder_.steps(
      "  - inject: { stall: feeder.A, name: jam }\n"
      "  - snapshot: before\n"
      "  - fork:\n"
      "      one: [ { clear: jam }, { snapshot: inner }, { restore: inner } ]\n"
      "      two: [ { clear: jam }, { advance: 5ms } ]\n"
      "  - clear: jam\n"
      "  - restore: before\n"
      "  - clear: jam\n");
  EXPECT_EQ(texts_of(steps),
            (Strings{"inject stall feeder.A as jam", "snapshot before", "fork one, two", "one: clear jam",
                     "one: snapshot inner", "one: restore inner", "two: clear jam", "two: advance 5ms",
                     "clear jam", "restore before", "clear jam"}));
}

TEST_F(ScenarioSteps, KnowWhereTheyStand) {
  const Steps steps = folder_.steps("  - advance: 1ms\n\n  - include: homing.yaml\n  - reset: peaks\n");
  ASSERT_EQ(steps.size(), 4U);
  EXPECT_EQ(steps[0].line, 4);
  EXPECT_EQ(steps[0].file, folder_.path("scenario.yaml"));
  EXPECT_EQ(steps[2].line, 4);
  EXPECT_EQ(steps[2].file, folder_.path("homing.yaml"));
  EXPECT_EQ(steps[3].line, 7);
}

}  // namespace scenario_steps_test
}  // namespace understudy::emulator::play
