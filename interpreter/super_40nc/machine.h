// What the PLC and the step programs act on: the device, as an abstract machine.
#pragma once

#include <cstdint>
#include <span>

#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/requests.h"

namespace understudy::interpreter::super_40nc {

/// Where the plain contacts and registers are among Machine::cells(): the cell of number 0 of each. A contact
/// is 0 or 1, a register its 32 bits.
struct CellLayout {
  std::uint32_t x = 0;        // X0 to X47
  std::uint32_t y = 0;        // Y0 to Y31
  std::uint32_t m = 0;        // M0 to M511
  std::uint32_t t = 0;        // T0 to T63: contacts
  std::uint32_t c = 0;        // C0 to C31
  std::uint32_t t_value = 0;  // T0 to T63: present values
  std::uint32_t c_value = 0;
  std::uint32_t d = 0;  // D0 to D999
  bool operator==(const CellLayout&) const = default;
};

/// What became of a motion that a step program asked for.
enum class Begun : std::uint8_t {
  done,     // there was nothing to move; its signal has come
  runs,     // until is_running() says otherwise
  taken,    // an axis is taken: nothing has changed, and the program asks again at the next tick
  void_,    // lost; the machine has reported why, if there is a code for it
  refused,  // a limit or an alarm, reported: it resets the program
};

/// Whatever it is told to do may start, stop and replace programs, also the one whose line tells it (D8000,
/// D8020, D9001): a line at work is a copy, and whoever has a scan run keeps its ladder until that is over.
class Machine {
 public:
  virtual ~Machine() = default;

  // --- contacts and registers ---------------------------------------------------------------------
  virtual CellLayout layout() const = 0;
  /// Stay where they are as long as the machine does.
  virtual std::span<std::uint32_t> cells() = 0;
  /// A plain one that survives power-off (kBlocks) has another value now.
  virtual void kept_cell_written(std::uint32_t cell) = 0;
  /// M8000 to M8699 as a read from outside would show it now.
  virtual bool special_contact(int number) const = 0;
  /// As a write from outside. Returns whether anything has changed, or will because of it.
  virtual bool set_special_contact(int number, bool on) = 0;
  /// D8000 to D8599, D9000 to D9499: the same.
  virtual std::int32_t special_register(int number) const = 0;
  virtual bool set_special_register(int number, std::int32_t value) = 0;
  /// A parameter as it acts: it may have been written, and not act yet.
  virtual std::int32_t parameter_in_force(int number) const { return special_register(number); }
  /// X14 as it was at power-up: what an axis turns at until the first RPM.
  virtual std::int32_t rpm_at_power_up(int axis) const = 0;

  /// D8094 to D8096, of a line of this area. `step` counts from the area's base, as D8095 does.
  virtual void report(Code code, Area area, int step) = 0;

  // --- step programs ------------------------------------------------------------------------------
  /// M8x02, M8002 or CEMG is ON: it cannot start.
  virtual bool is_held_in_reset(Area area) const = 0;
  /// It starts or goes on: D8094 to D8096 are cleared.
  virtual void program_starts(Area area) = 0;
  /// It has met END: its signal comes (Y9, Y4 to Y7).
  virtual void program_ended(Area area) = 0;

  virtual Begun begin(Area by, const LinearMove& move) = 0;
  virtual Begun begin(Area by, const CentreArc& arc) = 0;
  virtual Begun begin(Area by, const PointArc& arc) = 0;
  virtual Begun begin(Area by, const RadiusArc& arc) = 0;
  virtual Begun begin(Area by, const Drive& drive) = 0;
  virtual Begun begin(Area by, const MarkSearch& search) = 0;
  virtual Begun begin(Area by, const HomeSearch& search) = 0;
  /// `runs` if an axis has to come to rest first.
  virtual Begun begin(Area by, const Rotation& rotation) = 0;
  virtual Begun begin(Area by, const WheelRatios& ratios) = 0;
  /// Whether what a program waits for still moves: from begin() that said `runs` until it has arrived, or was
  /// given up without resetting the program. A motion that is held is running.
  virtual bool is_running(Area by) const = 0;
  /// M8006, PAUSE: what the program moves comes to rest by its ramp and stays its own, but not what follows
  /// the wheel.
  virtual void hold(Area by) = 0;
  /// What was held goes on; a home search begins again.
  virtual void go_on(Area by) = 0;
  /// What was held is forgotten.
  virtual void drop_held(Area by) = 0;
  /// STP: C: all that C moves stops at once. Another one: whatever moves its axis. Returns the programs that
  /// have lost the motion of a line by it, besides `area`: they are reset.
  virtual Areas stop(Area area) = 0;
  /// A program is over, or begins anew: what it has waited for goes on by itself, if it does.
  virtual void waits_no_more(Area by) = 0;

  // --- the PLC --------------------------------------------------------------------------------------
  /// Starts each axis that is free; the others are void. `rpm` is the PLC's own, `step` the line's as D8095
  /// counts.
  virtual void plc_drive(const Drive& drive, int step) = 0;
  virtual void plc_home(const HomeSearch& search, int step) = 0;
  /// At the end of each scan in which some axis is, or was in the scan before, to be jogged; `steps` are the
  /// lines' as D8095 counts. Returns whether anything may change by it.
  virtual bool plc_jog(const Jogs& jogs, const JogSteps& steps) = 0;

  // --- both -----------------------------------------------------------------------------------------
  /// Returns whether anything has changed.
  virtual bool set_positions(const SetPositions& positions) = 0;
};

/// The registers and contacts of the device that programs depend on without naming them.
namespace named {
inline constexpr int kSingleStep = 8001;  // M8x01 of an axis program
inline constexpr int kEmergencyStop = 8002;
inline constexpr int kReset = 8102;  // of X; 100 further for each axis
inline constexpr int kMotionInhibit = 8004;
inline constexpr int kContinuous = 8007;
inline constexpr int kContinuousKey = 8600;
inline constexpr int kAlwaysOn = 8003;
inline constexpr int kFeed = 8006;            // D
inline constexpr int kPlane = 8007;           // D
inline constexpr int kOwnedAxes = 9003;       // C21
inline constexpr int kContinuousPath = 9005;  // D
inline constexpr int kDefaultFeed = 9004;     // C10
inline constexpr int kTargetsOfC = 9006;      // C20
inline constexpr int kDefaultPlane = 9016;    // C23
inline constexpr int kTargetsOfX = 9173;      // X15; 100 further for each axis
}  // namespace named

}  // namespace understudy::interpreter::super_40nc
