// The state of a bench in parts: a line, one of its stations, a device. Each part is of one moment, which
// lines and devices give as "time_ns"; while the clock is stopped, it is the same in all parts.
#pragma once

#include <cstddef>
#include <cstdint>

#include "emulator/serve/control/reply_text.h"

namespace understudy::emulator::serve {

class Daemon;

class StatusParts {
 public:
  explicit StatusParts(Daemon& daemon) : daemon_(daemon) {}

  /// Adds the members of an object, one after another. Returns false if nothing is left.
  bool add_next(ReplyText& text);

 private:
  enum class Part : std::uint8_t { head, lines, devices, faults, end };
  void add_head(ReplyText& text);
  void add_of_line(ReplyText& text);

  Daemon& daemon_;
  Part part_ = Part::head;
  std::size_t next_ = 0;  // line or device
  std::size_t next_station_ = 0;
  bool is_in_line_ = false;
};

}  // namespace understudy::emulator::serve
