// A play is recorded completely, also if it goes back to an earlier state.
#include "emulator/play/performing/performance_recorder.h"
#include "emulator/models/models.h"

#include <filesystem>
#include <fstream>

#include "emulator/world/bench/bench_text.h"
#include "emulator/world/recording/replay.h"
#include "tests/emulator/play/performing/played.h"
#include "tests/emulator/play/performing/scenario_folder.h"

namespace understudy::emulator::play {
namespace performance_recorder_test {

/// The results of a scenario and its branches, each with a recording.
std::vector<ScenarioResult> recorded(const Scenario& scenario, const ScenarioFolder& folder) {
  RunOptions options;
  int count = 0;
  options.observers.push_back([&](world::World& world) {
    world::RecordingHeader header{.version = "1.2.3",
                                  .bench = world::to_text(scenario.bench),
                                  .options = {.strict_framing = true},
                                  .seed = scenario.bench.seed,
                                  .snapshot = {}};
    return std::make_unique<PerformanceRecorder>(world, std::move(header),
                                                 folder.path(std::to_string(count++) + ".jsonl"));
  });
  return run_scenario(scenario, options);
}

struct Again {
  world::ReplayResult result;
  world::RecordingHeader header;
  std::int64_t pulses = 0;  // of the first axis, at the end
};

Again again(const ScenarioResult& result) {
  std::ifstream file(result.recording);
  Again again;
  const auto look = [&](world::World& world) { again.pulses = world.sent_pulses(0, 0); };
  const world::Replayed replayed = world::replay(models::all_models(), file, result.recording, {}, {}, look);
  again.result = replayed.result;
  again.header = replayed.header;
  EXPECT_EQ(again.result.verdict, world::ReplayResult::Verdict::same) << again.result.difference;
  EXPECT_TRUE(again.result.has_end);
  return again;
}

TEST(PerformanceRecorder, ARecordingLeadsToTheSameEnd) {
  const ScenarioFolder folder;
  const Scenario scenario = scenario_of(kServoOn + kExampleMove +
                                        "  - advance: 500ms\n"
                                        "  - input: { feeder.DIN_10: on }\n"
                                        "  - inject: { drop: feeder, nth: 2 }\n"
                                        "  - send: { bytes: 01 03 00 01 00 01 +crc, within: 20ms }\n"
                                        "  - send: { bytes: 01 03 00 01 00 01 +crc, within: 20ms }\n"
                                        "  - wait: { until: feeder.STATUS.4 == 0, within: 4s }\n"
                                        "  - expect: { feeder.Cord_A: 31999 }\n");
  const ScenarioResult result = recorded(scenario, folder).front();
  EXPECT_EQ(result.verdict, ScenarioResult::Verdict::failed);
  const Again replayed = again(result);
  EXPECT_EQ(replayed.result.reached, result.failure->at);
  EXPECT_EQ(replayed.pulses, 32000);
  // The bytes sent: two completed writes (8 bytes each), one read of one word (7) of two, and one of two
  // words (9).
  EXPECT_EQ(replayed.result.bytes_sent, 8U + 8U + 7U + 9U);
  EXPECT_EQ(replayed.header.snapshot, "");
}

TEST(PerformanceRecorder, ABranchBeginsWithTheStateAtItsFork) {
  const ScenarioFolder folder;
  const auto results =
      recorded(scenario_of(kServoOn + kExampleMove +
                           "  - advance: 500ms\n"
                           "  - fork:\n"
                           "      on: [ wait: { until: feeder.STATUS.4 == 0, within: 4s } ]\n"
                           "      stopped: [ write: { feeder.Aaxis_STOP: 1 }, advance: 1s ]\n"),
               folder);
  ASSERT_EQ(results.size(), 3U);
  EXPECT_LT(again(results[0]).pulses, 6000);  // about 529 ms of the move
  const Again on = again(results[1]);
  EXPECT_NE(on.header.snapshot, "");
  EXPECT_EQ(on.pulses, 32000);
  EXPECT_EQ(on.result.bytes_sent, 0U);
  const Again stopped = again(results[2]);
  EXPECT_LT(stopped.pulses, 6000);
  EXPECT_EQ(stopped.result.bytes_sent, 8U);
}

TEST(PerformanceRecorder, RestartsWhereAStateIsRestored) {
  const ScenarioFolder folder;
  const ScenarioResult result = recorded(scenario_of(kServoOn + "  - snapshot: still\n" + kExampleMove +
                                                     "  - advance: 1s\n"
                                                     "  - restore: still\n"
                                                     "  - assert: feeder.A.pulses == 0\n"
                                                     "  - write: { feeder.Aaxis_Speed: 7 }\n"),
                                         folder)
                                    .front();
  EXPECT_EQ(why(result), "");
  const Again replayed = again(result);
  EXPECT_NE(replayed.header.snapshot, "");
  EXPECT_EQ(replayed.pulses, 0);
  EXPECT_EQ(replayed.result.bytes_sent, 8U);  // only of the last write
}

}  // namespace performance_recorder_test
}  // namespace understudy::emulator::play
