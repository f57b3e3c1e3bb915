// Code shared by commands that read programs.
#pragma once

#include <string>
#include <vector>

#include "emulator/command_line/commands.h"
#include "emulator/device/model.h"
#include "emulator/device/program_error.h"
#include "emulator/device/program_language.h"

namespace understudy::emulator::command_line {

/// Returns the model's language. Throws UsageError if the model's devices do not run programs.
const ProgramLanguage& require_language(const Model& model);
/// Returns the settings. Throws UsageError, or SettingError for settings that do not exist in the model.
DeviceSettings program_settings(const Model& model, const ProgramTextArguments& arguments);
/// Prints the mistakes to standard error, one per line.
void print_mistakes(const std::vector<ProgramMistake>& mistakes, const std::string& file);

}  // namespace understudy::emulator::command_line
