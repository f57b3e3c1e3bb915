// The file of `--coverage`: which lines of the downloaded programs have run, summed over all runs.
#pragma once

#include <cstdio>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "base/files/file_claims.h"
#include "emulator/command_line/result_file.h"
#include "emulator/play/performing/observer.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/coverage/coverage_report.h"
#include "emulator/world/coverage/program_coverage.h"
#include "emulator/world/world.h"

namespace understudy::emulator::command_line {

/// What a command is asked for. An empty path: no file; no minimum: any coverage will do.
struct CoverageWish {
  std::string path;
  std::optional<double> min_percent;

  bool is_wanted() const { return !path.empty() || min_percent; }
};

/// Claims the file. Throws UsageError for a path that is no kind of coverage, and for a minimum that is no
/// percentage.
void require_coverage(FileClaims& claims, const CoverageWish& wish);

class CoverageFile {
 public:
  /// Opens the file. Throws GrowingFileError.
  explicit CoverageFile(const CoverageWish& wish);

  bool is_wanted() const { return wish_.is_wanted(); }
  /// Empties the file, so that its old content is not mistaken for the result of a run that breaks off.
  void empty() { file_.empty(); }
  /// Adds the counts of a run. May be called on any thread.
  void add(const world::CoverageReport& report);
  /// Returns an onlooker that adds the counts of a scenario's run.
  play::ObserverMaker observer(const play::Scenario& scenario);
  /// Writes the file, and beside it the listings of programs that have no file of their own. Prints what has
  /// run. Returns false if that is less than the minimum.
  bool write(std::FILE* told);

 private:
  const CoverageWish wish_;
  ResultFile file_;
  std::mutex mutex_;
  world::CoverageReport report_;
};

/// The same of a world that is served.
class ServedCoverage {
 public:
  /// Counts from this moment on, unless the path is empty. Throws GrowingFileError.
  ServedCoverage(const std::string& path, world::World& world);

  /// Writes the file, if there is one.
  void write();

 private:
  CoverageFile file_;
  std::unique_ptr<world::ProgramCoverage> counts_;  // null: nobody has asked for it
};

}  // namespace understudy::emulator::command_line
