// The list of all controllers. The folders that run controllers do not depend on this list; they receive it
// as an argument.
#pragma once

#include "emulator/device/model.h"

namespace understudy::emulator::models {

/// Returns the models in the order of `understudy models`.
ModelList all_models();

}  // namespace understudy::emulator::models
