// Checks and restores a framer's state.
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "pty/rtu_framer.h"
#include "pty/state_reach.h"

namespace understudy::pty {

void RtuFramer::check(const State& state) const {
  const auto require = [](bool holds) {
    if (!holds) throw std::invalid_argument("a framer cannot contain these characters");
  };
  constexpr std::uint16_t kShortest = 4;
  const std::size_t used = state.characters.size();
  const std::size_t longest = framing_.strict ? kRtuMaxFrame : 2 * kRtuMaxFrame;
  require(used <= kCapacity && state.characters.marks.size() == used);
  require(state.undecided <= state.candidate && state.candidate <= used);
  require(used - state.undecided <= longest && state.search_again_at <= kRtuMaxFrame + 1);
  require(state.resumed <= used && (!state.is_paused || state.undecided < used));
  std::size_t free_from = 0;
  for (const Frame& frame : state.ready) {
    require(frame.first >= free_from && frame.size >= kShortest && frame.size <= kRtuMaxFrame);
    free_from = std::size_t{frame.first} + frame.size;
  }
  require(free_from <= state.undecided);
  for (const Mark& mark : state.characters.marks) require(is_within_reach(mark.end));
  require(is_within_reach(state.last_end));
}

void RtuFramer::restore(const State& state) {
  check(state);
  state_ = state;
  forget_served();
  errors_ = {};
  error_count_ = 0;
}

}  // namespace understudy::pty
