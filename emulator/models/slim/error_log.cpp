#include "emulator/models/slim/error_log.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "emulator/device/memory/nv_entry_error.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/models/slim/chain/chain.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"
#include "emulator/models/slim/transition_tables.h"

namespace understudy::emulator::models::slim {

void note_error(State& state, const Setup& setup, int module, Error error) {
  Errors& errors = state.errors[static_cast<std::size_t>(module)];
  errors.present = error;
  if (error != Error::none)
    state.chain.options().noted.meet(kErrorTable, static_cast<std::size_t>(error) - 1, 0);
  if (setup.history_is_kept()) ++state.memory_revision;
  errors.history.insert(errors.history.begin(), static_cast<std::uint8_t>(error));
  if (errors.history.size() > setup.history_length()) errors.history.pop_back();
}

/// T0 reads the lines, so errors in a line belong to T0, whatever module the line contains. Motor errors
/// belong to the motor's module. If that module is not linked, nobody could query it, so the error belongs to
/// T0.
int remember_error(State& state, const Setup& setup, int module, Error error) {
  const bool is_of_line = error == Error::syntax || error == Error::range || error == Error::address;
  if (is_of_line || !state.chain.linked(module) || setup.errors_are_of_t0()) module = 0;
  note_error(state, setup, module, error);
  return module;
}

void remember_late_errors(State& state, const Setup& setup) {
  for (int m = 0; m < kModules; ++m) {
    const Error late = state.chain.take_late_error(m);
    if (late != Error::none) note_error(state, setup, setup.errors_are_of_t0() ? 0 : m, late);
  }
}

std::string history_text(const Setup& setup, const Errors& errors) {
  std::string text;
  for (const std::uint8_t error : errors.history) {
    if (!text.empty()) text += ',';
    text += std::to_string(setup.code_of(static_cast<Error>(error)));
  }
  return text.empty() ? "0" : text;
}

namespace {

std::string history_name(int module, std::size_t number) {
  return (module == 0 ? "" : "T" + std::to_string(module)) + "ERC(" + std::to_string(number) + ")";
}

}  // namespace

void write_history(const std::array<Errors, kModules>& errors, NvImage& image) {
  for (int m = 0; m < kModules; ++m) {
    const auto& history = errors[static_cast<std::size_t>(m)].history;
    for (std::size_t i = 0; i < history.size(); ++i) {
      image.registers.emplace_back(history_name(m, i), history[i]);
    }
  }
}

std::array<Errors, kModules> read_history(const Setup& setup, NvImage& image) {
  std::array<Errors, kModules> errors{};
  if (!setup.history_is_kept()) return errors;
  for (int m = 0; m < kModules; ++m) {
    for (std::size_t i = 0; i < setup.history_length(); ++i) {
      const auto found = std::ranges::find(image.registers, history_name(m, i),
                                           [](const auto& entry) { return std::string_view(entry.first); });
      if (found == image.registers.end()) break;
      constexpr auto kMax = static_cast<std::int64_t>(Error::address);
      if (found->second < 1 || found->second > kMax) {
        throw refused_value(NvEntryError::List::registers, history_name(m, i),
                            history_name(m, i) + ": " + std::to_string(found->second) +
                                " is not an error number; expected 1 to " + std::to_string(kMax));
      }
      errors[static_cast<std::size_t>(m)].history.push_back(static_cast<std::uint8_t>(found->second));
      image.registers.erase(found);
    }
  }
  return errors;
}

}  // namespace understudy::emulator::models::slim
