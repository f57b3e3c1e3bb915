// Plays many scenarios: which of them, and on how many threads. Worlds share nothing, so neither the results
// nor their order depend on the threads.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/play/performing/run.h"

namespace understudy::emulator::play {

/// Which part of a suite: the first, and each `of`th after it, for number 1.
struct Shard {
  std::size_t number = 1;
  std::size_t of = 1;
};
/// Reads "2/4"; nothing if the text is something else.
std::optional<Shard> parse_shard(std::string_view text);

/// Those whose names match the pattern (`*`, `?`, `[abc]`; an empty one matches all), and of those one shard,
/// in the same order.
std::vector<Scenario> choose(std::vector<Scenario> scenarios, const std::string& pattern, Shard shard);

/// How a scenario is to be played. Called on the threads that play.
using OptionsFor = std::function<RunOptions(const Scenario&)>;

/// Plays all on `jobs` threads. `tell` gets the results of each scenario, in order, on the calling thread.
/// What run_scenario() throws comes out here, after the results of all scenarios before that one.
void run_suite(std::span<const Scenario> scenarios, const OptionsFor& options_for, int jobs,
               const std::function<void(const std::vector<ScenarioResult>&)>& tell);

}  // namespace understudy::emulator::play
