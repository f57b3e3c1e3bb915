// RS-M8194H: drives of single axes: decides whether they begin, wait, are held or void (transitions.h), and
// begins them.
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
  std::array<AxisMask, lang::kTriggerCount> trigger_holds{};  // axes that the level of a channel holds

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
  /// Returns whether a path may begin on these axes now, provided that no path is running.
  Start may_start(AxisMask axes, Starter who) const;
  Start may_start(std::size_t axis, Starter who, bool on_path = false) const;
  /// Sets the error bits for what keeps axes from starting.
  void note_obstacles(AxisMask axes);
  /// If so chosen, a drive that would be held waits behind one that is held already, or is void.
  bool waits_behind_held(AxisMask axes) const;
  bool keeps_first_held(AxisMask axes) const;
  /// Returns true if, under the chosen option, the drive is void because its speed was never set.
  bool lacks_speed(std::size_t axis, Drive::What what) const;

  // --- how they begin ---------------------------------------------------------------------------
  /// Starts a drive of single axes.
  Took drive(AxisMask axes, const Drive& what);
  /// Starts one axis without checking locks and waits; anything that it meets at its start becomes its error.
  void start(std::size_t axis, const Drive& what, bool without_ramps = false);
  void start_held();
  /// Applies a changed V: a T-shaped drive continues at the new speed, an S-shaped one keeps its own (7.1).
  void change_speed(std::size_t axis, motion::Instant at);
  /// Discards the part of an axis's remaining work that this event removes (transitions.h).
  void take_off(std::size_t axis, DiscardEvent event);
  /// Forgets the errors of earlier motions, for a drive that starts.
  void forget_errors(std::size_t axis);
  /// Checks the rest of a drive that a pause holds. Anything that would have ended the drive ends the rest.
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
