// The side effects of Simple2-R3's registers, for its register table. A cell's argument is an axis unless a
// comment states otherwise.
#pragma once

#include "emulator/device/register_map/row.h"

namespace understudy::emulator::models::simple2_r3 {

class Simple2R3;

inline constexpr int kAxisA = 0;
inline constexpr int kAxisB = 1;
inline constexpr int kAllAxes = 2;

// Readers.
Value read_status(const Simple2R3& device, Cell);
Value read_version(const Simple2R3& device, Cell);
Value read_output(const Simple2R3& device, Cell cell);  // index: DOUT number
Value read_all_outputs(const Simple2R3& device, Cell);
Value read_input(const Simple2R3& device, Cell cell);  // index: DIN number
Value read_all_inputs(const Simple2R3& device, Cell);
Value read_encoder(const Simple2R3& device, Cell cell);
Value read_coordinate(const Simple2R3& device, Cell cell);
Value read_incremental_trigger(const Simple2R3& device, Cell cell);  // 1 while that move is in progress
Value read_absolute_trigger(const Simple2R3& device, Cell cell);
Value read_servo(const Simple2R3& device, Cell cell);
Value read_alarm_clear(const Simple2R3& device, Cell cell);
Value read_homing_trigger(const Simple2R3& device, Cell cell);
Value read_mode(const Simple2R3& device, Cell cell);
Value read_encoder_speed(const Simple2R3& device, Cell cell);
Value read_now_line(const Simple2R3& device, Cell);
Value read_program_runs(const Simple2R3& device, Cell);
Value read_timer(const Simple2R3& device, Cell cell);  // argument: 0 or 1
Tick next_count_of_timer(const Simple2R3& device, Cell cell, Tick done);
Tick every_tick(const Simple2R3& device, Cell cell, Tick done);
Value read_adc(const Simple2R3& device, Cell cell);     // argument: 0 or 1
Value read_analog(const Simple2R3& device, Cell cell);  // argument: 0 or 1; 200 per volt
Value read_eeprom_busy(const Simple2R3& device, Cell);
Value read_cell(const Simple2R3& device, Cell cell);  // argument and index as for write_cell
Value read_unlocked(const Simple2R3& device, Cell);
Value read_password(const Simple2R3& device, Cell);
Value read_zero(const Simple2R3& device, Cell);  // for triggers that have ended immediately

// Effects.
void write_output(Simple2R3& device, Cell cell, Value level);
void write_all_outputs(Simple2R3& device, Cell, Value levels);
void preset_encoder(Simple2R3& device, Cell cell, Value counts);
void preset_coordinate(Simple2R3& device, Cell cell, Value pulses);
void change_sync(Simple2R3& device, Cell cell, Value value);
void change_speed(Simple2R3& device, Cell cell, Value);  // Speed, AccTime, DecTime or Resoultion of an axis
void start_incremental(Simple2R3& device, Cell cell, Value);
void start_absolute(Simple2R3& device, Cell cell, Value);
void start_incremental_by_set(Simple2R3& device, Cell cell, Value set);
void start_absolute_by_set(Simple2R3& device, Cell cell, Value set);
void stop_motion(Simple2R3& device, Cell cell, Value);
void switch_servo(Simple2R3& device, Cell cell, Value on);
void clear_alarm(Simple2R3& device, Cell cell, Value);
void go_home(Simple2R3& device, Cell cell, Value);
void command_velocity(Simple2R3& device, Cell cell, Value milli_rpm);
void run_velocity_by_set(Simple2R3& device, Cell cell, Value set);
void command_pwm(Simple2R3& device, Cell cell, Value percent);
void command_following(Simple2R3& device, Cell cell, Value);
void preset_timer(Simple2R3& device, Cell cell, Value value);
void start_program(Simple2R3& device, Cell, Value line);
void stop_program(Simple2R3& device, Cell, Value);
void write_cell(Simple2R3& device, Cell cell, Value value);  // argument: 0 CMD to 3 JMP; index: the line
void enter_password(Simple2R3& device, Cell, Value);
void change_password(Simple2R3& device, Cell, Value password);
void erase_program(Simple2R3& device, Cell, Value);
void reset_to_factory(Simple2R3& device, Cell, Value);

}  // namespace understudy::emulator::models::simple2_r3
