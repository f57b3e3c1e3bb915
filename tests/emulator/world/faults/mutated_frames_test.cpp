// 10,000 mutated frames between valid ones change nothing, and the valid ones get replies.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "emulator/device/register_map/register_bank.h"
#include "tests/emulator/world/faults/faulty_line.h"

namespace understudy::emulator::world {
namespace mutated_frames_test {

/// Returns true if any part of it is a frame with a correct checksum: then it is not a mutant but another
/// request.
bool holds_a_good_frame(const Bytes& bytes) {
  for (std::size_t first = 0; first + 4 <= bytes.size(); ++first) {
    for (std::size_t size = 4; first + size <= bytes.size(); ++size) {
      const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(first);
      const Bytes body(begin, begin + static_cast<std::ptrdiff_t>(size - 2));
      if (with_crc(body) == Bytes(begin, begin + static_cast<std::ptrdiff_t>(size))) return true;
    }
  }
  return false;
}

class Mutants {
 public:
  explicit Mutants(std::uint64_t seed) : random_(seed) {}

  Bytes next() {
    const std::vector<Bytes> good{kSetSpeed, kSetMove,   kSwitchServoOn,
                                  kMove,     kAskFeeder, with_crc({0x00, 0x06, 0x10, 0x02, 0x00, 0x64})};
    while (true) {
      Bytes bytes = good[below(good.size())];
      for (std::size_t i = 0; i <= below(3); ++i) mutate(bytes);
      if (!bytes.empty() && !holds_a_good_frame(bytes)) return bytes;
    }
  }

 private:
  std::size_t below(std::size_t count) { return random_() % count; }
  std::uint8_t byte() { return static_cast<std::uint8_t>(random_()); }
  std::ptrdiff_t place(const Bytes& bytes) { return static_cast<std::ptrdiff_t>(below(bytes.size() + 1)); }

  void mutate(Bytes& bytes) {
    switch (below(6)) {
      case 0:
        if (!bytes.empty()) bytes[below(bytes.size())] ^= static_cast<std::uint8_t>(1U << below(8));
        break;
      case 1:
        if (!bytes.empty()) bytes[below(bytes.size())] = byte();
        break;
      case 2: bytes.resize(below(bytes.size() + 1)); break;
      case 3: bytes.insert(bytes.begin() + place(bytes), byte()); break;
      case 4: bytes.erase(bytes.begin(), bytes.begin() + place(bytes)); break;
      default:
        for (std::size_t i = 0; i < below(40); ++i) bytes.push_back(byte());
        break;
    }
  }

  std::mt19937_64 random_;
};

void expect_unmoved(std::uint64_t seed, bool is_strict) {
  FaultyLine line("", {.strict_framing = is_strict});
  Mutants mutants(seed);
  const auto image = [&](std::size_t device) {
    const auto words = std::as_const(line.world()).device(device).register_bank()->image();
    return std::vector<std::uint32_t>(words.begin(), words.end());
  };
  const auto feeder = image(0);
  const auto turner = image(1);
  for (int i = 0; i < 2500; ++i) {
    const Bytes mutant = mutants.next();
    ASSERT_EQ(line.ask(mutant).bytes, Bytes{}) << hex(mutant);
    ASSERT_EQ(image(0), feeder) << hex(mutant);
    ASSERT_EQ(image(1), turner) << hex(mutant);
    ASSERT_EQ(line.ask(kAskFeeder), (Answer{kUsual, kFeederSays})) << "after " << hex(mutant);
    if (i % 4 != 0) continue;
    ASSERT_EQ(line.ask(kAskTurner), (Answer{kUsual, kTurnerSays})) << "after " << hex(mutant);
  }
  EXPECT_EQ(line.world().line(0).stations[0]->counters().requests, 2500u);
}

TEST(MutatedFrames, ChangeNothingAndGoodOnesBetweenThemAreAnswered) {
  for (const std::uint64_t seed : {1u, 2u}) expect_unmoved(seed, false);
}

TEST(MutatedFrames, OfAHostThatIsReceivedStrictlyToo) {
  for (const std::uint64_t seed : {3u, 4u}) expect_unmoved(seed, true);
}

}  // namespace mutated_frames_test
}  // namespace understudy::emulator::world
