// The lines of a step program that are not motion. (Manual, Sequence 指令一覽表.)
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/program_watch.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/events.h"
#include "interpreter/super_40nc/fields.h"
#include "interpreter/super_40nc/instruction_row.h"
#include "interpreter/super_40nc/instructions.h"
#include "interpreter/super_40nc/machine.h"
#include "interpreter/super_40nc/numbers.h"
#include "interpreter/super_40nc/operand.h"
#include "interpreter/super_40nc/options.h"
#include "interpreter/super_40nc/program.h"
#include "interpreter/super_40nc/requests.h"
#include "interpreter/super_40nc/step_programs.h"
#include "interpreter/super_40nc/structure.h"

namespace understudy::interpreter::super_40nc {

/// Notifies the observer that the line begins, unless the line was already waiting.
void StepPrograms::begin_line(Area area) {
  const StepState& program = state(area);
  const bool waits = program.phase == Phase::waiting || program.left_ms > 0;
  watched_line_ = waits ? -1 : code(area).line_at(program.step);
  if (!waits) machine_.watch()->runs(static_cast<int>(area), watched_line_, 1);
}

bool StepPrograms::decide(Area area, bool outcome) {
  ProgramWatch* const watch = machine_.watch();
  if (watch != nullptr && watched_line_ >= 0) {
    watch->decides(static_cast<int>(area), watched_line_, outcome, 1);
  }
  return outcome;
}

StepPrograms::Slice StepPrograms::execute(Area area, const Instruction line) {
  if (machine_.watch() != nullptr) begin_line(area);
  state(area).owns_pointer = true;
  const Slice slice = carry_out(area, line);
  state(area).owns_pointer = false;
  return slice;
}

StepPrograms::Slice StepPrograms::carry_out(Area area, const Instruction& line) {
  const std::size_t needed = place_of_needed(line.op);
  if (needed < line.fields.size() && !line.fields[needed].is_set()) return advance(area, line);
  if (is_contact(line.op) || joins_blocks(line.op)) return read_contact(area, line);
  if (is_calculation(line.op)) {
    const int step = base_of(area, options_) + state(area).step;
    const Calculated result = calculate(line, access_, options_);
    if (result.code != Code::none) machine_.report(result.code, area, step);
    return advance(area, line);
  }
  if (row_of(line.op).group == Group::motion) return set_mode(area, line);
  const bool holds = (state(area).blocks & 1) != 0;
  if (line.op == Op::set) {
    access_.switch_contact(line.fields[0], true);
  } else if (line.op == Op::rst) {
    access_.reset(line.fields[0]);
  } else if (line.op == Op::end) {
    return end(area);
  } else if (line.op == Op::jmp || (line.op == Op::cj && decide(area, holds)) ||
             (line.op == Op::cjn && decide(area, !holds))) {
    return jump_to_label(area);
  } else if ((line.op == Op::if_ && !decide(area, holds)) || line.op == Op::else_) {
    state(area).step = code(area).target_of(code(area).line_at(state(area).step));
    return Slice::continues;
  } else if (line.op == Op::cal) {
    return call(area, line);
  } else if (line.op == Op::ret) {
    return return_(area, line);
  } else if (line.op == Op::wat || line.op == Op::wtn) {
    return wait(area, line, decide(area, access_.contact(line.fields[0]) == (line.op == Op::wat)));
  } else if (line.op == Op::tmr) {
    return wait_for_time(area, line);
  }
  return advance(area, line);  // LAB, ENDI, NOP, and CJ, CJN and IF that do not jump
}

/// Advances to the next line, unless the line has stopped its program or moved the pointer.
StepPrograms::Slice StepPrograms::advance(Area area, const Instruction& line) {
  StepState& program = state(area);
  if (!program.owns_pointer) return Slice::continues;
  program.phase = Phase::executing;
  program.step += steps_of(line);
  return Slice::continues;
}

StepPrograms::Slice StepPrograms::jump(Area area, int step) {
  state(area).step = step;
  return !options_.chose(option("slice_end", "waits_and_the_64_lines_alone")) ? Slice::is_over
                                                                              : Slice::continues;
}

StepPrograms::Slice StepPrograms::jump_to_label(Area area) {
  const int target = code(area).target_of(code(area).line_at(state(area).step));
  if (target >= 0) return jump(area, target);
  fail(area, Code::label_missing);
  return Slice::is_over;
}

StepPrograms::Slice StepPrograms::call(Area area, const Instruction& line) {
  StepState& program = state(area);
  std::int64_t passes = line.fields[1].is_set() ? access_.value(line.fields[1]) : 1;
  if (passes <= 0) {
    if (options_.chose(option("cal_count", "skipped"))) return advance(area, line);
    passes = INT64_MAX;
  }
  const int label = code(area).target_of(code(area).line_at(program.step));
  if (label < 0 || program.calls.size() >= static_cast<std::size_t>(call_depth(options_))) {
    fail(area, label < 0 ? Code::label_missing : Code::pairing);
    return Slice::is_over;
  }
  const bool is_compared =
      line.fields[1].letter == Letter::d && options_.chose(option("cal_of_d", "compared_at_each_ret"));
  if (is_compared) passes = -1;
  program.calls.push_back({program.step + steps_of(line), label, passes});
  return jump(area, label);
}

/// Returns the present count of the CAL before a step, or 0 if another program has no CAL there.
std::int64_t StepPrograms::passes_wanted(Area area, int back) {
  const int number = code(area).line_at(back) > 0  ? code(area).line_at(back) - 1
                     : back == code(area).length() ? code(area).line_count() - 1
                                                   : -1;
  if (number < 0 || code(area).line(number).op != Op::cal) return 0;
  return access_.value(code(area).line(number).fields[1]);
}

StepPrograms::Slice StepPrograms::return_(Area area, const Instruction& line) {
  StepState& program = state(area);
  if (program.calls.empty()) {
    if (options_.chose(option("ret_without_cal", "ignored"))) return advance(area, line);
    fail(area, Code::pairing);
    return Slice::is_over;
  }
  Call& last = program.calls.back();
  const bool goes_again = last.passes < 0 ? -last.passes < passes_wanted(area, last.back) : last.passes > 1;
  if (goes_again) {
    --last.passes;
    return jump(area, last.label);
  }
  const int back = last.back;
  program.calls.pop_back();
  return jump(area, back);
}

StepPrograms::Slice StepPrograms::end(Area area) {
  machine_.program_ended(area);
  const bool by_key =
      !options_.chose(option("continuous", "m8007_alone")) && machine_.special_contact(named::kContinuousKey);
  const bool is_continuous = area == Area::c && (machine_.special_contact(named::kContinuous) || by_key);
  take(is_continuous ? Event::end_continuous : Event::end, area);
  return Slice::is_over;
}

StepPrograms::Slice StepPrograms::wait(Area area, const Instruction& line, bool is_over) {
  if (is_over) return advance(area, line);
  state(area).phase = Phase::waiting;
  return Slice::is_over;
}

/// Returns true if the waiting time is in a register, which is read in each tick.
bool StepPrograms::follows_register(Area area) const {
  const int line = code(area).line_at(state(area).step);
  return options_.chose(option("tmr_of_d", "compared_in_each_scan")) && line >= 0 &&
         code(area).line(line).fields[0].letter == Letter::d;
}

/// Reads the time once, and waits for that many ticks after the tick in which the line was reached.
StepPrograms::Slice StepPrograms::wait_for_time(Area area, const Instruction& line) {
  StepState& program = state(area);
  if (program.left_ms > 0) {
    if (options_.chose(option("tmr_under_m8004", "stands")) && is_inhibited()) return wait(area, line, false);
    if (follows_register(area)) {
      const std::int32_t ms = access_.value(line.fields[0]);
      program.left_ms += std::int64_t{ms} - std::exchange(program.wait_ms, ms);
    }
    program.left_ms = std::max<std::int64_t>(program.left_ms - scan_ms(options_), 0);
    return wait(area, line, program.left_ms == 0);
  }
  const std::int32_t ms = access_.value(line.fields[0]);
  if (ms > 0) program.left_ms = ms;
  program.wait_ms = follows_register(area) ? ms : 0;
  return wait(area, line, ms <= 0);
}

StepPrograms::Slice StepPrograms::read_contact(Area area, const Instruction& line) {
  std::uint64_t& blocks = state(area).blocks;
  if (joins_blocks(line.op)) {
    const bool is_series = line.op == Op::anb;
    blocks = is_series ? (blocks >> 1) & (~std::uint64_t{1} | blocks) : (blocks >> 1) | (blocks & 1);
    return advance(area, line);
  }
  const Relations relations = relations_of(line.op);
  const bool is_on =
      relations != 0
          ? (relation_of(access_.value(line.fields[0]), access_.value(line.fields[1])) & relations) != 0
          : access_.contact(line.fields[0]) != is_inverted(line.op);
  const std::uint64_t bit = decide(area, is_on) ? 1 : 0;
  switch (place_of(line.op)) {
    case Place::begins:
      blocks = ((blocks << 1) | bit) & ((std::uint64_t{1} << stack_depth(options_)) - 1);
      break;
    case Place::in_series: blocks &= ~std::uint64_t{1} | bit; break;
    case Place::in_parallel: blocks |= bit; break;
  }
  return advance(area, line);
}

/// Returns true if the next line belongs to the contacts before it, which are all read together.
bool StepPrograms::is_in_group(Area area) const {
  const int line = code(area).line_at(state(area).step);
  if (state(area).phase != Phase::executing || line < 0) return false;
  const Op op = code(area).line(line).op;
  return (is_contact(op) && !begins_block(op)) || joins_blocks(op) || reads_group(op);
}

/// STP, STR: the fields are X, Y, Z, U in every program. If no field is set, the instruction applies to C.
StepPrograms::Slice StepPrograms::control(Area area, const Instruction& line) {
  const AxisValues values = axis_values(line, access_);
  const AxisSet axes = chosen_axes(values);
  advance(area, line);
  const auto act = [&](Area other) { line.op == Op::str ? start(other) : stop(other); };
  if (is_empty(values)) act(Area::c);
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (has_axis(axes, axis)) act(area_of_axis(axis));
  }
  return Slice::continues;
}

}  // namespace understudy::interpreter::super_40nc
