// The state of a bench in parts: a line, one of its stations, a device. Each part shows one moment, which
// lines and devices report as "time_ns". While the clock is stopped, this time is the same in all parts.
#pragma once

#include <cstddef>
#include <cstdint>

#include "emulator/serve/control/reply_text.h"

namespace understudy::emulator::serve {

class Daemon;

class StatusParts {
 public:
  explicit StatusParts(Daemon& daemon) : daemon_(daemon) {}

  /// Adds the next members to an object. Returns false if nothing is left.
  bool add_next(ReplyText& text);

 private:
  enum class Part : std::uint8_t { head, lines, devices, faults, end };
  void add_head(ReplyText& text);
  void add_of_line(ReplyText& text);

  Daemon& daemon_;
  Part part_ = Part::head;
  std::size_t next_ = 0;  // the next line or device
  std::size_t next_station_ = 0;
  bool is_in_line_ = false;
};

}  // namespace understudy::emulator::serve
