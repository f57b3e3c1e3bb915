// Triggers alone: which occasions they hit, calculated by hand; and when their conditions are checked.
#include "emulator/world/faults/trigger.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

namespace understudy::emulator::world {
namespace trigger_test {

using namespace std::chrono_literals;

/// The expression "a" is true when the test says so.
struct Told final : ConditionSource {
  bool holds(const std::string&) override {
    ++asked;
    return is_true;
  }
  bool is_true = false;
  int asked = 0;
};

TEST(Draw, IsSplitMix64) {
  // Its author's reference values.
  EXPECT_EQ(draw(1234567, 1), 6457827717110365317u);
  EXPECT_EQ(draw(1234567, 2), 3203168211198807973u);
  EXPECT_EQ(draw(1234567, 3), 9817491932198370423u);
  EXPECT_EQ(draw(0, 1), 0xE220A8397B1DCDAFu);
}

TEST(Trigger, ChanceHitsItsShare) {
  // 10,000 draws: within 4 standard deviations, sqrt(n p (1 - p)).
  struct Case {
    std::int64_t percent;
    int min, max;
  };
  for (const auto& [percent, min, max] : std::vector<Case>{
           {1, 60, 140}, {5, 412, 588}, {50, 4800, 5200}, {99, 9860, 9940}, {100, 10'000, 10'000}}) {
    for (const std::uint64_t stream : {1u, 2u, 99u}) {
      FaultTrigger trigger;
      trigger.chance = percent * kAlways / 100;
      FaultCourse course;
      Told reported;
      for (int i = 0; i < 10'000; ++i) strikes_frame(trigger, course, {}, reported, stream);
      EXPECT_GE(course.hits, min) << percent;
      EXPECT_LE(course.hits, max) << percent;
    }
  }
}

TEST(Trigger, AnAddressIsHitByARangeThatTouchesIt) {
  struct Case {
    int first, last;  // of the trigger
    int from, count;  // of the request
    bool hit;
  };
  for (const auto& c : std::vector<Case>{{5, 5, 5, 1, true},
                                         {5, 5, 4, 1, false},
                                         {5, 5, 4, 2, true},
                                         {5, 5, 6, 9, false},
                                         {5, 7, 7, 3, true},
                                         {5, 7, 8, 3, false},
                                         {5, 7, 0, 5, false},
                                         {5, 7, 0, 6, true},
                                         {5, 7, 6, 1, true},
                                         {0, 0, 0, 0, false},
                                         {0, 9, 3, 0, false},
                                         {0xFFFF, 0xFFFF, 0xFFFF, 1, true}}) {
    FaultTrigger trigger;
    trigger.first_address = c.first;
    trigger.last_address = c.last;
    FaultCourse course;
    Told reported;
    EXPECT_EQ(strikes_frame(trigger, course, {.read = {c.from, c.count}}, reported, 0), c.hit)
        << c.first << ".." << c.last << " and " << c.from << " + " << c.count;
  }
}

TEST(Trigger, AConditionIsAskedOnlyOfFramesThatFit) {
  FaultTrigger trigger;
  trigger.function = 6;
  trigger.when = "a";
  trigger.from = 10ms;
  FaultCourse course;
  Told reported;
  reported.is_true = true;
  EXPECT_FALSE(strikes_frame(trigger, course, {.at = 20ms, .function = 3}, reported, 0));
  EXPECT_FALSE(strikes_frame(trigger, course, {.at = 9ms, .function = 6}, reported, 0));
  EXPECT_EQ(reported.asked, 0);
  EXPECT_TRUE(strikes_frame(trigger, course, {.at = 10ms, .function = 6}, reported, 0));
  EXPECT_EQ(reported.asked, 1);
  EXPECT_EQ(course.seen, 3);
  EXPECT_EQ(course.matched, 1);
}

/// Returns after which ticks, of 1 to 20, it is active, with "a" true as given.
std::vector<Tick> ticks_in_force(const FaultTrigger& trigger, const std::function<bool(Tick)>& is_true,
                                 bool skip, FaultCourse& course) {
  std::vector<Tick> ticks;
  Told reported;
  for (Tick tick = 1; tick <= 20; ++tick) {
    reported.is_true = is_true(tick);
    const bool is_alone = is_of_time_alone(trigger);
    while (next_moment(trigger, course) <= time_of(tick)) {
      strikes_time(trigger, course,
                   next_moment(trigger, course) < SimTime{0} ? SimTime{0} : next_moment(trigger, course),
                   reported, 3);
    }
    if (!is_alone && (!skip || next_poll(trigger, course, tick - 1) == tick)) {
      strikes_time(trigger, course, time_of(tick), reported, 3);
    }
    if (course.in_force) ticks.push_back(tick);
  }
  return ticks;
}

std::vector<Tick> span(Tick first, Tick last) {
  std::vector<Tick> ticks;
  for (Tick tick = first; tick <= last; ++tick) ticks.push_back(tick);
  return ticks;
}

TEST(Trigger, OfTimeAndConditionsIsInForceWhenItSays) {
  struct Case {
    const char* what;
    std::function<void(FaultTrigger&)> set;
    std::function<bool(Tick)> is_true;
    std::vector<Tick> in_force;
    std::int64_t hits;
  };
  const auto never = [](Tick) { return false; };
  const auto from_5_to_8_and_12_to_14 = [](Tick t) { return (t >= 5 && t <= 8) || (t >= 12 && t <= 14); };
  for (const auto& c : std::vector<Case>{
           {"at", [](FaultTrigger& t) { t.at = 7ms; }, never, span(7, 20), 1},
           {"at, between ticks", [](FaultTrigger& t) { t.at = 7100us; }, never, span(8, 20), 1},
           {"at for", [](FaultTrigger& t) { t.at = 7ms, t.lasts = 3ms; }, never, span(7, 9), 1},
           {"at for, within a tick", [](FaultTrigger& t) { t.at = 7100us, t.lasts = 200us; }, never, {}, 1},
           {"from to", [](FaultTrigger& t) { t.from = 3ms, t.to = 6ms; }, never, span(3, 5), 1},
           {"to", [](FaultTrigger& t) { t.to = 4ms; }, never, span(1, 3), 1},
           {"for", [](FaultTrigger& t) { t.lasts = 4ms; }, never, span(1, 3), 1},
           {"when",
            [](FaultTrigger& t) { t.when = "a"; },
            from_5_to_8_and_12_to_14,
            {5, 6, 7, 8, 12, 13, 14},
            2},
           {"when times", [](FaultTrigger& t) { t.when = "a", t.times = 1; }, from_5_to_8_and_12_to_14,
            span(5, 8), 1},
           {"when for, shorter",
            [](FaultTrigger& t) { t.when = "a", t.lasts = 2ms; },
            from_5_to_8_and_12_to_14,
            {5, 6, 12, 13},
            2},
           {"when for, longer",
            [](FaultTrigger& t) { t.when = "a", t.lasts = 5ms; },
            from_5_to_8_and_12_to_14,
            {5, 6, 7, 8, 9, 12, 13, 14, 15, 16},
            2},
           {"when from",
            [](FaultTrigger& t) { t.when = "a", t.from = 7ms; },
            from_5_to_8_and_12_to_14,
            {7, 8, 12, 13, 14},
            2},
           {"when to",
            [](FaultTrigger& t) { t.when = "a", t.to = 13ms; },
            from_5_to_8_and_12_to_14,
            {5, 6, 7, 8, 12},
            2},
           {"when never", [](FaultTrigger& t) { t.when = "a"; }, never, {}, 0},
           {"chance of all", [](FaultTrigger& t) { t.chance = kAlways; }, never, span(1, 20), 20},
           {"chance times", [](FaultTrigger& t) { t.chance = kAlways, t.times = 3; }, never, span(1, 3), 3},
           {"chance for", [](FaultTrigger& t) { t.chance = kAlways, t.times = 2, t.lasts = 3ms; }, never,
            span(1, 6), 2},
       }) {
    FaultTrigger trigger;
    c.set(trigger);
    FaultCourse every_tick;
    FaultCourse skipping;
    EXPECT_EQ(ticks_in_force(trigger, c.is_true, false, every_tick), c.in_force) << c.what;
    EXPECT_EQ(ticks_in_force(trigger, c.is_true, true, skipping), c.in_force) << c.what << ", skipping";
    EXPECT_EQ(every_tick.hits, c.hits) << c.what;
    EXPECT_EQ(every_tick, skipping) << c.what;
  }
}

TEST(Trigger, ThatHasHadItsHitsNeedsNoMoreLooks) {
  FaultTrigger trigger;
  trigger.when = "a";
  trigger.times = 1;
  trigger.lasts = 5ms;
  FaultCourse course;
  Told reported;
  reported.is_true = true;
  EXPECT_EQ(next_poll(trigger, course, 0), 1);
  strikes_time(trigger, course, 1ms, reported, 0);
  strikes_time(trigger, course, 6ms, reported, 0);
  EXPECT_FALSE(course.in_force);
  EXPECT_EQ(next_poll(trigger, course, 6), kNever);
  trigger = {};
  trigger.at = 3ms;
  course = {};
  EXPECT_EQ(next_moment(trigger, course), 3ms);
  strikes_time(trigger, course, 3ms, reported, 0);
  EXPECT_EQ(next_moment(trigger, course), kForever);
}

}  // namespace trigger_test
}  // namespace understudy::emulator::world
