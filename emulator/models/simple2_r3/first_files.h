// The files that `understudy init` writes for this model.
#pragma once

#include "emulator/device/model.h"

namespace understudy::emulator::models::simple2_r3 {

inline constexpr FirstFiles kFirstFiles{
    .bench =
        R"(# One Simple2-R3 on a serial line, with a machine on axis A; the memory assigns functions to the inputs of its
# switches. `understudy serve bench.yaml` opens its port.
understudy: 1
lines:
  rs485:
    link: ./feeder.port
    baud: 19200
    stations:
      - { device: feeder, address: 1 }
devices:
  feeder: { model: simple2-r3, nv: { DIN2_Aaxis_UP_Limit: 1, DIN3_Aaxis_DN_Limit: 1, DIN4_Aaxis_Home: 1 } }
plant:
  feeder.A:
    travel: [-120000, 120000]
    home: { at: 0, width: 200 }
    limits: { lower: -100000, upper: 100000 }
)",
    .steps = R"(  - write: { feeder.Aaxis_SVON: 1 }
  - write: { feeder.Aaxis_Pulse: 3200, feeder.Aaxis_Speed: 60, feeder.Aaxis_Move_INC: 1 }
  - wait: { until: feeder.STATUS.4 == 0, within: 5s }
  - expect: { feeder.Cord_A: 3200 }
)"};

}  // namespace understudy::emulator::models::simple2_r3
