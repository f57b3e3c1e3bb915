// Groups failures by kind: a thousand cases that fail for the same reason need to be examined only once. Two
// failures are of the same kind if the same step failed with the same words, ignoring numbers and bytes.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "emulator/play/results/result.h"

namespace understudy::emulator::play {

/// Returns "grid.yaml:17: feeder.Cord_A is #; expected #", or an empty text if the scenario did not fail.
std::string kind_of_failure(const ScenarioResult& result);

class FailureKinds {
 public:
  static constexpr std::size_t kMax = 1000;  // failures of further kinds are counted but not distinguished

  struct Kind {
    std::string text;
    std::string first;  // the name of the first case of this kind
    std::uint64_t count = 0;
    std::uint64_t varied = 0;  // how many of these are cases from `vary`
  };

  /// Counts a failure and returns its kind, or null if there are already too many kinds.
  const Kind* add(const ScenarioResult& result);
  /// Returns the kinds in the order of their first failures.
  const std::vector<Kind>& all() const { return kinds_; }
  std::uint64_t others() const { return others_; }

 private:
  std::vector<Kind> kinds_;
  std::unordered_map<std::string, std::size_t> numbers_;
  std::uint64_t others_ = 0;
};

}  // namespace understudy::emulator::play
