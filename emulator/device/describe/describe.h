// Presents a model's tables as sheets for people and scripts.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "emulator/device/describe/sheet.h"
#include "emulator/device/model.h"

namespace understudy::emulator {

/// Returns the sheet with the name `what`: registers, parameters, instructions, commands, choices, ports or
/// blocks. Returns nothing for any other word. The columns of CSV, JSON and Markdown are fixed
/// (docs/command_line.md); the table for people has more columns.
std::optional<Sheet> describe(const Model& model, std::string_view what, SheetFormat format);

/// Returns the path of the scenario that distinguishes the options of a choice,
/// "docs/fidelity/proofs/MODEL/NAME.yaml". The path is empty if the choice has only one option, or if no
/// scenario covers it.
std::string scenario_of_choice(const Model& model, const ChoiceRow& row);

}  // namespace understudy::emulator
