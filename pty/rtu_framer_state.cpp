// A framer's state as a value: saved, checked, restored. The structured binding names every member, so that
// one that is added and forgotten here does not compile.
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "pty/rtu_framer.h"
#include "pty/state_reach.h"

namespace understudy::pty {

RtuFramer::State RtuFramer::save() const {
  const auto& [framing, values, marks, ready, ready_first, ready_count, used, undecided, candidate,
               look_again_at, oversize, last_end, character_under_way, dropped, errors, error_count] = *this;
  State state{.characters = {},
              .ready = {},
              .undecided = static_cast<std::uint16_t>(undecided),
              .candidate = static_cast<std::uint16_t>(candidate),
              .look_again_at = static_cast<std::uint16_t>(look_again_at),
              .oversize = oversize,
              .last_end = last_end,
              .character_under_way = character_under_way,
              .dropped = dropped};
  // What was served, or dropped, before the first that matters may lie there or not: it is left out.
  const std::size_t begin = ready_count > 0 ? ready[ready_first].first : undecided;
  for (std::size_t i = begin; i < used; ++i) {
    state.characters.push_back({.value = values[i], .end = marks[i].end, .number = marks[i].number});
  }
  for (std::size_t i = 0; i < ready_count; ++i) {
    const Ready& frame = ready[(ready_first + i) % kMaxReady];
    state.ready.push_back({.first = static_cast<std::uint16_t>(frame.first - begin), .size = frame.size});
  }
  for (std::uint16_t* index : {&state.undecided, &state.candidate}) {
    *index = static_cast<std::uint16_t>(*index - begin);
  }
  return state;
}

void RtuFramer::check(const State& state) const {
  const auto demand = [](bool holds) {
    if (!holds) throw std::invalid_argument("a framer cannot hold such characters");
  };
  constexpr std::uint16_t kShortest = 4;
  const std::size_t used = state.characters.size();
  const std::size_t longest = framing_.strict ? kRtuMaxFrame : 2 * kRtuMaxFrame;
  demand(used <= kCapacity && state.ready.size() <= kMaxReady);
  demand(state.undecided <= state.candidate && state.candidate <= used);
  demand(used - state.undecided <= longest && state.look_again_at <= kRtuMaxFrame + 1);
  std::size_t free_from = 0;
  for (const State::Frame& frame : state.ready) {
    demand(frame.first >= free_from && frame.size >= kShortest && frame.size <= kRtuMaxFrame);
    free_from = std::size_t{frame.first} + frame.size;
  }
  demand(free_from <= state.undecided);
  for (const State::Character& character : state.characters) demand(is_within_reach(character.end));
  demand(is_within_reach(state.last_end));
}

void RtuFramer::restore(const State& state) {
  check(state);
  used_ = state.characters.size();
  for (std::size_t i = 0; i < used_; ++i) {
    values_[i] = state.characters[i].value;
    marks_[i] = {.end = state.characters[i].end, .number = state.characters[i].number};
  }
  ready_first_ = 0;
  ready_count_ = state.ready.size();
  for (std::size_t i = 0; i < ready_count_; ++i) {
    ready_[i] = {.first = state.ready[i].first, .size = state.ready[i].size};
  }
  undecided_ = state.undecided;
  candidate_ = state.candidate;
  look_again_at_ = state.look_again_at;
  oversize_ = state.oversize;
  last_end_ = state.last_end;
  character_under_way_ = state.character_under_way;
  dropped_ = state.dropped;
  errors_ = {};
  error_count_ = 0;
}

}  // namespace understudy::pty
