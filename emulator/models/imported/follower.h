// A value that comes after another one with a lag, as a temperature comes after its setpoint.
#pragma once

#include "base/simulated_time.h"

namespace understudy::emulator::models::imported {

/// How much of the way to its goal a first-order lag goes in a time: 1 - exp(-time / time_constant). Only
/// + - * / are used, so it is the same bits everywhere; relative error below 1e-14. 1 for a time constant of
/// 0.
double share_of_way(double time_s, double time_constant_s);

/// The value at the end of one period, in which it goes `share` of the way to `goal`, and no farther than
/// `most` if that is above 0. A rest of less than a thousand millionth of the goal (or of 1) is gone at once:
/// it would never end.
double come_nearer(double value, double goal, double share, double most);

}  // namespace understudy::emulator::models::imported
