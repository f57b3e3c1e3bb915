// Implements Modbus RTU, for lines with several numbered stations.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/device/device.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/model.h"
#include "emulator/world/faults/trigger.h"
#include "emulator/world/protocol/line_protocol.h"
#include "emulator/world/protocol/modbus_request.h"
#include "emulator/world/protocol/modbus_words.h"
#include "emulator/world/stations/frame_faults.h"
#include "emulator/world/stations/line_station.h"
#include "emulator/world/stations/rtu_station.h"
#include "pty/capture.h"
#include "pty/capture_frames.h"
#include "pty/rtu_framer.h"

namespace understudy::emulator::world {

namespace {

class ModbusLineProtocol final : public LineProtocol {
 public:
  const Protocol& protocol() const override { return kModbusRtu; }
  std::string_view messages() const override { return "Modbus frames"; }

  std::unique_ptr<LineStation> make_station(Device& device, std::size_t port,
                                            const StationConditions& conditions) const override {
    if (device.modbus() == nullptr || device.register_bank() == nullptr)
      throw std::logic_error(device.name() + ": speaks Modbus, but is not a ModbusStation with registers");
    pty::RtuFraming framed_by = framing(device.model(), conditions);
    if (framed_by.silence != SimTime{0}) framed_by.silence = device.modbus()->end_silence(framed_by.silence);
    return std::make_unique<RtuStation>(device, port, framed_by);
  }
  pty::RtuFraming framing(const Model& model, const StationConditions& conditions) const override {
    // If characters take no time, there is no silence to wait for, unless only silence ends a frame.
    const bool no_silence = conditions.is_instant && !conditions.strict_framing;
    return {.strict = conditions.strict_framing,
            .silence = no_silence ? SimTime{0} : model.rtu->end_silence,
            .patience = conditions.patience,
            .rest_patience = conditions.rest_patience};
  }

  bool is_framed_by_silence() const override { return true; }
  bool may_change(const LineStations& stations, const pty::CapturedPacket& message) const override {
    if (message.remark != pty::Remark::none || !is_write(message.bytes)) return false;
    return std::any_of(stations.begin(), stations.end(), [&](const auto& station) {
      const Device& device = station->device();
      return device.powered() && device.modbus()->addressing(message.bytes[0]) != Addressing::ignore;
    });
  }
  bool is_refusal(std::span<const std::uint8_t> answer) const override {
    return answer.size() >= 2 && (answer[1] & 0x80) != 0;
  }

  std::unique_ptr<pty::CaptureFrames> packets(std::size_t line, pty::RtuFraming framing,
                                              pty::CaptureFrames::Sink sink) const override {
    return std::make_unique<pty::CaptureFrames>(line, framing, std::move(sink));
  }
  std::vector<std::size_t> addressed(const LineStations& stations,
                                     std::span<const std::uint8_t> request) const override {
    return addressed_by(stations, request);
  }
  std::string request_text(const LineStations& /*stations*/, const Device* to,
                           std::span<const std::uint8_t> request) const override {
    return modbus_request_text(to, request);
  }
  std::string command_text(const Device* to, std::span<const std::uint8_t> request) const override {
    return modbus_command_text(to, request);
  }
  std::string reply_text(const LineStations& /*stations*/, const Device* to,
                         std::span<const std::uint8_t> request,
                         std::span<const std::uint8_t> reply) const override {
    return modbus_reply_text(to, request, reply);
  }

  /// Returns the facts about a request, mainly the registers that it accesses.
  FrameFacts facts_of(const ReceivedFrame& frame) const override {
    FrameFacts facts{.at = frame.now, .station = frame.bytes[0], .function = frame.bytes[1]};
    const ModbusRequest request = parse_request_frame(frame.bytes);
    const auto addresses = [](const std::optional<RegisterSpan>& span) {
      return span ? FrameFacts::Addresses{span->first, static_cast<int>(span->count)}
                  : FrameFacts::Addresses{};
    };
    facts.read = addresses(request.reads);
    facts.written = addresses(request.writes);
    return facts;
  }
};

}  // namespace

const LineProtocol& modbus_protocol() {
  static const ModbusLineProtocol protocol;
  return protocol;
}

}  // namespace understudy::emulator::world
