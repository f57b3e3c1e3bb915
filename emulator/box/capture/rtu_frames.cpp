#include "emulator/box/capture/rtu_frames.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/box/capture/capture.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::box {

namespace {

constexpr std::size_t kLongest = 256;
constexpr std::size_t kTcpHeader = 6;  // without the station, which a serial frame has, too
constexpr std::uint8_t kRefusalBit = 0x80;

/// The lengths of a function's frames, with station and checksum (MODBUS Application Protocol, chapter 6).
struct FunctionLengths {
  std::uint8_t code = 0;
  std::size_t request = 0;
  std::size_t request_count_at = 0;  // a byte that tells how many more there are; 0: none
  std::size_t reply = 0;
  std::size_t reply_count_at = 0;
};
constexpr std::array kFunctions{
    FunctionLengths{0x01, 8, 0, 5, 2},   FunctionLengths{0x02, 8, 0, 5, 2},
    FunctionLengths{0x03, 8, 0, 5, 2},   FunctionLengths{0x04, 8, 0, 5, 2},
    FunctionLengths{0x05, 8, 0, 8, 0},   FunctionLengths{0x06, 8, 0, 8, 0},
    FunctionLengths{0x07, 4, 0, 5, 0},   FunctionLengths{0x08, 8, 0, 8, 0},
    FunctionLengths{0x0B, 4, 0, 8, 0},   FunctionLengths{0x0C, 4, 0, 5, 2},
    FunctionLengths{0x0F, 9, 6, 8, 0},   FunctionLengths{0x10, 9, 6, 8, 0},
    FunctionLengths{0x11, 4, 0, 5, 2},   FunctionLengths{0x14, 5, 2, 5, 2},
    FunctionLengths{0x15, 5, 2, 5, 2},   FunctionLengths{0x16, 10, 0, 10, 0},
    FunctionLengths{0x17, 13, 10, 5, 2},
};
/// Replies of read device identification have no length: it ends where the checksum is right.
constexpr std::uint8_t kIdentification = 0x2B;

FrameLength none() { return {}; }
FrameLength more() { return {.state = FrameLength::State::needs_more}; }
FrameLength known(std::size_t size) {
  return size > kLongest ? none() : FrameLength{.state = FrameLength::State::known, .size = size};
}

FrameLength length_of(std::span<const std::uint8_t> bytes, std::size_t min, std::size_t count_at) {
  if (count_at == 0) return known(min);
  return bytes.size() <= count_at ? more() : known(min + bytes[count_at]);
}

const FunctionLengths* function_of(std::uint8_t code) {
  const auto* const found = std::ranges::find(kFunctions, code, &FunctionLengths::code);
  return found == kFunctions.end() ? nullptr : &*found;
}

FrameLength length_by_checksum(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kShortest = 10;
  for (std::size_t size = kShortest; size <= std::min(bytes.size(), kLongest); ++size)
    if (pty::rtu_crc_ok(bytes.first(size))) return known(size);
  return bytes.size() < kLongest ? more() : none();
}

CapturedBytes with_checksum(std::span<const std::uint8_t> bytes) {
  CapturedBytes frame(bytes.begin(), bytes.end());
  pty::append_rtu_crc(frame);
  return frame;
}

}  // namespace

FrameLength request_length(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 2) return more();
  if (bytes[1] == kIdentification) return known(7);
  const FunctionLengths* const function = function_of(bytes[1]);
  if (function == nullptr) return none();
  return length_of(bytes, function->request, function->request_count_at);
}

FrameLength reply_length(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 2) return more();
  if ((bytes[1] & kRefusalBit) != 0) return known(5);
  if (bytes[1] == kIdentification) return length_by_checksum(bytes);
  const FunctionLengths* const function = function_of(bytes[1]);
  if (function == nullptr) return none();
  return length_of(bytes, function->reply, function->reply_count_at);
}

bool may_answer(std::span<const std::uint8_t> request, std::span<const std::uint8_t> reply) {
  if (request.size() < 4 || reply.size() < 5 || request[0] != reply[0]) return false;
  if (reply[1] == (request[1] | kRefusalBit)) return true;
  if (reply[1] != request[1]) return false;
  const auto repeats = [&](std::size_t first, std::size_t last) {
    return last < std::min(request.size(), reply.size()) &&
           std::equal(request.begin() + static_cast<std::ptrdiff_t>(first),
                      request.begin() + static_cast<std::ptrdiff_t>(last) + 1,
                      reply.begin() + static_cast<std::ptrdiff_t>(first));
  };
  const auto count = static_cast<std::size_t>(request.size() < 6 ? 0 : request[4] << 8 | request[5]);
  switch (request[1]) {
    case 0x01:
    case 0x02: return reply[2] == (count + 7) / 8;
    case 0x03:
    case 0x04: return reply[2] == 2 * count;
    case 0x05:
    case 0x06:
    case 0x0F:
    case 0x10: return repeats(2, 5);
    default: return true;
  }
}

std::optional<TcpFrame> take_tcp_frame(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kTcpHeader + 2 || bytes[2] != 0 || bytes[3] != 0) return {};
  const std::size_t length = static_cast<std::size_t>(bytes[4]) << 8 | bytes[5];
  if (length < 2 || length > kLongest - 2 || bytes.size() < kTcpHeader + length) return {};
  return TcpFrame{.bytes = with_checksum(bytes.subspan(kTcpHeader, length)),
                  .size = kTcpHeader + length,
                  .transaction = static_cast<std::uint16_t>(bytes[0] << 8 | bytes[1])};
}

void FrameFinder::add(const CapturedPiece& piece) {
  constexpr std::size_t kWorthMoving = 4096;
  if (begin_ > kWorthMoving) {
    bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(begin_));
    begin_ = 0;
  }
  bytes_.insert(bytes_.end(), piece.bytes.begin(), piece.bytes.end());
  marks_.push_back({.end = passed_ + rest().size(), .at = piece.at, .place = piece.place});
}

std::optional<SimTime> FrameFinder::begins() const {
  return is_empty() || marks_.empty() ? std::nullopt : marks_.front().at;
}

std::size_t FrameFinder::take_dropped() { return std::exchange(dropped_, 0); }

FrameFinder::Match FrameFinder::match_as(FrameRole role, const CapturedBytes* pending) const {
  const auto bytes = rest();
  const FrameLength length = role == FrameRole::request ? request_length(bytes) : reply_length(bytes);
  if (length.state == FrameLength::State::none) return {};
  if (length.state == FrameLength::State::needs_more || bytes.size() < length.size) return {.waits = true};
  const auto whole = bytes.first(length.size);
  if (!pty::rtu_crc_ok(whole)) return {};
  return {.size = length.size, .role = role, .answers = pending != nullptr && may_answer(*pending, whole)};
}

/// A debug log of a master may show Modbus TCP. The length in its header must be that of the function.
FrameFinder::Match FrameFinder::match_tcp(const CapturedBytes* pending) const {
  const auto bytes = rest();
  // The header comes before its length is known.
  const bool may_be_tcp = bytes.size() < kTcpHeader + 2 || (bytes[2] == 0 && bytes[3] == 0 && bytes[4] == 0 &&
                                                            bytes.size() < kTcpHeader + bytes[5]);
  if (may_be_tcp) return {.waits = true};
  const auto frame = take_tcp_frame(bytes);
  if (!frame) return {};
  const FrameLength request = request_length(frame->bytes);
  const FrameLength reply = reply_length(frame->bytes);
  const auto fits = [&](const FrameLength& length) {
    return length.state == FrameLength::State::known && length.size == frame->bytes.size();
  };
  const bool answers = pending != nullptr && may_answer(*pending, frame->bytes);
  if (role_ != FrameRole::request && fits(reply) && (role_ == FrameRole::reply || answers || !fits(request)))
    return {.size = frame->size, .role = FrameRole::reply, .is_tcp = true};
  if (role_ != FrameRole::reply && fits(request))
    return {.size = frame->size, .role = FrameRole::request, .is_tcp = true};
  return {};
}

/// Of two readings, a reply to the request that waits is the better one, and then a request.
FrameFinder::Match FrameFinder::match(const CapturedBytes* pending) const {
  Match reply;
  Match request;
  if (role_ != FrameRole::request) reply = match_as(FrameRole::reply, pending);
  if (reply.size != 0 && (role_ == FrameRole::reply || reply.answers)) return reply;
  if (role_ != FrameRole::reply) request = match_as(FrameRole::request, pending);
  if (request.size != 0) return request;
  if (reply.size != 0) return reply;
  Match tcp = match_tcp(pending);
  tcp.waits = tcp.waits || reply.waits || request.waits;
  return tcp;
}

FoundFrame FrameFinder::take(const Match& match) {
  const auto bytes = rest().first(match.size);
  FoundFrame frame{.bytes = {bytes.begin(), bytes.end()}, .role = match.role};
  if (!marks_.empty()) {
    frame.at = marks_.front().at;
    frame.place = marks_.front().place;
  }
  if (match.is_tcp) {
    TcpFrame tcp = *take_tcp_frame(bytes);
    frame.bytes = std::move(tcp.bytes);
    frame.pair = std::uint64_t{1} << 16 | tcp.transaction;
  }
  drop(match.size);
  return frame;
}

void FrameFinder::drop(std::size_t count) {
  begin_ += count;
  passed_ += count;
  while (!marks_.empty() && marks_.front().end <= passed_) marks_.pop_front();
}

std::optional<FoundFrame> FrameFinder::next(const CapturedBytes* pending, bool gives_up) {
  while (!is_empty()) {
    const Match found = match(pending);
    if (found.size != 0) return dropped_ != 0 ? std::nullopt : std::optional(take(found));
    if (found.waits && !gives_up) return {};
    drop(1);
    ++dropped_;
  }
  return {};
}

}  // namespace understudy::emulator::box
