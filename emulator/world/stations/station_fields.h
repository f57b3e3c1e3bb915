// What the states of stations consist of (base/state/state_bytes.h).
#pragma once

#include "base/state/state_bytes.h"
#include "emulator/world/stations/rtu_station.h"
#include "emulator/world/stations/text_station.h"

namespace understudy::emulator::world {

struct StationFields {
  // clang-format off
  static void of(Like<StationCounters> auto& v, auto visit) { auto& [a, b, c] = v; visit(a, b, c); }

  static void of(Like<pty::RtuFramer::State::Character> auto& v, auto visit) {
    auto& [a, b, c] = v; visit(a, b, c);
  }
  static void of(Like<pty::RtuFramer::State::Frame> auto& v, auto visit) { auto& [a, b] = v; visit(a, b); }
  static void of(Like<pty::RtuFramer::State> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h, i] = v; visit(a, b, c, d, e, f, g, h, i);
  }
  static void of(Like<RtuStation::Late> auto& v, auto visit) { auto& [a, b, c, d] = v; visit(a, b, c, d); }
  static void of(Like<RtuStation::State> auto& v, auto visit) { auto& [a, b, c] = v; visit(a, b, c); }

  static void of(Like<pty::TextLines::State> auto& v, auto visit) {
    auto& [a, b, c, d] = v; visit(a, b, c, d);
  }
  static void of(Like<pty::HeardText> auto& v, auto visit) { auto& [a, b, c, d] = v; visit(a, b, c, d); }
  static void of(Like<TextStation::Waiting> auto& v, auto visit) { auto& [a, b, c] = v; visit(a, b, c); }
  static void of(Like<TextStation::Late> auto& v, auto visit) { auto& [a, b, c, d] = v; visit(a, b, c, d); }
  static void of(Like<TextStation::Outgoing> auto& v, auto visit) { auto& [a, b] = v; visit(a, b); }
  static void of(Like<TextStation::State> auto& v, auto visit) {
    auto& [a, b, c, d, e, f, g, h] = v; visit(a, b, c, d, e, f, g, h);
  }
  // clang-format on

  static constexpr pty::HeardText::What last(pty::HeardText::What) { return pty::HeardText::What::go_on; }
  static void check(const auto&) {}  // only the station decides what is possible
};

/// Reads a state of `station` and checks it; calling the result puts it in force.
template <class OneStation>
std::function<void()> read_state_of(OneStation& station, StateReader& reader) {
  typename OneStation::State state;
  reader.read<StationFields>(state);
  station.check(state);
  return [&station, state = std::move(state)] { station.restore(state); };
}

}  // namespace understudy::emulator::world
