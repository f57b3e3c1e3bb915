// RS-M8194H: the exceptions for refused requests, and the reasons that input 102 then shows (4.16.2,
// 12.1.12).
#pragma once

#include <cstdint>

#include "emulator/device/register_map/refusal.h"
#include "emulator/models/rs_m8194h/rows/ground.h"
#include "interpreter/rs_m8194h/faults.h"

namespace understudy::emulator::models::rs_m8194h {

/// Returns the refusal of a request because of this fault. reason_of() returns the number that input 102 then
/// shows.
DeviceAnswer answer_of(const Part& part, interpreter::rs_m8194h::Fault fault);
std::uint8_t reason_of(const Part& part, interpreter::rs_m8194h::Fault fault);

}  // namespace understudy::emulator::models::rs_m8194h
