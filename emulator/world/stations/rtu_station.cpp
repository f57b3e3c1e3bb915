#include "emulator/world/stations/rtu_station.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "base/state/difference.h"
#include "base/state/state_bytes.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/world/stations/frame_faults.h"
#include "emulator/world/stations/modbus_answer.h"
#include "emulator/world/stations/station_fields.h"
#include "pty/line_settings.h"
#include "pty/rtu_framer.h"
#include "pty/station.h"

namespace understudy::emulator::world {

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
    report_errors(state_.framer);  // errors that precede the frame come first
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
  const ReceivedFrame request = received_frame(frame, now);
  ReplyFrame reply;
  const std::size_t size =
      answer_frame(device_, wire_, counters_, request, std::span(frame.bytes).first(frame.size), reply, out);
  if (size == 0) return;
  wire_.answer(request, std::span(reply).first(size), out, device_.modbus()->reply_delay());
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
