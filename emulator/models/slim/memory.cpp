#include "emulator/models/slim/memory.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "base/text/one_line.h"
#include "emulator/device/memory/nv_entry_error.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/numbers.h"
#include "emulator/models/slim/parameters.h"
#include "interpreter/slim/command_row.h"

namespace understudy::emulator::models::slim {

namespace {

using interpreter::slim::kIntegerMax;

bool is_integer(const ParameterDefinition& row) { return row.type == ParameterDefinition::Type::integer; }

/// Calls `visit(name, value, definition)` for all named values, in the order of the lists. The definition is
/// null for variables.
void for_each_name(auto& memory, SpeedNames names, auto visit) {
  for (int m = 0; m < kModules; ++m) {
    for (std::size_t place = 0; place < kParameterCount; ++place) {
      const std::size_t i = listed_at(place, names);
      if (m > 0 && kParameters[i].host_only) continue;
      visit(parameter_name(m, i, names), memory.parameters[static_cast<std::size_t>(m)][i], &kParameters[i]);
    }
  }
  const ParameterDefinition* const none = nullptr;
  for (std::size_t i = 0; i < memory.integers.size(); ++i)
    visit("N" + std::to_string(i), memory.integers[i], none);
  for (std::size_t i = 0; i < memory.reals.size(); ++i) visit("R" + std::to_string(i), memory.reals[i], none);
  for (std::size_t i = 0; i < memory.integer_array.size(); ++i) {
    visit("NS(" + std::to_string(i) + ")", memory.integer_array[i], none);
  }
  for (std::size_t i = 0; i < memory.real_array.size(); ++i) {
    visit("RS(" + std::to_string(i) + ")", memory.real_array[i], none);
  }
}

}  // namespace

Memory factory_memory(int modules) {
  Memory memory;
  memory.parameters.fill(factory_parameters());
  memory.parameters[0][parameter("PN50")] = (1 << modules) - 1;
  return memory;
}

std::string parameter_name(int module, std::size_t number, SpeedNames names) {
  return (module == 0 ? "" : "T" + std::to_string(module)) + std::string(name_of(number, names));
}

void write_image(const Memory& memory, const Memory& factory, const MemoryForm& form, NvImage& image) {
  const SpeedNames names = form.speed_names;
  std::vector<double> before;
  for_each_name(factory, names, [&](const std::string&, const auto& value, const ParameterDefinition*) {
    before.push_back(value);
  });
  std::size_t next = 0;
  for_each_name(memory, names,
                [&](const std::string& name, const auto& value, const ParameterDefinition* row) {
                  if (value == before[next++]) return;
                  if (std::is_same_v<std::decay_t<decltype(value)>, std::int16_t> ||
                      (row != nullptr && is_integer(*row))) {
                    image.registers.emplace_back(name, static_cast<std::int64_t>(value));
                  } else {
                    image.reals.emplace_back(name, value);
                  }
                });
}

Memory read_image(const NvImage& image, const Memory& factory, const MemoryForm& form) {
  std::map<std::string, double> integers;
  std::map<std::string, double> reals;
  for (const auto& [name, value] : image.registers) integers.emplace(name, static_cast<double>(value));
  for (const auto& [name, value] : image.reals) reals.emplace(name, value);
  Memory memory = factory;
  const auto take = [](std::map<std::string, double>& from, const std::string& name) {
    const auto node = from.extract(name);
    return node.empty() ? std::nullopt : std::optional(node.mapped());
  };
  const auto does_not_fit = [](NvEntryError::List where, const std::string& name, double value, double lowest,
                               double highest) {
    return refused_value(where, name,
                         quoted(name) + ": " + text_of_real(value, RealForm::exponent) +
                             " does not fit; expected " + text_of_real(lowest, RealForm::exponent) + " to " +
                             text_of_real(highest, RealForm::exponent));
  };
  for_each_name(memory, form.speed_names,
                [&](const std::string& name, auto& value, const ParameterDefinition* row) {
                  using T = std::decay_t<decltype(value)>;
                  const bool whole = std::is_same_v<T, std::int16_t> || (row != nullptr && is_integer(*row));
                  const auto given = take(whole ? integers : reals, name);
                  if (!given) return;
                  const auto where = whole ? NvEntryError::List::registers : NvEntryError::List::reals;
                  if (row != nullptr) {
                    const auto fits = fitted(*row, *given);
                    if (!fits) throw does_not_fit(where, name, *given, row->lowest, row->highest);
                    value = static_cast<T>(*fits);
                  } else if (std::is_same_v<T, std::int16_t>) {
                    if (*given < form.integer_min || *given > kIntegerMax) {
                      throw does_not_fit(where, name, *given, form.integer_min, kIntegerMax);
                    }
                    value = static_cast<T>(*given);
                  } else {
                    if (std::abs(*given) > kMaxReal)
                      throw does_not_fit(where, name, *given, -kMaxReal, kMaxReal);
                    value = static_cast<T>(*given);
                  }
                });
  if (!integers.empty()) {
    const std::string& name = integers.begin()->first;
    throw refused_value(NvEntryError::List::registers, name,
                        "there is no " + quoted(name) + "; expected a parameter or variable");
  }
  if (!reals.empty()) {
    const std::string& name = reals.begin()->first;
    throw refused_value(NvEntryError::List::reals, name,
                        "there is no " + quoted(name) + "; expected a parameter or variable");
  }
  return memory;
}

}  // namespace understudy::emulator::models::slim
