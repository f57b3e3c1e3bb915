// Stops, holds and continues an axis, whether it is moving alone or on a path.
#pragma once

#include <optional>

#include "emulator/models/super_40nc/axis/axis_parts.h"
#include "emulator/models/super_40nc/path/manual_motions.h"
#include "emulator/models/super_40nc/path/paths.h"
#include "motion/axis.h"

namespace understudy::emulator::models::super_40nc {

/// Reports that a program has lost a motion because of an obstacle to its axis. The axis is released; -1
/// means several axes.
struct Broken {
  Mover mover = Mover::c;
  int axis = -1;
  bool is_awaited = false;  // a line is waiting for it
  motion::Cause why = motion::Cause::none;
};

class Moves : protected Chips {
 public:
  Moves(AxisParts& parts, Paths& paths) : Chips(parts.chips), parts_(parts), paths_(paths) {}

  /// Stops immediately. A home or zero return that is abandoned has no further effect.
  void stop_axis(int axis_number, Code code = Code::none);
  /// Executes VDRV 0. Returns true if the axis must first stop.
  bool end_by_ramp(int axis_number, Mover mover);
  /// Stops because of STP, a STOP key or M8x02.
  void stop_by_command(int axis_number);
  void stop_all_of(Mover mover);
  /// Stops all axes that a program is moving, after an obstacle to one of them.
  void break_program(Mover mover, int but_for = -1);
  /// Called when the motor has stopped without a command.
  std::optional<Broken> ended(int axis_number);

  void hold_axis(int axis_number);
  std::optional<Broken> resume_axis(int axis_number);

  /// Returns the motion by hand, or nothing if a program line is waiting for the axis.
  std::optional<ManualMotion> manual_motion(int axis_number) const;
  /// Handles an event according to the table in manual_motions.h.
  void handle(int axis, ManualEvent event, Code code = Code::none);
  void handle(int axis, ManualMotion motion, ManualEvent event, Code code = Code::none);

 private:
  void rest_axis(int axis_number);
  std::optional<Broken> cannot_resume(int axis_number, const Rest& rest, Mover mover, bool is_awaited);

  AxisParts& parts_;
  Paths& paths_;
};

}  // namespace understudy::emulator::models::super_40nc
