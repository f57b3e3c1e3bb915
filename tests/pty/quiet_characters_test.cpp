// Characters that arrive at one moment are passed on together if nothing is due between them: the result is
// the same as one by one.
#include <gtest/gtest.h>

#include <random>

#include "pty/line.h"
#include "pty/rtu_crc.h"
#include "pty/rtu_framer.h"
#include "tests/pty/fake_station.h"

namespace understudy::pty {
namespace quiet_characters_test {

using namespace std::chrono_literals;

const Bytes kReply = hex("01 03 02 C0 01 29 84");

/// A read, a write of some registers, one with a wrong checksum, or noise.
Bytes random_piece(std::mt19937_64& random) {
  const auto any = [&](std::uint64_t below) { return static_cast<std::uint8_t>(random() % below); };
  Bytes bytes;
  switch (random() % 4) {
    case 0: bytes = {any(3), 0x03, any(4), any(255), 0, 1}; break;
    case 1: {
      const std::uint8_t count = any(5);
      bytes = {any(3), 0x10, 0x1F, 0x40, 0, count, static_cast<std::uint8_t>(2 * count)};
      for (int i = 0; i < 2 * count; ++i) bytes.push_back(any(255));
      break;
    }
    case 2: bytes = {1, static_cast<std::uint8_t>(0x41 + any(8)), any(255), any(255)}; break;
    default:
      for (std::uint64_t left = random() % 12; left > 0; --left) bytes.push_back(any(255));
      return bytes;
  }
  append_rtu_crc(bytes);
  if (random() % 8 == 0) bytes.back() ^= 1;
  return bytes;
}

Bytes random_lump(std::mt19937_64& random) {
  Bytes lump;
  for (std::uint64_t left = 1 + random() % 4; left > 0; --left) {
    const Bytes piece = random_piece(random);
    lump.insert(lump.end(), piece.begin(), piece.end());
  }
  return lump;
}

TEST(QuietCharacters, OfAFramerAreNotDueBeforeTheLast) {
  int jumps = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    std::mt19937_64 random(seed);
    RtuFramer framer({.strict = seed % 5 == 0,
                      .silence = seed % 2 == 0 ? SimTime(0) : SimTime(750us),
                      .patience = seed % 7 == 0 ? SimTime(0) : SimTime(10ms)});
    SimTime moment{0};
    for (int i = 0; i < 30; ++i) {
      moment += random() % 3 == 0 ? 20ms : 1ms;
      while (const auto frame = framer.take_due(moment)) EXPECT_GT(frame->size, 3U);
      const Bytes lump = random_lump(random);
      for (std::size_t at = 0; at < lump.size();) {
        std::size_t quiet = framer.quiet_characters();
        jumps += quiet > 1 ? 1 : 0;
        // The first of a lump may end a silence.
        for (quiet = at == 0 ? 1 : std::max<std::size_t>(quiet, 1); quiet > 0 && at < lump.size(); --quiet) {
          framer.push({.start = moment, .end = moment, .value = lump[at++]});
          const auto due = framer.due();
          ASSERT_TRUE(quiet == 1 || !due || *due > moment) << "seed " << seed << ", character " << at;
        }
        while (framer.take_due(moment)) {
        }
      }
    }
  }
  EXPECT_GT(jumps, 1000);
}

TEST(QuietCharacters, AreThoseThatAWriteStillLacks) {
  for (const bool is_strict : {false, true}) {
    RtuFramer framer({.strict = is_strict, .silence = 750us, .patience = 10ms});
    for (const std::uint8_t value : hex("01 10 1F 40 00 02 04"))
      framer.push({.start = 1ms, .end = 1ms, .value = value});
    EXPECT_EQ(framer.quiet_characters(), is_strict ? 0U : 6U);
  }
}

/// Tells the line how long it is quiet.
class QuietSlave final : public FakeSlave {
 public:
  using FakeSlave::FakeSlave;
  std::size_t quiet_characters() const override { return framer_.quiet_characters(); }
};

struct Course {
  Bytes received, out;
  std::vector<SimTime> served_at, out_at;
  std::uint64_t unheard = 0;

  bool operator==(const Course&) const = default;
};

template <class Slave>
Course course(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  LineRig rig({.settings = {}, .timing = Timing::instant});
  Slave slave(1, kReply, {.silence = 0s, .patience = 10ms});
  rig.line.attach(slave);
  rig.line.host_opened();
  SimTime now{0};
  for (int i = 0; i < 20; ++i) {
    if (random() % 4 == 0) rig.line.host_settings(HostSettings{.baud = random() % 3 == 0 ? 9600 : 19200});
    const Bytes lump = random_lump(random);
    if (random() % 5 == 0) {
      rig.line.receive_departed(random_lump(random), now);
    }
    rig.send(lump, now);
    rig.run(now);
    now += random() % 2 == 0 ? 1ms : 30ms;
    rig.run(now);
  }
  Course made;
  made.out = rig.out;
  made.served_at = slave.served_at;
  made.out_at = rig.out_at;
  for (const TimedByte& byte : slave.received) made.received.push_back(byte.value);
  made.unheard = rig.line.counters().bytes_unheard;
  return made;
}

TEST(QuietCharacters, OfALineMakeNoDifference) {
  std::size_t answered = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    const Course one_by_one = course<FakeSlave>(seed);
    ASSERT_EQ(course<QuietSlave>(seed), one_by_one) << "seed " << seed;
    answered += one_by_one.out.size();
  }
  EXPECT_GT(answered, 1000U);
}

}  // namespace quiet_characters_test
}  // namespace understudy::pty
