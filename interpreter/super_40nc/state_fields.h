// The state fields of running programs (base/state/fields.h), in the order of the saved bytes.
#pragma once

#include <cstddef>

#include "base/state/fields.h"
#include "base/state/state_bytes.h"
#include "interpreter/super_40nc/plc.h"
#include "interpreter/super_40nc/step_programs.h"

namespace understudy {

template <>
struct StateOf<interpreter::super_40nc::Targets> {
  static constexpr auto last = interpreter::super_40nc::Targets::relative;
};

template <>
struct StateOf<interpreter::super_40nc::Phase> {
  static constexpr auto last = interpreter::super_40nc::Phase::held;
};

template <>
struct StateOf<interpreter::super_40nc::Jogs> {
  using Value = interpreter::super_40nc::Jogs;
  static constexpr auto fields = FieldList{field<&Value::positive>(), field<&Value::negative>()};
};

template <>
struct StateOf<interpreter::super_40nc::PlcState> {
  using Value = interpreter::super_40nc::PlcState;
  static constexpr auto fields =
      FieldList{field<&Value::runs>(),    field<&Value::is_first_scan>(), field<&Value::memories>(),
                field<&Value::targets>(), field<&Value::rpm>(),           field<&Value::has_modes>(),
                field<&Value::jogs>(),    field<&Value::unit_ms>(),       field<&Value::timed>()};
  static void check(const Value& state) { require_reach(state.unit_ms); }
};

template <>
struct StateOf<interpreter::super_40nc::Call> {
  using Value = interpreter::super_40nc::Call;
  static constexpr auto fields =
      FieldList{field<&Value::back>(), field<&Value::label>(), field<&Value::passes>()};
};

template <>
struct StateOf<interpreter::super_40nc::StepState> {
  using Value = interpreter::super_40nc::StepState;
  static constexpr auto fields = FieldList{field<&Value::phase>(),
                                           field<&Value::resumes>(),
                                           field<&Value::is_paused_by_key>(),
                                           field<&Value::machine_holds>(),
                                           field<&Value::waits_to_resume>(),
                                           field<&Value::step>(),
                                           field<&Value::next_step>(),
                                           field<&Value::left_ms>(),
                                           field<&Value::wait_ms>(),
                                           field<&Value::calls>(),
                                           field<&Value::blocks>(),
                                           field<&Value::has_modes>(),
                                           field<&Value::targets>(),
                                           field<&Value::rpm>(),
                                           field<&Value::waits_for_drive>()};
  static constexpr std::size_t apart = 1;  // owns_pointer, which is always false between lines
  /// Accepts any step, because a program stops at a step where no instruction begins.
  static void check(const Value& state);
};

template <>
struct StateOf<interpreter::super_40nc::StepStates> {
  using Value = interpreter::super_40nc::StepStates;
  static constexpr auto fields = FieldList{field<&Value::programs>()};
};

}  // namespace understudy
