// The numbers that a SLIM holds: its modules' parameters, variables, arrays. In RAM, and as they are kept.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "emulator/device/memory/nv_image.h"
#include "emulator/models/slim/module.h"
#include "emulator/models/slim/parameters.h"
#include "interpreter/slim/commands.h"

namespace understudy::emulator::models::slim {

struct Memory {
  std::array<Parameters, kModules> parameters{};
  std::array<std::int16_t, interpreter::slim::kVariableCount> integers{};    // N#
  std::array<float, interpreter::slim::kVariableCount> reals{};              // R#
  std::array<std::int16_t, interpreter::slim::kArrayCount> integer_array{};  // NS()
  std::array<float, interpreter::slim::kArrayCount> real_array{};            // RS()

  bool operator==(const Memory&) const = default;
};

/// As it leaves the factory; the first `modules` are linked.
Memory factory_memory(int modules);

/// The names and ranges that a bench has chosen.
struct MemoryForm {
  SpeedNames speed_names = SpeedNames::pn10_is_vm;
  int integer_least = interpreter::slim::kIntegerLeast;
};

/// "T1PR3", of a row by its number; of the host without a prefix, as commands name it.
std::string parameter_name(int module, std::size_t number, SpeedNames names);

/// What differs from `factory`, by name, into an image; and back into a memory that is `factory` otherwise.
/// The latter throws NvError for unknown names and impossible values.
void write_image(const Memory& memory, const Memory& factory, const MemoryForm& form, NvImage& image);
Memory read_image(const NvImage& image, const Memory& factory, const MemoryForm& form);

}  // namespace understudy::emulator::models::slim
