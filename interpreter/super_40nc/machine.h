// The device on which the PLC and the step programs act, as an abstract interface.
#pragma once

#include <cstdint>
#include <span>

#include "base/program_watch.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/named.h"
#include "interpreter/super_40nc/requests.h"

namespace understudy::interpreter::super_40nc {

/// The layout of the plain contacts and registers in Machine::cells(): for each letter, the cell of number 0.
/// A contact is 0 or 1; a register contains its 32 bits.
struct CellLayout {
  std::uint32_t x = 0;        // X0 to X47
  std::uint32_t y = 0;        // Y0 to Y31
  std::uint32_t m = 0;        // M0 to M511
  std::uint32_t t = 0;        // T0 to T63: contacts
  std::uint32_t c = 0;        // C0 to C31
  std::uint32_t t_value = 0;  // T0 to T63: current values
  std::uint32_t c_value = 0;
  std::uint32_t d = 0;  // D0 to D999
  bool operator==(const CellLayout&) const = default;
};

/// The result of a motion that a step program requests.
enum class Begun : std::uint8_t {
  done,     // there is nothing to wait for
  runs,     // runs until is_running() returns false
  taken,    // an axis is taken: nothing has changed, and the program tries again in the next tick
  ignored,  // no effect; the machine has reported the reason if it has a code
  refused,  // because of a limit or an alarm, which is reported and resets the program
};

/// The interface to the device. Any call may start, stop and replace programs, even the program whose line
/// makes the call (D8000, D8020, D9001). Therefore, the current line is a copy, and the caller of a scan
/// keeps the ladder until the scan ends.
class Machine : public Watched {
 public:
  virtual ~Machine() = default;

  // --- contacts and registers ---------------------------------------------------------------------
  virtual CellLayout layout() const = 0;
  /// The cells stay at the same address as long as the machine exists.
  virtual std::span<std::uint32_t> cells() = 0;
  /// Called when a retentive plain cell (kBlocks) has changed.
  virtual void retentive_cell_written(std::uint32_t cell) = 0;
  /// Returns M8000 to M8699, as a read from outside would return it now.
  virtual bool special_contact(int number) const = 0;
  /// Writes the contact as a host would. Returns true if this changes anything, now or later.
  virtual bool set_special_contact(int number, bool on) = 0;
  /// Like the functions above, for D8000 to D8599 and D9000 to D9499.
  virtual std::int32_t special_register(int number) const = 0;
  virtual bool set_special_register(int number, std::int32_t value) = 0;
  /// Returns the parameter value in effect. A written value may take effect later.
  virtual std::int32_t parameter_in_force(int number) const { return special_register(number); }
  /// Returns X14 as it was at power-up: the speed of an axis until the first RPM.
  virtual std::int32_t rpm_at_power_up(int axis) const = 0;

  /// Reports an error in a line of this area in D8094 to D8096. `step` counts from the area's base, as in
  /// D8095.
  virtual void report(Code code, Area area, int step) = 0;

  // --- step programs ------------------------------------------------------------------------------
  /// Returns true if M8x02, M8002 or CEMG is ON, or the axis's STOP key is pressed, so that the program
  /// cannot start.
  virtual bool is_held_in_reset(Area area) const = 0;
  /// Called when a program starts or continues. Clears D8094 to D8096, unless a choice keeps them.
  virtual void program_starts(Area area) = 0;
  /// Called when a program has reached END. Outputs its signal (Y9, Y4 to Y7).
  virtual void program_ended(Area area) = 0;

  virtual Begun begin(Area by, const LinearMove& move) = 0;
  virtual Begun begin(Area by, const CentreArc& arc) = 0;
  virtual Begun begin(Area by, const PointArc& arc) = 0;
  virtual Begun begin(Area by, const RadiusArc& arc) = 0;
  virtual Begun begin(Area by, const Drive& drive) = 0;
  virtual Begun begin(Area by, const MarkSearch& search) = 0;
  virtual Begun begin(Area by, const HomeSearch& search) = 0;
  /// Returns `runs` if an axis must first stop.
  virtual Begun begin(Area by, const Rotation& rotation) = 0;
  virtual Begun begin(Area by, const WheelRatios& ratios) = 0;
  /// Returns true while the motion for which a program waits is in progress: from a begin() that returned
  /// `runs` until the motion arrives, or is abandoned without resetting the program. A held motion counts as
  /// running.
  virtual bool is_running(Area by) const = 0;
  /// M8006, PAUSE: the program's motion stops along its ramp but still belongs to the program. Axes that
  /// follow the wheel continue.
  virtual void hold(Area by) = 0;
  /// Continues held motion. A home search begins again.
  virtual void resume_motions(Area by) = 0;
  /// Drops held motion.
  virtual void drop_held(Area by) = 0;
  /// STP: for C, stops everything that C moves; for another area, stops everything that moves its axis.
  /// Returns the other programs that have lost the motion of a line as a result, and are reset.
  virtual Areas stop(Area area) = 0;
  /// Called when a program ends or restarts. The motion for which it was waiting continues without it.
  virtual void waits_no_more(Area by) = 0;

  // --- the PLC --------------------------------------------------------------------------------------
  /// Starts each free axis; the others are skipped. `rpm` contains the PLC's own speeds. `step` is the step
  /// number of the line, counted as in D8095.
  virtual void plc_drive(const Drive& drive, int step) = 0;
  virtual void plc_home(const HomeSearch& search, int step) = 0;
  /// Called at the end of each scan that requests the jog of an axis, or that follows a scan which requested
  /// one. `steps` contains the step numbers of the lines, counted as in D8095. Returns true if this may
  /// change anything.
  virtual bool plc_jog(const Jogs& jogs, const JogSteps& steps) = 0;

  // --- both -----------------------------------------------------------------------------------------
  /// Returns true if anything has changed.
  virtual bool set_positions(const SetPositions& positions) = 0;
};

}  // namespace understudy::interpreter::super_40nc
