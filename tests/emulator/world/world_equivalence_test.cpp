// However a world is stepped, the same things from outside at the same times make the same world: bulk
// ticks or single ones, many small steps or one big one. Random, seeded; UNDERSTUDY_SEED overrides.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "tests/emulator/world/two_devices.h"

namespace understudy::emulator {
namespace {

using namespace std::chrono_literals;

std::uint64_t seed() {
  const char* given = std::getenv("UNDERSTUDY_SEED");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : 77'001;
}

/// Something from outside: bytes on the line, or an input's level.
struct Event {
  SimTime at{0};
  Bytes bytes{};
  std::size_t device = 0;
  int terminal = -1;
  bool on = false;
};

class RandomEvents {
 public:
  explicit RandomEvents(std::uint64_t seed_value) : random_(seed_value) {}

  std::int64_t between(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }

  std::vector<Event> make(int count) {
    std::vector<Event> events;
    for (int i = 0; i < count; ++i) {
      time_ += gap();
      Event event{.at = time_};
      if (between(0, 4) == 0) {
        event.device = static_cast<std::size_t>(between(0, 1));
        event.terminal = static_cast<int>(between(0, 10));
        event.on = between(0, 1) == 1;
      } else {
        event.bytes = bytes();
      }
      events.push_back(event);
    }
    return events;
  }

 private:
  SimTime gap() {
    switch (between(0, 6)) {
      case 0: return SimTime{between(0, 2'000'000)};
      case 1: return SimTime{between(0, 50'000'000)};
      case 2: return SimTime{between(0, 3'000'000'000)};
      case 3: return (kTickLength - time_ % kTickLength);            // the next tick sharp
      case 4: return (kTickLength - time_ % kTickLength) * 2 - 1ns;  // just before or after one
      default: return SimTime{between(8'000'000, 20'000'000)};       // as a host polls
    }
  }

  Bytes bytes() {
    const auto station = static_cast<int>(between(0, 9) == 0 ? between(0, 4) : between(1, 2));
    switch (between(0, 9)) {
      case 0: {  // noise
        Bytes noise;
        for (auto n = between(1, 20); n > 0; --n) noise.push_back(static_cast<std::uint8_t>(between(0, 255)));
        return noise;
      }
      case 1: return read_request(station, 0x0000, 1);
      case 2: return read_request(station, 0x0E00, 8);
      case 3: return read_request(station, static_cast<int>(between(0, 0xFFFF)), 2);
      case 4:
        return write_request(station, static_cast<int>(between(0x0A00, 0x0A0D)),
                             static_cast<int>(between(0, 1)));
      case 5: return whole_move(station);
      case 6: return write_request(station, 0x1013, between(0, 5) > 0 ? 1 : 0);
      default: {
        constexpr int kAddresses[] = {0x0D00, 0x0D04, 0x0D05, 0x0DF0, 0x0E00, 0x0E04, 0x1000, 0x1002, 0x1003,
                                      0x1005, 0x100B, 0x100C, 0x100D, 0x1013, 0x1014, 0x1016, 0x1017, 0x101B,
                                      0x101C, 0x2000, 0x2100, 0x2107, 0xF002, 0xF014, 0xF016, 0xF018, 0xFF06};
        const int address = kAddresses[static_cast<std::size_t>(between(0, std::size(kAddresses) - 1))];
        return write_request(station, address,
                             static_cast<int>(between(0, 3) == 0 ? between(0, 3000) : between(0, 1)));
      }
    }
  }

  /// Function 16: distance, speed, times and the trigger of an axis.
  Bytes whole_move(int station) {
    const auto byte = [](std::int64_t n) { return static_cast<std::uint8_t>(n); };
    const std::int64_t first = between(0, 1) == 0 ? 0x1000 : 0x1006;
    const std::int64_t distance = between(-1500, 1500);
    Bytes frame{byte(station), 0x10, byte(first >> 8), byte(first), 0, 6, 12};
    for (const std::int64_t word : {distance, distance >> 16, between(0, 3) == 0 ? 0 : between(1, 400),
                                    between(0, 30), between(0, 30), std::int64_t{1}}) {
      frame.push_back(byte(word >> 8));
      frame.push_back(byte(word));
    }
    return framed(frame);
  }

  std::mt19937_64 random_;
  SimTime time_{0};
};

void apply(World& world, const Event& event) {
  if (event.terminal >= 0) {
    world.set_external_input(event.device, event.terminal, event.on);
  } else {
    world.line(0).line.receive(event.bytes, event.at);
  }
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
