// Input from masters to a gateway, and from the line back to it, complete or not. However it is cut into
// pieces, the line gets the frames of the messages that the standard knows, one after another, up to the
// first one without a known length; the masters get complete replies; nothing grows without bound.
//
// The first byte says how the input is cut and what the line replies; the rest is the input.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "emulator/serve/ports/modbus_tcp.h"
#include "pty/rtu_crc.h"
#include "tests/fuzz/fuzzing.h"

namespace {

using namespace understudy;
using emulator::serve::GatewayRules;
using emulator::serve::ModbusTcp;
using fuzzing::require;
using Bytes = ModbusTcp::Bytes;
using Frames = std::vector<Bytes>;

constexpr std::size_t kLongest = 4000;
constexpr std::size_t kRoom = 256;
constexpr std::size_t kHeader = 6;

/// The frames that the line should get, by the standard alone.
struct Expected {
  Frames frames;
  bool is_refused = false;
};

Expected expected_of(std::span<const std::uint8_t> sent) {
  Expected expected;
  while (sent.size() >= kHeader) {
    const std::size_t length = std::size_t{sent[4]} << 8 | sent[5];
    if (length < 2 || length > 254) {
      expected.is_refused = true;
      break;
    }
    if (sent.size() < kHeader + length) break;
    Bytes frame(sent.begin() + kHeader, sent.begin() + static_cast<std::ptrdiff_t>(kHeader + length));
    if (sent[2] == 0 && sent[3] == 0) {
      pty::append_rtu_crc(frame);
      expected.frames.push_back(frame);
    }
    sent = sent.subspan(kHeader + length);
  }
  return expected;
}

/// The line's replies to a frame: alternately the right one, half of it, something else, nothing.
void answer(ModbusTcp& gateway, const Bytes& frame, unsigned how) {
  Bytes reply{frame[0], static_cast<std::uint8_t>(frame[1] | 0x80), 2};
  pty::append_rtu_crc(reply);
  switch (how % 4) {
    case 0: gateway.receive_from_line(reply); break;
    case 1: gateway.receive_from_line(std::span(reply).first(3)); break;
    case 2: gateway.receive_from_line(frame); break;
    default: break;
  }
  gateway.give_up();
}

void serve(ModbusTcp& gateway, Frames& frames, unsigned how) {
  for (Bytes frame = gateway.take_for_line(kRoom); !frame.empty(); frame = gateway.take_for_line(kRoom)) {
    require(pty::rtu_crc_ok(frame) && frame.size() >= 4 && frame.size() <= kRoom, "it is a frame");
    require(gateway.waits() && gateway.patience(), "its answer is waited for");
    require(gateway.take_for_line(kRoom).empty(), "one at a time");
    frames.push_back(frame);
    answer(gateway, frame, how + static_cast<unsigned>(frames.size()));
    require(!gateway.waits(), "and for no more");
    const Bytes sent = gateway.take_for_client();
    require(sent.size() <= 260, "answers are bounded");
    if (!sent.empty()) require(sent.size() >= 8 && sent.size() == kHeader + sent[5], "and whole");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1 || size > kLongest) return 0;
  const std::span<const std::uint8_t> sent(data + 1, size - 1);
  const Expected expected = expected_of(sent);
  const std::size_t pieces[] = {sent.size() + 1, std::size_t{1} + data[0] % 16, 1};
  for (const std::size_t piece : pieces) {
    ModbusTcp gateway;
    Frames frames;
    bool is_refused = false;
    for (std::size_t at = 0; at < sent.size() && !is_refused; at += piece) {
      require(gateway.has_room(), "what is served makes room");
      is_refused = !gateway.receive_from_client(sent.subspan(at, std::min(piece, sent.size() - at)));
      serve(gateway, frames, data[0] >> 4);
    }
    if (is_refused) require(!gateway.receive_from_client(sent), "what was refused stays so");
    require(is_refused == expected.is_refused, "a length is refused that no message has");
    gateway.client_gone();
    serve(gateway, frames, data[0] >> 4);
    require(frames == expected.frames, "the line gets what the standard says");
    require(gateway.is_idle() || !is_refused, "nothing is left");
  }
  return 0;
}
