// SLIM: what each command can do when a host sends it. If a command has no row, the table does not compile.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/complete_table.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/hazards.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/commands.h"
#include "interpreter/slim/options.h"
#include "interpreter/slim/parse.h"

namespace understudy::emulator::models::slim {

namespace command_hazards {

using interpreter::slim::Verb;
using Row = HandlerRow<Verb, Hazards>;

inline constexpr Hazards kReads = Hazards::reads;
inline constexpr Hazards kValue = Hazards::settings;
inline constexpr Hazards kMotion = Hazards::motion;
inline constexpr Hazards kOutput = Hazards::output;
inline constexpr Hazards kMemory = Hazards::memory;
// A program can do everything that its commands can do.
inline constexpr Hazards kProgram = kMemory | kOutput | kMotion;
// Within a program, a line is only stored; typed, it is refused.
inline constexpr Hazards kInProgram = kMemory;
// Parameters include speeds, limits, the modes of inputs and outputs, and which modules are linked.
inline constexpr Hazards kAnyParameter = kOutput | kMotion | Hazards::stops_answering;
inline constexpr Hazards kEverything = Hazards::all;

// clang-format off
inline constexpr Row kRows[] = {
    {Verb::move_absolute, kMotion},
    {Verb::move_relative, kMotion},
    {Verb::jog_forward, kMotion},
    {Verb::jog_reverse, kMotion},
    {Verb::jog_stop, kMotion},
    {Verb::thrust, kMotion},
    {Verb::home, kMotion},
    {Verb::set_coordinate, kMotion},
    {Verb::servo_on, kMotion},
    {Verb::servo_off, kMotion},
    {Verb::reset, kMotion},
    {Verb::servo_off_now, kMotion},
    {Verb::servo_on_now, kMotion},
    {Verb::analog_speed, kMotion},
    {Verb::set_port, kOutput},
    {Verb::clear_port, kOutput},
    {Verb::toggle_port, kOutput},
    {Verb::pulse_port, kOutput},
    {Verb::set_all_ports, kOutput},
    {Verb::set_port_now, kOutput},
    {Verb::clear_port_now, kOutput},
    {Verb::pwm, kOutput},
    {Verb::set_port_at, kOutput},
    {Verb::clear_port_at, kOutput},
    {Verb::run, kProgram},
    {Verb::jump, kInProgram},
    {Verb::jump_if, kInProgram},
    {Verb::jump_if_within, kInProgram},
    {Verb::call, kInProgram},
    {Verb::return_, kInProgram},
    {Verb::wait_input, kInProgram},
    {Verb::wait_time, kInProgram},
    {Verb::wait_done, kInProgram},
    {Verb::set_event, kProgram},
    {Verb::on_event, kProgram},
    {Verb::pause, kMotion},
    {Verb::redo, kMotion},
    {Verb::clear_buffer, kMotion},
    {Verb::exit, kMotion},
    {Verb::program_new, kMemory},
    {Verb::program_append, kMemory},
    {Verb::program_list, kReads},
    {Verb::program_edit, kMemory},
    {Verb::program_insert, kMemory},
    {Verb::program_delete, kMemory},
    {Verb::upload, kReads},
    {Verb::download, kMemory},
    {Verb::get_integer, kInProgram},
    {Verb::get_real, kInProgram},
    {Verb::print, kReads},
    {Verb::set_variable, kValue},
    {Verb::set_parameter, kAnyParameter},
    {Verb::list_parameters, kReads},
    {Verb::default_parameters, kAnyParameter},
    {Verb::save_data, kMemory},
    {Verb::save_parameters, kMemory},
    {Verb::save_program, kMemory},
    {Verb::reboot, kEverything},
    {Verb::map_axis, kMotion},
    {Verb::line_absolute, kMotion},
    {Verb::line_relative, kMotion},
    {Verb::arc_absolute, kMotion},
    {Verb::arc_relative, kMotion},
    {Verb::helix_absolute, kMotion},
    {Verb::helix_relative, kMotion},
    {Verb::spiral, kMotion},
    {Verb::pause_all, kMotion},
    {Verb::resume_all, kMotion},
    {Verb::abandon_all, kMotion},
    {Verb::stop_all, kMotion},
    {Verb::axis_move_absolute, kMotion},
    {Verb::axis_move_relative, kMotion},
    {Verb::axis_wait_done, kInProgram},
    {Verb::set_path_speed, kMotion},
    {Verb::continuous_path, kMotion},
};
// clang-format on

/// Queries are replaced by another command, which is possible because a key may occur twice.
inline constexpr auto kVerbs = [] {
  std::array<Verb, interpreter::slim::kCommands.size()> verbs{};
  std::size_t count = 0;
  for (const auto& row : interpreter::slim::kCommands)
    verbs[count++] = row.is_query() ? Verb::home : row.verb;
  return verbs;
}();

inline constexpr CompleteTable<Verb, Hazards> kTable(kVerbs, kRows);

}  // namespace command_hazards

/// Returns the effect of a line on program entry (PG, PE, PI, PA, DL).
inline EditMark edit_mark_of_line(std::string_view line) {
  namespace lang = interpreter::slim;
  using lang::Verb;
  constexpr char kEscape = '\x1B';
  const bool is_blank = line.find_first_not_of(" \t\r\n") == std::string_view::npos;
  if (is_blank || line.find(kEscape) != std::string_view::npos) return EditMark::ends;
  const lang::ParseResult parsed = lang::parse_line(line, lang::kWidestDialect);
  if (parsed.error != lang::Error::none || !parsed.line.command) return EditMark::none;
  const Verb verb = parsed.line.command->verb;
  if (verb == Verb::program_edit || verb == Verb::program_insert) return EditMark::begins_one_line;
  const bool begins = verb == Verb::program_new || verb == Verb::program_append || verb == Verb::download;
  return begins ? EditMark::begins : verb == Verb::exit ? EditMark::ends : EditMark::none;
}

/// Returns what a line of text can do. A line that the emulator does not recognise as a command may be a
/// command for a real controller, or belong to a program that is being entered.
inline Hazards hazards_of_line(std::string_view line) {
  namespace lang = interpreter::slim;
  const lang::ParseResult parsed = lang::parse_line(line, lang::kWidestDialect);
  if (parsed.error != lang::Error::none) return line.starts_with('?') ? Hazards::reads : Hazards::all;
  if (!parsed.line.command) return parsed.line.label.empty() ? Hazards::reads : Hazards::memory;
  const lang::Command& command = *parsed.line.command;
  if (lang::kCommands[static_cast<std::size_t>(command.row)].is_query()) return Hazards::reads;
  const bool is_array = command.verb == lang::Verb::set_variable && !command.operands.empty() &&
                        lang::is_array(command.operands.front().kind);
  return command_hazards::kTable[command.verb] | (is_array ? Hazards::memory : Hazards::reads);
}

/// Returns the numbers in a line. The number is missing if the line contains a variable, an input or a clock
/// instead.
inline std::optional<CommandNumbers> numbers_of_command(std::string_view line) {
  namespace lang = interpreter::slim;
  using Kind = lang::Operand::Kind;
  const lang::ParseResult parsed = lang::parse_line(line, lang::kWidestDialect);
  if (parsed.error != lang::Error::none) return std::nullopt;
  CommandNumbers told;
  if (!parsed.line.command) return told;
  const lang::Command& command = *parsed.line.command;
  const lang::CommandRow& row = lang::kCommands[static_cast<std::size_t>(command.row)];
  std::span<const lang::Operand> operands = command.operands;
  std::string word(row.command.substr(0, row.command.find(' ')));
  if (word.starts_with("Tp")) word.erase(0, 2);
  if (!command.name.empty()) word = command.name;
  if (command.verb == lang::Verb::set_variable && !operands.empty()) {
    const lang::Operand& target = operands.front();
    word = lang::holds_integer(target.kind) ? "N" : "R";
    word += lang::is_array(target.kind) ? "S" : std::to_string(target.index);
    operands = operands.subspan(1);
  }
  if (command.module <= 0) told.names.push_back(word);
  told.names.push_back("T" + std::to_string(std::max(command.module, 0)) + word);
  for (const lang::Operand& operand : operands) {
    const bool is_number = operand.kind == Kind::integer || operand.kind == Kind::real;
    const bool stands_for_one = lang::is_variable(operand.kind) || lang::asks_host(operand.kind) ||
                                operand.kind == Kind::analog || operand.kind == Kind::clock ||
                                operand.kind == Kind::quantity;
    if (is_number) told.numbers.emplace_back(operand.number);
    if (stands_for_one) told.numbers.emplace_back(std::nullopt);
  }
  return told;
}

}  // namespace understudy::emulator::models::slim
