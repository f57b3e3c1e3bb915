// The form of a fault in a file, for editors: one kind with its place, the kind's fields, and the trigger's.
// The readers check more (find_fault).
#pragma once

#include <algorithm>
#include <array>

#include "emulator/world/bench_file/form.h"

namespace understudy::emulator::world {

inline constexpr std::array kFaultKeys{
    // The kinds, in the order of Fault::Kind.
    KeyRow{"stall", "The motor of this axis is blocked.", &kAxisName},
    KeyRow{"lost_steps", "One in `one_in` pulses on this axis is lost.", &kAxisName},
    KeyRow{"slip", "The machine on this axis is pushed.", &kAxisName},
    KeyRow{"alarm", "The drive of this axis has an alarm.", &kAxisName},
    KeyRow{"stuck", "This input stays as it is.", &kInputName},
    KeyRow{"encoder_noise", "The encoder on this axis counts wrongly.", &kAxisName},
    KeyRow{"turn", "The hand wheel with the encoder of this axis is turned.", &kAxisName},
    KeyRow{"power_cut", "This device has no power.", &kDeviceName},
    KeyRow{"echo", "Hosts on this line receive their own bytes.", &kLineName},
    KeyRow{"lumps", "Bytes on this line arrive in batches, as through a USB adapter.", &kLineName},
    KeyRow{"unplug", "The adapter of this line is unplugged.", &kLineName},
    KeyRow{"slow", "This device executes requests late.", &kDeviceName},
    KeyRow{"busy", "This device, or all on this line, refuse requests as busy.", &kDeviceOrLineName},
    KeyRow{"exception", "This device, or all on this line, refuse requests.", &kDeviceOrLineName},
    KeyRow{"early_reply", "This device, or all on this line, reply without the silence.", &kDeviceOrLineName},
    KeyRow{"drop", "Replies (or requests) of this device or line are lost.", &kDeviceOrLineName},
    KeyRow{"delay", "Replies (or requests) of this device or line are late.", &kDeviceOrLineName},
    KeyRow{"corrupt_checksum", "The last byte of replies (or requests) is inverted.", &kDeviceOrLineName},
    KeyRow{"truncate", "Only the first bytes of replies (or requests) arrive.", &kDeviceOrLineName},
    KeyRow{"duplicate", "Replies (or requests) arrive twice.", &kDeviceOrLineName},
    KeyRow{"noise", "Extra bytes arrive before and after replies (or requests).", &kDeviceOrLineName},
    KeyRow{"collision", "Another sender talks at the same time.", &kDeviceOrLineName},
    KeyRow{"split", "Replies (or requests) arrive in two pieces.", &kDeviceOrLineName},
    KeyRow{"wrong_transaction", "Over Modbus TCP, replies have the next transaction's number.",
           &kDeviceOrLineName},
    KeyRow{"wrong_unit", "Over Modbus TCP, replies have the next unit's number.", &kDeviceOrLineName},
    KeyRow{"hang_up", "Over TCP, the connection closes in the middle of replies.", &kDeviceOrLineName},
    // Their fields.
    KeyRow{"one_in", "lost_steps: one pulse in this many is lost.", &kText},
    KeyRow{"pulses", "slip: how far.", &kText},
    KeyRow{"level", "stuck: on or off.", &kText},
    KeyRow{"counts", "turn: how far; encoder_noise: this many too many.", &kText},
    KeyRow{"in", "turn: how long it takes; by default at once.", &kText},
    KeyRow{"period", "encoder_noise: too few for the second half of it.", &kText},
    KeyRow{"by", "slow, delay: how late; split: how much later the rest arrives; lumps: the interval.",
           &kText},
    KeyRow{"code", "exception: which.", &kText},
    KeyRow{"keep", "truncate, split, hang_up: how many bytes arrive (first).", &kText},
    KeyRow{"after", "duplicate: how much later; noise: the bytes after it.", &kText},
    KeyRow{"before", "noise: the bytes before it.", &kText},
    KeyRow{"with", "collision: the bytes of the other sender.", &kText},
    KeyRow{"of", "reply (default), request or both.", &kText},
    // The fields of the trigger.
    KeyRow{"function", "Requests with this function.", &kText},
    KeyRow{"station", "Requests for this station.", &kText},
    KeyRow{"address", "Requests about this register, or one of 0x1000..0x1010.", &kText},
    KeyRow{"nth", "The third of those that match: 3; 3..7, 3..", &kText},
    KeyRow{"every", "One in this many matches.", &kText},
    KeyRow{"at", "The first from then on.", &kText},
    KeyRow{"from", "From then on.", &kText},
    KeyRow{"to", "Before then.", &kText},
    KeyRow{"for", "For this long, once it strikes.", &kText},
    KeyRow{"when", "While this condition holds.", &kText},
    KeyRow{"chance", "By chance: 5%.", &kText},
    KeyRow{"seed", "Its own random seed.", &kText},
    KeyRow{"times", "At most this many times.", &kText},
};

namespace fault_form {
constexpr auto with_name() {
  std::array<KeyRow, kFaultKeys.size() + 1> keys{};
  std::copy(kFaultKeys.begin(), kFaultKeys.end(), keys.begin());
  keys.back() = KeyRow{"name", "Its name for `clear` (default: the fault itself).", &kText};
  return keys;
}
}  // namespace fault_form
inline constexpr auto kInjectKeys = fault_form::with_name();

}  // namespace understudy::emulator::world
