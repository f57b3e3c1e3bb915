// Valid benches that use all keys of bench files, and a function that reads one in tests.
#pragma once

#include <string>

#include "emulator/models/models.h"
#include "emulator/world/bench_file/bench_file.h"
#include "tests/emulator/world/bench_file/without_columns.h"

namespace understudy::emulator::world {

inline const std::string kFullBench = R"(understudy: 1
lines:
  rs485:
    link: ./feeder.port          # relative to the bench file
    baud: 19200
    timing: wire
    stations:
      - { name: feeder, model: simple2-r3, address: 1, firmware: "1.52" }
      - { device: turner, address: 2 }
  second:
    timing: instant
    baud: 115200
    stations:
      - name: lone-one_3
        model: simple2-r3
devices:
  turner:
    model: simple2-r3
    firmware: 1.40
    set: { Aaxis_Speed: 200, Aaxis_Pulse: -32000, DOUT_ALL: 0x7F }
    choices: { servo_at_power_up: on, limit_reaction: none }
plant:
  feeder.A:
    travel: [-20000, 20000]
    home: { at: 0, width: 200 }
    limits: { lower: -18000, upper: 18000 }
    encoder: { per_revolution: 4000 }
  turner.B: { limits: { upper: 5 }, encoder: { per_revolution: 10000, motor_pulses_per_revolution: 800 } }
wires: [ feeder.DOUT_4 -> turner.DIN_10, "turner.DOUT_0->feeder.DIN_9" ]
)";

/// Drives, hysteresis, switches on the housing, inputs, faults, memories.
inline const std::string kDisturbedBench = R"(understudy: 1
lines:
  rs485:
    stations:
      - { name: feeder, model: simple2-r3, dip: { DIP2: on }, nv: memory/feeder.json }
      - { device: turner, address: 2 }
devices:
  turner: { model: simple2-r3, dip: { DIP1: off, DIP2: off } }
plant:
  feeder.A:
    home: { at: -10, width: 5, hysteresis: 3 }
    limits: { lower: -180, upper: 170, hysteresis: 12 }
    encoder: { per_revolution: 4000, reversed: true }
    drive: { ready_after: 120ms, enabled_by: off, alarm_contact: opens }
  turner.B: { drive: {}, encoder: { per_revolution: 1, reversed: false } }
inputs: { feeder.DIN_10: on, turner.DIN_1: 0, feeder.AIN_A: 2.5V, turner.AIN_B: 9999mV, turner.DIP2: 1 }
faults:
  - { stall: feeder.A }
  - { lost_steps: turner.B, one_in: 50 }
  - { slip: turner.A, pulses: -200 }
  - { alarm: feeder.A }
  - { stuck: feeder.DIN_2, level: off }
)";

inline Bench parse(const std::string& text) {
  return parse_bench(models::all_models(), text, "bench.yaml", "/benches");
}

/// Returns the diagnostic about a text; empty if there is none.
inline std::string diagnostic(const std::string& text) {
  try {
    parse(text);
  } catch (const BenchError& error) {
    return without_columns(error.what());
  }
  return "";
}

}  // namespace understudy::emulator::world
