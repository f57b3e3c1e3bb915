// Checks how hosts behave on a world's lines. It finds behaviour that works here, perhaps only just, but
// would fail with a real controller. It observes for its whole lifetime, and reports once, at the end.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "emulator/play/lint/host_lint.h"
#include "emulator/play/performing/observer.h"

namespace understudy::emulator::play {

class Lint final : public Observer {
 public:
  /// The world must outlive this object.
  explicit Lint(world::World& world);

  /// Returns a line of text for each finding, with the number of occurrences and the time of the first one,
  /// in the order of the bench's lines. Empty if there are no findings.
  std::vector<std::string> findings() const;

  void world_restored(std::size_t steps) override;
  /// Sets ScenarioResult::lint_findings.
  void finish(ScenarioResult& result) override { result.lint_findings = findings(); }

 private:
  world::World& world_;
  std::vector<std::unique_ptr<HostLint>> lines_;
};

}  // namespace understudy::emulator::play
