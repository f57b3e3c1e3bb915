// The language of SUPER-40NC's programs, for its model.
#pragma once

#include "emulator/device/program_language.h"

namespace understudy::emulator::models::super_40nc {

const ProgramLanguage& program_language();

}  // namespace understudy::emulator::models::super_40nc
