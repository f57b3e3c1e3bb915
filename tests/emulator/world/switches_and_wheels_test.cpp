// Switches that open or are wired elsewhere; where a machine begins; hand wheels.
#include <gtest/gtest.h>

#include "emulator/models/models.h"
#include "emulator/world/snapshot.h"
#include "tests/emulator/play/performing/played.h"
#include "tests/emulator/world/bench_file/bench_texts.h"

namespace understudy::emulator::world {
namespace switches_and_wheels_test {

/// Two Simple2-R3s, x and y; the machine on x.A; steps.
std::string text_of(const std::string& machine, const std::string& wires, const std::string& steps) {
  return "understudy: 1\n"
         "name: test\n"
         "bench:\n"
         "  lines: { a: { timing: instant, stations: [ { name: x, model: simple2-r3 }, { name: y, model: "
         "simple2-r3, address: 2 } ] } }\n"
         "  plant: { x.A: { " +
         machine + " } }\n  wires: [ " + wires + " ]\nsteps:\n  - advance: 2ms\n" + steps;
}

void expect_passes(const std::string& text) {
  const play::ScenarioResult result =
      play::run_scenario(play::parse_scenarios(models::all_models(), text, "test.yaml").front(), {}).front();
  EXPECT_TRUE(play::has_passed(result)) << text << play::why(result);
}

std::string diagnostic_of(const std::string& machine, const std::string& wires = "") {
  try {
    play::parse_scenarios(models::all_models(), text_of(machine, wires, "  - advance: 1ms\n"), "test.yaml");
    return "";
  } catch (const FileError& error) {
    const std::string what = without_columns(error.what());
    return what.substr(what.find(": ") + 2);
  }
}

TEST(Switches, ThatOpenAreClosedElsewhere) {
  expect_passes(text_of(
      "home: { at: 10, width: 5, contact: opens }, limits: { lower: -20, upper: 20, contact: opens }", "",
      "  - assert: [ x.DIN_4 == 1, x.DIN_2 == 1, x.DIN_3 == 1, x.A.home == 0 ]\n"
      "  - inject: { slip: x.A, pulses: 12 }\n"
      "  - advance: 2ms\n"
      "  - assert: [ x.DIN_4 == 0, x.DIN_2 == 1, x.DIN_3 == 1, x.A.home == 1 ]\n"
      "  - inject: { slip: x.A, pulses: 12 }\n"
      "  - advance: 2ms\n"
      "  - assert: [ x.DIN_4 == 1, x.DIN_2 == 0, x.DIN_3 == 1, x.A.upper_limit == 1 ]\n"
      "  - inject: { slip: x.A, pulses: -50 }\n"
      "  - advance: 2ms\n"
      "  - assert: [ x.DIN_4 == 1, x.DIN_2 == 1, x.DIN_3 == 0, x.A.lower_limit == 1 ]\n"));
}

TEST(Switches, ThatAMachineDoesNotHaveAreOpen) {
  expect_passes(text_of("limits: { upper: 20, contact: opens }", "",
                        "  - assert: [ x.DIN_2 == 1, x.DIN_3 == 0, x.DIN_4 == 0 ]\n"));
}

TEST(Switches, MayBeWiredToOtherInputs) {
  // DIN_2 is the controller's own upper limit, DIN_5 the alarm of axis B, which has no drive.
  expect_passes(
      text_of("home: { at: 10, width: 5, input: DIN_2 }, limits: { upper: 20, upper_input: DIN_5, lower: "
              "-5, lower_input: DIN_10 }",
              "",
              "  - inject: { slip: x.A, pulses: 12 }\n"
              "  - advance: 3ms\n"
              "  - assert: [ x.DIN_2 == 1, x.DIN_4 == 0, x.DIN_5 == 0, x.DIN_10 == 0 ]\n"
              "  - inject: { slip: x.A, pulses: 20 }\n"
              "  - advance: 3ms\n"
              "  - assert: [ x.DIN_2 == 0, x.DIN_4 == 0, x.DIN_5 == 1, x.DIN_10 == 0 ]\n"
              "  - inject: { slip: x.A, pulses: -60 }\n"
              "  - advance: 3ms\n"
              "  - assert: [ x.DIN_2 == 0, x.DIN_3 == 0, x.DIN_5 == 0, x.DIN_10 == 1 ]\n"));
}

TEST(Switches, MayBeWiredToOtherControllers) {
  expect_passes(text_of(
      "home: { at: 0, width: 5 }, limits: { upper: 20, contact: opens }, drive: { alarm_contact: opens }",
      "x.A.home -> y.DIN_10, x.A.upper_limit -> y.DIN_1, x.A.alarm -> y.DIN_0, x.A.ready -> y.DIN_3, "
      "x.DOUT_4 -> y.DIN_2",
      // On the switch at power-up.
      "  - assert: [ y.DIN_10 == 1, y.DIN_1 == 1, y.DIN_0 == 1, y.DIN_3 == 0 ]\n"
      "  - inject: { slip: x.A, pulses: 30 }\n"
      "  - inject: { alarm: x.A }\n"
      "  - advance: 2ms\n"
      "  - assert: [ y.DIN_10 == 0, y.DIN_1 == 0, y.DIN_0 == 0, y.DIN_2 == 0 ]\n"
      "  - write: { x.DOUT_ALL: 0x10 }\n"
      "  - advance: 2ms\n"
      "  - assert: y.DIN_2 == 1\n"));
}

TEST(Switches, ThatCannotBeWiredSoAreRefused) {
  EXPECT_EQ(
      diagnostic_of("home: { at: 0, width: 5, input: DIN_2 }, limits: { upper: 9 }"),
      "bench.plant.x.A: x.A.upper_limit and x.A.home are both wired to DIN_2; expected one contact on an "
      "input, and `wires` for more");
  EXPECT_EQ(diagnostic_of("home: { at: 0, width: 5, input: DIN_99 }"),
            "bench.plant.x.A.home.input: 'DIN_99' is not an input of simple2-r3; the nearest is 'DIN_9'");
  EXPECT_EQ(diagnostic_of("home: { at: 0, width: 5, contact: closed }"),
            "bench.plant.x.A.home.contact: 'closed' is unknown; expected opens or closes");
  EXPECT_EQ(diagnostic_of("limits: { upper: 3, lower_input: DIN_9 }"),
            "bench.plant.x.A.limits.lower_input: there is no lower limit switch; expected `lower`");
  EXPECT_EQ(diagnostic_of("travel: [ -5, 5 ]", "x.A.home -> y.DIN_1"),
            "bench.wires[0]: the machine on x.A has no home; expected it in `plant`");
  EXPECT_EQ(diagnostic_of("travel: [ -5, 5 ]", "x.A.hom -> y.DIN_1"),
            "bench.wires[0]: 'hom' is not a switch of a machine; the nearest is 'home'");
  EXPECT_EQ(diagnostic_of("travel: [ -5, 5 ]", "x.DOUT_4 -> y.A.home"),
            "bench.wires[0]: 'home' is not an input of a drive; expected one of servo, alarm_clear");
}

TEST(Switches, NearHomeMarkAndIndexAreLevelsToSuchAController) {
  expect_passes(text_of(
      "near_home: { at: 100, width: 50, hysteresis: 5, input: DIN_5 }, mark: { at: 200, width: 1, contact: "
      "opens, input: DIN_6 }, encoder: { per_revolution: 4000, motor_pulses_per_revolution: 1000, index: { "
      "at: "
      "-2, width: 4, input: DIN_10 } }",
      "x.A.near_home -> y.DIN_1, x.A.index -> y.DIN_2",
      "  - assert: [ x.DIN_5 == 0, x.DIN_6 == 1, x.DIN_10 == 1, x.A.index == 1, x.A.mark == 0 ]\n"
      "  - inject: { slip: x.A, pulses: 100 }\n"
      "  - advance: 2ms\n"
      "  - assert: [ x.DIN_5 == 1, y.DIN_1 == 1, y.DIN_2 == 0, x.DIN_10 == 0, x.A.near_home == 1 ]\n"
      "  - inject: { slip: x.A, pulses: 54 }\n"
      "  - advance: 2ms\n"
      "  - assert: x.A.near_home == 1\n"
      "  - inject: { slip: x.A, pulses: 46 }\n"
      "  - advance: 2ms\n"
      "  - assert: [ x.A.near_home == 0, x.A.mark == 1, x.DIN_6 == 0 ]\n"
      "  - inject: { slip: x.A, pulses: 798 }\n"
      "  - advance: 2ms\n"
      "  - assert: [ x.A.index == 1, x.DIN_10 == 1, y.DIN_2 == 1 ]\n"
      "  - inject: { slip: x.A, pulses: 4 }\n"
      "  - advance: 2ms\n"
      "  - assert: [ x.A.index == 0, x.DIN_10 == 0 ]\n"));
}

TEST(Switches, OfTheseKindsThatCannotBeAreRefused) {
  EXPECT_EQ(diagnostic_of("near_home: { width: 5 }"),
            "bench.plant.x.A.near_home: 'at' is missing; expected it here");
  EXPECT_EQ(diagnostic_of("mark: { at: 5, width: 0 }"),
            "bench.plant.x.A.mark.width: '0' is not valid; expected a whole number from 1 to 1000000000000");
  EXPECT_EQ(diagnostic_of("mark: { at: 5, width: 1, input: DOUT_1 }").substr(0, 45),
            "bench.plant.x.A.mark.input: 'DOUT_1' is not a");
  EXPECT_EQ(
      diagnostic_of("encoder: { per_revolution: 400, index: { width: 50, period: 50 } }"),
      "bench.plant.x.A.encoder.index.width: is on for 50 of 50 positions; expected fewer than its period");
  EXPECT_EQ(diagnostic_of("encoder: { per_revolution: 400, on: wheel, index: { width: 5 } }"),
            "bench.plant.x.A.encoder.index: is on a hand wheel; expected an encoder on the machine");
  EXPECT_EQ(diagnostic_of("travel: [ -5, 5 ]", "x.A.mark -> y.DIN_1"),
            "bench.wires[0]: the machine on x.A has no mark; expected it in `plant`");
  EXPECT_EQ(
      diagnostic_of("mark: { at: 5, width: 1, input: DIN_9 }, near_home: { at: 5, width: 1, input: DIN_9 }"),
      "bench.plant.x.A: x.A.mark and x.A.near_home are both wired to DIN_9; expected one contact on an "
      "input, and `wires` for more");
}

TEST(Machines, BeginWhereTheyAreSaidToStand) {
  expect_passes(text_of(
      "position: 500, travel: [ 100, 1000 ], home: { at: 480, width: 50 }, encoder: { per_revolution: "
      "4000, motor_pulses_per_revolution: 1000 }",
      "",
      "  - assert: [ x.A.position == 500, x.DIN_4 == 1, x.A.encoder == 0, x.A.pulses == 0 ]\n"
      "  - expect: { x.Cord_A: 0, x.ENCA: 0 }\n"
      "  - inject: { slip: x.A, pulses: 100 }\n"
      "  - advance: 2ms\n"
      "  - assert: [ x.A.position == 600, x.DIN_4 == 0, x.A.encoder == 400 ]\n"
      "  - inject: { slip: x.A, pulses: -900 }\n"
      "  - advance: 2ms\n"
      "  - assert: [ x.A.position == 100, x.A.encoder == -1600 ]\n"));
  EXPECT_EQ(diagnostic_of("position: 500, travel: [ -5, 5 ]"),
            "bench.plant.x.A.travel: does not include position 500, where the machine starts; expected a "
            "range with this position");
}

TEST(HandWheels, AreTurnedByHandAlone) {
  expect_passes(text_of("encoder: { per_revolution: 400, on: wheel }", "",
                        "  - inject: { slip: x.A, pulses: 100 }\n"
                        "  - advance: 2ms\n"
                        "  - assert: [ x.A.position == 100, x.A.encoder == 0 ]\n"
                        "  - inject: { turn: x.A, counts: 7, in: 3ms }\n"
                        "  - advance: 1ms\n"
                        "  - assert: x.A.encoder == 2\n"
                        "  - advance: 1ms\n"
                        "  - assert: x.A.encoder == 4\n"
                        "  - advance: 5ms\n"
                        "  - assert: [ x.A.encoder == 7, x.A.position == 100 ]\n"
                        // Fewer counts than ticks are spread over all of them.
                        "  - inject: { turn: x.A, counts: 5, in: 1s }\n"
                        "  - advance: 500ms\n"
                        "  - assert: x.A.encoder == 9\n"
                        "  - advance: 499ms\n"
                        "  - assert: x.A.encoder == 11\n"
                        // A turn that starts during another one is added to it.
                        "  - inject: { turn: x.A, counts: -5, in: 4ms }\n"
                        "  - advance: 2ms\n"
                        "  - assert: x.A.encoder == 9\n"
                        "  - advance: 2ms\n"
                        "  - assert: x.A.encoder == 7\n"
                        "  - inject: { turn: x.A, counts: -1000000 }\n"
                        "  - advance: 1ms\n"
                        "  - assert: x.A.encoder == -999993\n"
                        // In the middle of a turn, the state is complete.
                        "  - inject: { turn: x.A, counts: 1000, in: 100ms }\n"
                        "  - advance: 50ms\n"
                        "  - snapshot: half\n"
                        "  - advance: 100ms\n"
                        "  - assert: x.A.encoder == -998993\n"
                        "  - restore: half\n"
                        "  - assert: x.A.encoder == -999493\n"
                        "  - advance: 100ms\n"
                        "  - assert: x.A.encoder == -998993\n"));
  expect_passes(text_of("encoder: { per_revolution: 400, on: wheel, reversed: true }", "",
                        "  - inject: { turn: x.A, counts: 5 }\n"
                        "  - advance: 1ms\n"
                        "  - assert: x.A.encoder == -5\n"
                        "  - inject: { turn: x.A, counts: 20, when: x.DIN_10 == 1, name: later }\n"
                        "  - advance: 5ms\n"
                        "  - assert: x.A.encoder == -5\n"
                        "  - input: { x.DIN_10: on }\n"
                        "  - advance: 5ms\n"
                        "  - assert: x.A.encoder == -25\n"));
}

TEST(HandWheels, ThatAreNotThereAreNotTurned) {
  const std::string text =
      text_of("encoder: { per_revolution: 400 }", "", "  - inject: { turn: x.A, counts: 7 }\n");
  try {
    play::parse_scenarios(models::all_models(), text, "test.yaml");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_NE(
        std::string(error.what()).find("x.A has no hand wheel; expected `encoder: { on: wheel }` in `plant`"),
        std::string::npos)
        << error.what();
  }
}

}  // namespace switches_and_wheels_test
}  // namespace understudy::emulator::world
