// Failures by kind: the step and the words, ignoring numbers.
#include "emulator/play/results/failure_kinds.h"

#include <gtest/gtest.h>

namespace understudy::emulator::play {
namespace failure_kinds_test {

ScenarioResult failed(const std::string& what, int line = 7, const std::string& name = "a case") {
  ScenarioResult result{.verdict = ScenarioResult::Verdict::failed, .name = name, .file = "s.yaml"};
  result.steps = {{"s.yaml", 3, "advance 1s"}, {"steps.yaml", line, "expect"}};
  result.failure = Failure{.what = what};
  return result;
}

TEST(FailureKind, IsTheStepAndTheWordsWithoutNumbers) {
  struct Row {
    const char* what;
    const char* kind;
  };
  for (const Row& row :
       std::vector<Row>{{"feeder.Cord_A is 31999; expected 32000", "feeder.Cord_A is #; expected #"},
                        {"feeder.Cord_A is -1; expected 32000 +- 2", "feeder.Cord_A is #; expected # +- #"},
                        {"feeder.STATUS.4 is 1; expected 0", "feeder.STATUS.4 is #; expected #"},
                        {"it took 3.0500s; expected 3050ms +- 2ms", "it took #; expected # +- #"},
                        {"MAIN_LINE2_CMD is 0x10", "MAIN_LINE2_CMD is #"},
                        {"'feeder.A.pulses == 3200' does not hold", "'feeder.A.pulses == #' does not hold"},
                        {"the reply was 01 03 02 C0 01", "the reply was #"},
                        {"the reply was C0 FF", "the reply was #"},
                        {"it was 5 13; expected 10 20", "it was #; expected #"},
                        {"an unexpected reply: F7; expected one", "an unexpected reply: #; expected one"},
                        {"D0 is 5; expected A1", "D0 is #; expected #"},
                        {"FF AB.C0 is 1", "FF AB.C0 is #"},
                        {"mill.D800 is 7", "mill.D800 is #"},
                        {"D800 is 7", "D800 is #"},
                        {"corrupt_reply feeder bytes=FF00 was", "corrupt_reply feeder bytes=# was"},
                        {"the state is a1f3c29bdeadbeef", "the state is #"},
                        {"the facade is added", "the facade is added"},
                        {"it said 'OK\\x0d'", "it said 'OK#'"},
                        {"nothing came within 500ms.", "nothing came within #."},
                        {"", ""}}) {
    EXPECT_EQ(kind_of_failure(failed(row.what)), "steps.yaml:7: " + std::string(row.kind));
  }
  EXPECT_EQ(kind_of_failure(ScenarioResult{}), "");
  ScenarioResult unreadable = failed("s.yaml:3:5: vary.a: 17 is too much");
  unreadable.is_unreadable = true;
  EXPECT_EQ(kind_of_failure(unreadable), "s.yaml: s.yaml:#:#: vary.a: # is too much");
}

TEST(FailureKinds, CountAndKnowTheirFirst) {
  FailureKinds kinds;
  EXPECT_EQ(kinds.add(failed("x is 1", 7, "first"))->count, 1U);
  EXPECT_EQ(kinds.add(failed("x is 2", 7, "second"))->first, "first");
  EXPECT_EQ(kinds.add(failed("x is 2", 8, "third"))->count, 1U) << "another step";
  EXPECT_EQ(kinds.add(failed("y is 2", 7, "fourth"))->count, 1U) << "a different text";
  ScenarioResult varied = failed("x is 3");
  varied.which.is_varied = true;
  EXPECT_EQ(kinds.add(varied)->count, 3U);
  ASSERT_EQ(kinds.all().size(), 3U);
  EXPECT_EQ(kinds.all()[0].varied, 1U);
  EXPECT_EQ(kinds.all()[1].first, "third");
}

TEST(FailureKinds, AreNeverMoreThanSomeNumber) {
  FailureKinds kinds;
  for (int i = 0; i < static_cast<int>(FailureKinds::kMax); ++i)
    EXPECT_NE(kinds.add(failed("x", i)), nullptr);
  EXPECT_EQ(kinds.add(failed("y")), nullptr);
  EXPECT_EQ(kinds.add(failed("y")), nullptr);
  EXPECT_EQ(kinds.add(failed("x", 5))->count, 2U);
  EXPECT_EQ(kinds.others(), 2U);
  EXPECT_EQ(kinds.all().size(), FailureKinds::kMax);
}

}  // namespace failure_kinds_test
}  // namespace understudy::emulator::play
