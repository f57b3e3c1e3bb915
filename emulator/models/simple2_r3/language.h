// Simple2-R3's program language: listings of instructions, which are assembled into 256 lines of four cells.
#pragma once

#include <vector>

#include "emulator/device/program_error.h"
#include "emulator/device/program_language.h"
#include "interpreter/simple2/listing.h"

namespace understudy::emulator::models::simple2_r3 {

const ProgramLanguage& language();

std::vector<ProgramMistake> mistakes_of(const interpreter::simple2::Assembly& assembly);

}  // namespace understudy::emulator::models::simple2_r3
