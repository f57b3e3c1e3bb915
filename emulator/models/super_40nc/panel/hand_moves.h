// Motions by hand: jogs and the hand wheel by contact, HOME and ZERO of all axes in their order.
#pragma once

#include "emulator/models/super_40nc/axis/axis_parts.h"
#include "emulator/models/super_40nc/panel/pressed_keys.h"
#include "emulator/models/super_40nc/path/moves.h"

namespace understudy::emulator::models::super_40nc {

class HandMoves : protected Chips {
 public:
  HandMoves(AxisParts& parts, Moves& moves, PressedKeys& keys, PanelState& state)
      : Chips(parts.chips), parts_(parts), moves_(moves), keys_(keys), state_(state) {}

  /// Starts HOME, ZERO, jogs and the wheel, and releases what is no longer requested.
  void apply_contacts();
  /// Drops the orders, because axes that are still stopping do not belong to a key that was pressed in the
  /// meantime.
  void give_up_orders();
  /// A choice makes PAUSE and M8006 slow down motion by hand.
  void slow_by_hand(int axis);

 private:
  void apply_order_keys();
  void follow_order(OrderKey& key, Activity holder, StoredRegister order_of_axis,
                    void (Homes::*start)(int, int));
  void apply_jogs(int axis);
  void apply_wheel();

  AxisParts& parts_;
  Moves& moves_;
  PressedKeys& keys_;
  PanelState& state_;
};

}  // namespace understudy::emulator::models::super_40nc
