#include "emulator/world/stations/modbus_answer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/reasons.h"
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

/// Returns the number of the first reason that the device gives for the request that is served now.
std::uint64_t begin_reasons(Device& device) {
  Reasons* const reasons = device.modbus()->reasons();
  if (reasons == nullptr) return 0;
  reasons->begin_request();
  return reasons->next_number();
}

/// Returns why the request had no effect or was refused, as far as the device says so.
std::string why_without_effect(Device& device, std::uint64_t first_reason, const ModbusReply& reply) {
  if (const int number = reply.refused.objection.reason; number != 0) {
    const std::string_view meaning = device.modbus()->meaning_of_reason(number);
    if (!meaning.empty()) return "reason " + std::to_string(number) + ": " + std::string(meaning);
  }
  const Reasons* const reasons = device.modbus()->reasons();
  if (reasons == nullptr || reasons->next_number() == first_reason) return {};
  std::string text;
  for (const Reasons::Said& said : reasons->since(first_reason))
    text += (text.empty() ? "" : "; ") + said.text;
  return text;
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
  const std::uint64_t first_reason = begin_reasons(device);
  const ModbusReply reply = treatment.exception != 0 ? refusal(frame[1], treatment.exception)
                                                     : serve(device, frame.subspan(1, frame.size() - 3));
  const std::string why = why_without_effect(device, first_reason, reply);
  out.served(frame, std::span(reply.pdu).first(reply.size), request.last_character, why);
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
