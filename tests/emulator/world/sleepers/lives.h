// All classes derived from Life, one for each controller.
#pragma once

#include <memory>

#include "tests/emulator/world/sleepers/life.h"

namespace understudy::emulator::world::sleepers {

std::unique_ptr<Life> life_of_simple2();
std::unique_ptr<Life> life_of_super_40nc();
std::unique_ptr<Life> life_of_rs_m8194h();
std::unique_ptr<Life> life_of_slim();
/// For a controller that a file describes; each course has a different one.
std::unique_ptr<Life> life_of_imported();

}  // namespace understudy::emulator::world::sleepers
