// The file of `--coverage`: which lines of the downloaded programs have run, as a total of all runs.
#pragma once

#include <cstdio>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/files/file_claims.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/device_coverage_file.h"
#include "emulator/command_line/result_file.h"
#include "emulator/play/performing/observer.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/coverage/controller_coverage.h"
#include "emulator/world/coverage/coverage_report.h"
#include "emulator/world/coverage/program_coverage.h"

namespace understudy::emulator::command_line {

/// The coverage options of a command. Empty path: no file; no minimum: any coverage passes.
struct CoverageWish {
  std::string path;
  std::optional<double> min_percent;
  std::string version{};  // the version of this program, for a page

  bool is_wanted() const { return !path.empty() || min_percent; }
};

/// Claims the file. Throws UsageError if the path does not end like a coverage file, or if the minimum is not
/// a percentage. `flag` is used in messages.
void require_coverage(FileClaims& claims, const CoverageWish& wish, const std::string& flag = "--coverage");

class CoverageFile {
 public:
  /// Opens the file. Throws GrowingFileError.
  explicit CoverageFile(const CoverageWish& wish, const char* flag = "--coverage");

  bool is_wanted() const { return wish_.is_wanted(); }
  /// Empties the file, so that its old content is not mistaken for the result of an interrupted run.
  void empty() { file_.empty(); }
  /// Adds the counts of a run. May be called on any thread.
  void add(const world::CoverageReport& report);
  /// Returns an observer that adds the counts of a scenario's run.
  play::ObserverMaker observer(const play::Scenario& scenario);
  /// Writes the file, and next to it the listings of programs that have no file. Prints the coverage. Returns
  /// false if it is below the minimum.
  bool write(std::FILE* out);
  /// Returns the content of the written file.
  const world::CoverageReport& report() const { return report_; }

 private:
  void write_listings();

  const CoverageWish wish_;
  const char* flag_;
  ResultFile file_;
  std::mutex mutex_;
  world::CoverageReport report_;
};

/// Both kinds of coverage of a run.
struct RunCoverage {
  explicit RunCoverage(const RunArguments& arguments);

  bool is_wanted() const { return programs.is_wanted() || devices.is_wanted(); }
  void empty();
  /// Returns observers that add the counts of a scenario's run.
  std::vector<play::ObserverMaker> observers(const play::Scenario& scenario);
  /// Returns false if the coverage is below the minimum.
  bool write(std::FILE* out);
  /// Returns the coverage of programs as a section of a page; empty if coverage was not requested.
  std::string section() const;

  CoverageFile programs;
  DeviceCoverageFile devices;
};
/// Returns the coverage options in the flags of a run.
CoverageWish coverage_of(const RunArguments& arguments);

/// Both kinds of coverage of a served world.
class ServedCoverage {
 public:
  /// Counts from now on, unless the path is empty. The control socket has a separate count, because its
  /// clients may restart it. Throws GrowingFileError.
  ServedCoverage(const ServeArguments& arguments, serve::Daemon& daemon);

  /// Writes the requested files.
  void write();

 private:
  CoverageFile file_;
  DeviceCoverageFile devices_file_;
  std::unique_ptr<world::ProgramCoverage> counts_;  // null: coverage was not requested
  std::unique_ptr<world::ControllerCoverage> devices_;
};

}  // namespace understudy::emulator::command_line
