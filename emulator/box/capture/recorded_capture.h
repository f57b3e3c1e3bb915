// Takes a recording of a bench as a capture: what a host sent, what the devices sent back, and what the
// inputs did. So a recording can be compared with another version, model or bench.
#pragma once

#include <istream>
#include <string>

#include "emulator/box/capture/capture.h"
#include "emulator/device/model.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::box {

/// Inputs are those of the devices of the same names in `bench`. Throws CaptureReadError.
Capture read_recorded_capture(ModelList models, std::istream& file, const std::string& path,
                              const CaptureSettings& settings, const world::Bench& bench);

}  // namespace understudy::emulator::box
