// A connection to a real controller: bytes to and from a serial port of this machine or one behind TCP, in
// wall time.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "emulator/box/wire/port_name.h"
#include "emulator/serve/loop/event_loop.h"
#include "pty/line_settings.h"
#include "pty/port_link.h"

namespace understudy::emulator::box {

using Bytes = std::vector<std::uint8_t>;
using serve::WallTime;

/// Thrown if the port cannot be opened, or is lost. The message is one line that names it and what was
/// expected.
struct WireError : pty::PortError {
  using pty::PortError::PortError;
};

/// What an adapter may hold back: the latency timers of USB adapters are set to 16 ms.
inline constexpr WallTime kAdapterDelay = std::chrono::milliseconds(20);
/// A line that is never silent for longer than this is used anyway.
inline constexpr WallTime kLongestUnrest = std::chrono::seconds(1);

class Wire {
 public:
  Wire() = default;
  virtual ~Wire() = default;
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  /// Sets speed and framing, if PortName::has_settings(). Throws WireError.
  virtual void set_line(const pty::LineSettings& settings) = 0;
  /// Sends all bytes. Throws WireError.
  virtual void send(std::span<const std::uint8_t> bytes) = 0;
  /// Adds the bytes that have arrived, or arrive before `until`. Returns false if there are none. Throws
  /// WireError.
  virtual bool receive(Bytes& bytes, WallTime until) = 0;
  /// Returns what becomes readable when bytes arrive.
  virtual int descriptor() const = 0;

  /// Drops received bytes that nobody has read.
  void discard();
};

enum class WireUse : std::uint8_t {
  talk,
  listen,  // a serial port is opened for reading only, so nothing can be sent
};
/// Throws WireError.
std::unique_ptr<Wire> open_wire(const PortName& name, WireUse use = WireUse::talk);

}  // namespace understudy::emulator::box
