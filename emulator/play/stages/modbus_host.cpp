#include "emulator/play/stages/modbus_host.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "emulator/play/stages/stage.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::play {

namespace {

constexpr std::uint8_t kReadHolding = 0x03;
constexpr std::uint8_t kWriteOne = 0x06;
constexpr std::uint8_t kWriteSeveral = 0x10;
constexpr std::uint8_t kException = 0x80;
constexpr std::size_t kExceptionSize = 5;

void put_word(std::vector<std::uint8_t>& frame, std::size_t word) {
  frame.push_back(static_cast<std::uint8_t>(word >> 8));
  frame.push_back(static_cast<std::uint8_t>(word));
}

std::size_t word_at(std::span<const std::uint8_t> frame, std::size_t at) {
  return static_cast<std::size_t>(frame[at] << 8 | frame[at + 1]);
}

}  // namespace

std::vector<std::uint8_t> read_request(int station, std::uint16_t first, int count) {
  std::vector<std::uint8_t> frame{static_cast<std::uint8_t>(station), kReadHolding};
  put_word(frame, first);
  put_word(frame, static_cast<std::size_t>(count));
  pty::append_rtu_crc(frame);
  return frame;
}

std::vector<std::uint8_t> write_request(int station, std::uint16_t first,
                                        std::span<const std::uint16_t> words) {
  const bool is_single = words.size() == 1;
  std::vector<std::uint8_t> frame{static_cast<std::uint8_t>(station), is_single ? kWriteOne : kWriteSeveral};
  put_word(frame, first);
  if (!is_single) {
    put_word(frame, words.size());
    frame.push_back(static_cast<std::uint8_t>(2 * words.size()));
  }
  for (const std::uint16_t word : words) put_word(frame, word);
  pty::append_rtu_crc(frame);
  return frame;
}

std::size_t wanted_size(std::span<const std::uint8_t> request, std::span<const std::uint8_t> reply) {
  if (reply.size() >= 2 && (reply[1] & kException) != 0) return kExceptionSize;
  if (request[1] == kReadHolding) return 5 + 2 * word_at(request, 4);
  return 8;  // the beginning of the request, and a checksum
}

HostReply judge_reply(std::span<const std::uint8_t> request, std::span<const std::uint8_t> reply) {
  HostReply made;
  made.bytes.assign(reply.begin(), reply.end());
  made.kind = reply.empty() ? HostReply::Kind::silence : HostReply::Kind::garbled;
  if (reply.size() < 2 || reply.size() != wanted_size(request, reply) || !pty::rtu_crc_ok(reply) ||
      reply[0] != request[0] || (reply[1] & ~kException) != request[1]) {
    return made;
  }
  if ((reply[1] & kException) != 0) {
    made.kind = HostReply::Kind::exception;
    made.exception = reply[2];
  } else if (request[1] == kReadHolding) {
    if (reply[2] != 2 * word_at(request, 4)) return made;
    made.kind = HostReply::Kind::good;
    for (std::size_t i = 0; i < word_at(request, 4); ++i) {
      made.words.push_back(static_cast<std::uint16_t>(word_at(reply, 3 + 2 * i)));
    }
  } else if (std::equal(request.begin(), request.begin() + 6, reply.begin())) {
    made.kind = HostReply::Kind::good;
  }
  return made;
}

}  // namespace understudy::emulator::play
