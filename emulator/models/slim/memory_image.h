// Converts the persistent memory to and from a file.
#pragma once

#include <functional>

#include "emulator/device/memory/nv_image.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"

namespace understudy::emulator::models::slim {

/// Returns a function that writes the present memory, and that may be called at any later time.
std::function<void(NvImage&)> image_writer(const State& state, const Setup& setup);
/// Throws NvError for an image that does not fit; in that case, nothing changes.
void read_image(State& state, const Setup& setup, const NvImage& given);

}  // namespace understudy::emulator::models::slim
