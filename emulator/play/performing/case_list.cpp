#include "emulator/play/performing/case_list.h"

#include <fnmatch.h>
#include <malloc.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/file_claims.h"
#include "base/files/file_error.h"
#include "base/files/text_file.h"
#include "base/state/state_bytes.h"
#include "base/text/parse_integer.h"
#include "emulator/device/model.h"
#include "emulator/play/performing/suite.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/play/reading/shared_reading.h"
#include "emulator/play/scenario/case.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::play {

namespace {

// Reading a case again takes less than a tenth of the time of its run, but for test suites of ordinary size,
// it is not necessary.
constexpr std::size_t kMaxHeld = 1000;
constexpr std::size_t kMaxShared = 256;  // benches and step files
constexpr std::size_t kTrimEvery = 256;  // files

std::uint64_t hash_of_text(std::string_view text, std::uint64_t onto) {
  return hash_of(std::as_bytes(std::span(text)), onto);
}

/// Discards shared files if there are too many.
void keep_few(SharedReading& shared) {
  if (shared.benches.size() > kMaxShared) shared.benches.clear();
  if (shared.included.size() > kMaxShared) shared.included.clear();
}

}  // namespace

std::optional<Shard> parse_shard(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const auto number = parse_integer(text.substr(0, slash));
  const auto of = parse_integer(text.substr(slash + 1));
  if (!number || !of || *number < 1 || *number > *of) return std::nullopt;
  return Shard{static_cast<std::uint64_t>(*number), static_cast<std::uint64_t>(*of)};
}

bool matches(const std::string& pattern, const std::string& name, std::uint64_t identity) {
  return pattern.empty() || fnmatch(pattern.c_str(), name.c_str(), 0) == 0 || pattern == name ||
         pattern == identity_text(identity);
}

CaseList::CaseList(ModelList models, ReadingOptions options)
    : options_(std::move(options)), shared_{.models = models, .benches = {}, .included = {}} {}

std::uint64_t CaseList::cases() const {
  std::uint64_t sum = 0;
  for (const File& file : files_) sum += file.size;
  return sum;
}

std::uint64_t CaseList::hash_of_file(const std::string& path) {
  const auto it = hashes_.find(path);
  if (it != hashes_.end()) return it->second;
  const auto text = read_text_file(path);
  return hashes_.emplace(path, text ? hash_of_text(*text, hash_of({})) : 0).first->second;
}

void CaseList::add(const std::string& path, const std::function<void(const Scenario&)>& look) {
  keep_few(shared_);
  ScenarioFile opened(path, options_, shared_);
  File file{.path = path, .size = opened.size(), .is_varied = opened.is_varied(), .made_of = 0, .held = {}};
  const bool is_held = !file.is_varied && held_ + file.size <= kMaxHeld;
  // The hash depends neither on the location of the files nor on the spelling of their paths.
  std::set<std::uint64_t> contents;
  opened.check([&](Scenario scenario) {
    look(scenario);
    for (const FileClaim& claim : scenario.files) contents.insert(hash_of_file(claim.path));
    if (is_held) file.held.push_back(std::make_shared<const Scenario>(std::move(scenario)));
  });
  file.made_of = hash_of_text(options_.seed ? std::to_string(*options_.seed) : "", hash_of({}));
  for (const std::uint64_t content : contents)
    file.made_of = hash_of_text(identity_text(content), file.made_of);
  held_ += file.held.size();
  files_.push_back(std::move(file));
  // The small amount of data that is kept for each file is located between the memory of its worlds, and
  // glibc 2.36 reuses aligned memory only if it is contiguous. This call returns 14 KiB per file.
  if (files_.size() % kTrimEvery == 0) ::malloc_trim(0);
}

/// Claims the paths that a case saves. For listed cases, this was done when they were checked.
void CaseList::claim_saved(const Scenario& scenario) const {
  const std::uint64_t who = identity_of(scenario.which) ^ hash_of_text(scenario.file, hash_of({}));
  for (const std::string& path : scenario.saved) {
    const std::lock_guard lock(saved_mutex_);
    if (saved_.emplace(hash_of_text(path, hash_of({})), who).first->second != who) {
      throw FileError(scenario.file + ": save: " + path +
                      " is also saved by another case; expected a different path for each case");
    }
  }
}

CaseReader::CaseReader(const CaseList& case_list)
    : case_list_(case_list), shared_{.models = case_list.shared_.models, .benches = {}, .included = {}} {}

ScenarioFile& CaseReader::open(std::size_t file) {
  if (file != file_) {
    keep_few(shared_);
    file_ = SIZE_MAX;
    open_ = std::make_unique<ScenarioFile>(case_list_.files_[file].path, case_list_.options_, shared_);
    file_ = file;
  }
  return *open_;
}

std::shared_ptr<const Scenario> CaseReader::read(const CaseId& which_case) {
  const CaseList::File& file = case_list_.files_[which_case.file];
  if (!file.held.empty()) return file.held[which_case.number];
  ScenarioFile& opened = open(which_case.file);
  if (opened.size() != file.size) {
    throw FileError(
        file.path +
        ": cases: their number has changed since the file was checked; expected an unchanged file");
  }
  auto scenario = std::make_shared<const Scenario>(opened.read(which_case.number));
  if (file.is_varied && !scenario->saved.empty()) case_list_.claim_saved(*scenario);
  return scenario;
}

std::string CaseReader::name_of(const CaseId& which_case) {
  const CaseList::File& file = case_list_.files_[which_case.file];
  return file.held.empty() ? open(which_case.file).name_of(which_case.number)
                           : file.held[which_case.number]->name;
}

Case CaseReader::case_of(const CaseId& which_case) {
  const CaseList::File& file = case_list_.files_[which_case.file];
  return file.held.empty() ? open(which_case.file).case_of(which_case.number)
                           : file.held[which_case.number]->which;
}

Selection::Selection(const CaseList& case_list, std::string pattern, Shard shard)
    : case_list_(case_list), pattern_(std::move(pattern)), shard_(shard), reader_(case_list) {}

std::optional<CaseId> Selection::next() {
  while (at_.file < case_list_.files()) {
    if (at_.number >= case_list_.cases_of(at_.file)) {
      at_ = {.file = at_.file + 1, .number = 0};
      continue;
    }
    const CaseId which_case = at_;
    ++at_.number;
    if (!pattern_.empty() &&
        !matches(pattern_, reader_.name_of(which_case), identity_of(reader_.case_of(which_case)))) {
      continue;
    }
    if (selected_++ % shard_.of == shard_.number - 1) return which_case;
  }
  return std::nullopt;
}

std::uint64_t Selection::count(const CaseList& case_list, const std::string& pattern, Shard shard) {
  if (pattern.empty()) return (case_list.cases() + shard.of - shard.number) / shard.of;
  Selection all(case_list, pattern, shard);
  std::uint64_t count = 0;
  while (all.next()) ++count;
  return count;
}

}  // namespace understudy::emulator::play
