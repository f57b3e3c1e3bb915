#include "emulator/models/rs_m8194h/command_names.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/command_window.h"
#include "emulator/device/program_error.h"
#include "emulator/models/rs_m8194h/language.h"
#include "interpreter/rs_m8194h/check.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/text.h"
#include "interpreter/rs_m8194h/window.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

namespace lang = interpreter::rs_m8194h;

/// Corners of a rectangle are a choice of the device.
constexpr lang::CommandOptions kAnyChoice{.rectangle_corners_must_fit = false};

lang::WordOrder order_of(const WindowForm& form) {
  return form.low_word_first ? lang::WordOrder::low_first : lang::WordOrder::high_first;
}

class CommandNames final : public CommandWindow {
 public:
  std::string_view register_name() const override { return "Sub_Function_Code"; }
  std::string_view example() const override { return "RSM_FIXED_MOVE XYZU 10000"; }

  std::vector<std::uint16_t> words_of(std::string_view text, const WindowForm& form) const override {
    const lang::ParsedCommand parsed = lang::parse_command(text, kAnyChoice);
    if (!parsed.command) throw ProgramError(mistakes_of({*parsed.error}));
    return lang::encode(*parsed.command, order_of(form));
  }

  std::optional<std::string> text_of(std::span<const std::uint16_t> words,
                                     const WindowForm& form) const override {
    lang::Command command;
    if (lang::read_registers(words, order_of(form), command) != lang::Fault::none) return std::nullopt;
    if (lang::bad_parameter(command, kAnyChoice) || lang::bad_operand(command)) return std::nullopt;
    return lang::text_of(command);
  }
};

}  // namespace

const CommandWindow& command_names() {
  static const CommandNames names;
  return names;
}

}  // namespace understudy::emulator::models::rs_m8194h
