// The live page in real browsers, with mbpoll as the host alongside. Browsers are heavy to install, so this
// runs only with UNDERSTUDY_HEAVY_HOSTS=1 (./test then installs them).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace page_browser_test {

class PageInABrowser : public testing::TestWithParam<const char*> {};

TEST_P(PageInABrowser, ShowsAndDoesWhatItShould) {
  const char* wanted = getenv("UNDERSTUDY_HEAVY_HOSTS");
  if (wanted == nullptr || std::string(wanted) != "1") {
    GTEST_SKIP() << "UNDERSTUDY_HEAVY_HOSTS=1 is not set (it needs chromium, chromium-driver, firefox-esr "
                    "and python3-selenium)";
  }
  Process visit({"/usr/bin/python3", std::string(TEST_FACTS) + "/hosts/browser/live.py", UNDERSTUDY_BINARY,
                 "--only", GetParam()});
  EXPECT_EQ(visit.wait(std::chrono::seconds(500)), 0) << visit.output() << visit.errors();
}

INSTANTIATE_TEST_SUITE_P(Parts, PageInABrowser,
                         testing::Values("panels_simple2-r3", "panels_slim", "panels_rs-m8194h",
                                         "panels_super-40nc", "does_axes", "does_signals", "does_plot",
                                         "does_registers", "does_bus", "does_program", "does_faults",
                                         "does_keyboard", "does_keeps", "host", "before", "burst", "restart",
                                         "recording", "story", "story_file", "path", "ladder", "waits",
                                         "crowd", "firefox"),
                         [](const testing::TestParamInfo<const char*>& part) {
                           std::string name = part.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace page_browser_test
}  // namespace understudy::acceptance
