// However a world is stepped, the same things from outside at the same times make the same world: bulk
// ticks or single ones, many small steps or one big one. Random, seeded; UNDERSTUDY_SEED overrides.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "tests/emulator/world/random_events.h"

namespace understudy::emulator {
namespace {

using namespace std::chrono_literals;

std::uint64_t seed() {
  const char* given = std::getenv("UNDERSTUDY_SEED");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : 77'001;
}

testing::AssertionResult same(World& one, World& other) {
  const auto differ = [&](const std::string& what) {
    return testing::AssertionFailure() << what << " differs";
  };
  if (one.now() != other.now()) return differ("the time");
  if (one.next_due() != other.next_due()) return differ("what is due");
  for (std::size_t d = 0; d < 2; ++d) {
    if (!one.device(d).same_state(other.device(d))) return differ(one.device(d).name());
    for (int i = 0; i < 18; ++i) {
      if (one.device(d).input(i) != other.device(d).input(i)) return differ("an input");
      if (one.device(d).output(i) != other.device(d).output(i)) return differ("an output");
    }
    for (int axis = 0; axis < 2; ++axis) {
      const PlantAxis& machine = one.plant(d, axis);
      const PlantAxis& twin = other.plant(d, axis);
      if (machine.position_pulses() != twin.position_pulses()) return differ("a machine");
      if (machine.lost_pulses() != twin.lost_pulses()) return differ("what a machine lost");
    }
  }
  if (take_output(one) != take_output(other)) return differ("what the line says");
  return testing::AssertionSuccess();
}

struct Lively {
  std::uint64_t crossed = 0;
  std::uint64_t run = 0;
  std::uint64_t replies = 0;
  std::int64_t moved = 0;
};

/// `step(world, to)` brings the second world to a time, in whatever way is to be compared.
template <typename Step>
Lively compare(std::uint64_t seed_value, const std::string& timing, Step step) {
  RandomEvents random(seed_value);
  const WorldOptions options{.strict_framing = random.between(0, 3) == 0};
  World plain = make_world(timing, 19'200, options);
  World twin = make_world(timing, 19'200, options);
  const std::vector<Event> events = random.make(250);
  Lively lively;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const std::int64_t before = plain.plant(0, 0).position_pulses();
    plain.advance_to(events[i].at);
    step(twin, events[i].at);
    lively.moved += std::abs(plain.plant(0, 0).position_pulses() - before);
    EXPECT_TRUE(same(plain, twin)) << "seed " << seed_value << " " << timing << " before event " << i
                                   << " at " << format_duration(events[i].at);
    if (testing::Test::HasFailure()) return lively;
    apply(plain, events[i]);
    apply(twin, events[i]);
  }
  const SimTime end = events.back().at + 40s;
  plain.advance_to(end);
  step(twin, end);
  EXPECT_TRUE(same(plain, twin)) << "seed " << seed_value << " " << timing << " at the end";
  lively.crossed = plain.ticks_crossed();
  lively.run = plain.ticks_run();
  for (const auto& station : plain.line(0).stations) lively.replies += station->counters().replies;
  return lively;
}

/// The sequences are worth something only if much happens in them.
void expect_lively(const Lively& sum) {
  EXPECT_GT(sum.crossed, 10'000u);
  EXPECT_GT(sum.run, 10'000u);
  EXPECT_GT(sum.replies, 1000u);
  EXPECT_GT(sum.moved, 1000);
}

constexpr int kSequences = 12;

template <typename Step>
void compare_all(std::uint64_t first_seed, Step step) {
  Lively sum;
  for (std::uint64_t i = 0; i < kSequences && !testing::Test::HasFailure(); ++i) {
    const Lively one = compare(first_seed + i, i % 2 == 0 ? "wire" : "instant", step);
    sum.crossed += one.crossed;
    sum.run += one.run;
    sum.replies += one.replies;
    sum.moved += one.moved;
  }
  if (!testing::Test::HasFailure()) expect_lively(sum);
}

TEST(WorldEquivalence, BulkTicksAreSingleTicksBitForBit) {
  std::cout << "seed " << seed() << "\n";
  compare_all(seed(), [](World& world, SimTime to) {
    world.set_bulk_ticks(false);
    world.advance_to(to);
    EXPECT_EQ(world.ticks_crossed(), 0u);
  });
}

TEST(WorldEquivalence, OddStepsAreOneBigStep) {
  std::cout << "seed " << seed() + 1000 << "\n";
  std::mt19937_64 steps(seed());
  compare_all(seed() + 1000, [&](World& world, SimTime to) {
    while (world.now() < to) {
      constexpr SimTime kSteps[] = {1ns, 333'333ns, 1ms, 7ms - 1ns, 17'001'003ns, 500ms};
      world.advance_to(std::min(to, world.now() + kSteps[steps() % std::size(kSteps)]));
    }
    world.advance_to(to);
  });
}

TEST(WorldEquivalence, WakingOnlyWhenSomethingIsDueMissesNothing) {
  std::cout << "seed " << seed() + 2000 << "\n";
  compare_all(seed() + 2000, [&](World& world, SimTime to) {
    int idle_turns = 0;
    while (const auto due = world.next_due()) {
      if (*due > to) break;
      const SimTime before = world.now();
      world.advance_to(*due);
      idle_turns = world.now() == before ? idle_turns + 1 : 0;
      ASSERT_LT(idle_turns, 10) << "due again and again at " << format_duration(*due);
    }
    world.advance_to(to);
  });
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
      plain.line(0).line.receive(frame, at);
      ahead.line(0).line.receive(frame, at);
    }
    plain.advance_to(at + 1s);
    ahead.advance_to(at + 1s);
    ASSERT_TRUE(same(plain, ahead)) << "round " << round;
  }
}

}  // namespace
}  // namespace understudy::emulator
