// Implements `ctl coverage`: prints or writes which lines of the programs have run.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "emulator/command_line/commands.h"
#include "emulator/world/coverage/coverage_report.h"

namespace understudy::emulator::command_line {

/// Prints each program with the lines that have not run.
void print_files(const world::CoverageReport& report);

/// Prints the reply: the totals, then each program with the lines that have not run.
void print_coverage(const nlohmann::ordered_json& reply);

/// Writes the reply to FILE.info, FILE.xml or FILE.html. Throws UsageError and GrowingFileError.
void write_coverage(const nlohmann::ordered_json& reply, const ControlArguments& arguments);

}  // namespace understudy::emulator::command_line
