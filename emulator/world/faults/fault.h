// Faults that a user injects to see how a host handles them: in the machine and its wiring, in devices, and
// in messages on the line. Triggers (trigger.h) determine when faults take effect. docs/faults.md explains
// each kind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/world/faults/trigger.h"
#include "emulator/world/names/names.h"

namespace understudy::emulator::world {

struct Fault {
  enum class Kind : std::uint8_t {
    // Faults of the machine, at an axis or (stuck) at an input.
    stall,          // the motor is blocked, so every pulse is lost
    lost_steps,     // one pulse in `amount` is lost
    slip,           // the machine is pushed by `amount` pulses, once
    alarm,          // the drive is in alarm; a simulated drive keeps the alarm until the controller clears it
    stuck,          // an input has the level `amount`, whatever drives it
    encoder_noise,  // the encoder count is `amount` too high for half of `period_ticks`, then `amount` too
                    // low for the other half
    turn,           // a hand wheel, or another counted input, is turned by `amount` over `over_ticks`
    // Faults of a device.
    power_cut,  // the device has no power
    // Faults of the adapter that connects hosts to a line.
    echo,    // a host receives its own bytes
    lumps,   // received bytes are delivered at multiples of `amount` ns
    unplug,  // the adapter is unplugged
    slow,    // the device executes each request `amount` ns late
    // Faults in how a device, or every device on a line, handles requests.
    busy,         // requests are refused as by a busy device
    exception,    // requests are refused with exception `amount`
    early_reply,  // requests are complete at their last character, without the device's silence
    // Faults of a message on the wire (pty/wire_fault.h).
    drop,
    delay,             // delayed by `amount` ns
    corrupt_checksum,  // the last byte is inverted
    truncate,          // only the first `amount` bytes arrive
    duplicate,         // repeated `amount` ns later
    noise,             // preceded by `before` and followed by `after`
    collision,         // another sender sends `before` at the same time
    split,             // the first `amount` bytes arrive on time, the rest `over_ticks` later
    // Faults of a reply between a gateway and a master.
    wrong_transaction,  // with the next transaction's number
    wrong_unit,         // with the next unit's number
    hang_up,            // the connection ends after its first `amount` bytes
  } kind = Kind::stall;
  std::size_t device = 0;  // for a fault of a line: the first device on it
  // An axis; for `stuck`, or for a `turn` with of_input, a terminal. For a fault of a line, the port that
  // connects the device.
  int place = 0;
  std::int64_t amount = 0;
  std::int64_t period_ticks = 0;
  std::int64_t over_ticks = 0;
  bool on_line = false;   // it affects the whole line
  bool of_input = false;  // for `turn`: the place is a counted input
  enum class Side : std::uint8_t { reply, request, both } side = Side::reply;
  std::vector<std::uint8_t> before{};
  std::vector<std::uint8_t> after{};
  FaultTrigger trigger{};

  bool operator==(const Fault&) const = default;
};

/// Returns true if the fault changes messages on the wire.
constexpr bool is_of_wire(Fault::Kind kind) { return kind >= Fault::Kind::drop || kind == Fault::Kind::slow; }
/// Returns true if the fault affects requests or replies, and therefore needs frames with any trigger.
constexpr bool is_of_frames(Fault::Kind kind) { return kind >= Fault::Kind::slow; }
/// Returns true if the fault affects replies to hosts that are connected over TCP. It has no effect on the
/// line.
constexpr bool is_of_gateway(Fault::Kind kind) { return kind >= Fault::Kind::wrong_transaction; }
constexpr bool is_of_adapter(Fault::Kind kind) {
  return kind == Fault::Kind::echo || kind == Fault::Kind::lumps || kind == Fault::Kind::unplug;
}
/// Returns true for a single action on the machine, which cannot be cleared.
constexpr bool is_done_at_once(Fault::Kind kind) {
  return kind == Fault::Kind::slip || kind == Fault::Kind::turn;
}
/// Returns true if the fault waits for a frame, a time or a condition before it takes effect.
bool waits(const Fault& fault);

/// A fault as text: `stall feeder.A`, `lost_steps feeder.A one_in=50`, `drop feeder nth=3`.
struct FaultText {
  std::string kind;
  std::string place;
  std::vector<std::pair<std::string, std::string>> fields;  // name and value
};

/// Thrown for an error in one field of a fault.
struct FaultFieldError : NameError {
  FaultFieldError(const std::string& kind, std::string field_name, std::string what_is_wrong)
      : NameError(kind + ": " + field_name + ": " + what_is_wrong),
        field(std::move(field_name)),
        diagnostic(std::move(what_is_wrong)) {}
  std::string field;
  std::string diagnostic;
};

/// Thrown for an error in the place of a fault. The fields of the fault have not been checked.
struct FaultPlaceError : NameError {
  using NameError::NameError;
};

/// Throws NameError for names that are not in the bench. check_fault.h checks the names in `when`.
Fault find_fault(const KnownDevices& devices, const FaultText& text);
/// Throws NameError for errors of a fault that do not depend on its place.
void require_fault_fields(const KnownDevices& devices, const FaultText& text);
/// Return a fault in the form that find_fault() accepts, as fields and as one line.
FaultText fault_text(const KnownDevices& devices, const Fault& fault);
std::string to_text(const KnownDevices& devices, const Fault& fault);

/// A fault and its present state.
struct ArmedFault {
  Fault fault;
  FaultCourse course{};

  bool operator==(const ArmedFault&) const = default;
};

}  // namespace understudy::emulator::world
