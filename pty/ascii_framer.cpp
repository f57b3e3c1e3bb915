#include "pty/ascii_framer.h"

#include <cctype>
#include <optional>
#include <stdexcept>
#include <utility>

#include "pty/ascii_frame.h"
#include "pty/state_reach.h"
#include "pty/station.h"

namespace understudy::pty {

std::optional<AsciiFrame> AsciiFramer::push(const TimedByte& byte) {
  auto& characters = state_.characters;
  const bool is_late = !characters.empty() && byte.start - state_.last_end > patience_;
  if (is_late || byte.value == ':') give_up_waiting();
  state_.last_end = byte.end;
  if (byte.value != ':' && characters.empty()) {
    ++state_.dropped;
    return std::nullopt;
  }
  const bool is_end = !characters.empty() && characters.back() == '\r' && byte.value == '\n';
  const bool may_follow =
      characters.empty() || is_end ||
      (characters.back() != '\r' && (byte.value == '\r' || std::isxdigit(byte.value) != 0));
  characters.push_back(byte.value);
  if (!may_follow || characters.size() > kAsciiMaxFrame) {
    give_up_waiting();
    return std::nullopt;
  }
  if (!is_end) return std::nullopt;
  auto rtu = rtu_of_ascii(characters);
  if (!rtu) {
    give_up_waiting();
    return std::nullopt;
  }
  return AsciiFrame{.bytes = std::exchange(characters, {}),
                    .rtu = *std::move(rtu),
                    .end = byte.end,
                    .last_character = byte.number};
}

void AsciiFramer::reset() { state_.characters.clear(); }

void AsciiFramer::give_up_waiting() {
  state_.dropped += state_.characters.size();
  state_.characters.clear();
}

void AsciiFramer::check(const State& state) {
  const bool is_beginning = state.characters.empty() || state.characters.front() == ':';
  if (!is_beginning || state.characters.size() >= kAsciiMaxFrame || !is_within_reach(state.last_end))
    throw std::invalid_argument("no Modbus ASCII frame begins like this");
}

void AsciiFramer::restore(const State& state) {
  check(state);
  state_ = state;
}

}  // namespace understudy::pty
