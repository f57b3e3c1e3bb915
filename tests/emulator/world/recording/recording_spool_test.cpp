// A recording that is as large as it may be begins again, and what it was is kept beside it.
#include "emulator/world/recording/recording_spool.h"
#include "emulator/models/models.h"

#include <filesystem>
#include <fstream>

#include "emulator/world/bench/bench_text.h"
#include "emulator/world/recording/replay.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/snapshot_file.h"
#include "tests/emulator/serve/control/daemon_rig.h"
#include "tests/emulator/world/two_devices.h"

namespace understudy::emulator::world {
namespace recording_spool_test {

namespace fs = std::filesystem;

struct SpooledWorld {
  SpooledWorld()
      : bench(parse_bench(models::all_models(), two_devices("instant", 19'200), "two.yaml", ".")),
        world(bench, {}, {}) {}
  RecordingSpool spool(std::size_t cap_bytes) {
    return {world,
            {.version = "1.2.3", .bench = to_text(bench), .options = {}, .seed = 0, .snapshot = {}},
            std::make_unique<GrowingFile>(path, "the recording", logger()),
            cap_bytes,
            logger()};
  }
  std::function<void(const std::string&)> logger() {
    return [this](const std::string& line) { log.push_back(line); };
  }
  /// A request and its reply, so many times.
  void talk(RecordingSpool& recording, int times) {
    for (int i = 0; i < times; ++i) {
      world.receive(0, write_request(1, 0x1002, i % 500 + 1));
      world.advance_to(world.now() + std::chrono::milliseconds(20));
      take_output(world);
      recording.look();
    }
  }
  ReplayResult replayed(const std::string& file, std::uint64_t* end = nullptr) const {
    std::ifstream text(file);
    return replay(models::all_models(), text, file, {}, {},
                  [&](const World& at_end) {
                    if (end != nullptr) *end = hash(at_end);
                  })
        .result;
  }

  serve::TestFolder folder;
  std::string path = folder.path + "/day.jsonl";
  Bench bench;
  World world;
  std::vector<std::string> log;
};

TEST(RecordingSpool, BelowItsCapIsOneFile) {
  SpooledWorld rig;
  {
    RecordingSpool recording = rig.spool(1 << 20);
    rig.talk(recording, 50);
  }
  EXPECT_FALSE(fs::exists(rig.path + ".1"));
  EXPECT_EQ(rig.replayed(rig.path).verdict, ReplayResult::Verdict::same);
}

TEST(RecordingSpool, BeyondItsCapBeginsAgainAndKeepsTheOneBefore) {
  SpooledWorld rig;
  std::uint64_t last = 0;
  {
    // The header of the ones that begin with a snapshot is about 30 kB.
    RecordingSpool recording = rig.spool(100'000);
    rig.talk(recording, 3000);
    last = hash(rig.world);
  }
  EXPECT_EQ(rig.log, std::vector<std::string>{});
  ASSERT_TRUE(fs::exists(rig.path + ".1"));
  // One that ends holds the state that it ends in.
  const std::size_t state = to_text(save(rig.world), kBenchOfRecording).size();
  EXPECT_LT(fs::file_size(rig.path + ".1"), 101'000U + state + state / 10);
  std::uint64_t end = 0;
  const ReplayResult before = rig.replayed(rig.path + ".1");
  EXPECT_EQ(before.verdict, ReplayResult::Verdict::same) << before.difference;
  EXPECT_TRUE(before.has_end);
  const ReplayResult after = rig.replayed(rig.path, &end);
  EXPECT_EQ(after.verdict, ReplayResult::Verdict::same) << after.difference;
  EXPECT_EQ(end, last);
  EXPECT_EQ(after.reached, rig.world.now());
}

TEST(RecordingSpool, ThatCannotBePutAsideEndsWithAWord) {
  SpooledWorld rig;
  RecordingSpool recording = rig.spool(20'000);
  fs::create_directories(rig.path + ".1/in the way");
  rig.talk(recording, 1000);
  ASSERT_EQ(rig.log.size(), 1U);
  EXPECT_NE(rig.log[0].find("the recording ends here: it cannot be put aside as "), std::string::npos);
}

}  // namespace recording_spool_test
}  // namespace understudy::emulator::world
