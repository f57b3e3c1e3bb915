// The language of SUPER-40NC's programs, as its model offers it.
#pragma once

#include "emulator/device/program_language.h"

namespace understudy::emulator::models::super_40nc {

const ProgramLanguage& program_language();

}  // namespace understudy::emulator::models::super_40nc
