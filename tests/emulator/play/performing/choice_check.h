// Checks that a play distinguishes the options of a choice: those of docs/fidelity/proofs/MODEL/.
#pragma once

#include <string>
#include <vector>

#include "base/choices.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::play {

struct Proof {
  std::string id;       // of its choice
  std::string comment;  // above the play
  std::vector<Scenario> cases;
};

/// Returns the plays of a file's text, each about a choice. Throws FileError.
std::vector<Proof> proofs_in(const std::string& text, const std::string& path);

/// What is wrong with the proof of a row, a sentence each that names the row; nothing if it is as it should
/// be:
///  - it asks a question and explains it;
///  - it has one case for each option of the row, in the row's order, and each passes;
///  - what comes out differs from case to case (outcome_hash.h);
///  - and it does so by the choice alone. The first case is played without its expectations, with one option
///    after the other, and still comes out differently; and what another case does is just that.
std::vector<std::string> diagnostics_of_proof(const ChoiceRow& row, const Proof& proof);

}  // namespace understudy::emulator::play
