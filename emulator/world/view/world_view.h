// What can be looked at in a running world: what there is (inventory.h), and how it is doing. Whoever looks
// (probes, peaks) knows no more of a world than this; looking changes nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/device.h"
#include "emulator/world/plant/plant.h"
#include "emulator/world/speech/line_speech.h"
#include "emulator/world/stations/line_station.h"
#include "emulator/world/view/inventory.h"
#include "pty/line.h"
#include "pty/rtu_framer.h"

namespace understudy::emulator::world {

/// A line with those who stand on it.
struct WorldLine {
  pty::Line line;
  const LineSpeech& speech;
  LineStations stations;
  pty::RtuFraming framing{};  // as its stations have it; the shortest of different silences

  /// As of `speech`.
  std::string request_text(std::span<const std::uint8_t> request) const {
    return speech.request_text(stations, request);
  }
  std::string command_text(std::span<const std::uint8_t> request) const {
    return speech.command_text(stations, request);
  }
  std::string reply_text(std::span<const std::uint8_t> request, std::span<const std::uint8_t> reply) const {
    return speech.reply_text(stations, request, reply);
  }
  std::unique_ptr<pty::CaptureFrames> packets(std::size_t number, pty::CaptureFrames::Sink sink) const {
    return speech.packets(number, framing, std::move(sink));
  }
};

class WorldView : public Inventory {
 public:
  virtual SimTime now() const = 0;
  virtual const WorldLine& line(std::size_t number) const = 0;
  virtual std::size_t device_count() const = 0;
  virtual const PlantAxis& plant(std::size_t device, int axis) const = 0;
  /// All pulses since the world began, in the motor's sense.
  virtual std::int64_t sent_pulses(std::size_t device, int axis) const = 0;

  const std::string& line_name(std::size_t number) const final { return line(number).line.name(); }
  const PlantSetup& machine(std::size_t device, int axis) const final { return plant(device, axis).setup(); }

 protected:
  ~WorldView() = default;
};

/// Sees ticks when they are completely over. May act on the world as the outside does.
class TickWatcher {
 public:
  virtual ~TickWatcher() = default;
  virtual void on_tick(Tick tick) = 0;
  /// The first tick after `done` that it must see although nothing happens: `done` + 1 for one that sees
  /// each, kNever for one that would see the same again. The first tick at which nothing happens is shown to
  /// all.
  virtual Tick next_look(Tick done) const { return done + 1; }
  /// Nothing has changed since the tick that it saw last, and nothing does up to `last`.
  virtual void on_rest(Tick last) { on_tick(last); }
};

}  // namespace understudy::emulator::world
