// Lists the fields of stations' states (base/state/fields.h), in the order of the bytes.
#pragma once

#include <functional>
#include <utility>

#include "base/state/difference.h"
#include "base/state/fields.h"
#include "base/state/state_bytes.h"
#include "emulator/world/stations/rtu_station.h"
#include "emulator/world/stations/text_station.h"
#include "pty/state_fields.h"

namespace understudy {

template <>
struct StateOf<emulator::world::StationCounters> {
  using Value = emulator::world::StationCounters;
  static constexpr auto fields =
      FieldList{field("requests", &Value::requests), field("replies", &Value::replies),
                field("exceptions", &Value::exceptions)};
};

template <>
struct StateOf<emulator::world::FaultyWire::Late> {
  using Value = emulator::world::FaultyWire::Late;
  static constexpr auto fields =
      FieldList{field("at", &Value::at), field("is_reply", &Value::is_reply),
                field("last_character", &Value::last_character), field("bytes", &Value::bytes)};
};

template <>
struct StateOf<emulator::world::RtuStation::State> {
  using Value = emulator::world::RtuStation::State;
  static constexpr auto fields = FieldList{field("framer", &Value::framer),
                                           field("counters", &Value::counters), field("late", &Value::late)};
  static void check(const Value& state) { emulator::world::FaultyWire::check(state.late); }
};

template <>
struct StateOf<emulator::world::TextStation::Waiting> {
  using Value = emulator::world::TextStation::Waiting;
  static constexpr auto fields = FieldList{field("has_heard", &Value::has_heard),
                                           field("heard", &Value::heard), field("echo", &Value::echo)};
};

template <>
struct StateOf<emulator::world::TextStation::Outgoing> {
  using Value = emulator::world::TextStation::Outgoing;
  static constexpr auto fields =
      FieldList{field("last_character", &Value::last_character), field("text", &Value::text)};
};

template <>
struct StateOf<emulator::world::TextStation::State> {
  using Value = emulator::world::TextStation::State;
  static constexpr auto fields =
      FieldList{field("lines", &Value::lines),         field("counters", &Value::counters),
                field("waiting", &Value::waiting),     field("late", &Value::late),
                field("outgoing", &Value::outgoing),   field("free_at", &Value::free_at),
                field("speaks_at", &Value::speaks_at), field("is_held", &Value::is_held)};
  static void check(const Value& state);
};

}  // namespace understudy

namespace understudy::emulator::world {

/// Reads and checks a station's state. Calling the result puts it in force.
template <class State>
std::function<void()> read_into(State& state, StateReader& reader) {
  State restored = state;  // includes members that are not read, such as the framing rules
  reader.read(restored);
  return [&state, restored = std::move(restored)] { state = restored; };
}

}  // namespace understudy::emulator::world
