// The FIFO: its capacity, what bypasses it, what holds it (2.2, 3.2.2, 4.10, 9.9).
#include <gtest/gtest.h>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace fifo_test {

/// X runs without an end, and the FIFO waits for it.
struct BlockedRsm : OneRsm {
  BlockedRsm() { send({"RSM_CONTINUE_MOVE X 1000", "RSM_STOP_WAIT X"}); }
};

TEST(RsM8194hFifo, HasThirtyBlocksAndIsBusyWhenFull) {
  BlockedRsm rsm;
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 30);
  for (int free = 29; free >= 0; --free) {
    rsm.send("RSM_SET_V Y 1000");
    EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), free);
  }
  EXPECT_EQ(rsm.exception("RSM_SET_V Y 1000"), 6);
  EXPECT_EQ(rsm.get("IllegalFuncErr"), 0xC1);
  // Commands that act at once take no block, and are never refused as busy.
  rsm.send({"RSM_STOP_SUDDENLY X"});
  rsm.run(10);
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 30);
}

struct Cost {
  const char* command;
  int blocks;
};
constexpr Cost kCosts[] = {
    {"RSM_ARC_CW -5000 -5000 -10000 -10000", 2},
    {"RSM_ABS_ARC_CCW -5000 -5000 -10000 -10000", 2},
    {"RSM_LINE_2D_INITIAL X Y 300 18000 500000", 2},
    {"RSM_LINE_2D_CONTINUE 0 100 100", 1},
    {"RSM_HELIX_3D Y Z U 1 50000 0 25000 50 3600", 3},
    {"RSM_RECTANGLE X Y 1 0 0 20000 10000 1000 1000 10000 5000 5000", 4},
    {"RSM_SYNC_ACTION U U 64 0 2 4 0 0 0 0 0 0", 2},
};

TEST(RsM8194hFifo, CommandsTakeTheBlocksThatTheManualMarks) {
  for (const Cost& row : kCosts) {
    BlockedRsm rsm;
    rsm.send(row.command);
    EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 30 - row.blocks) << row.command;
    for (int i = 30 - row.blocks; i >= row.blocks; --i) rsm.send("RSM_SET_V Y 1000");
    EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), row.blocks - 1);
    EXPECT_EQ(rsm.exception(row.command), 6) << row.command;
    EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), row.blocks - 1);
  }
}

TEST(RsM8194hFifo, WritesOfCountersQueueLikeTheirCommands) {
  BlockedRsm rsm;
  EXPECT_EQ(rsm.ask("10 00 5A 00 08 10 00 00 27 10 00 00 27 10 00 00 27 10 00 00 27 10"), "10 00 5A 00 08");
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 26);
  EXPECT_EQ(rsm.get("LP_Y"), 0);
  for (int i = 0; i < 23; ++i) rsm.send("RSM_SET_V Y 1000");
  // Three are free: four counters are refused as a whole.
  EXPECT_EQ(rsm.ask("10 00 5A 00 08 10 00 00 27 10 00 00 27 10 00 00 27 10 00 00 27 10"), "90 06");
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 3);
  rsm.set("VAR5", 77);  // overtakes
  EXPECT_EQ(rsm.get("VAR5"), 77);
  rsm.send("RSM_STOP_SUDDENLY X");
  rsm.run(10);
  EXPECT_EQ(rsm.get("LP_Y"), 10000);
}

TEST(RsM8194hFifo, ADriveWaitsForItsAxisAndSettingsBehindItWait) {
  OneRsm rsm;
  rsm.send({"RSM_SET_V X 1000", "RSM_SET_SV X 1000", "RSM_FIXED_MOVE X 100", "RSM_FIXED_MOVE X -50",
            "RSM_SET_LP Y 5"});
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 28);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 1);
  rsm.run(101);
  EXPECT_EQ(rsm.get("LP_X"), 100);
  EXPECT_EQ(rsm.get("LP_Y"), 5);
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_X"), 50);
}

TEST(RsM8194hFifo, EightCommandsAtMostBeginInATick) {
  BlockedRsm rsm;
  for (int i = 1; i <= 20; ++i) rsm.send("RSM_SET_LP Y " + std::to_string(i));
  rsm.send("RSM_STOP_SUDDENLY X");
  rsm.run(1);
  EXPECT_EQ(rsm.get("LP_Y"), 8);
  rsm.run(1);
  EXPECT_EQ(rsm.get("LP_Y"), 16);
  rsm.run(1);
  EXPECT_EQ(rsm.get("LP_Y"), 20);
}

TEST(RsM8194hFifo, ClearCardBufferEmptiesItAndWaitsContinue) {
  BlockedRsm rsm;
  rsm.send({"RSM_SET_LP Y 5", "RSM_SET_LP Z 5", "RSM_CLEAR_CARD_BUFFER", "RSM_SET_LP U 5"});
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 29);
  rsm.run(5);
  EXPECT_EQ(rsm.get("LP_U"), 0);
  rsm.send("RSM_STOP_SUDDENLY X");
  rsm.run(2);
  EXPECT_EQ(rsm.positions()[3], 5);
  EXPECT_EQ(rsm.positions()[1], 0);
}

TEST(RsM8194hFifo, ACommandOfOneRegisterMayComeByFunction6) {
  BlockedRsm rsm;
  rsm.send("RSM_SET_LP Y 5");
  EXPECT_EQ(rsm.ask("06 1F 40 0A 0B"), "06 1F 40 0A 0B");  // CLEAR_CARD_BUFFER
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 30);
}

TEST(RsM8194hFifo, EmergencyStopEmptiesAFullOne) {
  BlockedRsm rsm;
  for (int i = 0; i < 30; ++i) rsm.send("RSM_SET_V Y 1000");
  rsm.send("RSM_EMERGENCY_STOP 0");
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 30);
  EXPECT_EQ(rsm.get("EMERGENCY_STOP"), 1);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  for (const char* name : {"ERROR_CODE_X", "ERROR_CODE_Y", "ERROR_CODE_Z", "ERROR_CODE_U"}) {
    EXPECT_EQ(rsm.get(name), 0x200);
  }
  EXPECT_EQ(rsm.get("ERROR_STATE"), 1);
  rsm.send({"RSM_CLEAR_EMERGENCY_STOP"});
  EXPECT_EQ(rsm.get("EMERGENCY_STOP"), 0);
  EXPECT_EQ(rsm.get("ERROR_STATE"), 0);
}

}  // namespace fifo_test
}  // namespace understudy::emulator::models::rs_m8194h
