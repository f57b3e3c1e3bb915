// Reads a recording of a bench as a capture, with requests, replies and inputs. A recording can then be
// compared with another version, model or bench.
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
