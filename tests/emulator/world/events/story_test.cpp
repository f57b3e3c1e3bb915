// The story of a failure: which events led there, and in which words.
#include "emulator/world/events/story.h"

#include <gtest/gtest.h>

#include "tests/emulator/world/two_devices.h"

namespace understudy::emulator::world {
namespace story_test {

Event write(SimTime time, const std::string& device, const std::string& name, const std::string& value) {
  return {.time = time,
          .what = "write",
          .by = "host",
          .device = device,
          .name = device + "." + name,
          .value = value};
}

std::vector<std::string> texts_of(const Story& story) {
  std::vector<std::string> texts;
  for (const Story::Moment& moment : story.moments) texts.push_back(moment.text);
  return texts;
}

TEST(Story, ReportsTheEventsThatTouchItsNames) {
  using namespace std::chrono_literals;
  const World world = make_world();
  const std::deque<Event> events = {
      write(1ms, "feeder", "Aaxis_Pulse", "32000"),
      write(1ms, "feeder", "Aaxis_Speed", "200"),
      write(2ms, "turner", "Aaxis_Speed", "9"),
      {.time = 3ms, .what = "inject", .by = "control", .device = "feeder", .text = "lost_steps feeder.A"},
      {.time = 4ms, .what = "exception", .by = "host", .line = "rs485", .text = "read feeder.Nothing: 2"},
      write(5s, "feeder", "Aaxis_Speed", "1")};
  const RecordedFailure failure{.what = "feeder.A.lost is 5; expected 0 at feeder.nonsense",
                                .at = 4s,
                                .scenario = "a move",
                                .place = "fail.yaml:8",
                                .step = "assert feeder.A.lost == 0."};
  const Story story = story_of(world, failure, events);
  EXPECT_EQ(story.at, 4s);
  EXPECT_EQ(story.sentence,
            "failed at 4s: feeder.A.lost is 5; expected 0 at feeder.nonsense (fail.yaml:8: assert "
            "feeder.A.lost == 0.)");
  EXPECT_EQ(story.names, std::vector<std::string>{"feeder.A.lost"});
  EXPECT_EQ(texts_of(story), (std::vector<std::string>{
                                 "host writes feeder.Aaxis_Pulse = 32000, feeder.Aaxis_Speed = 200",
                                 "scenario injects lost_steps feeder.A", "rs485: read feeder.Nothing: 2"}));
  EXPECT_EQ(moment_lines(story).front(),
            "1ms  host writes feeder.Aaxis_Pulse = 32000, feeder.Aaxis_Speed = 200");
}

/// Hundreds of later writes to the same device push out none that touches the names.
TEST(Story, KeepsWhatTouchesItsNames) {
  using namespace std::chrono_literals;
  const World world = make_world();
  std::deque<Event> events = {write(1ms, "feeder", "Aaxis_Pulse", "7")};
  for (int i = 2; i < 500; ++i) events.push_back(write(i * 1ms, "feeder", "Aaxis_Speed", std::to_string(i)));
  const Story story = story_of(
      world, {.what = "feeder.Aaxis_Pulse is 7", .at = 1s, .scenario = {}, .place = {}, .step = {}}, events);
  EXPECT_EQ(story.sentence, "failed at 1s: feeder.Aaxis_Pulse is 7");
  ASSERT_GT(story.moments.size(), 10U);
  EXPECT_LT(story.moments.size(), 40U);
  EXPECT_EQ(story.moments.front().text, "host writes feeder.Aaxis_Pulse = 7");
  EXPECT_EQ(story.moments.back().text, "host writes feeder.Aaxis_Speed = 499");
}

}  // namespace story_test
}  // namespace understudy::emulator::world
