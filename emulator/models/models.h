// All controllers. The rooms that run them do not know this list: it is handed to them.
#pragma once

#include "emulator/device/model.h"

namespace understudy::emulator::models {

/// In the order of `understudy models`.
ModelList all_models();

}  // namespace understudy::emulator::models
