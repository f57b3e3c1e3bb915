#include "emulator/serve/ports/modbus_tcp.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "emulator/world/protocol/modbus_request.h"
#include "pty/ascii_frame.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::serve {

namespace {

// The header consists of the transaction, the protocol (0), and the length of the remaining bytes: the unit
// and the request.
constexpr std::size_t kHeader = 6;
constexpr std::size_t kMinLength = 2;
constexpr std::size_t kMaxLength = 254;

constexpr std::size_t kLongestFrame = kMaxLength + 2;  // with the checksum

// The time that stations get to execute a broadcast.
constexpr std::chrono::milliseconds kAfterBroadcast{100};

constexpr std::uint8_t kException = 0x80;
constexpr std::uint8_t kTargetDoesNotRespond = 0x0B;
constexpr std::size_t kExceptionFrame = 5;  // also the shortest reply

std::uint16_t word_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] << 8 | bytes[at + 1]);
}

/// Returns the length of the RTU frame that begins with these bytes, or nothing if its function does not
/// determine it.
std::optional<std::size_t> size_of_reply(std::span<const std::uint8_t> frame) {
  const std::uint8_t function = frame[1];
  if ((function & kException) != 0) return kExceptionFrame;
  if (function >= 0x01 && function <= 0x04) return kExceptionFrame + frame[2];
  if (function == 0x05 || function == 0x06 || function == 0x0F || function == 0x10) return 8;
  return std::nullopt;
}

/// Returns false if the length in the message's header is impossible.
bool is_length_possible(std::span<const std::uint8_t> received) {
  if (received.size() < kHeader) return true;
  const std::size_t length = word_at(received, 4);
  return length >= kMinLength && length <= kMaxLength;
}

/// Returns the size of the message, or nothing if the message is incomplete or invalid.
std::optional<std::size_t> size_of_message(std::span<const std::uint8_t> received) {
  if (received.size() < kHeader || !is_length_possible(received)) return std::nullopt;
  const std::size_t size = kHeader + word_at(received, 4);
  return received.size() >= size ? std::optional(size) : std::nullopt;
}

}  // namespace

bool ModbusTcp::receive_from_client(std::span<const std::uint8_t> bytes) {
  if (is_refused_) return false;
  received_.insert(received_.end(), bytes.begin(), bytes.end());
  std::span<const std::uint8_t> rest = received_;
  while (const auto size = size_of_message(rest)) rest = rest.subspan(*size);
  if (is_length_possible(rest)) return true;
  received_.resize(received_.size() - rest.size());
  is_refused_ = true;
  return false;
}

std::optional<std::chrono::milliseconds> ModbusTcp::patience() const {
  if (!on_line_) return std::nullopt;
  return is_broadcast() ? kAfterBroadcast : rules_.timeout;
}

ModbusTcp::Bytes ModbusTcp::take_for_line(std::size_t room) {
  const std::size_t longest = rules_.is_ascii ? pty::kAsciiMaxFrame : kLongestFrame;
  while (room >= longest && !on_line_ && to_client_.empty()) {
    const auto size = size_of_message(received_);
    if (!size) break;
    const auto end = received_.begin() + static_cast<std::ptrdiff_t>(*size);
    const bool is_modbus = word_at(received_, 2) == 0;
    Bytes frame(received_.begin() + kHeader, end);
    const std::uint16_t transaction = word_at(received_, 0);
    received_.erase(received_.begin(), end);
    if (!is_modbus) continue;  // the standard requires that other protocols are ignored
    // A frame of Modbus ASCII has two digits for each byte, one checksum byte less, and three delimiters.
    const auto on_line = [this](std::size_t bytes) { return rules_.is_ascii ? 2 * (bytes - 1) + 3 : bytes; };
    const std::uint8_t unit = frame[0];
    if (rules_.station_of) frame[0] = rules_.station_of(unit, frame[1]);
    pty::append_rtu_crc(frame);
    on_line_ = Request{
        .transaction = transaction,
        .unit = unit,
        .station = frame[0],
        .function = frame[1],
        .exchange_bytes = on_line(frame.size()) + on_line(reply_size(world::parse_request_frame(frame)))};
    reply_.clear();
    return rules_.is_ascii ? pty::ascii_of_rtu(frame) : frame;
  }
  return {};
}

/// Receives bytes from the line. Drops late or damaged replies, which do not match the pending request.
void ModbusTcp::receive_from_line(std::span<const std::uint8_t> bytes) {
  if (!on_line_) return;
  reply_.insert(reply_.end(), bytes.begin(), bytes.end());
  if (rules_.is_ascii) return take_ascii_reply();
  while (reply_.size() >= kExceptionFrame) {
    const std::size_t size = size_of_reply(reply_).value_or(reply_.size());
    if (reply_.size() < size) return;
    const std::span<const std::uint8_t> frame = std::span<const std::uint8_t>(reply_).first(size);
    const bool is_good = pty::rtu_crc_ok(frame);
    if (!is_good && !size_of_reply(reply_)) return;  // the reply may be incomplete
    if (is_good && is_reply(frame)) {
      answer(frame.subspan(1, size - 3));
      reply_.clear();
      return;
    }
    reply_.erase(reply_.begin(), reply_.begin() + static_cast<std::ptrdiff_t>(size));
  }
}

bool ModbusTcp::is_reply(std::span<const std::uint8_t> frame) const {
  return frame[0] == on_line_->station && (frame[1] & ~kException) == on_line_->function;
}

void ModbusTcp::take_ascii_reply() {
  while (true) {
    const auto end = std::find(reply_.begin(), reply_.end(), '\n');
    if (end == reply_.end()) return;
    const Bytes line(reply_.begin(), end + 1);
    reply_.erase(reply_.begin(), end + 1);
    const auto begin = std::find(line.rbegin(), line.rend(), ':');
    if (begin == line.rend()) continue;
    const auto frame =
        pty::rtu_of_ascii(std::span(line).subspan(static_cast<std::size_t>(line.rend() - begin) - 1));
    if (!frame || !is_reply(*frame)) continue;
    reply_.clear();
    return answer(std::span(*frame).subspan(1, frame->size() - 3));
  }
}

void ModbusTcp::give_up() {
  if (!on_line_) return;
  if (is_broadcast() || !rules_.reports_timeout) {
    on_line_.reset();
    return;
  }
  answer(std::array{static_cast<std::uint8_t>(on_line_->function | kException), kTargetDoesNotRespond});
}

bool ModbusTcp::is_idle() const { return !on_line_ && to_client_.empty() && !size_of_message(received_); }

void ModbusTcp::client_gone() {
  to_client_.clear();
  const auto next = on_line_ ? std::optional<std::size_t>(0) : size_of_message(received_);
  received_.resize(next.value_or(0));
}

void ModbusTcp::answer(std::span<const std::uint8_t> pdu) {
  const std::size_t length = pdu.size() + 1;
  const std::array header{static_cast<std::uint8_t>(on_line_->transaction >> 8),
                          static_cast<std::uint8_t>(on_line_->transaction),
                          std::uint8_t{0},
                          std::uint8_t{0},
                          static_cast<std::uint8_t>(length >> 8),
                          static_cast<std::uint8_t>(length),
                          on_line_->unit};
  to_client_.insert(to_client_.end(), header.begin(), header.end());
  to_client_.insert(to_client_.end(), pdu.begin(), pdu.end());
  on_line_.reset();
}

ModbusTcp::Bytes ModbusTcp::take_for_client() { return std::exchange(to_client_, {}); }

}  // namespace understudy::emulator::serve
