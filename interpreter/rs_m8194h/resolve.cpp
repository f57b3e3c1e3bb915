#include "interpreter/rs_m8194h/resolve.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "interpreter/rs_m8194h/check.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/command_row.h"
#include "interpreter/rs_m8194h/commands.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/machine.h"

namespace understudy::interpreter::rs_m8194h {

std::int32_t value_of(std::uint32_t operand, const Machine& machine) {
  if (is_variable(operand)) return machine.variable(variable_number(operand));
  return static_cast<std::int32_t>(operand);
}

Fault resolve(Command& command, const Machine& machine, const Options& options) {
  const CommandRow& row = command.row();
  const Command as_stored = command;
  bool has_any = false;
  for (std::size_t i = 0; i < row.parameter_count(); ++i) {
    if (!is_reference(as_stored, i)) continue;
    has_any = true;
    const Parameter& parameter = row.parameters[i];
    std::int32_t value = parameter.reference == Reference::variable
                             ? machine.variable(variable_number(as_stored.values[i]))
                             : machine.byte_variable(byte_variable_number(as_stored.values[i]));
    const bool has_sign = parameter.width == Width::signed_long;
    if (!has_sign && parameter.kind == Kind::speed) value = std::max(value, 0);
    const std::int64_t number =
        has_sign ? std::int64_t{value} : std::int64_t{static_cast<std::uint32_t>(value)};
    const bool is_checked_with_others =
        parameter.kind == Kind::isr_if_used || parameter.kind == Kind::point_if_used;
    if (!is_checked_with_others && !parameter.lists(number)) return Fault::parameter;
    command.values[i] = static_cast<std::uint32_t>(value);
  }
  if (!has_any) return Fault::none;
  Command plain = command;
  plain.code = real_time_code(command.verb());  // a real-time command has no references
  return bad_parameter(plain, options) ? Fault::parameter : Fault::none;
}

}  // namespace understudy::interpreter::rs_m8194h
