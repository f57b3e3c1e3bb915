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
    const auto what = character == kXoff ? HeardText::What::hold : HeardText::What::go_on;
    outcome.heard = HeardText{.what = what, .end = byte.end, .last_character = byte.number};
    return outcome;
  }
  const bool is_behind_return = std::exchange(was_return_, character == '\r');
  if (character == '\n' && !rules.line_feed_ends) return outcome;
  const auto hear = [&](HeardText::What what) {
    outcome.heard = HeardText{
        .what = what, .text = std::exchange(text_, {}), .end = byte.end, .last_character = byte.number};
    is_overlong_ = false;
  };

  if (character == '\r' || character == '\n') {
    const bool is_empty = text_.empty() && !is_overlong_;
    if (character == '\n' && (is_behind_return || is_empty)) return outcome;
    hear(is_overlong_ ? HeardText::What::overlong : HeardText::What::line);
    outcome.echo = rules.echoed_end;
    return outcome;
  }
  if (character == kEscape) {
    dropped_ += std::exchange(text_, {}).size();
    hear(HeardText::What::escape);
    return outcome;
  }
  if (rules.echoes && (character == kBackspace || character == kDelete)) {
    if (text_.empty()) return outcome;
    text_.pop_back();
    outcome.echo = "\b \b";
    return outcome;
  }
  outcome.echo = character;
  if (is_overlong_ || text_.size() >= std::min(rules.longest, kLongest)) {
    dropped_ += 1 + std::exchange(text_, {}).size();
    is_overlong_ = true;
  } else {
    text_ += character;
  }
  return outcome;
}

void TextLines::reset() {
  text_.clear();
  is_overlong_ = was_return_ = false;
}

TextLines::State TextLines::save() const {
  const auto& [text, is_overlong, was_return, dropped] = *this;
  return {.text = text, .is_overlong = is_overlong, .was_return = was_return, .dropped = dropped};
}

void TextLines::check(const State& state) {
  const bool has_end = state.text.find_first_of("\r\n") != std::string::npos;
  const bool holds = state.text.size() <= kLongest && !has_end &&
                     (state.text.empty() || (!state.is_overlong && !state.was_return));
  if (!holds) throw std::invalid_argument("this is not a state of a text line");
}

void TextLines::restore(const State& state) {
  check(state);
  text_ = state.text;
  is_overlong_ = state.is_overlong;
  was_return_ = state.was_return;
  dropped_ = state.dropped;
}

}  // namespace understudy::pty
