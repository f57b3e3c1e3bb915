// The files that `understudy init` writes for this model.
#pragma once

#include "emulator/device/model.h"

namespace understudy::emulator::models::super_40nc {

inline constexpr FirstFiles kFirstFiles{
    .bench =
        R"(# One SUPER-40NC on both its ports, with a small program. `understudy serve bench.yaml` opens the ports.
understudy: 1
lines:
  rs232:
    link: ./mill.port
    stations: [ { device: mill, port: RS232 } ]
  rs485:
    link: ./mill.rs485.port
    stations: [ { device: mill, port: RS485 } ]
devices:
  mill:
    model: super-40nc
    program: |
      AREA X
      RPM K100
      DRV K1000
      END
)",
    .steps = R"(  - write: { mill.M8100: 1 }
  - wait: { until: mill.M8100 == 0, within: 5s }
  - expect: { mill.D8117: 1000 }
)"};

}  // namespace understudy::emulator::models::super_40nc
