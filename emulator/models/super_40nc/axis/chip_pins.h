// The chip's CLR, LTC and ERC, which are present only if a choice says so.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/super_40nc/axis/axis_parameters.h"
#include "emulator/models/super_40nc/axis/chips.h"
#include "emulator/models/super_40nc/axis/counters.h"
#include "emulator/models/super_40nc/rows/terminals.h"

namespace understudy::emulator::models::super_40nc {

class ChipPins : protected Chips {
 public:
  ChipPins(const Chips& chips, AxisParameters& parameters, Counters& counters)
      : Chips(chips), parameters_(parameters), counters_(counters) {}

  using Chips::has_chip_pins;
  void see_pins();
  /// Handles a change of CLR or LTC at its moment, up to which the counters have already counted. `speed` is
  /// the chip's speed at that moment.
  void pin_changes(int axis, ChipPin pin, bool is_on, std::int64_t speed);
  /// Clears the counters in the mask D9x27.
  void clear_by_pin(int axis);
  /// Clears the counters that CLR holds at 0. Since COUNTER1 follows the travel, it is reset at the end of
  /// each tick.
  void hold_cleared();
  /// Returns true while ERC is output (M8x49, M8x52, M8x53).
  bool gives_erc(int axis) const { return now() < axes_.erc_until[static_cast<std::size_t>(axis)]; }
  void give_erc(int axis);
  void give_erc_behind(int axis, Code code);
  /// Returns the first tick after `done` in which an ERC ends.
  Tick next_end_of_erc(Tick done) const;

 private:
  void see(int axis, ChipPin pin, bool is_on);

  AxisParameters& parameters_;
  Counters& counters_;
};

}  // namespace understudy::emulator::models::super_40nc
