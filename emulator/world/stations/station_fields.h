// The fields of the stations' states (base/state/fields.h), in the order of the saved bytes.
#pragma once

#include <functional>
#include <utility>

#include "base/state/difference.h"
#include "base/state/fields.h"
#include "base/state/state_bytes.h"
#include "emulator/world/stations/ascii_station.h"
#include "emulator/world/stations/rtu_station.h"
#include "emulator/world/stations/text_station.h"
#include "pty/state_fields.h"

namespace understudy {

template <>
struct StateOf<emulator::world::StationCounters> {
  using Value = emulator::world::StationCounters;
  static constexpr auto fields =
      FieldList{field<&Value::requests>(), field<&Value::replies>(), field<&Value::exceptions>()};
};

template <>
struct StateOf<emulator::world::FaultyWire::Late> {
  using Value = emulator::world::FaultyWire::Late;
  static constexpr auto fields = FieldList{field<&Value::at>(), field<&Value::is_reply>(),
                                           field<&Value::last_character>(), field<&Value::bytes>()};
};

template <>
struct StateOf<emulator::world::RtuStation::State> {
  using Value = emulator::world::RtuStation::State;
  static constexpr auto fields =
      FieldList{field<&Value::framer>(), field<&Value::counters>(), field<&Value::late>()};
  static void check(const Value& state) { emulator::world::FaultyWire::check(state.late); }
};

template <>
struct StateOf<emulator::world::AsciiStation::State> {
  using Value = emulator::world::AsciiStation::State;
  static constexpr auto fields = FieldList{field<&Value::framer>(), field<&Value::counters>(),
                                           field<&Value::waiting>(), field<&Value::late>()};
  static void check(const Value& state);
};

template <>
struct StateOf<emulator::world::TextStation::Waiting> {
  using Value = emulator::world::TextStation::Waiting;
  static constexpr auto fields =
      FieldList{field<&Value::has_received>(), field<&Value::received>(), field<&Value::echo>()};
};

template <>
struct StateOf<emulator::world::TextStation::Outgoing> {
  using Value = emulator::world::TextStation::Outgoing;
  static constexpr auto fields = FieldList{field<&Value::last_character>(), field<&Value::text>()};
};

template <>
struct StateOf<emulator::world::TextStation::State> {
  using Value = emulator::world::TextStation::State;
  static constexpr auto fields =
      FieldList{field<&Value::lines>(),     field<&Value::counters>(), field<&Value::waiting>(),
                field<&Value::late>(),      field<&Value::outgoing>(), field<&Value::free_at>(),
                field<&Value::speaks_at>(), field<&Value::is_held>()};
  static void check(const Value& state);
};

}  // namespace understudy

namespace understudy::emulator::world {

/// Reads and checks a station's state. Calling the returned function puts it into effect.
template <class State>
std::function<void()> read_into(State& state, StateReader& reader) {
  State restored = state;  // includes members that are not read, such as the framing rules
  reader.read(restored);
  return [&state, restored = std::move(restored)] { state = restored; };
}

}  // namespace understudy::emulator::world
