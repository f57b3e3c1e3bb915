// Calculates for move.cpp how far the speed of a short move can rise.
#pragma once

#include "motion/ramp.h"

namespace understudy::motion {

/// Returns the change of speed x >= 0 above `start_u_s` after which a ramp by `up` and a ramp by `down`
/// together cover `distance_u`. It is at most `limit_u_s`, and 0 if no ramp fits. Slopes, times and sections
/// have a closed form; jerk laws take a few monotone Newton steps on a convex function, exact to the last
/// bits.
double rise_within(double distance_u, double start_u_s, const RampLaw& up, const RampLaw& down,
                   double limit_u_s);

}  // namespace understudy::motion
