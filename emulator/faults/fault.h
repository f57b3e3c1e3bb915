// Faults of the machine and its wiring: what a user breaks to see how a host copes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/bench/names.h"

namespace understudy::emulator {

struct Fault {
  enum class Kind : std::uint8_t {
    stall,       // the motor is blocked, every pulse is lost
    lost_steps,  // every `amount`th pulse is lost
    slip,        // the machine is moved by `amount` pulses by force; over at once
    alarm,       // the drive is in alarm; with a drive it stays so until the controller clears it afterwards
    stuck,       // an input stays at the level `amount`, whatever drives it
  } kind = Kind::stall;
  std::size_t device = 0;
  int place = 0;  // an axis, or for `stuck` a terminal
  std::int64_t amount = 0;

  bool operator==(const Fault&) const = default;
};

/// A fault as text has it: `stall feeder.A`, `lost_steps feeder.A one_in=50`, `slip feeder.A pulses=-200`,
/// `alarm feeder.A`, `stuck feeder.DIN_2 level=0`.
struct FaultText {
  std::string kind;
  std::string place;
  std::vector<std::pair<std::string, std::int64_t>> amounts;  // by their names
};

/// Throws NameError for what the bench does not have.
Fault find_fault(const KnownDevices& devices, const FaultText& text);
/// As find_fault() takes it, and the same on one line.
FaultText fault_text(const KnownDevices& devices, const Fault& fault);
std::string to_text(const KnownDevices& devices, const Fault& fault);

}  // namespace understudy::emulator
