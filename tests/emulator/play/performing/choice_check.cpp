#include "tests/emulator/play/performing/choice_check.h"
#include "emulator/models/models.h"

#include <algorithm>
#include <set>
#include <sstream>

#include "emulator/play/performing/run.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/play/results/result_text.h"

namespace understudy::emulator::play {

namespace {

constexpr std::size_t kMinExplanation = 30;  // letters after the question

Steps without_expectations(const Steps& steps);

/// A step without its expectations: its actions are the same whatever the result is.
struct Unasking {
  const Step& step;
  Steps& made;

  template <typename What>
  void add(What what) const {
    made.push_back({.file = step.file, .line = step.line, .text = step.text, .what = std::move(what)});
  }

  void operator()(ExpectStep expect) const {
    for (ExpectStep::Entry& entry : expect.entries) entry.value = {};
    add(std::move(expect));
  }
  void operator()(WaitStep wait) const {
    wait.takes.reset();
    add(std::move(wait));
  }
  void operator()(SendStep send) const {
    send.reply.reset();
    add(std::move(send));
  }
  /// Returns lines that would be waited for, with their times.
  void operator()(TextStep text) const {
    const bool waits = text.lines.has_value();
    const SimTime within = text.within;
    text.lines.reset();
    if (text.text) add(std::move(text));
    if (waits) add(AdvanceStep{within});
  }
  void operator()(ForkStep fork) const {
    for (ForkStep::Branch& branch : fork.branches) branch.steps = without_expectations(branch.steps);
    add(std::move(fork));
  }
  void operator()(ProgramStep program) const {
    program.refused.reset();
    program.asks = false;
    add(std::move(program));
  }
  void operator()(const MemoryStep& memory) const {
    if (memory.what == MemoryStep::What::save) add(memory);
  }
  void operator()(const AssertStep&) const {}
  void operator()(const SpanStep&) const {}
  void operator()(const EndSpanStep&) const {}
  template <typename Other>
  void operator()(const Other& other) const {
    add(other);
  }
};

Steps without_expectations(const Steps& steps) {
  Steps made;
  for (const Step& step : steps) std::visit(Unasking{step, made}, step.what);
  return made;
}

Scenario without_expectations(Scenario scenario) {
  scenario.steps = without_expectations(scenario.steps);
  return scenario;
}

/// Returns the options that its devices were given for a row.
std::set<std::string> chosen_in(const Scenario& scenario, const std::string& id) {
  std::set<std::string> chosen;
  for (const world::DeviceSetup& device : scenario.bench.devices) {
    const auto it = device.settings.choices.find(id);
    if (it != device.settings.choices.end()) chosen.insert(it->second);
  }
  return chosen;
}

Scenario choosing(Scenario scenario, const std::string& id, const std::string& option) {
  for (world::DeviceSetup& device : scenario.bench.devices) {
    const auto it = device.settings.choices.find(id);
    if (it != device.settings.choices.end()) it->second = option;
  }
  return scenario;
}

/// For the scenario and each of its branches.
using Outcome = std::vector<std::uint64_t>;

Outcome outcome_of(const std::vector<ScenarioResult>& results) {
  Outcome outcome;
  for (const ScenarioResult& result : results) outcome.push_back(result.outcome_hash);
  return outcome;
}

std::vector<ScenarioResult> played_with_hash(const Scenario& scenario) {
  RunOptions options;
  options.with_hash = true;
  return run_scenario(scenario, options);
}

/// The comment above each play; plays are the items that are indented by two.
std::vector<std::string> comments_in(const std::string& text) {
  std::vector<std::string> comments;
  std::string comment;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("  #")) {
      comment += line;
      continue;
    }
    if (line.starts_with("  - ")) comments.push_back(comment);
    comment.clear();
  }
  return comments;
}

class ChoiceCheck {
 public:
  explicit ChoiceCheck(const ChoiceRow& row) : id_(row.id) {
    for (const std::string_view option : options_of(row)) options_.emplace_back(option);
  }

  std::vector<std::string> diagnostics(const Proof& proof) {
    look_at_comment(proof.comment);
    if (look_at_options(proof.cases)) {
      look_at_cases(proof.cases);
      look_at_causes(proof.cases);
    }
    return diagnostics_;
  }

 private:
  void report(const std::string& what) { diagnostics_.push_back(id_ + ": " + what); }

  void look_at_comment(const std::string& comment) {
    const std::size_t question = comment.find('?');
    if (question == std::string::npos) return report("asks nothing in a comment above it");
    if (comment.size() < question + kMinExplanation) report("explains nothing");
  }

  bool look_at_options(const std::vector<Scenario>& cases) {
    std::vector<std::string> named;
    for (const Scenario& scenario : cases) {
      const std::set<std::string> chosen = chosen_in(scenario, id_);
      named.push_back(chosen.size() == 1 ? *chosen.begin() : "?");
    }
    if (named == options_) return true;
    report("the cases choose " + joined(named) +
           "; expected each option once, ours first: " + joined(options_));
    return false;
  }

  void look_at_cases(const std::vector<Scenario>& cases) {
    std::vector<Outcome> outcomes;
    for (const Scenario& scenario : cases) {
      const auto results = played_with_hash(scenario);
      for (const ScenarioResult& result : results) {
        for (const std::string& line : failure_lines(result)) report(result.name + ": " + line);
      }
      outcomes.push_back(outcome_of(results));
    }
    require_different(outcomes, "what comes out");
  }

  void look_at_causes(const std::vector<Scenario>& cases) {
    const Scenario deeds = without_expectations(cases.front());
    std::vector<Outcome> outcomes;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      outcomes.push_back(outcome_of(played_with_hash(choosing(deeds, id_, options_[i]))));
      if (outcome_of(played_with_hash(without_expectations(cases[i]))) != outcomes.back()) {
        report("the case of " + options_[i] +
               " does something else than the first one; expected only its option and its expectations to "
               "differ");
      }
    }
    require_different(outcomes, "what comes out by the choice alone");
  }

  void require_different(const std::vector<Outcome>& outcomes, const std::string& what) {
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        if (outcomes[i] != outcomes[k]) continue;
        report(what + " is the same for " + options_[k] + " and " + options_[i]);
      }
    }
  }

  static std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text.empty() ? "none" : text;
  }

  std::string id_;
  std::vector<std::string> options_;
  std::vector<std::string> diagnostics_;
};

}  // namespace

std::vector<Proof> proofs_in(const std::string& text, const std::string& path) {
  const std::vector<std::string> comments = comments_in(text);
  std::vector<Proof> proofs;
  std::string last;
  for (Scenario& scenario : parse_scenarios(models::all_models(), text, path)) {
    const std::string play = scenario.which.play;
    if (proofs.empty() || play != last) {
      const std::size_t number = proofs.size();
      proofs.push_back({.id = play.substr(0, play.find(':')),
                        .comment = number < comments.size() ? comments[number] : "",
                        .cases = {}});
      last = play;
    }
    proofs.back().cases.push_back(std::move(scenario));
  }
  return proofs;
}

std::vector<std::string> diagnostics_of_proof(const ChoiceRow& row, const Proof& proof) {
  return ChoiceCheck(row).diagnostics(proof);
}

}  // namespace understudy::emulator::play
