// A recording that reaches its size limit starts again, and its earlier part is kept in another file.
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
            std::make_unique<GrowingFile>(path, ContentKind::recording, logger()),
            cap_bytes,
            logger()};
  }
  std::function<void(const std::string&)> logger() {
    return [this](const std::string& line) { log.push_back(line); };
  }
  /// A request and its reply, this many times.
  void talk(RecordingSpool& recording, int times) {
    for (int i = 0; i < times; ++i) {
      world.receive(0, write_request(1, 0x1002, i % 500 + 1));
      world.advance_to(world.now() + std::chrono::milliseconds(20));
      take_output(world);
      recording.poll();
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
  // A recording that ends contains its final state.
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
  EXPECT_NE(rig.log[0].find("the recording ends here: it cannot be renamed to "), std::string::npos);
}

TEST(RecordingSpool, ReplacesNoOlderPartThatIsNoRecording) {
  struct Case {
    const char* name;
    std::function<void(const std::string& older)> put;
    const char* why;  // why it is kept
  };
  const auto text = [](const std::string& path, const std::string& words) { std::ofstream(path) << words; };
  const std::vector<Case> cases = {
      {"nothing", [](const std::string&) {}, ""},
      {"an empty file", [&](const std::string& path) { text(path, ""); }, ""},
      {"a recording", [&](const std::string& path) { text(path, R"({"understudy":1,"kind":"recording"})"); },
       ""},
      {"a text", [&](const std::string& path) { text(path, "precious"); },
       "it is not a recording; expected one to replace, or a free path"},
      {"results", [&](const std::string& path) { text(path, R"({"file":"a.yaml"})"); },
       "it is a results file; expected a recording to replace, or a free path"},
      {"a link to a recording",
       [&](const std::string& path) {
         text(path + "-else", R"({"understudy":1,"kind":"recording"})");
         fs::create_symlink(path + "-else", path);
       },
       "it is a link; expected a recording to replace, or a free path"},
      {"a folder", [](const std::string& path) { fs::create_directory(path); },
       "it is a directory; expected a recording to replace, or a free path"},
  };
  for (const Case& c : cases) {
    SpooledWorld rig;
    const std::string older = rig.path + ".1";
    c.put(older);
    EXPECT_EQ(why_no_older_part(older), c.why) << c.name;
    const auto kind_before = fs::symlink_status(older).type();
    {
      RecordingSpool recording = rig.spool(50'000);
      rig.talk(recording, 500);
    }
    const bool is_kept = *c.why != '\0';
    EXPECT_EQ(rig.log.size(), is_kept ? 1U : 0U) << c.name;
    if (is_kept) {
      EXPECT_EQ(fs::symlink_status(older).type(), kind_before) << c.name;
      EXPECT_NE(rig.log.at(0).find(older + ": " + c.why), std::string::npos) << rig.log.at(0);
    } else {
      EXPECT_EQ(rig.replayed(older).verdict, ReplayResult::Verdict::same) << c.name;
    }
  }
}

TEST(RecordingSpool, BeginsAgainWithTheSameMode) {
  SpooledWorld rig;
  { const std::ofstream made(rig.path); }
  fs::permissions(rig.path, fs::perms(0600));
  {
    RecordingSpool recording = rig.spool(50'000);
    rig.talk(recording, 500);
  }
  EXPECT_EQ(fs::status(rig.path).permissions(), fs::perms(0600));
  EXPECT_EQ(fs::status(rig.path + ".1").permissions(), fs::perms(0600));
}

}  // namespace recording_spool_test
}  // namespace understudy::emulator::world
