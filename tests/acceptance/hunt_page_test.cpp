// The commands of docs/hunt.md work as printed, and `hunt` as its flags say.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/acceptance/page_blocks.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace hunt_page_test {

namespace fs = std::filesystem;

class HuntPage : public testing::Test {
 protected:
  HuntPage() {
    const auto files = page_blocks("hunt.md", "yaml");
    EXPECT_EQ(files.size(), 2U);  // python/tests/test_hunt.py has the one with a host
    folder_.write("press.yaml", files.at(0));
  }
  Finished in_shell(const std::string& script) const {
    const char* const path = std::getenv("PATH");
    const std::string programs = fs::path(UNDERSTUDY_BINARY).parent_path().string();
    return run({"env", "-C", folder_.path(), "bash", "-ec", script},
               {{"PATH", programs + ":" + (path == nullptr ? "/usr/bin:/bin" : path)}});
  }
  PrivateFolder folder_;
};

TEST_F(HuntPage, ItsCommandsComeToWhatItSays) {
  const auto scripts = page_blocks("hunt.md", "sh");
  ASSERT_EQ(scripts.size(), 3U);
  const Finished first = in_shell(scripts[0]);
  EXPECT_EQ(first.exit_code, 0) << first.output << first.errors;
  // The page prints what comes out, to the letter.
  const auto printed = page_blocks("hunt.md", "text");
  EXPECT_NE(first.output.find(printed.at(0)), std::string::npos) << first.output;
  for (const char* const ending : {".yaml", ".jsonl", ".html"})
    EXPECT_TRUE(fs::exists(folder_ / ("found/press-438cd470" + std::string(ending)))) << ending;
  EXPECT_EQ(understudy({"replay", folder_ / "found/press-438cd470.jsonl"}).exit_code, 0);
  const Finished mended = in_shell(scripts[1]);
  EXPECT_EQ(mended.exit_code, 0) << mended.output << mended.errors;
  EXPECT_NE(mended.output.find("2000 courses, 0 found; "), std::string::npos) << mended.output;
}

TEST_F(HuntPage, TheExitCodeSaysWhatWasFound) {
  EXPECT_EQ(in_shell("understudy hunt press.yaml --courses 100 --seed 3 --jobs 2").exit_code, 1);
  EXPECT_EQ(in_shell("understudy hunt press.yaml --courses 1").exit_code, 0);
  for (const char* const wrong :
       {"hunt", "hunt none.yaml", "hunt press.yaml --for soon", "hunt press.yaml --jobs 0",
        "hunt press.yaml --shard 3/2", "hunt press.yaml --courses 1 --found press.yaml"}) {
    const Finished finished = in_shell(std::string("understudy ") + wrong);
    EXPECT_EQ(finished.exit_code, 2) << wrong << finished.output;
    EXPECT_FALSE(finished.errors.empty()) << wrong;
  }
}

TEST_F(HuntPage, AFileWithoutAHuntIsRefused) {
  folder_.write("plain.yaml",
                "understudy: 1\nbench: { lines: { l: { stations: [ { name: a, model: simple2-r3 } ] } } }\n"
                "steps: [ advance: 1ms ]\n");
  const Finished finished = in_shell("understudy hunt plain.yaml");
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_NE(finished.errors.find("plain.yaml: hunt: is missing; expected `hunt:` with possible disturbances"),
            std::string::npos)
      << finished.errors;
}

}  // namespace hunt_page_test
}  // namespace understudy::acceptance
