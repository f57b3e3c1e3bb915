// A move from rest to rest, and the possible changes during the move: another speed, another target, a stop.
//
//   speed    top ______
//           /          \            start: the speed at which a stepper starts and stops
//   start  |            |___        creep: the rest at the start speed, if deceleration began early
//          |                |___ time
//
// Sources: the MCX314 and PCL6045 chips' laws as RS-M8194H and SUPER-40NC use them, Simple2-R3's appendix A,
// SLIM's trapezoid on a path. u is the coordinate's unit (motion/profile.h).
#pragma once

#include <cstdint>
#include <optional>

#include "motion/profile.h"
#include "motion/ramp.h"

namespace understudy::motion {

/// What happens when the distance is too short to reach the top speed.
enum class Short : std::uint8_t {
  lower_top,  // the top speed is lowered so that both complete ramps just fit: a triangle, or its rounded
              // form (PCL6045 with FH correction; MCX314 S-curve; every trapezoid)
  keep_half,  // acceleration ends early enough for both ramps to take half the distance; the other half is
              // run at constant speed (MCX314 with AVTRI)
  cut_ramp,   // acceleration is broken off where deceleration must begin; on a rounded ramp, the acceleration
              // then jumps (PCL6045 without FH correction)
};

/// How fast a coordinate moves: everything that defines a move except its distance.
struct SpeedLaw {
  double start_speed_u_s = 0;  // >= 0; if it is at least top_speed_u_s, the move keeps the top speed
  double top_speed_u_s = 0;    // > 0
  RampLaw up{};
  RampLaw down{};
  Short when_short = Short::lower_top;

  // Deceleration begins when the remaining distance equals the length of the deceleration ramp, calculated
  // with `down` or with the law that the chip assumes, if that is set; or at a fixed remaining distance. The
  // offset is added to this distance. If deceleration begins early, the axis covers the rest at the start
  // speed. If it begins late, the move ends abruptly at its target (a declared chip cut-off).
  std::optional<RampLaw> slow_down_reckoned_by{};  // SUPER-40NC: deceleration longer than 2 x acceleration
  std::optional<double> slow_down_at_u{};          // PCL6045 PRDP: >= 0, replaces the calculation
  double slow_down_offset_u = 0;                   // MCX314 AO

  bool operator==(const SpeedLaw&) const = default;
};

/// Throws BadMotion, which names the quantity, for values that are not finite or outside the ranges above.
void check(const SpeedLaw& law);

/// Plans the move from 0 over `distance_u` >= 0, which ends exactly at `distance_u`. A distance of 0 results
/// in an empty profile. Throws the same errors as check(), and BadMotion(not_positive) if the move would have
/// to creep at a start speed of 0.
Profile plan(double distance_u, const SpeedLaw& law);

/// Plans a run from rest to the top speed, which then continues forever.
Profile plan_endless(const SpeedLaw& law);

/// Plans a run from rest that passes `distance_u` at `passing_speed_u_s` > 0, decelerating by `law.down`, and
/// then keeps that speed forever. If the distance is too short for the deceleration, or the top speed does
/// not exceed the passing speed, the whole run is at the passing speed.
Profile plan_passing(double distance_u, double passing_speed_u_s, const SpeedLaw& law);

/// Plans a change from any state (speed >= 0; position counted from the beginning of the move) to another
/// speed >= 0, which then continues forever. Speed 0 is a stop. Speeds between 0 and the start speed are
/// skipped. Throws the same errors as check().
Profile change_speed(const Sample& now, double speed_u_s, const SpeedLaw& law);

/// Plans a stop from any state: the speed decreases to the start speed and the motion ends there. A motion
/// below the start speed ends at once.
Profile slow_to_stop(const Sample& now, const SpeedLaw& law);

/// Plans a change from any state (speed >= 0) to another target. If the target is already passed or too near
/// to stop at, the motion stops and returns. `law` may differ from the law with which the move began; its
/// when_short applies to moves from rest. With the same law and target as before, the move continues
/// unchanged, with two exceptions: ramps by time begin again, and moves that are cut off return once they
/// slow down. Distances below about 1e-9 count as 0.
Profile change_target(const Sample& state, double target_u, const SpeedLaw& law);

}  // namespace understudy::motion
