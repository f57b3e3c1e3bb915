// Which hosts a device receives: one with its own line settings, and one that set none.
#include <gtest/gtest.h>

#include "tests/acceptance/any_speed.h"
#include "tests/acceptance/raw_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace host_settings_test {

void expect_answer(Host& host) {
  EXPECT_EQ(exchange(host, kReadHardwareCode, kHardwareCodeReply.size()), kHardwareCodeReply);
}

TEST(HostWithAnotherSpeed, GetsNoReplyAndTheUserOneWarning) {
  const RunningUnderstudy daemon;
  {
    Host host(daemon.port());
    ASSERT_TRUE(host.set_even_parity(B9600));
    for (int time = 0; time < 3; ++time) {
      host.write(kReadHardwareCode);
      EXPECT_TRUE(is_silent(host));
    }
  }
  const auto warnings = lines_of(daemon.errors());
  ASSERT_EQ(warnings.size(), 1U) << daemon.errors();
  EXPECT_NE(warnings[0].find("9600"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[0].find("19200"), std::string::npos) << warnings[0];
  Host right(daemon.port());
  ASSERT_TRUE(right.set_even_parity(B19200));
  expect_answer(right);
  EXPECT_EQ(lines_of(daemon.errors()).size(), 1U) << daemon.errors();
}

TEST(HostWithAnotherSpeed, IsReceivedOnceItSetsTheRightOne) {
  const RunningUnderstudy daemon;
  Host host(daemon.port());
  ASSERT_TRUE(host.set_even_parity(B115200));
  host.write(kReadHardwareCode);
  EXPECT_TRUE(is_silent(host));
  ASSERT_TRUE(host.set_even_parity(B19200)) << "also while it holds the port open";
  expect_answer(host);
}

TEST(HostWithTwoStopBits, GetsNoReply) {
  const RunningUnderstudy daemon;
  Host host(daemon.port());
  ASSERT_TRUE(host.set_even_parity(B19200, 2));
  host.write(kReadHardwareCode);
  EXPECT_TRUE(is_silent(host));
  EXPECT_EQ(lines_of(daemon.errors()).size(), 1U) << daemon.errors();
}

TEST(HostWithAnotherSpeed, IsReceivedWithIgnoreBaud) {
  const RunningUnderstudy daemon({"--ignore-baud"});
  Host host(daemon.port());
  ASSERT_TRUE(host.set_even_parity(B9600));
  expect_answer(host);
  EXPECT_EQ(daemon.errors(), "");
}

TEST(HostThatSetsNoSpeed, IsReceivedWithOneWarning) {
  const RunningUnderstudy daemon;
  Host host(daemon.port());
  for (int time = 0; time < 3; ++time) expect_answer(host);
  EXPECT_EQ(lines_of(daemon.errors()).size(), 1U) << daemon.errors();
}

TEST(HostWithTheRightSpeed, CausesNoWarning) {
  const RunningUnderstudy daemon;
  for (int time = 0; time < 20; ++time) {
    Host host(daemon.port());
    ASSERT_TRUE(host.set_even_parity(B19200)) << "opening " << time;
    expect_answer(host);
  }
  EXPECT_EQ(daemon.errors(), "");
}

bool set_speed(const Host& host, int baud) { return set_any_speed(host.descriptor(), baud); }

TEST(HostWithNearlyTheSpeed, IsReceivedWithinTwoPercent) {
  const RunningUnderstudy daemon;
  for (const int baud : {19200, 19201, 18900, 19584, 18816}) {
    Host host(daemon.port());
    ASSERT_TRUE(set_speed(host, baud)) << baud;
    expect_answer(host);
  }
  EXPECT_EQ(daemon.errors(), "");
  for (const int baud : {19585, 18815}) {
    Host host(daemon.port());
    ASSERT_TRUE(set_speed(host, baud));
    host.write(kReadHardwareCode);
    EXPECT_TRUE(is_silent(host)) << baud;
  }
}

TEST(HostWithNearlyTheSpeed, IsReceivedAsTheLineChooses) {
  const RunningUnderstudy exact({"--baud-tolerance", "0%"});
  Host host(exact.port());
  ASSERT_TRUE(set_speed(host, 19201));
  host.write(kReadHardwareCode);
  EXPECT_TRUE(is_silent(host));
  const auto lenient = RunningUnderstudy::of_bench(
      "understudy: 1\nlines: { line: { link: ./port, baud_tolerance: 5%, stations: [ { name: d, model: "
      "simple2-r3, address: 1 } ] } }\n");
  Host slow(lenient->port());
  ASSERT_TRUE(set_speed(slow, 18300));
  expect_answer(slow);
  for (const char* wrong : {"2", "11%", "-1%", "much"}) {
    const Finished refused = understudy({"serve", "--model", "simple2-r3", "--baud-tolerance", wrong});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(refused.errors, "understudy: --baud-tolerance: '" + std::string(wrong) +
                                  "' is not valid; expected 0% to 10%, as in 2%\n");
  }
}

}  // namespace host_settings_test
}  // namespace understudy::acceptance
