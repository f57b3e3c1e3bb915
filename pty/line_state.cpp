// Checks and restores a line's state.
#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include "base/queue.h"
#include "pty/line.h"
#include "pty/line_settings.h"
#include "pty/state_reach.h"
#include "pty/station.h"

namespace understudy::pty {

void Line::check(const State& state) const {
  const auto require = [this](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument("line " + name_ + ": " + what);
  };
  require(state.members.size() == stations_.size(), "its stations are different");
  const LineSettings& settings = state.settings;
  require(settings.baud > 0 && settings.baud <= 10'000'000 && settings.data_bits >= 5 &&
              settings.data_bits <= 8 && settings.stop_bits >= 1 && settings.stop_bits <= 2,
          "its settings are not valid for a line");
  require(state.input.size() <= kInputCapacity && state.edge.output.size() <= kOutputCapacity,
          "more bytes are waiting than it can hold");
  const auto require_burst = [&](const Burst& burst) {
    require(is_within_reach(burst.start) && is_within_reach(burst.end) && burst.count >= 0 &&
                burst.count < settings.baud,
            "its characters have impossible times");
  };
  require_burst(state.arriving);
  for (const Member& member : state.members) {
    require_burst(member.transmission);
    require(is_within_reach(member.noticed_at.value_or(SimTime{0})), "its characters have impossible times");
  }
  const auto require_characters = [&](const Queue<TimedByte>& characters) {
    for (const TimedByte& character : characters) {
      require(is_within_reach(character.start) && is_within_reach(character.end),
              "its characters have impossible times");
    }
  };
  require_characters(state.input);
  require_characters(state.leaving);
  require(state.lump.size() < kLump && state.lump.empty() != state.lump_at.has_value() &&
              state.adapter.latency >= SimTime{0} && is_within_reach(state.adapter.latency) &&
              is_within_reach(state.lump_at.value_or(SimTime{0})),
          "its adapter cannot hold these bytes back");
  require(is_within_reach(state.edge.clock), "its clock is after the end of simulated time");
}

void Line::restore(const State& state) {
  due_changed();
  check(state);
  state_ = state;
  notices_ = static_cast<std::size_t>(std::ranges::count_if(
      state_.members, [](const Member& member) { return member.noticed_at.has_value(); }));
}

}  // namespace understudy::pty
