// The state fields of a program and its execution (base/state/fields.h), in the order of the saved bytes.
#pragma once

#include <string>
#include <vector>

#include "base/state/fields.h"
#include "base/state/state_bytes.h"
#include "interpreter/slim/editor.h"
#include "interpreter/slim/flow.h"

namespace understudy {

template <>
struct StateOf<interpreter::slim::Operand::Kind> {
  static constexpr auto last = interpreter::slim::Operand::Kind::quantity;
};

template <>
struct StateOf<interpreter::slim::Hold> {
  static constexpr auto last = interpreter::slim::Hold::number;
};

template <>
struct StateOf<interpreter::slim::Ending> {
  static constexpr auto last = interpreter::slim::Ending::failed;
};

template <>
struct StateOf<interpreter::slim::Error> {
  static constexpr auto last = interpreter::slim::Error::address;
};

template <>
struct StateOf<interpreter::slim::Condition> {
  static constexpr auto last = interpreter::slim::Condition::not_greater;
};

template <>
struct StateOf<interpreter::slim::Editor::Mode> {
  static constexpr auto last = interpreter::slim::Editor::Mode::download;
};

template <>
struct StateOf<interpreter::slim::Operand> {
  using Value = interpreter::slim::Operand;
  static constexpr auto fields =
      FieldList{field<&Value::kind>(), field<&Value::number>(), field<&Value::index>(),
                field<&Value::index_is_variable>(), field<&Value::text>()};
  static void check(const Value& operand);
};

template <>
struct StateOf<interpreter::slim::Frame> {
  using Value = interpreter::slim::Frame;
  static constexpr auto fields = FieldList{field<&Value::line>(), field<&Value::of_event>(),
                                           field<&Value::hold>(), field<&Value::until_ms>()};
  static void check(const Value& frame) { require_reach(frame.until_ms); }
};

template <>
struct StateOf<interpreter::slim::Event> {
  using Value = interpreter::slim::Event;
  static constexpr auto fields =
      FieldList{field<&Value::has_condition>(), field<&Value::condition>(), field<&Value::operands>(),
                field<&Value::has_address>(),   field<&Value::address>(),   field<&Value::armed>(),
                field<&Value::pending>()};
  static void check(const Value& event);
};

template <>
struct StateOf<interpreter::slim::Execution> {
  using Value = interpreter::slim::Execution;
  static constexpr auto fields = FieldList{
      field<&Value::running>(),    field<&Value::ending>(),   field<&Value::error>(), field<&Value::line>(),
      field<&Value::hold>(),       field<&Value::until_ms>(), field<&Value::stack>(), field<&Value::events>(),
      field<&Value::has_number>(), field<&Value::number>()};
  static void check(const Value& execution);
};

template <>
struct StateOf<interpreter::slim::Editor> {
  using Value = interpreter::slim::Editor;
  static constexpr auto fields = FieldList{field<&Value::mode>(), field<&Value::line>()};
};

/// A program is saved as its lines as they were entered. After reading, the program has the widest dialect;
/// set_texts() then applies the device's own options.
template <>
struct StateOf<interpreter::slim::Program> {
  static void write(const interpreter::slim::Program& program, StateWriter& writer);
  static void read(interpreter::slim::Program& program, StateReader& reader);
  /// Returns the lines, for comparing two states.
  static std::vector<std::string> reported(const interpreter::slim::Program& program) {
    return program.texts();
  }
};

}  // namespace understudy
