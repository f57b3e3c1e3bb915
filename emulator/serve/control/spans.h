// Reports the spans of a timeline: its states and events between two times (docs/control.md#spans).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/daemon/kept_waits.h"

namespace understudy::emulator::serve {

struct Stretch {
  SimTime from{0};
  SimTime to{0};
  std::uint64_t dots = 0;  // the width of the drawing
};

/// Reads `from_ns`, `to_ns` and `dots` of a message. By default, the stretch lasts from `begin` to `end`.
/// Throws MessageError.
Stretch stretch_of(const Json& message, SimTime begin, SimTime end);

/// A state or an event. Spans of a lane that lie within one dot are reported as one.
struct Span {
  std::string lane;
  SimTime begin{0};
  SimTime end{0};
  Json entry;
  bool is_bad = false;
  std::uint64_t count = 1;
};

Span span_of_wait(const HostWait& wait);

/// Returns the reply with the spans of the stretch, starting at the message's `from`. Throws MessageError.
Json reply_with(std::vector<Span> spans, const Stretch& stretch, const Json& message);

}  // namespace understudy::emulator::serve
