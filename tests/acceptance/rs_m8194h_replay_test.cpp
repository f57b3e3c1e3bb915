// A day of an RS-M8194H is recorded in the middle of its work and replayed: by the same program, on a
// processor without fused multiplication, and by another build. One power cut comes during a download,
// another during homing and a stream.
#include <gtest/gtest.h>
#include <signal.h>

#include <cstdlib>

#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace rs_m8194h_replay_test {

constexpr int kVar1 = 302;
constexpr int kCallMp = 8;
constexpr int kLpX = 90;
constexpr int kWindow = 8000;
constexpr int kHomeStateZ = 94;  // input registers
constexpr int kModuleState = 101;
constexpr std::uint16_t kInStep1 = 3;
constexpr std::uint16_t kInAnIsr = 7;

constexpr const char* kBench = R"(understudy: 1
lines:
  com: { baud: 115200, link: com.port, timing: instant, stations: [ { device: cell, address: 1 } ] }
devices:
  cell:
    model: rs-m8194h
    set: { FRNET_EVENT: 1 }
    program: |
      MP 41
        RSM_MACRO_FOR 200
          RSM_MACRO_VAR_CALCULATE VAR1 + 1 VAR1
          RSM_MACRO_TIMER 7
        RSM_MACRO_NEXT
      END
      ISR 1
        RSM_MACRO_VAR_CALCULATE VAR2 + 1 VAR2
        RSM_MACRO_FIXED_MOVE U 333
        RSM_MACRO_FRNET_WAIT 9 0 1 0
      END
      TRIGGER 8.0 off_to_on MP41
plant:
  cell.Z:
    home: { at: 3000, width: 400 }
    limits: { lower: -7000, upper: 900000 }
)";

class RsM8194hReplay : public testing::Test {
 protected:
  RsM8194hReplay() {
    const auto daemon = RunningUnderstudy::of_bench(kBench, {"--record", recording_});
    ModbusHost host(daemon->port(), {.baud = 115200, .parity = 'N'});
    const auto poll = [&](int times) {
      for (int i = 0; i < times; ++i) {
        EXPECT_EQ(host.read(kLpX - 8, 40).size(), 40U);
        EXPECT_EQ(host.read_input(88, 9).size(), 9U);
      }
    };
    const auto expect_done = [&](const Words& words) {
      const Finished finished = daemon->ctl(words);
      EXPECT_EQ(finished.exit_code, 0) << finished.errors;
    };
    const auto send = [&](const Registers& words) {
      EXPECT_TRUE(host.write(kWindow, words))
          << std::hex << words[0] << ": " << modbus_strerror(host.error());
    };
    // Speeds, homing of Z, a stream of X and Y, an ISR at the end of U's move, and MP 41 through an input.
    const auto begin = [&] {
      send({0x0A48, 15, 0, 8000});          // V
      send({0x0A47, 15, 0, 1000});          // SV
      send({0x0A49, 15, 0, 20000});         // A
      send({0x0A3C, 4, 0, 500});            // HV
      send({0x0A3E, 4, 1, 1, 0, 0, 0, 0});  // HOME_MODE
      send({0x0A3F, 4});                    // HOME_START
      send({0x0A82, 1, 2, 1, 0, 1000, 0, 5000, 0, 50000});
      send({0x0A84, 0, 1, 0, 0, 0, 0, 0, 3000, 0, 0});
      send({0x0A84, 0, 3, 0, 0, 0, 500, 0, 0, 0, 1000});
      send({0x0AAA});             // ENABLE_INT
      send({0x0AAC, 8, 7, 1});    // D-END of U calls ISR 1
      send({0x0A4E, 8, 0, 200});  // FIXED_MOVE
      poll(10);
      expect_done({"input", "DI_8_0=1"});
      poll(20);
      expect_done({"input", "DI_8_0=0"});
    };
    begin();
    EXPECT_TRUE(host.write(kVar1, Registers{0, 5}));
    // The power cut comes during an ISR and during homing.
    EXPECT_TRUE(eventually([&] { return host.read_input(kModuleState, 1) == Registers{kInAnIsr}; }));
    EXPECT_EQ(host.read_input(kHomeStateZ, 1), Registers{kInStep1});
    expect_done({"power", "cell", "cycle"});
    // A download that a power cut ends, and one that succeeds.
    send({0x0AC9, 42});
    send({0x0CD2, 0x7FFF, 9, 0, 3});
    expect_done({"power", "cell", "cycle"});
    begin();
    send({0x0AE2});
    send({0x0AC9, 42});
    send({0x0CD2, 0x7FFF, 9, 0, 3});
    send({0x0CCA});
    EXPECT_TRUE(host.write(kCallMp, 42));
    poll(30);
    expect_done({"power", "cell", "cycle"});
    poll(5);
    EXPECT_EQ(daemon->errors(), "");
    EXPECT_EQ(daemon->stop(SIGTERM), 0);
  }

  void expect_same(const std::string& program, const Environment& environment = {}) const {
    const Finished finished = run({program, "replay", recording_}, environment);
    EXPECT_EQ(finished.exit_code, 0) << finished.errors;
    EXPECT_NE(finished.output.find(": the same: "), std::string::npos) << finished.output;
  }

  PrivateFolder folder_;
  std::string recording_ = folder_ / "day.jsonl";
};

TEST_F(RsM8194hReplay, IsTheSame) { expect_same(UNDERSTUDY_BINARY); }

TEST_F(RsM8194hReplay, IsTheSameWithoutFusedMultiplication) {
  expect_same(UNDERSTUDY_BINARY, {{"GLIBC_TUNABLES", "glibc.cpu.hwcaps=-FMA,-AVX2"}});
}

TEST_F(RsM8194hReplay, IsTheSameInAnotherBuild) {
  const char* const other = std::getenv("UNDERSTUDY_OTHER_BINARY");
  if (other == nullptr || *other == '\0') {
    GTEST_SKIP() << "UNDERSTUDY_OTHER_BINARY names no program of another build type";
  }
  expect_same(other);
}

}  // namespace rs_m8194h_replay_test
}  // namespace understudy::acceptance
