// Where choices meet what else the device does: most of them are told apart by scenarios/choices/rs-m8194h/.
#include <gtest/gtest.h>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace rs_m8194h_choices_test {

/// X moves without end; a drive, commands of two blocks and a stop wait for it.
void fill(OneRsm& rsm, int pairs) {
  rsm.send({"RSM_SET_V X 1000", "RSM_CONTINUE_MOVE X 1000"});
  rsm.run(10);
  rsm.send("RSM_FIXED_MOVE X 1");
  for (int i = 0; i < pairs; ++i) rsm.send("RSM_LINE_2D_INITIAL X Y 100 1000 10000");
}

TEST(RsM8194hChoices, AFifoOfOneBlockEachIsFilledAndRestored) {
  const GivenRsm given{.choices = {{"fifo_cost", "one_each"}, {"stops_bypass_fifo", "wait_like_others"}}};
  OneRsm rsm(given);
  fill(rsm, 28);
  rsm.send("RSM_STOP_SUDDENLY X");
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 0);
  EXPECT_EQ(rsm.exception("RSM_STOP_SUDDENLY X"), 6);
  EXPECT_EQ(rsm.get("IllegalFuncErr"), 0xC1);
  OneRsm twin(given);
  twin.device().restore_state(rsm.device().save_state());
  EXPECT_TRUE(twin.device().same_state(rsm.device()));
  EXPECT_EQ(twin.get("FREE_BUFFER_SIZE"), 0);
  EXPECT_EQ(twin.get("DRIVING_AXIS"), 1);
}

TEST(RsM8194hChoices, AFifoFilledAsMarkedHoldsHalfAsMany) {
  OneRsm rsm;
  fill(rsm, 14);
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 1);
  EXPECT_EQ(rsm.exception("RSM_LINE_2D_INITIAL X Y 100 1000 10000"), 6);
  rsm.send("RSM_STOP_SUDDENLY X");
  rsm.run(10);
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 30);
}

TEST(RsM8194hChoices, AStopThatWaitsIsCarriedOutInItsTurn) {
  OneRsm rsm({.choices = {{"stops_bypass_fifo", "wait_like_others"}}});
  rsm.send({"RSM_SET_SV X 1000", "RSM_SET_V X 1000", "RSM_FIXED_MOVE X 100", "RSM_FIXED_MOVE X 100",
            "RSM_STOP_SUDDENLY X", "RSM_FIXED_MOVE X 100"});
  rsm.run_to_rest();
  // The second drive has just begun when it is stopped; the third one finds X locked.
  EXPECT_EQ(rsm.get("LP_X"), 100);
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0x100);
}

TEST(RsM8194hChoices, AHeldFifoGoesOnBehindADownload) {
  OneRsm rsm({.choices = {{"fifo_during_download", "held"}}});
  rsm.send({"RSM_SET_SV X 1000", "RSM_SET_V X 1000", "RSM_FIXED_MOVE X 100", "RSM_FIXED_MOVE X 100",
            "RSM_MP_CREATE 1"});
  rsm.run(1000);
  EXPECT_EQ(rsm.get("LP_X"), 100);
  EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), 29);
  OneRsm twin({.choices = {{"fifo_during_download", "held"}}});
  twin.device().restore_state(rsm.device().save_state());
  twin.send({"RSM_MACRO_SET_V X 1", "RSM_MACRO_MP_CLOSE"});
  twin.run(200);
  EXPECT_EQ(twin.get("LP_X"), 200);
  EXPECT_EQ(twin.get("FREE_BUFFER_SIZE"), 30);
}

TEST(RsM8194hChoices, AnEmergencyInputCanBeActiveWhileOpen) {
  OneRsm rsm({.choices = {{"emg_level", "while_off"}}});
  rsm.send({"RSM_SET_SV X 1000", "RSM_SET_V X 1000", "RSM_FIXED_MOVE X 100"});
  rsm.run(10);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0x20);
  EXPECT_EQ(rsm.get("DI_ALL_X") & 8, 8);
  rsm.input(kEmergencyPin, true);
  rsm.run(5);
  rsm.send("RSM_FIXED_MOVE X 100");
  rsm.run(50);
  EXPECT_GT(rsm.get("LP_X"), 0);
  const Value before = rsm.get("LP_X");
  rsm.input(kEmergencyPin, false);
  rsm.run(200);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  EXPECT_LT(rsm.get("LP_X"), before + 5);
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0x20);
}

}  // namespace rs_m8194h_choices_test
}  // namespace understudy::emulator::models::rs_m8194h
