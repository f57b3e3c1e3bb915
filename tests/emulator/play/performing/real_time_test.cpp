// What a scenario in real time receives and observes: the host's replies, and when a write was executed.
#include "emulator/play/executors/real_executor.h"
#include "emulator/play/executors/write_clock.h"
#include "tests/emulator/play/performing/played.h"

namespace understudy::emulator::play {
namespace real_time_test {

ScenarioResult played_in_real_time(const std::string& steps) {
  RunOptions options;
  options.make_executor = make_real_executor;
  return played(steps, "", options);
}

TEST(RealTime, BringsWhatIsReadAndWhatIsRefused) {
  const std::string write = "  - write: { feeder.Aaxis_Pulse: -70000, feeder.Aaxis_Speed: 200 }\n";
  const ScenarioResult good = played_in_real_time(
      write + "  - expect: { feeder.Aaxis_Pulse: -70000, feeder.Aaxis_Speed: 200, feeder.HW_Code: 49153 }\n" +
      "  - write: { feeder.Aaxis_Speed: 65535 }\n    exception: 3\n");
  EXPECT_TRUE(has_passed(good)) << why(good);
  const ScenarioResult bad = played_in_real_time(write + "  - expect: { feeder.Aaxis_Speed: 201 }\n");
  ASSERT_TRUE(bad.failure);
  EXPECT_EQ(bad.failure->what, "feeder.Aaxis_Speed is 200; expected 201");
}

TEST(RealTime, SaysWhichBytesCameInsteadOfAReply) {
  const ScenarioResult bad = played_in_real_time(
      "  - inject: { corrupt_checksum: feeder, nth: 2 }\n"
      "  - write: { feeder.Aaxis_Speed: 60 }\n  - expect: { feeder.HW_Code: 49153 }\n");
  ASSERT_TRUE(bad.failure);
  // The manual's frame, with the last byte inverted.
  EXPECT_EQ(bad.failure->what,
            "read feeder.HW_Code: an unexpected reply: 01 03 02 C0 01 29 7B; expected success");
}

/// When the clock reports that the last write was executed, once its frame is complete and answered.
class WriteClockTest : public testing::Test {
 protected:
  Tick after(const std::vector<std::uint8_t>& frame) {
    world_.receive(0, frame);
    world_.advance_to(world_.now() + std::chrono::milliseconds(50));
    world_.take_output(0, world_.line(0).line.output().size());
    return clock_.tick_of_last_write();
  }
  world::World world_{scenario_of("  - advance: 1ms\n").bench, {}, {}};
  WriteClock clock_{world_};
};

TEST_F(WriteClockTest, ReportsTheTickThatAWriteActsFrom) {
  EXPECT_EQ(clock_.tick_of_last_write(), 0);
  // Aaxis_Speed = 200 at 0: 8 characters of 11 bits at 19200 baud (4.58 ms) and 750 us of silence.
  EXPECT_EQ(after({0x01, 0x06, 0x10, 0x02, 0x00, 0xC8, 0x2D, 0x5C}), 6);
  // Reads, writes to another device, and refused writes (HW_Code) do not count.
  EXPECT_EQ(after({0x01, 0x03, 0x00, 0x01, 0x00, 0x01, 0xD5, 0xCA}), 6);
  EXPECT_EQ(after({0x02, 0x06, 0x10, 0x02, 0x00, 0xC8, 0x2D, 0x6F}), 6);
  EXPECT_EQ(after({0x01, 0x06, 0x00, 0x01, 0x00, 0x01, 0x19, 0xCA}), 6);
  // The next one, at 200 ms, does.
  EXPECT_EQ(after({0x01, 0x06, 0x10, 0x02, 0x00, 0xC8, 0x2D, 0x5C}), 206);
}

}  // namespace real_time_test
}  // namespace understudy::emulator::play
