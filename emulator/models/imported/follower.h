// Computes a value that follows another value with a lag, such as a temperature that follows its setpoint.
#pragma once

#include "base/simulated_time.h"

namespace understudy::emulator::models::imported {

/// Returns the fraction of the distance to its goal that a first-order lag covers in the given time: 1 -
/// exp(-time / time_constant). The function uses only + - * /, so the result has the same bits on every
/// machine. The relative error is below 1e-14. For a time constant of 0, the fraction is 1.
double lag_fraction(double time_s, double time_constant_s);

/// Returns the value at the end of a period in which it covers `share` of the distance to `goal`, but at most
/// `max` if that is above 0. If the remaining distance is below a billionth of the goal (or of 1), the result
/// is the goal, which the value would otherwise never reach.
double approach(double value, double goal, double share, double max);

}  // namespace understudy::emulator::models::imported
