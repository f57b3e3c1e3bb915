// Numbers as SLIM prints them.
#pragma once

#include <string>

namespace understudy::emulator::slim {

std::string text_of_integer(double value);
/// The shortest text that reads back as the same 32-bit number.
std::string text_of_real(double value);

}  // namespace understudy::emulator::slim
