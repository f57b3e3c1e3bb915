// Small hosts with planted faults (tests/planted_hosts): a campaign finds each, and none in the mended host.
#include <gtest/gtest.h>

#include <string>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace planted_faults_test {

class PlantedFault : public testing::TestWithParam<const char*> {
 protected:
  Finished campaign(const char* kind) const {
    const std::string scenario = std::string(PLANTED_HOSTS) + "/" + GetParam() + ".yaml";
    return understudy({"exec", scenario, "--host-time", "--jobs", "2", "--failures", folder_ / "failures",
                       "--", PLANTED_HOST, GetParam(), kind, "${number}"});
  }

 private:
  PrivateFolder folder_;
};

TEST_P(PlantedFault, IsFoundInTheCarelessHostAlone) {
  const Finished careless = campaign("careless");
  EXPECT_EQ(careless.exit_code, 1) << careless.output << careless.errors;
  EXPECT_NE(careless.output.find(" passed, "), std::string::npos) << careless.output;
  EXPECT_EQ(careless.output.find("\n0 passed, "), std::string::npos) << "some cases hide the fault";
  EXPECT_EQ(careless.output.find("the command was stopped"), std::string::npos) << careless.output;
  const Finished careful = campaign("careful");
  EXPECT_EQ(careful.exit_code, 0) << careful.output << careful.errors;
}

INSTANTIATE_TEST_SUITE_P(Hosts, PlantedFault,
                         testing::Values("double_move", "stale_busy_bit", "torn_value", "timeout_race",
                                         "missing_wait", "counter_overflow", "lost_command", "starved_stop",
                                         "word_order", "early_alarm_clear"),
                         [](const auto& host) { return std::string(host.param); });

}  // namespace planted_faults_test
}  // namespace understudy::acceptance
