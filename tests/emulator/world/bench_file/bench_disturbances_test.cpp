// Drives, switches, memories, programs, inputs and faults in bench files: right and wrong.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "emulator/models/models.h"
#include "emulator/world/bench/bench_text.h"
#include "emulator/world/world.h"
#include "tests/emulator/world/bench_file/bench_texts.h"

namespace understudy::emulator::world {
namespace bench_disturbances_test {

TEST(BenchFile, MachinesHaveHysteresisAReversedEncoderAndADrive) {
  const Bench bench = parse(kDisturbedBench);
  ASSERT_EQ(bench.machines.size(), 2u);
  const PlantSetup& a = bench.machines[0].plant;
  ASSERT_TRUE(a.home && a.drive);
  EXPECT_EQ(a.home->first, -10);
  EXPECT_EQ(a.home->last, -6);
  EXPECT_EQ(a.home_hysteresis_pulses, 3);
  EXPECT_EQ(a.limit_hysteresis_pulses, 12);
  EXPECT_TRUE(a.encoder_reversed);
  EXPECT_EQ(a.drive->ready_after, 120);
  EXPECT_FALSE(a.drive->enabled_by);
  EXPECT_TRUE(a.drive->alarm_opens);
  const PlantSetup& b = bench.machines[1].plant;
  ASSERT_TRUE(b.drive) << "an empty one counts";
  EXPECT_EQ(b.drive->ready_after, 0);
  EXPECT_TRUE(b.drive->enabled_by);
  EXPECT_FALSE(b.drive->alarm_opens);
  EXPECT_FALSE(b.encoder_reversed);
  EXPECT_FALSE(parse(kFullBench).machines[0].plant.drive);
  EXPECT_EQ(parse(kFullBench).machines[0].plant.home_hysteresis_pulses, 0);
}

TEST(BenchFile, DevicesHaveTheirSwitchesAndTheFileOfTheirMemory) {
  const Bench bench = parse(kDisturbedBench);
  const auto device = [&](std::size_t station) {
    return bench.devices[bench.lines[0].stations[station].device];
  };
  EXPECT_EQ(device(0).settings.dip, (std::map<std::string, bool>{{"DIP2", true}}));
  EXPECT_EQ(device(0).nv_path, "/benches/memory/feeder.json");
  EXPECT_EQ(device(1).settings.dip, (std::map<std::string, bool>{{"DIP1", false}, {"DIP2", false}}));
  EXPECT_EQ(device(1).nv_path, "");
}

TEST(BenchFile, InputsHaveLevelsInTheirUnits) {
  const Bench bench = parse(kDisturbedBench);
  std::map<std::string, std::int32_t> levels;
  for (const InputSetup& input : bench.inputs) {
    const DeviceSetup& device = bench.devices[input.device];
    const auto terminal = static_cast<std::size_t>(input.terminal);
    levels[device.settings.name + "." + std::string(device.model->terminals[terminal].name)] = input.level;
  }
  EXPECT_EQ(levels, (std::map<std::string, std::int32_t>{{"feeder.DIN_10", 1},
                                                         {"turner.DIN_1", 0},
                                                         {"feeder.AIN_A", 2500},
                                                         {"turner.AIN_B", 9999},
                                                         {"turner.DIP2", 1}}));
}

TEST(BenchFile, FaultsAreThereInTheOrderWritten) {
  const Bench bench = parse(kDisturbedBench);
  KnownDevices known;
  for (const DeviceSetup& device : bench.devices) known.push_back({device.settings.name, device.model, 152});
  std::vector<std::string> faults;
  for (const Fault& fault : bench.faults) faults.push_back(to_text(known, fault));
  EXPECT_EQ(faults, (std::vector<std::string>{"stall feeder.A", "lost_steps turner.B one_in=50",
                                              "slip turner.A pulses=-200", "alarm feeder.A",
                                              "stuck feeder.DIN_2 level=0"}));
}

/// A file with one device x in line 4, and the rest from line 5 on.
std::string and_then(const std::string& more, const std::string& of_x = "") {
  return "understudy: 1\nlines:\n  a:\n    stations: [ { name: x, model: simple2-r3" +
         (of_x.empty() ? "" : ", " + of_x) + " } ]\n" + more;
}

struct Bad {
  std::string text;
  std::string diagnostic;  // after "bench.yaml:"
};

void expect_diagnostics(const std::vector<Bad>& files) {
  for (const Bad& file : files)
    EXPECT_EQ(diagnostic(file.text), "bench.yaml:" + file.diagnostic) << file.text;
}

/// RS-M8194H has no setting for pulses per revolution: the bench needs one if its motor turns the encoder.
TEST(BenchErrors, AnEncoderKnowsTheMotorThatTurnsIt) {
  const auto with_encoder = [](const std::string& what) {
    return "understudy: 1\nlines: { a: { stations: [ { name: x, model: rs-m8194h } ] } }\nplant:\n  x.X: { "
           "encoder: { " +
           what + " } }\n";
  };
  const std::string unknown =
      "4: plant.x.X.encoder: needs the pulses per revolution of the motor; expected "
      "`motor_pulses_per_revolution`";
  expect_diagnostics({{with_encoder("per_revolution: 4000"), unknown},
                      {with_encoder("per_revolution: 4000, index: { at: 40 }"), unknown},
                      {with_encoder("per_revolution: 4000, index: { at: 40, period: 100 }"), unknown}});
  for (const char* what : {"per_revolution: 4000, on: wheel",
                           "per_revolution: 4000, motor_pulses_per_revolution: 200, index: { at: 40 }"}) {
    const Bench bench = parse(to_text(parse(with_encoder(what))));
    World world(bench, {}, {});
    world.advance_to(std::chrono::milliseconds(5));
    EXPECT_EQ(world.plant(0, 0).encoder_counts(), 0) << what;
  }
}

TEST(BenchErrors, DrivesEncodersAndHysteresis) {
  const auto machine = [](const std::string& text) { return and_then("plant:\n  x.A: { " + text + " }\n"); };
  const std::string at = "6: plant.x.A.";
  const std::string no_time = "' is not a duration of whole milliseconds; expected one such as 120ms";
  expect_diagnostics({
      {machine("drive: { ready: 5ms }"), at + "drive.ready: is not a key here; expected one of ready_after, "
                                              "enabled_by, alarm_contact (the nearest "
                                              "is 'ready_after')"},
      {machine("drive: yes"), at + "drive: expected a map, as in `key: value`"},
      {machine("drive: { ready_after: 120 }"), at + "drive.ready_after: '120" + no_time},
      {machine("drive: { ready_after: -1ms }"), at + "drive.ready_after: '-1ms" + no_time},
      {machine("drive: { ready_after: 1.5ms }"), at + "drive.ready_after: '1.5ms" + no_time},
      {machine("drive: { ready_after: 500us }"), at + "drive.ready_after: '500us" + no_time},
      {machine("drive: { ready_after: [ 1ms ] }"), at + "drive.ready_after: expected a word or a number"},
      {machine("drive: { enabled_by: high }"),
       at + "drive.enabled_by: 'high' is unknown; expected on or off"},
      {machine("drive: { enabled_by: 1 }"), at + "drive.enabled_by: '1' is unknown; expected on or off"},
      {machine("drive: { alarm_contact: open }"),
       at + "drive.alarm_contact: 'open' is unknown; expected opens or closes"},
      {machine("encoder: { per_revolution: 4, reversed: yes }"),
       at + "encoder.reversed: 'yes' is unknown; expected true or false"},
      {machine("encoder: { reversed: true }"), at + "encoder: 'per_revolution' is missing; expected it here"},
      {machine("encoder: { per_revolution: 4, motor_pulses_per_revolution: 0 }"),
       at + "encoder.motor_pulses_per_revolution: '0' is not valid; expected a whole number from 1 to "
            "10000000"},
      {machine("home: { at: 0, width: 5, hysteresis: -1 }"),
       at + "home.hysteresis: '-1' is not valid; expected a whole number from 0 to 1000000000000"},
      {machine("limits: { hysteresis: 1.5 }"),
       at + "limits.hysteresis: '1.5' is not valid; expected a whole number from 0 to 1000000000000"},
      {machine("home: { at: 0, width: 5, hysteresis: 1, hysteresis: 2 }"),
       at + "home.hysteresis: is given twice; expected it only once"},
  });
  EXPECT_EQ(diagnostic(machine("drive: { ready_after: 1.5s }")), "");
  EXPECT_EQ(parse(machine("drive: { ready_after: 1.5s }")).machines[0].plant.drive->ready_after, 1500);
}

TEST(BenchErrors, SwitchesOnTheHousing) {
  const std::string at = "4: lines.a.stations[0]";
  expect_diagnostics({
      {and_then("", "dip: { DIP3: on }"),
       at + ".dip.DIP3: 'DIP3' is not a switch of simple2-r3; the nearest is 'DIP1'"},
      {and_then("", "dip: { DIN_1: on }"),
       at + ".dip.DIN_1: 'DIN_1' is not a switch of simple2-r3; expected one of DIP1, DIP2"},
      {and_then("", "dip: { DIP1: maybe }"),
       at + ".dip.DIP1: 'maybe' is neither on nor off; expected on or off"},
      {and_then("", "dip: { DIP1: 2 }"), at + ".dip.DIP1: '2' is neither on nor off; expected on or off"},
      {and_then("", "dip: [ DIP1 ]"), at + ".dip: expected a map, as in `key: value`"},
      {and_then("", "dip: { DIP1: on, DIP1: off }"), at + ".dip.DIP1: is given twice; expected it only once"},
      {"understudy: 1\nlines:\n  a: { baud: 19200, stations: [ { name: x, model: simple2-r3, dip: { DIP1: on "
       "} } ] }\n",
       "3: lines.a.stations[0].dip: the switches select 115200 baud, but the line has 19200; expected the "
       "same"},
  });
}

TEST(BenchErrors, MemoriesAndPrograms) {
  const std::string at = "4: lines.a.stations[0]";
  expect_diagnostics({
      {and_then("", "nv: ''"), at + ".nv: is empty; expected a path"},
      {and_then("", "nv: [ a ]"), at + ".nv: expected a word or a number"},
      {and_then("  b: { stations: [ { name: y, model: simple2-r3, nv: sub/../m.json } ] }\n", "nv: m.json"),
       "5: lines.b.stations[0].nv: device 'x' has the same file; expected another file"},
      {and_then("", "program: ''"), at + ".program: is empty; expected a path"},
      {and_then("", "program: nowhere.lst"),
       at + ".program: /benches/nowhere.lst cannot be read (No such file or directory); expected a listing"},
  });
}

TEST(BenchFile, AProgramIsAListingBesideIt) {
  std::string folder = "/tmp/bench-program-XXXXXX";
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  const auto read = [&](const std::string& listing) {
    std::ofstream(folder + "/pick.lst") << listing;
    return parse_bench(models::all_models(), and_then("", "program: pick.lst"), "bench.yaml", folder);
  };
  const Bench bench = read("Delay_mSec 5\n");
  EXPECT_EQ(bench.devices[0].settings.program, "Delay_mSec 5\n");
  EXPECT_EQ(bench.devices[0].settings.program_name, folder + "/pick.lst");
  try {
    read("NOP\n  Dellay_mSec 5\n");
    ADD_FAILURE() << "there is no such instruction";
  } catch (const BenchError& error) {
    // The diagnostic is about the listing, where an editor finds it.
    EXPECT_EQ(error.what(), folder +
                                "/pick.lst:2:3: mnemonic: no instruction is called 'Dellay_mSec'; expected "
                                "an instruction (nearest: 'Delay_mSec')");
  }
  std::filesystem::remove_all(folder);
}

TEST(BenchErrors, Inputs) {
  const auto inputs = [](const std::string& text) { return and_then("inputs: { " + text + " }\n"); };
  const std::string at = "5: inputs.";
  expect_diagnostics({
      {and_then("inputs: [ x.DIN_1 ]\n"), "5: inputs: expected a map, as in `key: value`"},
      {inputs("x.DIN_1: high"), at + "x.DIN_1: 'high' is not a level; expected on or off"},
      {inputs("x.DIN_1: 2"), at + "x.DIN_1: x.DIN_1: 2 is not a level; expected 0 or 1"},
      {inputs("x.DIN_1: 2.5V"), at + "x.DIN_1: '2.5V' is not a level; expected on or off"},
      {inputs("x.DIN_1: { on: 1 }"), at + "x.DIN_1: expected a word or a number"},
      {inputs("x.AIN_A: 2.5"), at + "x.AIN_A: '2.5' is not a level; expected a voltage such as 2.5V"},
      {inputs("x.AIN_A: 12001"),
       at + "x.AIN_A: x.AIN_A: 12001 is not a level; expected 0 to 12000 millivolts"},
      {inputs("x.AIN_A: -1mV"), at + "x.AIN_A: x.AIN_A: -1 is not a level; expected 0 to 12000 millivolts"},
      {inputs("x.AIN_A: 13V"), at + "x.AIN_A: x.AIN_A: 13000 is not a level; expected 0 to 12000 millivolts"},
      {inputs("x.DIN_11: on"), at + "x.DIN_11: no input of x is called 'DIN_11'; the nearest is 'DIN_1'"},
      {inputs("x.DOUT_1: on"),
       at + "x.DOUT_1: no input of x is called 'DOUT_1'; expected one such as 'DIN_0'"},
      {inputs("x.DIN_1: on, x.DIN_1: off"), at + "x.DIN_1: is given twice; expected it only once"},
  });
  EXPECT_EQ(diagnostic(inputs("x.AIN_A: 12V, x.AIN_B: 12000mV, DIN_1: on")), "");
}

TEST(BenchErrors, Faults) {
  const auto fault = [](const std::string& text) { return and_then("faults:\n  - { " + text + " }\n"); };
  const std::string at = "6: faults[0]: ";
  expect_diagnostics({
      {and_then("faults: { stall: x.A }\n"), "5: faults: expected a list, as in `[ a, b ]`"},
      {and_then("faults: [ stall ]\n"), "5: faults[0]: expected a map, as in `key: value`"},
      {fault(""), at + "is empty; expected a fault, as in `{ stall: feeder.A }`"},
      {fault("jam: x.A"), at + "'jam' is not a fault; expected one such as 'stall'"},
      {fault("'': x.A, stall: x.A"), at + "'' is not a fault; expected one such as 'stall'"},
      {fault("'': x.A"), at + "'' is not a fault; expected one such as 'stall'"},
      {fault("stall: x.C"), at + "no axis of x is called 'C'; expected one of A, B"},
      {fault("stall: [ x.A ]"), "6: faults[0].stall: expected a word or a number"},
      {fault("stall: x.A, one_in: 5"),
       "6: faults[0].one_in: is not a field here; expected one such as 'nth'"},
      {fault("one_in: 5, lost_steps: x.A"), at + "'one_in' is not a fault; expected one such as 'stall'"},
      {fault("lost_steps: x.A"), at + "lost_steps: one_in is missing; expected 1 to 1000000000000"},
      {fault("lost_steps: x.A, one_in: 0"),
       "6: faults[0].one_in: 0 is out of range; expected 1 to 1000000000000"},
      {fault("lost_steps: x.A, one_in: on"),
       "6: faults[0].one_in: 'on' is not valid; expected a whole number"},
      {fault("lost_steps: x.A, one_in: 99999999999999999999"),
       "6: faults[0].one_in: '99999999999999999999' is not valid; expected a whole number"},
      {fault("stall: x.A, stall: x.B"), "6: faults[0].stall: is given twice; expected it only once"},
      {fault("stuck: x.DIN_1"), at + "stuck: level is missing; expected on or off"},
      {fault("stuck: x.DIN_1, level: high"), "6: faults[0].level: 'high' is not valid; expected on or off"},
      {fault("stuck: x.DIN_1, level: 2"), "6: faults[0].level: 2 is out of range; expected 0 to 1"},
      {fault("drop: x, nht: 3"), "6: faults[0].nht: is not a field here; the nearest is 'nth'"},
      {fault("drop: x, nth: 0"), "6: faults[0].nth: 0 is out of range; expected 1 to 1000000000000"},
      {fault("drop: y, nth: 3"), at + "no device is called 'y'; expected 'x'"},
      {fault("drop: x, when: x.A.puls > 5"),
       "6: faults[0].when: column 1 of 'x.A.puls > 5': axis A has no 'puls'; the nearest is 'pulses'"},
      {fault("drop: x, when: time"), "6: faults[0].when: 'time' is a duration; expected a condition"},
      {fault("drop: x, when: x.A.greatest_speed > 5"),
       "6: faults[0].when: 'x.A.greatest_speed' cannot be used in a fault; expected a value that the bench "
       "itself has"},
      {fault("drop: x, address: Aaxis_Sped"),
       "6: faults[0].address: x: no register is called 'Aaxis_Sped'; the nearest is 'Aaxis_Speed'"},
      {fault("encoder_noise: x.A, counts: 4"), at + "x.A has no encoder; expected one in `plant`"},
      {fault("noise: x"), at + "noise: before and after are missing; expected at least one of them"},
      {and_then("seed: -1\n"),
       "5: seed: '-1' is not valid; expected a whole number from 0 to 9223372036854775807"},
      {and_then("seed: now\n"),
       "5: seed: 'now' is not valid; expected a whole number from 0 to 9223372036854775807"},
      {fault("stuck: x.AIN_A, level: 1"), at + "'x.AIN_A' cannot be stuck; expected a digital input"},
  });
  EXPECT_EQ(diagnostic(fault("stuck: DIN_1, level: true")), "") << "one device needs no name";
}

TEST(BenchErrors, OfDisturbancesAreOneLineToo) {
  for (const std::string& text :
       {and_then("inputs: { \"x.DI\\nN_1\": on }\n"), and_then("inputs: { x.DIN_1: \"o\\nn\" }\n"),
        and_then("faults: [ { \"st\\nall\": x.A } ]\n"), and_then("faults: [ { stall: \"x.\\nA\" } ]\n"),
        and_then("faults: [ { stall: x.A, \"a\\nb\": 1 } ]\n"),
        and_then("faults: [ { stuck: x.DIN_1, level: \"a\\nb\" } ]\n"),
        and_then("plant:\n  x.A: { drive: { enabled_by: \"o\\nn\" } }\n"),
        and_then("", "program: \"NOP\\nb\""), and_then("", "dip: { \"DIP\\n1\": on }")}) {
    const std::string got = diagnostic(text);
    EXPECT_NE(got, "") << text;
    EXPECT_EQ(got.find('\n'), std::string::npos) << got;
  }
}

}  // namespace bench_disturbances_test
}  // namespace understudy::emulator::world
