// Stops while a macro waits, while an ISR waits above a suspended macro, and while a stream expects more
// segments (7.5, 5.9): event by event, as data.
#include <gtest/gtest.h>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace stops_in_the_midst_test {

enum class Midst : std::uint8_t { macro, isr, stream };

/// X runs without an end in the first two; Y's move has triggered the ISR of the second.
const char* const kPrograms = R"(
MP 1
  RSM_MACRO_FIXED_MOVE X 1000000
  RSM_MACRO_FIXED_MOVE X 100
  RSM_MACRO_SET_VAR VAR1 1
END
MP 2
  RSM_MACRO_FIXED_MOVE X 1000000
  RSM_MACRO_FIXED_MOVE Y 10
  RSM_MACRO_TIMER 500
  RSM_MACRO_SET_VAR VAR1 1
END
ISR 1
  RSM_MACRO_FRNET_WAIT 8 0 1 0
  RSM_MACRO_SET_VAR VAR2 1
END
)";

struct MidstRsm : OneRsm {
  explicit MidstRsm(Midst midst) : OneRsm({.program = kPrograms}) {
    send({"RSM_SET_SV XY 1000", "RSM_SET_V XY 10000", "RSM_SET_A XY 20000", "RSM_AXIS_ASSIGN X Y 0"});
    run(3);
    switch (midst) {
      case Midst::macro: set("CALL_MP", 1); break;
      case Midst::isr:
        send({"RSM_ENABLE_INT", "RSM_INTFACTOR_ENABLE Y 7 1"});
        set("CALL_MP", 2);
        break;
      case Midst::stream:
        send("RSM_LINE_2D_INITIAL X Y 10000 10000 20000");
        for (int i = 0; i < 5; ++i) send("RSM_LINE_2D_CONTINUE 0 2000 0");
        break;
    }
    run(100);
  }
};

struct Left {
  bool mp = false;  // still running
  bool isr = false;
  bool moves = false;  // X, three seconds later
  bool locked = false;
  bool path_locked = false;
  bool emergency = false;
  int error_x = 0;
  int error_y = 0;
  int free = 30;
  int var1 = 0;
  int var2 = 0;
};

struct Case {
  Midst midst;
  const char* event;  // a command; or +NAME: an input comes on
  Left left;
};
constexpr int kStop = 0x100;
constexpr int kEmergency = 0x200;
const Case kCases[] = {
    // The drive that the macro waits for is void, and the macro continues after it.
    {Midst::macro, "RSM_STOP_SLOWLY X", {.locked = true, .error_x = kStop, .var1 = 1}},
    {Midst::macro, "RSM_STOP_SUDDENLY X", {.locked = true, .error_x = kStop, .var1 = 1}},
    {Midst::macro,
     "RSM_VSTOP_SLOWLY",
     {.moves = true, .path_locked = true, .error_x = kStop, .error_y = kStop, .var1 = 1}},
    {Midst::macro,
     "RSM_VSTOP_SUDDENLY",
     {.moves = true, .path_locked = true, .error_x = kStop, .error_y = kStop, .var1 = 1}},
    {Midst::macro,
     "RSM_EMERGENCY_STOP 0",
     {.emergency = true, .error_x = kEmergency, .error_y = kEmergency, .var1 = 1}},
    {Midst::macro,
     "RSM_EMERGENCY_STOP 1",
     {.emergency = true, .error_x = kEmergency, .error_y = kEmergency, .var1 = 1}},
    {Midst::macro, "RSM_MP_TERMINATE", {.moves = true}},
    {Midst::macro, "RSM_CLEAR_CARD_BUFFER", {.mp = true, .moves = true}},
    {Midst::macro, "RSM_RESET_CARD", {}},
    // In order after the macro.
    {Midst::macro, "RSM_DRV_HOLD X", {.mp = true, .moves = true, .free = 29}},
    {Midst::macro, "RSM_CLEAR_STOP X", {.mp = true, .moves = true, .free = 29}},
    {Midst::macro, "RSM_FIXED_MOVE Y 100", {.mp = true, .moves = true, .free = 29}},
    {Midst::macro, "+LMTP_X", {.error_x = 4, .var1 = 1}},  // stopped, and the next drive ends at once
    {Midst::macro, "+EMG", {.error_x = 0x20, .var1 = 1}},

    {Midst::isr, "RSM_STOP_SLOWLY X", {.mp = true, .isr = true, .locked = true, .error_x = kStop}},
    {Midst::isr, "RSM_STOP_SUDDENLY X", {.mp = true, .isr = true, .locked = true, .error_x = kStop}},
    {Midst::isr,
     "RSM_VSTOP_SUDDENLY",
     {.mp = true, .isr = true, .moves = true, .path_locked = true, .error_x = kStop, .error_y = kStop}},
    {Midst::isr,
     "RSM_EMERGENCY_STOP 0",
     {.mp = true, .isr = true, .emergency = true, .error_x = kEmergency, .error_y = kEmergency}},
    {Midst::isr, "RSM_MP_TERMINATE", {.moves = true}},
    {Midst::isr, "RSM_CLEAR_CARD_BUFFER", {.mp = true, .isr = true, .moves = true}},
    {Midst::isr, "RSM_RESET_CARD", {}},
    {Midst::isr, "RSM_FIXED_MOVE Y 100", {.mp = true, .isr = true, .moves = true, .free = 29}},
    {Midst::isr, "+LMTP_X", {.mp = true, .isr = true, .error_x = 4}},
    // The end of its wait: both run to their ends, and the TIMER has run meanwhile.
    {Midst::isr, "+DI_8_0", {.moves = true, .var1 = 1, .var2 = 1}},

    // Segments that remain in the FIFO are void, one after another.
    {Midst::stream, "RSM_STOP_SLOWLY X", {.locked = true, .error_x = kStop}},
    {Midst::stream, "RSM_STOP_SUDDENLY X", {.locked = true, .error_x = kStop}},
    {Midst::stream, "RSM_VSTOP_SLOWLY", {.path_locked = true, .error_x = kStop, .error_y = kStop}},
    {Midst::stream, "RSM_VSTOP_SUDDENLY", {.path_locked = true, .error_x = kStop, .error_y = kStop}},
    {Midst::stream,
     "RSM_EMERGENCY_STOP 0",
     {.emergency = true, .error_x = kEmergency, .error_y = kEmergency}},
    {Midst::stream,
     "RSM_EMERGENCY_STOP 1",
     {.emergency = true, .error_x = kEmergency, .error_y = kEmergency}},
    {Midst::stream, "RSM_MP_TERMINATE", {}},
    {Midst::stream, "RSM_CLEAR_CARD_BUFFER", {}},
    {Midst::stream, "RSM_RESET_CARD", {}},
    {Midst::stream, "+LMTP_X", {.error_x = 4}},
    {Midst::stream, "+EMG", {.error_x = 0x20, .error_y = 0x20}},
};

TEST(RsM8194hStopsInTheMidst, LeaveWhatTheTableSays) {
  for (const Case& each : kCases) {
    SCOPED_TRACE(std::to_string(static_cast<int>(each.midst)) + " meets " + each.event);
    MidstRsm rsm(each.midst);
    ASSERT_EQ(rsm.get("DRIVING_AXIS") & 1, 1);
    const std::string event = each.event;
    if (event == "+LMTP_X") rsm.pin(0, Pin::limit_plus, true);
    if (event == "+EMG") rsm.input(kEmergencyPin, true);
    if (event == "+DI_8_0") rsm.input(kFirstDi, true);
    if (event[0] != '+') rsm.send(event);
    rsm.run(3000);
    EXPECT_EQ(rsm.state().execution.mp.is_alive(), each.left.mp);
    EXPECT_EQ(!rsm.state().execution.isrs.empty(), each.left.isr);
    EXPECT_EQ((rsm.get("DRIVING_AXIS") & 1) != 0, each.left.moves);
    EXPECT_EQ(rsm.state().units[0].locked, each.left.locked);
    EXPECT_EQ(rsm.state().units[0].path_locked, each.left.path_locked);
    EXPECT_EQ(rsm.get("EMERGENCY_STOP"), each.left.emergency ? 1 : 0);
    EXPECT_EQ(rsm.get("ERROR_CODE_X"), each.left.error_x);
    EXPECT_EQ(rsm.get("ERROR_CODE_Y"), each.left.error_y);
    EXPECT_EQ(rsm.get("FREE_BUFFER_SIZE"), each.left.free);
    EXPECT_EQ(rsm.get("VAR1"), each.left.var1);
    EXPECT_EQ(rsm.get("VAR2"), each.left.var2);
  }
}

struct Place {
  const char* event;
  Value x;
  Value starved;  // RINT bit 3
};
const Place kPlaces[] = {
    {"RSM_MP_TERMINATE", 10000, 1}, {"RSM_CLEAR_CARD_BUFFER", 4000, 1}, {"RSM_RESET_CARD", 0, 0}};

TEST(RsM8194hStopsInTheMidst, OfAStreamLeaveItWhereItsSegmentsEnd) {
  for (const Place& each : kPlaces) {
    MidstRsm rsm(Midst::stream);
    rsm.send(each.event);
    rsm.run(3000);
    EXPECT_EQ(rsm.get("LP_X"), each.x) << each.event;
    EXPECT_EQ(rsm.get("Continuous_Inp_Interrupt"), each.starved) << each.event;
  }
}

}  // namespace stops_in_the_midst_test
}  // namespace understudy::emulator::models::rs_m8194h
