// Implements Modbus ASCII: other frames for the messages of Modbus RTU, which modbus_protocol() handles.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "emulator/device/device.h"
#include "emulator/device/modbus/modbus_ascii.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/model.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/faults/kinds.h"
#include "emulator/world/faults/trigger.h"
#include "emulator/world/names/names.h"
#include "emulator/world/protocol/line_protocol.h"
#include "emulator/world/protocol/modbus_words.h"
#include "emulator/world/stations/ascii_station.h"
#include "emulator/world/stations/frame_faults.h"
#include "emulator/world/stations/line_station.h"
#include "pty/ascii_frame.h"
#include "pty/ascii_framer.h"
#include "pty/capture.h"
#include "pty/capture_frames.h"
#include "pty/rtu_framer.h"

namespace understudy::emulator::world {

namespace {

using Bytes = std::span<const std::uint8_t>;

class AsciiLineProtocol final : public LineProtocol {
 public:
  const Protocol& protocol() const override { return kModbusAscii; }
  std::string_view messages() const override { return "Modbus ASCII frames"; }

  std::unique_ptr<LineStation> make_station(Device& device, std::size_t port,
                                            const StationConditions& conditions) const override {
    if (device.modbus() == nullptr || device.register_bank() == nullptr)
      throw std::logic_error(device.name() + ": speaks Modbus, but is not a ModbusStation with registers");
    // If a host is slow in real time, it is equally slow in a simulation that runs faster.
    const SimTime patience = std::max<SimTime>(pty::kAsciiPatience, conditions.rest_patience);
    return std::make_unique<AsciiStation>(device, port, patience);
  }

  bool may_change(const LineStations& stations, const pty::CapturedPacket& message) const override {
    const auto frame = pty::rtu_of_ascii(message.bytes);
    if (message.remark != pty::Remark::none || !frame) return false;
    pty::CapturedPacket carried = message;
    carried.bytes = *frame;
    return modbus_protocol().may_change(stations, carried);
  }
  bool is_refusal(Bytes answer) const override {
    const auto frame = pty::rtu_of_ascii(answer);
    return frame && modbus_protocol().is_refusal(*frame);
  }

  std::unique_ptr<pty::CaptureFrames> packets(std::size_t line, pty::RtuFraming framing,
                                              pty::CaptureFrames::Sink sink) const override {
    return std::make_unique<pty::CaptureFrames>(line, framing, std::move(sink), pty::Packets::ascii_frames);
  }
  std::vector<std::size_t> addressed(const LineStations& stations, Bytes request) const override {
    const auto frame = pty::rtu_of_ascii(request);
    return frame ? modbus_protocol().addressed(stations, *frame) : std::vector<std::size_t>();
  }
  std::string request_text(const LineStations& stations, const Device* to, Bytes request) const override {
    const auto frame = pty::rtu_of_ascii(request);
    return frame ? modbus_protocol().request_text(stations, to, *frame) : hex_text(request);
  }
  std::string command_text(const Device* to, Bytes request) const override {
    const auto frame = pty::rtu_of_ascii(request);
    return frame ? modbus_protocol().command_text(to, *frame) : std::string();
  }
  std::string reply_text(const LineStations& stations, const Device* to, Bytes request,
                         Bytes reply) const override {
    const auto frame = pty::rtu_of_ascii(reply);
    if (!frame) return hex_text(reply);
    const auto asked = pty::rtu_of_ascii(request);
    return modbus_protocol().reply_text(stations, to, asked ? Bytes(*asked) : Bytes(), *frame);
  }

  FrameFacts facts_of(const ReceivedFrame& frame) const override {
    const auto carried = pty::rtu_of_ascii(frame.bytes);
    if (!carried) return {.at = frame.now};
    ReceivedFrame same = frame;
    same.bytes = *carried;
    return modbus_protocol().facts_of(same);
  }
  /// Refuses faults that answer before the silence that ends a frame, because ASCII frames end with CR and
  /// LF.
  void require_possible(const std::string& device, const Fault& fault) const override {
    if (fault.kind != Fault::Kind::early_reply) return;
    throw NameError(std::string(fault_kind(fault.kind).name) + ": " + device +
                    " speaks Modbus ASCII, whose frames do not end by silence; expected another fault");
  }
};

}  // namespace

const LineProtocol& ascii_protocol() {
  static const AsciiLineProtocol protocol;
  return protocol;
}

}  // namespace understudy::emulator::world
