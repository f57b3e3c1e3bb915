#include "emulator/models/slim/variables.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "emulator/models/slim/chain/chain_state.h"
#include "emulator/models/slim/memory.h"
#include "emulator/models/slim/parameters.h"
#include "emulator/models/slim/parameters_set.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/options.h"

namespace understudy::emulator::models::slim {

std::int64_t clock_s(const State& state, const Setup& setup) {
  return (setup.now() - state.clock_zero) / 1000;
}

double value_of(const State& state, const Setup& setup, const lang::Operand& operand) {
  using Kind = lang::Operand::Kind;
  switch (operand.kind) {
    case Kind::integer_variable: return state.ram.integers[at(operand.index)];
    case Kind::real_variable: return state.ram.reals[at(operand.index)];
    case Kind::integer_array: return state.ram.integer_array[at(operand.index)];
    case Kind::real_array: return state.ram.real_array[at(operand.index)];
    case Kind::analog: return setup.input(0, kAnalog);
    case Kind::clock: return static_cast<double>(clock_s(state, setup));
    case Kind::quantity: return 0;
    case Kind::integer:
    case Kind::real:
    case Kind::port:
    case Kind::label:
    case Kind::text:
    case Kind::get_integer:
    case Kind::get_real:
    case Kind::event:
    case Kind::condition: return operand.number;
  }
  return operand.number;
}

Error set_variable(State& state, const Setup& setup, const lang::Operand& variable, double value) {
  using Kind = lang::Operand::Kind;
  if (variable.kind == Kind::clock) return set_parameter(state, setup, 0, "TM", value);
  if (!std::isfinite(value)) return Error::range;
  if (holds_integer(variable.kind)) {
    if (value < lang::integer_min(setup.language) || value > lang::kIntegerMax) return Error::range;
    if (value != std::trunc(value)) return Error::range;
  } else if (std::abs(value) > kMaxReal) {
    return Error::range;
  }
  if (!is_variable(variable.kind)) return Error::syntax;
  const auto whole = static_cast<std::int16_t>(holds_integer(variable.kind) ? value : 0);
  const auto real = static_cast<float>(value);
  const std::size_t place = at(variable.index);
  const auto store = [&](Memory& memory) {
    if (is_array(variable.kind)) {
      if (holds_integer(variable.kind)) memory.integer_array[place] = whole;
      if (!holds_integer(variable.kind)) memory.real_array[place] = real;
    } else {
      if (holds_integer(variable.kind)) memory.integers[place] = whole;
      if (!holds_integer(variable.kind)) memory.reals[place] = real;
    }
  };
  store(state.ram);
  const bool is_kept = is_array(variable.kind) ? !setup.chose(option("arrays_kept", "by_save_d"))
                                               : setup.chose(option("variables_kept", "when_written"));
  if (!is_kept) return Error::none;
  store(state.kept);
  ++state.memory_revision;
  return Error::none;
}

}  // namespace understudy::emulator::models::slim
