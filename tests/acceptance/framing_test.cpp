// Where frames end: tolerant of bursts and pauses on a pty, or by silence alone with --strict-framing.
#include <gtest/gtest.h>

#include <thread>

#include "tests/acceptance/raw_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace framing_test {

/// Sends the request in two parts, 5 ms apart, several times. Returns how many got a reply. A busy machine
/// may lengthen or hide a pause, so the tests require the greater part.
constexpr int kTimes = 7;
int answers_to_paused_requests(const RunningUnderstudy& daemon) {
  Host host(daemon.port());
  EXPECT_TRUE(host.set_even_parity(B19200));
  int answers = 0;
  for (int time = 0; time < kTimes; ++time) {
    host.write(Bytes(kReadHardwareCode.begin(), kReadHardwareCode.begin() + 2));
    // The two characters are on the wire for 1.1 ms; the pause begins after them.
    std::this_thread::sleep_for(std::chrono::microseconds(1100 + 5000));
    host.write(Bytes(kReadHardwareCode.begin() + 2, kReadHardwareCode.end()));
    if (host.read(kHardwareCodeReply.size(), 60) == kHardwareCodeReply) ++answers;
  }
  EXPECT_EQ(exchange(host, kReadHardwareCode, kHardwareCodeReply.size()), kHardwareCodeReply)
      << "a request in one piece";
  return answers;
}

TEST(StrictFraming, LeavesARequestWithAPauseUnanswered) {
  const RunningUnderstudy daemon({"--strict-framing"});
  EXPECT_LT(answers_to_paused_requests(daemon), kTimes / 2);
}

TEST(TolerantFraming, AnswersARequestWithAPause) {
  const RunningUnderstudy daemon;
  EXPECT_GT(answers_to_paused_requests(daemon), kTimes / 2);
}

TEST(TolerantFraming, IsPatientByTheHostsClockHoweverFastTimeRuns) {
  for (const char* speed : {"free", "100", "0.5"}) {
    const RunningUnderstudy daemon({"--speed", speed, "--timing", "instant"});
    EXPECT_GT(answers_to_paused_requests(daemon), kTimes / 2) << speed;
  }
}

TEST(TolerantFraming, GivesUpAnIncompleteRequestAlsoWhereTheClockStands) {
  const RunningUnderstudy daemon({"--speed", "manual", "--timing", "instant"});
  Host host(daemon.port());
  ASSERT_TRUE(host.set_even_parity(B19200));
  host.write(pty::hex("01 10 10 00 00 7B F6 00 00"));  // the beginning of a request of 255 bytes
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(exchange(host, kReadHardwareCode, kHardwareCodeReply.size()), kHardwareCodeReply);
}

const Bytes kNoise = pty::hex("FF 00 01 03 42");

Bytes after_noise(const Bytes& request) {
  Bytes bytes = kNoise;
  bytes.insert(bytes.end(), request.begin(), request.end());
  return bytes;
}

TEST(TolerantFraming, FindsAGoodRequestRightAfterNoise) {
  const RunningUnderstudy daemon;
  Host host(daemon.port());
  ASSERT_TRUE(host.set_even_parity(B19200));
  for (int time = 0; time < 3; ++time)
    EXPECT_EQ(exchange(host, after_noise(kReadHardwareCode), kHardwareCodeReply.size()), kHardwareCodeReply);
}

TEST(StrictFraming, LosesARequestRightAfterNoiseAndReceivesTheNext) {
  const RunningUnderstudy daemon({"--strict-framing"});
  Host host(daemon.port());
  ASSERT_TRUE(host.set_even_parity(B19200));
  host.write(after_noise(kReadHardwareCode));
  EXPECT_TRUE(is_silent(host));
  EXPECT_EQ(exchange(host, kReadHardwareCode, kHardwareCodeReply.size()), kHardwareCodeReply);
}

TEST(WrongChecksum, GetsNoReplyAndTheNextRequestWorks) {
  const RunningUnderstudy daemon;
  Host host(daemon.port());
  ASSERT_TRUE(host.set_even_parity(B19200));
  Bytes wrong = kSetSpeed200;
  wrong.back() ^= 1;
  host.write(wrong);
  EXPECT_TRUE(is_silent(host));
  EXPECT_EQ(exchange(host, pty::hex("01 03 10 02 00 01 21 0A"), 7), pty::hex("01 03 02 00 00 B8 44"))
      << "Aaxis_Speed is still 0";
}

}  // namespace framing_test
}  // namespace understudy::acceptance
