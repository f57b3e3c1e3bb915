// Implements `ctl scope`: shows the progress of an oscilloscope's single shot, and writes its samples as a
// trace.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace understudy::emulator::command_line {

/// Prints the `scope` object of a reply. It may be null.
void print_scope(const nlohmann::ordered_json& scope);

/// Writes the samples of the daemon at that socket to FILE.csv, for `plot`. Throws UsageError if there are no
/// samples, and GrowingFileError if the file cannot be written.
void write_scope(const std::string& socket, const std::string& path);

}  // namespace understudy::emulator::command_line
