// RS-M8194H: the whole state as a value: the states of its parts.
#pragma once

#include <array>
#include <cstdint>

#include "emulator/models/rs_m8194h/chip/chip.h"
#include "emulator/models/rs_m8194h/chip/interrupts.h"
#include "emulator/models/rs_m8194h/drives/drives.h"
#include "emulator/models/rs_m8194h/drives/streams.h"
#include "emulator/models/rs_m8194h/programs/command_queue.h"
#include "emulator/models/rs_m8194h/programs/frnet.h"
#include "emulator/models/rs_m8194h/programs/memory.h"
#include "emulator/models/rs_m8194h/programs/programs.h"
#include "emulator/models/rs_m8194h/programs/status.h"
#include "emulator/models/rs_m8194h/programs/triggers.h"
#include "emulator/models/rs_m8194h/rows/registers.h"

namespace understudy::emulator::models::rs_m8194h {

/// What the RS-M8194H itself stores about requests.
struct RequestState {
  std::uint16_t illegal_reason = 0;                      // input 102
  std::array<std::uint16_t, kWindowWords> parameters{};  // written before their command (a choice)

  bool operator==(const RequestState&) const = default;
};

struct State : ChipState,
               StreamState,
               DriveState,
               InterruptState,
               QueueState,
               ProgramState,
               TriggerState,
               FrnetState,
               StatusState,
               RequestState,
               MemoryState {
  bool operator==(const State&) const = default;
};

}  // namespace understudy::emulator::models::rs_m8194h
