#pragma once

#include <string>
#include <vector>

#include "base/files/file_claims.h"
#include "base/files/output_file.h"
#include "emulator/command_line/commands.h"
#include "emulator/world/recording/recording_spool.h"
#include "emulator/world/trace/trace_file.h"

namespace understudy::emulator::command_line {

/// Checks and claims the output path of a flag. An empty path means no file. Throws UsageError.
inline std::string require_output(FileClaims& claims, const std::string& flag, const std::string& path) {
  if (const std::string why = claims.objection_to(path); !why.empty()) {
    throw UsageError(flag + ": " + path + ": " + why);
  }
  claims.add({path, "what " + flag + " writes"});
  return path;
}

inline std::string require_capture(FileClaims& claims, const std::string& path) {
  if (path.ends_with(".pcap")) {
    throw UsageError(
        "--capture: " + path +
        ": this old format is not supported; expected .pcapng, or another ending for a text log");
  }
  return require_output(claims, "--capture", path);
}

/// Like require_output(), but also checks that `also` is empty if there is no trace.
inline std::string require_trace(FileClaims& claims, const std::string& path,
                                 const std::vector<std::string>& also) {
  if (path.empty() && !also.empty())
    throw UsageError("--trace-also: has no effect without --trace; expected --trace FILE");
  if (!path.empty() && !world::is_trace_name(path)) {
    throw UsageError("--trace: " + path + ": has an unknown format; expected FILE.csv or FILE.vcd");
  }
  return require_output(claims, "--trace", path);
}

/// Returns the path for the older part of a large recording, next to the recording itself. Empty if there is
/// no recording.
inline std::string older_part_of(const std::string& recording) {
  if (recording.empty()) return "";
  try {
    return output_target(recording) + world::kOlderPart;
  } catch (const OutputError&) {
    return recording + world::kOlderPart;  // the error is reported when the file is opened
  }
}

}  // namespace understudy::emulator::command_line
