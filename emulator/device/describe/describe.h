// What a model's tables say, as sheets for people and scripts.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "emulator/device/describe/sheet.h"
#include "emulator/device/model.h"

namespace understudy::emulator {

/// `what` is registers, parameters, instructions, commands, choices, ports or blocks; nothing for another
/// word. The columns of CSV, JSON and Markdown are fixed (docs/command_line.md); the table for people has
/// more.
std::optional<Sheet> describe(const Model& model, std::string_view what, SheetFormat format);

/// The file with the play that tells the options of a choice apart, "docs/fidelity/proofs/MODEL/NAME.yaml";
/// empty where there is one option only.
std::string scenario_of_choice(const Model& model, const ChoiceRow& row);

}  // namespace understudy::emulator
