// What a SLIM needs in addition to its state: its device, which provides time, inputs and a log, and the
// options that the bench selected. All parts of the controller are functions on a State and a Setup:
//
//   setup.h             choices, terminals, time
//   error_log.h         ?ERR and ?ERC
//   output.h            sending text, and reporting failures
//   parameters_set.h    parameters and axis letters; saving them
//   variables.h         N#, R#, NS(), RS() and the clock
//   power.h             power-up, power-down, inputs
//   memory_image.h      the persistent memory as a file
//   program_text.h      loaded programs
//   queries.h           the answers to queries
//   actions.h           the effects of commands (commands.cpp)
//   by_name.h           queries and assignments that bypass the line
//   dialogue.h          the handling of a line
//
// Each part may use the parts above it. device.h combines them into a device.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/simulated_time.h"
#include "emulator/device/device.h"
#include "emulator/models/slim/memory.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/numbers.h"
#include "emulator/models/slim/parameters.h"
#include "emulator/models/slim/rules/chain_options.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/options.h"

namespace understudy::emulator::models::slim {

namespace lang = interpreter::slim;

// The terminals of a module. Those of T0 come first, followed by those of T1, and so on.
inline constexpr int kInputs = lang::kInputCount;
inline constexpr int kHorg = kInputs;
inline constexpr int kAnalog = kHorg + 1;
inline constexpr int kFirstSwitch = kAnalog + 1;
inline constexpr int kFirstOutput = kFirstSwitch + lang::kSwitchCount;
inline constexpr int kTerminalsOfModule = kFirstOutput + kOutputs;
constexpr int terminal(int module, int which) { return module * kTerminalsOfModule + which; }

struct Setup {
  explicit Setup(const Device& of);

  const Device& device;
  const int modules;  // how many modules are linked in the factory settings
  const ChainOptions options;
  const lang::Options language;

  bool chose(const Option& option) const { return options.chose(option); }
  int number(std::size_t row) const { return options.number(row); }
  Tick now() const { return device.now(); }
  std::int32_t input(int module, int which) const { return device.input(terminal(module, which)); }
  bool level(int module, int which) const { return input(module, which) != 0; }
  /// Returns the present levels of a module's inputs; bit 0 is input 1.
  std::uint8_t input_levels(int module) const {
    unsigned levels = 0;
    for (int i = 0; i < kInputs; ++i) levels |= (level(module, i) ? 1U : 0U) << i;
    return static_cast<std::uint8_t>(levels);
  }

  // ---- Choices that several parts look up

  std::string_view line_end() const { return chose(option("output_end", "cr")) ? "\r" : "\r\n"; }
  RealForm real_form() const {
    return chose(option("real_format", "exponent_of_the_large_and_small")) ? RealForm::exponent
                                                                           : RealForm::plain;
  }
  bool is_silence(Error error) const {
    return error == Error::not_linked && chose(option("unlinked_module", "silence"));
  }
  /// Returns the number that is shown for an error.
  int code_of(Error error) const {
    return error != Error::none && chose(option("error_codes", "1_for_all")) ? 1 : static_cast<int>(error);
  }
  bool errors_are_of_t0() const { return chose(option("error_of", "t0")); }
  std::size_t history_length() const { return static_cast<std::size_t>(number(numbers("history_length"))); }
  bool history_is_kept() const { return chose(option("history_kept", "for_ever")); }
  bool has_input_mask() const { return !chose(option("input_mask", "error_1")); }
  /// Returns true if a module that has an axis letter loses it when it receives a new one.
  bool takes_letters_away() const { return takes_letters_away(options); }
  static bool takes_letters_away(const ChainOptions& options) {
    return options.chose(option("axis_values", "is_taken_from_its_letter"));
  }
  /// Returns the canonical name of the parameter: PR4 is another name for PR3, unless it is a separate speed.
  std::string_view canonical(std::string_view parameter) const {
    return parameter == "PR4" && !options.lines_have_own_speed() ? "PR3" : parameter;
  }
  MemoryForm memory_form() const;
  Memory factory() const;
};

}  // namespace understudy::emulator::models::slim
