// The chip's CLR, LTC and ERC, which are fitted only by choice.
#pragma once

#include <cstddef>

#include "base/simulated_time.h"
#include "emulator/models/super_40nc/axis/axis_parameters.h"
#include "emulator/models/super_40nc/axis/chips.h"
#include "emulator/models/super_40nc/axis/counters.h"

namespace understudy::emulator::models::super_40nc {

class ChipPins : protected Chips {
 public:
  ChipPins(const Chips& chips, AxisParameters& parameters, Counters& counters)
      : Chips(chips), parameters_(parameters), counters_(counters) {}

  bool has_chip_pins() const { return chose(option("pins_fitted", "also_clr_ltc_and_erc")); }
  void see_pins();
  void hold_cleared();
  /// Returns true while ERC is given (M8x49, M8x52, M8x53).
  bool gives_erc(int axis) const { return now() < axes_.erc_until[static_cast<std::size_t>(axis)]; }
  void give_erc(int axis);
  void give_erc_behind(int axis, Code code);
  /// Returns the first tick after `done` at which an ERC ends.
  Tick next_end_of_erc(Tick done) const;

 private:
  void clear_by_pin(int axis);

  AxisParameters& parameters_;
  Counters& counters_;
};

}  // namespace understudy::emulator::models::super_40nc
