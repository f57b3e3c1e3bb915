// A result is the same after a way through bytes.
#include "emulator/play/results/result_state.h"

#include <gtest/gtest.h>

#include <vector>

namespace understudy::emulator::play {
namespace result_state_test {

ScenarioResult failed_result() {
  ScenarioResult result;
  result.verdict = ScenarioResult::Verdict::failed;
  result.name = "a move (nth=4)";
  result.file = "campaign.yaml";
  result.steps = {
      {.file = "campaign.yaml", .line = 9, .text = "advance 1ms", .begin = SimTime{1}, .end = SimTime{2}},
      {.file = "steps.yaml", .line = 3, .text = "say x", .has_failed = true}};
  result.failure = Failure{.at = SimTime{5},
                           .what = "what",
                           .expected = "expected",
                           .came = "came",
                           .details = {"a", "b"},
                           .led_to = {"event"},
                           .frames = {"frame"},
                           .state = {"state"}};
  result.simulated = SimTime{7};
  result.outcome_hash = 0x1234567890abcdef;
  result.lint_findings = {"finding"};
  result.recording = "a.jsonl";
  result.trace = "a.csv";
  result.capture = "a.pcapng";
  result.which = {.play = "play", .values = {{"nth", "4"}, {"fault", "drop"}}, .is_varied = true};
  result.seed = 8;
  result.branch = "branch";
  result.is_unreadable = true;
  result.rerun = "exec";
  result.like = "like";
  return result;
}

TEST(ResultState, KeepsEveryField) {
  StateWriter writer;
  writer.write(std::vector{failed_result(), ScenarioResult{}});
  const std::vector<std::byte> bytes = writer.take();
  StateReader reader(bytes);
  std::vector<ScenarioResult> read;
  reader.read(read);
  ASSERT_EQ(read.size(), 2U);
  const ScenarioResult& result = read.front();
  const ScenarioResult wanted = failed_result();
  EXPECT_EQ(result.verdict, wanted.verdict);
  EXPECT_EQ(std::tie(result.name, result.file, result.recording, result.trace, result.capture, result.branch,
                     result.rerun, result.like),
            std::tie(wanted.name, wanted.file, wanted.recording, wanted.trace, wanted.capture, wanted.branch,
                     wanted.rerun, wanted.like));
  ASSERT_EQ(result.steps.size(), 2U);
  EXPECT_EQ(result.steps[0].line, 9);
  EXPECT_EQ(result.steps[0].end, SimTime{2});
  EXPECT_TRUE(result.steps[1].has_failed);
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(std::tie(result.failure->at, result.failure->what, result.failure->expected, result.failure->came,
                     result.failure->details, result.failure->frames, result.failure->state,
                     result.failure->led_to),
            std::tie(wanted.failure->at, wanted.failure->what, wanted.failure->expected, wanted.failure->came,
                     wanted.failure->details, wanted.failure->frames, wanted.failure->state,
                     wanted.failure->led_to));
  EXPECT_EQ(std::tie(result.simulated, result.outcome_hash, result.lint_findings, result.seed,
                     result.is_unreadable),
            std::tie(wanted.simulated, wanted.outcome_hash, wanted.lint_findings, wanted.seed,
                     wanted.is_unreadable));
  EXPECT_EQ(std::tie(result.which.play, result.which.values, result.which.is_varied),
            std::tie(wanted.which.play, wanted.which.values, wanted.which.is_varied));
  EXPECT_FALSE(read.back().failure);
}

}  // namespace result_state_test
}  // namespace understudy::emulator::play
