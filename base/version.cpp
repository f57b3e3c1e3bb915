#include "base/version.h"

#include <string_view>

namespace understudy {

std::string_view program_version() { return UNDERSTUDY_VERSION; }

}  // namespace understudy
