// The manual's first list: commands for one motor, programs, variables, parameters, queries. It has no
// columns.
#pragma once

#include <array>
#include <string_view>

#include "interpreter/slim/command_row.h"

namespace understudy::interpreter::slim::rows {

using enum Slot;
using enum Condition;

/// Abbreviations for the rows: each constant is one combination of the manual's three columns.
struct PrintedColumns {
  Printed program, immediate, external;
};
inline constexpr PrintedColumns kUnprinted{Printed::nothing, Printed::nothing, Printed::nothing};
inline constexpr PrintedColumns kTyped{Printed::yes, Printed::yes, Printed::no};
inline constexpr PrintedColumns kStored{Printed::yes, Printed::no, Printed::no};
inline constexpr PrintedColumns kAlways{Printed::yes, Printed::yes, Printed::yes};

consteval CommandRow row(std::string_view command, std::string_view syntax, std::string_view meaning,
                         std::string_view group, PrintedColumns columns, Verb verb, std::array<Slot, 4> slots,
                         int variant = -1) {
  return {command,           syntax,           meaning, group, columns.program,
          columns.immediate, columns.external, verb,    slots, variant};
}
consteval int v(Condition condition) { return static_cast<int>(condition); }

inline constexpr std::string_view kMotion = "motion";
inline constexpr std::string_view kJog = "jog";
inline constexpr std::string_view kHome = "home";
inline constexpr std::string_view kCoordinate = "coordinate";
inline constexpr std::string_view kMotorControl = "motor control";
inline constexpr std::string_view kOutput = "output";
inline constexpr std::string_view kPositionSynchronisedOutput = "position-synchronised output";
inline constexpr std::string_view kProgramFlow = "program flow";
inline constexpr std::string_view kSpeedControl = "speed control";
inline constexpr std::string_view kProgramManagement = "program management";
inline constexpr std::string_view kRs232Io = "RS232 I/O";
inline constexpr std::string_view kDatabase = "database";
inline constexpr std::string_view kVariables = "variables";
inline constexpr std::string_view kSystemParameters = "system parameters";
inline constexpr std::string_view kQuery = "query";
inline constexpr std::string_view kMultiAxis = "multi-axis";

inline constexpr std::array<CommandRow, 117> kOneMotor{{
    row("MA", "MA x", "Move absolutely to coordinate x at working speed", kMotion, kUnprinted,
        Verb::move_absolute, {real}),
    row("MA", "MA Rn", "Move absolutely to the coordinate held in Rn (manual prints R0)", kMotion, kUnprinted,
        Verb::move_absolute, {real_variable}),
    row("MR", "MR x", "Move relatively by x at working speed", kMotion, kUnprinted, Verb::move_relative,
        {real}),
    row("MR", "MR Rn", "Move relatively by the value held in Rn (manual prints R0)", kMotion, kUnprinted,
        Verb::move_relative, {real_variable}),
    row("TpMA", "TpMA x", "Module p (1-7) moves absolutely to x at working speed", kMotion, kUnprinted,
        Verb::move_absolute, {real}),
    row("TpMR", "TpMR x", "Module p (1-7) moves relatively by x at working speed", kMotion, kUnprinted,
        Verb::move_relative, {real}),
    row("SPI", "SPI X,Y,R,L", "Two-axis flat spiral (mosquito-coil shape); meaning of R and L not defined",
        kMotion, kUnprinted, Verb::spiral, {real, real, real, real}),
    row("JGF", "JGF", "Jog forward continuously", kJog, kUnprinted, Verb::jog_forward, {}),
    row("JGR", "JGR", "Jog reverse continuously", kJog, kUnprinted, Verb::jog_reverse, {}),
    row("JG0", "JG0", "End jog; decelerate to stop (digit zero)", kJog, kUnprinted, Verb::jog_stop, {}),
    row("TpJGF", "TpJGF", "Module p jog forward", kJog, kUnprinted, Verb::jog_forward, {}),
    row("TpJGR", "TpJGR", "Module p jog reverse", kJog, kUnprinted, Verb::jog_reverse, {}),
    row("TpJG0", "TpJG0", "Module p end jog, decelerate to stop", kJog, kUnprinted, Verb::jog_stop, {}),
    row("FT", "FT n", "Fixed torque/thrust n = 1-20000 (torque motor, encoder required)", kJog, kUnprinted,
        Verb::thrust, {thrust_level}),
    row("TpFT", "TpFT n", "Module p fixed torque/thrust", kJog, kUnprinted, Verb::thrust, {thrust_level}),
    row("H", "H", "Home (in horg)", kHome, kUnprinted, Verb::home, {}),
    row("TpH", "TpH",
        "Module p home (manual prints T1H = second axis, so T0 is the first; up to 16 axes linked)", kHome,
        kUnprinted, Verb::home, {}),
    row("CS", "CS x", "Set the present position coordinate to x", kCoordinate, kUnprinted,
        Verb::set_coordinate, {real}),
    row("TpCS", "TpCS x", "Module p set present coordinate", kCoordinate, kUnprinted, Verb::set_coordinate,
        {real}),
    row("HON", "HON", "Hold on: start motor control", kMotorControl, kUnprinted, Verb::servo_on, {}),
    row("TpHON", "TpHON", "Module p: Hold on: start motor control", kMotorControl, kUnprinted, Verb::servo_on,
        {}),
    row("HOFF", "HOFF", "Hold off: suspend motor control", kMotorControl, kUnprinted, Verb::servo_off, {}),
    row("TpHOFF", "TpHOFF", "Module p: Hold off: suspend motor control", kMotorControl, kUnprinted,
        Verb::servo_off, {}),
    row("RESET", "RESET", "Reset motor control", kMotorControl, kUnprinted, Verb::reset, {}),
    row("TpRESET", "TpRESET", "Module p: Reset motor control", kMotorControl, kUnprinted, Verb::reset, {}),
    row("IHOFF", "IHOFF", "Immediate HOFF, for use in ON EV event routines", kMotorControl, kUnprinted,
        Verb::servo_off_now, {}),
    row("IHON", "IHON", "Immediate HON, for use in ON EV event routines", kMotorControl, kUnprinted,
        Verb::servo_on_now, {}),
    row("SET", "SET Pn", "Output port n On (1-4)", kOutput, kUnprinted, Verb::set_port, {port}),
    row("CLR", "CLR Pn", "Output port n Off (1-4)", kOutput, kUnprinted, Verb::clear_port, {port}),
    row("CHG", "CHG Pn", "Toggle output port n", kOutput, kUnprinted, Verb::toggle_port, {port}),
    row("PLS", "PLS Pn,tm", "One pulse on port n, width tm x 4 ms", kOutput, kUnprinted, Verb::pulse_port,
        {port, pulse_width}),
    row("OUTP", "OUTP n", "Set all 4 output ports at once, n = 0-15", kOutput, kUnprinted,
        Verb::set_all_ports, {levels}),
    row("ISET", "ISET Pn", "Immediately set port n On (1-4)", kOutput, kUnprinted, Verb::set_port_now,
        {port}),
    row("ICLR", "ICLR Pn", "Immediately set port n Off (1-4)", kOutput, kUnprinted, Verb::clear_port_now,
        {port}),
    row("PWM", "PWM Pn,f,duty", "PWM on port n (1-4); units of f and duty not stated", kOutput, kUnprinted,
        Verb::pwm, {port, frequency, percent}),
    row("P1SET", "P1SET Pn,x", "When motion reaches coordinate x set port n On (comparator 1)",
        kPositionSynchronisedOutput, kUnprinted, Verb::set_port_at, {port, real}, 1),
    row("P2SET", "P2SET Pn,x", "Same, comparator 2", kPositionSynchronisedOutput, kUnprinted,
        Verb::set_port_at, {port, real}, 2),
    row("P1CLR", "P1CLR Pn,x", "When motion reaches coordinate x set port n Off (comparator 1)",
        kPositionSynchronisedOutput, kUnprinted, Verb::clear_port_at, {port, real}, 1),
    row("P2CLR", "P2CLR Pn,x", "Same, comparator 2 (manual prints P1CLR twice; range 1<=p<=2)",
        kPositionSynchronisedOutput, kUnprinted, Verb::clear_port_at, {port, real}, 2),
    row("G", "G [addr]", "Run program from addr; without addr from address 0", kProgramFlow, kUnprinted,
        Verb::run, {maybe_address}),
    row("JP", "JP addr", "Unconditional jump", kProgramFlow, kUnprinted, Verb::jump, {address}),
    row("JI", "JI i,addr", "Jump if input i (1-8) On", kProgramFlow, kUnprinted, Verb::jump_if,
        {input, address}, v(input_on)),
    row("JNI", "JNI i,addr", "Jump if input i (1-8) Off", kProgramFlow, kUnprinted, Verb::jump_if,
        {input, address}, v(input_off)),
    row("JZ", "JZ #int,addr", "Jump if variable is 0", kProgramFlow, kUnprinted, Verb::jump_if,
        {integer_variable, address}, v(zero)),
    row("JNZ", "JNZ #int,addr", "Jump if variable is not 0", kProgramFlow, kUnprinted, Verb::jump_if,
        {integer_variable, address}, v(not_zero)),
    row("JE", "JE c,#var,addr", "Jump if #var == c", kProgramFlow, kUnprinted, Verb::jump_if,
        {comparand, variable, address}, v(equal)),
    row("JNE", "JNE c,#var,addr", "Jump if #var != c", kProgramFlow, kUnprinted, Verb::jump_if,
        {comparand, variable, address}, v(not_equal)),
    row("JG", "JG c,#var,addr", "Jump if #var > c", kProgramFlow, kUnprinted, Verb::jump_if,
        {comparand, variable, address}, v(greater)),
    row("JNG", "JNG c,#var,addr", "Jump if #var <= c", kProgramFlow, kUnprinted, Verb::jump_if,
        {comparand, variable, address}, v(not_greater)),
    row("JTI", "JTI i,tm,addr", "Jump if input i is On or becomes On within tm", kProgramFlow, kUnprinted,
        Verb::jump_if_within, {input, milliseconds, address}, v(input_on)),
    row("JNTI", "JNTI i,tm,addr", "Jump if input i is Off or becomes Off within tm", kProgramFlow, kUnprinted,
        Verb::jump_if_within, {input, milliseconds, address}, v(input_off)),
    row("CALL", "CALL addr", "Call subroutine", kProgramFlow, kUnprinted, Verb::call, {address}),
    row("RET", "RET", "Return; at top level ends the program", kProgramFlow, kUnprinted, Verb::return_, {}),
    row("WI", "WI i", "Wait until input i is On", kProgramFlow, kUnprinted, Verb::wait_input, {input},
        v(input_on)),
    row("WNI", "WNI i", "Wait until input i is Off", kProgramFlow, kUnprinted, Verb::wait_input, {input},
        v(input_off)),
    row("WT", "WT tm", "Wait tm ms", kProgramFlow, kUnprinted, Verb::wait_time, {milliseconds}),
    row("DN", "DN", "Wait until all earlier commands have completed", kProgramFlow, kUnprinted,
        Verb::wait_done, {}),
    row("TpDN", "TpDN", "Wait for module p (only mentioned under XDN)", kProgramFlow, kUnprinted,
        Verb::wait_done, {}),
    row("SET EV", "SET EVk cond",
        "Define trigger condition of immediate interrupt event k (example SET EV1 NZ,N0)", kProgramFlow,
        kUnprinted, Verb::set_event, {event, condition}),
    row("ON EV", "ON EVk,addr", "Set event subroutine address (example ON EV1,$PPZ)", kProgramFlow,
        kUnprinted, Verb::on_event, {event, address}),
    row("PZ", "PZ", "Pause", kProgramFlow, kUnprinted, Verb::pause, {}),
    row("REDO", "REDO", "Continue commands not yet executed", kProgramFlow, kUnprinted, Verb::redo, {}),
    row("CLR BUF", "CLR BUF", "Discard commands not yet executed", kProgramFlow, kUnprinted,
        Verb::clear_buffer, {word}),
    row("AVM", "AVM", "Analog set VM: motor speed controlled by analog input", kSpeedControl, kUnprinted,
        Verb::analog_speed, {}),
    row("FU", "FU=0|1", "Unit of PN14, PN10 speeds: 1 = RPS, 0 = RPM", kSpeedControl, kUnprinted,
        Verb::set_parameter, {flag}),
    row("VJ", "VJ=x", "Jog speed parameter (appears only in the FU example)", kSpeedControl, kUnprinted,
        Verb::set_parameter, {data}),
    row("PG", "PG", "Enter program edit mode", kProgramManagement, kUnprinted, Verb::program_new, {}),
    row("PA", "PA", "Append to the existing program", kProgramManagement, kUnprinted, Verb::program_append,
        {}),
    row("PL", "PL", "List program", kProgramManagement, kUnprinted, Verb::program_list, {}),
    row("PE", "PE n", "Edit line n", kProgramManagement, kUnprinted, Verb::program_edit, {line}),
    row("PI", "PI n", "Insert a line at n", kProgramManagement, kUnprinted, Verb::program_insert, {line}),
    row("PD", "PD n", "Delete line n", kProgramManagement, kUnprinted, Verb::program_delete, {line}),
    row("ULP", "ULP", "Upload program to terminal (PC)", kProgramManagement, kUnprinted, Verb::upload, {}),
    row("DLP", "DLP", "Download program from terminal (PC)", kProgramManagement, kUnprinted, Verb::download,
        {}),
    row("EXIT", "EXIT", "Leave the running program", kProgramManagement, kUnprinted, Verb::exit, {}),
    row("ULC", "ULC", "Output all present parameters to the terminal", kProgramManagement, kUnprinted,
        Verb::list_parameters, {}),
    row("GETI", "GETI", "Input an integer from RS232", kRs232Io, kUnprinted, Verb::get_integer, {}),
    row("GETR", "GETR", "Input a real from RS232", kRs232Io, kUnprinted, Verb::get_real, {}),
    row("OUT", "OUT #var", "Output a number on RS232", kRs232Io, kUnprinted, Verb::print, {variable}),
    row("OUT", "OUT \"text\"", "Output a string on RS232", kRs232Io, kUnprinted, Verb::print, {text}),
    row("DATA", "DATA idx,r", "Store r at database address idx (N0-N64, R0-R64)", kDatabase, kUnprinted,
        Verb::set_variable, {stored_variable, data}),
    row("SAVE D", "SAVE D", "Save all database data to EEPROM", kDatabase, kUnprinted, Verb::save_data,
        {word}),
    row("N#", "N#=data", "Set integer variable N0-N64 (max 32766)", kVariables, kUnprinted,
        Verb::set_variable, {data}),
    row("R#", "R#=data", "Set real variable R0-R64", kVariables, kUnprinted, Verb::set_variable, {data}),
    row("NS", "NS(i)=data", "Set integer array element NS(0)-NS(2000) in flash", kVariables, kUnprinted,
        Verb::set_variable, {data}),
    row("RS", "RS(i)=data", "Set real array element RS(0)-RS(2000) in flash", kVariables, kUnprinted,
        Verb::set_variable, {data}),
    row("AIN", "AIN=N#",
        "Set variable N# to the value of the VR (analog) input (the variable on the right receives it; the "
        "manual calls it a resistance)",
        kVariables, kUnprinted, Verb::set_variable, {variable}),
    row("<param>", "<name>=data", "Set a system parameter", kSystemParameters, kUnprinted,
        Verb::set_parameter, {data}),
    row("Tp<param>", "Tp<name>=data", "Set a parameter of module p (example T2PR3=200)", kSystemParameters,
        kUnprinted, Verb::set_parameter, {data}),
    row("DF", "DF", "Reset all system parameters to defaults", kSystemParameters, kUnprinted,
        Verb::default_parameters, {}),
    row("SAVE C", "SAVE C", "Save all system parameters to flash", kSystemParameters, kUnprinted,
        Verb::save_parameters, {word}),
    row("SAVE P", "SAVE P", "Save program", kSystemParameters, kUnprinted, Verb::save_program, {word}),
    row("RESET H", "RESET H", "Reboot (RESET HOME)", kSystemParameters, kUnprinted, Verb::reboot, {word}),
    row("TpSYN", "T0SYN=n", "Choose the master motor for arc commands in multi-axis link (example T0SYN=2)",
        kSystemParameters, kUnprinted, Verb::set_parameter, {whole}),
    row("?IN", "?IN n", "State of input n (1-8)", kQuery, kUnprinted, Verb::query_input, {maybe_input}),
    row("?AIN", "?AIN", "Analog input (0-1000)", kQuery, kUnprinted, Verb::query_analog, {}),
    row("?SW", "?SW n", "DIP switch n (1-6)", kQuery, kUnprinted, Verb::query_switch, {dip_switch}),
    row("?ST", "?ST", "System status", kQuery, kUnprinted, Verb::query_status, {}),
    row("?VER", "?VER", "Software number", kQuery, kUnprinted, Verb::query_version, {}),
    row("?N#", "?N#", "Integer variable", kQuery, kUnprinted, Verb::query_variable, {}),
    row("?R#", "?R#", "Real variable", kQuery, kUnprinted, Verb::query_variable, {}),
    row("?PE", "?PE", "Coordinate", kQuery, kUnprinted, Verb::query_coordinate, {}),
    row("?LL", "?LL", "Motor load limit, W", kQuery, kUnprinted, Verb::query_parameter, {}),
    row("?EL", "?EL", "Position error limit", kQuery, kUnprinted, Verb::query_parameter, {}),
    row("?VM", "?VM", "Present working speed", kQuery, kUnprinted, Verb::query_parameter, {}),
    row("?AC", "?AC", "Present input voltage", kQuery, kUnprinted, Verb::query_voltage, {}),
    row("?IMX", "?IMX", "Historic maximum output current", kQuery, kUnprinted, Verb::query_peak_current, {}),
    row("?IC", "?IC", "Historic average maximum output current", kQuery, kUnprinted, Verb::query_mean_current,
        {}),
    row("?FLE", "?FLE", "Maximum error between motor and encoder, pulses", kQuery, kUnprinted,
        Verb::query_peak_following_error, {}),
    row("?MT", "?MT", "Motor version", kQuery, kUnprinted, Verb::query_motor_version, {}),
    row("?MD", "?MD", "Present MODE", kQuery, kUnprinted, Verb::query_mode, {}),
    row("?TEMP", "?TEMP", "Present temperature", kQuery, kUnprinted, Verb::query_temperature, {}),
    row("?ERR", "?ERR", "Present ERR", kQuery, kUnprinted, Verb::query_error, {}),
    row("?ERC", "?ERC", "ERR history", kQuery, kUnprinted, Verb::query_error_history, {}),
    row("?time", "?time", "Power-on time", kQuery, kUnprinted, Verb::query_time, {}),
    row("?TM", "?TM", "Seconds since power-on; can be set to 0, or from a variable such as N0 or R0", kQuery,
        kUnprinted, Verb::query_parameter, {}),
    row("?Tp", "?Tp<name>", "Query module p (example ?t1err)", kQuery, kUnprinted, Verb::query_parameter, {}),
}};

}  // namespace understudy::interpreter::slim::rows
