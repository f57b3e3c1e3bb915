// The fields of a SLIM's state (base/state/fields.h), in the order of the saved bytes.
#pragma once

#include <string>

#include "base/state/fields.h"
#include "emulator/models/slim/chain/chain_fields.h"
#include "emulator/models/slim/state.h"
#include "interpreter/slim/state_fields.h"

namespace understudy {

template <>
struct StateOf<emulator::models::slim::Errors> {
  using Value = emulator::models::slim::Errors;
  static constexpr auto fields = FieldList{field<&Value::present>(), field<&Value::history>()};
};

template <>
struct StateOf<emulator::models::slim::Memory> {
  using Value = emulator::models::slim::Memory;
  static constexpr auto fields =
      FieldList{field<&Value::parameters>(), field<&Value::integers>(), field<&Value::reals>(),
                field<&Value::integer_array>(), field<&Value::real_array>()};
  static void check(const Value& memory);
};

template <>
struct StateOf<emulator::models::slim::State> {
  using Value = emulator::models::slim::State;
  static constexpr auto fields = FieldList{field<&Value::ram>(),          field<&Value::kept>(),
                                           field<&Value::kept_program>(), field<&Value::memory_revision>(),
                                           field<&Value::chain>(),        field<&Value::program>(),
                                           field<&Value::editor>(),       field<&Value::execution>(),
                                           field<&Value::errors>(),       field<&Value::inputs>(),
                                           field<&Value::powered_at>(),   field<&Value::clock_zero>(),
                                           field<&Value::output>(),       field<&Value::touched>()};
  static void check(const Value& state);
};

}  // namespace understudy
