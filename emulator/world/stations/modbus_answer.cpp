#include "emulator/world/stations/modbus_answer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/world/stations/frame_faults.h"
#include "emulator/world/stations/server.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::world {

namespace {

ModbusReply refusal(std::uint8_t function, int exception) {
  ModbusReply reply;
  reply.pdu[0] = function | 0x80;
  reply.pdu[1] = static_cast<std::uint8_t>(exception);
  reply.size = 2;
  return reply;
}

}  // namespace

std::size_t answer_frame(Device& device, FaultyWire& wire, StationCounters& counters,
                         const ReceivedFrame& request, std::span<const std::uint8_t> frame,
                         ReplyFrame& reply_frame, pty::Transmitter& out) {
  const std::uint8_t address = frame[0];
  const Addressing addressing = device.modbus()->addressing(address);
  if (addressing == Addressing::ignore) return 0;
  ++counters.requests;
  const FrameFaults::Treatment treatment = wire.treatment_of(request);
  const ModbusReply reply = treatment.exception != 0 ? refusal(frame[1], treatment.exception)
                                                     : serve(device, frame.subspan(1, frame.size() - 3));
  out.served(frame, std::span(reply.pdu).first(reply.size), request.last_character);
  if (addressing == Addressing::execute_silently || !treatment.is_answered) return 0;

  const bool refuses = (reply.pdu[0] & 0x80) != 0;
  if (refuses && treatment.exception == 0 && !device.modbus()->answers_refusals()) return 0;

  ++counters.replies;
  if (refuses) ++counters.exceptions;
  if (reply.refused.objection) device.register_bank()->exception_answered(reply.refused);
  reply_frame[0] = address;
  std::copy_n(reply.pdu.begin(), reply.size, reply_frame.begin() + 1);
  return pty::append_rtu_crc(reply_frame, reply.size + 1);
}

}  // namespace understudy::emulator::world
