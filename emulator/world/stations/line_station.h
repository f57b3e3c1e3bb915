// The presence of a device on a line with any protocol, from the view of the world.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "emulator/device/device.h"
#include "emulator/world/stations/faulty_wire.h"
#include "pty/station.h"

namespace understudy::emulator::world {

struct StationCounters {
  std::uint64_t requests = 0;  // messages for this station: frames (including broadcasts) or lines
  std::uint64_t replies = 0;
  std::uint64_t exceptions = 0;  // how many replies were exceptions
};

class LineStation : public pty::Station, private FaultyWire::End {
 public:
  LineStation(const LineStation&) = delete;
  LineStation& operator=(const LineStation&) = delete;

  pty::LineSettings settings() const final { return device_.line_settings(port_); }

  /// Drops incomplete input and unsent output.
  virtual void reset() = 0;

  /// Sets the source of faults for frames; null: none. For each frame, the source receives these numbers.
  void set_faults(FrameFaults* faults, std::size_t device, std::size_t line) {
    wire_.set_faults(faults, device, line);
  }

  /// Called when the device may have something to send without a request. If so, due() changes and the
  /// function returns true.
  virtual bool poll_text(pty::SimTime /*now*/) { return false; }

  const Device& device() const { return device_; }
  /// Returns the device's port that is connected to the line.
  std::size_t port() const { return port_; }
  const StationCounters& counters() const { return counters_; }
  /// Returns the number of received bytes that were ignored.
  virtual std::uint64_t dropped_bytes() const = 0;

  // --- its state: what it receives and has counted, excluding the device's state --------------------------
  virtual void write_state(StateWriter& writer) const = 0;
  /// Reads a state. Calling the returned function puts it into effect; the function does not throw. Throws
  /// StateError or std::invalid_argument for a state that is impossible for this station.
  virtual std::function<void()> read_state(StateReader& reader) = 0;
  /// Reads two states and returns where they differ (base/state/difference.h).
  virtual std::string difference(StateReader& a, StateReader& b, const std::string& path) const = 0;

 protected:
  /// `counters` and `late` are parts of the station's state.
  LineStation(Device& device, std::size_t port, StationCounters& counters,
              std::vector<FaultyWire::Late>& late)
      : device_(device), port_(port), counters_(counters), wire_(*this, late) {}

  Device& device_;
  std::size_t port_;
  StationCounters& counters_;
  FaultyWire wire_;  // everything that the station receives and sends passes through it
};

using LineStations = std::vector<std::unique_ptr<LineStation>>;

}  // namespace understudy::emulator::world
