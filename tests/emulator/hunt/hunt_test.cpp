// A hunt finds what breaks a scenario, and writes the least of it as a scenario.
#include "emulator/hunt/hunt.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/emulator/hunt/hunted.h"

namespace understudy::emulator::hunt {
namespace hunt_test {

const std::string kBounce = R"(hunt:
  may:
    - inject: { stuck: feeder.DIN_10, level: { one_of: [ on, off ] }, for: { between: [ 1ms, 10ms ] } }
      times: 4
      from: the operator presses
      to: the contact rests
    - inject: { slow: feeder, by: { between: [ 1ms, 9ms ] } }
    - advance: { between: [ 1ms, 100ms ] }
)";

TEST(Hunt, ItFindsTheContactThatBounces) {
  const HuntFolder folder(kPresses + kBounce);
  Tally tally;
  const std::vector<Found> found = hunted(folder, {.seed = 1, .jobs = 1, .courses = 300}, &tally);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(tally.courses, 300U);
  EXPECT_GT(tally.failed, 1U);
  EXPECT_NE(found[0].kind.find("scenario.yaml:19: Counter1_Value is #; expected #"), std::string::npos)
      << found[0].kind;
  // A contact that bounces once is enough; slow replies and a late host have nothing to do with it.
  ASSERT_EQ(found[0].shrunk.disturbances.size(), 1U) << found[0].text;
  EXPECT_EQ(found[0].shrunk.disturbances[0].entry, 0U);
  EXPECT_TRUE(found[0].is_minimal);
}

TEST(Hunt, TheWrittenScenarioFailsOnlyWithItsDisturbance) {
  const HuntFolder folder(kPresses + kBounce);
  const std::vector<Found> found = hunted(folder, {.seed = 1, .jobs = 1, .courses = 300});
  ASSERT_EQ(found.size(), 1U);
  std::string text = found[0].text;
  EXPECT_NE(failure_of(folder, text).find("expected 1"), std::string::npos) << text;
  const std::size_t begin = text.find("  - inject:");
  ASSERT_NE(begin, std::string::npos) << text;
  text.erase(begin, text.find('\n', begin) + 1 - begin);
  EXPECT_EQ(failure_of(folder, text), "") << text;
}

TEST(Hunt, FindingsDoNotDependOnTheNumberOfThreads) {
  const HuntFolder folder(kPresses + kBounce);
  for (const std::uint64_t seed : {1, 2}) {
    const auto alone = hunted(folder, {.seed = seed, .jobs = 1, .courses = 600});
    EXPECT_FALSE(alone.empty());
    EXPECT_EQ(alone, hunted(folder, {.seed = seed, .jobs = 3, .courses = 600}));
  }
}

/// Guided shards continue from their own courses, so this holds for those that are drawn alone.
TEST(Hunt, ShardsPlayTheCoursesOfTheWholeHunt) {
  const HuntFolder folder(kPresses + kBounce);
  Tally whole;
  hunted(folder, {.seed = 3, .jobs = 1, .courses = 100, .is_guided = false}, &whole);
  Tally sum;
  for (const std::uint64_t number : {1, 2, 3}) {
    Tally part;
    const play::Shard shard{.number = number, .of = 3};
    hunted(folder, {.seed = 3, .jobs = 1, .courses = 100, .shard = shard, .is_guided = false}, &part);
    sum.courses += part.courses;
    sum.failed += part.failed;
    sum.simulated += part.simulated;
  }
  EXPECT_EQ(sum.courses, whole.courses);
  EXPECT_EQ(sum.failed, whole.failed);
  EXPECT_EQ(sum.simulated, whole.simulated);
}

/// What is easy to find is found as soon as without guidance.
TEST(Hunt, TheFirstCoursesAreDrawnAlone) {
  const HuntFolder folder(kPresses + kBounce);
  for (const std::uint64_t courses : {112, 240}) {
    Tally guided;
    Tally alone;
    hunted(folder, {.seed = 3, .jobs = 1, .courses = courses}, &guided);
    hunted(folder, {.seed = 3, .jobs = 1, .courses = courses, .is_guided = false}, &alone);
    EXPECT_EQ(guided.simulated == alone.simulated, courses == 112) << courses;
    EXPECT_GT(guided.failed, 0U);
  }
}

TEST(Hunt, ConditionsMustHoldInEveryCourse) {
  const HuntFolder folder(kPresses + R"(hunt:
  may: [ { inject: { stuck: feeder.DIN_10, level: on, for: 5ms }, times: 9 } ]
  never: feeder.Counter1_Value == 2
  to: the contact rests
)");
  const auto found = hunted(folder, {.seed = 5, .jobs = 1, .courses = 400});
  std::vector<std::string> kinds;
  for (const Found& one : found) {
    if (one.kind.find("never 'feeder.Counter1_Value == #'") == std::string::npos) continue;
    kinds.push_back(one.kind);
    EXPECT_NE(one.text.find("  - never: feeder.Counter1_Value == 2  # this is what must hold\n"),
              std::string::npos)
        << one.text;
    EXPECT_NE(failure_of(folder, one.text).find("never 'feeder.Counter1_Value == 2'"), std::string::npos);
  }
  EXPECT_EQ(kinds.size(), 1U);
}

TEST(Hunt, NothingIsFoundWhereTheProgramWaits) {
  std::string debounced = kPresses + kBounce;
  debounced.insert(debounced.find("                Wait_IO DIN_10 OFF"), "                Delay_mSec 50\n");
  const HuntFolder folder(debounced);
  for (const Found& one : hunted(folder, {.seed = 1, .jobs = 1, .courses = 300})) ADD_FAILURE() << one.text;
}

TEST(Hunt, AScenarioThatFailsByItselfIsFoundAtOnce) {
  std::string wrong = kPresses + kBounce;
  wrong.replace(wrong.find("Counter1_Value: 1"), 17, "Counter1_Value: 7");
  const HuntFolder folder(wrong);
  Tally tally;
  const auto found = hunted(folder, {.seed = 1, .jobs = 2, .courses = 300}, &tally);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(tally.courses, 1U);
  EXPECT_TRUE(found[0].shrunk.disturbances.empty());
  EXPECT_NE(found[0].text.find("# It fails without any disturbance.\n"), std::string::npos) << found[0].text;
}

TEST(Hunt, StepsOfMayThatFailAreNotFindings) {
  const HuntFolder folder(kPresses +
                          "hunt: { may: [ write: { feeder.Aaxis_SVON: 1 }, inject: { drop: feeder } ] }\n");
  Tally tally;
  const auto found = hunted(folder, {.seed = 1, .jobs = 1, .courses = 200}, &tally);
  EXPECT_GT(tally.cut_short, 0U);
  for (const Found& one : found) EXPECT_EQ(one.kind.find("Aaxis_SVON"), std::string::npos) << one.kind;
}

TEST(Hunt, CasesAreDrawnToo) {
  std::string varied = kPresses + kBounce;
  varied.insert(varied.find("steps:"), "vary: { held: { from: 40ms, to: 90ms, step: 10ms } }\n");
  varied.replace(varied.find("130ms"), 5, "${held}");
  const HuntFolder folder(varied);
  const auto found = hunted(folder, {.seed = 1, .jobs = 2, .courses = 300});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].text.find("# The case is (held="), std::string::npos) << found[0].text;
  EXPECT_NE(failure_of(folder, found[0].text), "") << found[0].text;
}

TEST(Hunt, TheOptionOfAChoiceIsInTheFinding) {
  std::string chosen = kPresses + kBounce;
  chosen.insert(chosen.find("steps:"), "choice: { exceptions: [ no_answer ] }\n");
  const HuntFolder folder(chosen);
  const auto found = hunted(folder, {.seed = 1, .jobs = 1, .courses = 300});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].text.find("\nchoice: { exceptions: [ no_answer ] }\n"), std::string::npos)
      << found[0].text;
  EXPECT_NE(failure_of(folder, found[0].text), "") << found[0].text;
}

TEST(Hunt, PathsAreWrittenForTheFolderOfTheFinding) {
  std::string text = kPresses + kBounce;
  text.replace(text.find("{ lines:"), text.find("} }\n") + 3 - text.find("{ lines:"), "benches/b.yaml");
  const std::size_t program = text.find("      feeder: |\n");
  text.replace(program, text.find("  - write:") - program, "      feeder: count.lst\n");
  const HuntFolder folder(text);
  folder.write("benches/b.yaml",
               "understudy: 1\nlines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } }\n");
  folder.write("count.lst", "again: Wait_IO DIN_10 ON\nCounter_Increase 1\nWait_IO DIN_10 OFF\nJump again\n");
  const auto found = hunted(folder, {.seed = 1, .jobs = 1, .courses = 300});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].text.find("bench: ../benches/b.yaml\n"), std::string::npos) << found[0].text;
  EXPECT_NE(found[0].text.find("feeder: ../count.lst"), std::string::npos) << found[0].text;
  EXPECT_NE(failure_of(folder, found[0].text), "") << found[0].text;
}

}  // namespace hunt_test
}  // namespace understudy::emulator::hunt
