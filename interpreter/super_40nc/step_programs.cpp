#include "interpreter/super_40nc/step_programs.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/events.h"
#include "interpreter/super_40nc/instruction_row.h"
#include "interpreter/super_40nc/machine.h"
#include "interpreter/super_40nc/operand.h"
#include "interpreter/super_40nc/options.h"
#include "interpreter/super_40nc/requests.h"

namespace understudy::interpreter::super_40nc {

void StepPrograms::report(Area area, Code code) {
  machine_.report(code, area, base_of(area, options_) + state(area).step);
}

/// Reports an error that stops the program.
void StepPrograms::fail(Area area, Code code) {
  report(area, code);
  forget(area);
}

// --- events -----------------------------------------------------------------------------------------

void StepPrograms::take(Event event, Area area) {
  const Reaction reaction = reaction_of(event, state(area).phase);
  // A start cancels a pause that was to begin at the end of the motion.
  const bool runs_on = event == Event::start && reaction == Reaction::nothing;
  if (runs_on && !machine_.is_held_in_reset(area)) set_contact(area, true);
  switch (reaction) {
    case Reaction::nothing:
    case Reaction::pause_later:
    case Reaction::motions_wait:
    case Reaction::rest_waits: break;  // checked when the motion is to continue
    case Reaction::fresh_start:
    case Reaction::next_or_wait:
    case Reaction::resume: begin(area, reaction); break;
    case Reaction::pause: pause(area, false); break;
    case Reaction::hold:
      machine_.hold(area);
      state(area).machine_holds = true;
      pause(area, true);
      break;
    case Reaction::freeze: freeze(area); break;
    case Reaction::next_line: state(area).phase = Phase::executing; break;
    case Reaction::forget:
      if (state(area).machine_holds) machine_.drop_held(area);
      forget(area);
      break;
    case Reaction::restart:
      clear(area);
      begin(area, Reaction::fresh_start);
      break;
    case Reaction::stop_motors: stop_motors(area); break;
    case Reaction::stop:
      stop_motors(area);
      forget(area);
      break;
    case Reaction::broken: forget(area); break;
    case Reaction::same_step: change_file(area); break;
  }
}

/// STR.
void StepPrograms::start(Area area) {
  const bool runs_on = reaction_of(Event::start, state(area).phase) == Reaction::nothing;
  if (runs_on && options_.chose(option("str_running", "begins_anew")) && !machine_.is_held_in_reset(area))
    take(Event::stop, area);
  take(Event::start, area);
}

/// Starts or continues the program.
void StepPrograms::begin(Area area, Reaction how) {
  StepState& program = state(area);
  if (machine_.is_held_in_reset(area)) return set_contact(area, false);
  const bool has_motion = program.resumes == Phase::moving || program.resumes == Phase::homing;
  // A motion that was paused is completed, even if its program's file has since become empty.
  const bool completes = has_motion || program.machine_holds;
  if (code(area).is_empty() && !completes) {
    if (options_.chose(option("empty_program", "is_an_error"))) report(area, Code::no_end);
    return set_contact(area, false);
  }
  machine_.program_starts(area);
  set_contact(area, true);
  program.is_paused_by_key = false;
  const bool is_new = program.step == 0 && how != Reaction::resume && program.resumes == Phase::executing;
  const bool loads = is_new || !program.has_modes || options_.chose(option("fresh_start", "every_start"));
  if (loads) load_modes(area);
  if (is_inhibited() && (has_motion || program.machine_holds)) {
    program.phase = Phase::waiting;
    program.waits_to_resume = true;
    return;
  }
  resume(area);
}

void StepPrograms::resume(Area area) {
  StepState& program = state(area);
  program.waits_to_resume = false;
  program.phase = std::exchange(program.resumes, Phase::executing);
  // A motion that cannot continue because of a limit resets the program.
  if (std::exchange(program.machine_holds, false)) machine_.resume_motions(area);
}

void StepPrograms::load_modes(Area area) {
  StepState& program = state(area);
  const int axis = axis_of(area);
  const int where = axis < 0 ? named::kTargetsOfC : named::kTargetsOfX + 100 * axis;
  program.targets = machine_.parameter_in_force(where) == 0 ? Targets::absolute : Targets::relative;
  program.waits_for_drive = true;
  program.has_modes = true;
  for (int i = 0; i < kAxisCount; ++i) {
    program.rpm[static_cast<std::size_t>(i)] = machine_.rpm_at_power_up(i);
  }
  if (area != Area::c) return;
  machine_.set_special_register(named::kFeed, machine_.parameter_in_force(named::kDefaultFeed));
  machine_.set_special_register(named::kPlane, machine_.parameter_in_force(named::kDefaultPlane));
}

/// Resets the state as at power-up, but keeps the modes and speeds.
void StepPrograms::clear(Area area) {
  StepState& program = state(area);
  StepState cleared;
  cleared.has_modes = program.has_modes;
  cleared.targets = program.targets;
  cleared.rpm = program.rpm;
  cleared.waits_for_drive = program.waits_for_drive;
  program = cleared;
  machine_.waits_no_more(area);
}

void StepPrograms::forget(Area area) {
  const bool was_idle = state(area).phase == Phase::idle;
  clear(area);
  if (!was_idle) set_contact(area, false);
}

void StepPrograms::stop_motors(Area area) {
  const Areas lost = machine_.stop(area);
  for (const AreaRow& row : kAreas) {
    if (row.area != Area::plc && row.area != area && has(lost, row.area)) take(Event::broken, row.area);
  }
}

void StepPrograms::pause(Area area, bool by_key) {
  StepState& program = state(area);
  const bool was_waiting = program.phase == Phase::waiting && !program.waits_to_resume;
  if (program.phase != Phase::paused && !program.waits_to_resume) {
    program.resumes = was_waiting ? Phase::waiting : Phase::executing;
  }
  program.waits_to_resume = false;
  program.phase = Phase::paused;
  program.is_paused_by_key |= by_key;
  set_contact(area, false);
}

void StepPrograms::freeze(Area area) {
  StepState& program = state(area);
  if (!program.waits_to_resume) program.resumes = program.phase;
  program.waits_to_resume = false;
  program.phase = Phase::held;
  program.is_paused_by_key = true;
  program.machine_holds = true;
  machine_.hold(area);
  set_contact(area, false);
}

/// C continues at the same step. A wait for the same condition continues.
void StepPrograms::change_file(Area area) {
  StepState& program = state(area);
  if (program.phase != Phase::waiting || program.waits_to_resume) return;
  program.phase = Phase::executing;
  const int line = code(area).line_at(program.step);
  if (line < 0 || code(area).line(line).op != Op::tmr) program.left_ms = 0;
}

/// Moves the pointer of a running program, either after its motion or at once.
void StepPrograms::move_pointer(StepState& program, int step) {
  program.owns_pointer = false;
  if (program.phase == Phase::moving || program.phase == Phase::homing) {
    program.next_step = step;
    return;
  }
  program.phase = Phase::executing;
  program.waits_to_resume = false;
  program.left_ms = 0;
  program.step = step;
}

void StepPrograms::set_step(Area area, int step) {
  StepState& program = state(area);
  const bool is_at_rest =
      program.phase == Phase::idle || program.phase == Phase::paused || program.phase == Phase::held;
  if (!is_at_rest) {
    if (options_.chose(option("pointer_write_running", "goes_on_there"))) move_pointer(program, step);
    return;
  }
  if (program.machine_holds) machine_.drop_held(area);
  program.machine_holds = false;
  if (program.phase == Phase::held) program.phase = Phase::paused;
  program.resumes = Phase::executing;
  program.left_ms = 0;
  program.step = step;
}

bool StepPrograms::shows_pausing() const {
  const StepState& program = state(Area::c);
  return program.is_paused_by_key && (program.phase == Phase::paused || program.phase == Phase::held);
}

// --- a tick -----------------------------------------------------------------------------------------

void StepPrograms::run_slices() {
  for (int i = 0; i < kStepProgramCount; ++i) run_slice(static_cast<Area>(i));
}

void StepPrograms::end_of_motion(Area area) {
  StepState& program = state(area);
  program.step = program.next_step;
  take(is_single_step(area) ? Event::single_step : Event::motion_ended, area);
}

void StepPrograms::run_slice(Area area) {
  StepState& program = state(area);
  const bool rests =
      program.phase == Phase::idle || program.phase == Phase::paused || program.phase == Phase::held;
  if (rests && contact_is_on(area)) take(Event::start, area);
  const bool is_off = !rests && area != Area::c && !contact_is_on(area);
  if (is_off && options_.chose(option("axis_contact_off", "stops_the_program")))
    return take(Event::stop, area);
  if (program.phase == Phase::moving || program.phase == Phase::homing) {
    if (machine_.is_running(area)) return;
    end_of_motion(area);
  }
  if (program.phase == Phase::waiting && program.waits_to_resume && contact_is_on(area)) {
    if (!is_inhibited()) resume(area);
    return;
  }
  for (int executed = 0; executed < slice(options_) || is_in_group(area); ++executed) {
    if (program.phase != Phase::executing && program.phase != Phase::waiting) return;
    if (is_stopped_short(area)) return;  // the contacts take effect before the next slice
    if (!contact_is_on(area)) return take(Event::contact_off, area);
    if (!finds_line(area)) return;
    if (execute(area, code(area).line(code(area).line_at(program.step))) == Slice::is_over) return;
  }
}

/// Returns true if an instruction begins at the program's step; otherwise, the program ends.
bool StepPrograms::finds_line(Area area) {
  StepState& program = state(area);
  if (code(area).line_at(program.step) >= 0) return true;
  if (options_.chose(option("missing_end", "as_if_it_had_one")) && program.step == code(area).length()) {
    end(area);
    return false;
  }
  const int next = options_.chose(option("pointer_inside", "goes_on_with_the_next_line"))
                       ? code(area).next_step(program.step)
                       : -1;
  if (next >= 0) {
    program.step = next;
    return true;
  }
  fail(area, Code::unknown);
  return false;
}

Operand StepPrograms::awaited(Area area) const {
  const StepState& program = state(area);
  const int line = code(area).line_at(program.step);
  if (program.phase != Phase::waiting || program.waits_to_resume || line < 0) return {};
  const Instruction& instruction = code(area).line(line);
  return instruction.op == Op::wat || instruction.op == Op::wtn ? instruction.fields[0] : Operand{};
}

std::int64_t StepPrograms::quiet_ms(Area area) const {
  constexpr std::int64_t kForEver = INT64_MAX;
  const StepState& program = state(area);
  switch (program.phase) {
    case Phase::idle:
    case Phase::paused:
    case Phase::held: return contact_is_on(area) ? 0 : kForEver;
    case Phase::executing: return 0;
    case Phase::moving:
    case Phase::homing: return machine_.is_running(area) ? kForEver : 0;
    case Phase::waiting: break;
  }
  if (!contact_is_on(area)) return 0;
  if (program.left_ms > 0 && follows_register(area)) return 0;
  if (program.left_ms > 0)
    return options_.chose(option("tmr_under_m8004", "stands")) && is_inhibited() ? kForEver
                                                                                 : program.left_ms - 1;
  if (program.waits_to_resume) return is_inhibited() ? kForEver : 0;
  const Operand contact = awaited(area);
  if (!contact.is_set())
    return is_inhibited() ? kForEver : 0;  // a taken axis is requested again in each tick
  const bool waits_for_on = code(area).line(code(area).line_at(program.step)).op == Op::wat;
  return access_.contact(contact) == waits_for_on ? 0 : kForEver;
}

void StepPrograms::fast_forward(Area area, std::int64_t ticks) {
  StepState& program = state(area);
  if (options_.chose(option("tmr_under_m8004", "stands")) && is_inhibited()) return;
  if (program.phase == Phase::waiting && program.left_ms > 0) program.left_ms -= ticks;
}

}  // namespace understudy::interpreter::super_40nc
