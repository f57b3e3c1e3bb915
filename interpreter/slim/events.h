// Conditions, and the events that use them (SET EV, ON EV).
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "interpreter/slim/machine.h"
#include "interpreter/slim/options.h"

namespace understudy::interpreter::slim {

struct Event {
  bool has_condition = false;
  Condition condition = Condition::not_zero;
  std::vector<Operand> operands = {};
  bool has_address = false;
  Operand address = {};
  bool armed = false;    // fires when its condition is true
  bool pending = false;  // has fired and is waiting to be handled

  bool operator==(const Event&) const = default;
};

/// The events, numbered from 1. The lowest number has priority.
using Events = std::array<Event, kEventCount>;

/// Executes `SET EV` or `ON EV`, whether in a program or typed.
void define_event(Events& events, const Command& command, const Options& options);
/// Arms the events at the start of a program. Earlier occurrences are dropped; the definitions are kept.
void arm_events(Events& events, const Options& options);

/// Checks all conditions. If a condition cannot be tested, returns its error and disables the event.
Error check_events(Events& events, const Options& options, const Machine& machine);
/// Returns the next event to be handled, which is then no longer pending.
std::optional<Operand> take_event(Events& events);
/// Returns true if the next check would change anything although only the machine's clock advances.
bool would_change(const Events& events, const Machine& machine);

/// Replaces an array index that is a variable with its value. Returns Error::range if there is no such
/// element.
Error resolve_index(Operand& operand, const Machine& machine);
Error resolve_indices(Command& command, const Machine& machine);
/// Tests a condition. Condition describes the operands.
Error test_condition(Condition condition, std::span<const Operand> operands, const Machine& machine,
                     bool& holds);

}  // namespace understudy::interpreter::slim
