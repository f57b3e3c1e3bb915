// Macros and triggers as text: for listings, and for messages to the window.
#pragma once

#include <vector>

#include "emulator/device/program_error.h"
#include "emulator/device/program_language.h"
#include "interpreter/rs_m8194h/text_error.h"

namespace understudy::emulator::models::rs_m8194h {

const ProgramLanguage& language();

std::vector<ProgramMistake> mistakes_of(const std::vector<interpreter::rs_m8194h::TextError>& errors);

}  // namespace understudy::emulator::models::rs_m8194h
