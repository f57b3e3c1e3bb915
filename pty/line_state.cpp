// A line's state as a value: saved, checked, restored. The structured bindings name every member, so that one
// that is added and forgotten here does not compile.
#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "pty/line.h"
#include "pty/line_settings.h"
#include "pty/state_reach.h"
#include "pty/station.h"

namespace understudy::pty {

Line::State Line::save() const {
  const auto& [name, options, warn, counters, members, observers, clock, next, is_host_open, host_settings,
               departed_settings, last_departed, last_received, has_warned_deaf, has_warned_no_speed,
               has_warned_collision, input, input_first, input_count, arriving, is_heard, leaving,
               leaving_first, notices, output, output_first] = *this;
  State state{.settings = options.settings,
              .members = {},
              .is_host_open = is_host_open,
              .host_settings = host_settings,
              .departed_settings = departed_settings,
              .last_departed = last_departed,
              .last_received = last_received,
              .has_warned = {has_warned_deaf, has_warned_no_speed, has_warned_collision},
              .input = {},
              .arriving = arriving,
              .is_heard = is_heard,
              .leaving = {leaving.begin() + static_cast<std::ptrdiff_t>(leaving_first), leaving.end()},
              .edge = {.output = {output.begin() + static_cast<std::ptrdiff_t>(output_first), output.end()},
                       .counters = counters,
                       .clock = clock}};
  for (const Member& member : members) {
    const auto& [station, is_deaf, speech, noticed_at] = member;
    state.members.push_back({.is_deaf = is_deaf, .speech = speech, .noticed_at = noticed_at});
  }
  for (std::size_t i = 0; i < input_count; ++i) {
    state.input.push_back(input[(input_first + i) % kInputCapacity]);
  }
  return state;
}

void Line::check(const State& state) const {
  const auto demand = [this](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument("line " + name_ + ": " + what);
  };
  demand(state.members.size() == members_.size(), "its stations are different");
  const LineSettings& settings = state.settings;
  demand(settings.baud > 0 && settings.baud <= 10'000'000 && settings.data_bits >= 5 &&
             settings.data_bits <= 8 && settings.stop_bits >= 1 && settings.stop_bits <= 2,
         "its settings are not those of a line");
  demand(state.input.size() <= kInputCapacity && state.edge.output.size() <= kOutputCapacity,
         "more bytes wait than it holds");
  const auto demand_burst = [&](const Burst& burst) {
    demand(is_within_reach(burst.start) && is_within_reach(burst.end) && burst.count >= 0 &&
               burst.count < settings.baud,
           "its characters take no time");
  };
  demand_burst(state.arriving);
  for (const State::Member& member : state.members) {
    demand_burst(member.speech);
    demand(is_within_reach(member.noticed_at.value_or(SimTime{0})), "its characters take no time");
  }
  const auto demand_characters = [&](const std::vector<TimedByte>& characters) {
    for (const TimedByte& character : characters) {
      demand(is_within_reach(character.start) && is_within_reach(character.end),
             "its characters take no time");
    }
  };
  demand_characters(state.input);
  demand_characters(state.leaving);
  demand(is_within_reach(state.edge.clock), "its clock is beyond the end of time");
}

void Line::restore(const State& state) {
  due_changed();
  check(state);
  options_.settings = state.settings;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    members_[i].is_deaf = state.members[i].is_deaf;
    members_[i].speech = state.members[i].speech;
    members_[i].noticed_at = state.members[i].noticed_at;
  }
  notices_ = static_cast<std::size_t>(
      std::count_if(members_.begin(), members_.end(), [](const Member& m) { return m.noticed_at; }));
  is_host_open_ = state.is_host_open;
  host_settings_ = state.host_settings;
  departed_settings_ = state.departed_settings;
  last_departed_ = state.last_departed;
  last_received_ = state.last_received;
  has_warned_deaf_ = state.has_warned[0];
  has_warned_no_speed_ = state.has_warned[1];
  has_warned_collision_ = state.has_warned[2];
  std::copy(state.input.begin(), state.input.end(), input_.begin());
  input_first_ = 0;
  input_count_ = state.input.size();
  arriving_ = state.arriving;
  is_heard_ = state.is_heard;
  leaving_.assign(state.leaving.begin(), state.leaving.end());
  leaving_first_ = 0;
  output_.assign(state.edge.output.begin(), state.edge.output.end());
  output_first_ = 0;
  counters_ = state.edge.counters;
  clock_ = state.edge.clock;
}

}  // namespace understudy::pty
