// The files that `understudy init` writes for this model.
#pragma once

#include "emulator/device/model.h"

namespace understudy::emulator::models::rs_m8194h {

inline constexpr FirstFiles kFirstFiles{
    .bench =
        R"(# One RS-M8194H on a serial line, with a machine on axis X. `understudy serve bench.yaml` opens its port.
understudy: 1
lines:
  com:
    link: ./cell.port
    baud: 115200
    stations:
      - { name: cell, model: rs-m8194h, address: 1 }
plant:
  cell.X:
    travel: [-60000, 60000]
    home: { at: 0, width: 200 }
    limits: { lower: -50000, upper: 50000 }
)",
    .steps = R"(  - command: { cell: RSM_SET_MAX_V X 16000 }
  - command: { cell: RSM_SET_V X 2000 }
  - command: { cell: RSM_FIXED_MOVE X 1000 }
  - wait: { until: cell.LP_X == 1000, within: 20s }
  - expect: { cell.LP_X: 1000, cell.ERROR_CODE_X: 0 }
)"};

}  // namespace understudy::emulator::models::rs_m8194h
