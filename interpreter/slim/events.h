// Conditions, and the events that use them: SET EV, ON EV.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "interpreter/slim/machine.h"

namespace understudy::interpreter::slim {

/// Options about events that the manual leaves open.
struct EventOptions {
  /// If its condition is already true when an event becomes complete (SET EV and ON EV) or when the program
  /// starts, the event fires, or it waits until the condition has been false.
  enum class AtArming : std::uint8_t { fires, waits_for_change } at_arming = AtArming::fires;
  /// If an event occurs during another event's routine and its condition is false again at the RET, the event
  /// fires, or it is dropped.
  enum class Held : std::uint8_t { fires, is_dropped } held = Held::fires;
  /// Conditions are checked at every multiple of this time; changes in between are not noticed.
  int check_interval_ms = 1;

  bool operator==(const EventOptions&) const = default;
};

struct Event {
  bool has_condition = false;
  Condition condition = Condition::not_zero;
  std::vector<Operand> operands = {};
  bool has_address = false;
  Operand address = {};
  bool armed = false;    // fires when its condition is true
  bool pending = false;  // has fired and is waiting for its turn

  bool operator==(const Event&) const = default;
};

/// The events by number, from 1; the lowest number has priority.
using Events = std::array<Event, kEventCount>;

/// Executes `SET EV` or `ON EV`, in a program or typed.
void define_event(Events& events, const Command& command, const EventOptions& options);
/// Arms the events at the start of a program: earlier occurrences are dropped, and the definitions are kept.
void arm_events(Events& events, const EventOptions& options);

/// Checks all conditions. Returns the error of a condition that cannot be tested; that event is disabled.
Error check_events(Events& events, const EventOptions& options, const Machine& machine);
/// Returns the event whose turn it is, which is then no longer pending.
std::optional<Operand> take_event(Events& events);
/// Returns true if the next check would change anything, if only the machine's clock advances.
bool would_change(const Events& events, const Machine& machine);

/// Resolves the index of an array element from its variable. Returns Error::range if there is no such
/// element.
Error resolve_index(Operand& operand, const Machine& machine);
Error resolve_indices(Command& command, const Machine& machine);
/// Tests a condition; the operands are as described at Condition.
Error test_condition(Condition condition, std::span<const Operand> operands, const Machine& machine,
                     bool& holds);

}  // namespace understudy::interpreter::slim
