// Independent terminal programs as hosts of a served SLIM: python3-serial and expect. Their programs are in
// hosts/slim_serial_host.py and hosts/slim_host.exp.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/acceptance/running_understudy.h"
#include "tests/pty/pcapng_reader.h"

namespace understudy::acceptance {
namespace slim_hosts_test {

// Debian's packages belong to this interpreter; another one earlier in PATH does not find them.
constexpr const char* kPython = "/usr/bin/python3";
constexpr const char* kPyserial = "/usr/lib/python3/dist-packages/serial";
constexpr const char* kExpect = "/usr/bin/expect";

std::unique_ptr<RunningUnderstudy> served(const Words& flags = {}) {
  Words words{"--modules", "3"};
  words.insert(words.end(), flags.begin(), flags.end());
  return RunningUnderstudy::of_model("slim", words);
}

/// The host must succeed, and the daemon must not have printed warnings.
void expect_well(const RunningUnderstudy& daemon, const Words& host) {
  const Finished finished = run(host);
  EXPECT_EQ(finished.exit_code, 0) << finished.output << finished.errors;
  EXPECT_EQ(daemon.errors(), "");
}

class SlimByPyserial : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kPyserial)) GTEST_SKIP() << "python3-serial is not installed";
  }
  static void expect_case(const RunningUnderstudy& daemon, const std::string& name) {
    expect_well(daemon,
                {kPython, std::string(TEST_FACTS) + "/hosts/slim_serial_host.py", daemon.port(), name});
  }
};

TEST_F(SlimByPyserial, DownloadsAProgramRunsItAndGivesItsNumbers) {
  const auto daemon = served();
  expect_case(*daemon, "palletising");
  EXPECT_EQ(daemon->ctl({"get", "PE", "T1PE", "N0", "R0"}).output, "PE 0\nT1PE 25\nN0 2\nR0 12.5\n");
}

TEST_F(SlimByPyserial, SendsHalfLinesAndSeveralAtATime) {
  const auto daemon = served();
  expect_case(*daemon, "half_lines");
  EXPECT_EQ(daemon->ctl({"get", "N1", "R1"}).output, "N1 4\nR1 2.5\n");
}

TEST_F(SlimByPyserial, SendsNoiseBetweenGoodLines) {
  const auto daemon = served();
  expect_case(*daemon, "noise");
}

TEST_F(SlimByPyserial, ComesAndGoes) {
  const auto daemon = served();
  expect_case(*daemon, "reopening");
  EXPECT_EQ(daemon->ctl({"get", "N7"}).output, "N7 10\n");
}

TEST(SlimByExpect, TypesAProgramWithAnEventAndAnswersIt) {
  if (!std::filesystem::exists(kExpect)) GTEST_SKIP() << "expect is not installed";
  const auto daemon = served();
  expect_well(*daemon, {kExpect, "-f", std::string(TEST_FACTS) + "/hosts/slim_host.exp", daemon->port()});
  EXPECT_EQ(daemon->ctl({"get", "PE", "N5"}).output, "PE 0\nN5 0\n");
}

// --- the command line of a text-protocol model -----------------------------------------------------

TEST_F(SlimByPyserial, IsCapturedAsWhatItIs) {
  const PrivateFolder folder;
  {
    const auto daemon = served({"--capture", folder / "a.pcapng"});
    expect_case(*daemon, "half_lines");
  }
  std::ifstream file(folder / "a.pcapng", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const pty::PcapngFile capture = pty::read_pcapng(bytes);
  ASSERT_GE(capture.packets.size(), 2U);
  EXPECT_EQ(capture.packets[0].bytes, (std::vector<std::uint8_t>{'?', 'P', 'E', '\r'}));
  EXPECT_EQ(capture.packets[1].bytes, (std::vector<std::uint8_t>{'0', '\r', '\n'}));
  for (const pty::PcapngPacket& packet : capture.packets) EXPECT_EQ(packet.dissector, "data");
}

TEST(SlimCommandLine, ShowsItsStateAndTakesValues) {
  const auto daemon = served();
  const Finished status = daemon->ctl({"status"});
  EXPECT_EQ(status.exit_code, 0) << status.errors;
  EXPECT_NE(status.output.find("\n  device: 0 requests, 0 replies\n"), std::string::npos) << status.output;
  EXPECT_NE(status.output.find("\ndevice device: slim, firmware 1.00\n"), std::string::npos) << status.output;
  const Finished watch = daemon->ctl({"watch", "--times", "1"});
  EXPECT_EQ(watch.exit_code, 0) << watch.errors;
  EXPECT_NE(watch.output.find("slim, firmware 1.00"), std::string::npos) << watch.output;
  EXPECT_EQ(daemon->ctl({"set", "N3=-7", "T2VM=12.5"}).exit_code, 0);
  EXPECT_EQ(daemon->ctl({"get", "N3", "T2VM"}).output, "N3 -7\nT2VM 12.5\n");
  struct Refused {
    const char* value;
    const char* reported;
  };
  for (const auto& [value, reported] : {Refused{"N3=1.5", "whole number"},
                                        {"N3=40000", "N3: is out of range"},
                                        {"N3=1e300", "N3: is out of range"},
                                        {"PE=1", "not a parameter or variable"}}) {
    const Finished refused = daemon->ctl({"set", value});
    EXPECT_EQ(refused.exit_code, 2) << value;
    EXPECT_EQ(lines_of(refused.errors).size(), 1U) << refused.errors;
    EXPECT_NE(refused.errors.find(reported), std::string::npos) << refused.errors;
  }
}

TEST(SlimCommandLine, RefusesWhatIsNoChain) {
  struct Case {
    Words words;
    const char* reported;
  };
  for (const Case& each : {Case{{"serve", "--model", "slim", "--modules", "9"}, "expected 1 to 8"},
                           Case{{"serve", "--model", "slim", "--modules", "0"}, "expected 1 or more"},
                           Case{{"serve", "--modules", "2", "--model", "simple2-r3"}, "expected none"},
                           Case{{"serve", "--model", "slim", "--station", "1"}, "no station number"},
                           Case{{"poll", "/dev/null", "--model", "slim", "PE"}, "speaks text"}}) {
    const Finished refused = understudy(each.words);
    EXPECT_EQ(refused.exit_code, 2) << each.reported;
    EXPECT_EQ(refused.output, "");
    EXPECT_EQ(lines_of(refused.errors).size(), 1U) << refused.errors;
    EXPECT_NE(refused.errors.find(each.reported), std::string::npos) << refused.errors;
  }
}

TEST(SlimCommandLine, DescribesEveryFormOfItsCommands) {
  const Finished described = understudy({"describe", "slim", "commands", "--format", "csv"});
  EXPECT_EQ(described.exit_code, 0) << described.errors;
  const std::vector<std::string> lines = lines_of(described.output);
  ASSERT_EQ(lines.size(), 1 + 169U);
  EXPECT_EQ(lines[0], "command,syntax,meaning");
  EXPECT_EQ(lines[1].rfind("MA,MA x,", 0), 0U) << lines[1];
}

}  // namespace slim_hosts_test
}  // namespace understudy::acceptance
