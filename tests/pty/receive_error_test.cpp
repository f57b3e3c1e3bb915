// The error that a framer reports for data that it drops: once per lump, and the same under both rules.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "pty/rtu_crc.h"
#include "pty/rtu_framer.h"

namespace understudy::pty {
namespace receive_error_test {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;

constexpr RtuFraming kStrict{.strict = true, .silence = 750us, .patience = 10ms};
constexpr RtuFraming kTolerant{.strict = false, .silence = 750us, .patience = 10ms};
constexpr SimTime kCharacter = 573us;

Bytes with_crc(Bytes bytes) {
  append_rtu_crc(bytes);
  return bytes;
}
const Bytes kGood = with_crc({0x01, 0x03, 0x00, 0x01, 0x00, 0x01});

Bytes part_of(const Bytes& bytes, std::size_t count) { return {bytes.begin(), bytes.begin() + count}; }
Bytes joined(Bytes bytes, const Bytes& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
  return bytes;
}

/// Sends lumps with long silences between, and asks after each call, as a station does.
struct Receiver {
  explicit Receiver(RtuFraming framing) : framer(framing) {}
  void send(const Bytes& lump) {
    for (const std::uint8_t value : lump) {
      framer.start_bit(now);
      take_errors();
      framer.push({.start = now, .end = now + kCharacter, .value = value});
      take_errors();
      now += kCharacter;
    }
    for (auto at = framer.due(); at; at = framer.due()) {
      now = std::max(now, *at);
      const bool is_frame = framer.take_due(now).has_value();
      take_errors();
      if (is_frame) errors += "frame ";
    }
    now += 100ms;
  }
  void take_errors() {
    while (const auto error = framer.take_error()) {
      errors += std::vector<std::string>{"bad_checksum ", "overlong ", "cut_off "}[static_cast<int>(*error)];
    }
  }
  RtuFramer framer;
  SimTime now{0};
  std::string errors;
};

struct Lump {
  std::string what;
  std::vector<Bytes> lumps;
  std::string strict;
  std::string tolerant;
};

std::vector<Lump> lumps() {
  Bytes wrong = kGood;
  wrong.back() ^= 1;
  const Bytes several = with_crc({0x01, 0x10, 0x00, 0x01, 0x00, 0x02, 0x04, 1, 2, 3, 4});
  const Bytes ones(300, 0x01);
  const Bytes noise(300, 0xFF);
  const Bytes max_noise(700, 0xFF);
  return {
      {"a good frame", {kGood}, "frame ", "frame "},
      {"a wrong checksum", {wrong}, "bad_checksum ", "bad_checksum "},
      {"twice", {wrong, wrong}, "bad_checksum bad_checksum ", "bad_checksum bad_checksum "},
      {"and a good one after", {wrong, kGood}, "bad_checksum frame ", "bad_checksum frame "},
      {"one byte", {{0x01}}, "cut_off ", "cut_off "},
      {"seven of eight", {part_of(kGood, 7)}, "cut_off ", "cut_off "},
      {"before its byte count", {part_of(several, 6)}, "cut_off ", "cut_off "},
      {"before its data are in", {part_of(several, 9)}, "cut_off ", "cut_off "},
      {"an unknown function", {{0x01, 0x64, 0x00, 0x00, 0x00}}, "bad_checksum ", "bad_checksum "},
      {"a byte count that lies", {{0x01, 0x10, 0, 0, 0, 1, 0xFF, 0, 1, 2}}, "bad_checksum ", "bad_checksum "},
      {"noise longer than a frame", {noise}, "overlong ", "overlong "},
      {"noise much longer", {max_noise}, "overlong ", "overlong "},
      {"what might be a frame, too long", {ones}, "overlong ", "overlong "},
      {"twice too long", {noise, noise}, "overlong overlong ", "overlong overlong "},
      {"too long, then cut off", {max_noise, {0x01, 0x03}}, "overlong cut_off ", "overlong cut_off "},
      {"a frame with noise behind it", {joined(kGood, {0xFF, 0xFF})}, "bad_checksum ", "frame cut_off "},
      {"noise, then a frame", {joined({0xFF, 0xFF}, kGood)}, "bad_checksum ", "cut_off frame "},
  };
}

TEST(ReceiveError, IsReportedOnceForALump) {
  for (const auto& [what, sent, strict, tolerant] : lumps()) {
    Receiver by_silence(kStrict);
    Receiver by_length(kTolerant);
    for (const Bytes& lump : sent) {
      by_silence.send(lump);
      by_length.send(lump);
    }
    EXPECT_EQ(by_silence.errors, strict) << what << ", strict";
    EXPECT_EQ(by_length.errors, tolerant) << what << ", tolerant";
  }
}

TEST(ReceiveError, IsNotThatAnotherStationSpoke) {
  Receiver receiver(kStrict);
  receiver.framer.push({.start = 0us, .end = kCharacter, .value = 0x01});
  receiver.framer.reset();
  receiver.now = 1s;
  receiver.send(kGood);
  EXPECT_EQ(receiver.errors, "frame ");
}

TEST(ReceiveError, IsTheSameAfterARestoreInTheMiddle) {
  for (const RtuFraming& framing : {kStrict, kTolerant}) {
    Receiver whole(framing);
    Receiver again(framing);
    for (int i = 0; i < 600; ++i) {
      for (Receiver* receiver : {&whole, &again}) {
        receiver->framer.push({.start = receiver->now, .end = receiver->now + kCharacter, .value = 0xFF});
        receiver->take_errors();
        receiver->now += kCharacter;
      }
      if (i % 50 != 49) continue;
      RtuFramer fresh(framing);
      fresh.restore(again.framer.save());
      again.framer = fresh;
    }
    whole.send({});
    again.send({});
    EXPECT_EQ(again.errors, "overlong ");
    EXPECT_EQ(again.errors, whole.errors);
    EXPECT_EQ(again.framer.dropped_bytes(), 600U);
  }
}

}  // namespace receive_error_test
}  // namespace understudy::pty
