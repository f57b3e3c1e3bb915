// The state fields of a program and its execution (base/state/fields.h), in the order of the saved bytes.
#pragma once

#include <string>

#include "base/state/fields.h"
#include "base/state/state_bytes.h"
#include "interpreter/simple2/execution/execution.h"
#include "interpreter/simple2/program.h"

namespace understudy::interpreter::simple2 {

/// The parts of a program that describe how it differs from another program.
struct ReportedProgram {
  Lines lines{};
  FlagRules flag_rules{};
  FlagLines flag_lines{};
};

}  // namespace understudy::interpreter::simple2

namespace understudy {

template <>
struct StateOf<interpreter::simple2::Ending> {
  static constexpr auto last = interpreter::simple2::Ending::wait_cut_short;
};

template <>
struct StateOf<interpreter::simple2::Phase> {
  static constexpr auto last = interpreter::simple2::Phase::move;
};

template <>
struct StateOf<interpreter::simple2::FlagRules::Several> {
  static constexpr auto last = interpreter::simple2::FlagRules::Several::last_written;
};

template <>
struct StateOf<interpreter::simple2::FlagRules::AfterEnd> {
  static constexpr auto last = interpreter::simple2::FlagRules::AfterEnd::do_not_count;
};

template <>
struct StateOf<interpreter::simple2::FlagRules::Found> {
  static constexpr auto last = interpreter::simple2::FlagRules::Found::on_request;
};

template <>
struct StateOf<interpreter::simple2::LoopState> {
  using Value = interpreter::simple2::LoopState;
  static constexpr auto fields = FieldList{field<&Value::counts>(), field<&Value::first_line>(),
                                           field<&Value::loop_line>(), field<&Value::passes>()};
};

template <>
struct StateOf<interpreter::simple2::Line> {
  using Value = interpreter::simple2::Line;
  static constexpr auto fields = FieldList{field<&Value::command>(), field<&Value::data1>(),
                                           field<&Value::data2>(), field<&Value::flag>()};
};

template <>
struct StateOf<interpreter::simple2::FlagRules> {
  using Value = interpreter::simple2::FlagRules;
  static constexpr auto fields =
      FieldList{field<&Value::several>(), field<&Value::after_end>(), field<&Value::found>()};
};

template <>
struct StateOf<interpreter::simple2::Execution> {
  using Value = interpreter::simple2::Execution;
  static constexpr auto fields =
      FieldList{field<&Value::running>(),     field<&Value::ending>(),      field<&Value::now_line>(),
                field<&Value::next_line>(),   field<&Value::phase>(),       field<&Value::delay_until_ms>(),
                field<&Value::waits_for_a>(), field<&Value::waits_for_b>(), field<&Value::waits>(),
                field<&Value::loop>(),        field<&Value::held>()};
  static void check(const Value& execution);
};

/// The lines of a program, and the flags that the lines do not determine.
template <>
struct StateOf<interpreter::simple2::ReportedProgram> {
  using Value = interpreter::simple2::ReportedProgram;
  static constexpr auto fields =
      FieldList{field<&Value::lines>(), field<&Value::flag_rules>(), field<&Value::flag_lines>()};
};

template <>
struct StateOf<interpreter::simple2::Program> {
  static void write(const interpreter::simple2::Program& program, StateWriter& writer);
  static void read(interpreter::simple2::Program& program, StateReader& reader);
  static interpreter::simple2::ReportedProgram reported(const interpreter::simple2::Program& program) {
    return {program.lines(), program.flag_rules(), program.flag_lines()};
  }
};

}  // namespace understudy
