// Checks that a proof, a play in docs/fidelity/proofs/MODEL/, distinguishes the options of a choice.
#pragma once

#include <string>
#include <vector>

#include "base/choices.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::play {

struct Proof {
  std::string id;       // the choice's id
  std::string comment;  // above the play
  std::vector<Scenario> cases;
};

/// Returns the plays of a file's text, each about a choice. Throws FileError.
std::vector<Proof> proofs_in(const std::string& text, const std::string& path);

/// Returns the errors in the proof of a row, as sentences that name the row; nothing if it is correct:
///  - it asks a question and explains it;
///  - it has one case for each option of the row, in the row's order, and each passes;
///  - the outcomes of the cases differ (outcome_hash.h);
///  - they differ only because of the choice: the first case, run without its expectations and with one
///    option after another, still has different outcomes, and the other cases do exactly the same.
std::vector<std::string> diagnostics_of_proof(const ChoiceRow& row, const Proof& proof);

}  // namespace understudy::emulator::play
