// Plays many cases, one after the other, on several threads. Worlds share nothing, so neither the results nor
// their order depend on the threads. Only the cases that are being played, and a few that are over, are held:
// there may be any number.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "emulator/play/results/result.h"

namespace understudy::emulator::play {

/// A case of a file of a playbill.
struct Ticket {
  std::size_t file = 0;
  std::uint64_t number = 0;
  friend bool operator==(const Ticket&, const Ticket&) = default;
};

/// The next case to play, or nothing. One call at a time, on any thread.
using NextTicket = std::function<std::optional<Ticket>()>;
/// Plays a case.
using Play = std::function<std::vector<ScenarioResult>(const Ticket&)>;

/// Plays all on `jobs` threads, each with a Play of its own, made on that thread. `tell` gets the results of
/// each case, in order, on the calling thread. What a Play throws comes out here, after the results of all
/// cases before that one.
void run_suite(const NextTicket& next, const std::function<Play()>& make_play, int jobs,
               const std::function<void(const Ticket&, std::vector<ScenarioResult>)>& tell);

}  // namespace understudy::emulator::play
