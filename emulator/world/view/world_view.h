// The readable side of a running world: its contents (inventory.h) and its current state. Observers (probes,
// peaks) use only this interface. Reading changes nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/device.h"
#include "emulator/world/plant/plant.h"
#include "emulator/world/protocol/line_protocol.h"
#include "emulator/world/stations/line_station.h"
#include "emulator/world/view/inventory.h"
#include "pty/line.h"
#include "pty/rtu_framer.h"

namespace understudy::emulator::world {

/// A line with its stations.
struct WorldLine {
  pty::Line line;
  const LineProtocol& protocol;
  LineStations stations;
  pty::RtuFraming framing{};  // from the stations; if they differ, with the shortest silence

  /// These functions use `protocol` and the stations that the request addresses now.
  std::string request_text(std::span<const std::uint8_t> request) const {
    return protocol.request_text(stations, device_addressed(request), request);
  }
  std::string command_text(std::span<const std::uint8_t> request) const {
    return protocol.command_text(device_addressed(request), request);
  }
  std::string reply_text(std::span<const std::uint8_t> request, std::span<const std::uint8_t> reply) const {
    return protocol.reply_text(stations, device_addressed(request.empty() ? reply : request), request, reply);
  }
  /// Returns the first device that the message addresses now, or null.
  const Device* device_addressed(std::span<const std::uint8_t> message) const {
    const std::vector<std::size_t> to = protocol.addressed(stations, message);
    return to.empty() ? nullptr : &stations[to.front()]->device();
  }
  std::unique_ptr<pty::CaptureFrames> packets(std::size_t number, pty::CaptureFrames::Sink sink) const {
    return protocol.packets(number, framing, std::move(sink));
  }
};

class WorldView : public Inventory {
 public:
  virtual SimTime now() const = 0;
  virtual const WorldLine& line(std::size_t number) const = 0;
  virtual std::size_t device_count() const = 0;
  virtual const PlantAxis& plant(std::size_t device, int axis) const = 0;
  /// Returns the total of all pulses since the world began, in the motor's direction.
  virtual std::int64_t sent_pulses(std::size_t device, int axis) const = 0;

  const std::string& line_name(std::size_t number) const final { return line(number).line.name(); }
  const PlantSetup& machine(std::size_t device, int axis) const final { return plant(device, axis).setup(); }

 protected:
  ~WorldView() = default;
};

/// Is notified of ticks when they have ended. The watcher may act on the world like an outside event.
class TickWatcher {
 public:
  virtual ~TickWatcher() = default;
  virtual void on_tick(Tick tick) = 0;
  /// Returns the first tick after `done` of which it must be notified even if nothing happens: `done` + 1 if
  /// it needs every tick, kNever if it does not need unchanged ticks. All watchers are notified of the first
  /// tick in which nothing happens.
  virtual Tick next_poll(Tick done) const { return done + 1; }
  /// Called if nothing has changed since the last tick of which it was notified, and nothing will change up
  /// to `last`.
  virtual void on_rest(Tick last) { on_tick(last); }
};

}  // namespace understudy::emulator::world
