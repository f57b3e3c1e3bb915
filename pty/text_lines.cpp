#include "pty/text_lines.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "pty/station.h"

namespace understudy::pty {

namespace {

constexpr char kBackspace = '\b';
constexpr char kDelete = '\x7F';
constexpr char kEscape = '\x1B';
constexpr char kXon = '\x11';
constexpr char kXoff = '\x13';

}  // namespace

TextLines::Outcome TextLines::push(const TimedByte& byte, const TextLineRules& rules) {
  const auto character = static_cast<char>(byte.value);
  Outcome outcome;
  if (rules.has_flow_control && (character == kXon || character == kXoff)) {
    const auto what = character == kXoff ? ReceivedText::What::hold : ReceivedText::What::release;
    outcome.received = ReceivedText{.what = what, .end = byte.end, .last_character = byte.number};
    return outcome;
  }
  const bool is_behind_return = std::exchange(state_.was_return, character == '\r');
  if (character == '\n' && !rules.line_feed_ends) return outcome;
  const auto report = [&](ReceivedText::What what) {
    outcome.received = ReceivedText{
        .what = what, .text = std::exchange(state_.text, {}), .end = byte.end, .last_character = byte.number};
    state_.is_overlong = false;
  };

  if (character == '\r' || character == '\n') {
    const bool is_empty = state_.text.empty() && !state_.is_overlong;
    if (character == '\n' && (is_behind_return || is_empty)) return outcome;
    report(state_.is_overlong ? ReceivedText::What::overlong : ReceivedText::What::line);
    outcome.echo = rules.echoed_end;
    return outcome;
  }
  if (character == kEscape) {
    state_.dropped += std::exchange(state_.text, {}).size();
    report(ReceivedText::What::escape);
    return outcome;
  }
  if (rules.echoes && (character == kBackspace || character == kDelete)) {
    if (state_.text.empty()) return outcome;
    state_.text.pop_back();
    outcome.echo = "\b \b";
    return outcome;
  }
  outcome.echo = character;
  if (state_.is_overlong || state_.text.size() >= std::min(rules.longest, kLongest)) {
    state_.dropped += 1 + std::exchange(state_.text, {}).size();
    state_.is_overlong = true;
  } else {
    state_.text += character;
  }
  return outcome;
}

void TextLines::reset() {
  state_.text.clear();
  state_.is_overlong = state_.was_return = false;
}

void TextLines::check(const State& state) {
  const bool has_end = state.text.find_first_of("\r\n") != std::string::npos;
  const bool holds = state.text.size() <= kLongest && !has_end &&
                     (state.text.empty() || (!state.is_overlong && !state.was_return));
  if (!holds) throw std::invalid_argument("this is not a state of a text line");
}

void TextLines::restore(const State& state) {
  check(state);
  state_ = state;
}

}  // namespace understudy::pty
