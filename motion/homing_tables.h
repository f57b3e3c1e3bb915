// The homing sequences of the four controllers, as tables for motion/homing.h. They are created from the
// parameters, in pulses and pulses per second. The devices set their counters afterwards.
#pragma once

#include <array>
#include <cstdint>

#include "motion/homing.h"

namespace understudy::motion {

/// SUPER-40NC, parameters X20 to X31 (manual, 《X20.》): 13 modes, based on those of the PCL6045 chip.
/// Signals: home is DOG, index is EZ.
struct Super40ncHoming {
  int mode = 0;                      // X20, 0 .. 12
  int direction = +1;                // X23
  SpeedLaw fast;                     // X21, Vh
  SpeedLaw creep;                    // X22, Vc
  std::int32_t index_count = 1;      // X31 + 1
  std::int64_t leave_pulses = 5;     // X25: the distance to leave a DOG that is on at the start; 0 acts as 1
  std::int64_t offset_pulses = 0;    // X30, signed, independent of `direction`
  bool limit_stops_at_once = false;  // modes 6 to 8 and 12: as in the chip with D9x01 = 0
  bool leaves_fast = false;          // true: leaves a DOG that is on at the start at `fast`
  bool offset_creeps = false;        // true: the return to the reference and the offset use the creep speed
  bool plate_may_be_short = false;   // true: a DOG that is off after the stop is ignored
  bool turns_at_limit = false;  // true: at a limit before the DOG, returns past the DOG and searches again;
                                // false: homing fails
};
/// Returns the table of a mode. The reference is the edge of the DOG (modes 0, 1, 9) or of the limit (6),
/// otherwise the last EZ counted. Throws BadMotion(out_of_range) for a mode that does not exist.
HomingProgram super40nc_homing(const Super40ncHoming& how);
/// Returns true for modes that search for the limit on the side of `direction`. They cannot find home if that
/// limit is not in use.
bool super40nc_homes_by_limit(int mode);

/// SUPER-40NC, instruction MRK: the axis passes its target at the creep speed and continues to a mark on one
/// of the limit inputs. The reference is the mark; if no mark was met, the reference is not known. In both
/// cases, home counts as found.
struct Super40ncMark {
  std::int64_t distance_pulses = 0;
  std::int64_t search_pulses = 0;     // X16: how far to search for the mark; above 0 for +EL, below 0 for -EL
  SpeedLaw fast;                      // the speed set by RPM
  SpeedLaw creep;                     // X22
  bool slows_behind = false;          // true: decelerates after the target, and searches at the creep speed
  bool searches_all_the_way = false;  // true: a mark before the target also ends the move
  bool mark_slows = false;            // true: the mark stops the axis along its ramp
  bool needs_edge = false;            // true: a mark that is on when the search begins does not count
};
/// Throws BadMotion(out_of_range) for a search distance of 0.
HomingProgram super40nc_mark(const Super40ncMark& how);

/// RS-M8194H, SET_HV, HOME_LIMIT, SET_HOME_MODE (manual, 6 and 4.8): four steps of the MCX314 chip, each with
/// its own direction or skipped. Signals: near_home is IN0, home is IN1, index is IN2. A phase's code is the
/// value that input 92 + a shows during the phase.
struct Rsm8194hHoming {
  std::array<int, 4> directions{};   // the directions of steps 1 to 4: +1, -1, or 0 to skip the step
  SpeedLaw drive;                    // V: steps 1 and 4
  SpeedLaw home;                     // HV: steps 2 and 3
  std::int64_t offset_pulses = 0;    // the offset of step 4, >= 0
  bool limit_is_home = false;        // HOME_LIMIT 1: the limit in step 2's direction replaces HOME
  bool limit_is_near_home = false;   // HOME_LIMIT 1: the limit in step 1's direction replaces NHOME
  bool soft_limits_lead_on = false;  // true: soft limits act like hardware limits
};
HomingProgram rsm8194h_homing(const Rsm8194hHoming& how);

/// Simple2-R3, *_Home_Speed, *_Home_AccTime, *_GoHome_DIR. The manual does not describe the sequence. This
/// one always ends on the edge of the home switch that the axis meets in `direction`, wherever it began.
struct Simple2Homing {
  int direction = -1;  // GoHome_DIR: 0 is -1, 1 is +1
  SpeedLaw speed;      // with a top speed of 0 the axis does not move, as in every Simple2-R3 move
};
HomingProgram simple2_homing(const Simple2Homing& how);

/// SLIM, H: moves at -VJ until horg is on, then slows down.
struct SlimHoming {
  int direction = -1;  // +1 for a negative VJ
  SpeedLaw jog;        // VJ; with a top speed of 0 the axis does not move
};
HomingProgram slim_homing(const SlimHoming& how);

}  // namespace understudy::motion
