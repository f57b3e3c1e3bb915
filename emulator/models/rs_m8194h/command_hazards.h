// RS-M8194H: what each command can do when a host sends it. If a command has no row, the table does not
// compile.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "base/complete_table.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/hazards.h"
#include "interpreter/rs_m8194h/check.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/command_row.h"
#include "interpreter/rs_m8194h/commands.h"
#include "interpreter/rs_m8194h/text.h"

namespace understudy::emulator::models::rs_m8194h {

namespace command_hazards {

using interpreter::rs_m8194h::Verb;
using Row = HandlerRow<Verb, Hazards>;

inline constexpr Hazards kValue = Hazards::settings;  // takes effect from the next drive on
inline constexpr Hazards kMotion = Hazards::motion;   // including commands that affect a drive in progress
inline constexpr Hazards kOutput = Hazards::output;
inline constexpr Hazards kMemory = Hazards::memory;  // lines of macros are only stored
inline constexpr Hazards kWires = kOutput | kMotion;
inline constexpr Hazards kMacro = kMemory | kOutput | kMotion;  // whatever its lines can do
inline constexpr Hazards kEverything = Hazards::all;

// clang-format off
inline constexpr Row kRows[] = {
    {Verb::emergency_stop, kMotion},
    {Verb::clear_emergency_stop, kMotion},
    {Verb::clear_vstop, kMotion},
    {Verb::reset_card, kEverything},
    {Verb::clear_card_buffer, kMotion},
    {Verb::set_pulse_mode, kWires},
    {Verb::set_max_v, kMotion},
    {Verb::set_hlmt, kMotion},
    {Verb::limitstop_mode, kMotion},
    {Verb::set_nhome, kMotion},
    {Verb::set_home_edge, kMotion},
    {Verb::set_slmt, kMotion},
    {Verb::clear_slmt, kMotion},
    {Verb::set_encoder, kMotion},
    {Verb::servo_on, kWires},
    {Verb::servo_off, kWires},
    {Verb::set_alarm, kMotion},
    {Verb::set_inpos, kMotion},
    {Verb::set_filter, kMotion},
    {Verb::vring_enable, kMotion},
    {Verb::vring_disable, kMotion},
    {Verb::avtri_enable, kMotion},
    {Verb::avtri_disable, kMotion},
    {Verb::exd_mp, kMotion},
    {Verb::exd_fp, kMotion},
    {Verb::exd_cp, kMotion},
    {Verb::exd_disable, kMotion},
    {Verb::write_byte_var, kValue},
    {Verb::write_var, kValue},
    {Verb::write_md, kMemory},
    {Verb::set_lp, kMotion},
    {Verb::get_lp, kMemory},
    {Verb::set_ep, kMotion},
    {Verb::get_ep, kMemory},
    {Verb::get_di, kMemory},
    {Verb::get_error, kMemory},
    {Verb::get_error_code, kMemory},
    {Verb::get_di_all, kMemory},
    {Verb::frnet_in, kMemory},
    {Verb::frnet_out, kOutput},
    {Verb::frnet_read, kMemory},
    {Verb::frnet_write, kOutput},
    {Verb::frnet_wait, kMemory},
    {Verb::set_hv, kMotion},
    {Verb::home_limit, kMotion},
    {Verb::set_home_mode, kMotion},
    {Verb::home_start, kMotion},
    {Verb::get_di_signal, kMemory},
    {Verb::get_di_signal_all, kMemory},
    {Verb::get_home_search_state, kMemory},
    {Verb::change_vel_on_fly, kMotion},
    {Verb::normal_speed, kValue},
    {Verb::set_sv, kValue},
    {Verb::set_v, kMotion},
    {Verb::set_a, kValue},
    {Verb::set_d, kValue},
    {Verb::set_k, kValue},
    {Verb::set_l, kValue},
    {Verb::set_ao, kValue},
    {Verb::fixed_move, kMotion},
    {Verb::set_pulse, kMotion},
    {Verb::continue_move, kMotion},
    {Verb::axis_assign, kValue},
    {Verb::vector_speed, kValue},
    {Verb::set_vsv, kValue},
    {Verb::set_vv, kMotion},
    {Verb::set_va, kValue},
    {Verb::set_vd, kValue},
    {Verb::set_vk, kValue},
    {Verb::set_vl, kValue},
    {Verb::set_vao, kValue},
    {Verb::line_2d, kMotion},
    {Verb::line_3d, kMotion},
    {Verb::arc_cw, kMotion},
    {Verb::arc_ccw, kMotion},
    {Verb::circle_cw, kMotion},
    {Verb::circle_ccw, kMotion},
    {Verb::sync_action, kWires},
    {Verb::set_compare, kMotion},
    {Verb::get_latch, kMemory},
    {Verb::set_preset, kMotion},
    {Verb::set_out, kOutput},
    {Verb::rectangle, kMotion},
    {Verb::line_2d_initial, kMotion},
    {Verb::line_2d_continue, kMotion},
    {Verb::line_3d_initial, kMotion},
    {Verb::line_3d_continue, kMotion},
    {Verb::mix_2d_initial, kMotion},
    {Verb::mix_2d_continue, kMotion},
    {Verb::helix_3d, kMotion},
    {Verb::line_scan, kWires},
    {Verb::line_scan_start, kWires},
    {Verb::clear_sync_action, kWires},
    {Verb::set_activation_factors, kWires},
    {Verb::set_activation_axis, kWires},
    {Verb::set_action, kWires},
    {Verb::enable_int, kMacro},
    {Verb::disable_int, kMacro},
    {Verb::intfactor_enable, kMacro},
    {Verb::intfactor_disable, kMacro},
    {Verb::drv_hold, kMotion},
    {Verb::drv_start, kMotion},
    {Verb::stop_slowly, kMotion},
    {Verb::stop_suddenly, kMotion},
    {Verb::vstop_slowly, kMotion},
    {Verb::vstop_suddenly, kMotion},
    {Verb::clear_stop, kMotion},
    {Verb::load_initial, kWires},
    {Verb::mp_create, kMemory},
    {Verb::mp_close, kMemory},
    {Verb::mp_call, kMacro},
    {Verb::isr_create, kMemory},
    {Verb::isr_close, kMemory},
    {Verb::isr_call, kMacro},
    {Verb::set_var, kMemory},
    {Verb::set_rvar, kMemory},
    {Verb::var_calculate, kMemory},
    {Verb::for_, kMemory},
    {Verb::next, kMemory},
    {Verb::if_, kMemory},
    {Verb::else_, kMemory},
    {Verb::end_if, kMemory},
    {Verb::timer, kMemory},
    {Verb::stop_wait, kMotion},
    {Verb::exit_macro, kMemory},
    {Verb::exit_for, kMemory},
    {Verb::goto_, kMemory},
    {Verb::label, kMemory},
    {Verb::mp_terminate, kMotion},
    {Verb::abs_set_position, kMotion},
    {Verb::abs_get_position, kMemory},
    {Verb::abs_fixed_move, kMotion},
    {Verb::abs_line_2d, kMotion},
    {Verb::abs_line_3d, kMotion},
    {Verb::abs_arc_cw, kMotion},
    {Verb::abs_arc_ccw, kMotion},
    {Verb::abs_line_2d_continue, kMotion},
    {Verb::abs_line_3d_continue, kMotion},
    {Verb::abs_mix_2d_continue, kMotion},
};
// clang-format on

/// A key may occur twice, because several rows of the manual share a verb.
inline constexpr auto kVerbs = [] {
  std::array<Verb, interpreter::rs_m8194h::kCommands.size()> verbs{};
  std::size_t count = 0;
  for (const auto& row : interpreter::rs_m8194h::kCommands) verbs[count++] = row.verb;
  return verbs;
}();

inline constexpr CompleteTable<Verb, Hazards> kTable(kVerbs, kRows);

}  // namespace command_hazards

/// Returns what a message to the command window can do.
inline Hazards hazards_of_command(std::span<const std::uint16_t> words) {
  namespace lang = interpreter::rs_m8194h;
  const lang::CommandRow* const row = words.empty() ? nullptr : lang::find_code(words[0]);
  if (row == nullptr) return Hazards::all;
  if (lang::is_macro_code(words[0])) return Hazards::memory;
  const bool is_initial = row->use.initial && words.size() > 1 && (words[1] & lang::kInitial) != 0;
  return Hazards::settings | command_hazards::kTable[row->verb] |
         (is_initial ? Hazards::memory : Hazards::reads);
}

/// Returns the numbers in a command, such as 1000 in RSM_FIXED_MOVE X 1000. Axes, operators and destinations
/// do not count. A macro line is named like its command.
inline std::optional<CommandNumbers> numbers_of_command(std::string_view text) {
  namespace lang = interpreter::rs_m8194h;
  using lang::Kind;
  const std::optional<lang::Command> command = lang::parse_command(text, lang::kAnyChoice).command;
  if (!command) return std::nullopt;
  const lang::CommandRow& row = command->row();
  CommandNumbers told;
  if (command->is_macro_line()) told.names.emplace_back(row.macro_name);
  if (!row.real_time_name.empty()) told.names.emplace_back(row.real_time_name);
  for (std::size_t i = 0; i < row.parameter_count(); ++i) {
    const lang::Parameter& parameter = row.parameters[i];
    const bool is_number = parameter.kind < Kind::axes || parameter.kind == Kind::operand ||
                           parameter.kind == Kind::isr_if_used || parameter.kind == Kind::point_if_used;
    if (!is_number) continue;
    if (lang::is_reference(*command, i)) {
      told.numbers.emplace_back(std::nullopt);
    } else if (parameter.width != lang::Width::real) {
      told.numbers.emplace_back(static_cast<double>(command->number(i)));
    } else {
      const float real = std::bit_cast<float>(command->values[i]);
      told.numbers.push_back(std::isfinite(real) ? std::optional<double>(real) : std::nullopt);
    }
  }
  return told;
}

}  // namespace understudy::emulator::models::rs_m8194h
