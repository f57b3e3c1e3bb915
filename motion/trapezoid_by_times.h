// Trapezoid by times: a move whose acceleration and deceleration take given times.
//
//   speed   ________ top
//          /        \            TA and TD are satisfied first; the top speed is lowered so that
//         /          \           the distance comes out (a triangle when it is short).
//        / TA  TC  TD \ time
//
// Law: Simple2-R3 manual, appendix A, read consistently (area (TA+TD)*R/2, as its own worked example
// and its line for TC have it): R = min(V, 2P/(TA+TD)), TC = P/R - (TA+TD)/2, TT = TA+TC+TD.
#pragma once

#include <cstdint>

#include "motion/profile.h"

namespace understudy::motion {

struct TrapezoidByTimes {
  std::int64_t distance_pulses = 0;  // >= 0
  double top_speed_pps = 0;          // > 0, the limit; short moves stay below
  double acceleration_time_s = 0;    // > 0
  double deceleration_time_s = 0;    // > 0
};

/// The profile of the move; a distance of 0 gives the empty profile. Throws std::invalid_argument,
/// naming the quantity, for what is outside the domain above or not finite.
Profile plan(const TrapezoidByTimes& move);

}  // namespace understudy::motion
