// Courses that reached something new are kept, and later ones go on from them.
#include "emulator/hunt/corpus.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "base/state/state_bytes.h"
#include "emulator/hunt/course_state.h"
#include "tests/emulator/hunt/hunted.h"

namespace understudy::emulator::hunt {
namespace corpus_test {

using When = play::Disturbance::When;

Course sample() {
  return {.case_number = 7,
          .disturbances = {
              {.entry = 1, .step = 2, .when = When::at, .moment = 123'000'000, .values = {0, 41}},
              {.entry = 0, .step = 3, .when = When::here, .moment = 0, .values = {}},
              {.entry = 4, .step = 0, .when = When::nth, .moment = 3, .values = {9}},
          }};
}

TEST(Corpus, ACourseIsReadAsItWasWritten) {
  const auto line = parse_corpus_line(json_text(sample()));
  ASSERT_TRUE(line && line->course);
  EXPECT_EQ(*line->course, sample());
  const auto next = parse_corpus_line(json_text(5, 4096));
  ASSERT_TRUE(next && !next->course);
  EXPECT_EQ(next->seed, 5U);
  EXPECT_EQ(next->next, 4096U);
}

TEST(Corpus, OtherLinesAreRefused) {
  const std::string good = json_text(sample());
  for (std::size_t length = 0; length < good.size(); ++length)
    EXPECT_FALSE(parse_corpus_line(good.substr(0, length))) << length;
  for (
      const char* const line :
      {"[]", "7", "{}", R"({"case": -1, "disturbances": []})", R"({"case": 1, "disturbances": {}})",
       R"({"case": 1, "disturbances": [ 3 ]})", R"({"next": 1})",
       R"({"next": 1, "seed": 18446744073709551615})",
       R"({"case": 0, "disturbances": [{"entry": 0, "step": 0, "when": "soon", "moment": 0, "values": []}]})",
       R"({"case": 0, "disturbances": [{"entry": 0, "step": 0, "when": "at", "moment": 0, "values": [1.5]}]})"}) {
    EXPECT_FALSE(parse_corpus_line(line)) << line;
  }
}

TEST(Corpus, OnlyNewThingsMakeASeed) {
  Corpus corpus;
  Reached reached;
  reached.when = {{4 | 2, SimTime(10)}, {8 | 3, SimTime(20)}};
  EXPECT_TRUE(corpus.add(sample(), reached));
  EXPECT_FALSE(corpus.add(Course{}, reached));
  EXPECT_TRUE(corpus.seeds().empty());
  corpus.renew();
  ASSERT_EQ(corpus.seeds().size(), 1U);
  EXPECT_EQ(corpus.seeds()[0].course, sample());
  EXPECT_EQ(corpus.seeds()[0].moments, (std::vector<SimTime>{SimTime(10), SimTime(20)}));
  EXPECT_EQ(corpus.counts(), (Counts{0, 0, 1, 1}));
  reached.when.emplace(12, SimTime(30));
  EXPECT_TRUE(corpus.add(Course{}, reached));
  EXPECT_EQ(corpus.counts(), (Counts{1, 0, 1, 1}));
}

TEST(Corpus, WhatFewCoursesReachIsDrawnMoreOften) {
  Corpus corpus;
  Course rare;
  rare.case_number = 1;
  Reached common;
  common.when = {{4 | 2, SimTime(10)}};
  for (int i = 0; i < 100; ++i) corpus.add(Course{}, common);
  Reached other;
  other.when = {{8 | 2, SimTime(10)}};
  corpus.add(rare, other);
  corpus.renew();
  ASSERT_EQ(corpus.seeds().size(), 2U);
  int drawn = 0;
  for (std::uint64_t number = 0; number < 1000; ++number) {
    Dice dice(1, number);
    if (corpus.seeds()[corpus.draw_seed(dice)].course == rare) ++drawn;
  }
  EXPECT_GT(drawn, 950);  // 100 to 1
  EXPECT_LT(drawn, 1000);
}

TEST(Corpus, ACourseGoesToAnotherProcessUnchanged) {
  Course course = sample();
  course.left_out = {2, 5};
  course.end = 9;
  StateWriter writer;
  writer.write(course);
  Course read;
  const std::vector<std::byte> bytes = writer.take();
  StateReader(bytes).read(read);
  EXPECT_EQ(read, course);
}

/// A machine that stops only after three presses, each within 20 ms after the one before.
const std::string kLock = R"(understudy: 1
name: a lock
bench: { lines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } } }
steps:
  - program:
      feeder: |
        again:  Wait_IO DIN_10 ON
                Wait_IO DIN_9 ON
                Wait_IO DIN_8 ON
                Counter_Increase 1
                Jump again
  - write: { PROG_MAIN_RunTime_START: 0 }
  - advance: 300ms
  - assert: feeder.Counter1_Value == 0
hunt:
  may:
    - inject: { stuck: feeder.DIN_10, level: on, for: 4ms }
    - inject: { stuck: feeder.DIN_9, level: on, for: 4ms }
    - inject: { stuck: feeder.DIN_8, level: on, for: 4ms }
    - inject: { stuck: feeder.DIN_7, level: on, for: { between: [ 1ms, 90ms ] } }
      times: 9
)";

TEST(Hunt, GuidedItGoesOnFromWhatIsNew) {
  const HuntFolder folder(kLock);
  Tally tally;
  const auto found = hunted(folder, {.seed = 1, .jobs = 2, .courses = 3000}, &tally);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].shrunk.disturbances.size(), 3U);
  EXPECT_TRUE(found[0].is_minimal);
  for (const std::size_t count : tally.reached) EXPECT_GT(count, 0U);
}

TEST(Course, WhatIsDrawnAndChangedStaysPossible) {
  const std::string text = kPresses + R"(hunt:
  may:
    - inject: { stuck: feeder.DIN_10, level: { one_of: [ on, off ] }, for: { between: [ 1ms, 10ms ] } }
      times: 4
      within: 8ms
      from: the operator presses
      to: the contact rests
    - inject: { stuck: feeder.DIN_9, level: on }
      to: the operator presses
    - inject: { drop: feeder, of: { one_of: [ reply, request, both ] } }
    - advance: { between: [ 1ms, 100ms ] }
      from: the contact rests
)";
  auto scenario = std::make_shared<const play::Scenario>(
      play::parse_scenarios(models::all_models(), text, "scenario.yaml").at(0));
  CoursePlayer course_player(scenario, models::all_models(), {});
  const std::vector<SimTime> moments{SimTime(21'000'000), SimTime(170'000'000), SimTime(4'000'000'000)};
  const Ground ground{
      .plan = course_player.plan(), .undisturbed = course_player.undisturbed(), .moments = moments};
  for (std::uint64_t number = 0; number < 200; ++number) {
    Dice dice(1, number);
    auto course = draw_disturbances(ground, dice);
    const auto others = draw_disturbances(ground, dice);
    for (int changes = 0; changes < 20; ++changes) {
      for (const play::Disturbance& one : course) ASSERT_TRUE(is_possible(one, ground)) << number;
      course = changed(course, others, ground, dice);
    }
  }
}

/// The number is that of these draws with any compiler. A change of how courses are drawn changes it.
TEST(Course, WhatIsDrawnDoesNotDependOnTheCompiler) {
  auto scenario = std::make_shared<const play::Scenario>(
      play::parse_scenarios(models::all_models(), kLock, "scenario.yaml").at(0));
  CoursePlayer course_player(scenario, models::all_models(), {});
  const std::vector<SimTime> moments{SimTime(21'000'000), SimTime(170'000'000)};
  const Ground ground{
      .plan = course_player.plan(), .undisturbed = course_player.undisturbed(), .moments = moments};
  StateWriter writer;
  for (std::uint64_t number = 0; number < 100; ++number) {
    Dice dice(1, number);
    Course course{.disturbances = draw_disturbances(ground, dice)};
    for (int changes = 0; changes < 10; ++changes) {
      course.disturbances = changed(course.disturbances, {}, ground, dice);
      writer.write(course);
    }
  }
  EXPECT_EQ(hash_of(writer.take()), 6294058663435740651U);
}

TEST(Hunt, ItGoesOnWithACorpus) {
  const HuntFolder folder(kLock);
  play::CaseList cases(models::all_models(), {});
  cases.add(folder / "scenario.yaml", [](const play::Scenario&) {});
  Hunt first(cases, models::all_models(), {.seed = 9, .courses = 512});
  first.run([](const Finding&) {});
  EXPECT_EQ(first.next_course(), 512U);
  std::vector<Course> courses;
  for (const Seed& seed : first.corpus().seeds()) courses.push_back(seed.course);
  // Courses of another plan are left out.
  courses.push_back({.case_number = 3});
  courses.push_back({.disturbances = {{.entry = 99, .values = {}}}});
  courses.push_back({.disturbances = {{.entry = 3, .when = When::at, .values = {1000}}}});
  Hunt next(cases, models::all_models(), {.seed = 9, .courses = 0, .first = 512, .corpus = courses});
  next.run([](const Finding&) {});
  EXPECT_EQ(next.corpus().counts(), first.corpus().counts());
  EXPECT_EQ(next.next_course(), 512U);
}

}  // namespace corpus_test
}  // namespace understudy::emulator::hunt
