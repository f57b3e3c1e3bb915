// Writes results as bytes, to pass them between processes.
#pragma once

#include <cstdint>

#include "base/state/state_bytes.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/case.h"

template <>
struct understudy::StateOf<understudy::emulator::play::Case> {
  using Case = emulator::play::Case;
  static void write(const Case& which, StateWriter& writer) {
    writer.write(which.play);
    writer.write(static_cast<std::uint64_t>(which.values.size()));
    for (const auto& [name, value] : which.values) {
      writer.write(name);
      writer.write(value);
    }
    writer.write(which.is_varied);
  }
  static void read(Case& which, StateReader& reader) {
    reader.read(which.play);
    std::uint64_t count = 0;
    reader.read(count);
    which.values.clear();
    for (; count > 0; --count) {
      auto& [name, value] = which.values.emplace_back();
      reader.read(name);
      reader.read(value);
    }
    reader.read(which.is_varied);
  }
};

template <>
struct understudy::StateOf<understudy::emulator::play::StepResult> {
  using StepResult = emulator::play::StepResult;
  static constexpr auto fields =
      FieldList{field<&StepResult::file>(),   field<&StepResult::line>(), field<&StepResult::text>(),
                field<&StepResult::begin>(),  field<&StepResult::end>(),  field<&StepResult::has_failed>(),
                field<&StepResult::skipped>()};
};

template <>
struct understudy::StateOf<understudy::emulator::play::Failure> {
  using Failure = emulator::play::Failure;
  static constexpr auto fields =
      FieldList{field<&Failure::at>(),    field<&Failure::what>(),    field<&Failure::expected>(),
                field<&Failure::came>(),  field<&Failure::details>(), field<&Failure::frames>(),
                field<&Failure::state>(), field<&Failure::led_to>()};
};

template <>
struct understudy::StateOf<understudy::emulator::play::ScenarioResult::Verdict> {
  using Verdict = emulator::play::ScenarioResult::Verdict;
  static constexpr Verdict last = Verdict::not_tellable;
};

/// Everything except the run log, which only a report in the same process uses.
template <>
struct understudy::StateOf<understudy::emulator::play::ScenarioResult> {
  using ScenarioResult = emulator::play::ScenarioResult;

  static void write(const ScenarioResult& result, StateWriter& writer) {
    each_field(result, [&](const auto& value) { writer.write(value); });
  }
  static void read(ScenarioResult& result, StateReader& reader) {
    each_field(result, [&](auto& value) { reader.read(value); });
  }

 private:
  template <class Result, class Act>
  static void each_field(Result& result, Act act) {
    act(result.verdict);
    act(result.name);
    act(result.file);
    act(result.steps);
    act(result.failure);
    act(result.simulated);
    act(result.outcome_hash);
    act(result.lint_findings);
    act(result.recording);
    act(result.trace);
    act(result.capture);
    act(result.which);
    act(result.seed);
    act(result.branch);
    act(result.is_unreadable);
    act(result.rerun);
    act(result.like);
  }
};
