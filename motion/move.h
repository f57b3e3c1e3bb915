// A move from rest to rest, and the changes possible while it runs: another speed, another target, a stop.
//
//   speed    top ______
//           /          \            start: the speed that a stepper jumps to, and stops from
//   start  |            |___        creep: the rest, at the start speed, if deceleration began early
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
  cut_ramp,   // acceleration is broken off where deceleration must begin: on a rounded ramp the acceleration
              // then jumps (PCL6045 without FH correction)
};

/// How fast a coordinate moves: everything that defines a move except its distance.
struct SpeedLaw {
  double start_speed_u_s = 0;  // >= 0; from top_speed_u_s up, the move keeps the top speed
  double top_speed_u_s = 0;    // > 0
  RampLaw up{};
  RampLaw down{};
  Short when_short = Short::lower_top;

  // Deceleration begins when the remaining distance equals that of the ramp down, by `down` or, if given, by
  // the law that the chip calculates with; or at a fixed remaining distance. The offset is added to it. If
  // deceleration begins early, the axis creeps the rest at the start speed; if late, the move ends abruptly
  // on its target (a declared chip cut-off).
  std::optional<RampLaw> slow_down_reckoned_by{};  // SUPER-40NC: deceleration longer than 2 x acceleration
  std::optional<double> slow_down_at_u{};          // PCL6045 PRDP: >= 0, instead of calculating
  double slow_down_offset_u = 0;                   // MCX314 AO

  bool operator==(const SpeedLaw&) const = default;
};

/// Throws BadMotion, naming the quantity, for values that are not finite or outside the domains above.
void check(const SpeedLaw& law);

/// Plans the move over `distance_u` >= 0, from 0, that ends exactly on `distance_u`; a distance of 0 gives
/// the empty profile. Throws as check() does, and BadMotion(not_positive) when the move would have to creep
/// at a start speed of 0.
Profile plan(double distance_u, const SpeedLaw& law);

/// Plans a run from rest up to the top speed, which is then kept forever.
Profile plan_endless(const SpeedLaw& law);

/// Plans a run from rest that passes `distance_u` at `passing_speed_u_s` > 0, by `law.down`, and then keeps
/// that speed forever. If the distance is too short to slow down in, or the top speed is not above the
/// passing speed, the whole run is at the passing speed.
Profile plan_passing(double distance_u, double passing_speed_u_s, const SpeedLaw& law);

/// Plans a change from any state (speed >= 0; position counted from the move's beginning) to another speed >=
/// 0, which is then kept forever; speed 0 is a stop. Speeds between 0 and the start speed are skipped. Throws
/// as check() does.
Profile change_speed(const Sample& now, double speed_u_s, const SpeedLaw& law);

/// Plans a stop from any state: the speed falls to the start speed and the motion ends there. A motion below
/// the start speed ends at once.
Profile slow_to_stop(const Sample& now, const SpeedLaw& law);

/// Plans a change from any state (speed >= 0) to a target further on, or to one that is already passed or too
/// near to stop at; the motion then stops and comes back. `law` may differ from the one that the move began
/// with; its when_short is for moves from rest. With the same law and target as before, the move continues
/// unchanged, with two exceptions: ramps by time begin again, and moves that are cut off come back once they
/// slow down. Distances below about 1e-9 count as 0.
Profile change_target(const Sample& state, double target_u, const SpeedLaw& law);

}  // namespace understudy::motion
