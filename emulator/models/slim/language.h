// SLIM's programs as text: the lines that a host would enter. The instructions are the model's commands.
#pragma once

#include "emulator/device/program_language.h"

namespace understudy::emulator::models::slim {

const ProgramLanguage& language();

}  // namespace understudy::emulator::models::slim
