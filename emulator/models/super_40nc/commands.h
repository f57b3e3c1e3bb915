// Handles command contacts in a scan, in this order: emergency, resets, STOP keys, panel pages, M8008, ZERO
// SET, HOME, ZERO, jog, hand wheel. If a contact stays ON after a void request or a stop, it must go OFF
// before it has an effect again.
#pragma once

#include "base/simulated_time.h"
#include "emulator/models/super_40nc/axis/axis_parts.h"
#include "emulator/models/super_40nc/panel/hand_moves.h"
#include "emulator/models/super_40nc/panel/pressed_keys.h"
#include "emulator/models/super_40nc/path/moves.h"
#include "emulator/models/super_40nc/path/paths.h"
#include "emulator/models/super_40nc/programs/programs.h"

namespace understudy::emulator::models::super_40nc {

struct ScanState {
  bool run_switch = false;  // PLC_RUN as sampled in this tick
  bool emergency_obeyed = false;
  bool was_inhibited = false;  // M8004 in the last scan
  Tick logo_at = kNever;       // when M8502 goes on
  bool logo_over = false;

  bool operator==(const ScanState&) const = default;
};

class Commands : protected Chips {
 public:
  Commands(const Controls& controls, HandMoves& hands, Programs& programs, ProgramState& program_state,
           ScanState& state)
      : Chips(controls.parts.chips),
        parts_(controls.parts),
        paths_(controls.paths),
        moves_(controls.moves),
        keys_(controls.keys),
        hands_(hands),
        programs_(programs),
        program_state_(program_state),
        state_(state) {}

  /// Handles the contacts in a scan, if anything was written since the last scan.
  void check_contacts();
  /// Returns true if axes have errors that the next scan clears (a choice).
  bool has_errors_for_a_scan() const;
  /// Called after the PLC, which has seen them.
  void forget_errors_of_a_scan();

 private:
  void apply_contacts();
  void apply_stops();
  void apply_emergency();
  void stop_by_emergency(Area area, bool is_new);
  void apply_pages();
  void reset_parameters();
  void hold_while_inhibited();
  void drop_edges();
  void see_contacts();

  AxisParts& parts_;
  Paths& paths_;
  Moves& moves_;
  PressedKeys& keys_;
  HandMoves& hands_;
  Programs& programs_;
  ProgramState& program_state_;
  ScanState& state_;
};

}  // namespace understudy::emulator::models::super_40nc
