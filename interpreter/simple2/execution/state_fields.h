// The state fields of a program and its run (base/state/fields.h), in the order of the bytes.
#pragma once

#include <string>

#include "base/state/fields.h"
#include "base/state/state_bytes.h"
#include "interpreter/simple2/execution/execution.h"
#include "interpreter/simple2/program.h"

namespace understudy::interpreter::simple2 {

/// The parts of a program that describe its differences from another one.
struct ToldProgram {
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
  static constexpr auto last = interpreter::simple2::FlagRules::Found::when_told;
};

template <>
struct StateOf<interpreter::simple2::LoopState> {
  using Value = interpreter::simple2::LoopState;
  static constexpr auto fields =
      FieldList{field("counts", &Value::counts), field("first_line", &Value::first_line),
                field("loop_line", &Value::loop_line), field("passes", &Value::passes)};
};

template <>
struct StateOf<interpreter::simple2::Line> {
  using Value = interpreter::simple2::Line;
  static constexpr auto fields = FieldList{field("command", &Value::command), field("data1", &Value::data1),
                                           field("data2", &Value::data2), field("flag", &Value::flag)};
};

template <>
struct StateOf<interpreter::simple2::FlagRules> {
  using Value = interpreter::simple2::FlagRules;
  static constexpr auto fields =
      FieldList{field("several", &Value::several), field("after_end", &Value::after_end),
                field("found", &Value::found)};
};

template <>
struct StateOf<interpreter::simple2::Execution> {
  using Value = interpreter::simple2::Execution;
  static constexpr auto fields = FieldList{field("running", &Value::running),
                                           field("ending", &Value::ending),
                                           field("now_line", &Value::now_line),
                                           field("next_line", &Value::next_line),
                                           field("phase", &Value::phase),
                                           field("delay_until_ms", &Value::delay_until_ms),
                                           field("waits_for_a", &Value::waits_for_a),
                                           field("waits_for_b", &Value::waits_for_b),
                                           field("waits", &Value::waits),
                                           field("loop", &Value::loop),
                                           field("held", &Value::held)};
  static void check(const Value& execution);
};

/// A program's lines, and the flags that do not follow from them.
template <>
struct StateOf<interpreter::simple2::ToldProgram> {
  using Value = interpreter::simple2::ToldProgram;
  static constexpr auto fields =
      FieldList{field("lines", &Value::lines), field("flag_rules", &Value::flag_rules),
                field("flag_lines", &Value::flag_lines)};
};

template <>
struct StateOf<interpreter::simple2::Program> {
  static void write(const interpreter::simple2::Program& program, StateWriter& writer);
  static void read(interpreter::simple2::Program& program, StateReader& reader);
  static interpreter::simple2::ToldProgram told(const interpreter::simple2::Program& program) {
    return {program.lines(), program.flag_rules(), program.flag_lines()};
  }
};

}  // namespace understudy
