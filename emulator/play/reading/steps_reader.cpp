#include "emulator/play/reading/steps_reader.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/file_error.h"
#include "base/files/text_file.h"
#include "base/text/suggestion.h"
#include "emulator/play/reading/parameters.h"
#include "emulator/play/reading/step_rows.h"
#include "emulator/play/reading/trial.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/bench_file/bench_schema.h"
#include "emulator/world/faults/fault.h"

namespace understudy::emulator::play {

namespace {

const StepRow* find_row(std::string_view key) {
  for (const StepRow& row : step_rows()) {
    if (row.key.key == key) return &row;
  }
  return nullptr;
}

/// Returns the kind of a step, which its first key with the name of a kind determines, or null.
const StepRow* row_of(const world::YamlFields& step) {
  if (!step.is_map()) step.fail("expected a step, as in `- advance: 250ms`");
  for (const auto& [key, value] : step.entries()) {
    if (const StepRow* const row = find_row(key)) return row;
  }
  return nullptr;
}

[[noreturn]] void fail_without_row(const world::YamlFields& step) {
  const auto entries = step.entries();
  if (entries.empty()) step.fail("is empty; expected a step, as in `- advance: 250ms`");
  std::vector<std::string> names;
  for (const StepRow& row : step_rows()) names.emplace_back(row.key.key);
  const std::string& key = entries.front().first;
  entries.front().second.fail("is not a step" + suggestion(key, names));
}

/// Returns the size of a step's data, without its text, for those kinds that may contain much data.
struct BytesOf {
  std::size_t operator()(const SendStep& step) const {
    return step.bytes.size() + (step.reply ? step.reply->size() : 0);
  }
  std::size_t operator()(const TextStep& step) const {
    std::size_t bytes = step.text ? step.text->size() : 0;
    if (!step.lines) return bytes;
    for (const std::string& line : *step.lines) bytes += line.size();
    return bytes;
  }
  std::size_t operator()(const ProgramStep& step) const { return step.text.size(); }
  std::size_t operator()(const SayStep& step) const { return step.text.size(); }
  template <typename Other>
  std::size_t operator()(const Other&) const {
    return 0;
  }
};

/// Returns the same path for all spellings of a path.
std::string canonical(const std::string& path) {
  return std::filesystem::weakly_canonical(std::filesystem::absolute(path)).string();
}

}  // namespace

StepsReader::StepsReader(const Trial& trial, FileReading& file, const std::string& path)
    : trial_(trial), file_(file), paths_{canonical(path)} {
  for (const world::Fault& fault : trial.bench().faults)
    story_.faults.push_back(world::to_text(trial.known(), fault));
}

Steps StepsReader::read(const world::YamlFields& list, const Parameters& parameters,
                        std::vector<WrittenStep>* written) {
  Steps steps;
  top_ = into_ = &steps;
  written_ = written;
  diagnostics_.require([&] { read_here(list, parameters); });
  written_ = nullptr;
  return steps;
}

Steps StepsReader::read_apart(const world::YamlFields& step) {
  static const Parameters kNone;
  Steps steps;
  into_ = &steps;
  parameters_ = &kNone;
  const Story before = story_;
  diagnostics_ = {};
  diagnostics_.require([&] { read_or_report(step); });
  story_ = before;
  return steps;
}

void StepsReader::note_written() {
  written_->push_back(
      {.fields = has_added_ ? written_->back().fields : current_->settled(), .continues = has_added_});
  has_added_ = true;
}

void StepsReader::count(const world::YamlFields& where) {
  if (++file_.steps > FileReading::kMaxSteps) {
    throw world::LastError(where.place(), where.field() + ": is one step too many; expected at most " +
                                              std::to_string(FileReading::kMaxSteps) +
                                              " including all loops and cases");
  }
}

void StepsReader::count_bytes(const world::YamlFields& where, const Step& step) {
  file_.bytes += step.text.size() + std::visit(BytesOf{}, step.what);
  if (file_.bytes > FileReading::kMaxBytes) {
    where.fail("is too large: the steps exceed " + std::to_string(FileReading::kMaxBytes >> 20) +
               " MiB; expected less, including all loops and cases");
  }
}

void StepsReader::read_here(const world::YamlFields& list, const Parameters& parameters) {
  if (++depth_ > FileReading::kDeepest) {
    list.fail("is nested too deeply; expected at most " + std::to_string(FileReading::kDeepest) +
              " levels of loops, forks and includes");
  }
  const Parameters* const outer = std::exchange(parameters_, &parameters);
  const auto steps = list.with_rule(&parameters).elements();
  if (steps.empty()) list.fail("is empty; expected at least one step");
  for (const world::YamlFields& step : steps) read_or_report(step);
  parameters_ = outer;
  --depth_;
}

/// Reads a step. If the step cannot be read, restores the state of the reader.
void StepsReader::read_or_report(const world::YamlFields& step) {
  const auto before = std::tuple(parameters_, into_, paths_.size(), depth_);
  const auto outer = std::pair(may_lack_name_, has_failed_);
  const StepRow* row = nullptr;
  may_lack_name_ = has_failed_ = false;
  attempt([&] {
    row = row_of(step);
    may_lack_name_ = lacks_names_ && row != nullptr && row->names == StepRow::Names::wants;
    read_step(step, row);
  });
  const bool is_read = !has_failed_;
  std::tie(may_lack_name_, has_failed_) = outer;
  if (is_read) return;
  lacks_names_ = lacks_names_ || row == nullptr || row->names == StepRow::Names::gives;
  std::size_t paths = 0;
  std::tie(parameters_, into_, paths, depth_) = before;
  paths_.resize(paths);
}

Steps StepsReader::read_branch(const world::YamlFields& list) {
  Steps steps;
  Steps* const outer = std::exchange(into_, &steps);
  const Story before = story_;
  const auto branching = current_;
  diagnostics_.attempt([&] { read_here(list, *parameters_); });
  current_ = branching;
  has_added_ = false;
  story_ = before;
  into_ = outer;
  return steps;
}

void StepsReader::read_included(const world::YamlFields& field) {
  const std::string path = canonical(field.path());
  if (std::find(paths_.begin(), paths_.end(), path) != paths_.end()) {
    field.fail(field.path() + " includes itself; expected another file");
  }
  auto& included = file_.shared.included;
  auto it = included.find(field.path());
  if (it == included.end()) {
    const auto text = read_text_file(path);
    if (!text) field.fail(field.path() + " " + text.why + "; expected a file of steps");
    const world::YamlFields root =
        world::YamlFields::parse(*text, field.path(), "steps", "`understudy: 1` and `steps:`");
    const std::string why = is_another_kind(*text, ContentKind::steps);
    if (!why.empty() && (root.has("bench") || !root.has("steps"))) field.fail(field.path() + " " + why);
    root.require_keys(kIncludedKeys);
    root.at("understudy").integer(world::kVersionSchema);
    it = included.emplace(field.path(), root.at("steps")).first;
  }
  add_file(field.path(), "a file of steps that is included");
  paths_.push_back(path);
  read_here(it->second, *parameters_);
  paths_.pop_back();
}

void StepsReader::read_step(const world::YamlFields& step, const StepRow* row) {
  step.require_map();
  if (row == nullptr) fail_without_row(step);
  current_ = step;
  has_added_ = false;
  std::vector<world::Key> known{row->key};
  known.insert(known.end(), row->beside.begin(), row->beside.end());
  for (const auto& [key, value] : step.entries()) {
    const StepRow* const other = find_row(key);
    if (other == nullptr || other == row) continue;
    known.push_back(other->key);
    attempt([&, &second = value] { second.fail("is a second step in one entry; expected `- ` before it"); });
  }
  attempt([&] { step.require_keys(known); });
  row->read(*this, step, step.at(row->key.key));
}

}  // namespace understudy::emulator::play
