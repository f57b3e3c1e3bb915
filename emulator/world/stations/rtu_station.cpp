#include "emulator/world/stations/rtu_station.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "base/state/difference.h"
#include "base/state/state_bytes.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/world/stations/frame_faults.h"
#include "emulator/world/stations/server.h"
#include "emulator/world/stations/station_fields.h"
#include "pty/line_settings.h"
#include "pty/rtu_crc.h"
#include "pty/rtu_framer.h"
#include "pty/station.h"

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

std::optional<pty::SimTime> RtuStation::due() const {
  const std::optional<pty::SimTime> frame = state_.framer.due();
  const std::optional<pty::SimTime> wire = wire_.due();
  return frame && wire ? std::min(frame, wire) : frame ? frame : wire;
}

void RtuStation::run(pty::SimTime now, pty::Transmitter& out) {
  wire_.run(now, out);
  if (wire_.take_early_frame()) {
    if (const auto frame = state_.framer.take_early()) take_frame(*frame, now, out);
  }
  while (const auto frame = state_.framer.take_due(now)) {
    report_errors(state_.framer);  // errors before the frame come first
    take_frame(*frame, now, out);
  }
  report_errors(state_.framer);
}

void RtuStation::reset() {
  state_.framer.reset();
  wire_.reset();
}

// --- receiving -----------------------------------------------------------------------------------

void RtuStation::report_each_error(pty::RtuFramer& framer) {
  while (const auto error = framer.take_error()) device_.modbus()->receive_failed(port_, *error);
}

ReceivedFrame RtuStation::received_frame(const pty::RtuFrame& frame, pty::SimTime now) const {
  return {.bytes = std::span(frame.bytes).first(frame.size),
          .last_character = frame.last_character,
          .is_for_device = device_.modbus()->addressing(frame.bytes[0]) != Addressing::ignore,
          .now = now};
}

/// Checks the frame if the character with that number completes one.
void RtuStation::check_completed(std::uint64_t last_character, pty::SimTime now) {
  const auto frame = state_.framer.peek();
  if (frame && frame->last_character == last_character) wire_.check_completed(received_frame(*frame, now));
}

void RtuStation::take_frame(const pty::RtuFrame& frame, pty::SimTime now, pty::Transmitter& out) {
  if (wire_.passes(received_frame(frame, now), out)) serve_frame(frame, now, out);
}

void RtuStation::serve_piece(std::span<const std::uint8_t> bytes, std::uint64_t last_character,
                             pty::SimTime now, pty::Transmitter& out) {
  constexpr pty::SimTime kInstant{1};
  pty::RtuFramer framer(
      {.strict = state_.framer.framing().strict, .silence = kInstant, .patience = kInstant});
  for (const std::uint8_t value : bytes) {
    framer.push({.start = now, .end = now, .value = value, .number = last_character});
  }
  while (const auto frame = framer.take(now + kInstant)) serve_frame(*frame, now, out);
  report_errors(framer);
}

void RtuStation::serve_frame(const pty::RtuFrame& frame, pty::SimTime now, pty::Transmitter& out) {
  const std::uint8_t address = frame.bytes[0];
  const Addressing addressing = device_.modbus()->addressing(address);
  if (addressing == Addressing::ignore) return;
  ++counters_.requests;
  const ReceivedFrame request = received_frame(frame, now);
  const FrameFaults::Treatment treatment = wire_.treatment_of(request);
  const ModbusReply reply = treatment.exception != 0
                                ? refusal(frame.bytes[1], treatment.exception)
                                : serve(device_, std::span(frame.bytes).subspan(1, frame.size - 3));
  if (addressing == Addressing::execute_silently || !treatment.is_answered) return;

  const bool refuses = (reply.pdu[0] & 0x80) != 0;
  if (refuses && treatment.exception == 0 && !device_.modbus()->answers_refusals()) return;

  ++counters_.replies;
  if (refuses) ++counters_.exceptions;
  if (reply.refused.objection) device_.register_bank()->exception_answered(reply.refused);
  std::array<std::uint8_t, pty::kRtuMaxFrame> buffer;
  buffer[0] = address;
  std::copy_n(reply.pdu.begin(), reply.size, buffer.begin() + 1);
  wire_.answer(request, std::span(buffer).first(pty::append_rtu_crc(buffer, reply.size + 1)), out,
               device_.modbus()->reply_delay());
}

void RtuStation::transmit(std::span<const std::uint8_t> bytes, std::uint64_t last_character,
                          pty::Transmitter& out) {
  out.answer(bytes, last_character);
}

// --- state ---------------------------------------------------------------------------------------

void RtuStation::write_state(StateWriter& writer) const { writer.write(state_); }

std::function<void()> RtuStation::read_state(StateReader& reader) { return read_into(state_, reader); }

std::string RtuStation::difference(StateReader& a, StateReader& b, const std::string& path) const {
  return difference_of_saved<State>(a, b, path);
}

}  // namespace understudy::emulator::world
