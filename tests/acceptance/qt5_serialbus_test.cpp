// Qt's Modbus master as the host: it keeps t3.5, and sends a broadcast without waiting for a reply. Qt is
// heavy to install, so these tests run only with UNDERSTUDY_HEAVY_HOSTS=1 (./test then installs it).
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace qt5_serialbus_test {

struct QtSetup {
  int baud;
  char parity;

  friend std::ostream& operator<<(std::ostream& out, const QtSetup& setup) {
    return out << setup.baud << " 8" << setup.parity << "1";
  }
};

/// Three stations of a line, with addresses at both ends of the switch.
std::string three_stations(int baud, const std::string& timing) {
  return "understudy: 1\nlines:\n  rs485:\n    baud: " + std::to_string(baud) + "\n    timing: " + timing +
         R"(
    stations:
      - { name: first, model: simple2-r3, address: 1 }
      - { name: middle, model: simple2-r3, address: 7 }
      - { name: last, model: simple2-r3, address: 15 }
)";
}

class Qt5SerialBus : public testing::TestWithParam<QtSetup> {
 protected:
  void SetUp() override {
    const char* wanted = getenv("UNDERSTUDY_HEAVY_HOSTS");
    if (wanted == nullptr || std::string(wanted) != "1")
      GTEST_SKIP() << "UNDERSTUDY_HEAVY_HOSTS=1 is not set (it needs libqt5serialbus5-dev)";
    const std::string source = std::string(TEST_FACTS) + "/hosts/qt5_serialbus";
    const Finished configured = run({CMAKE_PROGRAM, "-S", source, "-B", build_, "-G", "Ninja"});
    ASSERT_EQ(configured.exit_code, 0) << configured.errors;
    const Finished built = run({CMAKE_PROGRAM, "--build", build_});
    ASSERT_EQ(built.exit_code, 0) << built.output << built.errors;
  }

  /// The result of each request, sent while the port was open once.
  std::vector<std::string> send(const RunningUnderstudy& daemon, const Words& requests) const {
    Words command{build_ + "/qt5_serialbus_host", daemon.port(), std::to_string(GetParam().baud),
                  std::string(1, GetParam().parity)};
    command.insert(command.end(), requests.begin(), requests.end());
    const Finished finished = run(command);
    EXPECT_EQ(finished.exit_code, 0) << finished.output << finished.errors;
    return lines_of(finished.output);
  }

  struct Case {
    const char* request;
    const char* outcome;
  };
  void expect(const RunningUnderstudy& daemon, const std::vector<Case>& cases) const {
    Words requests;
    for (const Case& one : cases) requests.emplace_back(one.request);
    const auto outcomes = send(daemon, requests);
    ASSERT_EQ(outcomes.size(), cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i)
      EXPECT_EQ(outcomes[i], cases[i].outcome) << cases[i].request << ", request " << i + 1;
    EXPECT_EQ(daemon.errors(), "");
  }

  const std::string build_ = std::string(BUILD_FOLDER) + "/qt5_serialbus_host";
};

TEST_P(Qt5SerialBus, ExchangesAndLearnsWhatIsRefused) {
  const RunningUnderstudy daemon({"--baud", std::to_string(GetParam().baud)});
  for (int opening = 1; opening <= 3; ++opening) {
    expect(daemon, {{"1/read/0x0001/1", "49153"},
                    {"1/inputs/0x0001/1", "49153"},
                    {"1/write/0x1002/200", "written"},
                    {"1/write/0x1000/0xFE0C,0xFFFF", "written"},  // -500, low word first
                    {"1/read/0x1000/3", "65036 65535 200"},
                    {"1/raw/0x05/0000FF00", "exception 1"},    // write a coil
                    {"1/raw/0x41/0102", "exception 1"},        // an unknown function
                    {"1/read/0x0003/1", "exception 2"},        // a hole
                    {"1/write/0x0001/1", "exception 2"},       // HW_Code is read-only
                    {"1/write/0x1003/3001", "exception 3"},    // the maximum of AccTime is 3000
                    {"1/raw/0x03/4000007E", "exception 3"},    // 126 registers
                    {"1/raw/0x03/00010001", "02c001"},         // byte count, HW_Code
                    {"1/read/0x1000/3", "65036 65535 200"}});  // as before
  }
  EXPECT_EQ(daemon.requests(), 3 * 13);
  EXPECT_EQ(daemon.ctl({"get", "Aaxis_Pulse"}).output, "Aaxis_Pulse -500\n");
}

TEST_P(Qt5SerialBus, BroadcastsToEveryStationWithoutAReply) {
  for (const char* timing : {"wire", "instant"}) {
    const auto daemon = RunningUnderstudy::of_bench(three_stations(GetParam().baud, timing));
    expect(*daemon, {{"1/write/0x1002/1", "written"},
                     {"7/write/0x1002/7", "written"},
                     {"15/write/0x1002/15", "written"},
                     {"0/write/0x1002/321", "broadcast"},
                     {"15/read/0x1002/1", "321"},
                     {"1/read/0x1002/1", "321"},
                     {"7/read/0x1002/1", "321"},
                     {"0/write/0x1000/0xFE0C,0xFFFF,1000", "broadcast"},
                     {"0/write/0x1003/3001", "broadcast"},  // each refuses it, and none replies
                     {"0/write/0x1004/9", "broadcast"},
                     {"7/write/0x1002/8", "written"},
                     {"1/read/0x1000/5", "65036 65535 1000 0 9"},
                     {"7/read/0x1000/5", "65036 65535 8 0 9"},
                     {"15/read/0x1000/5", "65036 65535 1000 0 9"}});
    EXPECT_EQ(daemon->ctl({"get", "first.Aaxis_Speed", "middle.Aaxis_Speed", "last.Aaxis_Speed"}).output,
              "first.Aaxis_Speed 1000\nmiddle.Aaxis_Speed 8\nlast.Aaxis_Speed 1000\n")
        << timing;
  }
}

TEST_P(Qt5SerialBus, StartsEveryStationWithOneBroadcast) {
  const auto daemon = RunningUnderstudy::of_bench(three_stations(GetParam().baud, "wire"));
  // Pulses (low, high word), 600 RPM, 10 ms of acceleration and deceleration: 0.11 to 0.41 s.
  expect(*daemon, {{"0/write/0x1014/1", "broadcast"},  // Aaxis_SVON
                   {"1/write/0x1000/3200,0,600,1,1", "written"},
                   {"7/write/0x1000/6400,0,600,1,1", "written"},
                   {"15/write/0x1000/12800,0,600,1,1", "written"},
                   {"0/write/0x1005/1", "broadcast"},  // Aaxis_Move_INC
                   {"1/poll/0x0000/0x10", "0"},
                   {"7/poll/0x0000/0x10", "0"},
                   {"15/poll/0x0000/0x10", "0"},
                   {"1/read/0x0E04/2", "3200 0"},
                   {"7/read/0x0E04/2", "6400 0"},
                   {"15/read/0x0E04/2", "12800 0"}});
}

INSTANTIATE_TEST_SUITE_P(At, Qt5SerialBus,
                         testing::Values(QtSetup{19200, 'E'}, QtSetup{19200, 'N'}, QtSetup{115200, 'E'}),
                         [](const auto& parameter) {
                           return std::to_string(parameter.param.baud) + "Baud8" + parameter.param.parity +
                                  "1";
                         });

}  // namespace qt5_serialbus_test
}  // namespace understudy::acceptance
