// A day over a real port is recorded and replayed.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace replay_test {

/// Makes the recording of a host that moved axis A by 3200 pulses and watched it until it stopped.
class RecordedDay : public testing::Test {
 protected:
  RecordedDay() {
    RunningUnderstudy daemon({"--record", recording_});
    ModbusHost host(daemon.port());
    EXPECT_TRUE(host.write(kAaxisSvon, 1));
    // 200 RPM of 3200 pulses, shortest ramps: 310 ms.
    EXPECT_TRUE(host.write(kAaxisPulse, {3200, 0, 200, 1, 1, 1}));
    EXPECT_TRUE(eventually([&] {
      const Registers status = host.read(kStatus);
      return !status.empty() && (status[0] & kMovingA) == 0;
    }));
    EXPECT_EQ(daemon.ctl({"input", "DIN_10=1"}).exit_code, 0);
    EXPECT_FALSE(host.read(kCordA).empty());
    EXPECT_EQ(daemon.stop(SIGTERM), 0);
  }

  std::string text() const {
    std::ostringstream text;
    text << std::ifstream(recording_).rdbuf();
    return text.str();
  }

  PrivateFolder folder_;
  std::string recording_ = folder_ / "day.jsonl";
};

TEST_F(RecordedDay, RunsAgainInFreeTime) {
  const Finished finished = understudy({"replay", recording_});
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_EQ(finished.errors, "");
  EXPECT_NE(finished.output.find(": the same: "), std::string::npos) << finished.output;
}

TEST_F(RecordedDay, ReportsTheFirstByteThatDiffers) {
  std::string day = text();
  // The host requests 3201 pulses: 0C81 hex instead of 0C80. The request's checksum is then wrong, so no
  // station replies.
  const std::size_t at = day.find("0c80");
  ASSERT_NE(at, std::string::npos) << day.substr(0, 2000);
  day.replace(at, 4, "0c81");
  const Finished finished = understudy({"replay", folder_.write("other.jsonl", day)});
  EXPECT_EQ(finished.exit_code, 1);
  EXPECT_EQ(lines_of(finished.errors).size(), 1U) << finished.errors;
  EXPECT_NE(finished.errors.find(": differs: "), std::string::npos) << finished.errors;
}

TEST_F(RecordedDay, StopsWhereRequestedAndCanBeInspected) {
  // Somewhere in the middle of the move, which starts with the reply to its start at the latest.
  const std::string control = folder_ / "control";
  Process replay({UNDERSTUDY_BINARY, "replay", recording_, "--until", "200ms", "--control", control});
  ASSERT_TRUE(eventually([&] { return replay.output().find("the clock is at 200ms") != std::string::npos; }))
      << replay.output() << replay.errors();
  const auto ctl = [&](Words words) {
    words.insert(words.begin(), {"ctl", "--control", control});
    return understudy(words);
  };
  EXPECT_EQ(ctl({"get", "STATUS.4"}).output, "STATUS.4 1\n");
  EXPECT_EQ(ctl({"get", "DIN_10"}).output, "DIN_10 0\n") << "that came later";
  const Finished there = ctl({"run-until", "device.STATUS.4 == 0", "--within", "1s"});
  EXPECT_EQ(there.exit_code, 0) << there.errors;
  EXPECT_EQ(ctl({"get", "Cord_A"}).output, "Cord_A 3200\n");
  // It gets a new port, and serves.
  const auto lines = lines_of(replay.output());
  const auto ready = std::find_if(lines.begin(), lines.end(),
                                  [](const std::string& line) { return line.starts_with("ready "); });
  ASSERT_NE(ready, lines.end());
  EXPECT_EQ(ready->find(folder_.path()), std::string::npos);
  replay.send(SIGTERM);
  EXPECT_EQ(replay.wait(kPatience), 0);
}

TEST_F(RecordedDay, StopsAtItsEndIfThatComesFirst) {
  const std::string control = folder_ / "control";
  Process replay({UNDERSTUDY_BINARY, "replay", recording_, "--until", "10h", "--control", control});
  ASSERT_TRUE(eventually([&] { return replay.output().find("the clock is at ") != std::string::npos; }))
      << replay.output() << replay.errors();
  EXPECT_EQ(understudy({"ctl", "--control", control, "get", "Cord_A", "DIN_10"}).output,
            "Cord_A 3200\nDIN_10 1\n");
  replay.send(SIGTERM);
  EXPECT_EQ(replay.wait(kPatience), 0);
}

/// It uses the time of the bench, even while nothing happens.
TEST(QuietRecording, LastsAsLongAsTheDaemonDid) {
  const PrivateFolder folder;
  const std::string recording = folder / "quiet.jsonl";
  {
    RunningUnderstudy daemon({"--record", recording, "--speed", "1000x"});
    ASSERT_TRUE(eventually([&] { return daemon.ctl({"status"}).output.find("simulated time 0s") != 0; }));
    usleep(200'000);  // 200 simulated seconds
    EXPECT_EQ(daemon.stop(SIGTERM), 0);
  }
  const Finished finished = understudy({"replay", recording});
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  std::smatch simulated;
  ASSERT_TRUE(std::regex_search(finished.output, simulated, std::regex(", ([0-9]+)[.0-9]*s simulated")))
      << finished.output;
  EXPECT_GE(std::stoi(simulated[1]), 200) << finished.output;
}

TEST_F(RecordedDay, IsRefusedWhereItIsNoRecording) {
  for (const auto& [text, why] : std::vector<std::pair<std::string, std::string>>{
           {"", "is empty or cannot be read"}, {"{}\n", "understudy"}, {"hello\n", "JSON"}}) {
    const Finished finished = understudy({"replay", folder_.write("bad.jsonl", text)});
    EXPECT_EQ(finished.exit_code, 2) << finished.errors;
    EXPECT_EQ(lines_of(finished.errors).size(), 1U) << finished.errors;
    EXPECT_NE(finished.errors.find(why), std::string::npos) << finished.errors;
  }
}

}  // namespace replay_test
}  // namespace understudy::acceptance
