// The numbers in a SLIM: parameters of its modules, variables, arrays. There is a copy in RAM and a
// persistent copy.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "emulator/device/memory/nv_image.h"
#include "emulator/models/slim/motor/module.h"
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

/// Returns the memory of a new device, whose first `modules` modules are linked.
Memory factory_memory(int modules);

/// The naming and the ranges that the bench has selected.
struct MemoryForm {
  SpeedNames speed_names = SpeedNames::pn10_is_vm;
  int integer_min = interpreter::slim::kIntegerMin;
};

/// Returns the name of a parameter row, "T1PR3". As in commands, the parameters of the whole chain have no
/// prefix.
std::string parameter_name(int module, std::size_t number, SpeedNames names);

/// write_image() writes the values that differ from `factory`, by name. read_image() reads them into a memory
/// whose other values are those of `factory`. It throws NvError for unknown names and impossible values.
void write_image(const Memory& memory, const Memory& factory, const MemoryForm& form, NvImage& image);
Memory read_image(const NvImage& image, const Memory& factory, const MemoryForm& form);

}  // namespace understudy::emulator::models::slim
