// The kinds of faults, and their fields in text form.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "emulator/world/faults/fault.h"

namespace understudy::emulator::world {

/// A field of a kind, in addition to those of the trigger, and the member that it sets.
struct FaultFieldRow {
  enum class ValueType : std::uint8_t { number, level, duration, ticks, even_ticks, bytes, side };
  std::string_view name;
  ValueType type = ValueType::number;
  bool required = true;
  std::int64_t lowest = 0;
  std::int64_t highest = 0;
  std::int64_t Fault::*number = &Fault::amount;
  std::vector<std::uint8_t> Fault::*bytes = nullptr;
};

struct FaultKindRow {
  enum class Place : std::uint8_t {
    axis,
    wheel,  // a hand wheel on an axis, or a counted input
    input,
    device,
    device_or_line,
    line,
  };
  std::string_view name;
  Fault::Kind kind;
  Place place;
  std::span<const FaultFieldRow> fields;
  std::string_view effect;               // for faults of messages: the effect, for observers
  std::string_view effect_on_request{};  // the same for a request; empty if it does not differ
};

/// Returns the rows in the order of Fault::Kind.
std::span<const FaultKindRow> fault_kinds();
inline const FaultKindRow& fault_kind(Fault::Kind kind) {
  return fault_kinds()[static_cast<std::size_t>(kind)];
}

}  // namespace understudy::emulator::world
