// Hosts that come and go: nothing that a host wrote is lost, no other host gets its unread bytes, and a host
// that never reads does not affect anyone.
#include <gtest/gtest.h>
#include <sched.h>

#include <cstring>
#include <fstream>
#include <thread>

#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/raw_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace reopening_test {

using Clock = std::chrono::steady_clock;

/// Waits until the daemon has noticed that its last host has gone.
bool is_free(const RunningUnderstudy& daemon) {
  return daemon.ctl({"status"}).output.find("host closed") != std::string::npos;
}

TEST(HostThatClosesAtOnce, HasItsWriteApplied) {
  const RunningUnderstudy daemon;
  for (const int speed : {200, 0, 200, 0, 200}) {
    {
      Host hasty(daemon.port());
      ASSERT_TRUE(hasty.set_even_parity(B19200));
      hasty.write(speed == 200 ? kSetSpeed200 : pty::hex("01 06 10 02 00 00 2C CA"));
    }
    EXPECT_TRUE(eventually([&] {
      return daemon.ctl({"get", "Aaxis_Speed"}).output == "Aaxis_Speed " + std::to_string(speed) + "\n";
    })) << speed;
  }
}

TEST(HostThatClosesAtOnce, LeavesNoReplyToTheNext) {
  const RunningUnderstudy daemon;
  for (int time = 1; time <= 5; ++time) {
    {
      Host hasty(daemon.port());
      ASSERT_TRUE(hasty.set_even_parity(B19200));
      hasty.write(kReadHardwareCode);
    }
    EXPECT_TRUE(eventually([&] { return daemon.requests() == 2 * time - 1; }));  // executed and answered
    std::this_thread::sleep_for(Wait(20));
    Host next(daemon.port());
    ASSERT_TRUE(next.set_even_parity(B19200));
    EXPECT_TRUE(is_silent(next));
    EXPECT_EQ(exchange(next, kSetSpeed200, kSetSpeed200.size()), kSetSpeed200);
  }
}

TEST(HostThatReadsHalfAReply, LeavesNotTheOtherHalfToTheNext) {
  const RunningUnderstudy daemon;
  {
    Host first(daemon.port());
    ASSERT_TRUE(first.set_even_parity(B19200));
    EXPECT_EQ(exchange(first, kReadHardwareCode, 3), pty::hex("01 03 02"));
    std::this_thread::sleep_for(Wait(10));  // the rest waits in the pty
  }
  EXPECT_TRUE(eventually([&] { return is_free(daemon); }));
  Host next(daemon.port());
  ASSERT_TRUE(next.set_even_parity(B19200));
  EXPECT_TRUE(is_silent(next));
  EXPECT_EQ(exchange(next, kSetSpeed200, kSetSpeed200.size()), kSetSpeed200);
}

TEST(HostThatStopsInsideARequest, DoesNotSpoilTheNextOnes) {
  const RunningUnderstudy daemon;
  {
    Host first(daemon.port());
    ASSERT_TRUE(first.set_even_parity(B19200));
    first.write(Bytes(kSetSpeed200.begin(), kSetSpeed200.begin() + 5));
  }
  std::this_thread::sleep_for(Wait(100));
  ModbusHost next(daemon.port());
  EXPECT_EQ(next.read(kHardwareCode), Registers{0xC001});
  EXPECT_EQ(next.read(kAaxisSpeed), Registers{0});
}

// --- hosts that follow each other closely ----------------------------------------------------------

/// Keeps two processors for the daemon and its host during its lifetime, so that the daemon meets the next
/// host while it still handles the end of the previous one.
class OnTwoProcessors {
 public:
  explicit OnTwoProcessors(pid_t daemon) {
    sched_getaffinity(0, sizeof(before_), &before_);
    std::vector<int> processors;
    for (int i = 0; i < CPU_SETSIZE; ++i) {
      if (CPU_ISSET(i, &before_)) processors.push_back(i);
    }
    pin(daemon, processors.front());
    pin(0, processors.back());
  }
  ~OnTwoProcessors() { sched_setaffinity(0, sizeof(before_), &before_); }
  OnTwoProcessors(const OnTwoProcessors&) = delete;
  OnTwoProcessors& operator=(const OnTwoProcessors&) = delete;

 private:
  static void pin(pid_t process, int processor) {
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(processor, &set);
    sched_setaffinity(process, sizeof(set), &set);
  }
  cpu_set_t before_{};
};

TEST(HostThatReopensAtOnce, IsKnownByItsOwnSettings) {
  const RunningUnderstudy daemon({"--baud", "115200"});
  const OnTwoProcessors pinned(daemon.process().pid());
  for (int time = 1; time <= 300; ++time) {
    ModbusHost host(daemon.port(), {.baud = 115200});
    ASSERT_EQ(host.read(kHardwareCode), Registers{0xC001})
        << "time " << time << ": " << strerror(host.error());
  }
  EXPECT_EQ(daemon.errors(), "") << "every host has set its speed";
}

TEST(HostThatReopensAtOnce, IsNotReceivedAtAnotherSpeed) {
  const RunningUnderstudy daemon({"--baud", "115200"});
  const OnTwoProcessors pinned(daemon.process().pid());
  constexpr int kTimes = 40;
  int received = 0;
  for (int time = 1; time <= kTimes; ++time) {
    EXPECT_EQ(ModbusHost(daemon.port(), {.baud = 115200}).read(kHardwareCode), Registers{0xC001});
    ModbusHost wrong(daemon.port(), {.baud = 9600, .patience = Wait(25)});
    if (!wrong.read(kHardwareCode).empty()) ++received;
  }
  EXPECT_EQ(received, 0) << "of " << kTimes;
}

// --- a host that never reads ----------------------------------------------------------------------

long resident_kilobytes(pid_t pid) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmRSS:")) return std::stol(line.substr(6));
  }
  return -1;
}

class Flood : public testing::TestWithParam<const char*> {};

TEST_P(Flood, OfRequestsWhoseRepliesNobodyReadsHarmsNobody) {
  const RunningUnderstudy daemon({"--baud", "115200", "--timing", GetParam()});
  ASSERT_EQ(ModbusHost(daemon.port(), {.baud = 115200}).read(kHardwareCode), Registers{0xC001});
  const long before = resident_kilobytes(daemon.process().pid());
  std::uint64_t written = 0;
  {
    Host flood(daemon.port());
    ASSERT_TRUE(flood.set_even_parity(B115200));
    Bytes lump;
    for (int i = 0; i < 64; ++i) lump.insert(lump.end(), kReadHardwareCode.begin(), kReadHardwareCode.end());
    const auto until = Clock::now() + std::chrono::seconds(1);
    bool asked = false;
    while (Clock::now() < until) {
      const ssize_t count = ::write(flood.descriptor(), lump.data(), lump.size());
      if (count > 0) written += static_cast<std::uint64_t>(count);
      if (count <= 0) std::this_thread::sleep_for(Wait(1));
      if (!asked && Clock::now() > until - std::chrono::milliseconds(500)) {
        asked = true;
        EXPECT_EQ(daemon.ctl({"status"}).exit_code, 0) << "the daemon is not blocked";
      }
    }
  }
  EXPECT_GT(written, 10'000U);
  EXPECT_LT(resident_kilobytes(daemon.process().pid()) - before, 2048);
  // The data that the flood left in the pty must still cross the wire: 20 KiB take 2 s at this speed.
  EXPECT_TRUE(eventually([&] {
    ModbusHost next(daemon.port(), {.baud = 115200, .patience = std::chrono::milliseconds(200)});
    return next.read(kHardwareCode) == Registers{0xC001} && next.read(kAaxisPulse, 3) == Registers{0, 0, 0};
  }));
}

INSTANTIATE_TEST_SUITE_P(With, Flood, testing::Values("wire", "instant"),
                         [](const auto& parameter) { return std::string(parameter.param) + "Timing"; });

}  // namespace reopening_test
}  // namespace understudy::acceptance
