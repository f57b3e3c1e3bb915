#include "emulator/models/rs_m8194h/rows/views.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "emulator/device/register_map/row.h"
#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/module.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "emulator/models/rs_m8194h/state.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/commands.h"
#include "interpreter/rs_m8194h/download.h"
#include "interpreter/rs_m8194h/verbs.h"
#include "interpreter/rs_m8194h/window.h"
#include "motion/axis.h"
#include "motion/coordinated.h"
#include "motion/homing.h"
#include "motion/profile.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

constexpr std::uint32_t kModuleId = 0x44;

std::size_t axis_number(Cell cell) { return static_cast<std::size_t>(cell.axis); }
Value bit_of_word(std::uint32_t word, int number) { return word >> number & 1U; }
/// Returns false for an address of U's signals that a choice omits: 380 as printed (arguments from 16 on), or
/// 280 by the pattern of the other axes.
bool is_served(const Module& it, Cell cell) {
  if (cell.argument >= 16) return !it.chose(option("raw_signals_of_u", "at_280"));
  return cell.argument < 8 || !it.chose(option("raw_signals_of_u", "at_380"));
}
const AxisUnit& unit_of(const Module& it, Cell cell) { return it.chip.unit(axis_number(cell)); }
const motion::Axis& motor_of(const Module& it, Cell cell) { return it.chip.motor(axis_number(cell)); }
std::size_t group_of(int number) { return static_cast<std::size_t>(number); }

std::uint16_t all_of(const Module& it, Cell cell) {
  const bool is_active = it.chose(option("di_all_levels", "active_by_setting"));
  return di_all_word(unit_of(it, cell), unit_of(it, cell).emergency, it.chip.is_driving(axis_number(cell)),
                     is_active ? UpperBits::active : UpperBits::line_levels);
}

/// Returns the command that corresponds to a plain write.
lang::Command counter_command(lang::Verb verb, Cell cell, Value value) {
  lang::Command command{.code = lang::real_time_code(verb)};
  command.values[0] = mask_of(axis_number(cell));
  command.values[1] = static_cast<std::uint32_t>(value);
  return command;
}

}  // namespace

Value do_word(const Module& it, Cell cell) { return it.frnet.state().outputs[group_of(cell.index)]; }
Value di_word(const Module& it, Cell cell) { return it.frnet.inputs()[group_of(cell.index)]; }
Value do_bit(const Module& it, Cell cell) {
  return bit_of_word(it.frnet.state().outputs[group_of(cell.argument)], cell.index);
}
Value di_bit(const Module& it, Cell cell) {
  return bit_of_word(it.frnet.inputs()[group_of(cell.argument - 8)], cell.index);
}
void write_do_word(Module& it, Cell cell, Value value) {
  it.frnet.write(group_of(cell.index), static_cast<std::uint16_t>(value));
}
void write_do_bit(Module& it, Cell cell, Value value) {
  it.frnet.write_bit(group_of(cell.argument), static_cast<std::size_t>(cell.index), value != 0);
}

Value di_all(const Module& it, Cell cell) { return all_of(it, cell); }
Value di_all_bit(const Module& it, Cell cell) { return bit_of_word(all_of(it, cell), cell.argument); }
Value error_code(const Module& it, Cell cell) { return it.chip.error_code(axis_number(cell)); }
Value error_bit(const Module& it, Cell cell) {
  constexpr int kSoftEmergency = 9;
  if (cell.argument == kSoftEmergency && it.chose(option("soft_emg_bit", "has_none"))) return 0;
  return bit_of_word(it.chip.error_code(axis_number(cell)), cell.argument);
}
Value di_signal(const Module& it, Cell cell) { return di_signal_word(unit_of(it, cell)); }
Value di_signal_bit(const Module& it, Cell cell) {
  return is_served(it, cell) ? bit_of_word(di_signal_word(unit_of(it, cell)), cell.argument % 8) : 0;
}
Value logic_position(const Module& it, Cell cell) {
  return logic_count(unit_of(it, cell), motor_of(it, cell));
}
Value encoder_position(const Module& it, Cell cell) {
  return encoder_count(unit_of(it, cell), motor_of(it, cell));
}
Value absolute_position(const Module& it, Cell cell) {
  return absolute_count(unit_of(it, cell), motor_of(it, cell));
}
Value current_velocity(const Module& it, Cell cell) {
  double speed_pps = it.chip.speed_pps(axis_number(cell));
  const motion::Coordinated& together = it.chip.paths().together;
  const bool is_first = together.engaged && together.axis_of[0] == cell.axis;
  if (is_first && it.chose(option("cv_in_interpolation", "axis1_that_of_the_path"))) {
    speed_pps = together.run.sample(it.now()).speed_u_s;
  }
  const bool is_signed = it.chose(option("cv_sign", "of_the_direction"));
  return std::llround(is_signed ? speed_pps : std::abs(speed_pps));
}
Value current_acceleration(const Module& it, Cell cell) {
  const motion::Coordinated& together = it.chip.paths().together;
  const std::size_t axis = axis_number(cell);
  double size = 0;
  if (together.takes(axis)) {
    // The axis's component of the acceleration along the path.
    const motion::Sample along = together.run.sample(it.now());
    const double share =
        along.speed_u_s > 0 ? std::abs(together.speed_pps(axis, it.now())) / along.speed_u_s : 0;
    size = std::abs(along.acceleration_u_s2) * share;
  } else if (it.chip.is_driving(axis)) {
    size = std::abs(motor_of(it, cell).sample(it.now()).acceleration_u_s2);
  }
  return static_cast<Value>(size < INT32_MAX ? size + 0.5 : INT32_MAX);
}
Value stop_status(const Module& it, Cell cell) { return it.chip.is_driving(axis_number(cell)) ? 0 : 1; }
Value latch(const Module& it, Cell cell) { return unit_of(it, cell).latched; }
Value home_state(const Module& it, Cell cell) {
  const motion::Homing& homing = motor_of(it, cell).homing;
  return homing.active() ? homing.row().code : 0;
}
Value servo_is_on(const Module& it, Cell cell) { return unit_of(it, cell).basic.servo ? 1 : 0; }

void queue_logic_position(Module& it, Cell cell, Value value) {
  it.queue.queue(counter_command(lang::Verb::set_lp, cell, value));
}
void queue_encoder_position(Module& it, Cell cell, Value value) {
  it.queue.queue(counter_command(lang::Verb::set_ep, cell, value));
}
void queue_absolute_position(Module& it, Cell cell, Value value) {
  it.queue.queue(counter_command(lang::Verb::abs_set_position, cell, value));
}

Value running_mp(const Module& it, Cell) { return it.programs.running_mp(); }
Value emergency_state(const Module& it, Cell) { return it.drives.state().emergency_state ? 1 : 0; }
Value error_state(const Module& it, Cell) {
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (it.chip.error_code(a) != 0) return 1;
  }
  return 0;
}
Value free_blocks(const Module& it, Cell) { return it.queue.free_blocks(); }
Value rint_word(const Module& it, Cell cell) {
  return it.interrupts.state().rint | (error_state(it, cell) != 0 ? bit_of(Rint::axes) : 0);
}
Value rint_bit(const Module& it, Cell cell) {
  return bit_of_word(static_cast<std::uint32_t>(rint_word(it, cell)), cell.argument);
}
Value module_id(const Module& it, Cell) { return it.is_absent() ? 0 : kModuleId; }
Value rsm_firmware(const Module& it, Cell) { return it.firmware() >= 300 ? 0x03000000 : 0x02000000; }
Value module_firmware(const Module& it, Cell) {
  if (it.is_absent()) return 0;
  return it.firmware() >= 300 ? 0x02210300 : 0x02210201;
}
Value interpolation_ready(const Module& it, Cell) {
  if (it.is_absent()) return 0;
  const Paths& paths = it.chip.paths();
  if (!paths.together.engaged) return 1;
  // A stream accepts one segment ahead of the running one.
  return paths.runs == Paths::Runs::stream && paths.open && it.streams.has_room() ? 1 : 0;
}
Value driving_axes(const Module& it, Cell) { return it.chip.driving(); }
Value rsm_state(const Module& it, Cell) { return static_cast<Value>(it.programs.state().rsm); }
Value module_state(const Module& it, Cell) {
  // The numbering in 4.16.2. A choice decides whether states that pass within a tick are shown.
  constexpr Value kDownloading = 3;
  constexpr Value kRunsMp = 5;
  constexpr Value kRunsIsr = 7;
  constexpr Value kBooting = 0xFF;
  const Value first = it.chose(option("module_state_numbers", "of_12_1_12")) ? 3 : 0;
  if (it.programs.is_downloading()) return first + kDownloading;
  if (it.status.is_resetting()) return kBooting;
  const State& state = it.state();
  const bool is_helix = state.paths.together.engaged && state.paths.runs == Paths::Runs::helix;
  if (it.programs.isr_runs()) return first + kRunsIsr;
  if (it.programs.mp_runs() || (is_helix && it.machine_options().helix_is_macro)) return first + kRunsMp;
  const bool has_passed =
      it.chose(option("passing_states", "show_for_a_tick")) && it.now() > state.finished_at + 1;
  return first + (has_passed ? 0 : state.finished);
}
Value illegal_reason(const Module& it, Cell) { return it.state().illegal_reason; }
Value download_field(const Module& it, Cell cell) {
  const lang::DownloadStatus& shown = it.programs.state().downloaded;
  const std::uint16_t fields[] = {shown.mp, shown.isr, shown.command, shown.line, shown.error};
  return fields[cell.argument];
}
Value execution_field(const Module& it, Cell cell) {
  if (it.chose(option("execution_fault_words", "of_the_last_download"))) return download_field(it, cell);
  return it.programs.state().execution_fault[static_cast<std::size_t>(cell.argument)];
}
Value factor_axes(const Module& it, Cell cell) {
  return it.interrupts.state().factor_axes[static_cast<std::size_t>(cell.argument)];
}

}  // namespace understudy::emulator::models::rs_m8194h
