// Implements lines of text, for a line with one device, which may also send text without a request.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/text/text_protocol.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/faults/kinds.h"
#include "emulator/world/faults/trigger.h"
#include "emulator/world/names/names.h"
#include "emulator/world/protocol/line_protocol.h"
#include "emulator/world/protocol/received_lines.h"
#include "emulator/world/stations/frame_faults.h"
#include "emulator/world/stations/line_station.h"
#include "emulator/world/stations/text_station.h"
#include "pty/capture.h"
#include "pty/capture_frames.h"
#include "pty/rtu_framer.h"

namespace understudy::emulator::world {

namespace {

class TextLineProtocol final : public LineProtocol {
 public:
  const Protocol& protocol() const override { return kTextLines; }
  std::string_view messages() const override { return "lines of text"; }

  std::unique_ptr<LineStation> make_station(Device& device, std::size_t port,
                                            const StationConditions& conditions) const override {
    if (device.text_protocol() == nullptr)
      throw std::logic_error(device.name() + ": speaks text, but is not a TextProtocol");
    return std::make_unique<TextStation>(device, port, conditions.is_instant);
  }
  bool may_be_unasked() const override { return true; }

  bool carries_text() const override { return true; }
  bool may_change(const LineStations& /*stations*/, const pty::CapturedPacket& /*message*/) const override {
    return true;  // only the device could determine this
  }

  std::unique_ptr<pty::CaptureFrames> packets(std::size_t line, pty::RtuFraming framing,
                                              pty::CaptureFrames::Sink sink) const override {
    return std::make_unique<pty::CaptureFrames>(line, framing, std::move(sink), pty::Packets::lines);
  }
  std::string request_text(const LineStations& /*stations*/, const Device* /*to*/,
                           std::span<const std::uint8_t> request) const override {
    return quoted(request);
  }
  std::string reply_text(const LineStations& stations, const Device* /*to*/,
                         std::span<const std::uint8_t> /*request*/,
                         std::span<const std::uint8_t> reply) const override {
    const std::string meaning = meaning_of(stations, reply);
    return quoted(reply) + (meaning.empty() ? "" : ": " + meaning);
  }
  bool refuses(const LineStations& stations, std::span<const std::uint8_t> answer) const override {
    return !meaning_of(stations, answer).empty();
  }

  /// Returns only the time, because text lines contain neither a station nor a function.
  FrameFacts facts_of(const ReceivedFrame& frame) const override { return {.at = frame.now}; }
  /// Refuses faults that require functions, stations, checksums or exceptions, because text lines have none
  /// of these.
  void require_possible(const std::string& device, const Fault& fault) const override {
    const std::string kind(fault_kind(fault.kind).name);
    switch (fault.kind) {
      case Fault::Kind::busy:
      case Fault::Kind::exception:
      case Fault::Kind::early_reply:
      case Fault::Kind::corrupt_checksum:
      case Fault::Kind::wrong_transaction:
      case Fault::Kind::wrong_unit:
        throw NameError(kind + ": is a fault of Modbus frames, but " + device +
                        " uses text; expected a different fault");
      default: break;
    }
    const FaultTrigger& trigger = fault.trigger;
    for (const auto& [field, value] :
         {std::pair("function", trigger.function), std::pair("station", trigger.station),
          std::pair("address", trigger.first_address)}) {
      if (value < 0) continue;
      throw FaultFieldError(
          kind, field, device + " speaks text, to which this field does not apply; expected no such field");
    }
  }

 private:
  /// Returns the meaning of an error answer from a station, or an empty text for any other answer.
  static std::string meaning_of(const LineStations& stations, std::span<const std::uint8_t> answer) {
    const std::string text(answer.begin(), answer.end());
    for (const auto& station : stations) {
      const Device& device = station->device();
      if (device.text_protocol() == nullptr) continue;
      for (const std::string& line : lines_in(text).lines) {
        const std::string_view meaning = device.text_protocol()->meaning_of(line);
        if (!meaning.empty()) return std::string(meaning);
      }
    }
    return {};
  }
  /// Returns the lines one after another, each of them in quotes.
  static std::string quoted(std::span<const std::uint8_t> bytes) {
    constexpr std::size_t kMaxCharacters = 200;
    std::string text(bytes.begin(), bytes.end());
    const bool is_cut = text.size() > kMaxCharacters;
    if (is_cut) text.resize(kMaxCharacters);
    if (text.starts_with('\n')) text.erase(0, 1);
    return lines_text(lines_in(text).lines) + (is_cut ? " ..." : "");
  }
};

}  // namespace

const LineProtocol& text_protocol() {
  static const TextLineProtocol protocol;
  return protocol;
}

}  // namespace understudy::emulator::world
