// Implements `probe`: plays the proofs of choices on a real controller, and reports which options it has.
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/choices.h"
#include "base/files/content_kind.h"
#include "base/files/file_claims.h"
#include "emulator/box/calibrate/evidence_file.h"
#include "emulator/box/wire/wire.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/model_option.h"
#include "emulator/command_line/on_box.h"
#include "emulator/command_line/output_paths.h"
#include "emulator/command_line/probe_proofs.h"
#include "emulator/command_line/result_file.h"
#include "emulator/device/model.h"
#include "emulator/play/executors/real_executor.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::command_line {

namespace {

namespace fs = std::filesystem;
using Verdict = play::ScenarioResult::Verdict;

constexpr const char* kBox = "box";

/// Plays a case once. Returns nothing if a step was skipped or the rig failed, because the case has not
/// checked everything.
std::optional<Ending> play_case(OptionCase& one, OnBox& stage) {
  play::RunOptions options;
  options.make_executor = [&](const play::Scenario& scenario) { return stage.make(scenario); };
  CaseEnd end = end_of(play::run_scenario(*one.scenario, options).front());
  one.why = std::move(end.why);
  return stage.take_rig_failure() ? std::nullopt : end.ending;
}

/// Plays each case that tells options apart, and then each once more, because a late reply or what an earlier
/// case has left behind can change a verdict. Returns false if the controller no longer answers.
bool play_proof(Proof& proof, OnBox& stage) {
  constexpr int kTimes = 2;
  for (int time = 0; time < kTimes; ++time) {
    for (OptionCase& one : proof.cases) {
      if (!one.is_telling()) continue;
      const std::optional<Ending> ended = play_case(one, stage);
      if (!stage.are_answering() && !stage.revive(kBox)) {
        one.why = "the controller stopped answering";
        proof.why_not = "the controller stopped answering while it was played";
        return false;
      }
      if (!ended) {
        proof.why_not = one.why;
        return true;
      }
      proof.is_unsteady = proof.is_unsteady || (one.ended && !are_alike(*one.ended, *ended));
      one.ended = ended;
    }
  }
  return true;
}

/// Lists the requests of each case.
void plan_proof(Proof& proof, OnBox& stage) {
  std::printf("%s\n", std::string(proof.choice->id).c_str());
  for (OptionCase& one : proof.cases)
    if (one.is_telling()) play_case(one, stage);
}

/// Options that were measured change what other proofs show, so all are rehearsed again with them.
void judge_with_measured(std::vector<Proof>& proofs, OnBox& stage) {
  MeasuredOptions measured;
  for (const Proof& proof : proofs) {
    if (proof.state() != "measured") continue;
    const std::string option = proof.agreeing().front();
    if (option != options_of(*proof.choice).front()) measured.emplace(proof.choice->id, option);
  }
  for (Proof& proof : proofs)
    if (!measured.empty() && proof.is_played()) proof.rehearse(stage, measured);
}

/// Returns true if the controller may still hold settings of earlier proofs, which look like another option:
/// writes were allowed, and no rig has reset the memory before each case.
bool may_hold_settings(const OnArguments& on) {
  const bool writes = on.allow_writes || on.allow_memory || on.allow_outputs || on.allow_motion;
  return writes && on.rig.empty();
}

box::EvidenceFile evidence_of(const Model& model, const ProbeArguments& arguments,
                              const std::vector<Proof>& proofs) {
  box::EvidenceFile evidence{.box = arguments.box, .port = arguments.port};
  const Firmware firmware = require_firmware(model, arguments.firmware);
  evidence.devices = {
      {kBox, std::string(model.name), version_text(firmware != 0 ? firmware : model.firmwares.back())}};
  for (const Proof& proof : proofs) {
    box::EvidenceRow row{.device = kBox,
                         .choice = std::string(proof.choice->id),
                         .state = proof.state(),
                         .options = proof.is_played() ? proof.agreeing() : std::vector<std::string>(),
                         .expected = std::string(options_of(*proof.choice).front()),
                         .proof = proof.cases.empty() ? "" : proof.cases.front().scenario->file,
                         .why_not = proof.why_not};
    for (const OptionCase& one : proof.cases)
      if (!one.why.empty()) row.seen[one.option] = one.why;
    const bool is_another = row.state == "measured" && row.options.front() != row.expected;
    if (is_another && may_hold_settings(arguments.on)) {
      row.state = "undecided";
      row.options.push_back(row.expected);
    }
    evidence.rows.push_back(std::move(row));
  }
  return evidence;
}

/// Plays all proofs that can be played. Returns false if it was ended before.
bool play_all(std::vector<Proof>& proofs, OnBox& stage, bool only_plans) {
  std::string why_over;
  try {
    for (Proof& proof : proofs) {
      if (!why_over.empty() && proof.why_not.empty()) proof.why_not = why_over;
      if (proof.why_not.empty()) proof.rehearse(stage);
      if (!proof.why_not.empty()) continue;
      if (only_plans) {
        plan_proof(proof, stage);
      } else if (!play_proof(proof, stage)) {
        why_over = "the controller stopped answering after " + std::string(proof.choice->id);
      }
    }
  } catch (const play::ExecutionAborted&) {
    why_over = "was not reached";
  } catch (const box::WireError& error) {
    std::fprintf(stderr, "understudy: probe: %s\n", error.what());
    why_over = "was not reached";
  }
  for (Proof& proof : proofs)
    if (proof.why_not.empty() && !proof.is_played()) proof.why_not = why_over;
  judge_with_measured(proofs, stage);
  return why_over.empty();
}

}  // namespace

int probe_box(ModelList models, const ProbeArguments& arguments) {
  const Model& model = require_model(models, arguments.model);
  require_firmware(model, arguments.firmware);
  FileClaims claims;
  ResultFile output("--output", require_output(claims, "--output", arguments.output), ContentKind::evidence);
  OnArguments on = arguments.on;
  on.on = {"*=" + arguments.port};
  OnBox stage(on);
  stage.have_bare_controller(kBox);
  std::vector<Proof> proofs = proofs_of(models, model, arguments, stage);
  const bool is_whole = play_all(proofs, stage, on.plan);
  if (on.plan) return kExitWell;
  const box::EvidenceFile evidence = evidence_of(model, arguments, proofs);
  std::fputs(box::evidence_table(evidence, "the model's default is different").c_str(), stdout);
  if (output.is_wanted()) {
    output.replace(box::evidence_text(evidence));
    std::printf("wrote %s\n", arguments.output.c_str());
  }
  return is_whole ? kExitWell : kExitFailed;
}

}  // namespace understudy::emulator::command_line
