// However a world is stepped, the same events from outside at the same times make the same world: bulk ticks
// or single ones, many small steps or one big one. Random, seeded; UNDERSTUDY_SEED overrides.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <utility>

#include "tests/emulator/world/random_events.h"
#include "tests/emulator/world/stepping.h"

namespace understudy::emulator::world {
namespace world_equivalence_test {

using namespace std::chrono_literals;

std::uint64_t seed() { return seed_or(77'001); }

struct Lively {
  std::uint64_t skipped = 0;
  std::uint64_t run = 0;
  std::uint64_t replies = 0;
  std::int64_t moved = 0;
};

void compare(std::uint64_t seed_value, const std::string& timing, const Stepping& stepping, Lively& sum) {
  RandomEvents random(seed_value);
  const WorldOptions options{.strict_framing = random.between(0, 3) == 0};
  World plain = make_world(timing, 19'200, options);
  World twin = make_world(timing, 19'200, options);
  std::int64_t before = plain.plant(0, 0).position_pulses();
  ASSERT_NO_FATAL_FAILURE(play_both(plain, twin, random.make(250), stepping,
                                    "seed " + std::to_string(seed_value) + " " + timing, [&] {
                                      const std::int64_t now = plain.plant(0, 0).position_pulses();
                                      sum.moved += std::abs(now - std::exchange(before, now));
                                    }));
  sum.skipped += plain.ticks_skipped();
  sum.run += plain.ticks_run();
  for (const auto& station : plain.line(0).stations) sum.replies += station->counters().replies;
}

/// The sequences are meaningful only if much happens in them.
void expect_lively(const Lively& sum) {
  EXPECT_GT(sum.skipped, 10'000u);
  EXPECT_GT(sum.run, 5'000u);
  EXPECT_GT(sum.replies, 1000u);
  EXPECT_GT(sum.moved, 1000);
}

constexpr int kSequences = 12;

void compare_all(std::uint64_t first_seed, const Stepping& stepping) {
  std::cout << "seed " << first_seed << "\n";
  Lively sum;
  for (std::uint64_t i = 0; i < kSequences; ++i) {
    ASSERT_NO_FATAL_FAILURE(compare(first_seed + i, i % 2 == 0 ? "wire" : "instant", stepping, sum));
  }
  expect_lively(sum);
}

TEST(WorldEquivalence, BulkTicksAreSingleTicksBitForBit) { compare_all(seed(), by_single_ticks); }
TEST(WorldEquivalence, OddStepsAreOneBigStep) { compare_all(seed() + 1000, by_odd_steps(seed())); }
TEST(WorldEquivalence, WakingOnlyWhenSomethingIsDueMissesNothing) {
  compare_all(seed() + 2000, by_what_is_due);
}

TEST(WorldEquivalence, FramesGivenInAdvanceAreServedAtTheirTimes) {
  RandomEvents random(seed() + 3000);
  for (int round = 0; round < 10; ++round) {
    World plain = make_world("wire");
    World ahead = make_world("wire");
    SimTime at{0};
    for (int i = 0; i < 40; ++i) {  // within the line's 1024 bytes
      at += SimTime{random.between(6'000'000, 40'000'000)};
      const Bytes frame =
          i == 0 ? write_request(0, 0x1013, 1) : write_request(1 + i % 2, 0x1000 + i % 6, 1 + i);
      plain.advance_to(at);
      plain.receive(0, frame, at);
      ahead.receive(0, frame, at);
    }
    plain.advance_to(at + 1s);
    ahead.advance_to(at + 1s);
    ASSERT_TRUE(same(plain, ahead)) << "round " << round;
  }
}

}  // namespace world_equivalence_test
}  // namespace understudy::emulator::world
