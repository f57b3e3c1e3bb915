// The fields of a SLIM's state (base/state/fields.h), in the order of the bytes.
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
  static constexpr auto fields =
      FieldList{field("present", &Value::present), field("history", &Value::history)};
};

template <>
struct StateOf<emulator::models::slim::Memory> {
  using Value = emulator::models::slim::Memory;
  static constexpr auto fields =
      FieldList{field("parameters", &Value::parameters), field("integers", &Value::integers),
                field("reals", &Value::reals), field("integer_array", &Value::integer_array),
                field("real_array", &Value::real_array)};
  static void check(const Value& memory);
};

template <>
struct StateOf<emulator::models::slim::State> {
  using Value = emulator::models::slim::State;
  static constexpr auto fields = FieldList{field("ram", &Value::ram),
                                           field("kept", &Value::kept),
                                           field("kept_program", &Value::kept_program),
                                           field("kept_revision", &Value::kept_revision),
                                           field("chain", &Value::chain),
                                           field("program", &Value::program),
                                           field("editor", &Value::editor),
                                           field("execution", &Value::execution),
                                           field("errors", &Value::errors),
                                           field("inputs", &Value::inputs),
                                           field("powered_at", &Value::powered_at),
                                           field("clock_zero", &Value::clock_zero),
                                           field("speech", &Value::speech),
                                           field("touched", &Value::touched)};
  static void check(const Value& state);
};

}  // namespace understudy
