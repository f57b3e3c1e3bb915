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
#include "base/files/file_error.h"
#include "base/files/growing_file.h"
#include "base/files/text_file.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/output_paths.h"
#include "emulator/play/performing/observer.h"
#include "emulator/play/report/coverage_page.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/coverage/coverage_report.h"
#include "emulator/world/coverage/program_coverage.h"
#include "emulator/world/coverage/tracefile.h"
#include "emulator/world/world.h"

namespace understudy::emulator::command_line {

namespace {

bool is_xml(const std::string& path) { return path.ends_with(".xml"); }
bool is_page(const std::string& path) { return path.ends_with(".html"); }

/// Returns the files that a scenario reads and that may contain programs.
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
  void world_restored(std::size_t /*steps*/) override {}  // executed lines stay covered
  void finish(play::ScenarioResult& /*result*/) override { file_.add(coverage_.report(sources_)); }

 private:
  world::ProgramCoverage coverage_;
  std::vector<world::ProgramSource> sources_;
  CoverageFile& file_;
};

}  // namespace

void require_coverage(FileClaims& claims, const CoverageWish& wish, const std::string& flag) {
  const bool is_known = wish.path.ends_with(".info") || is_xml(wish.path) || is_page(wish.path);
  if (!wish.path.empty() && !is_known) {
    throw UsageError(flag + ": " + wish.path +
                     " has an unknown format; expected FILE.info (lcov), FILE.xml (Cobertura) or "
                     "FILE.html (a page)");
  }
  if (wish.min_percent && !(*wish.min_percent >= 0 && *wish.min_percent <= 100)) {
    throw UsageError("--coverage-min: expected a percentage, 0 to 100");
  }
  require_output(claims, flag, wish.path);
}

CoverageFile::CoverageFile(const CoverageWish& wish, const char* flag)
    : wish_(wish),
      flag_(flag),
      file_(flag, wish.path, is_page(wish.path) ? ContentKind::page : ContentKind::coverage) {}

void CoverageFile::add(const world::CoverageReport& report) {
  const std::lock_guard lock(mutex_);
  report_.add(report);
}

play::ObserverMaker CoverageFile::observer(const play::Scenario& scenario) {
  return [this, sources = sources_of(scenario)](world::World& world) {
    return std::make_unique<CoverageObserver>(world, sources, *this);
  };
}

void CoverageFile::write_listings() {
  const std::filesystem::path folder = std::filesystem::path(wish_.path).parent_path();
  world::CoverageReport placed;
  for (auto& [path, file] : report_.files) {
    const std::string place = file.listing.empty() ? path : (folder / path).string();
    const bool is_new = !file.listing.empty() && read_text_file(place).value_or("") != file.listing;
    const std::string why = is_new ? replace_text_file(place, file.listing, ContentKind::other) : "";
    if (!why.empty())
      throw GrowingFileError(std::string(flag_) + ": " + place + " cannot be written: " + why);
    placed.files.emplace(place, std::move(file));
  }
  report_ = std::move(placed);
}

bool CoverageFile::write(std::FILE* out) {
  if (file_.is_wanted()) {
    write_listings();
    file_.write(is_xml(wish_.path)    ? world::cobertura_text(report_)
                : is_page(wish_.path) ? play::coverage_page(report_, wish_.version)
                                      : world::lcov_text(report_));
  }
  const world::CoverageTotals totals = report_.totals();
  std::string line = "coverage of programs: " + play::coverage_text(totals);
  const bool is_enough = !wish_.min_percent || totals.line_percent() >= *wish_.min_percent;
  if (!is_enough) {
    char min[32];
    std::snprintf(min, sizeof min, "%g", *wish_.min_percent);
    line += std::string("; expected at least ") + min + " % of the lines";
  }
  std::fprintf(out, "%s\n", line.c_str());
  return is_enough;
}

CoverageWish coverage_of(const RunArguments& arguments) {
  return {.path = arguments.coverage, .min_percent = arguments.coverage_min, .version = arguments.version};
}

RunCoverage::RunCoverage(const RunArguments& arguments)
    : programs(coverage_of(arguments)), devices(arguments.device_coverage, arguments.version) {}

void RunCoverage::empty() {
  programs.empty();
  devices.empty();
}

std::vector<play::ObserverMaker> RunCoverage::observers(const play::Scenario& scenario) {
  std::vector<play::ObserverMaker> makers;
  if (programs.is_wanted()) makers.push_back(programs.observer(scenario));
  if (devices.is_wanted()) makers.push_back(devices.observer());
  return makers;
}

bool RunCoverage::write(std::FILE* out) {
  const bool is_enough = !programs.is_wanted() || programs.write(out);
  if (devices.is_wanted()) devices.write(out);
  return is_enough;
}

std::string RunCoverage::section() const {
  return programs.is_wanted() ? play::coverage_section(programs.report()) : "";
}

ServedCoverage::ServedCoverage(const ServeArguments& arguments, serve::Daemon& daemon)
    : file_({.path = arguments.coverage, .min_percent = {}, .version = arguments.version}),
      devices_file_(arguments.device_coverage, arguments.version) {
  if (devices_file_.is_wanted()) devices_ = std::make_unique<world::ControllerCoverage>(daemon.world());
  if (!file_.is_wanted()) return;
  counts_ = std::make_unique<world::ProgramCoverage>(daemon.world());
  daemon.observers().count_lines(daemon.world());
}

void ServedCoverage::write() {
  if (counts_ != nullptr) {
    file_.add(counts_->report());
    file_.write(stderr);
  }
  if (devices_ != nullptr) {
    devices_file_.add(devices_->report());
    devices_file_.write(stderr);
  }
}

int add_coverage(const CoverageArguments& arguments) {
  const CoverageWish wish{
      .path = arguments.output, .min_percent = arguments.min_percent, .version = arguments.version};
  FileClaims claims;
  for (const std::string& file : arguments.files) claims.add({file, "a file to add"});
  require_coverage(claims, wish, "--output");
  std::vector<world::CoverageReport> reports;  // all files are read before the output is opened
  for (const std::string& path : arguments.files) {
    const FileText text = read_text_file(path);
    if (!text) throw FileError(path + ": " + text.why + "; expected a tracefile (FILE.info)");
    if (const std::string why = is_another_kind(*text, ContentKind::coverage); !why.empty()) {
      throw FileError(path + ": " + why);
    }
    reports.push_back(world::read_tracefile(*text, path));
  }
  CoverageFile sum(wish, "--output");
  for (const world::CoverageReport& report : reports) sum.add(report);
  return sum.write(stdout) ? kExitWell : kExitFailed;
}

}  // namespace understudy::emulator::command_line
