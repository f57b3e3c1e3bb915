// Names of things in a world: "feeder.Cord_A", "feeder.STATUS.4", "feeder.DIN_10"; the device may be left
// out where there is only one.
#pragma once

#include <stdexcept>
#include <string_view>

#include "emulator/register_map/register_map.h"
#include "emulator/world/world.h"

namespace understudy::emulator {

/// One line: which name is not known, and the nearest that is.
struct NameError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct RegisterName {
  std::size_t device = 0;
  NamedPlace place;
};
RegisterName find_register(const World& world, std::string_view name);

struct InputName {
  std::size_t device = 0;
  int terminal = 0;
};
InputName find_input(const World& world, std::string_view name);

}  // namespace understudy::emulator
