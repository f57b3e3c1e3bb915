#include "emulator/box/asking/modbus_exchange.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include "emulator/box/asking/asked.h"
#include "emulator/box/wire/wire.h"
#include "emulator/play/executors/executor.h"
#include "emulator/play/executors/modbus_host.h"
#include "emulator/serve/loop/event_loop.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::box {

namespace {

constexpr WallTime kReplySlice = std::chrono::milliseconds(50);
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
    if (!receive(reply, deadline)) continue;
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
    if (receive(received, deadline)) asked.latency = serve::wall_now() - begin;
  }
  if (received.size() < kHeader || received.size() < kHeader + length_in(received))
    return received;  // it is not a reply, but something has come
  Bytes reply(received.begin() + kHeader,
              received.begin() + static_cast<std::ptrdiff_t>(kHeader + length_in(received)));
  pty::append_rtu_crc(reply);
  return reply;
}

bool ModbusExchange::receive(Bytes& bytes, WallTime deadline) {
  if (settings_.heartbeat) settings_.heartbeat();
  return wire_.receive(bytes, std::min(deadline, serve::wall_now() + kReplySlice));
}

/// After an unexpected reply, the silence must be longer, because an adapter may hold its rest back.
void ModbusExchange::keep_silence() {
  const WallTime begin = serve::wall_now();
  Bytes dropped;
  while (true) {
    const WallTime silence = settings_.silence + (is_unsettled_ ? kAdapterDelay : WallTime{0});
    const WallTime until = std::min(quiet_since_ + silence, begin + kLongestUnrest);
    if (!wire_.receive(dropped, until)) {
      if (serve::wall_now() < until) continue;
      break;
    }
    dropped.clear();
    note_traffic(true);
    if (serve::wall_now() - begin >= kLongestUnrest) break;
  }
  is_unsettled_ = false;
}

void ModbusExchange::note_traffic(bool is_unsettled) {
  quiet_since_ = serve::wall_now();
  is_unsettled_ = is_unsettled;
}

Asked ModbusExchange::ask(const Bytes& request) {
  keep_silence();
  note_traffic(true);  // also if the wait for the reply is given up
  Asked asked{.request = request, .reply = {}};
  asked.reply = settings_.is_tcp ? ask_tcp(request, asked) : ask_rtu(request, asked);
  using Kind = play::HostReply::Kind;
  const Kind kind = play::judge_reply(request, asked.reply).kind;
  note_traffic((kind == Kind::garbled || kind == Kind::silence) && !settings_.is_tcp);
  return asked;
}

}  // namespace understudy::emulator::box
