// A value that follows another one with a lag, as a temperature follows its setpoint.
#pragma once

#include "base/simulated_time.h"

namespace understudy::emulator::models::imported {

/// Returns the share of the distance to its goal that a first-order lag covers in a time: 1 - exp(-time /
/// time_constant). It uses only + - * /, so the result has the same bits everywhere; the relative error is
/// below 1e-14. The share is 1 for a time constant of 0.
double lag_fraction(double time_s, double time_constant_s);

/// Returns the value at the end of one period, in which it covers `share` of the distance to `goal`, and at
/// most `most` if that is above 0. A remaining distance of less than a thousand millionth of the goal (or of
/// 1) is dropped at once, since it would never end.
double approach(double value, double goal, double share, double most);

}  // namespace understudy::emulator::models::imported
