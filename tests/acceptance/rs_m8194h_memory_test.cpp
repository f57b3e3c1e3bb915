// The memory of an RS-M8194H under a daemon with --nv: macros that arrived through the window and settings of
// the Initial Table survive the daemon, and an interrupted download leaves the previous macro.
#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>
#include <iterator>

#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace rs_m8194h_memory_test {

constexpr int kCallMp = 8;
constexpr int kCvX = 106;
constexpr int kVar1 = 302;
constexpr int kMd3 = 3006;
constexpr int kWindow = 8000;
constexpr int kRsmState = 100;  // input registers
constexpr int kDownloading = 1;
constexpr HostSetup kAsItComes{.baud = 115200, .parity = 'N'};
const Registers kCreateMp7 = {0x0AC9, 7};
const Registers kClose = {0x0CCA};

/// SET_VAR VAR1: the frame of the manual's 7.5, with a 16-bit number.
Registers set_var1(std::uint16_t number) { return {0x0CD2, 0x7FFF, 1, 0, number}; }

class RsM8194hMemory : public testing::Test {
 protected:
  std::unique_ptr<RunningUnderstudy> serve() const {
    return RunningUnderstudy::of_bench(
        "understudy: 1\nlines:\n  com: { baud: 115200, link: com.port, timing: instant, stations: [ { name: "
        "cell, model: rs-m8194h, address: 1 } ] }\n",
        {"--nv", memory_.path()});
  }
  std::string image() const {
    std::ifstream file(memory_ / "cell.json", std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// MP 7 sets VAR1 to a number.
  static void download(ModbusHost& host, std::uint16_t number) {
    for (const Registers& words : {kCreateMp7, set_var1(number), kClose}) {
      EXPECT_TRUE(host.write(kWindow, words)) << modbus_strerror(host.error());
    }
  }
  static void expect_mp7_sets(ModbusHost& host, std::uint16_t number) {
    EXPECT_TRUE(host.write(kCallMp, 7)) << modbus_strerror(host.error());
    EXPECT_TRUE(eventually([&] {
      return host.read(kVar1, 2) == Registers{0, number};
    })) << testing::PrintToString(host.read(kVar1, 2));
  }

  PrivateFolder memory_;
};

TEST_F(RsM8194hMemory, WhatCameThroughTheWindowOutlivesTheDaemon) {
  {
    const auto daemon = serve();
    ModbusHost host(daemon->port(), kAsItComes);
    download(host, 42);
    EXPECT_TRUE(host.write(kWindow, Registers{0x0A0D, 0x11, 0, 8000}));  // MAX_V of INITIAL_X
    EXPECT_TRUE(host.write(kMd3, Registers{0xFFFF, 0xFFFB}));
    EXPECT_EQ(daemon->stop(SIGTERM), 0);
  }
  const std::string kept = image();
  for (const char* line : {"RSM_SET_MAX_V INITIAL_X 8000", "RSM_MACRO_SET_VAR VAR1 42", "\"MD3\": -5"}) {
    EXPECT_NE(kept.find(line), std::string::npos) << line << " is not in\n" << kept;
  }
  const auto daemon = serve();
  ModbusHost host(daemon->port(), kAsItComes);
  EXPECT_EQ(host.read(kMd3, 2), (Registers{0xFFFF, 0xFFFB}));
  expect_mp7_sets(host, 42);
  // X and Y are set to 12000 PPS; X uses its MAX_V, Y the factory value.
  EXPECT_TRUE(host.write(kWindow, Registers{0x0A47, 3, 0, 12000}));  // SV
  EXPECT_TRUE(host.write(kWindow, Registers{0x0A48, 3, 0, 12000}));  // V
  EXPECT_TRUE(host.write(kWindow, Registers{0x0A50, 3, 0, 12000}));  // CONTINUE_MOVE
  EXPECT_TRUE(eventually([&] {
    return host.read(kCvX, 4) == Registers{0, 8000, 0, 12000};
  })) << testing::PrintToString(host.read(kCvX, 4));
  EXPECT_EQ(daemon->errors(), "");
}

TEST_F(RsM8194hMemory, AKillInADownloadLeavesTheMacroThatWas) {
  // After OPEN, after a line, and after CLOSE, when the new macro is present as soon as it is in the file.
  struct Case {
    const char* when;
    std::vector<Registers> sent;
    std::uint16_t then;
  };
  const std::vector<Case> kCases = {
      {"opened", {kCreateMp7}, 42},
      {"in the midst", {kCreateMp7, set_var1(43)}, 42},
      {"closed", {kCreateMp7, set_var1(44), kClose}, 44},
      {"opened again", {kCreateMp7}, 44},
  };
  {
    const auto daemon = serve();
    ModbusHost host(daemon->port(), kAsItComes);
    download(host, 42);
    EXPECT_EQ(daemon->stop(SIGTERM), 0);
  }
  for (const Case& one : kCases) {
    {
      const auto daemon = serve();
      ModbusHost host(daemon->port(), kAsItComes);
      for (const Registers& words : one.sent) EXPECT_TRUE(host.write(kWindow, words)) << one.when;
      if (one.sent.back() == kClose) {
        EXPECT_TRUE(eventually([&] { return image().find("VAR1 44") != std::string::npos; })) << image();
      } else {
        EXPECT_EQ(host.read_input(kRsmState), Registers{kDownloading}) << one.when;
      }
      EXPECT_EQ(daemon->stop(SIGKILL), 128 + SIGKILL);
    }
    const auto daemon = serve();
    ModbusHost host(daemon->port(), kAsItComes);
    EXPECT_EQ(host.read_input(kRsmState), Registers{0}) << one.when;
    expect_mp7_sets(host, one.then);
    EXPECT_EQ(daemon->errors(), "") << one.when;
  }
}

TEST_F(RsM8194hMemory, APowerCutInADownloadLeavesTheMacroThatWas) {
  const auto daemon = serve();
  ModbusHost host(daemon->port(), kAsItComes);
  download(host, 42);
  EXPECT_TRUE(host.write(kWindow, kCreateMp7));
  EXPECT_TRUE(host.write(kWindow, set_var1(43)));
  EXPECT_EQ(daemon->ctl({"power", "cell", "off"}).exit_code, 0);
  EXPECT_TRUE(host.in_vain([](ModbusHost& asked) { return asked.read_input(kRsmState); }).empty())
      << "a controller without power is silent";
  EXPECT_EQ(daemon->ctl({"power", "cell", "on"}).exit_code, 0);
  EXPECT_TRUE(eventually([&] { return host.read_input(kRsmState) == Registers{0}; }));
  // It has left the download: a macro line is refused, a command is accepted.
  EXPECT_FALSE(host.write(kWindow, set_var1(43)));
  EXPECT_EQ(host.error(), EMBXILVAL);
  EXPECT_TRUE(host.write(kWindow, Registers{0x0A48, 1, 0, 2000}));
  expect_mp7_sets(host, 42);
  EXPECT_EQ(daemon->errors(), "");
}

}  // namespace rs_m8194h_memory_test
}  // namespace understudy::acceptance
