// The parts that all report pages share.
#pragma once

#include <string_view>

namespace understudy::emulator::play {

extern const std::string_view kPageStyle;   // CSS, for light and dark
extern const std::string_view kPageScript;  // shows values under the pointer; the page is complete without it

}  // namespace understudy::emulator::play
