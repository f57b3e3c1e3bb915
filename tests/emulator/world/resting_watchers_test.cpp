// An observer does not force a world to run every tick while nothing happens, and sees the same as if it did.
// Random, seeded; UNDERSTUDY_SEED overrides.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "emulator/device/named_values.h"
#include "emulator/world/trace/trace.h"
#include "tests/emulator/world/random_events.h"
#include "tests/emulator/world/stepping.h"
#include "tests/sanitized.h"

namespace understudy::emulator::world {
namespace resting_watchers_test {

using namespace std::chrono_literals;

/// A trace of the usual values, and of more.
class Traced {
 public:
  Traced(World& world, const std::vector<std::string>& also)
      : trace_(world, trace_signals(world, also),
               csv_format([this](std::string_view line) { text += line; })) {}
  std::string text;

 private:
  Trace trace_;
};

std::string hex(int address) {
  char text[8];
  std::snprintf(text, sizeof text, "0x%04X", static_cast<unsigned>(address));
  return text;
}

/// Each register whose value is more than what was stored; by address.
std::vector<std::string> computed_registers(const World& world) {
  std::vector<std::string> names;
  for (const KnownDevice& device : world.known()) {
    for (const RegisterRow& row : register_rows(*device.model)) {
      if (row.reader == nullptr || row.access == Access::write) continue;
      if (device.firmware < row.since) continue;
      for (int i = 0; i < row.count; ++i)
        names.push_back(device.name + "." + hex(row.address + i * row.stride));
    }
  }
  return names;
}

World slim_world() {
  return World(
      parse_bench(models::all_models(),
                  "understudy: 1\n"
                  "lines: { rs232: { timing: instant, stations: [ { name: robot, model: slim } ] } }\n",
                  "bench.yaml", "."),
      {}, {});
}

void say(World& world, const std::string& line) {
  const std::string sent = line + "\r";
  world.receive(0, std::span(reinterpret_cast<const std::uint8_t*>(sent.data()), sent.size()));
}

TEST(RestingWatchers, SeeTheSameOfTwoSimple2AsByTicks) {
  const std::uint64_t seed = seed_or(63'001);
  std::uint64_t skipped = 0;
  for (std::uint64_t i = 0; i < 2; ++i) {
    World plain = make_world(i % 2 == 0 ? "wire" : "instant");
    World twin = make_world(i % 2 == 0 ? "wire" : "instant");
    std::vector<std::string> also = computed_registers(plain);
    if (is_sanitized()) also.resize(also.size() / 20);  // otherwise minutes
    also.push_back("feeder.requests");
    Traced one(plain, also);
    Traced other(twin, also);
    ASSERT_NO_FATAL_FAILURE(play_both(plain, twin, RandomEvents(seed + i).make(40), by_single_ticks,
                                      "UNDERSTUDY_SEED=" + std::to_string(seed + i), [] {}));
    ASSERT_TRUE(one.text == other.text) << "UNDERSTUDY_SEED=" << seed + i;
    EXPECT_GT(std::count(one.text.begin(), one.text.end(), '\n'), 200);
    skipped += plain.ticks_skipped();
  }
  EXPECT_GT(skipped, 10'000u);
}

/// The encoder's speed is calculated from the time of its last counts, so it is checked in every tick.
TEST(RestingWatchers, SeeAnEncodersSpeedFallToZero) {
  World plain = make_world("instant");
  World twin = make_world("instant");
  const std::vector<std::string> also{"feeder.ENCA_RPM"};
  Traced one(plain, also);
  Traced other(twin, also);
  twin.set_bulk_ticks(false);
  for (World* world : {&plain, &twin}) {
    world->receive(0, write_request(1, 0x1014, 1));
    world->receive(0, write_request(1, 0x1000, 300));
    world->advance_to(1ms);
    world->receive(0, write_request(1, 0x1013, 1));
    world->receive(0, write_request(1, 0x1002, 60));
    world->advance_to(2ms);
    world->receive(0, write_request(1, 0x1005, 1));
  }
  plain.advance_to(20s);
  by_single_ticks(twin, 20s);
  EXPECT_TRUE(one.text == other.text);
}

TEST(RestingWatchers, SeeATimerCountByItsUnit) {
  World plain = make_world("instant");
  World twin = make_world("instant");
  const std::vector<std::string> also{"feeder.Timer1_Value"};
  Traced one(plain, also);
  Traced other(twin, also);
  for (World* world : {&plain, &twin}) {
    world->load_program(0, "Timer_Start 1\nEnd\n");
    world->receive(0, write_request(1, 0x3000, 0));
  }
  plain.advance_to(3s);
  by_single_ticks(twin, 3s);
  EXPECT_TRUE(one.text == other.text);
  EXPECT_GT(std::count(one.text.begin(), one.text.end(), '\n'), 30);
}

TEST(RestingWatchers, SeeAllNamesOfASlimAsByTicks) {
  World plain = slim_world();
  World twin = slim_world();
  std::vector<std::string> also;
  for (const std::string& name : plain.device(0).named_values()->names()) also.push_back("robot." + name);
  Traced one(plain, also);
  Traced other(twin, also);
  twin.set_bulk_ticks(false);
  for (World* world : {&plain, &twin}) {
    say(*world, "TM=77");
    world->advance_to(1500ms);
    say(*world, "VM=600");
    say(*world, "MR 5000");
  }
  plain.advance_to(20'123ms);
  by_single_ticks(twin, 20'123ms);
  EXPECT_TRUE(one.text == other.text);
  EXPECT_GT(plain.ticks_skipped(), 10'000u);
}

TEST(RestingWatchers, OfAnIdleDayCostAFewLooks) {
  struct Count final : TickWatcher {
    void on_tick(Tick) override { ++looks; }
    Tick next_poll(Tick) const override { return kNever; }
    int looks = 0;
  };
  World world = make_world();
  world.advance_to(1s);
  Count count;
  world.add_watcher(count);
  Traced traced(world, {});
  world.advance_to(24h);
  EXPECT_LT(count.looks, 10);
  EXPECT_EQ(world.now(), 24h);
}

TEST(RestingWatchers, OneThatSeesEveryTickMakesAllSeeThem) {
  struct Every final : TickWatcher {
    void on_tick(Tick tick) override { ticks.push_back(tick); }
    std::vector<Tick> ticks;
  };
  World world = make_world();
  Traced traced(world, {});
  Every every;
  world.add_watcher(every);
  world.advance_to(3s);
  ASSERT_EQ(every.ticks.size(), 3000u);
  for (std::size_t i = 0; i < every.ticks.size(); ++i) EXPECT_EQ(every.ticks[i], static_cast<Tick>(i) + 1);
}

/// An action of a watcher is visible to all at the next tick.
TEST(RestingWatchers, SeeWhatOneOfThemDoes) {
  struct Acting final : TickWatcher {
    explicit Acting(World& of) : world(of) {}
    void on_tick(Tick tick) override {
      if (tick == 1000) world.set_external_input(0, 3, 1);
    }
    Tick next_poll(Tick done) const override { return done < 1000 ? 1000 : kNever; }
    World& world;
  };
  std::string texts[2];
  for (const bool in_bulk : {false, true}) {
    World world = make_world();
    world.set_bulk_ticks(in_bulk);
    Acting acting(world);
    world.add_watcher(acting);
    Traced traced(world, {});
    world.advance_to(2s);
    texts[in_bulk ? 1 : 0] = traced.text;
  }
  EXPECT_TRUE(texts[0] == texts[1]);
  EXPECT_NE(texts[0].find("\n1001,"), std::string::npos);
}

}  // namespace resting_watchers_test
}  // namespace understudy::emulator::world
