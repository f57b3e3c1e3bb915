// What is spoken on a line: how devices are put on it, how hosts behave there, what its messages say. All
// that differs from one protocol to another is asked here; a new one is one more object (speech_of() lists
// them).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "emulator/device/model.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/stations/line_station.h"
#include "pty/capture_frames.h"
#include "pty/rtu_framer.h"

namespace understudy::emulator::world {

/// How a line and its world treat the stations on it.
struct StationConditions {
  bool is_instant = false;      // characters take no time
  bool strict_framing = false;  // silence alone ends a frame
  SimTime patience{0};          // as of WorldOptions
  SimTime rest_patience{0};     // as long as LineSetup::byte_timeout, in simulated time
};

class LineSpeech {
 public:
  virtual const Protocol& protocol() const = 0;
  /// "Modbus frames": what the line carries, for messages.
  virtual std::string_view messages() const = 0;

  // --- stations ----------------------------------------------------------------------------------
  /// Of the device at one of its ports.
  virtual std::unique_ptr<LineStation> make_station(Device& device, std::size_t port,
                                                    const StationConditions& conditions) const = 0;
  /// How a station of that model frames what it hears, where it does.
  virtual pty::RtuFraming framing(const Model& /*model*/, const StationConditions& /*conditions*/) const {
    return {};
  }
  /// Whether a device may say something unasked.
  virtual bool may_be_unasked() const { return false; }

  // --- hosts -------------------------------------------------------------------------------------
  /// Whether steps that send and hear text fit it.
  virtual bool carries_text() const { return false; }
  /// Whether a host leaves a silence between its messages.
  virtual bool is_framed_by_silence() const { return false; }
  /// Whether a host's message may change something in one of the stations.
  virtual bool may_change(const LineStations& stations, const pty::CapturedPacket& message) const = 0;
  /// Whether an answer says that nothing was changed.
  virtual bool is_refusal(std::span<const std::uint8_t> /*answer*/) const { return false; }

  // --- onlookers ---------------------------------------------------------------------------------
  /// Makes packets of what goes over the line, which has that number.
  virtual std::unique_ptr<pty::CaptureFrames> packets(std::size_t line, pty::RtuFraming framing,
                                                      pty::CaptureFrames::Sink sink) const = 0;
  /// A message of a host in words.
  virtual std::string request_text(const LineStations& stations,
                                   std::span<const std::uint8_t> request) const = 0;
  /// "mill: MOVE X 1000", of a message that is a command with a name (emulator/device/command_window.h); else
  /// empty.
  virtual std::string command_text(const LineStations& /*stations*/,
                                   std::span<const std::uint8_t> /*request*/) const {
    return {};
  }
  /// What a station answered. `request` is empty if it is not known.
  virtual std::string reply_text(const LineStations& stations, std::span<const std::uint8_t> request,
                                 std::span<const std::uint8_t> reply) const = 0;

  // --- faults ------------------------------------------------------------------------------------
  /// What a fault's trigger asks of a message.
  virtual FrameFacts facts_of(const HeardFrame& frame) const = 0;
  /// Throws NameError for a fault that its messages cannot have.
  virtual void demand_possible(const std::string& /*device*/, const Fault& /*fault*/) const {}

 protected:
  ~LineSpeech() = default;
};

// modbus_speech.cpp, text_speech.cpp
const LineSpeech& modbus_speech();
const LineSpeech& text_speech();

/// That of a model's protocol. Throws std::logic_error if it is none of them.
const LineSpeech& speech_of(const Model& model);

}  // namespace understudy::emulator::world
