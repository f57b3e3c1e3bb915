// The state fields of commands, downloads and running macros (base/state/fields.h), in the order of the saved
// bytes.
#pragma once

#include "base/state/fields.h"
#include "base/state/state_bytes.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/download.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/machine.h"
#include "interpreter/rs_m8194h/macro.h"
#include "interpreter/rs_m8194h/run.h"
#include "interpreter/rs_m8194h/triggers.h"

namespace understudy {

template <>
struct StateOf<interpreter::rs_m8194h::Fault> {
  static constexpr auto last = interpreter::rs_m8194h::Fault::macro_runs;
};

template <>
struct StateOf<interpreter::rs_m8194h::Hold> {
  static constexpr auto last = interpreter::rs_m8194h::Hold::machine;
};

template <>
struct StateOf<interpreter::rs_m8194h::TriggerCondition> {
  static constexpr auto last = interpreter::rs_m8194h::TriggerCondition::change;
};

template <>
struct StateOf<interpreter::rs_m8194h::TriggerEvent> {
  static constexpr auto last = interpreter::rs_m8194h::TriggerEvent::clear_stop;
};

/// A command is saved as the registers that the host would send.
template <>
struct StateOf<interpreter::rs_m8194h::Command> {
  static void write(const interpreter::rs_m8194h::Command& command, StateWriter& writer);
  static void read(interpreter::rs_m8194h::Command& command, StateReader& reader);
  /// Returns the command as text, for comparing two states.
  static std::string reported(const interpreter::rs_m8194h::Command& command);
};

template <>
struct StateOf<interpreter::rs_m8194h::MacroName> {
  using Value = interpreter::rs_m8194h::MacroName;
  static constexpr auto fields = FieldList{field<&Value::is_isr>(), field<&Value::number>()};
};

template <>
struct StateOf<interpreter::rs_m8194h::Download> {
  using Value = interpreter::rs_m8194h::Download;
  static constexpr auto fields =
      FieldList{field<&Value::name>(), field<&Value::lines>(), field<&Value::fault>(),
                field<&Value::code>(), field<&Value::line>(),  field<&Value::is_spoilt>()};
  static void check(const Value& download);
};

template <>
struct StateOf<interpreter::rs_m8194h::DownloadStatus> {
  using Value = interpreter::rs_m8194h::DownloadStatus;
  static constexpr auto fields =
      FieldList{field<&Value::mp>(), field<&Value::isr>(), field<&Value::command>(), field<&Value::line>(),
                field<&Value::error>()};
};

template <>
struct StateOf<interpreter::rs_m8194h::ExecutionFault> {
  using Value = interpreter::rs_m8194h::ExecutionFault;
  static constexpr auto fields =
      FieldList{field<&Value::macro>(), field<&Value::code>(), field<&Value::line>(), field<&Value::fault>()};
};

template <>
struct StateOf<interpreter::rs_m8194h::Trigger> {
  using Value = interpreter::rs_m8194h::Trigger;
  static constexpr auto fields =
      FieldList{field<&Value::condition>(), field<&Value::event>(), field<&Value::argument>()};
  static void check(const Value& trigger);
};

template <>
struct StateOf<interpreter::rs_m8194h::Loop> {
  using Value = interpreter::rs_m8194h::Loop;
  static constexpr auto fields = FieldList{field<&Value::line>(), field<&Value::left>()};
};

template <>
struct StateOf<interpreter::rs_m8194h::Level> {
  using Value = interpreter::rs_m8194h::Level;
  static constexpr auto fields =
      FieldList{field<&Value::number>(), field<&Value::line>(), field<&Value::loops>()};
};

template <>
struct StateOf<interpreter::rs_m8194h::Run> {
  using Value = interpreter::rs_m8194h::Run;
  static constexpr auto fields =
      FieldList{field<&Value::is_isr>(),   field<&Value::levels>(),  field<&Value::hold>(),
                field<&Value::until_ms>(), field<&Value::awaited>(), field<&Value::saw_other_level>()};
  static void check(const Value& run);
};

template <>
struct StateOf<interpreter::rs_m8194h::ReturnRegister> {
  using Value = interpreter::rs_m8194h::ReturnRegister;
  static constexpr auto fields = FieldList{field<&Value::value>(), field<&Value::is_full>()};
};

/// After a restore, the execution must also pass is_sound() with the macros of its machine.
template <>
struct StateOf<interpreter::rs_m8194h::Execution> {
  using Value = interpreter::rs_m8194h::Execution;
  static constexpr auto fields = FieldList{field<&Value::mp>(), field<&Value::isrs>(),
                                           field<&Value::mp_return>(), field<&Value::isr_return>()};
  static void check(const Value& execution);
};

}  // namespace understudy
