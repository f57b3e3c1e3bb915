#include "emulator/version.h"

namespace understudy::emulator {

std::string_view program_version() { return UNDERSTUDY_VERSION; }

}  // namespace understudy::emulator
