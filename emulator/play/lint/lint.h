// How the hosts on a world's lines behave: what works here, or only just works, and would go wrong with a
// real controller. It listens as long as it lives, and reports once, at the end.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "emulator/play/lint/line_manners.h"
#include "emulator/play/performing/onlooker.h"

namespace understudy::emulator::play {

class Lint final : public Onlooker {
 public:
  /// The world must outlive it.
  explicit Lint(world::World& world);

  /// A line of text for each finding, with its count and its first moment, in the order of the bench's lines;
  /// none if all is well.
  std::vector<std::string> findings() const;

  void world_restored(std::size_t steps) override;
  /// Into ScenarioResult::manners.
  void finish(ScenarioResult& result) override { result.manners = findings(); }

 private:
  world::World& world_;
  std::vector<std::unique_ptr<LineManners>> lines_;
};

}  // namespace understudy::emulator::play
