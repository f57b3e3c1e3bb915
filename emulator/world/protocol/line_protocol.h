// The protocol of a line: how it connects devices, how hosts behave on it, and what its messages mean. All
// differences between protocols are behind this interface; a new protocol is an additional object
// (protocol_of() lists them).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/model.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/stations/line_station.h"
#include "pty/capture_frames.h"
#include "pty/rtu_framer.h"

namespace understudy::emulator::world {

/// How a line and its world treat the stations on it.
struct StationConditions {
  bool is_instant = false;      // characters take no time on the wire
  bool strict_framing = false;  // frames end only by silence
  SimTime patience{0};          // as in WorldOptions
  SimTime rest_patience{0};     // LineSetup::byte_timeout in simulated time
};

class LineProtocol {
 public:
  virtual const Protocol& protocol() const = 0;
  /// Returns "Modbus frames" or a similar phrase for messages.
  virtual std::string_view messages() const = 0;

  // --- stations ----------------------------------------------------------------------------------
  /// Creates the station of a device at one of its ports.
  virtual std::unique_ptr<LineStation> make_station(Device& device, std::size_t port,
                                                    const StationConditions& conditions) const = 0;
  /// If stations of this model split received bytes into frames, returns how they do so.
  virtual pty::RtuFraming framing(const Model& /*model*/, const StationConditions& /*conditions*/) const {
    return {};
  }
  /// Returns true if a device may send something without a request.
  virtual bool may_be_unasked() const { return false; }

  // --- hosts -------------------------------------------------------------------------------------
  /// Returns true if scenario steps that send and receive text can use this protocol.
  virtual bool carries_text() const { return false; }
  /// Returns true if a host leaves a silence between messages.
  virtual bool is_framed_by_silence() const { return false; }
  /// Returns true if a host's message may change something in a station.
  virtual bool may_change(const LineStations& stations, const pty::CapturedPacket& message) const = 0;
  /// Returns true if an answer means that nothing was changed.
  virtual bool is_refusal(std::span<const std::uint8_t> /*answer*/) const { return false; }

  /// Like is_refusal(), but for people: returns true for any answer from these stations that reports an
  /// error, even if something was changed.
  virtual bool refuses(const LineStations& /*stations*/, std::span<const std::uint8_t> answer) const {
    return is_refusal(answer);
  }

  // --- observers ---------------------------------------------------------------------------------
  /// Returns an object that splits the traffic on the line with this number into packets.
  virtual std::unique_ptr<pty::CaptureFrames> packets(std::size_t line, pty::RtuFraming framing,
                                                      pty::CaptureFrames::Sink sink) const = 0;
  /// Returns the numbers of the stations on the line that a host's message addresses now. Returns none if
  /// messages of this protocol have no address.
  virtual std::vector<std::size_t> addressed(const LineStations& /*stations*/,
                                             std::span<const std::uint8_t> /*request*/) const {
    return {};
  }
  /// Describes a host's message in words. `to` is the device that it addressed when it was sent, or null if
  /// there was none.
  virtual std::string request_text(const LineStations& stations, const Device* to,
                                   std::span<const std::uint8_t> request) const = 0;
  /// Returns "mill: MOVE X 1000" for a message that is a command with a name
  /// (emulator/device/command_window.h), and an empty text for all other messages.
  virtual std::string command_text(const Device* /*to*/, std::span<const std::uint8_t> /*request*/) const {
    return {};
  }
  /// Describes a station's answer in words. `request` is empty if it is not known. `to` is the device that
  /// the request addressed.
  virtual std::string reply_text(const LineStations& stations, const Device* to,
                                 std::span<const std::uint8_t> request,
                                 std::span<const std::uint8_t> reply) const = 0;

  // --- faults ------------------------------------------------------------------------------------
  /// Returns the facts about a message that fault triggers test.
  virtual FrameFacts facts_of(const ReceivedFrame& frame) const = 0;
  /// Throws NameError for a fault that is impossible for messages of this protocol.
  virtual void require_possible(const std::string& /*device*/, const Fault& /*fault*/) const {}

 protected:
  ~LineProtocol() = default;
};

// Defined in modbus_protocol.cpp, ascii_protocol.cpp and text_protocol.cpp.
const LineProtocol& modbus_protocol();
const LineProtocol& ascii_protocol();
const LineProtocol& text_protocol();

/// Returns the object for a model's protocol. Throws std::logic_error if there is none.
const LineProtocol& protocol_of(const Model& model);

}  // namespace understudy::emulator::world
