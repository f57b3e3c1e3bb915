#include "emulator/world/stations/text_station.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/state/difference.h"
#include "base/state/state_bytes.h"
#include "base/state/state_error.h"
#include "emulator/device/device.h"
#include "emulator/device/text/text_protocol.h"
#include "emulator/world/stations/faulty_wire.h"
#include "emulator/world/stations/frame_faults.h"
#include "emulator/world/stations/line_station.h"
#include "emulator/world/stations/station_fields.h"
#include "pty/state_reach.h"
#include "pty/station.h"
#include "pty/text_lines.h"

namespace understudy {

void StateOf<emulator::world::TextStation::State>::check(const emulator::world::TextStation::State& state) {
  emulator::world::FaultyWire::check(state.late);
  const auto require = [](bool holds) { require_state(holds, "the texts of a station are not valid"); };
  require(state.waiting.size() <= 1);
  for (const auto& waiting : state.waiting) require(pty::is_within_reach(waiting.received.end));
  for (const auto& outgoing : state.outgoing) require(!outgoing.text.empty());
  require(state.free_at >= pty::SimTime{0} && pty::is_within_reach(state.free_at));
  require(!state.speaks_at || pty::is_within_reach(*state.speaks_at));
}

}  // namespace understudy

namespace understudy::emulator::world {

using Received = pty::ReceivedText::What;

namespace {

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// Returns a line as a frame. For the wire, it includes the line ending; for the device, it does not.
ReceivedFrame frame_of(std::string_view text, std::uint64_t last_character, pty::SimTime now) {
  return {.bytes = bytes_of(text), .last_character = last_character, .is_for_device = true, .now = now};
}

pty::TextLineRules rules_of(const TextProtocol& protocol) {
  const TextRules rules = protocol.text_rules();
  return {.longest = rules.longest_line,
          .echoes = rules.echo,
          .line_feed_ends = rules.line_feed_ends,
          .has_flow_control = rules.has_flow_control,
          .echoed_end = rules.echoed_end};
}

TextProtocol& text_protocol_of(Device& device) {
  if (device.text_protocol() == nullptr) throw std::logic_error(device.name() + ": does not speak text");
  return *device.text_protocol();
}

}  // namespace

TextStation::TextStation(Device& device, std::size_t port, bool is_instant)
    : LineStation(device, port, state_.counters, state_.late),
      protocol_(text_protocol_of(device)),
      is_instant_(is_instant) {}

void TextStation::receive(const pty::TimedByte& byte) {
  if (!device_.powered()) return;
  const pty::TextLineRules rules = rules_of(protocol_);
  pty::TextLines::Outcome outcome = state_.lines.push(byte, rules);
  if (!rules.echoes) outcome.echo.clear();
  if (!outcome.received && outcome.echo.empty()) return;
  pty::ReceivedText received{.end = byte.end, .last_character = byte.number};
  if (outcome.received) received = std::move(*outcome.received);
  state_.waiting.push_back({outcome.received.has_value(), std::move(received), std::move(outcome.echo)});
}

std::optional<pty::SimTime> TextStation::due() const {
  std::optional<pty::SimTime> due = wire_.due();
  const auto offer = [&](pty::SimTime at) { due = std::min(due.value_or(at), at); };
  if (!state_.waiting.empty()) offer(state_.waiting.front().received.end);
  if (state_.is_held) return due;
  if (!state_.outgoing.empty()) offer(state_.free_at);
  if (state_.speaks_at) offer(*state_.speaks_at);
  return due;
}

void TextStation::run(pty::SimTime now, pty::Transmitter& out) {
  wire_.run(now, out);
  for (const Waiting& waiting : std::exchange(state_.waiting, {})) {
    if (!waiting.echo.empty()) echo(waiting, out);
    if (waiting.has_received) carry_out(waiting.received, now, out);
  }
  send(now, out);
  if (state_.is_held || !state_.speaks_at || *state_.speaks_at > now) return;
  state_.speaks_at.reset();
  if (!state_.outgoing.empty() || state_.free_at > now) {
    state_.speaks_at = state_.free_at;
  } else if (protocol_.has_text()) {
    state_.outgoing.push_back({.text = protocol_.take_text()});
    send(now, out);
  }
}

void TextStation::reset() {
  state_.lines.reset();
  state_.waiting.clear();
  wire_.reset();
  state_.outgoing.clear();
  state_.free_at = pty::SimTime{0};
  state_.speaks_at.reset();
  state_.is_held = false;
}

bool TextStation::poll_text(pty::SimTime now) {
  if (state_.speaks_at || !device_.powered() || !protocol_.has_text()) return false;
  state_.speaks_at = std::max(now, state_.free_at);
  return true;
}

// --- receiving -----------------------------------------------------------------------------------

void TextStation::echo(const Waiting& waiting, pty::Transmitter& out) {
  if (!state_.is_held) return out.answer(bytes_of(waiting.echo), waiting.received.last_character);
  if (outgoing_size() < kMaxOutgoing)
    state_.outgoing.push_back({waiting.received.last_character, waiting.echo});
}

void TextStation::carry_out(const pty::ReceivedText& received, pty::SimTime now, pty::Transmitter& out) {
  const bool is_whole = received.what != Received::line ||
                        wire_.passes(frame_of(received.text + '\r', received.last_character, now), out);
  if (is_whole) serve(received, now, out);
}

void TextStation::serve_piece(std::span<const std::uint8_t> bytes, std::uint64_t last_character,
                              pty::SimTime now, pty::Transmitter& out) {
  for (const std::uint8_t value : bytes) {
    auto outcome = state_.lines.push({.start = now, .end = now, .value = value, .number = last_character},
                                     rules_of(protocol_));
    if (outcome.received) serve(*outcome.received, now, out);
  }
}

void TextStation::serve(const pty::ReceivedText& received, pty::SimTime now, pty::Transmitter& out) {
  const ReceivedFrame request = frame_of(received.text, received.last_character, now);
  FrameFaults::Treatment treatment;
  switch (received.what) {
    case Received::line:
      ++counters_.requests;
      treatment = wire_.treatment_of(request);
      protocol_.receive_line(received.text);
      break;
    case Received::overlong: protocol_.receive_overlong(); break;
    case Received::escape: protocol_.receive_escape(); break;
    case Received::hold: state_.is_held = true; return;
    case Received::release: state_.is_held = false; return;
  }
  if (!protocol_.has_text() || outgoing_size() >= kMaxOutgoing) return;
  const std::string text = protocol_.take_text();
  if (!treatment.is_answered || text.empty()) return;
  ++counters_.replies;
  wire_.answer(request, bytes_of(text), out);
}

// --- sending -------------------------------------------------------------------------------------

void TextStation::transmit(std::span<const std::uint8_t> bytes, std::uint64_t last_character,
                           pty::Transmitter& /*out*/) {
  state_.outgoing.push_back({last_character, {bytes.begin(), bytes.end()}});
}

void TextStation::send(pty::SimTime now, pty::Transmitter& out) {
  const std::size_t piece =
      is_instant_ || !protocol_.text_rules().has_flow_control ? kPiece : kPieceThatCanBeHeld;
  while (!state_.is_held && !state_.outgoing.empty() && state_.free_at <= now) {
    Outgoing& first = state_.outgoing.front();
    const std::size_t size = std::min(first.text.size(), piece);
    const auto bytes = bytes_of(std::string_view(first.text).substr(0, size));
    if (first.last_character == 0) {
      out.transmit(bytes);
    } else {
      out.answer(bytes, first.last_character);
    }
    // A long text takes time even if characters do not, because no host could read it that fast.
    const bool takes_time = !is_instant_ || size == kPiece;
    if (takes_time) state_.free_at = now + settings().duration_of(static_cast<std::int64_t>(size));
    first.text.erase(0, size);
    if (first.text.empty()) state_.outgoing.erase(state_.outgoing.begin());
  }
}

std::size_t TextStation::outgoing_size() const {
  std::size_t size = 0;
  for (const Outgoing& outgoing : state_.outgoing) size += outgoing.text.size();
  return size;
}

// --- state ---------------------------------------------------------------------------------------

void TextStation::write_state(StateWriter& writer) const { writer.write(state_); }

std::function<void()> TextStation::read_state(StateReader& reader) { return read_into(state_, reader); }

std::string TextStation::difference(StateReader& a, StateReader& b, const std::string& path) const {
  return difference_of_saved<State>(a, b, path);
}

}  // namespace understudy::emulator::world
