#include "emulator/box/asking/modbus_master.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <utility>

#include "emulator/box/asking/asked.h"
#include "emulator/box/wire/wire.h"
#include "emulator/device/register_map/row.h"
#include "emulator/play/stages/executor.h"
#include "emulator/play/stages/modbus_host.h"
#include "emulator/serve/loop/event_loop.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::box {

namespace {

constexpr std::size_t kChecksum = 2;
constexpr std::size_t kHeader = 6;  // of Modbus TCP: transaction, protocol, length

std::size_t length_in(const Bytes& frame) { return static_cast<std::size_t>(frame[4] << 8 | frame[5]); }

/// Returns true if the bytes begin with all of the request. A reply to a read can do so only if its length
/// equals the upper half of the address, and its values the rest of the request.
bool begins_with(const Bytes& bytes, const Bytes& request) {
  return bytes.size() >= request.size() && std::equal(request.begin(), request.end(), bytes.begin());
}

}  // namespace

Bytes ModbusMaster::exchange(const Bytes& request, Asked& asked) {
  const WallTime begin = serve::wall_now();
  wire_.send(request);
  const WallTime deadline = begin + settings_.timeout;
  Bytes reply;
  while (serve::wall_now() < deadline) {
    if (!wire_.receive(reply, deadline)) continue;
    asked.latency = serve::wall_now() - begin;
    if (!asked.was_echoed && begins_with(reply, request)) {
      asked.was_echoed = true;
      reply.erase(reply.begin(), reply.begin() + static_cast<std::ptrdiff_t>(request.size()));
    }
    const bool may_be_echo = !asked.was_echoed && reply.size() < request.size() &&
                             std::equal(reply.begin(), reply.end(), request.begin());
    if (reply.size() < 2 || may_be_echo) continue;
    if (reply.size() >= play::wanted_size(request, reply)) break;
  }
  return reply;
}

Bytes ModbusMaster::exchange_tcp(const Bytes& request, Asked& asked) {
  ++transaction_;
  const std::size_t size = request.size() - kChecksum;
  Bytes sent{static_cast<std::uint8_t>(transaction_ >> 8), static_cast<std::uint8_t>(transaction_), 0, 0,
             static_cast<std::uint8_t>(size >> 8),         static_cast<std::uint8_t>(size)};
  sent.insert(sent.end(), request.begin(), request.end() - kChecksum);
  const WallTime begin = serve::wall_now();
  wire_.send(sent);
  const WallTime deadline = begin + settings_.timeout;
  Bytes received;
  while (serve::wall_now() < deadline) {
    if (received.size() >= kHeader && received.size() >= kHeader + length_in(received)) {
      if (std::equal(sent.begin(), sent.begin() + 2, received.begin())) break;
      // A late answer to an earlier request.
      received.erase(received.begin(),
                     received.begin() + static_cast<std::ptrdiff_t>(kHeader + length_in(received)));
      continue;
    }
    if (wire_.receive(received, deadline)) asked.latency = serve::wall_now() - begin;
  }
  if (received.size() < kHeader || received.size() < kHeader + length_in(received)) return {};
  Bytes reply(received.begin() + kHeader,
              received.begin() + static_cast<std::ptrdiff_t>(kHeader + length_in(received)));
  pty::append_rtu_crc(reply);
  return reply;
}

ReadReply ModbusMaster::read(Table table, std::uint16_t first, int count) {
  const WallTime rest = quiet_since_ + settings_.silence - serve::wall_now();
  if (rest > WallTime{0}) std::this_thread::sleep_for(rest);
  wire_.discard();
  ReadReply result;
  result.asked.request = play::read_request(settings_.station, table, first, count);
  const Bytes& request = result.asked.request;
  result.asked.reply =
      settings_.is_tcp ? exchange_tcp(request, result.asked) : exchange(request, result.asked);
  const Bytes& reply = result.asked.reply;
  result.reply = play::judge_reply(request, reply);
  if (reply.size() > kChecksum && reply[0] != request[0] && pty::rtu_crc_ok(reply))
    result.other_station = reply[0];
  quiet_since_ = serve::wall_now();
  return result;
}

}  // namespace understudy::emulator::box
