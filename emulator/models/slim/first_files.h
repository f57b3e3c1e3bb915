// The files that `understudy init` writes for this model.
#pragma once

#include "emulator/device/model.h"

namespace understudy::emulator::models::slim {

inline constexpr FirstFiles kFirstFiles{
    .bench =
        R"(# A chain of two SLIM modules, spoken to in lines of text. `understudy serve bench.yaml` opens its port.
understudy: 1
lines:
  rs232:
    link: ./robot.port
    baud: 9600
    stations:
      - { name: robot, model: slim, modules: 2 }
)",
    .steps = R"(  - send: { text: TX=0 }
  - send: { text: TY=1 }
  - send: { text: "2MA 100,50" }
  - wait: { until: robot.MD == 0, within: 5s }
  - send: { text: "?PE", reply: "100" }
)",
    // A chain of one module has one axis.
    .first_move = R"(  - send: { text: TX=0 }
  - send: { text: MA 1000 }
)"};

}  // namespace understudy::emulator::models::slim
