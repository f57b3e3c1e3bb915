// Samples of every homing mode, for the pictures of docs/motion.md.
#pragma once

#include <filesystem>

namespace understudy::docs {

/// One table a controller: time, travel and phase, a block for each mode.
void write_homing_samples(const std::filesystem::path& folder);

}  // namespace understudy::docs
