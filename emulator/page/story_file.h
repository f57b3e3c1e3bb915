// The page of a recording as one file that needs nothing else: neither this program nor a network.
#pragma once

#include <string>

#include "emulator/page/story_data.h"

namespace understudy::emulator::page {

/// Returns the file, an HTML page. `name` is the name of the recording. Throws RefusedError with the reason.
std::string story_file(const Asker& ask, const std::string& name, const std::string& version);

}  // namespace understudy::emulator::page
