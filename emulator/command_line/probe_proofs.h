// The proofs of a model's choices as `probe` plays them: a case for each option, what each case shows about
// each option, and what a real controller showed.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/choices.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/on_box.h"
#include "emulator/device/model.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::command_line {

/// How a case ends. Failing is not enough to exclude an option: something else may have failed.
struct Ending {
  std::optional<std::size_t> failed_step{};  // nothing: the case passes
  std::string came{};                        // what the step got; empty: this is not certain
  bool operator==(const Ending&) const = default;
};

/// Returns true if both can be endings of the same case with the same controller.
bool are_alike(const Ending& a, const Ending& b);

/// The case of a proof for one option of a choice.
struct OptionCase {
  std::string option;
  std::shared_ptr<const play::Scenario> scenario;
  /// How the case ends in the rehearsal, by option of the controller. Nothing: this depends on the adapter's
  /// delay, or a step was skipped.
  std::map<std::string, std::optional<Ending>> rehearsed{};
  std::optional<Ending> ended{};  // on the controller; nothing: it was not played
  std::string why{};              // why it did not pass

  /// Returns true if it ends differently for two options.
  bool is_telling() const;
};

/// Options that other proofs have measured, by choice.
using MeasuredOptions = std::map<std::string, std::string>;

struct CaseEnd {
  std::optional<Ending> ending{};  // nothing: a step was skipped, so not everything was checked
  std::string why{};               // why it did not pass
};
CaseEnd end_of(const play::ScenarioResult& result);

struct Proof {
  const ChoiceRow* choice = nullptr;
  std::vector<OptionCase> cases{};
  std::string why_not{};     // why it is not played, or was not played to its end: "needs a machine"
  bool is_unsteady = false;  // a case ended differently the second time, so nothing is excluded

  /// Plays each case with a simulated controller for each option. If the cases do not tell the options apart,
  /// `why_not` becomes the reason.
  void rehearse(OnBox& stage, const MeasuredOptions& measured = {});
  /// Returns the options of a controller on which the cases would end as they did.
  std::vector<std::string> agreeing() const;
  bool is_played() const;
  /// Returns a word of box::kEvidenceStates.
  std::string state() const;
};

/// Reads all proofs of the model. Those that need more than a controller with factory settings, and a rig if
/// the stage has one, have a `why_not`. The order is that of playing: the most telling come first.
std::vector<Proof> proofs_of(ModelList models, const Model& model, const ProbeArguments& arguments,
                             const OnBox& stage);

}  // namespace understudy::emulator::command_line
