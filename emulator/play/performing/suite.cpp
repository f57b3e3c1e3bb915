#include "emulator/play/performing/suite.h"

#include <fnmatch.h>

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "base/text/parse_integer.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::play {

namespace {

/// What the threads share.
class Board {
 public:
  explicit Board(std::span<const Scenario> scenarios) : scenarios_(scenarios), entries_(scenarios.size()) {}

  void work(const OptionsFor& options_for) {
    while (const auto number = take()) {
      Entry entry;
      try {
        entry.results = run_scenario(scenarios_[*number], options_for(scenarios_[*number]));
      } catch (...) {
        entry.error = std::current_exception();
      }
      put(*number, std::move(entry));
    }
  }

  /// Waits for that scenario.
  std::vector<ScenarioResult> results_of(std::size_t number) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return entries_[number].is_over; });
    if (entries_[number].error) std::rethrow_exception(entries_[number].error);
    return std::move(entries_[number].results);
  }

  /// Nobody begins another one.
  void stop() {
    const std::lock_guard lock(mutex_);
    next_ = entries_.size();
  }

 private:
  struct Entry {
    bool is_over = false;
    std::vector<ScenarioResult> results;
    std::exception_ptr error;
  };

  std::optional<std::size_t> take() {
    const std::lock_guard lock(mutex_);
    if (next_ >= entries_.size()) return std::nullopt;
    return next_++;
  }

  void put(std::size_t number, Entry entry) {
    const std::lock_guard lock(mutex_);
    entries_[number] = std::move(entry);
    entries_[number].is_over = true;
    changed_.notify_all();
  }

  std::span<const Scenario> scenarios_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Entry> entries_;
  std::size_t next_ = 0;
};

}  // namespace

std::optional<Shard> parse_shard(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const auto number = parse_integer(text.substr(0, slash));
  const auto of = parse_integer(text.substr(slash + 1));
  if (!number || !of || *number < 1 || *number > *of) return std::nullopt;
  return Shard{static_cast<std::size_t>(*number), static_cast<std::size_t>(*of)};
}

std::vector<Scenario> choose(std::vector<Scenario> scenarios, const std::string& pattern, Shard shard) {
  std::erase_if(scenarios, [&](const Scenario& scenario) {
    return !pattern.empty() && fnmatch(pattern.c_str(), scenario.name.c_str(), 0) != 0;
  });
  std::vector<Scenario> chosen;
  for (std::size_t i = shard.number - 1; i < scenarios.size(); i += shard.of) {
    chosen.push_back(std::move(scenarios[i]));
  }
  return chosen;
}

void run_suite(std::span<const Scenario> scenarios, const OptionsFor& options_for, int jobs,
               const std::function<void(const std::vector<ScenarioResult>&)>& tell) {
  Board board(scenarios);
  std::vector<std::jthread> threads;
  const std::size_t count = std::min(static_cast<std::size_t>(std::max(jobs, 1)), scenarios.size());
  const auto stop_at_end = [&board](void*) { board.stop(); };
  for (std::size_t i = 0; i < count; ++i) threads.emplace_back([&] { board.work(options_for); });
  // Also when something is thrown the threads are not left to play on.
  const std::unique_ptr<void, decltype(stop_at_end)> guard(&board, stop_at_end);
  for (std::size_t i = 0; i < scenarios.size(); ++i) tell(board.results_of(i));
}

}  // namespace understudy::emulator::play
