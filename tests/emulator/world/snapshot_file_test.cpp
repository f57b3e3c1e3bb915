// Which files are accepted as snapshots.
#include "emulator/world/snapshot_file.h"
#include "emulator/models/models.h"

#include <gtest/gtest.h>

#include "tests/emulator/world/two_devices.h"

namespace understudy::emulator::world {
namespace snapshot_file_test {

std::string diagnostic(const std::string& text, std::uint64_t bench = 0) {
  try {
    parse_snapshot(text, bench);
    return "";
  } catch (const SnapshotError& error) {
    return error.what();
  }
}

TEST(SnapshotFile, OfAnotherFormatIsRefused) {
  const std::string another = "understudy: has a different format; expected 1";
  for (const char* const format : {"2", "0", "\"1\"", "1.0", "true", "null", "[1]"}) {
    EXPECT_EQ(diagnostic("{\"understudy\": " + std::string(format) + "}"), another) << format;
  }
  EXPECT_EQ(diagnostic(R"({"understudy": 1})"), "kind: is missing; expected a snapshot");
  EXPECT_EQ(diagnostic("{}"), "understudy: is missing; expected a snapshot");
  EXPECT_EQ(diagnostic("[]"), "understudy: is missing; expected a snapshot");
}

TEST(SnapshotFile, IsOfItsBenchAndAsItWasWritten) {
  const World world(parse_bench(models::all_models(), two_devices("wire", 19200), "two.yaml", "."), {}, {});
  const std::string text = to_text(save(world), 7);
  EXPECT_EQ(diagnostic(text, 7), "");
  EXPECT_EQ(diagnostic(text, 8),
            "bench: is a different bench; expected the one that the snapshot was taken from");
  const auto with = [&](const std::string& what, const std::string& other) {
    std::string changed = text;
    changed.replace(changed.find(what), what.size(), other);
    return diagnostic(changed, 7);
  };
  EXPECT_EQ(with("\"understudy\": 1", "\"understudy\": 2"), "understudy: has a different format; expected 1");
  EXPECT_EQ(with("snapshot", "nv-image"), "kind: is 'nv-image'; expected snapshot");
  EXPECT_EQ(with("\"simulated_time_ns\": 0", "\"simulated_time_ns\": 1"),
            "checksum: does not match the state; expected the file as it was written");
}

}  // namespace snapshot_file_test
}  // namespace understudy::emulator::world
