#pragma once

#include <string_view>

namespace understudy {

/// Returns the version of the program: "0.3.0".
std::string_view program_version();

}  // namespace understudy
