// The PLC of a SUPER-40NC: one scan a tick over a ladder (ladder.h). What it remembers between scans is a
// plain value. (Manual, 軟體架構, END 指令.)
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
  bool is_first_scan = false;          // since RUN
  std::vector<std::uint8_t> memories;  // of edges: what each has seen last
  Targets targets = Targets::absolute;
  std::array<std::int32_t, kAxisCount> rpm{};
  bool has_modes = false;                // of a RUN before, where they stay
  Jogs jogs;                             // of the last scan
  std::int32_t unit_ms = 0;              // of the present unit, while timers run that count in larger ones
  std::vector<std::int32_t> timed = {};  // by memory: values of timers, where writes to them are ignored

  bool operator==(const PlcState&) const = default;
};

/// What the PLC does to step programs.
class StepControl {
 public:
  virtual ~StepControl() = default;
  virtual void start(Area area) = 0;  // STR
  virtual void stop(Area area) = 0;   // STP
};

struct Scanned {
  /// Whether anything has changed by it, but for timers that run unseen. If not, all further scans would do
  /// the same until something in Ladder::reads() changes, or `quiet_scans` of them are over.
  bool has_changed = false;
  std::int64_t quiet_scans = INT64_MAX;
};

/// To RUN, also at power-up and when another program is loaded meanwhile; X is up to date.
void run(PlcState& plc, const Ladder& ladder, Machine& machine, const Options& options = {});
/// To STOP: what it jogs stops by a ramp; all else goes on, and stays as it is.
void stop(PlcState& plc, Machine& machine);

/// One scan, of 1 ms. Nothing in STOP.
Scanned scan(PlcState& plc, const Ladder& ladder, Machine& machine, StepControl& programs,
             const Options& options);

/// As many quiet scans at once, at most Scanned::quiet_scans.
void cross(PlcState& plc, const Ladder& ladder, Machine& machine, std::int64_t scans, const Options& options);

}  // namespace understudy::interpreter::super_40nc
