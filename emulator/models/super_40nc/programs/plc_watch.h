// Decides whether a PLC that has settled needs to scan. A scan that has changed nothing would do the same
// again until something that it reads changes. Writes by hosts and step programs are recorded; other values
// are checked in each tick that is run. In skipped ticks, only moving values change, as indicated in their
// rows (Varies).
#pragma once

#include <vector>

#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "interpreter/super_40nc/ladder.h"

namespace understudy::emulator::models::super_40nc {

class PlcWatch {
 public:
  explicit PlcWatch(const RegisterBank& bank) : bank_(bank) {}

  /// Finds the values that the ladder reads and that may change without a recorded write.
  void find(const interpreter::super_40nc::Ladder& ladder);
  /// Records what the PLC sees now.
  void note();
  /// Returns true if everything is still as recorded.
  bool is_as_seen() const;
  /// Returns true if some of the values change with an axis's pulses.
  bool some_move() const { return some_move_; }

 private:
  const RegisterBank& bank_;
  // Working data, not part of the state.
  std::vector<Place> places_;
  bool some_move_ = false;
  std::vector<Value> seen_;  // values that the PLC saw in this tick
};

}  // namespace understudy::emulator::models::super_40nc
