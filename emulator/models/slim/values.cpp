// SLIM's variables, parameters and what is kept of them.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "emulator/device/device.h"
#include "emulator/models/slim/chain/chain.h"
#include "emulator/models/slim/chain/chain_state.h"
#include "emulator/models/slim/device.h"
#include "emulator/models/slim/memory.h"
#include "emulator/models/slim/motor/jobs.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/numbers.h"
#include "emulator/models/slim/parameters.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"

namespace understudy::emulator::models::slim {

double Slim::value(const lang::Operand& operand) const {
  using Kind = lang::Operand::Kind;
  switch (operand.kind) {
    case Kind::integer_variable: return state_.ram.integers[at(operand.index)];
    case Kind::real_variable: return state_.ram.reals[at(operand.index)];
    case Kind::integer_array: return state_.ram.integer_array[at(operand.index)];
    case Kind::real_array: return state_.ram.real_array[at(operand.index)];
    case Kind::analog: return Device::input(terminal(0, kAnalog));
    case Kind::clock: return static_cast<double>(clock_s());
    case Kind::quantity: return value_named(operand.text).value_or(0);
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

double Slim::amount(const lang::Command& command, std::size_t operand) const {
  return value(command.operands[operand]);
}

std::string Slim::text_of(const lang::Operand& variable) const {
  return holds_integer(variable.kind) || variable.kind == lang::Operand::Kind::integer
             ? text_of_integer(value(variable))
             : text_of_real(value(variable), real_form());
}

Error Slim::set_variable(const lang::Operand& variable, double value) {
  using Kind = lang::Operand::Kind;
  if (variable.kind == Kind::clock) return set_parameter(0, "TM", value);
  if (!std::isfinite(value)) return Error::range;
  if (holds_integer(variable.kind)) {
    if (value < of_programs().dialect.integer_least || value > lang::kIntegerMost) return Error::range;
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
  store(state_.ram);
  const bool is_kept = is_array(variable.kind) ? !chose(option("arrays_kept", "by_save_d"))
                                               : chose(option("variables_kept", "when_written"));
  if (!is_kept) return Error::none;
  store(state_.kept);
  ++state_.kept_revision;
  return Error::none;
}

Error Slim::set_parameter(int module, std::string_view given_name, double value) {
  const std::string_view name = meant(given_name);
  if (const Error error = linked(module); error != Error::none) return error;
  const SpeedNames names = memory_form().speed_names;
  if (const Error error = check_parameter(module, name, value, names, takes_letters_away());
      error != Error::none) {
    return error;
  }
  if (name == "TM") {
    state_.clock_zero = now() - std::llround(value * 1000);
    return Error::none;
  }
  const auto number = find_parameter(name, names);
  const ParameterDefinition& row = kParameters[*number];
  const auto fits = fitted(row, value);
  if (name == "TVM" && module == 0) {  // of all linked modules at once
    if (const Error error = state_.chain.settings().set_tvm(*fits); error != Error::none) return error;
    for (int m = 0; m < kModules; ++m) {
      if (state_.chain.linked(m)) state_.ram.parameters[at(m)][*number] = *fits;
    }
    return Error::none;
  }
  if (!row.not_implemented.empty() && !is_of_user_unit(*number))
    warn_not_implemented(row.name, row.not_implemented);
  const Error error = apply_parameter(module, *number, *fits);
  if (error == Error::none) state_.ram.parameters[at(module)][*number] = *fits;
  if (error == Error::none && *number == parameter("PN50")) {
    state_.ram.parameters[0][*number] = static_cast<double>(static_cast<int>(*fits) | 1);
  }
  return error;
}

/// Two of PN44, PN45 and PN46 are pulses and units; the third one is stored only.
Error Slim::set_scale(int module, std::size_t number, double value) {
  const UserUnit unit = user_unit();
  if (number != unit.pulses && number != unit.units) return Error::none;
  const Parameters& all = state_.ram.parameters[at(module)];
  const auto of = [&](std::size_t one) {
    return static_cast<std::int64_t>(one == number ? value : all[one]);
  };
  return state_.chain.settings().set_scale(module, of(unit.pulses), of(unit.units));
}

/// What a parameter means to the chain, before it is stored.
Error Slim::apply_parameter(int module, std::size_t number, double value) {
  Chain& chain = state_.chain;
  switch (number) {
    case parameter("VM"): return chain.settings().set_working_speed(module, value);
    case parameter("VJ"): return chain.settings().set_jog_speed(module, value);
    case parameter("FU"):
      return chain.settings().set_speed_unit(module, value == 0 ? SpeedUnit::rpm : SpeedUnit::rps);
    case parameter("VA"): return chain.settings().set_acceleration(module, value);
    case parameter("PN44"):
    case parameter("PN45"):
    case parameter("PN46"): return set_scale(module, number, value);
    case parameter("PR2"): return chain.settings().set_path_acceleration(module, value);
    case parameter("PR3"): return chain.settings().set_path_speed(module, value);
    case parameter("PR4"): return chain.settings().set_line_speed(module, value);
    case parameter("PR7"): return chain.settings().set_smooth_corner(module, value);
    case parameter("PN50"):
      for (int m = 1; m < kModules; ++m)
        chain.settings().set_linked(m, ((static_cast<int>(value) >> m) & 1) != 0);
      return Error::none;
    default: return Error::none;
  }
}

/// A chain that has just been made learns what its modules' parameters are.
void Slim::apply_all_parameters() {
  apply_parameter(0, parameter("PN50"), state_.ram.parameters[0][parameter("PN50")]);
  for (int m = 0; m < kModules; ++m) {
    for (std::size_t i = 0; i < kParameterCount; ++i) {
      if (!kParameters[i].host_only) apply_parameter(m, i, state_.ram.parameters[at(m)][i]);
    }
  }
}

/// TX= ..., and what PN37 says at power-up.
Error Slim::assign_axis(Letter letter, int module) {
  for (const Letter other : {Letter::x, Letter::y, Letter::z, Letter::w}) {
    const bool has_it = module != kUnassigned && state_.chain.assigned(other) == module;
    if (has_it && takes_letters_away()) state_.chain.assign(other, kUnassigned);
  }
  return state_.chain.assign(letter, module);
}

/// PN37 becomes the map that is in force.
void Slim::keep_axis_map() {
  int map = 0;
  for (int letter = 0; letter < kLetters; ++letter) {
    map |= state_.chain.assigned(static_cast<Letter>(letter)) << (4 * letter);
  }
  state_.ram.parameters[0][parameter("PN37")] = map;
}

/// DF. While anything has something to do it would change units under way.
Error Slim::restore_factory_parameters() {
  for (int m = 0; m < kModules; ++m) {
    if (state_.chain.busy(m)) return Error::not_allowed;
  }
  state_.ram.parameters = factory().parameters;
  apply_all_parameters();
  if (chose(option("defaults_kept", "at_once"))) keep_parameters();
  return Error::none;
}

void Slim::keep_parameters() {
  state_.kept.parameters = state_.ram.parameters;
  ++state_.kept_revision;
}

void Slim::keep_data() {
  const auto parameters = state_.kept.parameters;
  state_.kept = state_.ram;
  state_.kept.parameters = parameters;
  ++state_.kept_revision;
}

void Slim::keep_program() {
  state_.kept_program = state_.program.texts();
  ++state_.kept_revision;
}

/// ULC.
std::vector<std::string> Slim::parameter_list() const {
  std::vector<std::string> lines;
  for (int m = 0; m < kModules; ++m) {
    if (!state_.chain.linked(m)) continue;
    for (std::size_t place = 0; place < kParameterCount; ++place) {
      const std::size_t i = listed_at(place, memory_form().speed_names);
      const ParameterDefinition& row = kParameters[i];
      if (m > 0 && row.host_only) continue;
      if (row.name != meant(row.name)) continue;
      const double value = state_.ram.parameters[at(m)][i];
      lines.push_back(parameter_name(m, i, memory_form().speed_names) + "=" +
                      (row.type == ParameterDefinition::Type::integer ? text_of_integer(value)
                                                                      : text_of_real(value, real_form())));
    }
  }
  return lines;
}

}  // namespace understudy::emulator::models::slim
