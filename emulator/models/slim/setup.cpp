#include "emulator/models/slim/setup.h"

#include <algorithm>
#include <cstddef>

#include "emulator/device/device.h"
#include "emulator/models/slim/memory.h"
#include "emulator/models/slim/parameters.h"
#include "emulator/models/slim/rules/chain_options.h"
#include "emulator/models/slim/rules/choices.h"
#include "emulator/models/slim/rules/options.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/options.h"

namespace understudy::emulator::models::slim {

namespace {

/// Returns the selected option of each row, from the device.
ChainOptions options_of(const Device& device) {
  decltype(ChainOptions::numbers) numbers{};
  for (std::size_t row = 0; row < numbers.size(); ++row) numbers[row] = device.choice(row);
  return {.numbers = numbers, .noted = NotedDecisions(&device.decisions())};
}

lang::Options options_of_language(const Device& device, const ChainOptions& chosen) {
  lang::Options options(device.choices().subspan(kFirstOfLanguage),
                        device.decisions().asked(kFirstOfLanguage));
  options.check_command =
      Setup::takes_letters_away(chosen)
          ? [](const lang::Command& command) { return check_parameter_line(command, true); }
          : [](const lang::Command& command) { return check_parameter_line(command, false); };
  return options;
}

}  // namespace

Setup::Setup(const Device& of)
    : device(of),
      modules(std::max(of.settings().modules, 1)),
      options(options_of(of)),
      language(options_of_language(of, options)) {}

MemoryForm Setup::memory_form() const {
  return {.speed_names = chose(option("speed_parameters", "pn14_is_vm")) ? SpeedNames::pn14_is_vm
                                                                         : SpeedNames::pn10_is_vm,
          .integer_min = lang::integer_min(language)};
}

Memory Setup::factory() const {
  return factory_memory(chose(option("linked_from_factory", "t0_alone")) ? 1 : modules);
}

}  // namespace understudy::emulator::models::slim
