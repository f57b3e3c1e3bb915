#include "emulator/device/command_window.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/program_error.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"

namespace understudy::emulator {

namespace {

const CommandWindow& require_window(const Model& model) {
  if (model.window != nullptr) return *model.window;
  throw ProgramError(0, 0, std::string(model.name) + " has no named commands; expected registers to write");
}

}  // namespace

WindowMessage window_message(const Model& model, std::string_view text, const WindowForm& form) {
  const CommandWindow& window = require_window(model);
  return {.first = find_register(model, window.register_name(), form.firmware)->place.address(),
          .words = window.words_of(text, form)};
}

WindowMessage window_message(const Device& device, std::string_view text) {
  require_window(device.model());
  return window_message(device.model(), text, window_form(device));
}

WindowForm window_form(const Device& device) {
  return {.firmware = device.firmware(),
          .low_word_first = device.register_bank()->low_word_first(),
          .choices = device.choices()};
}

std::optional<std::string> window_text(const Device& device, Table table, int first,
                                       std::span<const std::uint16_t> words) {
  const CommandWindow* const window = device.model().window;
  if (window == nullptr || table != Table::holding) return std::nullopt;
  const auto place = find_register(device.model(), window->register_name(), device.firmware());
  if (place->place.address() != first) return std::nullopt;
  return window->text_of(words, window_form(device));
}

}  // namespace understudy::emulator
