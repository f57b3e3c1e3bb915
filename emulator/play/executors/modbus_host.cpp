#include "emulator/play/executors/modbus_host.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "emulator/device/register_map/row.h"
#include "emulator/play/executors/executor.h"
#include "emulator/world/stations/server.h"
#include "pty/ascii_frame.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::play {

namespace {

constexpr std::uint8_t kException = 0x80;
constexpr std::size_t kExceptionSize = 5;

void put_word(std::vector<std::uint8_t>& frame, std::size_t word) {
  frame.push_back(static_cast<std::uint8_t>(word >> 8));
  frame.push_back(static_cast<std::uint8_t>(word));
}

std::size_t word_at(std::span<const std::uint8_t> frame, std::size_t at) {
  return static_cast<std::size_t>(frame[at] << 8 | frame[at + 1]);
}

using world::FunctionRow;
constexpr std::uint16_t kOn = 0xFF00;

const FunctionRow& require_function(Table table, FunctionRow::Kind kind) {
  if (const FunctionRow* const row = world::function_for(table, kind)) return *row;
  throw std::logic_error("no function writes to inputs; expected coils or holding registers");
}

/// Returns the function of a request that reads, or null for a request that writes.
const FunctionRow* reading_function(std::uint8_t code) {
  for (const FunctionRow& row : world::kModbusFunctions) {
    if (row.code == code && row.kind == FunctionRow::Kind::read) return &row;
  }
  return nullptr;
}

std::size_t bytes_for(Table table, std::size_t count) {
  return is_table_of_bits(table) ? (count + 7) / 8 : 2 * count;
}

void put_data(std::vector<std::uint8_t>& frame, Table table, std::span<const std::uint16_t> words) {
  if (!is_table_of_bits(table)) {
    for (const std::uint16_t word : words) put_word(frame, word);
    return;
  }
  const std::size_t begin = frame.size();
  frame.resize(begin + bytes_for(table, words.size()));
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] != 0) frame[begin + i / 8] |= static_cast<std::uint8_t>(1U << i % 8);
  }
}

std::vector<std::uint8_t> request_of_several(int station, Table table, std::uint16_t first,
                                             std::span<const std::uint16_t> words) {
  std::vector<std::uint8_t> frame{static_cast<std::uint8_t>(station),
                                  require_function(table, FunctionRow::Kind::write_several).code};
  put_word(frame, first);
  put_word(frame, words.size());
  frame.push_back(static_cast<std::uint8_t>(bytes_for(table, words.size())));
  put_data(frame, table, words);
  pty::append_rtu_crc(frame);
  return frame;
}

}  // namespace

std::vector<std::uint8_t> read_request(int station, Table table, std::uint16_t first, int count) {
  std::vector<std::uint8_t> frame{static_cast<std::uint8_t>(station),
                                  require_function(table, FunctionRow::Kind::read).code};
  put_word(frame, first);
  put_word(frame, static_cast<std::size_t>(count));
  pty::append_rtu_crc(frame);
  return frame;
}

std::vector<std::uint8_t> write_request(int station, Table table, std::uint16_t first,
                                        std::span<const std::uint16_t> words) {
  if (words.size() != 1) return request_of_several(station, table, first, words);
  std::vector<std::uint8_t> frame{static_cast<std::uint8_t>(station),
                                  require_function(table, FunctionRow::Kind::write_one).code};
  put_word(frame, first);
  put_word(frame, !is_table_of_bits(table) ? words[0] : words[0] != 0 ? kOn : 0);
  pty::append_rtu_crc(frame);
  return frame;
}

std::vector<std::uint8_t> message_request(int station, std::uint16_t first,
                                          std::span<const std::uint16_t> words) {
  return request_of_several(station, Table::holding, first, words);
}

std::size_t wanted_size(std::span<const std::uint8_t> request, std::span<const std::uint8_t> reply) {
  if (reply.size() >= 2 && (reply[1] & kException) != 0) return kExceptionSize;
  if (const FunctionRow* const row = reading_function(request[1])) {
    return 5 + bytes_for(row->table, word_at(request, 4));
  }
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
  } else if (const FunctionRow* const row = reading_function(request[1])) {
    const std::size_t count = word_at(request, 4);
    if (reply[2] != bytes_for(row->table, count)) return made;
    made.kind = HostReply::Kind::good;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t value =
          is_table_of_bits(row->table) ? reply[3 + i / 8] >> i % 8 & 1U : word_at(reply, 3 + 2 * i);
      made.words.push_back(static_cast<std::uint16_t>(value));
    }
  } else if (std::equal(request.begin(), request.begin() + 6, reply.begin())) {
    made.kind = HostReply::Kind::good;
  }
  return made;
}

HostReply judge_ascii_reply(std::span<const std::uint8_t> request, std::span<const std::uint8_t> reply) {
  const auto frame = pty::rtu_of_ascii(reply);
  HostReply made = judge_reply(request, frame ? std::span<const std::uint8_t>(*frame) : reply);
  made.bytes.assign(reply.begin(), reply.end());
  return made;
}

}  // namespace understudy::emulator::play
