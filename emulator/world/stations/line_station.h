// A device's presence on a line, whatever is spoken there, as the world sees it.
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
  std::uint64_t requests = 0;  // for this station: frames, broadcasts included, or lines
  std::uint64_t replies = 0;
  std::uint64_t exceptions = 0;  // of the replies
};

class LineStation : public pty::Station, private FaultyWire::End {
 public:
  LineStation(const LineStation&) = delete;
  LineStation& operator=(const LineStation&) = delete;

  pty::LineSettings settings() const final { return device_.line_settings(port_); }

  /// Forgets what it was hearing, and what it still has to say.
  virtual void reset() = 0;

  /// What is broken that frames meet; null: nothing. It gets the numbers with each frame.
  void set_faults(FrameFaults* faults, std::size_t device, std::size_t line) {
    wire_.set_faults(faults, device, line);
  }

  /// The device may have something to say unasked. Returns whether it has: then due() has changed.
  virtual bool look_for_speech(pty::SimTime /*now*/) { return false; }

  const Device& device() const { return device_; }
  /// By which of the device's ports it stands there.
  std::size_t port() const { return port_; }
  const StationCounters& counters() const { return counters_; }
  /// Those that were heard and ignored.
  virtual std::uint64_t dropped_bytes() const = 0;

  // --- its state: what it hears and has counted; the device's is its own ---------------------------
  virtual void write_state(StateWriter& writer) const = 0;
  /// Reads it; calling the result puts it in force, which does not throw. Throws StateError or
  /// std::invalid_argument for what this station cannot be.
  virtual std::function<void()> read_state(StateReader& reader) = 0;
  /// Reads two, and tells where they differ (base/state/difference.h).
  virtual std::string difference(StateReader& a, StateReader& b, const std::string& path) const = 0;

 protected:
  /// The last two are parts of the station's state.
  LineStation(Device& device, std::size_t port, StationCounters& counters,
              std::vector<FaultyWire::Late>& late)
      : device_(device), port_(port), counters_(counters), wire_(*this, late) {}

  Device& device_;
  std::size_t port_;
  StationCounters& counters_;
  FaultyWire wire_;  // all that it hears and says goes through it
};

/// Those on a line.
using LineStations = std::vector<std::unique_ptr<LineStation>>;

}  // namespace understudy::emulator::world
