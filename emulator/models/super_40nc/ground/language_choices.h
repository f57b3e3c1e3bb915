// The options of the languages, as the choices of a device set them.
#pragma once

#include "interpreter/super_40nc/options.h"

namespace understudy::emulator {
class Device;
}

namespace understudy::emulator::models::super_40nc {

interpreter::super_40nc::Options chosen_options(const Device& device);

}  // namespace understudy::emulator::models::super_40nc
