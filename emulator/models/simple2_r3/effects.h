// The side effects of Simple2-R3's registers, for its register table. A cell's argument is an axis, or
// what is said there.
#pragma once

#include "emulator/device/register_map/row.h"

namespace understudy::emulator::models::simple2_r3 {

inline constexpr int kAxisA = 0;
inline constexpr int kAxisB = 1;
inline constexpr int kAllAxes = 2;

// Readers.
Value read_status(const Device& device, Cell);
Value read_version(const Device& device, Cell);
Value read_output(const Device& device, Cell cell);  // index: DOUT number
Value read_all_outputs(const Device& device, Cell);
Value read_input(const Device& device, Cell cell);  // index: DIN number
Value read_all_inputs(const Device& device, Cell);
Value read_encoder(const Device& device, Cell cell);
Value read_coordinate(const Device& device, Cell cell);
Value read_incremental_trigger(const Device& device, Cell cell);  // 1 while that move is in progress
Value read_absolute_trigger(const Device& device, Cell cell);
Value read_servo(const Device& device, Cell cell);
Value read_alarm_clear(const Device& device, Cell cell);
Value read_homing_trigger(const Device& device, Cell cell);
Value read_mode(const Device& device, Cell cell);
Value read_encoder_speed(const Device& device, Cell cell);
Value read_now_line(const Device& device, Cell);
Value read_program_runs(const Device& device, Cell);
Value read_timer(const Device& device, Cell cell);   // argument: 0 or 1
Value read_adc(const Device& device, Cell cell);     // argument: 0 or 1
Value read_analog(const Device& device, Cell cell);  // likewise; 200 a volt
Value read_eeprom_busy(const Device& device, Cell);
Value read_cell(const Device& device, Cell cell);  // as write_cell
Value read_unlocked(const Device& device, Cell);
Value read_password(const Device& device, Cell);
Value read_zero(const Device& device, Cell);  // triggers that are over at once

// Effects.
void write_output(Device& device, Cell cell, Value level);
void write_all_outputs(Device& device, Cell, Value levels);
void preset_encoder(Device& device, Cell cell, Value counts);
void preset_coordinate(Device& device, Cell cell, Value pulses);
void change_sync(Device& device, Cell cell, Value value);
void change_speed(Device& device, Cell cell, Value);  // Speed, AccTime, DecTime or Resoultion of an axis
void start_incremental(Device& device, Cell cell, Value);
void start_absolute(Device& device, Cell cell, Value);
void start_incremental_by_set(Device& device, Cell cell, Value set);
void start_absolute_by_set(Device& device, Cell cell, Value set);
void stop_motion(Device& device, Cell cell, Value);
void switch_servo(Device& device, Cell cell, Value on);
void clear_alarm(Device& device, Cell cell, Value);
void go_home(Device& device, Cell cell, Value);
void run_velocity(Device& device, Cell cell, Value milli_rpm);
void run_velocity_by_set(Device& device, Cell cell, Value set);
void output_pwm(Device& device, Cell cell, Value percent);
void follow_encoder(Device& device, Cell cell, Value);
void preset_timer(Device& device, Cell cell, Value value);
void start_program(Device& device, Cell, Value line);
void stop_program(Device& device, Cell, Value);
void write_cell(Device& device, Cell cell, Value value);  // argument: 0 CMD to 3 JMP; index: the line
void enter_password(Device& device, Cell, Value);
void change_password(Device& device, Cell, Value password);
void erase_program(Device& device, Cell, Value);
void reset_to_factory(Device& device, Cell, Value);

}  // namespace understudy::emulator::models::simple2_r3
