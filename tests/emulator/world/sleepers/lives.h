// All lives, one for each controller.
#pragma once

#include <memory>

#include "tests/emulator/world/sleepers/life.h"

namespace understudy::emulator::world::sleepers {

std::unique_ptr<Life> life_of_simple2();
std::unique_ptr<Life> life_of_super_40nc();
std::unique_ptr<Life> life_of_rs_m8194h();
std::unique_ptr<Life> life_of_slim();
/// A controller that a file describes; a different one for each course.
std::unique_ptr<Life> life_of_imported();

}  // namespace understudy::emulator::world::sleepers
