// Readers and effects of SUPER-40NC's contacts and registers, for its register tables.
#pragma once

#include "emulator/device/register_map/row.h"

namespace understudy::emulator::models::super_40nc {

class Super40nc;

/// The chip's flags of an axis, with their names in the manual (《M8x 特殊接點的功用(XYZU 軸用)》), and the
/// controller's own flags.
enum AxisStatus : int {
  SSCM,  // a motion is running
  SRUN,  // pulses are being sent
  SENI,  // a motion has ended
  SEND,  // no motion is running
  SERR,  // stopped because of an error
  SCP1,  // comparators
  SCP2,
  SCP3,
  SCP4,
  SCP5,
  SFU,  // accelerating
  SFD,  // decelerating
  SFC,  // constant speed
  SALM,
  SPEL,
  SMEL,
  SORG,
  SDIR,
  SEMG,
  SERC,
  SEZ,
  SCLR,
  SLTC,
  SINP,
  SRDY,
  HOME_DONE,
  ZERO_DONE,
  HOME_RUNS,
  ZERO_RUNS,
  WHEEL_RUNS,
};

// Readers. If the row has axes, the cell's index is the axis.
Value read_status(const Super40nc& device, Cell cell);
Value read_analog(const Super40nc& device, Cell cell);          // index: VR1 to VR3
Value read_error(const Super40nc& device, Cell cell);           // argument: code, step or other step
Value read_receive_errors(const Super40nc& device, Cell cell);  // argument: the port
Value read_work_position(const Super40nc& device, Cell cell);
Value read_counter(const Super40nc& device, Cell cell);  // argument: 0 to 3
Value read_operation(const Super40nc& device, Cell cell);
Value read_latch(const Super40nc& device, Cell cell);  // argument: 0 to 3
Value read_remainder(const Super40nc& device, Cell cell);
Value read_chip_speed(const Super40nc& device, Cell cell);
Value read_index_count(const Super40nc& device, Cell cell);
Value read_braking_distance(const Super40nc& device, Cell cell);

Value read_pointer(const Super40nc& device, Cell cell);  // argument: 0 for C, 1 for an axis
Value read_table_line(const Super40nc& device, Cell);
Value read_pausing(const Super40nc& device, Cell);
Value read_file_changed(const Super40nc& device, Cell);

// Effects.
void write_command(Super40nc& device, Cell cell,
                   Value level);  // argument: the M of axis X, or the first of several contacts
void write_pointer(Super40nc& device, Cell cell, Value step);  // argument: 0 for C, 1 for an axis
void write_nothing(Super40nc& device, Cell, Value);
void select_file(Super40nc& device, Cell, Value number);
void select_file_by_alias(Super40nc& device, Cell, Value number);
void select_recipe(Super40nc& device, Cell, Value number);
void lay_out_files(Super40nc& device, Cell, Value lines);
void limit_voltage(Super40nc& device, Cell cell, Value thousandths);  // argument: Vout1 or Vout2
void change_override(Super40nc& device, Cell, Value percent);
void select_wheel(Super40nc& device, Cell, Value);
void select_wheel_or_command(Super40nc& device, Cell, Value number);
void select_jog_speed(Super40nc& device, Cell, Value);
void change_axis(Super40nc& device, Cell cell, Value);  // argument: the number added to D9x00; 0: a D8x
void set_work_position(Super40nc& device, Cell cell, Value position);
void set_counter(Super40nc& device, Cell cell, Value pulses);

}  // namespace understudy::emulator::models::super_40nc
