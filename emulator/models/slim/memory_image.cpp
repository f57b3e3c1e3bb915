#include "emulator/models/slim/memory_image.h"

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "emulator/device/memory/nv_image.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/models/slim/error_log.h"
#include "emulator/models/slim/memory.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"
#include "interpreter/slim/options.h"
#include "interpreter/slim/program.h"

namespace understudy::emulator::models::slim {

std::function<void(NvImage&)> image_writer(const State& state, const Setup& setup) {
  return [kept = state.kept, factory = setup.factory(), form = setup.memory_form(),
          errors = setup.history_is_kept() ? std::optional(state.errors) : std::nullopt,
          program = state.kept_program](NvImage& image) {
    write_image(kept, factory, form, image);
    if (errors) write_history(*errors, image);
    image.program = program;
  };
}

void read_image(State& state, const Setup& setup, const NvImage& given) {
  NvImage image = given;
  const std::array<Errors, kModules> errors = read_history(setup, image);
  Memory memory = read_image(image, setup.factory(), setup.memory_form());
  const auto capacity = static_cast<std::size_t>(setup.language.number(lang::numbers("program_size")));
  if (image.program.size() > capacity) {
    throw NvError("program: has " + std::to_string(image.program.size()) + " lines; expected at most " +
                  std::to_string(capacity));
  }
  lang::Program program;
  if (!program.set_texts(image.program, setup.language)) {
    throw NvError(
        "program: contains a line that is not a program command; expected lines in the form that ULP prints");
  }
  state.kept = std::move(memory);
  if (setup.history_is_kept()) state.errors = errors;
  state.kept_program = image.program;
  ++state.memory_revision;
}

}  // namespace understudy::emulator::models::slim
