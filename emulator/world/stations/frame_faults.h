// The interface through which a station determines how faults affect each frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pty/line_settings.h"
#include "pty/wire_fault.h"

namespace understudy::emulator::world {

/// A received request: a frame with its checksum, or a text line. The line includes its line ending only for
/// faults of the wire.
struct ReceivedFrame {
  std::size_t device = 0;  // the device of the station
  std::size_t line = 0;    // the line on which it was received
  std::span<const std::uint8_t> bytes;
  std::uint64_t last_character = 0;
  bool is_for_device = false;  // also true for broadcasts
  pty::SimTime now{0};
};

class FrameFaults {
 public:
  /// Called when the last character of a frame has arrived. Returns true if the device treats the frame as
  /// complete immediately.
  virtual bool is_early(const ReceivedFrame& frame) = 0;
  /// Called when a request is complete. Returns the faults of the wire for it.
  virtual std::vector<pty::WireFault> on_request(const ReceivedFrame& frame) = 0;

  struct Treatment {
    int exception = 0;        // the request is refused with this exception; 0: it is executed
    bool is_answered = true;  // false if the power fails immediately after the request was executed
  };
  /// Called before the device executes a request.
  virtual Treatment on_serving(const ReceivedFrame& frame) = 0;
  /// Called when a request has been answered. Returns the faults of the wire for the reply.
  virtual std::vector<pty::WireFault> on_reply(const ReceivedFrame& frame) = 0;

 protected:
  ~FrameFaults() = default;
};

}  // namespace understudy::emulator::world
