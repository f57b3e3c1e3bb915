// The reply of a real controller, and its latency.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/box/wire/wire.h"

namespace understudy::emulator::box {

/// A request and its reply, as bytes of the line.
struct Asked {
  Bytes request;
  Bytes reply;          // without an echo; empty: nothing came in time
  WallTime latency{0};  // from the request's first byte to the reply's last, by this machine's clock
  bool was_echoed = false;
};

}  // namespace understudy::emulator::box
