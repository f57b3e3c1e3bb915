// A bench as text reads back as the same bench.
#include "emulator/world/bench/bench_text.h"
#include "emulator/models/models.h"

#include <gtest/gtest.h>

#include "emulator/world/bench_file/bench_file.h"

namespace understudy::emulator::world {
namespace bench_text_test {

// Everything that a bench can contain.
const std::string kFull = R"(
understudy: 1
lines:
  rs485:
    baud: 115200
    baud_tolerance: 0.0305%
    byte_timeout: 1250ms
    echo: on
    timing: instant
    stations:
      - name: feeder
        model: simple2-r3
        address: 3
        firmware: "1.40"
        dip: { DIP1: on, DIP2: on }
        nv: { Aaxis_Resoultion: 6400, PROG_MEM3: -7 }
        program: |
          again: Out DOUT_4 ON   ; "quoted", and a \\ too
                 Jump again
        choices: { loop_count: further_passes }
        set: { Aaxis_Speed: 200, Aaxis_Pulse: -5 }
      - { device: turner, address: 4 }
  other:
    stations: [ { name: third, model: simple2-r3 } ]
devices:
  turner: { model: simple2-r3 }
plant:
  feeder.A:
    travel: [-20000, 30000]
    home: { at: 5, width: 7, hysteresis: 2 }
    limits: { lower: -18000, upper: 28000, hysteresis: 3 }
    near_home: { at: -40, width: 9, hysteresis: 4, contact: opens, input: DIN_5 }
    mark: { at: 100, width: 1 }
    encoder: { per_revolution: 4000, motor_pulses_per_revolution: 3200, reversed: true, index: { at: -3, width: 2, period: 1600, input: DIN_6 } }
    drive: { ready_after: 120ms, enabled_by: off, alarm_contact: opens }
  turner.B:
    position: -300
    home: { at: 1, width: 2, contact: opens, input: DIN_7 }
    limits: { lower: -900, upper: 10, contact: opens, lower_input: DIN_8, upper_input: DIN_9 }
    encoder: { per_revolution: 100, on: wheel }
wires: [ feeder.DOUT_4 -> turner.DIN_10, turner.DOUT_0 -> third.DIN_1, turner.B.upper_limit -> third.DIN_5 ]
inputs: { turner.DIN_3: on, feeder.AIN_A: 2.5V, third.DIN_2: off }
faults:
  - { stall: turner.A }
  - { lost_steps: feeder.B, one_in: 50 }
  - { stuck: third.DIN_4, level: 1 }
  - { turn: turner.B, counts: 70, in: 12ms, at: 3s }
  - { drop: other, when: 'feeder["Cord_A"] > 5 and time >= 1s', nth: 3.., chance: 0.5%, seed: 9 }
  - { noise: feeder, before: FF 00, after: "0A", of: both, address: Aaxis_Speed, from: 1s, to: 1500ms }
  - { encoder_noise: feeder.A, counts: 3, period: 10ms, at: 250ms, for: 1s }
  - { power_cut: third, function: 0x10, every: 3, times: 2 }
seed: 77
)";

TEST(BenchText, ReadAgainIsTheSameBench) {
  const Bench bench = parse_bench(models::all_models(), kFull, "bench.yaml", "/somewhere");
  const std::string text = to_text(bench);
  EXPECT_EQ(text.find('\n'), std::string::npos);
  const Bench again = parse_bench(models::all_models(), text, "text", "/elsewhere");
  EXPECT_EQ(to_text(again), text);

  const DeviceSettings& feeder = again.devices[1].settings;  // turner was declared first
  EXPECT_EQ(feeder.name, "feeder");
  EXPECT_EQ(feeder.firmware, 140);
  EXPECT_EQ(feeder.address, 3);
  EXPECT_EQ(feeder.bauds, std::vector{115'200});
  EXPECT_EQ(feeder.dip, (std::map<std::string, bool>{{"DIP1", true}, {"DIP2", true}}));
  EXPECT_EQ(feeder.choices, (std::map<std::string, std::string>{{"loop_count", "further_passes"}}));
  EXPECT_EQ(feeder.set,
            (std::vector<std::pair<std::string, Value>>{{"Aaxis_Speed", 200}, {"Aaxis_Pulse", -5}}));
  ASSERT_TRUE(feeder.nv);
  EXPECT_EQ(feeder.nv->registers, (std::vector<std::pair<std::string, std::int64_t>>{
                                      {"Aaxis_Resoultion", 6400}, {"PROG_MEM3", -7}}));
  EXPECT_EQ(feeder.program.substr(0, 24), "again: Out DOUT_4 ON   ;");
  const PlantSetup& plant = again.machines[0].plant;
  EXPECT_EQ(plant.travel->first, -20'000);
  EXPECT_EQ(plant.home->first, 5);
  EXPECT_EQ(plant.home->last, 11);
  EXPECT_EQ(plant.home_hysteresis_pulses, 2);
  EXPECT_EQ(plant.limit_hysteresis_pulses, 3);
  EXPECT_EQ(plant.encoder_counts_per_revolution, 4000);
  EXPECT_TRUE(plant.encoder_reversed);
  EXPECT_EQ(plant.drive->ready_after, 120);
  EXPECT_FALSE(plant.drive->enabled_by);
  EXPECT_TRUE(plant.drive->alarm_opens);
  EXPECT_EQ(plant.near_home->on.first, -40);
  EXPECT_EQ(plant.near_home->on.last, -32);
  EXPECT_EQ(plant.near_home->hysteresis_pulses, 4);
  EXPECT_TRUE(plant.near_home->opens);
  EXPECT_EQ(plant.near_home->input, bench.machines[0].plant.near_home->input);
  EXPECT_EQ(plant.mark->on.last, 100);
  EXPECT_EQ(plant.mark->input, -1);
  EXPECT_EQ(plant.index->at, -3);
  EXPECT_EQ(plant.index->width, 2);
  EXPECT_EQ(plant.index->period, 1600);
  EXPECT_EQ(plant.index->input, bench.machines[0].plant.index->input);
  const PlantSetup& other = again.machines.at(1).plant;
  EXPECT_EQ(other.position_pulses, -300);
  EXPECT_TRUE(other.home_opens && other.limits_open && other.has_wheel);
  EXPECT_EQ(other.home_input, bench.machines.at(1).plant.home_input);
  EXPECT_EQ(other.lower_limit_input, bench.machines.at(1).plant.lower_limit_input);
  EXPECT_EQ(other.upper_limit_input, bench.machines.at(1).plant.upper_limit_input);
  ASSERT_EQ(again.wires.size(), 3U);
  EXPECT_EQ(again.wires[2].from_axis, 1);
  EXPECT_EQ(again.wires[2].from_contact, Contact::upper_limit);
  EXPECT_EQ(again.inputs.size(), 3U);
  EXPECT_EQ(again.faults, bench.faults);
  EXPECT_EQ(again.faults.size(), 8u);
  EXPECT_EQ(again.seed, 77u);
  EXPECT_EQ(again.lines[0].baud_tolerance_ppm, 305);
  EXPECT_EQ(again.lines[1].baud_tolerance_ppm, 20'000);
  EXPECT_EQ(again.lines[0].byte_timeout, std::chrono::milliseconds(1250));
  EXPECT_EQ(again.lines[1].byte_timeout, std::chrono::milliseconds(200));
  EXPECT_TRUE(again.lines[0].echoes);
  EXPECT_FALSE(again.lines[1].echoes);
}

TEST(BenchText, OfAFactoryBenchIsShort) {
  const Bench bench =
      parse_bench(models::all_models(),
                  "understudy: 1\nlines: { a: { stations: [ { name: x, model: simple2-r3 } ] } }", "b", "");
  EXPECT_EQ(to_text(bench),
            R"({"understudy":1,"lines":{"a":{"timing":"wire","stations":[{"device":"x","address":1}]}},)"
            R"("devices":{"x":{"model":"simple2-r3"}}})");
}

}  // namespace bench_text_test
}  // namespace understudy::emulator::world
