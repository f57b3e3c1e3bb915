// Many scenarios at once: which of them, on how many threads. Worlds share nothing, so the results, and the
// order in which they are told, do not depend on that.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/play/performing/runner.h"

namespace understudy::emulator::play {

/// Which part of a suite: the first, and each `of`th after it, for number 1.
struct Shard {
  std::size_t number = 1;
  std::size_t of = 1;
};
/// "2/4"; nothing if it is not that.
std::optional<Shard> parse_shard(std::string_view text);

/// Those whose name fits the pattern (`*`, `?`, `[abc]`; an empty one fits all), and of those a shard. The
/// order stays as it is.
std::vector<Scenario> choose(std::vector<Scenario> scenarios, const std::string& pattern, Shard shard);

/// How a scenario is to be played. It is asked on the threads that play.
using OptionsFor = std::function<PlayOptions(const Scenario&)>;

/// Plays all on `jobs` threads. `tell` gets the results of each scenario, in their order, on the thread that
/// calls. What play() throws comes out here, after the results of all scenarios before that one.
void play_all(std::span<const Scenario> scenarios, const OptionsFor& options_for, int jobs,
              const std::function<void(const std::vector<ScenarioResult>&)>& tell);

}  // namespace understudy::emulator::play
