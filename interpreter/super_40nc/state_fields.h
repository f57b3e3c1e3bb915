// The state fields of running programs (base/state/fields.h), in the order of the bytes.
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
  static constexpr auto fields =
      FieldList{field("positive", &Value::positive), field("negative", &Value::negative)};
};

template <>
struct StateOf<interpreter::super_40nc::PlcState> {
  using Value = interpreter::super_40nc::PlcState;
  static constexpr auto fields =
      FieldList{field("runs", &Value::runs),         field("is_first_scan", &Value::is_first_scan),
                field("memories", &Value::memories), field("targets", &Value::targets),
                field("rpm", &Value::rpm),           field("has_modes", &Value::has_modes),
                field("jogs", &Value::jogs),         field("unit_ms", &Value::unit_ms),
                field("timed", &Value::timed)};
  static void check(const Value& state) { require_reach(state.unit_ms); }
};

template <>
struct StateOf<interpreter::super_40nc::Call> {
  using Value = interpreter::super_40nc::Call;
  static constexpr auto fields =
      FieldList{field("back", &Value::back), field("label", &Value::label), field("passes", &Value::passes)};
};

template <>
struct StateOf<interpreter::super_40nc::StepState> {
  using Value = interpreter::super_40nc::StepState;
  static constexpr auto fields = FieldList{field("phase", &Value::phase),
                                           field("resumes", &Value::resumes),
                                           field("is_paused_by_key", &Value::is_paused_by_key),
                                           field("machine_holds", &Value::machine_holds),
                                           field("waits_to_resume", &Value::waits_to_resume),
                                           field("step", &Value::step),
                                           field("next_step", &Value::next_step),
                                           field("left_ms", &Value::left_ms),
                                           field("wait_ms", &Value::wait_ms),
                                           field("calls", &Value::calls),
                                           field("blocks", &Value::blocks),
                                           field("has_modes", &Value::has_modes),
                                           field("targets", &Value::targets),
                                           field("rpm", &Value::rpm),
                                           field("waits_for_drive", &Value::waits_for_drive)};
  static constexpr std::size_t apart = 1;  // owns_pointer: false between lines
  /// Accepts any step: a program stops at a step at which no instruction begins.
  static void check(const Value& state);
};

template <>
struct StateOf<interpreter::super_40nc::StepStates> {
  using Value = interpreter::super_40nc::StepStates;
  static constexpr auto fields = FieldList{field("programs", &Value::programs)};
};

}  // namespace understudy
