// Pending work of a motion, with every event that may discard it: every cell of the table in transitions.h.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "emulator/models/rs_m8194h/drives/transitions.h"
#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace marks_test {

constexpr int kPauseInput = kFirstDi;
constexpr int kHoldInput = kFirstDi + 1;

/// Axis X with one of the marks on it.
struct MarkedRsm : OneRsm {
  explicit MarkedRsm(Mark which)
      : OneRsm({.program = "TRIGGER 8.0 off_to_on pause\nTRIGGER 8.1 on hold X\n",
                .choices = {{"trigger_pause", "and_holds_all_axes"}, {"holds_bypass_fifo", "at_once"}}}),
        mark(which) {
    send({"RSM_SET_MAX_V XYZU 8000", "RSM_SET_V XYZU 1000", "RSM_SET_SV XYZU 1000", "RSM_SET_ALARM X 1 0",
          "RSM_AXIS_ASSIGN X Y 0"});
    set("FRNET_EVENT", 1);
    run(5);
    if (mark == Mark::paused_drive) {
      send("RSM_FIXED_MOVE X 5000");
      run(50);
      input(kPauseInput, true);
    } else if (mark == Mark::external_drive) {
      send("RSM_EXD_FP X 5000");
      pin(0, Pin::external_plus, true);
    } else {
      input(kHoldInput, true);
    }
    run(20);
  }
  bool is_present() const {
    const AxisUnit& unit = state().units[0];
    if (mark == Mark::paused_drive) return unit.paused_drive.what != Drive::What::none;
    if (mark == Mark::external_drive) {
      return unit.external.running != 0 || unit.external_waiting != 0 || unit.external_free_ns != 0;
    }
    return (state().trigger_holds[1] & 1U) != 0;
  }
  Mark mark;
};

struct Event {
  DiscardEvent event;
  std::function<void(MarkedRsm&)> happen;
};

const std::vector<Event>& events() {
  static const std::vector<Event> all{
      {DiscardEvent::stop, [](MarkedRsm& rsm) { rsm.send("RSM_STOP_SLOWLY X"); }},
      {DiscardEvent::stop, [](MarkedRsm& rsm) { rsm.send("RSM_STOP_SUDDENLY X"); }},
      {DiscardEvent::path_stop, [](MarkedRsm& rsm) { rsm.send("RSM_VSTOP_SLOWLY"); }},
      {DiscardEvent::path_stop, [](MarkedRsm& rsm) { rsm.send("RSM_VSTOP_SUDDENLY"); }},
      {DiscardEvent::emergency_stop, [](MarkedRsm& rsm) { rsm.send("RSM_EMERGENCY_STOP 0"); }},
      {DiscardEvent::emergency_stop, [](MarkedRsm& rsm) { rsm.send("RSM_EMERGENCY_STOP 1"); }},
      {DiscardEvent::cause,
       [](MarkedRsm& rsm) {
         rsm.pin(0, Pin::alarm, true);
         rsm.run(3);
         rsm.pin(0, Pin::alarm, false);
       }},
      {DiscardEvent::cause,
       [](MarkedRsm& rsm) {
         rsm.pin(0, Pin::limit_plus, true);
         rsm.run(3);
         rsm.pin(0, Pin::limit_plus, false);
       }},
      {DiscardEvent::cause,
       [](MarkedRsm& rsm) {
         rsm.input(kEmergencyPin, true);
         rsm.run(3);
         rsm.input(kEmergencyPin, false);
       }},
      {DiscardEvent::other_drive,
       [](MarkedRsm& rsm) {
         if (rsm.mark == Mark::external_drive) return rsm.send("RSM_SET_PULSE X 6000");
         // By a mark of another axis, because commands wait in the FIFO meanwhile.
         auto& sync = const_cast<State&>(rsm.state()).sync;
         sync.triggers[3] = {.factors = motion::bit(motion::Event::mark_on), .activates = 1};
         sync.actions[0].drive = motion::SyncAction::Drive::endless_minus;
         rsm.pin(3, Pin::in3, true);
         rsm.run(2);
         rsm.pin(3, Pin::in3, false);
       }},
      {DiscardEvent::release, [](MarkedRsm& rsm) { rsm.send("RSM_DRV_START X"); }},
      {DiscardEvent::triggers_off, [](MarkedRsm& rsm) { rsm.set("FRNET_EVENT", 0); }},
  };
  return all;
}

TEST(RsM8194hMarks, AreTakenOffAsTheTableSays) {
  for (std::size_t m = 0; m < kMarks; ++m) {
    const auto mark = static_cast<Mark>(m);
    std::array<bool, kDiscardEvents> is_tried{};
    for (const Event& event : events()) {
      SCOPED_TRACE(std::to_string(m) + ", " + std::to_string(&event - events().data()));
      MarkedRsm rsm(mark);
      ASSERT_TRUE(rsm.is_present());
      event.happen(rsm);
      rsm.run(3);
      EXPECT_EQ(rsm.is_present(), !takes_off(event.event, mark));
      is_tried[static_cast<std::size_t>(event.event)] = true;
    }
    for (const bool tried : is_tried) EXPECT_TRUE(tried);
    for (const bool is_power : {true, false}) {
      MarkedRsm rsm(mark);
      if (is_power) rsm.world().switch_power(0, false);
      if (!is_power) rsm.send("RSM_RESET_CARD");
      EXPECT_FALSE(rsm.is_present());
    }
  }
}

TEST(RsM8194hMarks, ATriggerLeavesTheHoldOfAHostAlone) {
  OneRsm rsm({.program = "TRIGGER 8.1 on hold X\n"});
  rsm.set("FRNET_EVENT", 1);
  rsm.input(kHoldInput, true);
  rsm.run(5);
  rsm.send({"RSM_DRV_START X", "RSM_DRV_HOLD X", "RSM_FIXED_MOVE X 100"});
  rsm.input(kHoldInput, false);
  rsm.run(1000);
  EXPECT_EQ(rsm.get("LP_X"), 0);
  rsm.send("RSM_DRV_START X");
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_X"), 100);
}

TEST(RsM8194hMarks, AnAlarmInAPauseIsTheEndOfWhatItHolds) {
  MarkedRsm rsm(Mark::paused_drive);
  rsm.run(500);
  const Value at = rsm.get("LP_X");
  rsm.pin(0, Pin::alarm, true);
  rsm.run(3);
  rsm.pin(0, Pin::alarm, false);
  rsm.run(3);
  rsm.send("RSM_MP_TERMINATE");  // the pause is over
  rsm.run(6000);
  EXPECT_EQ(rsm.get("LP_X"), at);
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 16);
}

}  // namespace marks_test
}  // namespace understudy::emulator::models::rs_m8194h
