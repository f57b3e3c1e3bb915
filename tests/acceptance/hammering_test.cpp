// A host that sends without pause: requests back to back, no reads for a long time, noise. The daemon
// survives, answers valid requests, keeps its time, and does not grow.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <span>
#include <thread>

#include "pty/rtu_crc.h"
#include "tests/acceptance/fifteen_stations.h"
#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/raw_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace hammering_test {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::json;

void append(Bytes& bytes, const Bytes& more) {
  std::copy(more.begin(), more.end(), std::back_inserter(bytes));
}

/// Station, function and data, with the checksum.
Bytes frame(Bytes bytes) {
  pty::append_rtu_crc(bytes);
  return bytes;
}
std::uint8_t low(int value) { return static_cast<std::uint8_t>(value); }
std::uint8_t high(int value) { return static_cast<std::uint8_t>(value >> 8); }

Bytes set_speed(int speed) { return frame({1, 0x06, 0x10, 0x02, high(speed), low(speed)}); }  // echoed
const Bytes kReadSpeed = pty::hex("01 03 10 02 00 01 21 0A");
Bytes speed_reply(int speed) { return frame({1, 0x03, 2, high(speed), low(speed)}); }

/// Reads until the line has been silent for a while.
Bytes read_all(Host& host) { return host.read(SIZE_MAX, kSilenceMs); }

/// Writes `lump` repeatedly for some time, as often as the pty accepts it, and ends with a whole one. Returns
/// how many were written.
std::size_t flood(Host& host, const Bytes& lump, Wait duration) {
  std::size_t sent = 0;
  const auto until = Clock::now() + duration;
  while (Clock::now() < until || (sent % lump.size() != 0 && Clock::now() < until + kPatience)) {
    const auto rest = std::span(lump).subspan(sent % lump.size());
    const ssize_t count = ::write(host.descriptor(), rest.data(), rest.size());
    if (count > 0) sent += static_cast<std::size_t>(count);
    if (count <= 0) std::this_thread::sleep_for(Wait(1));
  }
  EXPECT_EQ(sent % lump.size(), 0U);
  return sent / lump.size();
}

Json status(const RunningUnderstudy& daemon) {
  const auto asked = Clock::now();
  const Finished finished = daemon.ctl({"--json", "status"});
  EXPECT_LT(Clock::now() - asked, std::chrono::seconds(2)) << "the daemon is not blocked";
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  return Json::parse(finished.output)["status"];
}

/// Waits until the first line has received this many bytes from its host, and the wire has carried them.
void expect_taken(const RunningUnderstudy& daemon, std::size_t bytes) {
  EXPECT_TRUE(eventually([&] { return status(daemon)["lines"].at(0)["bytes_in"] == bytes; })) << bytes;
  std::this_thread::sleep_for(Wait(120));  // 1,024 bytes at 115200 baud take 98 ms
}

/// Checks that simulated time follows the clock during its lifetime, without a slip.
class KeepsTime {
 public:
  explicit KeepsTime(const RunningUnderstudy& daemon) : daemon_(daemon), earliest_(Clock::now()) {
    first_ = simulated(status(daemon_));
    latest_ = Clock::now();
  }
  ~KeepsTime() {
    const auto before = Clock::now();
    const Json last = status(daemon_);
    const auto passed = simulated(last) - first_;
    constexpr auto kTick = std::chrono::milliseconds(1);
    EXPECT_GE(passed, before - latest_ - kTick);
    EXPECT_LE(passed, Clock::now() - earliest_ + kTick);
    EXPECT_EQ(last["lateness"]["slips"], 0);
  }
  KeepsTime(const KeepsTime&) = delete;
  KeepsTime& operator=(const KeepsTime&) = delete;

 private:
  static std::chrono::nanoseconds simulated(const Json& status) {
    return std::chrono::nanoseconds(status["simulated_time_ns"].get<std::int64_t>());
  }
  const RunningUnderstudy& daemon_;
  Clock::time_point earliest_;  // when its time was first read: between these two
  Clock::time_point latest_;
  std::chrono::nanoseconds first_{0};
};

/// Returns a field of /proc/PID/status, in KiB: VmRSS is the present memory, VmHWM the peak.
long memory(const RunningUnderstudy& daemon, const std::string& field) {
  std::ifstream file("/proc/" + std::to_string(daemon.process().pid()) + "/status");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(field + ":")) return std::stol(line.substr(field.size() + 1));
  }
  ADD_FAILURE() << field << " is not known";
  return 0;
}

class Hammering : public testing::TestWithParam<const char*> {
 protected:
  RunningUnderstudy daemon_{{"--baud", "115200", "--timing", GetParam()}};
};

TEST_P(Hammering, RequestsBackToBackAreAnsweredInOrder) {
  constexpr int kRequests = 400;  // 5,600 bytes of replies, which the kernel holds
  Host host(daemon_.port());
  ASSERT_TRUE(host.set_even_parity(B115200));
  const KeepsTime timed(daemon_);
  Bytes requests, replies;
  for (int speed = 1; speed <= kRequests; ++speed) {
    append(requests, speed % 2 == 0 ? set_speed(speed) : kReadSpeed);
    append(replies, speed % 2 == 0 ? set_speed(speed) : speed_reply(speed - 1));
  }
  host.write(requests);
  // Reads nothing until everything is served, and a little longer: the last replies are still on the wire.
  EXPECT_TRUE(eventually([&] { return daemon_.requests() == kRequests; }));
  EXPECT_EQ(host.read(replies.size()), replies);
  EXPECT_TRUE(is_silent(host));
}

TEST_P(Hammering, RepliesThatNobodyReadsAreDroppedAndCounted) {
  Host host(daemon_.port());
  ASSERT_TRUE(host.set_even_parity(B115200));
  std::size_t sent = 0;
  {
    const KeepsTime timed(daemon_);
    sent = kReadHardwareCode.size() * flood(host, kReadHardwareCode, Wait(1000));
  }
  expect_taken(daemon_, sent);
  const Bytes read = read_all(host);
  const Json line = status(daemon_)["lines"].at(0);
  const int requests = line["stations"].at(0)["requests"];
  const int given_up = line["stations"].at(0)["bytes_dropped"];
  EXPECT_EQ(8 * requests + given_up, sent);
  EXPECT_LT(given_up, 800) << "a busy machine sometimes cuts a frame for 10 ms, and then it is dropped";
  EXPECT_EQ(line["bytes_out"], read.size());
  EXPECT_GT(line["bytes_discarded"], 0);
  EXPECT_EQ(line["bytes_out"].get<int>() + line["bytes_discarded"].get<int>(), 7 * requests);
  constexpr std::size_t kWaited = 4000;  // bytes that can wait before any is dropped
  ASSERT_GT(read.size(), kWaited);
  for (std::size_t i = 0; i < kWaited; ++i)
    ASSERT_EQ(read[i], kHardwareCodeReply[i % kHardwareCodeReply.size()]) << "byte " << i;
  EXPECT_EQ(exchange(host, kReadHardwareCode, kHardwareCodeReply.size()), kHardwareCodeReply);
  EXPECT_TRUE(is_silent(host));
}

TEST_P(Hammering, NoiseGetsNoReplyAndAGoodRequestAfterItDoes) {
  std::mt19937 random(20240607);
  const auto pick = [&](unsigned count) { return static_cast<int>(random() % count); };
  Host host(daemon_.port());
  ASSERT_TRUE(host.set_even_parity(B115200));
  const KeepsTime timed(daemon_);
  constexpr int kTimes = 40;
  int asked_again = 0;
  for (int time = 1; time <= kTimes && !HasFailure(); ++time) {
    Bytes noise;
    for (int size = pick(600); size > 0; --size) noise.push_back(low(pick(256)));
    // Beginnings of valid requests, and whole ones with one wrong bit.
    for (int count = pick(5); count > 0; --count) {
      Bytes wrong = set_speed(pick(1000));
      if (pick(2) == 0) {
        wrong.resize(static_cast<std::size_t>(1 + pick(7)));
      } else {
        wrong[static_cast<std::size_t>(pick(8))] ^= static_cast<std::uint8_t>(1 << pick(8));
      }
      append(noise, wrong);
    }
    host.write(noise);
    host.write(set_speed(time));
    Bytes reply = host.read(8, 1000);
    if (reply.empty()) {  // cut by a busy machine: a host repeats it
      ++asked_again;
      reply = exchange(host, set_speed(time), 8);
    }
    EXPECT_EQ(reply, set_speed(time)) << "time " << time;
    EXPECT_EQ(exchange(host, kReadSpeed, 7), speed_reply(time)) << "time " << time;
  }
  EXPECT_TRUE(is_silent(host));
  EXPECT_LE(asked_again, 2);
  EXPECT_EQ(daemon_.requests(), 2 * kTimes);
}

TEST_P(Hammering, AFloodOfNoiseHarmsNobody) {
  std::mt19937 random(20240608);
  // The address does not exist on the line, so a request that is valid by chance gets no reply either.
  Bytes noise(20'000);
  for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(2 + random() % 254);
  Host host(daemon_.port());
  ASSERT_TRUE(host.set_even_parity(B115200));
  const KeepsTime timed(daemon_);
  const std::size_t sent = noise.size() * flood(host, noise, Wait(1000));
  expect_taken(daemon_, sent);
  EXPECT_TRUE(is_silent(host));
  EXPECT_EQ(exchange(host, kReadHardwareCode, kHardwareCodeReply.size()), kHardwareCodeReply);
  EXPECT_EQ(daemon_.requests(), 1);
}

TEST_P(Hammering, MemoryStaysWhatItIs) {
  Bytes lump;
  for (int i = 0; i < 100; ++i) {
    append(lump, kReadHardwareCode);
    append(lump, pty::hex("FF 00 01 03 42"));
  }
  Host host(daemon_.port());
  ASSERT_TRUE(host.set_even_parity(B115200));
  std::size_t sent = 0;
  const auto flood_and_read = [&](Wait duration) {
    sent += lump.size() * flood(host, lump, duration);
    expect_taken(daemon_, sent);
    EXPECT_GT(read_all(host).size(), 4000U);
  };
  flood_and_read(Wait(300));
  const long before = memory(daemon_, "VmRSS");
  const int times = std::string(GetParam()) == "wire" ? 1 : 3;  // the wire needs 2 s for what the pty holds
  for (int time = 0; time < times; ++time) flood_and_read(Wait(500));
  EXPECT_LT(memory(daemon_, "VmRSS") - before, 512);
  EXPECT_LT(memory(daemon_, "VmHWM") - before, 1024);
}

TEST_P(Hammering, HostsThatWriteAndGoDoNotPileUp) {
  Bytes lump;
  for (int i = 0; i < 512; ++i) append(lump, kReadHardwareCode);
  EXPECT_EQ(daemon_.ctl({"status"}).exit_code, 0);
  const long before = memory(daemon_, "VmRSS");
  for (int time = 0; time < 200; ++time) {
    Host host(daemon_.port());
    host.set_even_parity(B115200);  // may be refused: they follow each other too closely (docs/wire.md)
    for (ssize_t count = 1; count > 0;) count = ::write(host.descriptor(), lump.data(), lump.size());
    host.close();
    std::this_thread::sleep_for(Wait(2));
  }
  EXPECT_LT(memory(daemon_, "VmRSS") - before, 1024);
  // Only the contents of the pty are left, 2 s on the wire.
  ModbusHost host(daemon_.port(), {.baud = 115200, .patience = kPatience});
  // While the pty is full, a write is refused (EAGAIN), because the daemon has not yet read the remaining
  // bytes.
  EXPECT_TRUE(eventually([&] { return host.read(kHardwareCode) == Registers{0xC001}; }))
      << modbus_strerror(host.error());
}

// 32,000 pulses at 600 RPM take 1 s, plus half of the 20 ms of acceleration and deceleration.
TEST_P(Hammering, AMoveTakesItsTimeUnderRequestsWithoutAPause) {
  ModbusHost host(daemon_.port(), {.baud = 115200, .patience = kPatience});
  ASSERT_TRUE(host.write(kAaxisSvon, 1));
  ASSERT_TRUE(host.write(kAaxisPulse, Registers{32000, 0, 600, 1, 1}));
  const KeepsTime timed(daemon_);
  ASSERT_TRUE(host.write(kAaxisMoveInc, 1));
  const auto started = Clock::now();
  int requests = 0;
  std::int32_t last = 0;
  while (host.is_moving() && Clock::now() < started + kPatience) {
    const std::int32_t at = host.read_long(kCordA);
    EXPECT_GE(at, last);
    last = at;
    requests += 2;
  }
  const auto taken = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - started);
  EXPECT_NEAR(static_cast<double>(taken.count()), 1010, 40);
  EXPECT_EQ(host.read_long(kCordA), 32000);
  EXPECT_GT(requests, 100);
}

INSTANTIATE_TEST_SUITE_P(With, Hammering, testing::Values("wire", "instant"),
                         [](const auto& parameter) { return std::string(parameter.param) + "Timing"; });

// A host that addresses the next station before the previous one has replied causes a collision; the line
// recovers.
TEST(HammeringFifteenStations, LeavesAllOfThemAlive) {
  for (const char* timing : {"wire", "instant"}) {
    const auto daemon = RunningUnderstudy::of_bench(fifteen_stations(115200, timing));
    {
      Host host(daemon->port());
      ASSERT_TRUE(host.set_even_parity(B115200));
      Bytes lump;
      for (int station = 0; station <= kStations; ++station) {
        append(lump, frame({low(station), 0x06, 0x10, 0x02, 0, low(station)}));
        append(lump, frame({low(station), 0x03, 0x10, 0x00, 0, 125}));  // refused: it ends in a hole
      }
      const KeepsTime timed(*daemon);
      const std::size_t lumps = flood(host, lump, Wait(500));
      expect_taken(*daemon, lumps * lump.size());
      read_all(host);
      for (const Json& station : status(*daemon)["lines"].at(0)["stations"]) {
        // Two of its own, and two broadcasts. On the wire, the reply to the previous request damages the next
        // one.
        EXPECT_GT(station["requests"], 0) << station;
        EXPECT_LE(station["requests"], 4 * lumps) << station;
        if (std::string(timing) == "wire") continue;
        const std::size_t given_up = station["bytes_dropped"];  // any station's, cut by a busy machine
        EXPECT_GE(station["requests"].get<std::size_t>() + given_up, 4 * lumps) << station;
        EXPECT_LT(given_up, 800U);
      }
    }
    ModbusHost host(daemon->port(), {.baud = 115200, .patience = kPatience});
    for (int station = 1; station <= kStations; ++station) {
      host.set_station(station);
      EXPECT_TRUE(host.write(kAaxisAccTime, 100 + station)) << modbus_strerror(host.error());
    }
    for (int station = 1; station <= kStations; ++station) {
      host.set_station(station);
      EXPECT_EQ(host.read(kAaxisAccTime), Registers{static_cast<std::uint16_t>(100 + station)}) << timing;
    }
  }
}

}  // namespace hammering_test
}  // namespace understudy::acceptance
