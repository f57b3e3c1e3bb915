// The commands of docs/campaigns.md work as printed.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "tests/acceptance/page_blocks.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace campaigns_page_test {

namespace fs = std::filesystem;

class CampaignsPage : public testing::Test {
 protected:
  CampaignsPage() {
    const auto files = page_blocks("campaigns.md", "yaml");
    EXPECT_EQ(files.size(), 1U);
    folder_.write("campaign.yaml", files.at(0));
  }
  Finished with(const Words& interpreter, const std::string& script) const {
    const char* const path = std::getenv("PATH");
    const std::string programs = fs::path(UNDERSTUDY_BINARY).parent_path().string();
    Words command{"env", "-C", folder_.path()};
    command.insert(command.end(), interpreter.begin(), interpreter.end());
    command.push_back(script);
    return run(command, {{"PATH", programs + ":" + (path == nullptr ? "/usr/bin:/bin" : path)}});
  }
  PrivateFolder folder_;
};

TEST_F(CampaignsPage, ItsCommandsComeToWhatItSays) {
  if (run({"sh", "-c", "command -v sqlite3"}).exit_code != 0) GTEST_SKIP() << "sqlite3 is not installed";
  const auto scripts = page_blocks("campaigns.md", "sh");
  const std::vector<Words> expected = {
      {"campaign.yaml: 30 scenarios with ",
       "3 failed in the same way: campaign.yaml:20: ", "27 passed, 3 failed; "},
      {"6 passed, 0 failed; ", "1 passed, 0 failed; ", "hash a move past a bad line (speed="},
      {"speed  pulses  failed", "400    7000    3"},
      {"27 passed, 3 failed; ", ": the same: "},
      {"30 skipped, because they ran earlier; 3 of them failed", "0 passed, 0 failed; ",
       "27 skipped, because they ran earlier; 0 of them failed", "0 passed, 3 failed; "}};
  ASSERT_EQ(scripts.size(), expected.size());
  for (std::size_t i = 0; i < scripts.size(); ++i) {
    const Finished finished = with({"bash", "-ec"}, scripts[i]);
    EXPECT_EQ(finished.exit_code, 0) << scripts[i] << finished.output << finished.errors;
    for (const std::string& text : expected[i]) {
      EXPECT_NE(finished.output.find(text), std::string::npos) << text << "\n" << finished.output;
    }
  }
}

TEST_F(CampaignsPage, ItsPythonReadsTheLines) {
  understudy({"run", folder_ / "campaign.yaml", "--results", folder_ / "results.jsonl"});
  const auto scripts = page_blocks("campaigns.md", "python");
  ASSERT_EQ(scripts.size(), 1U);
  const Finished finished = with({"python3", "-c"}, scripts[0]);
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_NE(finished.output.find("'pulses': 9000"), std::string::npos) << finished.output;
}

}  // namespace campaigns_page_test
}  // namespace understudy::acceptance
