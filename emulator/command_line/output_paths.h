#pragma once

#include <string>

#include "emulator/command_line/commands.h"
#include "emulator/file_claims.h"

namespace understudy::emulator {

/// A path that a flag gives for a file to write, which is claimed from now on. Empty paths are none. Throws
/// UsageError.
inline const std::string& demand_output(FileClaims& claims, const std::string& flag,
                                        const std::string& path) {
  if (const std::string why = claims.objection_to(path); !why.empty()) {
    throw UsageError(flag + ": " + path + ": " + why);
  }
  claims.add({path, "what " + flag + " writes"});
  return path;
}

}  // namespace understudy::emulator
