// The PLC: RUN and STOP, its scans, and the ticks that need no scan.
#include <algorithm>
#include <cstddef>
#include <span>

#include "base/simulated_time.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/axis/marks.h"
#include "emulator/models/super_40nc/path/manual_motions.h"
#include "emulator/models/super_40nc/programs/program_machine.h"
#include "emulator/models/super_40nc/programs/programs.h"
#include "emulator/models/super_40nc/rows/contact_rows.h"
#include "emulator/models/super_40nc/rows/data_rows.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/events.h"
#include "interpreter/super_40nc/plc.h"
#include "interpreter/super_40nc/step_programs.h"

namespace understudy::emulator::models::super_40nc {

/// Handles "plc 初始": programs that are not running start from the beginning.
void Programs::plc_to_run() {
  ProgramMachine machine(*this, controls_);
  language::run(state_.plc, *ladder_, machine, options_);
  language::StepPrograms steps(state_.steps, codes_, machine, options_);
  for (const language::AreaRow& row : language::kAreas) {
    if (row.area == language::Area::plc || chose(option("run_resets_steps", "stay"))) continue;
    steps.take(language::Event::plc_run, row.area);
    steps.set_step(row.area, 0);
  }
  ground_.clear_error();
  for (AxisState& state : axes_.axes) take_off(state, MarkEvent::plc_run);
}

void Programs::plc_to_stop() {
  ProgramMachine machine(*this, controls_);
  language::stop(state_.plc, machine);
  for (int number = 0; number < kAxisCount; ++number) controls_.moves.handle(number, ManualEvent::plc_stop);
  if (chose(option("plc_stop_timers", "are_cleared"))) clear_timers();
  if (!chose(option("plc_stop_outputs", "off"))) return;
  const std::span outputs = std::span(ground_.state().image).subspan(kFirstY.slot, kOutputCount);
  std::fill(outputs.begin(), outputs.end(), 0U);
}

/// Clears the values and contacts of timers that are not latched.
void Programs::clear_timers() {
  for (int i = 0; i < kTimers; ++i) {
    ground_.put({.slot = stored_at(Table::coil, kFirstTimerContact).slot + static_cast<std::size_t>(i)}, 0);
    ground_.put({.slot = stored_at(Table::holding, kFirstTimerValue).slot + static_cast<std::size_t>(i)}, 0);
  }
}

void Programs::run_plc() {
  ProgramMachine machine(*this, controls_);
  language::StepPrograms steps(state_.steps, codes_, machine, options_);
  const auto ladder = ladder_;
  if (!ladder->is_empty() && state_.plc.runs) {
    // A scan that changed nothing, and has no new input, would do the same again.
    notify_watch();
    const bool was_told = ground_.state().touched;
    const language::Scanned scanned = language::scan(state_.plc, *ladder, machine, steps, options_);
    state_.plc_quiet_scans = was_told || scanned.has_changed ? 0 : scanned.quiet_scans;
    if (state_.plc_quiet_scans > 0) note_what_plc_sees();
  }
}

Tick Programs::quiet_scans(bool moves) const {
  if (!plc_scans()) return kNever;
  return moves && watch_.some_move() ? 0 : state_.plc_quiet_scans;
}

void Programs::begin_first_scan() {
  if (!state_.plc.runs || !state_.plc.is_first_scan) return;
  ProgramMachine machine(*this, controls_);
  language::run(state_.plc, *ladder_, machine, options_);
}

void Programs::fast_forward(Tick done, Tick tick) {
  if (!plc_scans()) return;
  // The number of these ticks that contain a scan; see scans_in().
  const Tick each = std::max<Tick>(scan_ms(options_), 1);
  const Tick before_first = std::clamp(state_.flash_until - 1, done, tick);
  const Tick scans = tick / each - before_first / each;
  notify_watch();
  ProgramMachine machine(*this, controls_);
  language::fast_forward(state_.plc, *ladder_, machine, scans, options_);
  if (state_.plc_quiet_scans != kNever) state_.plc_quiet_scans -= tick - done;
}

bool Programs::scans_in(Tick tick) const {
  const bool is_one_of_them = scan_ms(options_) <= 1 || tick % scan_ms(options_) == 0;
  return is_one_of_them && tick >= state_.flash_until;
}

void Programs::wake_plc_by_what_changed() {
  if (plc_scans() && state_.plc_quiet_scans > 0 && !watch_.is_as_seen()) state_.plc_quiet_scans = 0;
}

}  // namespace understudy::emulator::models::super_40nc
