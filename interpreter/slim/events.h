// Conditions, and the events that wait for them: SET EV, ON EV.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "interpreter/slim/machine.h"

namespace understudy::interpreter::slim {

/// What the manual leaves open about events.
struct EventOptions {
  /// An event whose condition is true already when it becomes complete (SET EV and ON EV), or when the
  /// program starts: it fires, or waits until the condition has been false.
  enum class AtArming : std::uint8_t { fires, waits_for_change } at_arming = AtArming::fires;
  /// An event that came while another one's routine ran, and whose condition is false again at its RET.
  enum class Held : std::uint8_t { fires, is_dropped } held = Held::fires;
  /// Conditions are looked at in the milliseconds that this divides; what comes and goes in between is not
  /// seen.
  int look_every_ms = 1;

  bool operator==(const EventOptions&) const = default;
};

struct Event {
  bool has_condition = false;
  Condition condition = Condition::not_zero;
  std::vector<Operand> operands = {};
  bool has_address = false;
  Operand address = {};
  bool armed = false;    // fires when its condition is true
  bool pending = false;  // has fired and waits for its turn

  bool operator==(const Event&) const = default;
};

/// By number, from 1; the lowest has priority.
using Events = std::array<Event, kEventCount>;

/// `SET EV` or `ON EV`, in a program or typed.
void define_event(Events& events, const Command& command, const EventOptions& options);
/// As a program starts: what came before is forgotten, the definitions stay.
void arm_events(Events& events, const EventOptions& options);

/// Looks at all conditions. The error is that of a condition that cannot be tested (it is taken
/// out of use).
Error look_at_events(Events& events, const EventOptions& options, const Machine& machine);
/// Takes the event whose turn it is, which is then no longer pending.
std::optional<Operand> take_event(Events& events);
/// Whether the next look would change anything, if the machine stays as it is but its clock goes on.
bool would_change(const Events& events, const Machine& machine);

/// The index of an element of an array read from its variable: Error::range if there is no such element.
Error resolve_index(Operand& operand, const Machine& machine);
Error resolve_indices(Command& command, const Machine& machine);
/// Operands as Condition says.
Error test_condition(Condition condition, std::span<const Operand> operands, const Machine& machine,
                     bool& holds);

}  // namespace understudy::interpreter::slim
