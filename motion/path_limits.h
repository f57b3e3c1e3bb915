// Calculates how much of a path's speed each axis contributes.
#pragma once

#include "motion/path.h"

namespace understudy::motion {

/// Returns for each axis the largest component of the unit direction anywhere along the path: 0 if the axis
/// does not move, at most 1. For a spiral it is an upper bound; otherwise it is exact (except for a helix in
/// an oblique plane). If an axis has its own speed limit, the path speed must not exceed that limit divided
/// by this component (SUPER-40NC: no axis exceeds its X12).
Point greatest_direction(const Path& path);

/// Returns the maximum speed along the path at which no axis exceeds its limit (each > 0, in path units per
/// second), or infinity for a path that moves no axis. The speed refers to the true length, independent of
/// the path's measure.
double speed_within(const Path& path, const Point& axis_limits_u_s);

}  // namespace understudy::motion
