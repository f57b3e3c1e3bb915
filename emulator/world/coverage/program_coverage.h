// Counts which lines of the devices' programs run, and how their decisions end. It only observes: nothing in
// the world depends on it, and restoring a snapshot does not restore the counts.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "emulator/world/coverage/coverage_report.h"

namespace understudy::emulator::world {

class World;

/// A file whose program a device may run.
struct ProgramSource {
  std::string path;
  std::string text;
};

class ProgramCoverage {
 public:
  /// Starts counting. The world must outlive this object.
  explicit ProgramCoverage(World& world);
  ~ProgramCoverage();
  ProgramCoverage(const ProgramCoverage&) = delete;
  ProgramCoverage& operator=(const ProgramCoverage&) = delete;

  /// Returns the counts of all programs, or of one device's programs. Each part of a program belongs to the
  /// files with the same instructions, among those in `sources` and those of the bench. If there is no such
  /// file, it belongs to the listing that is read from the device.
  CoverageReport report(const std::vector<ProgramSource>& sources = {}) const;
  CoverageReport report_of(std::size_t device, const std::vector<ProgramSource>& sources = {}) const;
  /// Returns the counts of a device's instructions, by the first word of their code.
  std::map<std::string, CoveredLine> by_first_word(std::size_t device) const;

 private:
  class DeviceCounts;
  std::vector<std::unique_ptr<DeviceCounts>> devices_;  // null for devices without programs
};

}  // namespace understudy::emulator::world
