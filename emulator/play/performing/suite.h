// Runs many cases on several threads. Worlds share nothing, so neither the results nor their order depend on
// the threads. Only the running cases and a few finished cases are in memory, so the number of cases is not
// limited.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "emulator/play/results/result.h"

namespace understudy::emulator::play {

/// Identifies a case in a file of a case list.
struct CaseId {
  std::size_t file = 0;
  std::uint64_t number = 0;
  friend bool operator==(const CaseId&, const CaseId&) = default;
};

/// Returns the next case to run, or nothing if there is none. It may be called on any thread, but only one
/// call at a time.
using NextCase = std::function<std::optional<CaseId>()>;
/// Runs a case.
using Play = std::function<std::vector<ScenarioResult>(const CaseId&)>;

/// Runs all cases on `jobs` threads. Each thread creates its own Play. `report` receives the results of each
/// case, in order, on the calling thread. If a Play throws an exception, the exception is thrown here, after
/// the results of all earlier cases were reported.
void run_suite(const NextCase& next, const std::function<Play()>& make_play, int jobs,
               const std::function<void(const CaseId&, std::vector<ScenarioResult>)>& report);

}  // namespace understudy::emulator::play
