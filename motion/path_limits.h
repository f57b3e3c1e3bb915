// How much of a path's speed falls on each axis.
#pragma once

#include "motion/path.h"

namespace understudy::motion {

/// For each axis the greatest size its part of the unit direction has anywhere along the path: 0 where it
/// does not move, at most 1. Of a spiral an upper bound, else exact (but for a helix in an oblique plane). An
/// axis with a speed limit of its own allows a path speed of that limit divided by this (SUPER-40NC: no axis
/// exceeds its X12).
Point greatest_direction(const Path& path);

/// The greatest speed along the path at which no axis exceeds its limit (each > 0, in path units a second);
/// infinite for a path that moves no axis. By true length, whatever the path's measure.
double speed_within(const Path& path, const Point& axis_limits_u_s);

}  // namespace understudy::motion
