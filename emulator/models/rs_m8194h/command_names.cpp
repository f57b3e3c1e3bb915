#include "emulator/models/rs_m8194h/command_names.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/choices.h"
#include "emulator/device/command_window.h"
#include "emulator/device/model.h"
#include "emulator/device/program_error.h"
#include "emulator/models/rs_m8194h/programs/language.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "interpreter/rs_m8194h/check.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/text.h"
#include "interpreter/rs_m8194h/window.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

namespace lang = interpreter::rs_m8194h;

lang::WordOrder order_of(const WindowForm& form) {
  constexpr Option kTablesAlone = option("word_order_scope", "tables");
  const bool follows_order = form.choices.empty() || form.choices[kTablesAlone.choice] != kTablesAlone.number;
  return form.low_word_first && follows_order ? lang::WordOrder::low_first : lang::WordOrder::high_first;
}

/// The options that determine how a command is written. Whether the device accepts the command is checked
/// elsewhere.
lang::Options options_of(const WindowForm& form) {
  return form.choices.empty() ? lang::Options{} : options_of_language(AskedOptions{.numbers = form.choices});
}

class CommandNames final : public CommandWindow {
 public:
  std::string_view register_name() const override { return "Sub_Function_Code"; }
  std::string_view area() const override { return "RTC"; }
  std::string_view example() const override { return "RSM_FIXED_MOVE XYZU 10000"; }

  std::vector<std::uint16_t> words_of(std::string_view text, const WindowForm& form) const override {
    const lang::ParsedCommand parsed = lang::parse_command(text, lang::kAnyChoice);
    if (!parsed.command) throw ProgramError(mistakes_of({*parsed.error}));
    return lang::encode(*parsed.command, order_of(form), options_of(form));
  }

  std::optional<std::string> text_of(std::span<const std::uint16_t> words,
                                     const WindowForm& form) const override {
    lang::Command command;
    if (lang::read_registers(words, order_of(form), command, options_of(form)) != lang::Fault::none)
      return std::nullopt;
    if (lang::bad_parameter(command, lang::kAnyChoice) || lang::bad_operand(command)) return std::nullopt;
    return lang::text_of(command);
  }
};

}  // namespace

const CommandWindow& command_names() {
  static const CommandNames names;
  return names;
}

}  // namespace understudy::emulator::models::rs_m8194h
