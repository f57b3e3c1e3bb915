// The language of SUPER-40NC's programs, as its model offers it.
#pragma once

#include <vector>

#include "emulator/device/program_error.h"
#include "emulator/device/program_language.h"
#include "interpreter/super_40nc/listing.h"

namespace understudy::emulator::models::super_40nc {

const ProgramLanguage& program_language();

/// Returns all errors of a checked listing.
std::vector<ProgramMistake> mistakes_of(const interpreter::super_40nc::Checked& checked);

}  // namespace understudy::emulator::models::super_40nc
