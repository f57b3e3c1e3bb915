#include "emulator/box/asking/modbus_exchange.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <thread>

#include "emulator/box/asking/asked.h"
#include "emulator/box/wire/wire.h"
#include "emulator/play/executors/modbus_host.h"
#include "emulator/serve/loop/event_loop.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::box {

namespace {

constexpr std::size_t kChecksum = 2;
constexpr std::size_t kHeader = 6;  // of Modbus TCP: transaction, protocol, length

std::size_t length_in(const Bytes& frame) { return static_cast<std::size_t>(frame[4] << 8 | frame[5]); }

/// A reply to a read never begins with the request: where the request has the upper half of an address, the
/// reply has its length. A reply to a write may be equal to it.
constexpr bool is_read(const Bytes& request) {
  return request.size() > 1 && request[1] >= 1 && request[1] <= 4;
}

bool begins_with(const Bytes& bytes, const Bytes& request) {
  return bytes.size() >= request.size() && std::equal(request.begin(), request.end(), bytes.begin());
}

}  // namespace

Bytes ModbusExchange::ask_rtu(const Bytes& request, Asked& asked) {
  const WallTime begin = serve::wall_now();
  wire_.send(request);
  const WallTime deadline = begin + settings_.timeout;
  Bytes reply;
  while (serve::wall_now() < deadline) {
    if (!wire_.receive(reply, deadline)) continue;
    asked.latency = serve::wall_now() - begin;
    const bool may_echo = is_read(request) || is_echoing_;
    if (may_echo && !asked.was_echoed && begins_with(reply, request)) {
      asked.was_echoed = is_echoing_ = true;
      reply.erase(reply.begin(), reply.begin() + static_cast<std::ptrdiff_t>(request.size()));
    }
    const bool may_be_echo = may_echo && !asked.was_echoed && reply.size() < request.size() &&
                             std::equal(reply.begin(), reply.end(), request.begin());
    if (reply.size() < 2 || may_be_echo) continue;
    if (reply.size() >= play::wanted_size(request, reply)) break;
  }
  return reply;
}

Bytes ModbusExchange::ask_tcp(const Bytes& request, Asked& asked) {
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
  if (received.size() < kHeader || received.size() < kHeader + length_in(received))
    return received;  // it is not a reply, but something has come
  Bytes reply(received.begin() + kHeader,
              received.begin() + static_cast<std::ptrdiff_t>(kHeader + length_in(received)));
  pty::append_rtu_crc(reply);
  return reply;
}

void ModbusExchange::keep_silence() {
  const WallTime rest = quiet_since_ + settings_.silence - serve::wall_now();
  if (rest > WallTime{0}) std::this_thread::sleep_for(rest);
}

Asked ModbusExchange::ask(const Bytes& request) {
  keep_silence();
  wire_.discard();
  Asked asked{.request = request, .reply = {}};
  asked.reply = settings_.is_tcp ? ask_tcp(request, asked) : ask_rtu(request, asked);
  quiet_since_ = serve::wall_now();
  return asked;
}

}  // namespace understudy::emulator::box
