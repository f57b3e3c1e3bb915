#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/text/parse_integer.h"
#include "emulator/play/results/failure_kinds.h"
#include "emulator/play/results/result.h"
#include "emulator/play/results/result_text.h"
#include "emulator/play/results/results_file.h"
#include "emulator/play/scenario/case.h"

namespace understudy::emulator::play {

namespace {

using RowJson = nlohmann::ordered_json;

std::string verdict_word(const ScenarioResult& result) {
  if (result.is_unreadable) return "unreadable";
  switch (result.verdict) {
    case ScenarioResult::Verdict::passed: return "passed";
    case ScenarioResult::Verdict::failed: return "failed";
    case ScenarioResult::Verdict::not_reached: return "not reached";
    case ScenarioResult::Verdict::not_tellable: return "not tellable";
  }
  return {};
}

/// Returns a number if the text has the form of a JSON number, otherwise a text: 007, 1e3 and 0x10 are texts.
RowJson value_of(const std::string& text) {
  if (const auto whole = parse_integer(text); whole && std::to_string(*whole) == text) return *whole;
  if (!text.empty() && text.find_first_not_of("-.0123456789") == std::string::npos) {
    const RowJson number = RowJson::parse(text, nullptr, false);
    if (number.is_number_float()) return number;
  }
  return text;
}

RowJson parameters_of(const ResultRow& row) {
  RowJson all = RowJson::object();
  for (const auto& [name, value] : row.parameters) all[name] = value_of(value);
  return all;
}

std::string dumped(const RowJson& json) {
  return json.dump(-1, ' ', false, RowJson::error_handler_t::replace);
}

RowJson or_null(const std::optional<std::string>& text) { return text ? RowJson(*text) : RowJson(nullptr); }

/// Returns the seconds as a number with nanosecond resolution.
RowJson seconds_value(const std::string& seconds) { return std::strtod(seconds.c_str(), nullptr); }

}  // namespace

ResultRow row_of(const ScenarioResult& result, std::uint64_t made_of, bool with_hash) {
  ResultRow row{.file = result.file,
                .name = result.name,
                .branch = result.branch,
                .case_id = identity_text(identity_of(result.which)),
                .parameters = result.which.values,
                .verdict = verdict_word(result),
                .hash = {},
                .simulated_s = seconds_text(result.simulated),
                .seed = result.seed,
                .kind = {},
                .failure = {},
                .at_s = {},
                .step = {},
                .recording = {},
                .made_of = identity_text(made_of)};
  const bool was_played = !result.is_unreadable && result.verdict != ScenarioResult::Verdict::not_reached;
  if (with_hash && was_played) row.hash = identity_text(result.outcome_hash);
  if (result.failure) {
    row.kind = kind_of_failure(result);
    row.failure = result.failure->what;
    if (was_played) row.at_s = seconds_text(result.failure->at);
    if (!result.steps.empty())
      row.step = result.steps.back().file + ":" + std::to_string(result.steps.back().line);
  }
  if (!result.recording.empty()) row.recording = result.recording;
  return row;
}

std::string json_text_of_parameters(const ResultRow& row) { return dumped(parameters_of(row)); }

std::string json_text(const ResultRow& row) {
  return dumped(RowJson{{"file", row.file},
                        {"name", row.name},
                        {"branch", row.branch},
                        {"case_id", row.case_id},
                        {"parameters", parameters_of(row)},
                        {"verdict", row.verdict},
                        {"hash", or_null(row.hash)},
                        {"simulated_s", seconds_value(row.simulated_s)},
                        {"seed", row.seed},
                        {"kind", or_null(row.kind)},
                        {"failure", or_null(row.failure)},
                        {"at_s", row.at_s ? seconds_value(*row.at_s) : RowJson(nullptr)},
                        {"step", or_null(row.step)},
                        {"recording", or_null(row.recording)},
                        {"made_of", row.made_of}});
}

}  // namespace understudy::emulator::play
