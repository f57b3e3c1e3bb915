// The PLC of a SUPER-40NC, which makes one scan over a ladder (ladder.h) in each tick. Its state between
// scans is a plain value. (Manual, 軟體架構, END 指令.)
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "interpreter/super_40nc/ladder.h"
#include "interpreter/super_40nc/machine.h"
#include "interpreter/super_40nc/options.h"
#include "interpreter/super_40nc/requests.h"

namespace understudy::interpreter::super_40nc {

struct PlcState {
  bool runs = false;
  bool is_first_scan = false;          // the first scan since RUN
  std::vector<std::uint8_t> memories;  // the last state that each edge contact read
  Targets targets = Targets::absolute;
  std::array<std::int32_t, kAxisCount> rpm{};
  bool has_modes = false;    // the modes are from an earlier RUN (a choice)
  Jogs jogs;                 // jogs of the last scan
  std::int32_t unit_ms = 0;  // elapsed time of the current unit, while timers with a larger unit run
  std::vector<std::int32_t> timed = {};  // by memory: timer values, if writes to them are ignored

  bool operator==(const PlcState&) const = default;
};

/// The PLC's control of step programs.
class StepControl {
 public:
  virtual ~StepControl() = default;
  virtual void start(Area area) = 0;  // STR
  virtual void stop(Area area) = 0;   // STP
};

struct Scanned {
  /// True if the scan has changed anything except timers whose value is not read. If false, all further scans
  /// would have the same result until something in Ladder::reads() changes, or until `quiet_scans` scans have
  /// passed.
  bool has_changed = false;
  std::int64_t quiet_scans = INT64_MAX;
};

/// Switches to RUN, including at power-up and after another program was loaded. The X contacts must be up to
/// date.
void run(PlcState& plc, const Ladder& ladder, Machine& machine, const Options& options = {});
/// Switches to STOP. Jogs of the PLC stop along a ramp; everything else continues and keeps its state.
void stop(PlcState& plc, Machine& machine);

/// Runs one scan, which takes 1 ms. Does nothing in STOP.
Scanned scan(PlcState& plc, const Ladder& ladder, Machine& machine, StepControl& programs,
             const Options& options);

/// Runs several quiet scans at once, at most Scanned::quiet_scans.
void fast_forward(PlcState& plc, const Ladder& ladder, Machine& machine, std::int64_t scans,
                  const Options& options);

}  // namespace understudy::interpreter::super_40nc
