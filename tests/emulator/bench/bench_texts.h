// A valid bench that uses everything a bench file can say, and how one is read in tests.
#pragma once

#include <string>

#include "emulator/bench/bench_file.h"

namespace understudy::emulator {

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

inline Bench parse(const std::string& text) { return parse_bench(text, "bench.yaml", "/benches"); }

/// The complaint about a text; empty if there is none.
inline std::string complaint(const std::string& text) {
  try {
    parse(text);
  } catch (const BenchError& error) {
    return error.what();
  }
  return "";
}

}  // namespace understudy::emulator
