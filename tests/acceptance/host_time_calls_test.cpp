// Calls that exec --host-time handles, with drawn arguments (tests/calling_host): in real time the kernel and
// libc answer them, and in simulated time the answers must be the same. UNDERSTUDY_CALL_RUNS=N: more runs;
// each seed is tried in both times.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/acceptance/host_time_rig.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace host_time_test {

TEST_F(HostTime, AnswersOddArgumentsAsTheKernelDoes) {
  const char* const given = std::getenv("UNDERSTUDY_CALL_RUNS");
  const int runs = given != nullptr ? std::atoi(given) : 3;
  for (int seed = 1; seed <= runs; ++seed) {
    const Words host{CALLING_HOST, std::to_string(seed), "300"};
    const Finished real = understudy({"exec", bench(), "--", host[0], host[1], host[2]});
    ASSERT_EQ(real.exit_code, 0) << "seed " << seed << ": " << real.output << real.errors;
    const Finished simulated = exec(host, {"--listen", "modbus-tcp://192.168.77.5:502"});
    EXPECT_EQ(simulated.exit_code, 0) << "seed " << seed << ": " << simulated.errors;
    ASSERT_EQ(simulated.output, real.output) << "seed " << seed;
  }
}

}  // namespace host_time_test
}  // namespace understudy::acceptance
