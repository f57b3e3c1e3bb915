#include "emulator/world/stations/ascii_station.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "base/state/difference.h"
#include "base/state/state_bytes.h"
#include "base/state/state_error.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/world/stations/faulty_wire.h"
#include "emulator/world/stations/frame_faults.h"
#include "emulator/world/stations/modbus_answer.h"
#include "emulator/world/stations/station_fields.h"
#include "pty/ascii_frame.h"
#include "pty/ascii_framer.h"
#include "pty/state_reach.h"
#include "pty/station.h"

namespace understudy {

void StateOf<emulator::world::AsciiStation::State>::check(const emulator::world::AsciiStation::State& state) {
  emulator::world::FaultyWire::check(state.late);
  const auto require = [](bool holds) { require_state(holds, "the frames of a station are not valid"); };
  require(state.waiting.size() <= 1);
  for (const pty::AsciiFrame& frame : state.waiting)
    require(pty::rtu_of_ascii(frame.bytes) == frame.rtu && pty::is_within_reach(frame.end));
}

}  // namespace understudy

namespace understudy::emulator::world {

namespace {

ReceivedFrame received_frame(const Device& device, const pty::AsciiFrame& frame, pty::SimTime now) {
  return {.bytes = frame.bytes,
          .last_character = frame.last_character,
          .is_for_device = device.modbus()->addressing(frame.rtu[0]) != Addressing::ignore,
          .now = now};
}

}  // namespace

// Without power, a station receives nothing.
void AsciiStation::receive(const pty::TimedByte& byte) {
  if (!device_.powered()) return;
  if (auto frame = state_.framer.push(byte)) state_.waiting.push_back(*std::move(frame));
}

std::optional<pty::SimTime> AsciiStation::due() const {
  const std::optional<pty::SimTime> wire = wire_.due();
  if (state_.waiting.empty()) return wire;
  const pty::SimTime frame = state_.waiting.front().end;
  return wire ? std::min(frame, *wire) : frame;
}

void AsciiStation::run(pty::SimTime now, pty::Transmitter& out) {
  wire_.run(now, out);
  for (const pty::AsciiFrame& frame : std::exchange(state_.waiting, {})) {
    if (wire_.passes(received_frame(device_, frame, now), out)) serve_frame(frame, now, out);
  }
}

void AsciiStation::reset() {
  state_.framer.reset();
  state_.waiting.clear();
  wire_.reset();
}

void AsciiStation::serve_frame(const pty::AsciiFrame& frame, pty::SimTime now, pty::Transmitter& out) {
  const ReceivedFrame request = received_frame(device_, frame, now);
  ReplyFrame reply;
  const std::size_t size = answer_frame(device_, wire_, counters_, request, frame.rtu, reply, out);
  if (size == 0) return;
  wire_.answer(request, pty::ascii_of_rtu(std::span(reply).first(size)), out,
               device_.modbus()->reply_delay());
}

void AsciiStation::serve_piece(std::span<const std::uint8_t> bytes, std::uint64_t last_character,
                               pty::SimTime now, pty::Transmitter& out) {
  for (const std::uint8_t value : bytes) {
    const auto frame =
        state_.framer.push({.start = now, .end = now, .value = value, .number = last_character});
    if (frame) serve_frame(*frame, now, out);
  }
}

void AsciiStation::transmit(std::span<const std::uint8_t> bytes, std::uint64_t last_character,
                            pty::Transmitter& out) {
  out.answer(bytes, last_character);
}

void AsciiStation::write_state(StateWriter& writer) const { writer.write(state_); }

std::function<void()> AsciiStation::read_state(StateReader& reader) { return read_into(state_, reader); }

std::string AsciiStation::difference(StateReader& a, StateReader& b, const std::string& path) const {
  return difference_of_saved<State>(a, b, path);
}

}  // namespace understudy::emulator::world
