// Returns the messages for the first move of a model, for a user who has no host yet.
#pragma once

#include "emulator/device/device.h"
#include "emulator/serve/control/message_fields.h"

namespace understudy::emulator::serve {

/// Returns what the steps of the model's first files do, as messages for a device: {"set":{"Aaxis_SVON":1}}
/// or {"command":"RSM_SET_V X 2000"}. Steps that only read or check something are left out. If those steps
/// start a program and the device has none, the first message is {"program":"..."}.
Json first_move_of(const Device& device);

}  // namespace understudy::emulator::serve
