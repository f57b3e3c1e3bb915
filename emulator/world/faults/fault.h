// What a user breaks, to see how a host copes: the machine and its wiring, devices, and what goes over the
// line; and when (trigger.h). docs/faults.md explains each kind.
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
    // of the machine, at an axis or (stuck) an input
    stall,          // the motor is blocked, every pulse is lost
    lost_steps,     // every `amount`th pulse is lost
    slip,           // the machine is moved by `amount` pulses by force; over at once
    alarm,          // the drive is in alarm; a real drive stays so until the controller clears it afterwards
    stuck,          // an input stays at the level `amount`, whatever drives it
    encoder_noise,  // the encoder counts `amount` too many, then too few, half a `period_ticks` each
    turn,           // a hand wheel, or what else is counted, is turned by `amount`, over `over_ticks`
    // of a device
    power_cut,  // it has no power
    // of the adapter by which hosts are joined to a line
    echo,    // a host hears its own bytes
    lumps,   // what comes is handed over at multiples of `amount` ns
    unplug,  // the port is gone
    slow,    // it carries out each request `amount` ns late
    // of what a device, or all on a line, make of requests
    busy,         // they are refused as a busy device would
    exception,    // they are refused with exception `amount`
    early_reply,  // they are treated as over with their last character, without the device's silence
    // of a message on the wire (pty/wire_fault.h)
    drop,
    delay,             // by `amount` ns
    corrupt_checksum,  //
    truncate,          // to `amount` bytes
    duplicate,         // the second `amount` ns after the first
    noise,             // `before` and `after`
    collision,         // with `before`
    split,             // its first `amount` bytes come, and the rest `over_ticks` later
    // of a reply on its way from a gateway to a master
    wrong_transaction,  //
    wrong_unit,         //
    hang_up,            // the connection ends behind its first `amount` bytes
  } kind = Kind::stall;
  std::size_t device = 0;  // of a line: the first of the bench's that stands there
  // An axis, a terminal for `stuck` and a `turn` that is of_input, of a line the port by which that device is
  // there.
  int place = 0;
  std::int64_t amount = 0;
  std::int64_t period_ticks = 0;
  std::int64_t over_ticks = 0;
  bool on_line = false;   // all of its line is meant
  bool of_input = false;  // of `turn`: the place is a counted input
  enum class Side : std::uint8_t { reply, request, both } side = Side::reply;
  std::vector<std::uint8_t> before{};
  std::vector<std::uint8_t> after{};
  FaultTrigger trigger{};

  bool operator==(const Fault&) const = default;
};

/// What is done to a message on the wire.
constexpr bool is_of_wire(Fault::Kind kind) { return kind >= Fault::Kind::drop || kind == Fault::Kind::slow; }
/// What is done to a request or its reply: it needs frames, whatever its trigger says.
constexpr bool is_of_frames(Fault::Kind kind) { return kind >= Fault::Kind::slow; }
/// What happens to replies where a host is connected by TCP: on the wire nothing does.
constexpr bool is_of_gateway(Fault::Kind kind) { return kind >= Fault::Kind::wrong_transaction; }
constexpr bool is_of_adapter(Fault::Kind kind) {
  return kind == Fault::Kind::echo || kind == Fault::Kind::lumps || kind == Fault::Kind::unplug;
}
/// A single act on the machine, not something wrong with it: it cannot be cleared.
constexpr bool is_done_at_once(Fault::Kind kind) {
  return kind == Fault::Kind::slip || kind == Fault::Kind::turn;
}
/// Whether something must happen before it strikes: a frame, a time, a condition.
bool waits(const Fault& fault);

/// A fault as text: `stall feeder.A`, `lost_steps feeder.A one_in=50`, `drop feeder nth=3`.
struct FaultText {
  std::string kind;
  std::string place;
  std::vector<std::pair<std::string, std::string>> fields;  // by their names
};

/// Of one field of a fault.
struct FaultFieldError : NameError {
  FaultFieldError(const std::string& kind, std::string field_name, std::string what_is_wrong)
      : NameError(kind + ": " + field_name + ": " + what_is_wrong),
        field(std::move(field_name)),
        complaint(std::move(what_is_wrong)) {}
  std::string field;
  std::string complaint;
};

/// Throws NameError for what the bench does not have. What `when` names is judged by check_fault.h.
Fault find_fault(const KnownDevices& devices, const FaultText& text);
/// As find_fault() takes it, and on one line.
FaultText fault_text(const KnownDevices& devices, const Fault& fault);
std::string to_text(const KnownDevices& devices, const Fault& fault);

/// A fault, and what it has done so far.
struct ArmedFault {
  Fault fault;
  FaultCourse course{};

  bool operator==(const ArmedFault&) const = default;
};

}  // namespace understudy::emulator::world
