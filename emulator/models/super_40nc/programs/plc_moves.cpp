// Motion of the PLC: DRV, HOM, PJG and MJG. It never waits: a command for an axis that is in use is dropped.
#include <cstddef>
#include <cstdint>

#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/axis/ownership.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/path/manual_motions.h"
#include "emulator/models/super_40nc/programs/program_machine.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/ownership.h"
#include "interpreter/super_40nc/requests.h"

namespace understudy::emulator::models::super_40nc {

using language::Area;

/// Returns true if, because of a choice, no axis may start when one of them is in use.
bool ProgramMachine::plc_takes_none(language::AxisSet axes, Request request) {
  if (!chose(option("plc_several_axes", "none"))) return false;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if ((axes >> axis & 1) != 0 && controls_.parts.starts.ask(axis, request) != Grant::starts) return true;
  }
  return false;
}

void ProgramMachine::plc_drive(const language::Drive& drive, int step) {
  ground_.set_plc_step(step);
  language::AxisSet axes = 0;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (is_set(drive.target_lu, axis)) axes = static_cast<language::AxisSet>(axes | 1U << axis);
  }
  if (plc_takes_none(axes, Request::plc_drv)) return ground_.set_plc_step(0);
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (!is_set(drive.target_lu, axis) || controls_.keys.is_inhibited(axis)) continue;
    if (controls_.parts.starts.ask(axis, Request::plc_drv) != Grant::starts) continue;
    const std::int64_t base = drive.targets == language::Targets::relative ? relative_base_lu(axis) : 0;
    controls_.parts.drives.begin_drive(axis, base + value_of_axis(drive.target_lu, axis),
                                       drive.rpm[static_cast<std::size_t>(axis)], Mover::plc);
  }
  ground_.set_plc_step(0);
}

void ProgramMachine::plc_home(const language::HomeSearch& search, int step) {
  ground_.set_plc_step(step);
  if (plc_takes_none(search.axes, Request::home_or_zero)) return ground_.set_plc_step(0);
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if ((search.axes >> axis & 1) == 0 || controls_.keys.is_inhibited(axis)) continue;
    AxisState& state = state_of(axis);
    const bool is_free = state.holder == Activity::nobody;
    if (is_free) state.mover = Mover::plc;  // applies only if the motion begins
    controls_.parts.homes.start_home(axis);
    if (state.holder != Activity::home) state.mover = is_free ? Mover::hand : state.mover;
  }
  ground_.set_plc_step(0);
}

bool ProgramMachine::plc_jog(const language::Jogs& jogs, const language::JogSteps& steps) {
  const bool stops_both = chose(option("both_jogs", "both_stop_it"));
  const bool swaps = chose(option("x52_scope", "pjg_and_mjg_as_well"));
  for (int axis = 0; axis < kAxisCount; ++axis) {
    AxisState& state = state_of(axis);
    const bool is_swapped = swaps && registers().is_on(stored_x(d9x::kJogDirection), axis);
    const bool positive = ((is_swapped ? jogs.negative : jogs.positive) >> axis & 1) != 0;
    const bool negative = ((is_swapped ? jogs.positive : jogs.negative) >> axis & 1) != 0;
    const int running = state.asked_by_plc ? chip(axis).last_direction : 0;
    // If both directions are requested at once, the running direction continues.
    const int of_both = stops_both ? 0 : running;
    const int direction = positive && negative ? of_both : positive ? +1 : negative ? -1 : 0;
    if (running != 0 && running != direction) {
      controls_.moves.handle(axis, ManualMotion::plc_jog, ManualEvent::contact_off);
    }
    const bool is_new =
        direction != 0 && (direction != state.plc_jog_direction || controls_.keys.acts_behind_reset(axis));
    state.plc_jog_direction = static_cast<std::int8_t>(direction);
    if (!is_new || controls_.keys.is_inhibited(axis)) continue;
    const int step = steps[static_cast<std::size_t>(axis)];
    if (!language::may_move(*this, ground_.language_options(), Area::plc, axis)) {
      ground_.report({.code = Code::axis_not_owned, .step = step});
      continue;
    }
    ground_.set_plc_step(step);
    const bool is_free = state.holder == Activity::nobody;
    if (is_free) state.mover = Mover::plc;  // applies only if the motion begins
    controls_.parts.jogs.start_jog(axis, direction, &AxisState::asked_by_plc);
    if (is_free) state.mover = Mover::hand;
    ground_.set_plc_step(0);
  }
  return true;
}

}  // namespace understudy::emulator::models::super_40nc
