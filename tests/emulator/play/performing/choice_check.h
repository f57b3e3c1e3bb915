// Whether a scenario file tells the options of a choice apart: scenarios/choices/MODEL/ID.yaml.
#pragma once

#include <string>
#include <vector>

#include "emulator/device/choices.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::play {

/// What is wrong with a file of this text, a sentence each that names the row; nothing if it is as it should
/// be:
///  - it asks a question and explains it;
///  - it has one case for each option of the row, in the row's order, and each passes;
///  - what comes out differs from case to case (outcome_hash.h);
///  - and it does so by the choice alone. The first case is played without its expectations, with one option
///    after the other, and still comes out differently; and what another case does is just that.
std::vector<std::string> complaints_of_choice(const ChoiceRow& row, const std::string& text,
                                              const std::string& path);

}  // namespace understudy::emulator::play
