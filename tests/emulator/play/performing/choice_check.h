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

/// Returns the errors in the proof of a row, as sentences that name the row; nothing if it is correct:
///  - it asks a question and explains it;
///  - it has one case for each option of the row, in the row's order, and each passes;
///  - the outcomes of the cases differ (outcome_hash.h);
///  - and only because of the choice. The first case runs without its expectations, with one option after
///  another,
///    and still has different outcomes; and the other cases do exactly the same.
std::vector<std::string> diagnostics_of_proof(const ChoiceRow& row, const Proof& proof);

}  // namespace understudy::emulator::play
