#include "pty/rtu_framer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "pty/line_settings.h"
#include "pty/receive_error.h"
#include "pty/rtu_crc.h"
#include "pty/station.h"

namespace understudy::pty {
namespace {

// A function's rule for the length of a request.
struct LengthRule {
  std::uint8_t fixed = 0;          // the number of bytes; with a byte count, of those it does not count
  std::uint8_t byte_count_at = 0;  // index of the byte count, 0 if there is none
  bool may_be_longer = false;      // other lengths are legal too, and only silence shows them
};

constexpr LengthRule rule_of(std::uint8_t function) {
  switch (function) {
    case 0x01:
    case 0x02:
    case 0x03:
    case 0x04:
    case 0x05:
    case 0x06: return {.fixed = 8};
    case 0x07:
    case 0x0B:
    case 0x0C:
    case 0x11: return {.fixed = 4};
    case 0x08: return {.fixed = 8, .may_be_longer = true};  // sub-function 0 echoes data of any length
    case 0x0F:
    case 0x10: return {.fixed = 9, .byte_count_at = 6};
    case 0x16: return {.fixed = 10};
    case 0x17: return {.fixed = 13, .byte_count_at = 10};
    case 0x18: return {.fixed = 6};
    case 0x2B: return {.fixed = 7, .may_be_longer = true};  // MEI type 14 has this length
    default: return {};
  }
}

enum class Fit {
  waiting,     // may still become a frame
  good,        // is a frame with a right checksum
  impossible,  // cannot become a frame
};

struct Verdict {
  Fit fit = Fit::waiting;
  std::uint16_t size = 0;  // good: size of the frame; waiting: number of bytes at which to check again
};

constexpr std::uint16_t kOnlySilenceTells = kRtuMaxFrame + 1;
constexpr std::size_t kShortestFrame = 4;  // address, function, checksum

/// Returns the error in complete characters that are not a frame.
ReceiveError error_in(std::span<const std::uint8_t> noise) {
  if (noise.size() > kRtuMaxFrame) return ReceiveError::overlong;
  if (noise.size() < kShortestFrame) return ReceiveError::cut_off;
  const LengthRule rule = rule_of(noise[1]);
  const bool lacks_count = rule.byte_count_at != 0 && noise.size() <= rule.byte_count_at;
  const std::optional<std::size_t> wanted = rtu_request_size(noise);
  const bool is_cut = lacks_count || (wanted && noise.size() < *wanted && *wanted <= kRtuMaxFrame);
  return is_cut ? ReceiveError::cut_off : ReceiveError::bad_checksum;
}

/// Checks a frame that would begin with the first of `bytes` (at least one). A length that only silence can
/// show is accepted for a frame that begins after a silence, never in the middle of noise.
Verdict judge(std::span<const std::uint8_t> bytes, bool is_in_noise) {
  if (bytes.size() < 2) return {Fit::waiting, 2};
  const std::uint8_t function = bytes[1];
  if (function == 0 || function >= 0x80) return {Fit::impossible, 0};  // no request has these
  const Verdict patient = is_in_noise || bytes.size() > kRtuMaxFrame
                              ? Verdict{Fit::impossible, 0}
                              : Verdict{Fit::waiting, kOnlySilenceTells};
  const LengthRule rule = rule_of(function);
  if (rule.fixed == 0) return patient;
  std::uint16_t size = rule.fixed;
  if (rule.byte_count_at != 0) {
    if (bytes.size() <= rule.byte_count_at)
      return {Fit::waiting, static_cast<std::uint16_t>(rule.byte_count_at + 1)};
    size += bytes[rule.byte_count_at];
    if (size > kRtuMaxFrame) return {Fit::impossible, 0};
  }
  if (bytes.size() < size) return {Fit::waiting, size};
  if (rtu_crc_ok(bytes.first(size))) return {Fit::good, size};
  return rule.may_be_longer ? patient : Verdict{Fit::impossible, 0};
}

}  // namespace

std::optional<std::size_t> rtu_request_size(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 2) return std::nullopt;
  const LengthRule rule = rule_of(bytes[1]);
  if (rule.fixed == 0 || bytes.size() <= rule.byte_count_at) return std::nullopt;
  return rule.fixed + (rule.byte_count_at != 0 ? bytes[rule.byte_count_at] : std::size_t{0});
}

RtuFramer::RtuFramer(RtuFraming framing) : framing_(framing) {}

SimTime RtuFramer::usual_patience() const {
  return framing_.strict ? framing_.silence : std::max(framing_.patience, framing_.silence);
}

SimTime RtuFramer::patience() const {
  return state_.is_paused ? std::max(framing_.rest_patience, usual_patience()) : usual_patience();
}

/// Returns true if, at `at`, the line has been quiet long enough to end the undecided part, or for the
/// silence to count as a pause in it.
bool RtuFramer::is_silent(SimTime at) const {
  return state_.undecided < used() && at >= state_.last_end + patience();
}

void RtuFramer::be_silent_until(SimTime at) {
  while (is_silent(at)) end_of_silence();
}

void RtuFramer::start_bit(SimTime at) {
  be_silent_until(at);
  state_.character_under_way = true;
}

void RtuFramer::push(const TimedByte& byte) {
  be_silent_until(byte.start);
  const bool is_lump_over =
      state_.oversize != 0 && state_.undecided == used() && byte.start >= state_.last_end + patience();
  if (is_lump_over) state_.oversize = 0;
  state_.character_under_way = false;
  state_.last_end = byte.end;
  if (framing_.strict && undecided().size == kRtuMaxFrame) {
    ++state_.oversize;
    return;
  }
  if (used() == kCapacity) drop_oldest();
  if (std::exchange(state_.is_paused, false)) state_.resumed = used();
  state_.characters.push_back({byte.value, byte.end, byte.number});
  if (!framing_.strict && used() - state_.candidate >= state_.search_again_at) search();
  if (state_.resumed != 0) check_after_pause();
}

void RtuFramer::reset() {
  state_.characters.clear();
  state_.ready.clear();
  state_.undecided = state_.candidate = state_.search_again_at = 0;
  state_.is_paused = false;
  state_.resumed = 0;
  state_.oversize = 0;
  state_.character_under_way = false;
}

void RtuFramer::give_up_waiting() {
  if (!framing_.strict && state_.undecided < used() && !state_.character_under_way) end_of_silence();
}

/// Advances the candidate as far as the received characters allow a decision.
void RtuFramer::search() {
  Index& candidate = state_.candidate;
  while (candidate < used()) {
    const Verdict verdict = judge(bytes(candidate, used()), candidate > state_.undecided);
    if (verdict.fit == Fit::waiting) {
      state_.search_again_at = verdict.size;
      // Characters before a candidate are kept because all of them may be one frame of unknown length. When
      // they are too long for that, they are given up, which bounds the undecided part.
      if (undecided().size > kRtuMaxFrame) give_up_as_overlong(candidate);
      return;
    }
    if (verdict.fit == Fit::good) {
      const auto end = static_cast<Index>(candidate + verdict.size);
      add_ready(candidate, verdict.size);
      decide_up_to(end);
    } else {
      ++candidate;
    }
  }
  state_.search_again_at = 0;
  if (undecided().size > kRtuMaxFrame) give_up_as_overlong(used());
}

/// Gives up the undecided characters before `index`. Later characters of this lump are part of the same
/// error.
void RtuFramer::give_up_as_overlong(Index index) {
  const auto count = static_cast<std::uint64_t>(index - state_.undecided);
  if (count == 0) return;
  if (state_.oversize == 0) add_error(ReceiveError::overlong);
  state_.oversize += count;
  state_.dropped += count;
  state_.undecided = index;
  forget_served();
}

/// Checks whether the characters since the last pause are a frame, in case the host has given up the one
/// before.
void RtuFramer::check_after_pause() {
  if (state_.resumed <= state_.undecided) return;  // decided in the meantime
  const Verdict verdict = judge(bytes(state_.resumed, used()), true);
  if (verdict.fit != Fit::good) return;
  const auto end = static_cast<Index>(state_.resumed + verdict.size);
  add_ready(state_.resumed, verdict.size);
  decide_up_to(end);
}

/// Called when patience is over: takes the good frames out of the undecided part and drops the rest, except
/// the beginning of a frame, which may wait longer.
void RtuFramer::end_of_silence() {
  const bool is_pause = !framing_.strict && !state_.is_paused && framing_.rest_patience > usual_patience();
  // The whole part is tried first: a shorter frame inside a good frame of unknown length is data of that
  // frame.
  const bool is_whole =
      take_whole(state_.undecided) || (state_.resumed > state_.undecided && take_whole(state_.resumed));
  const bool has_good_ones = !is_whole && !framing_.strict && take_good_ones();
  if (framing_.strict) state_.dropped += state_.oversize;
  const bool is_clean = has_good_ones || state_.candidate == state_.undecided;
  decide_up_to(is_pause ? beginning(is_clean) : used());
  state_.oversize = 0;
  if (state_.undecided == used()) return;
  state_.is_paused = true;
  state_.search_again_at = judge(bytes(state_.undecided, used()), false).size;
}

/// Returns the beginning of a frame that may wait for its rest, or used() if there is none. Such a frame
/// begins right after a silence, a good frame or a pause. `is_clean`: the undecided part begins there.
RtuFramer::Index RtuFramer::beginning(bool is_clean) const {
  const auto may_wait = [this](Index first) {
    return first < used() && judge(bytes(first, used()), true).fit == Fit::waiting;
  };
  if (is_clean && may_wait(state_.undecided)) return state_.undecided;
  return state_.resumed > state_.undecided && may_wait(state_.resumed) ? state_.resumed : used();
}

/// Takes all characters from `first` on as one frame, if their checksum is right.
bool RtuFramer::take_whole(Index first) {
  const auto whole = bytes(first, used());
  const bool may_be = (state_.oversize == 0 || !framing_.strict) && whole.size() <= kRtuMaxFrame;
  if (!may_be || !rtu_crc_ok(whole)) return false;
  add_ready(first, static_cast<std::uint16_t>(whole.size()));
  return true;
}

/// Queues the good frames of the undecided part. Returns true if there was at least one.
bool RtuFramer::take_good_ones() {
  bool has_some = false;
  for (Index at = state_.candidate; at < used();) {
    const Verdict verdict = judge(bytes(at, used()), true);
    if (verdict.fit == Fit::good) add_ready(at, verdict.size);
    has_some = has_some || verdict.fit == Fit::good;
    at += verdict.fit == Fit::good ? verdict.size : std::uint16_t{1};
  }
  return has_some;
}

/// Queues a frame of the undecided part, and drops the characters before it.
void RtuFramer::add_ready(Index first, std::uint16_t size) {
  drop_up_to(first);
  state_.oversize = 0;
  state_.undecided = static_cast<Index>(first + size);
  state_.ready.push_back({first, size});
}

void RtuFramer::decide_up_to(Index index) {
  drop_up_to(index);
  state_.candidate = index;
  state_.search_again_at = 0;
  state_.is_paused = false;
  if (state_.resumed <= index) state_.resumed = 0;
  forget_served();
}

/// Drops the characters of the undecided part before `index`: they are not a frame.
void RtuFramer::drop_up_to(Index index) {
  const auto noise = bytes(state_.undecided, index);
  state_.undecided = index;
  state_.dropped += noise.size();
  const bool is_told = state_.oversize > 0 && !framing_.strict;
  if (noise.empty() || is_told) return;
  add_error(state_.oversize > 0 ? ReceiveError::overlong : error_in(noise));
}

void RtuFramer::add_error(ReceiveError error) {
  ++errors_[static_cast<std::size_t>(error)];
  ++error_count_;
}

std::optional<ReceiveError> RtuFramer::take_error() {
  for (std::size_t i = 0; i < errors_.size(); ++i) {
    if (errors_[i] == 0) continue;
    --errors_[i];
    --error_count_;
    return static_cast<ReceiveError>(i);
  }
  return std::nullopt;
}

/// Removes characters before the first ready frame or the undecided part: they are no longer needed.
void RtuFramer::forget_served() {
  const Index served = state_.ready.empty() ? state_.undecided : state_.ready.front().first;
  if (served == 0) return;
  state_.characters.pop_front(served);
  for (Frame& frame : state_.ready) frame.first = static_cast<Index>(frame.first - served);
  state_.undecided = static_cast<Index>(state_.undecided - served);
  state_.candidate = static_cast<Index>(state_.candidate - served);
  state_.resumed = state_.resumed > served ? static_cast<Index>(state_.resumed - served) : Index{0};
}

/// Makes room by dropping the oldest ready frame, because the station does not take its frames. (There is
/// one, since the undecided part alone always fits.)
void RtuFramer::drop_oldest() {
  state_.dropped += state_.ready.front().size;
  state_.ready.pop_front();
  forget_served();
}

std::span<const std::uint8_t> RtuFramer::bytes(std::size_t first, std::size_t last) const {
  return state_.characters.values.values().subspan(first, last - first);
}

std::optional<SimTime> RtuFramer::due() const {
  if (!state_.ready.empty()) {
    const auto& [first, size] = state_.ready.front();
    return state_.characters.marks[first + size - std::size_t{1}].end + framing_.silence;
  }
  if (state_.undecided == used() || state_.character_under_way) return std::nullopt;
  return state_.last_end + patience();
}

std::size_t RtuFramer::quiet_characters() const {
  const bool may_be_due =
      framing_.strict || patience() == SimTime{0} || !state_.ready.empty() || state_.resumed != 0;
  if (may_be_due || used() == kCapacity) return 0;
  // Only frames that search() finds are due immediately.
  const auto received = static_cast<std::size_t>(used() - state_.candidate);
  const std::size_t undecided_still =
      state_.search_again_at > received ? state_.search_again_at - received : 1;
  return std::min(undecided_still, kCapacity - used());
}

std::optional<std::uint64_t> RtuFramer::first_open_character() const {
  if (used() == 0) return std::nullopt;
  return state_.characters.marks.front().number;
}

std::optional<RtuFrame> RtuFramer::take(SimTime now) {
  if (!state_.character_under_way) be_silent_until(now);
  if (state_.ready.empty() || now < *due()) return std::nullopt;
  return take_ready();
}

std::optional<RtuFrame> RtuFramer::take_due(SimTime now) {
  if (used() == 0) return std::nullopt;
  for (std::optional<SimTime> at = due(); at && *at <= now;) {
    if (const auto frame = take(now)) return frame;
    const std::optional<SimTime> before = std::exchange(at, due());
    if (at == before) break;  // this call changed nothing, and further calls would not
  }
  return std::nullopt;
}

RtuFrame RtuFramer::take_ready() {
  const RtuFrame frame = frame_at(state_.ready.front());
  state_.ready.pop_front();
  forget_served();
  return frame;
}

RtuFrame RtuFramer::frame_at(const Frame& place) const {
  const std::size_t end = std::size_t{place.first} + place.size;
  RtuFrame frame;
  std::ranges::copy(bytes(place.first, end), frame.bytes.begin());
  frame.size = place.size;
  const Mark& last = state_.characters.marks[end - 1];
  frame.end = last.end;
  frame.last_character = last.number;
  return frame;
}

/// Returns the undecided part as one frame.
RtuFramer::Frame RtuFramer::undecided() const {
  return {state_.undecided, static_cast<std::uint16_t>(used() - state_.undecided)};
}

/// Strict rule: returns true if the undecided part would be a frame if it ended here.
bool RtuFramer::may_be_over() const {
  return framing_.strict && state_.undecided < used() && !state_.character_under_way &&
         state_.oversize == 0 && rtu_crc_ok(bytes(state_.undecided, used()));
}

std::optional<RtuFrame> RtuFramer::peek() const {
  if (!state_.ready.empty()) return frame_at(state_.ready.front());
  if (may_be_over()) return frame_at(undecided());
  return std::nullopt;
}

std::optional<RtuFrame> RtuFramer::take_early() {
  if (state_.ready.empty() && may_be_over()) end_of_silence();
  if (state_.ready.empty()) return std::nullopt;
  return take_ready();
}

}  // namespace understudy::pty
