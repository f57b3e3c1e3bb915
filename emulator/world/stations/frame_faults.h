// What a station asks about each frame when something is broken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pty/line_settings.h"
#include "pty/wire_fault.h"

namespace understudy::emulator::world {

/// A request as a station has heard it: a frame, checksum and all; of text a line without its end, or with it
/// where the wire is asked.
struct HeardFrame {
  std::size_t device = 0;  // whose station it is
  std::size_t line = 0;    // on which it was heard
  std::span<const std::uint8_t> bytes;
  std::uint64_t last_character = 0;
  bool is_for_device = false;  // broadcasts as well
  pty::SimTime now{0};
};

class FrameFaults {
 public:
  /// Its last character has come: whether the device takes it as complete at once.
  virtual bool is_early(const HeardFrame& frame) = 0;
  /// It is over: what the wire has done to it.
  virtual std::vector<pty::WireFault> on_request(const HeardFrame& frame) = 0;

  struct Treatment {
    int exception = 0;        // it is refused with this exception; 0: it is carried out
    bool is_answered = true;  // false: the power fails as soon as it has been carried out
  };
  /// It is for the device, which is about to carry it out.
  virtual Treatment on_serving(const HeardFrame& frame) = 0;
  /// It was answered: what the wire does to the reply.
  virtual std::vector<pty::WireFault> on_reply(const HeardFrame& frame) = 0;

 protected:
  ~FrameFaults() = default;
};

}  // namespace understudy::emulator::world
