#include "interpreter/rs_m8194h/window.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "interpreter/rs_m8194h/check.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/command_row.h"
#include "interpreter/rs_m8194h/commands.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/operators.h"
#include "interpreter/rs_m8194h/verbs.h"

namespace understudy::interpreter::rs_m8194h {
namespace {

struct Pair {
  std::uint16_t first = 0;
  std::uint16_t second = 0;
};

constexpr std::uint32_t joined(Pair pair, WordOrder order) {
  if (order == WordOrder::low_first) std::swap(pair.first, pair.second);
  return (std::uint32_t{pair.first} << 16U) | pair.second;
}

constexpr Pair parted(std::uint32_t value, WordOrder order) {
  Pair pair{static_cast<std::uint16_t>(value >> 16U), static_cast<std::uint16_t>(value)};
  if (order == WordOrder::low_first) std::swap(pair.first, pair.second);
  return pair;
}

/// Pairs of codes that chapter 7 and table 12.3 swap.
constexpr std::uint16_t kSwapped[][2] = {{0x0C81, 0x0CFC}, {0x0A84, 0x0AFD}, {0x0C84, 0x0CFD}};

/// This code appears only in a frame of 7.4.8.
constexpr std::uint16_t kMisprint = 0x0CB2;

std::uint16_t meant_by(std::uint16_t code, const Options& options) {
  if (code == kMisprint && options.chose(option("code_0cb2", "that_command")))
    return macro_code(Verb::mix_2d_initial);
  if (!options.chose(option("swapped_codes", "of_12_3"))) return code;
  for (const auto& [one, other] : kSwapped) {
    if (code == one) return other;
    if (code == other) return one;
  }
  return code;
}

/// Returns true for `<=`, `>=` and `!=`. Their first code has the letter order of the frame, the second the
/// order of the table.
bool has_two_orders(const ComparisonRow& row) {
  return row.text.size() == 2 && row.comparison != Comparison::equal;
}

/// Returns the operator of IF in its usual form. A form that the options do not accept becomes an invalid
/// operator.
std::uint32_t comparison_of(std::uint32_t sent, const Options& options) {
  const ComparisonRow* const row = find_comparison(sent);
  if (row == nullptr) return sent;
  const bool is_other = has_two_orders(*row) &&
                        ((options.chose(option("if_operator", "as_in_the_frame")) && sent == row->codes[1]) ||
                         (options.chose(option("if_operator", "as_in_the_table")) && sent == row->codes[0]));
  const bool is_letter = (sent & 0xFFU) == 0 || (sent >> 8U & 0xFFU) == 0;
  const bool is_single =
      is_letter && (row->comparison == Comparison::equal || row->comparison == Comparison::not_equal);
  return is_other || (is_single && options.chose(option("if_single_signs", "are_refused"))) ? 0
                                                                                            : row->codes[0];
}

/// The inverse of comparison_of(): returns the form that the options accept.
std::uint32_t sent_as(std::uint32_t comparison, const Options& options) {
  const ComparisonRow* const row = find_comparison(comparison);
  const bool is_other = row != nullptr && comparison == row->codes[0] && has_two_orders(*row) &&
                        options.chose(option("if_operator", "as_in_the_table"));
  return is_other ? row->codes[1] : comparison;
}

/// Holding registers 300 to 1323 are the variables.
std::uint32_t variable_at(std::uint32_t address) {
  constexpr std::uint32_t kFirst = 300;
  const bool is_one = address >= kFirst && address < kFirst + 2 * kVariableCount && address % 2 == 0;
  return is_one ? static_cast<std::uint32_t>(kVariable0) + (address - kFirst) / 2 : address;
}

}  // namespace

Fault why_not_now(std::uint16_t code, State state) {
  const bool is_macro_line = is_macro_code(code);
  if (state == State::ready) return is_macro_line ? Fault::macro_outside : Fault::none;
  if (!is_macro_line) return Fault::real_time_in_macro;
  const CommandRow* row = find_code(code);
  if (row == nullptr) return Fault::none;
  if (state == State::mp_download) return row->use.in_mp ? Fault::none : Fault::isr_in_mp;
  return row->use.in_isr ? Fault::none : Fault::mp_in_isr;
}

Fault read_registers(std::span<const std::uint16_t> registers, WordOrder order, Command& command,
                     const Options& options) {
  if (registers.empty()) return Fault::register_count;
  command = {.code = meant_by(registers[0], options)};
  const CommandRow* row = find_code(command.code);
  if (row == nullptr) return Fault::undefined_command;
  const auto wanted = static_cast<std::size_t>(row->registers());
  const bool is_short = options.chose(option("frnet_wait_registers", "8_or_7_with_a_time_of_one")) &&
                        command.verb() == Verb::frnet_wait;
  const bool is_one_short = is_short && registers.size() + 1 == wanted;
  if (registers.size() != wanted && !is_one_short) return Fault::register_count;
  std::size_t at = 1;
  const std::size_t count = row->parameter_count();
  for (std::size_t i = 0; i < count; ++i) {
    if (row->parameters[i].registers() == 1 || (is_one_short && i + 1 == count)) {
      command.values[i] = registers[at];
    } else {
      command.values[i] = joined({registers[at], registers[at + 1]}, order);
    }
    at += static_cast<std::size_t>(row->parameters[i].registers());
    if (row->parameters[i].kind == Kind::comparison) {
      command.values[i] = comparison_of(command.values[i], options);
    }
  }
  if (options.chose(option("frnet_out_data", "variable_by_its_address")) &&
      command.verb() == Verb::frnet_out) {
    command.values[1] = variable_at(command.values[1]);
  }
  return Fault::none;
}

Decoded decode(std::span<const std::uint16_t> registers, State state, WordOrder order,
               const Options& options) {
  Decoded decoded;
  if (registers.empty()) return {.fault = Fault::register_count};
  const std::uint16_t code = decoded.command.code = meant_by(registers[0], options);
  const bool is_undefined = find_code(code) == nullptr;
  const Fault not_now = why_not_now(code, state);
  decoded.fault = is_undefined ? Fault::undefined_command : Fault::none;
  if (not_now != Fault::none &&
      (!is_undefined || options.chose(option("check_order", "the_same_but_state_before_code"))))
    decoded.fault = not_now;
  if (decoded.fault != Fault::none) return decoded;
  decoded.fault = read_registers(registers, order, decoded.command, options);
  if (decoded.fault != Fault::none) return decoded;
  decoded.parameter = bad_parameter(decoded.command, options);
  if (decoded.parameter) decoded.fault = Fault::parameter;
  return decoded;
}

std::vector<std::uint16_t> encode(const Command& command, WordOrder order, const Options& options) {
  std::vector<std::uint16_t> registers = {meant_by(command.code, options)};
  const CommandRow& row = command.row();
  for (std::size_t i = 0; i < row.parameter_count(); ++i) {
    if (row.parameters[i].kind == Kind::comparison) {
      registers.push_back(static_cast<std::uint16_t>(sent_as(command.values[i], options)));
    } else if (row.parameters[i].registers() == 1) {
      registers.push_back(static_cast<std::uint16_t>(command.values[i]));
    } else {
      const Pair pair = parted(command.values[i], order);
      registers.insert(registers.end(), {pair.first, pair.second});
    }
  }
  return registers;
}

}  // namespace understudy::interpreter::rs_m8194h
