// Errors of a chain of SLIM modules: the language's own numbers, which ?ERR shows.
#pragma once

#include "interpreter/slim/error.h"

namespace understudy::emulator::models::slim {

using interpreter::slim::Error;

}  // namespace understudy::emulator::models::slim
