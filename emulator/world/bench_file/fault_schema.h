// The keys of a fault in a file, for editors: one kind with its place, the fields of the kind, and the fields
// of the trigger. The readers check more (find_fault).
#pragma once

#include <algorithm>
#include <array>

#include "emulator/world/bench_file/schema.h"

namespace understudy::emulator::world {

inline constexpr std::array kFaultKeys{
    // The kinds, in the order of Fault::Kind.
    Key{"stall", "The motor of this axis is blocked.", &kAxisName},
    Key{"lost_steps", "One in `one_in` pulses on this axis is lost.", &kAxisName},
    Key{"slip", "The machine on this axis is pushed.", &kAxisName},
    Key{"alarm", "The drive of this axis has an alarm.", &kAxisName},
    Key{"stuck", "This input stays as it is.", &kInputName},
    Key{"encoder_noise", "The encoder on this axis counts wrongly.", &kAxisName},
    Key{"turn", "The hand wheel with the encoder of this axis is turned.", &kAxisName},
    Key{"power_cut", "This device has no power.", &kDeviceName},
    Key{"echo", "Hosts on this line receive their own bytes.", &kLineName},
    Key{"lumps", "Bytes on this line arrive in batches, as through a USB adapter.", &kLineName},
    Key{"unplug", "The adapter of this line is unplugged.", &kLineName},
    Key{"slow", "This device executes requests late.", &kDeviceName},
    Key{"busy", "This device, or all on this line, refuse requests as busy.", &kDeviceOrLineName},
    Key{"exception", "This device, or all on this line, refuse requests.", &kDeviceOrLineName},
    Key{"early_reply", "This device, or all on this line, reply without waiting for the silence.",
        &kDeviceOrLineName},
    Key{"drop", "Replies (or requests) of this device or line are lost.", &kDeviceOrLineName},
    Key{"delay", "Replies (or requests) of this device or line are late.", &kDeviceOrLineName},
    Key{"corrupt_checksum", "The last byte of replies (or requests) is inverted.", &kDeviceOrLineName},
    Key{"truncate", "Only the first bytes of replies (or requests) arrive.", &kDeviceOrLineName},
    Key{"duplicate", "Replies (or requests) arrive twice.", &kDeviceOrLineName},
    Key{"noise", "Extra bytes arrive before and after replies (or requests).", &kDeviceOrLineName},
    Key{"collision", "Another sender transmits at the same time.", &kDeviceOrLineName},
    Key{"split", "Replies (or requests) arrive in two pieces.", &kDeviceOrLineName},
    Key{"wrong_transaction", "Over Modbus TCP, replies have the next transaction's number.",
        &kDeviceOrLineName},
    Key{"wrong_unit", "Over Modbus TCP, replies have the next unit's number.", &kDeviceOrLineName},
    Key{"hang_up", "Over TCP, the connection closes in the middle of replies.", &kDeviceOrLineName},
    // The fields of the kinds.
    Key{"one_in", "lost_steps: one pulse in this many is lost.", &kText},
    Key{"pulses", "slip: the number of pulses.", &kText},
    Key{"level", "stuck: on or off.", &kText},
    Key{"counts", "turn: the number of counts; encoder_noise: the error in counts.", &kText},
    Key{"in", "turn: how long it takes; immediate by default.", &kText},
    Key{"period", "encoder_noise: the length of a period; in its second half, the count is too low.", &kText},
    Key{"by", "slow, delay: how late; split: how much later the rest arrives; lumps: the interval.", &kText},
    Key{"code", "exception: its code.", &kText},
    Key{"keep", "truncate, split, hang_up: how many bytes arrive (first).", &kText},
    Key{"after", "duplicate: how much later; noise: the bytes after it.", &kText},
    Key{"before", "noise: the bytes before it.", &kText},
    Key{"with", "collision: the bytes of the other sender.", &kText},
    Key{"of", "reply (default), request or both.", &kText},
    // The fields of the trigger.
    Key{"function", "Requests with this function.", &kText},
    Key{"station", "Requests for this station.", &kText},
    Key{"address", "Requests for this register, or for any of 0x1000..0x1010.", &kText},
    Key{"nth", "Which of the matches: 3, 3..7 or 3..", &kText},
    Key{"every", "One in this many matches.", &kText},
    Key{"at", "The first match from this time on.", &kText},
    Key{"from", "Matches from this time on.", &kText},
    Key{"to", "Matches before this time.", &kText},
    Key{"for", "For this long after each hit.", &kText},
    Key{"when", "While this condition holds.", &kText},
    Key{"chance", "With this probability: 5%.", &kText},
    Key{"seed", "Its own random seed.", &kText},
    Key{"times", "At most this many times.", &kText},
};

namespace fault_schema {
constexpr auto with_name() {
  std::array<Key, kFaultKeys.size() + 1> keys{};
  std::copy(kFaultKeys.begin(), kFaultKeys.end(), keys.begin());
  keys.back() = Key{"name", "Its name for `clear` (default: the fault itself).", &kText};
  return keys;
}
}  // namespace fault_schema
inline constexpr auto kInjectKeys = fault_schema::with_name();

}  // namespace understudy::emulator::world
