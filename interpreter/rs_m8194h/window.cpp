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

Fault read_registers(std::span<const std::uint16_t> registers, WordOrder order, Command& command) {
  if (registers.empty()) return Fault::register_count;
  command = {.code = registers[0]};
  const CommandRow* row = find_code(command.code);
  if (row == nullptr) return Fault::undefined_command;
  if (registers.size() != static_cast<std::size_t>(row->registers())) return Fault::register_count;
  std::size_t at = 1;
  const std::size_t count = row->parameter_count();
  for (std::size_t i = 0; i < count; ++i) {
    if (row->parameters[i].registers() == 1) {
      command.values[i] = registers[at];
    } else {
      command.values[i] = joined({registers[at], registers[at + 1]}, order);
    }
    at += static_cast<std::size_t>(row->parameters[i].registers());
    if (row->parameters[i].kind != Kind::comparison) continue;
    const ComparisonRow* comparison = find_comparison(command.values[i]);
    if (comparison != nullptr) command.values[i] = comparison->codes[0];
  }
  return Fault::none;
}

Decoded decode(std::span<const std::uint16_t> registers, State state, WordOrder order,
               const CommandOptions& options) {
  Decoded decoded;
  if (registers.empty()) return {.fault = Fault::register_count};
  decoded.command.code = registers[0];
  if (find_code(registers[0]) == nullptr) {
    decoded.fault = Fault::undefined_command;
    return decoded;
  }
  decoded.fault = why_not_now(registers[0], state);
  if (decoded.fault != Fault::none) return decoded;
  decoded.fault = read_registers(registers, order, decoded.command);
  if (decoded.fault != Fault::none) return decoded;
  decoded.parameter = bad_parameter(decoded.command, options);
  if (decoded.parameter) decoded.fault = Fault::parameter;
  return decoded;
}

std::vector<std::uint16_t> encode(const Command& command, WordOrder order) {
  std::vector<std::uint16_t> registers = {command.code};
  const CommandRow& row = command.row();
  for (std::size_t i = 0; i < row.parameter_count(); ++i) {
    if (row.parameters[i].registers() == 1) {
      registers.push_back(static_cast<std::uint16_t>(command.values[i]));
    } else {
      const Pair pair = parted(command.values[i], order);
      registers.insert(registers.end(), {pair.first, pair.second});
    }
  }
  return registers;
}

}  // namespace understudy::interpreter::rs_m8194h
