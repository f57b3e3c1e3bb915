#include "emulator/command_line/coverage_file.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/file_claims.h"
#include "base/files/growing_file.h"
#include "base/files/text_file.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/output_paths.h"
#include "emulator/play/performing/observer.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/coverage/coverage_report.h"
#include "emulator/world/coverage/program_coverage.h"
#include "emulator/world/world.h"

namespace understudy::emulator::command_line {

namespace {

bool is_xml(const std::string& path) { return path.ends_with(".xml"); }

/// Files that a scenario reads and that may be programs.
std::vector<world::ProgramSource> sources_of(const play::Scenario& scenario) {
  std::vector<world::ProgramSource> sources;
  for (const FileClaim& claim : scenario.files) {
    const bool is_other = claim.path.ends_with(".yaml") || claim.path.ends_with(".yml") ||
                          claim.path.ends_with(".json") || claim.path.ends_with(".csv");
    if (is_other) continue;
    if (const FileText text = read_text_file(claim.path)) sources.push_back({claim.path, *text});
  }
  return sources;
}

class CoverageObserver final : public play::Observer {
 public:
  CoverageObserver(world::World& world, std::vector<world::ProgramSource> sources, CoverageFile& file)
      : coverage_(world), sources_(std::move(sources)), file_(file) {}
  void world_restored(std::size_t /*steps*/) override {}  // what has run has run
  void finish(play::ScenarioResult& /*result*/) override { file_.add(coverage_.report(sources_)); }

 private:
  world::ProgramCoverage coverage_;
  std::vector<world::ProgramSource> sources_;
  CoverageFile& file_;
};

/// "3 of 4 lines (75.0 %)".
std::string share_text(std::int64_t part, std::int64_t all, const char* what) {
  char percent[32];
  std::snprintf(percent, sizeof percent, "%.1f",
                all == 0 ? 100.0 : 100.0 * static_cast<double>(part) / static_cast<double>(all));
  return std::to_string(part) + " of " + std::to_string(all) + " " + what + " (" + percent + " %)";
}

}  // namespace

void require_coverage(FileClaims& claims, const CoverageWish& wish) {
  const bool is_known = wish.path.ends_with(".info") || is_xml(wish.path);
  if (!wish.path.empty() && !is_known) {
    throw UsageError("--coverage: " + wish.path +
                     " is not a kind of coverage; expected FILE.info (lcov) or FILE.xml (Cobertura)");
  }
  if (wish.min_percent && !(*wish.min_percent >= 0 && *wish.min_percent <= 100)) {
    throw UsageError("--coverage-min: expected a percentage, 0 to 100");
  }
  require_output(claims, "--coverage", wish.path);
}

CoverageFile::CoverageFile(const CoverageWish& wish)
    : wish_(wish), file_("--coverage", wish.path, ContentKind::coverage) {}

void CoverageFile::add(const world::CoverageReport& report) {
  const std::lock_guard lock(mutex_);
  report_.add(report);
}

play::ObserverMaker CoverageFile::observer(const play::Scenario& scenario) {
  return [this, sources = sources_of(scenario)](world::World& world) {
    return std::make_unique<CoverageObserver>(world, sources, *this);
  };
}

bool CoverageFile::write(std::FILE* told) {
  const world::CoverageTotals totals = report_.totals();
  if (file_.is_wanted()) {
    const std::filesystem::path folder = std::filesystem::path(wish_.path).parent_path();
    world::CoverageReport placed;
    for (auto& [path, file] : report_.files) {
      const std::string place = file.listing.empty() ? path : (folder / path).string();
      const bool is_new = !file.listing.empty() && read_text_file(place).value_or("") != file.listing;
      const std::string why = is_new ? replace_text_file(place, file.listing, ContentKind::other) : "";
      if (!why.empty()) throw GrowingFileError("--coverage: " + place + " cannot be written: " + why);
      placed.files.emplace(place, std::move(file));
    }
    file_.write(is_xml(wish_.path) ? world::cobertura_text(placed) : world::lcov_text(placed));
  }
  std::string line = "coverage of programs: " + share_text(totals.lines_run, totals.lines, "lines") + ", " +
                     share_text(totals.branches_taken, totals.branches, "branches");
  const bool is_enough = !wish_.min_percent || totals.line_percent() >= *wish_.min_percent;
  if (!is_enough) {
    char least[32];
    std::snprintf(least, sizeof least, "%g", *wish_.min_percent);
    line += std::string("; expected at least ") + least + " % of the lines";
  }
  std::fprintf(told, "%s\n", line.c_str());
  return is_enough;
}

ServedCoverage::ServedCoverage(const std::string& path, world::World& world)
    : file_({.path = path, .min_percent = {}}) {
  if (file_.is_wanted()) counts_ = std::make_unique<world::ProgramCoverage>(world);
}

void ServedCoverage::write() {
  if (counts_ == nullptr) return;
  file_.add(counts_->report());
  file_.write(stderr);
}

}  // namespace understudy::emulator::command_line
