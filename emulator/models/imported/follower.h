// Computes a value that follows another one with a lag, as a temperature follows its setpoint.
#pragma once

#include "base/simulated_time.h"

namespace understudy::emulator::models::imported {

/// Returns the share of the distance to its goal that a first-order lag covers in the given time: 1 -
/// exp(-time / time_constant). It uses only + - * /, so the result has the same bits on every machine. The
/// relative error is below 1e-14. The share is 1 for a time constant of 0.
double lag_fraction(double time_s, double time_constant_s);

/// Returns the value at the end of one period, in which it covers `share` of the distance to `goal`, but at
/// most `max` if that is above 0. If the remaining distance is below a billionth of the goal (or of 1), the
/// value becomes the goal at once, because it would otherwise never reach it.
double approach(double value, double goal, double share, double max);

}  // namespace understudy::emulator::models::imported
