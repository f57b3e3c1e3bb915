// RS-M8194H: drives of single axes. Decides whether they begin, wait, are held or are void (transitions.h),
// and begins them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/chip/chip.h"
#include "emulator/models/rs_m8194h/chip/scans.h"
#include "emulator/models/rs_m8194h/drives/streams.h"
#include "emulator/models/rs_m8194h/drives/transitions.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/ground.h"
#include "interpreter/rs_m8194h/machine.h"
#include "interpreter/rs_m8194h/triggers.h"
#include "motion/pulse_drive.h"

namespace understudy::emulator::models::rs_m8194h {

using lang::Took;

struct DriveState {
  bool emergency_state = false;
  std::array<AxisMask, lang::kTriggerCount> trigger_holds{};  // axes that the level of an input channel holds

  bool operator==(const DriveState&) const = default;
};

class Drives final : public Part {
 public:
  Drives(const Ground& ground, DriveState& state, Chip& chip, Scans& scans, Streams& streams)
      : Part(ground), state_(state), chip_(chip), scans_(scans), streams_(streams) {}

  DriveState& state() { return state_; }
  const DriveState& state() const { return state_; }

  void reset() { state_ = {}; }

  // --- whether they may begin (may_start.cpp) ---------------------------------------------------
  /// Returns whether a path may begin on these axes now, assuming that no path is running.
  Start may_start(AxisMask axes, Starter who) const;
  Start may_start(std::size_t axis, Starter who, bool on_path = false) const;
  /// Sets the error bits for the obstacles that prevent axes from starting.
  void note_obstacles(AxisMask axes);
  /// Depending on a choice, a drive that would be held waits until an already held drive is finished, or is
  /// void.
  bool waits_behind_held(AxisMask axes) const;
  bool keeps_first_held(AxisMask axes) const;
  /// Returns true if a choice makes the drive void because its speed was never set.
  bool lacks_speed(std::size_t axis, Drive::What what) const;

  // --- how they begin ---------------------------------------------------------------------------
  /// Starts a drive of single axes.
  Took drive(AxisMask axes, const Drive& what);
  /// Starts one axis without checking locks and waits. Any obstacle at the start becomes an error of the
  /// axis.
  void start(std::size_t axis, const Drive& what, bool without_ramps = false);
  void start_held();
  /// Applies a changed V. A T-curve drive continues at the new speed; an S-curve drive keeps its speed (7.1).
  void change_speed(std::size_t axis, motion::Instant at);
  /// Discards the part of an axis's remaining work that this event cancels (transitions.h).
  void take_off(std::size_t axis, DiscardEvent event);
  /// Clears the errors of earlier motions when a drive starts.
  void forget_errors(std::size_t axis);
  /// Checks the rest of a paused drive. Anything that would have ended the drive ends the rest.
  void check_paused(std::size_t axis);

 private:
  bool is_obstructed(std::size_t axis, Obstacle obstacle, bool on_path) const;
  bool holds_a_drive(AxisMask axes) const;
  void note_marks(std::size_t axis, DiscardEvent event) const;
  bool takes_place_of_endless(std::size_t axis, const Drive& what);

  DriveState& state_;
  Chip& chip_;
  Scans& scans_;
  Streams& streams_;
};

}  // namespace understudy::emulator::models::rs_m8194h
