// mbpoll as a user calls it: at 8E1, with one process per request, so each one reopens the port.
#include <gtest/gtest.h>
#include <signal.h>

#include <regex>

#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace mbpoll_test {

class Mbpoll : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    if (run({"mbpoll", "-V"}).exit_code == 127) GTEST_SKIP() << "mbpoll is not installed";
    daemon_ = std::make_unique<RunningUnderstudy>(Words{"--baud", std::to_string(GetParam())});
  }

  Words command(const std::string& type, int address, const Words& rest) const {
    Words words{"mbpoll", "-m", "rtu", "-b", std::to_string(GetParam()), "-P", "even", "-0",
                "-q",     "-t", type,  "-r", std::to_string(address)};
    words.insert(words.end(), rest.begin(), rest.end());
    words.push_back(daemon_->port());
    return words;
  }
  Finished read(const std::string& type, int address) const { return run(command(type, address, {"-1"})); }
  Finished write(const std::string& type, int address, const std::string& value) const {
    Words words = command(type, address, {});
    words.insert(words.end(), {"--", value});
    return run(words);
  }
  /// Returns the value as mbpoll prints it.
  std::string value(const std::string& type, int address) const {
    const Finished finished = read(type, address);
    EXPECT_EQ(finished.exit_code, 0) << finished.errors;
    std::smatch found;
    const bool printed = std::regex_search(finished.output, found, std::regex("\\]:\\s*(\\S+)"));
    EXPECT_TRUE(printed) << finished.output;
    return printed ? found[1].str() : "";
  }

  std::unique_ptr<RunningUnderstudy> daemon_;
};

TEST_P(Mbpoll, ReadsAndReadsAgainWithEvenParity) {
  for (int run = 1; run <= 3; ++run) EXPECT_EQ(value("4:hex", kHardwareCode), "0xC001") << "run " << run;
  EXPECT_EQ(value("3:hex", kHardwareCode), "0xC001");  // FC 04
  EXPECT_EQ(daemon_->errors(), "");
}

TEST_P(Mbpoll, Writes16And32Bits) {
  EXPECT_EQ(write("4", kAaxisSpeed, "200").exit_code, 0);
  EXPECT_EQ(value("4", kAaxisSpeed), "200");
  EXPECT_EQ(write("4:int", kAaxisPulse, "-70000").exit_code, 0);
  EXPECT_EQ(value("4:int", kAaxisPulse), "-70000");
}

TEST_P(Mbpoll, LearnsWhyARequestIsRefused) {
  const auto refusal = [](const Finished& finished) {
    EXPECT_EQ(finished.exit_code, 1);
    return finished.errors;
  };
  EXPECT_NE(refusal(write("0", 0, "1")).find("Illegal function"), std::string::npos);
  EXPECT_NE(refusal(read("4", kHole)).find("Illegal data address"), std::string::npos);
  EXPECT_NE(refusal(write("4", kHardwareCode, "1")).find("Illegal data address"), std::string::npos);
  EXPECT_NE(refusal(write("4", kAaxisAccTime, "3001")).find("Illegal data value"), std::string::npos);
  EXPECT_EQ(value("4", kAaxisAccTime), "0");
  EXPECT_EQ(value("4:hex", kHardwareCode), "0xC001");
}

TEST_P(Mbpoll, RunsAMoveToItsEnd) {
  EXPECT_EQ(write("4", kAaxisSvon, "1").exit_code, 0);
  EXPECT_EQ(write("4:int", kAaxisPulse, "3200").exit_code, 0);
  EXPECT_EQ(write("4", kAaxisSpeed, "120").exit_code, 0);  // half a second
  EXPECT_EQ(write("4", kAaxisMoveInc, "1").exit_code, 0);
  EXPECT_NE(std::stoi(value("4", kStatus)) & kMovingA, 0);
  EXPECT_TRUE(eventually([this] { return (std::stoi(value("4", kStatus)) & kMovingA) == 0; }));
  EXPECT_EQ(value("4:int", kCordA), "3200");
}

TEST_P(Mbpoll, IsKilledWhilePollingAndComesBack) {
  for (int kill = 1; kill <= 3; ++kill) {
    const int before = daemon_->requests();
    Process polling(command("4", kStatus, {"-l", "11"}));
    EXPECT_TRUE(eventually([&] { return daemon_->requests() >= before + 3; }));
    polling.send(SIGKILL);
    EXPECT_EQ(polling.wait(kPatience), 128 + SIGKILL) << polling.errors();
    EXPECT_EQ(value("4:hex", kHardwareCode), "0xC001") << "after kill " << kill;
  }
}

INSTANTIATE_TEST_SUITE_P(At, Mbpoll, testing::Values(19200, 115200),
                         [](const auto& parameter) { return std::to_string(parameter.param) + "Baud8E1"; });

}  // namespace mbpoll_test
}  // namespace understudy::acceptance
