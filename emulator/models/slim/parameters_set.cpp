#include "emulator/models/slim/parameters_set.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/models/slim/chain/chain.h"
#include "emulator/models/slim/chain/chain_state.h"
#include "emulator/models/slim/chain/settings.h"
#include "emulator/models/slim/memory.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/numbers.h"
#include "emulator/models/slim/parameters.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"

namespace understudy::emulator::models::slim {

namespace {

/// The parameter numbers that define the user unit: `pulses` pulses equal `units` user units.
struct UserUnit {
  std::size_t pulses = parameter("PN45");
  std::size_t units = parameter("PN46");

  bool includes(std::size_t number) const { return number == pulses || number == units; }
};

UserUnit user_unit(const Setup& setup) {
  if (setup.chose(option("user_unit", "pn44_pulses_are_pn45_units"))) {
    return {parameter("PN44"), parameter("PN45")};
  }
  return setup.chose(option("user_unit", "pn46_pulses_are_pn45_units"))
             ? UserUnit{parameter("PN46"), parameter("PN45")}
             : UserUnit{};
}

/// Two of PN44, PN45 and PN46 are the pulses and the units; the third one is only stored.
Error set_scale(State& state, const Setup& setup, int module, std::size_t number, double value) {
  const UserUnit unit = user_unit(setup);
  if (!unit.includes(number)) return Error::none;
  const Parameters& all = state.ram.parameters[at(module)];
  const auto of = [&](std::size_t one) {
    return static_cast<std::int64_t>(one == number ? value : all[one]);
  };
  return state.chain.settings().set_scale(module, of(unit.pulses), of(unit.units));
}

/// Applies a parameter to the chain before it is stored.
Error apply_parameter(State& state, const Setup& setup, int module, std::size_t number, double value) {
  ChainSettings chain = state.chain.settings();
  switch (number) {
    case parameter("VM"): return chain.set_working_speed(module, value);
    case parameter("VJ"): return chain.set_jog_speed(module, value);
    case parameter("FU"): return chain.set_speed_unit(module, value == 0 ? SpeedUnit::rpm : SpeedUnit::rps);
    case parameter("VA"): return chain.set_acceleration(module, value);
    case parameter("PN44"):
    case parameter("PN45"):
    case parameter("PN46"): return set_scale(state, setup, module, number, value);
    case parameter("PR2"): return chain.set_path_acceleration(module, value);
    case parameter("PR3"): return chain.set_path_speed(module, value);
    case parameter("PR4"): return chain.set_line_speed(module, value);
    case parameter("PR7"): return chain.set_smooth_corner(module, value);
    case parameter("PN50"):
      for (int m = 1; m < kModules; ++m) chain.set_linked(m, ((static_cast<int>(value) >> m) & 1) != 0);
      return Error::none;
    default: return Error::none;
  }
}

}  // namespace

Error linked(const State& state, int module) {
  return state.chain.linked(module) ? Error::none : Error::not_linked;
}

Error set_parameter(State& state, const Setup& setup, int module, std::string_view given_name, double value) {
  const std::string_view name = setup.canonical(given_name);
  if (const Error error = linked(state, module); error != Error::none) return error;
  const SpeedNames names = setup.memory_form().speed_names;
  if (const Error error = check_parameter(module, name, value, names, setup.takes_letters_away());
      error != Error::none) {
    return error;
  }
  if (name == "TM") {
    state.clock_zero = setup.now() - std::llround(value * 1000);
    return Error::none;
  }
  const auto number = find_parameter(name, names);
  const ParameterDefinition& row = kParameters[*number];
  const auto fits = fitted(row, value);
  if (name == "TVM" && module == 0) {  // for all linked modules, immediately
    if (const Error error = state.chain.settings().set_tvm(*fits); error != Error::none) return error;
    for (int m = 0; m < kModules; ++m) {
      if (state.chain.linked(m)) state.ram.parameters[at(m)][*number] = *fits;
    }
    return Error::none;
  }
  if (!row.not_implemented.empty() && !user_unit(setup).includes(*number))
    setup.device.warn_not_implemented(row.name, row.not_implemented);
  const Error error = apply_parameter(state, setup, module, *number, *fits);
  if (error == Error::none) state.ram.parameters[at(module)][*number] = *fits;
  if (error == Error::none && *number == parameter("PN50")) {
    state.ram.parameters[0][*number] = static_cast<double>(static_cast<int>(*fits) | 1);
  }
  return error;
}

void apply_all_parameters(State& state, const Setup& setup) {
  apply_parameter(state, setup, 0, parameter("PN50"), state.ram.parameters[0][parameter("PN50")]);
  for (int m = 0; m < kModules; ++m) {
    for (std::size_t i = 0; i < kParameterCount; ++i) {
      if (!kParameters[i].host_only) apply_parameter(state, setup, m, i, state.ram.parameters[at(m)][i]);
    }
  }
}

Error assign_axis(State& state, const Setup& setup, Letter letter, int module) {
  for (const Letter other : {Letter::x, Letter::y, Letter::z, Letter::w}) {
    const bool has_it = module != kUnassigned && state.chain.assigned(other) == module;
    if (has_it && setup.takes_letters_away()) state.chain.assign(other, kUnassigned);
  }
  return state.chain.assign(letter, module);
}

void keep_axis_map(State& state) {
  int map = 0;
  for (int letter = 0; letter < kLetters; ++letter) {
    map |= state.chain.assigned(static_cast<Letter>(letter)) << (4 * letter);
  }
  state.ram.parameters[0][parameter("PN37")] = map;
}

Error restore_factory_parameters(State& state, const Setup& setup) {
  for (int m = 0; m < kModules; ++m) {
    if (state.chain.busy(m)) return Error::not_allowed;
  }
  state.ram.parameters = setup.factory().parameters;
  apply_all_parameters(state, setup);
  if (setup.chose(option("defaults_kept", "at_once"))) keep_parameters(state);
  return Error::none;
}

void keep_parameters(State& state) {
  state.kept.parameters = state.ram.parameters;
  ++state.memory_revision;
}

void keep_data(State& state) {
  const auto parameters = state.kept.parameters;
  state.kept = state.ram;
  state.kept.parameters = parameters;
  ++state.memory_revision;
}

void keep_program(State& state) {
  state.kept_program = state.program.texts();
  ++state.memory_revision;
}

std::vector<std::string> parameter_list(const State& state, const Setup& setup) {
  std::vector<std::string> lines;
  for (int m = 0; m < kModules; ++m) {
    if (!state.chain.linked(m)) continue;
    for (std::size_t place = 0; place < kParameterCount; ++place) {
      const std::size_t i = listed_at(place, setup.memory_form().speed_names);
      const ParameterDefinition& row = kParameters[i];
      if (m > 0 && row.host_only) continue;
      if (row.name != setup.canonical(row.name)) continue;
      const double value = state.ram.parameters[at(m)][i];
      lines.push_back(parameter_name(m, i, setup.memory_form().speed_names) + "=" +
                      (row.type == ParameterDefinition::Type::integer
                           ? text_of_integer(value)
                           : text_of_real(value, setup.real_form())));
    }
  }
  return lines;
}

}  // namespace understudy::emulator::models::slim
