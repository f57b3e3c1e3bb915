// `ctl scope`: how far an oscilloscope's single shot is, in words, and what it has kept as a trace.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace understudy::emulator::command_line {

/// `scope` of a reply, which may be null.
void print_scope(const nlohmann::ordered_json& scope);

/// Writes what the daemon at that socket has kept to FILE.csv, for `plot`. Throws UsageError where there is
/// nothing, and GrowingFileError.
void write_scope(const std::string& socket, const std::string& path);

}  // namespace understudy::emulator::command_line
