#include "pty/rtu_framer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "pty/line_settings.h"
#include "pty/rtu_crc.h"
#include "pty/station.h"

namespace understudy::pty {
namespace {

// How a request's length follows from its function.
struct LengthRule {
  std::uint8_t fixed = 0;          // bytes in all, or, with a byte count, bytes besides the counted ones
  std::uint8_t byte_count_at = 0;  // index of the byte count, 0 if there is none
  bool may_be_longer = false;      // another length is legal too, and only silence tells it
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
    default: return {};
  }
}

enum class Fit {
  waiting,     // may still become a frame
  good,        // is one, checksum and all
  impossible,  // cannot be one
};

struct Verdict {
  Fit fit = Fit::waiting;
  std::size_t size = 0;  // good: of the frame; waiting: look again when so many bytes are in
};

constexpr std::size_t kOnlySilenceTells = kRtuMaxFrame + 1;
constexpr std::size_t kShortestFrame = 4;  // address, function, checksum

/// Of characters that are over and are not a frame.
ReceiveError error_in(std::span<const std::uint8_t> noise) {
  if (noise.size() > kRtuMaxFrame) return ReceiveError::overlong;
  if (noise.size() < kShortestFrame) return ReceiveError::cut_off;
  const LengthRule rule = rule_of(noise[1]);
  const bool lacks_count = rule.byte_count_at != 0 && noise.size() <= rule.byte_count_at;
  const std::optional<std::size_t> wanted = rtu_request_size(noise);
  const bool is_cut = lacks_count || (wanted && noise.size() < *wanted && *wanted <= kRtuMaxFrame);
  return is_cut ? ReceiveError::cut_off : ReceiveError::bad_checksum;
}

/// Judges a frame that would begin with the first of `bytes` (one at least). A length that only silence
/// tells is believed of a frame that begins where one should, never in the middle of noise.
Verdict judge(std::span<const std::uint8_t> bytes, bool is_in_noise) {
  if (bytes.size() < 2) return {Fit::waiting, 2};
  const std::uint8_t function = bytes[1];
  if (function == 0 || function >= 0x80) return {Fit::impossible, 0};  // no request has these
  const Verdict patient = is_in_noise || bytes.size() > kRtuMaxFrame
                              ? Verdict{Fit::impossible, 0}
                              : Verdict{Fit::waiting, kOnlySilenceTells};
  const LengthRule rule = rule_of(function);
  if (rule.fixed == 0) return patient;
  std::size_t size = rule.fixed;
  if (rule.byte_count_at != 0) {
    if (bytes.size() <= rule.byte_count_at) return {Fit::waiting, rule.byte_count_at + std::size_t{1}};
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

SimTime RtuFramer::patience() const {
  return framing_.strict ? framing_.silence : std::max(framing_.patience, framing_.silence);
}

/// Whether the line has been quiet for long enough at `at` to end what is undecided.
bool RtuFramer::is_silent(SimTime at) const { return undecided_ < used_ && at >= last_end_ + patience(); }

void RtuFramer::start_bit(SimTime at) {
  if (is_silent(at)) end_of_silence();
  character_under_way_ = true;
}

void RtuFramer::push(const TimedByte& byte) {
  if (is_silent(byte.start)) end_of_silence();
  const bool is_lump_over = oversize_ != 0 && undecided_ == used_ && byte.start >= last_end_ + patience();
  if (is_lump_over) oversize_ = 0;
  character_under_way_ = false;
  last_end_ = byte.end;
  if (framing_.strict && used_ - undecided_ == kRtuMaxFrame) {
    ++oversize_;
    return;
  }
  if (used_ == kCapacity) make_room();
  values_[used_] = byte.value;
  marks_[used_] = {byte.end, byte.number};
  ++used_;
  if (!framing_.strict && used_ - candidate_ >= look_again_at_) search();
}

void RtuFramer::reset() {
  used_ = undecided_ = candidate_ = look_again_at_ = 0;
  ready_first_ = ready_count_ = 0;
  oversize_ = 0;
  character_under_way_ = false;
}

void RtuFramer::give_up_waiting() {
  if (!framing_.strict && undecided_ < used_ && !character_under_way_) end_of_silence();
}

/// Moves the candidate on for as long as what is in decides about it.
void RtuFramer::search() {
  while (candidate_ < used_) {
    const Verdict verdict = judge(bytes(candidate_, used_), candidate_ > undecided_);
    if (verdict.fit == Fit::waiting) {
      look_again_at_ = verdict.size;
      // What precedes a candidate is kept for the case that the whole is one frame of unknown length.
      // It cannot be one any more when it is too long, and that bounds the undecided part.
      if (used_ - undecided_ > kRtuMaxFrame) give_up_as_overlong(candidate_);
      return;
    }
    if (verdict.fit == Fit::good) {
      add_ready(candidate_, verdict.size);
      decide_up_to(candidate_ + verdict.size);
    } else {
      ++candidate_;
    }
  }
  look_again_at_ = 0;
  if (used_ - undecided_ > kRtuMaxFrame) give_up_as_overlong(used_);
}

/// What of this lump comes later is part of the same error.
void RtuFramer::give_up_as_overlong(std::size_t index) {
  if (index == undecided_) return;
  if (oversize_ == 0) add_error(ReceiveError::overlong);
  oversize_ += index - undecided_;
  dropped_ += index - undecided_;
  undecided_ = index;
}

/// Nothing follows what is undecided: take the good frames out of it and drop the rest.
void RtuFramer::end_of_silence() {
  const auto whole = bytes(undecided_, used_);
  const bool may_be_whole = (oversize_ == 0 || !framing_.strict) && whole.size() <= kRtuMaxFrame;
  // The whole comes first: a shorter frame inside a good one of unknown length is its data.
  if (may_be_whole && rtu_crc_ok(whole)) {
    add_ready(undecided_, whole.size());
  } else if (!framing_.strict) {
    for (std::size_t at = candidate_; at < used_;) {
      const Verdict verdict = judge(bytes(at, used_), true);
      if (verdict.fit == Fit::good) add_ready(at, verdict.size);
      at += verdict.fit == Fit::good ? verdict.size : 1;
    }
  }
  if (framing_.strict) dropped_ += oversize_;
  decide_up_to(used_);
  oversize_ = 0;
}

/// Queues a frame of the undecided part, and counts as dropped what lies before it.
void RtuFramer::add_ready(std::size_t first, std::size_t size) {
  drop_up_to(first);
  oversize_ = 0;
  undecided_ = first + size;
  ready_[(ready_first_ + ready_count_) % kMaxReady] = {static_cast<std::uint16_t>(first),
                                                       static_cast<std::uint16_t>(size)};
  ++ready_count_;
}

void RtuFramer::decide_up_to(std::size_t index) {
  drop_up_to(index);
  candidate_ = index;
  look_again_at_ = 0;
  rewind_if_empty();
}

/// What of the undecided part lies before `index` is no frame.
void RtuFramer::drop_up_to(std::size_t index) {
  const auto noise = bytes(undecided_, index);
  undecided_ = index;
  dropped_ += noise.size();
  const bool is_told = oversize_ > 0 && !framing_.strict;
  if (noise.empty() || is_told) return;
  add_error(oversize_ > 0 ? ReceiveError::overlong : error_in(noise));
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

void RtuFramer::rewind_if_empty() {
  if (ready_count_ == 0 && undecided_ == used_) used_ = undecided_ = candidate_ = 0;
}

/// The buffer's end is reached: gives up what was served, and if nothing was, the oldest ready frame
/// (of a station that does not take its frames; the undecided part alone always fits).
void RtuFramer::make_room() {
  if (ready_count_ > 0 && ready_[ready_first_].first == 0) {
    dropped_ += ready_[ready_first_].size;
    ready_first_ = (ready_first_ + 1) % kMaxReady;
    --ready_count_;
  }
  const std::size_t shift = ready_count_ > 0 ? ready_[ready_first_].first : undecided_;
  std::copy(values_.begin() + shift, values_.begin() + used_, values_.begin());
  std::copy(marks_.begin() + shift, marks_.begin() + used_, marks_.begin());
  for (std::size_t i = 0; i < ready_count_; ++i) {
    auto& frame = ready_[(ready_first_ + i) % kMaxReady];
    frame.first = static_cast<std::uint16_t>(frame.first - shift);
  }
  used_ -= shift;
  undecided_ -= shift;
  candidate_ -= shift;
}

std::span<const std::uint8_t> RtuFramer::bytes(std::size_t first, std::size_t last) const {
  return std::span(values_).subspan(first, last - first);
}

std::optional<SimTime> RtuFramer::due() const {
  if (ready_count_ > 0) {
    const Ready& frame = ready_[ready_first_];
    return marks_[frame.first + frame.size - std::size_t{1}].end + framing_.silence;
  }
  if (undecided_ == used_ || character_under_way_) return std::nullopt;
  return last_end_ + patience();
}

std::optional<std::uint64_t> RtuFramer::first_open_character() const {
  if (ready_count_ > 0) return marks_[ready_[ready_first_].first].number;
  if (undecided_ < used_) return marks_[undecided_].number;
  return std::nullopt;
}

std::optional<RtuFrame> RtuFramer::take(SimTime now) {
  if (!character_under_way_ && is_silent(now)) end_of_silence();
  if (ready_count_ == 0 || now < *due()) return std::nullopt;
  return take_ready();
}

std::optional<RtuFrame> RtuFramer::take_due(SimTime now) {
  for (std::optional<SimTime> at = due(); at && *at <= now;) {
    if (const auto frame = take(now)) return frame;
    const std::optional<SimTime> before = std::exchange(at, due());
    if (at == before) break;  // nothing has come of it, and nothing would
  }
  return std::nullopt;
}

RtuFrame RtuFramer::take_ready() {
  const Ready ready = ready_[ready_first_];
  const RtuFrame frame = frame_at(ready.first, ready.size);
  ready_first_ = (ready_first_ + 1) % kMaxReady;
  --ready_count_;
  rewind_if_empty();
  return frame;
}

RtuFrame RtuFramer::frame_at(std::size_t first, std::size_t size) const {
  RtuFrame frame;
  std::copy_n(values_.begin() + static_cast<std::ptrdiff_t>(first), size, frame.bytes.begin());
  frame.size = size;
  const Mark& last = marks_[first + size - 1];
  frame.end = last.end;
  frame.last_character = last.number;
  return frame;
}

/// Under the strict rule: what is undecided would be a frame, if it ended here.
bool RtuFramer::may_be_over() const {
  return framing_.strict && undecided_ < used_ && !character_under_way_ && oversize_ == 0 &&
         rtu_crc_ok(bytes(undecided_, used_));
}

std::optional<RtuFrame> RtuFramer::peek() const {
  if (ready_count_ > 0) return frame_at(ready_[ready_first_].first, ready_[ready_first_].size);
  if (may_be_over()) return frame_at(undecided_, used_ - undecided_);
  return std::nullopt;
}

std::optional<RtuFrame> RtuFramer::take_early() {
  if (ready_count_ == 0 && may_be_over()) end_of_silence();
  if (ready_count_ == 0) return std::nullopt;
  return take_ready();
}

}  // namespace understudy::pty
