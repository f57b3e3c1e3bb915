#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/rows/effects.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/terminals.h"

namespace understudy::emulator::models::super_40nc {

Value read_status(const Super40nc& device, Cell cell) {
  return device.parts().axes.flags.status(cell.index, static_cast<AxisStatus>(cell.argument)) ? 1 : 0;
}

Value read_analog(const Super40nc& device, Cell cell) {
  return device.state().analog[static_cast<std::size_t>(cell.index)];
}

Value read_error(const Super40nc& device, Cell cell) {
  const ErrorReport& error = device.state().error;
  switch (cell.argument) {
    case 0: return device.chose(option("error_codes", "always_0")) ? 0 : static_cast<Value>(error.code);
    case 1: return error.step;
    default: return error.other_step;
  }
}

Value read_receive_errors(const Super40nc& device, Cell cell) {
  return static_cast<std::int32_t>(device.state().receive_errors[static_cast<std::size_t>(cell.argument)]);
}

Value read_work_position(const Super40nc& device, Cell cell) {
  return static_cast<std::int32_t>(device.parts().axes.chips.work_lu(cell.index));
}

Value read_counter(const Super40nc& device, Cell cell) {
  return device.parts().axes.chips.counter(cell.index, cell.argument);
}
Value read_operation(const Super40nc& device, Cell cell) {
  return device.parts().axes.chips.operation_of(cell.index);
}

Value read_latch(const Super40nc& device, Cell cell) {
  if (device.chose(option("latch_registers", "0"))) return 0;
  return device.parts().axes.chips.axis(cell.index).latched[static_cast<std::size_t>(cell.argument)];
}

Value read_remainder(const Super40nc& device, Cell cell) {
  return static_cast<std::int32_t>(device.parts().axes.chips.remaining_pulses(cell.index));
}

Value read_chip_speed(const Super40nc& device, Cell cell) {
  return device.parts().axes.chips.chip_speed(cell.index);
}

Value read_index_count(const Super40nc& device, Cell cell) {
  return device.parts().axes.chips.axis(cell.index).index_count;
}

Value read_braking_distance(const Super40nc& device, Cell cell) {
  return static_cast<std::int32_t>(device.parts().axes.chips.braking_pulses(cell.index));
}

Value read_pointer(const Super40nc& device, Cell cell) {
  return device.parts().programs.shown_step(
      static_cast<std::size_t>(cell.argument == 0 ? 0 : 1 + cell.index));
}
Value read_table_line(const Super40nc& device, Cell) { return device.parts().programs.table_line(); }
Value read_pausing(const Super40nc& device, Cell) { return device.parts().programs.is_pausing() ? 1 : 0; }
Value read_file_changed(const Super40nc& device, Cell) { return device.state().shows_file_changed ? 1 : 0; }

void write_command(Super40nc& device, Cell cell, Value level) {
  const bool is_of_axes = cell.argument >= m8x::kStart && cell.argument < m85::kParameterPageLeft;
  const int contact = is_of_axes ? of_axis(cell.argument, cell.index) : cell.argument + cell.index;
  if (device.chose(option("command_latch", "lost"))) return;  // only its level in the scan counts
  device.parts().ground.state().contacts.write(contact, level != 0);
}

void write_pointer(Super40nc& device, Cell cell, Value step) {
  const int program = cell.argument == 0 ? 0 : 1 + cell.index;
  const int base = device.parts().programs.shown_base(static_cast<std::size_t>(program));
  device.parts().programs.set_pointer(program, static_cast<std::int32_t>(step) - base);
}
void write_nothing(Super40nc&, Cell, Value) {}

void select_file(Super40nc& device, Cell, Value number) {
  device.parts().programs.change_file(static_cast<std::int32_t>(number));
}

void select_file_by_alias(Super40nc& device, Cell, Value number) {
  if (device.chose(option("d8002_alias", "plain_register"))) return;
  device.parts().ground.put(stored_d(d9::kFileNumber), static_cast<std::int32_t>(number));
  device.parts().programs.change_file(static_cast<std::int32_t>(number));
}

void select_recipe(Super40nc& device, Cell, Value number) {
  device.parts().programs.stored().change_recipe(static_cast<std::int32_t>(number));
}

void lay_out_files(Super40nc& device, Cell, Value) { device.parts().programs.stored().show_capacities(); }

void limit_voltage(Super40nc& device, Cell cell, Value thousandths) {
  const auto limited = static_cast<std::int32_t>(std::clamp<Value>(thousandths, 0, kVoltageSteps));
  device.parts().ground.put(cell.argument == 0 ? stored_d(d8::kVout1) : stored_d(d8::kVout2), limited);
}

void change_override(Super40nc& device, Cell, Value) { device.parts().paths.apply_override(); }

void select_wheel(Super40nc& device, Cell, Value) { device.parts().keys.select_wheel(); }

void select_wheel_or_command(Super40nc& device, Cell, Value number) {
  device.parts().keys.select_wheel();
  device.parts().programs.take_user_command(static_cast<std::int32_t>(number));
}

void select_jog_speed(Super40nc& device, Cell, Value) { device.parts().axes.jogs.change_jog_speed(); }

void change_axis(Super40nc& device, Cell cell, Value) {
  device.parts().axes.parameters.apply_axis_parameters(cell.index, cell.argument);
}

void set_work_position(Super40nc& device, Cell cell, Value position) {
  device.parts().axes.parameters.set_work_lu(cell.index, position);
}

void set_counter(Super40nc& device, Cell cell, Value pulses) {
  if (cell.argument == 0 && device.chose(option("d8x40_write", "ignored"))) return;
  device.parts().axes.parameters.set_counter(cell.index, cell.argument, static_cast<std::int32_t>(pulses));
}

}  // namespace understudy::emulator::models::super_40nc
