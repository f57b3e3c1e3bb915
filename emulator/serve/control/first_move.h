// Returns the messages for a first move of a model, for users who do not have a host yet.
#pragma once

#include "emulator/device/device.h"
#include "emulator/serve/control/message_fields.h"

namespace understudy::emulator::serve {

/// Returns the steps in the model's first files as messages for a device: {"set":{"Aaxis_SVON":1}} or
/// {"command":"RSM_SET_V X 2000"}. Steps that only read or check something are omitted. If those steps start
/// a program and the device has none, the first message is {"program":"..."}.
Json first_move_of(const Device& device);

}  // namespace understudy::emulator::serve
