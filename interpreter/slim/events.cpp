#include "interpreter/slim/events.h"

#include <cstddef>
#include <optional>
#include <span>

#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/error.h"
#include "interpreter/slim/machine.h"
#include "interpreter/slim/options.h"

namespace understudy::interpreter::slim {
namespace {

using Kind = Operand::Kind;

bool is_complete(const Event& event) { return event.has_condition && event.has_address; }

void arm(Event& event, const Options& options) {
  event.armed = !options.chose(option("event_at_arming", "waits_for_a_change"));
  event.pending = false;
}

Error number_of(Operand operand, const Machine& machine, double& number) {
  if (const Error error = resolve_index(operand, machine); error != Error::none) return error;
  const bool is_constant = operand.kind == Kind::integer || operand.kind == Kind::real;
  number = is_constant ? operand.number : machine.value(operand);
  return Error::none;
}

bool compare(Condition condition, double comparand, double variable) {
  switch (condition) {
    case Condition::equal: return variable == comparand;
    case Condition::not_equal: return variable != comparand;
    case Condition::greater: return variable > comparand;
    case Condition::not_greater: return variable <= comparand;
    case Condition::input_on:
    case Condition::input_off:
    case Condition::zero:
    case Condition::not_zero: break;
  }
  return false;  // these conditions do not compare two values
}

}  // namespace

Error resolve_index(Operand& operand, const Machine& machine) {
  if (!operand.index_is_variable) return Error::none;
  const double index = machine.value({.kind = Kind::integer_variable, .index = operand.index});
  if (index < 0 || index >= kArrayCount) return Error::range;
  operand.index = static_cast<int>(index);
  operand.index_is_variable = false;
  return Error::none;
}

Error resolve_indices(Command& command, const Machine& machine) {
  for (Operand& operand : command.operands) {
    if (const Error error = resolve_index(operand, machine); error != Error::none) return error;
  }
  return Error::none;
}

Error test_condition(Condition condition, std::span<const Operand> operands, const Machine& machine,
                     bool& holds) {
  switch (condition) {
    case Condition::input_on:
    case Condition::input_off:
      holds = machine.input(static_cast<int>(operands[0].number)) == (condition == Condition::input_on);
      return Error::none;
    case Condition::zero:
    case Condition::not_zero: {
      double number = 0;
      const Error error = number_of(operands[0], machine, number);
      holds = (number == 0) == (condition == Condition::zero);
      return error;
    }
    case Condition::equal:
    case Condition::not_equal:
    case Condition::greater:
    case Condition::not_greater: break;
  }
  double comparand = 0;
  double variable = 0;
  if (const Error error = number_of(operands[0], machine, comparand); error != Error::none) return error;
  if (const Error error = number_of(operands[1], machine, variable); error != Error::none) return error;
  // A real variable is a float32, so the comparand must also be a float32. Otherwise, 0.1 would never equal
  // R0=0.1.
  if (!holds_integer(operands[1].kind)) comparand = static_cast<float>(comparand);
  holds = compare(condition, comparand, variable);
  return Error::none;
}

void define_event(Events& events, const Command& command, const Options& options) {
  Event& event = events[static_cast<std::size_t>(command.operands[0].index - 1)];
  if (command.verb == Verb::on_event) {
    event.has_address = true;
    event.address = command.operands[1];
  } else {
    event.has_condition = true;
    event.condition = static_cast<Condition>(command.operands[1].index);
    event.operands.assign(command.operands.begin() + 2, command.operands.end());
  }
  arm(event, options);
}

void arm_events(Events& events, const Options& options) {
  for (Event& event : events) arm(event, options);
}

Error check_events(Events& events, const Options& options, const Machine& machine) {
  Error first_error = Error::none;
  for (Event& event : events) {
    if (!is_complete(event)) continue;
    bool holds = false;
    const Error error = test_condition(event.condition, event.operands, machine, holds);
    if (error != Error::none) {
      event = {};
      if (first_error == Error::none) first_error = error;
      continue;
    }
    if (holds && event.armed) {
      event.armed = false;
      event.pending = true;
    }
    if (!holds) {
      event.armed = true;
      if (event.pending && options.chose(option("held_event", "is_dropped"))) event.pending = false;
    }
  }
  return first_error;
}

std::optional<Operand> take_event(Events& events) {
  for (Event& event : events) {
    if (!event.pending) continue;
    event.pending = false;
    return event.address;
  }
  return std::nullopt;
}

bool would_change(const Events& events, const Machine& machine) {
  for (const Event& event : events) {
    if (!is_complete(event)) continue;
    bool holds = false;
    if (test_condition(event.condition, event.operands, machine, holds) != Error::none) return true;
    if (holds == event.armed) return true;
    for (const Operand& operand : event.operands) {
      if (operand.kind == Kind::clock || operand.kind == Kind::quantity) return true;
    }
  }
  return false;
}

}  // namespace understudy::interpreter::slim
