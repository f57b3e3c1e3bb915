// A day of a SUPER-40NC is recorded in the middle of its work and replayed: by the same program, on a
// processor without fused multiplication, and by another build.
#include <gtest/gtest.h>
#include <signal.h>

#include <cstdlib>

#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace super40nc_replay_test {

constexpr int kM0 = 1000;
constexpr int kM8000 = 2000;
constexpr int kD0 = 0;
constexpr int kD500 = 1000;
constexpr int kD9001 = 9002;
constexpr int kD9002 = 9004;

constexpr const char* kBench = R"(understudy: 1
lines:
  rs232: { link: panel.port, timing: instant, stations: [ { device: mill, port: RS232 } ] }
  rs485: { link: pc.port, timing: instant, stations: [ { device: mill, port: RS485 } ] }
devices:
  mill:
    model: super-40nc
    set: { D9003: 2, D9390: 200 }
    program: |
      AREA C
      F K30000
      XYP
      LIN K2000 K1000
      LAB K1
      CCW K4000 K1000 K1000
      CW * * K500 K-700
      TMR K33
      LIN K2000 K1000
      JMP K1
      END
      FILE 3
      F K10000
      LIN K500
      END
      AREA Z
      HOM K1
      RPM K200
      DRV K4000
      MRK K5000
      INC D500
      END
      AREA U
      LAB K1
      VDRV K150
      TMR K70
      VDRV K-60
      JMP K1
      END
      AREA PLC
      LD M8003
      OUT T60 K300
      LDP T60
      INC D0
      LD M1
      PJG * * K1
      END
plant:
  mill.Z:
    home: { at: 3000, width: 2000 }
    limits: { lower: -7000, upper: 9000 }
    encoder: { per_revolution: 4000, index: { at: 0 } }
)";

class Super40ncReplay : public testing::Test {
 protected:
  Super40ncReplay() {
    const auto daemon = RunningUnderstudy::of_bench(kBench, {"--record", recording_});
    ModbusHost panel(daemon->ports().at(0).link, {.station = 0});
    ModbusHost pc(daemon->ports().at(1).link, {.station = 0});
    const auto poll = [&](int times) {
      for (int i = 0; i < times; ++i) {
        EXPECT_EQ(panel.read(7234, 120).size(), 120U);  // positions, and the registers of the chip
        EXPECT_EQ(panel.read_coils(kM8000, 400).size(), 400U);
      }
    };
    const auto expect_done = [&](const Words& words) {
      const Finished finished = daemon->ctl(words);
      EXPECT_EQ(finished.exit_code, 0) << finished.errors;
    };
    EXPECT_TRUE(pc.write_coils(kM8000, Bits{1}));
    for (const int program : {3, 4}) EXPECT_TRUE(pc.write_bit(kM8000 + 100 * program, true));
    poll(20);
    expect_done({"turn", "mill.MPG=40", "in=200ms"});
    expect_done({"input", "X12=1"});
    EXPECT_TRUE(pc.write_bit(kM8000 + 6, true));  // M8006 holds the arc
    poll(20);
    EXPECT_TRUE(pc.write(kD9002, Registers{7, 0}));
    EXPECT_TRUE(pc.write(kD500, Registers{11, 0}));
    EXPECT_TRUE(pc.write_bit(kM8000, true));
    poll(20);
    EXPECT_TRUE(pc.write(kD9001, Registers{3, 0}));
    EXPECT_TRUE(pc.write_bit(kM0 + 1, true));
    poll(20);
    expect_done({"power", "mill", "cycle"});
    poll(5);
    EXPECT_TRUE(pc.write_bit(kM8000, true));
    expect_done({"program", "mill", folder_.write("other.lst", "AREA X\nTMR K5\nEND\n")});
    poll(20);
    EXPECT_GT(pc.read_long(kD0) + pc.read(kD9001)[0], 0);
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

TEST_F(Super40ncReplay, IsTheSame) { expect_same(UNDERSTUDY_BINARY); }

TEST_F(Super40ncReplay, IsTheSameWithoutFusedMultiplication) {
  expect_same(UNDERSTUDY_BINARY, {{"GLIBC_TUNABLES", "glibc.cpu.hwcaps=-FMA,-AVX2"}});
  expect_same(UNDERSTUDY_BINARY, {{"GLIBC_TUNABLES", "glibc.cpu.hwcaps=-FMA,-AVX2,-AVX,-FMA4,-AVX512F"}});
}

TEST_F(Super40ncReplay, IsTheSameInAnotherBuild) {
  const char* const other = std::getenv("UNDERSTUDY_OTHER_BINARY");
  if (other == nullptr || *other == '\0') {
    GTEST_SKIP() << "UNDERSTUDY_OTHER_BINARY names no program of another build type";
  }
  expect_same(other);
}

}  // namespace super40nc_replay_test
}  // namespace understudy::acceptance
