#include "pty/capture_frames.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "pty/ascii_frame.h"
#include "pty/ascii_framer.h"
#include "pty/capture.h"
#include "pty/line_observer.h"
#include "pty/line_settings.h"
#include "pty/rtu_crc.h"
#include "pty/rtu_framer.h"
#include "pty/station.h"

namespace understudy::pty {
namespace {

// Dropped characters in a row become one packet of at most this many bytes.
constexpr std::size_t kLongestNoise = kRtuMaxFrame;
// More bytes than a framer can hold. With strict framing, a lump that is too long for a frame keeps this many
// undecided; they are then all dropped.
constexpr std::size_t kMaxBytesWaiting = 5 * kRtuMaxFrame;

Remark why_dropped(std::span<const std::uint8_t> bytes) {
  const auto size = rtu_request_size(bytes);
  if (size ? bytes.size() < *size : bytes.size() < kRtuMinFrame) return Remark::incomplete;
  if (size != bytes.size()) return Remark::not_a_frame;
  return rtu_crc_ok(bytes) ? Remark::none : Remark::wrong_checksum;
}

}  // namespace

CaptureFrames::CaptureFrames(std::size_t line, RtuFraming framing, Sink sink, Packets packets)
    : line_(line), sink_(std::move(sink)), framer_(framing), packets_(packets) {}

void CaptureFrames::on_start_bit(SimTime at) {
  give_strikes();
  if (is_text()) return;
  framer_.start_bit(at);
  give_what_was_dropped();
}

void CaptureFrames::on_character(const TimedByte& character, bool is_received) {
  give_strikes();
  if (is_received != is_received_) {
    finish();  // the host has changed its speed
    is_received_ = is_received;
  }
  if (packets_ == Packets::ascii_frames) return take_ascii(character);
  if (packets_ == Packets::lines) return take_text(character);
  waiting_.push_back(character);
  framer_.push(character);
  give_what_was_dropped();
}

void CaptureFrames::take_text(const TimedByte& character) {
  waiting_.push_back(character);
  constexpr std::uint8_t kEscape = 0x1B;
  const bool is_behind_return = waiting_.size() == 1 && character.value == '\n';
  const bool is_end = character.value == '\r' || character.value == '\n' || character.value == kEscape;
  if ((is_end && !is_behind_return) || waiting_.size() == kLongestNoise) give_text();
}

void CaptureFrames::take_ascii(const TimedByte& character) {
  const bool is_late = !waiting_.empty() && character.start - waiting_.back().end > kAsciiPatience;
  if (character.value == ':' || is_late) give_ascii();
  waiting_.push_back(character);
  if (character.value == '\n' || waiting_.size() == kAsciiMaxFrame) give_ascii();
}

void CaptureFrames::on_nothing_more() {
  if (packets_ == Packets::ascii_frames) return give_ascii();
  framer_.give_up_waiting();
  give_what_was_dropped();
}

void CaptureFrames::on_transmission(const Transmission& transmission) {
  const Remark remark = transmission.has_collided  ? Remark::collided
                        : transmission.is_for_host ? Remark::none
                                                   : Remark::to_nobody;
  const bool is_explained = !why_.empty() && why_of_ == transmission.last_character;
  sink_({.line = line_,
         .direction = Direction::to_host,
         .time = transmission.start,
         .bytes = transmission.bytes,
         .remark = remark,
         .is_text = is_text(),
         .faults = faults_,
         .why = is_explained ? std::string_view(why_) : std::string_view(),
         .last_character = transmission.last_character});
  faults_.clear();
  if (is_explained) why_.clear();
}

void CaptureFrames::on_served(const ServedRequest& request) {
  if (request.why.empty()) return;
  why_ = request.why;
  why_of_ = request.last_character;
}

/// A text station sends its reply later and in pieces, so the strikes become a separate packet.
void CaptureFrames::on_strike(const StruckMessage& message) {
  give_strikes();
  faults_ = text_of(message.strikes);
  struck_at_ = message.time;
  if (message.is_sent && packets_ != Packets::lines) return;
  sink_({line_,
         message.is_reply ? Direction::to_host : Direction::from_host,
         message.time,
         {},
         Remark::none,
         is_text(),
         faults_});
  faults_.clear();
}

/// Reports strikes on a reply that was never sent.
void CaptureFrames::give_strikes() {
  if (faults_.empty()) return;
  sink_({line_, Direction::to_host, struck_at_, {}, Remark::none, is_text(), faults_});
  faults_.clear();
}

void CaptureFrames::run(SimTime now) {
  while (const auto frame = framer_.take_due(now)) {
    const auto last = std::find_if(waiting_.begin(), waiting_.end(), [&](const TimedByte& character) {
      return character.number == frame->last_character;
    });
    if (last == waiting_.end()) continue;  // dropped earlier
    const auto end = static_cast<std::size_t>(last - waiting_.begin()) + 1;
    if (end < frame->size) continue;
    give_dropped(end - frame->size);
    give_packet(frame->size, Remark::none);
  }
  give_what_was_dropped();
}

void CaptureFrames::finish() {
  give_strikes();
  if (packets_ == Packets::lines) return give_text();
  if (packets_ == Packets::ascii_frames) return give_ascii();
  framer_.give_up_waiting();
  run(SimTime::max());
  give_dropped(waiting_.size());
  framer_.reset();
}

/// Emits all waiting characters, which are at most one packet.
void CaptureFrames::give_text() {
  if (!waiting_.empty()) give_packet(waiting_.size(), Remark::none);
}

/// Emits all waiting characters as a frame, or as what the stations drop.
void CaptureFrames::give_ascii() {
  if (waiting_.empty()) return;
  std::vector<std::uint8_t> bytes;
  for (const TimedByte& character : waiting_) bytes.push_back(character.value);
  Remark remark = Remark::none;
  if (!rtu_of_ascii(bytes)) {
    const bool is_cut = bytes.front() == ':' && bytes.back() != '\n';
    remark = has_ascii_form(bytes) ? Remark::wrong_checksum
             : is_cut              ? Remark::incomplete
                                   : Remark::not_a_frame;
  }
  give_packet(waiting_.size(), remark);
}

/// Emits characters that the framer has dropped, once no further ones can belong to them.
void CaptureFrames::give_what_was_dropped() {
  const auto open = framer_.first_open_character();
  const auto first_open =
      open ? std::find_if(waiting_.begin(), waiting_.end(),
                          [&](const TimedByte& character) { return character.number >= *open; })
           : waiting_.end();
  const auto dropped = static_cast<std::size_t>(first_open - waiting_.begin());
  if (!open || dropped >= kLongestNoise) give_dropped(dropped);
  if (waiting_.size() >= kMaxBytesWaiting) give_dropped(waiting_.size());
}

void CaptureFrames::give_dropped(std::size_t count) {
  for (; count > 0; count -= std::min(count, kLongestNoise)) {
    std::array<std::uint8_t, kLongestNoise> bytes;
    const std::size_t size = std::min(count, kLongestNoise);
    for (std::size_t i = 0; i < size; ++i) bytes[i] = waiting_[i].value;
    give_packet(size, why_dropped(std::span(bytes).first(size)));
  }
}

/// Emits the first `count` waiting characters, at most kAsciiMaxFrame.
void CaptureFrames::give_packet(std::size_t count, Remark remark) {
  std::array<std::uint8_t, kAsciiMaxFrame> bytes;
  for (std::size_t i = 0; i < count; ++i) bytes[i] = waiting_[i].value;
  sink_({.line = line_,
         .direction = Direction::from_host,
         .time = waiting_.front().start,
         .bytes = std::span(bytes).first(count),
         .remark = is_received_ ? remark : Remark::unheard,
         .is_text = is_text(),
         .last_character = waiting_[count - 1].number});
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(count));
}

}  // namespace understudy::pty
