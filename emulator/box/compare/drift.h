// The difference between a controller's clock and that of its capture.
#pragma once

#include <functional>

#include "emulator/box/capture/capture.h"
#include "emulator/box/compare/comparison.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::box {

/// Estimates from the motions how much faster the controller's clock is than the capture's, in parts per
/// million: the value with which the bench agrees for longest. Returns 0 if no value helps, or
/// once `is_over` returns true.
double fit_drift(const world::Bench& bench, const Capture& capture, const CompareSettings& settings,
                 const std::function<bool()>& is_over = {});

}  // namespace understudy::emulator::box
