// Reports the state of a bench in parts: a line, one of its stations, or a device. Each part shows a single
// moment, which lines and devices report as "time_ns". While the clock is stopped, all parts show the same
// time.
#pragma once

#include <cstddef>
#include <cstdint>

#include "emulator/serve/control/reply_text.h"

namespace understudy::emulator::serve {

class Daemon;

class StatusParts {
 public:
  explicit StatusParts(Daemon& daemon) : daemon_(daemon) {}

  /// Adds the next members to an object. Returns false if there are no more.
  bool add_next(ReplyText& text);

 private:
  enum class Part : std::uint8_t { head, lines, devices, faults, end };
  void add_head(ReplyText& text);
  void add_of_line(ReplyText& text);

  Daemon& daemon_;
  Part part_ = Part::head;
  std::size_t next_ = 0;  // the index of the next line or device
  std::size_t next_station_ = 0;
  bool is_in_line_ = false;
};

}  // namespace understudy::emulator::serve
