// The parts of a row of SLIM's command table.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace understudy::interpreter::slim {

/// The functions of commands. A row's `variant` distinguishes related commands; the comments explain its
/// values.
enum class Verb : std::uint8_t {
  // one motor
  move_absolute,
  move_relative,
  jog_forward,
  jog_reverse,
  jog_stop,
  thrust,
  home,
  set_coordinate,
  servo_on,
  servo_off,
  reset,
  servo_off_now,  // IHOFF and IHON bypass the buffer
  servo_on_now,
  analog_speed,
  // outputs
  set_port,
  clear_port,
  toggle_port,
  pulse_port,
  set_all_ports,
  set_port_now,
  clear_port_now,
  pwm,
  set_port_at,  // variant: comparator 1 or 2
  clear_port_at,
  // program flow
  run,
  jump,
  jump_if,         // variant: a Condition
  jump_if_within,  // variant: Condition::input_on or input_off
  call,
  return_,
  wait_input,  // variant: Condition::input_on or input_off
  wait_time,
  wait_done,
  set_event,
  on_event,
  pause,
  redo,
  clear_buffer,
  exit,
  // program editing and transfer
  program_new,
  program_append,
  program_list,
  program_edit,
  program_insert,
  program_delete,
  upload,
  download,
  // numbers, parameters, memory
  get_integer,
  get_real,
  print,
  set_variable,   // operands: the variable and its new value; also for AIN=N0 and DATA
  set_parameter,  // name; operand: the new value
  list_parameters,
  default_parameters,
  save_data,
  save_parameters,
  save_program,
  reboot,
  // queries
  query_input,  // without an operand: all inputs
  query_analog,
  query_switch,
  query_status,
  query_version,
  query_variable,
  query_coordinate,
  query_voltage,
  query_peak_current,
  query_mean_current,
  query_peak_following_error,
  query_motor_version,
  query_mode,
  query_temperature,
  query_error,
  query_error_history,
  query_time,
  query_parameter,  // name
  // several motors
  map_axis,  // variant: axis 0 to 3 (x, y, z, w)
  line_absolute,
  line_relative,
  arc_absolute,
  arc_relative,
  helix_absolute,
  helix_relative,
  spiral,
  pause_all,
  resume_all,
  abandon_all,
  stop_all,
  axis_move_absolute,  // variant: axis
  axis_move_relative,
  axis_wait_done,
  set_path_speed,
  continuous_path,  // variant: mode 0 to 2
};

/// What a place after a command's name accepts as an operand.
enum class Slot : std::uint8_t {
  none,
  real,           // a constant
  real_variable,  // R0 to R64
  port,           // P1 to P4
  input,          // 1 to 8
  maybe_input,
  dip_switch,  // 1 to 6
  address,     // $LABEL or the number of a line
  maybe_address,
  line,              // the number of a line
  integer_variable,  // N# or NS(i)
  variable,          // N#, R#, NS(i) or RS(i)
  stored_variable,   // N# or R#
  comparand,         // a constant, variable or function of the type of the next variable
  data,              // a constant, variable or function that fits the previous variable
  milliseconds,
  pulse_width,  // in units of 4 ms
  frequency,    // in Hz
  percent,
  thrust_level,  // 1 to 20000
  levels,        // 0 to 15: bit 0 is port 1
  axis_module,   // 0 to 5, or 8 for none
  flag,          // 0 or 1
  whole,         // an integer
  variant,       // exactly the row's `variant`
  event,         // EV1 to EV8
  condition,     // of an event, including all that follows
  word,          // the second word of the command's name
  text,          // in quotes
};

/// The condition of a jump or an event. Its operands are either an input, or a variable, or a comparand and a
/// variable.
enum class Condition : std::uint8_t {
  input_on,
  input_off,
  zero,
  not_zero,
  equal,  // the variable equals the comparand
  not_equal,
  greater,  // the variable is greater than the comparand
  not_greater,
};

/// The contents of the manual's columns. The first list has no columns.
enum class Printed : std::uint8_t { no, yes, nothing };

struct CommandRow {
  std::string_view command;  // "Tp" as a prefix: may have a module; "?": a query
  std::string_view syntax;   // as the manual writes it; with "=": an assignment
  std::string_view meaning;
  std::string_view group;
  Printed program;    // 程式
  Printed immediate;  // 立即
  Printed external;   // 外部
  Verb verb;
  std::array<Slot, 4> slots = {};  // for an assignment, the slots after the "="
  int variant = -1;

  constexpr bool takes_module() const { return command.starts_with("Tp") || command.starts_with("?Tp"); }
  constexpr bool is_query() const { return command.starts_with('?'); }
  constexpr bool is_assignment() const { return syntax.find('=') != std::string_view::npos; }
};

inline constexpr int kModuleCount = 8;
inline constexpr int kInputCount = 8;
inline constexpr int kPortCount = 4;
inline constexpr int kSwitchCount = 6;
inline constexpr int kEventCount = 8;
inline constexpr int kVariableCount = 65;  // N0 to N64, R0 to R64
inline constexpr int kArrayCount = 2001;   // NS(0) to NS(2000), RS(0) to RS(2000)
/// The range of integers: "MAX N0=32766".
inline constexpr int kIntegerMin = -32768;
inline constexpr int kIntegerMax = 32766;

}  // namespace understudy::interpreter::slim
