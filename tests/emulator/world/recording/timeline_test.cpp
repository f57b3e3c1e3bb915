// Any moment of a recording equals a replay up to it, in whatever order moments are visited.
#include "emulator/world/recording/timeline.h"

#include <gtest/gtest.h>

#include <chrono>
#include <sstream>

#include "emulator/models/models.h"
#include "emulator/world/recording/replay.h"
#include "tests/emulator/world/recording/busy_world.h"

namespace understudy::emulator::world {
namespace timeline_test {

struct Noted final : ReplayWatcher {
  explicit Noted(std::vector<RecordedEvent>& all) : events(all) {}
  void happened(const RecordedEvent& event, std::size_t) override {
    if (event.what != RecordedEvent::What::end) events.push_back(event);
  }
  std::vector<RecordedEvent>& events;
};

std::vector<std::uint64_t> states_of(const World& world) {
  std::vector<std::uint64_t> states;
  for (std::size_t i = 0; i < world.device_count(); ++i) {
    states.push_back(world.device(i).state_hash());
    for (std::size_t a = 0; a < world.device(i).model().axes.size(); ++a) {
      states.push_back(static_cast<std::uint64_t>(world.plant(i, static_cast<int>(a)).position_pulses()));
    }
  }
  return states;
}

TEST(Timeline, ComesToWhatAReplayComesTo) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    BusyWorld busy(seed);
    busy.play(300);
    const std::string text = busy.finish();
    std::vector<RecordedEvent> events;
    std::optional<WorldState> begin;
    std::istringstream file(text);
    const Replayed replayed = replay(models::all_models(), file, "a", {}, [&](World& world) {
      begin = save(world);
      return std::make_unique<Noted>(events);
    });
    World world(replayed.bench, replayed.header.options, {});
    int keyframes = 0;
    Timeline timeline(world, *begin, events, replayed.result.reached, [&] { ++keyframes; });
    EXPECT_EQ(states_of(world), states_of(busy.world()));
    EXPECT_EQ(timeline.end(), replayed.result.reached);
    EXPECT_EQ(keyframes, static_cast<int>(timeline.keyframes()));
    const auto set_state = [&](const WorldState& state, std::size_t) { restore(world, state); };
    for (std::int64_t i = 1; i <= 12; ++i) {
      const auto mixed = i * 7 % 13;
      // Also at exactly the time of an event.
      const SimTime time = i % 2 == 0 ? SimTime{timeline.end().count() * mixed / 13}
                                      : events[events.size() * static_cast<std::size_t>(mixed) / 13].at;
      std::istringstream again(text);
      std::vector<std::uint64_t> expected;
      replay(models::all_models(), again, "a", time, {}, [&](World& there) { expected = states_of(there); });
      timeline.go_to(time, set_state);
      EXPECT_EQ(world.now(), time);
      EXPECT_EQ(states_of(world), expected) << format_duration(time);
    }
    timeline.go_to(SimTime{-1}, set_state);
    EXPECT_EQ(world.now(), timeline.begin());
    timeline.go_to(kHorizon, set_state);
    EXPECT_EQ(world.now(), timeline.end());
  }
}

/// Events before the moment are visible as well, by one more keyframe, if it is not too far away.
TEST(Timeline, BeginsAtTheKeyframeBeforeTheLast) {
  using namespace std::chrono_literals;
  const struct {
    SimTime length;
    SimTime time;
    SimTime from;
  } cases[] = {{5s, 4500ms, 3s}, {5s, 4s, 3s},    {5s, 3999ms, 2s},   {5s, 1500ms, 0s}, {2000s, 4s, 2s},
               {5s, 1s, 0s},     {5s, 900ms, 0s}, {3000s, 10s, 9s},   {3000s, 9s, 9s},  {3000s, 8s, 6s},
               {2000s, 5s, 4s},  {1000s, 7s, 6s}, {1000s, 7500ms, 6s}};
  for (const auto& [length, time, from] : cases) {
    World world = make_world();
    Timeline timeline(world, save(world), {}, length, [] {});
    timeline.go_to(time, [&](const WorldState& state, std::size_t) {
      restore(world, state);
      EXPECT_EQ(world.now(), from) << format_duration(length) << ", " << format_duration(time);
    });
    EXPECT_EQ(world.now(), time);
  }
}

}  // namespace timeline_test
}  // namespace understudy::emulator::world
