// Moves of single axes: durations by the closed forms of the chip's laws, counters, limits (3, 4, 7.1).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace single_axis_test {

TEST(RsM8194hAxis, ItsSpeedHasTheSignOfItsDirection) {
  OneRsm rsm;
  EXPECT_EQ(rsm.ports().speed_pps(0), 0);
  rsm.send({"RSM_SET_SV XY 2000", "RSM_SET_V XY 2000", "RSM_FIXED_MOVE X -1000", "RSM_FIXED_MOVE Y 1000"});
  rsm.run(10);
  EXPECT_EQ(rsm.ports().speed_pps(0), -2000);
  EXPECT_EQ(rsm.ports().speed_pps(1), 2000);
  rsm.run_to_rest();
  EXPECT_EQ(rsm.ports().speed_pps(0), 0);
}

std::string number(double value) { return std::to_string(static_cast<long long>(value)); }

/// Ticks from the command to the tick in which the move is over.
Tick ticks_of(double seconds) { return static_cast<Tick>(std::ceil(seconds * 1000 - 1e-6)) + 1; }

/// A trapezoid with separate deceleration, and AO pulses at SV.
double trapezoid_s(double distance, double sv, double v, double a, double d, double ao) {
  const double up = (v * v - sv * sv) / (2 * a);
  const double down = (v * v - sv * sv) / (2 * d);
  return (v - sv) / a + (v - sv) / d + (distance - ao - up - down) / v + ao / sv;
}
double s_curve_s(double distance, double sv, double v, double k, double l, double ao) {
  const double up_s = 2 * std::sqrt((v - sv) / k);
  const double down_s = 2 * std::sqrt((v - sv) / l);
  const double ramps = (v + sv) / 2 * (up_s + down_s);
  return up_s + down_s + (distance - ao - ramps) / v + ao / sv;
}

struct Move {
  int mode;
  double distance, sv, v, a, d, ao;  // a and d: K and L if the mode is an S-curve
};
constexpr Move kMoves[] = {
    {0, 20000, 1000, 10000, 20000, 0, 0},      {0, 20000, 1000, 10000, 20000, 0, 8},
    {0, 5000, 500, 2000, 4000, 0, 20},         {2, 20000, 1000, 10000, 20000, 40000, 0},
    {2, 20000, 1000, 10000, 40000, 15000, 30}, {1, 30000, 1000, 10000, 50000, 0, 0},
    {1, 30000, 1000, 10000, 50000, 0, 8},      {3, 40000, 1000, 10000, 50000, 80000, 0},
    {3, 40000, 500, 8000, 60000, 30000, 16},
};

TEST(RsM8194hAxis, MovesTakeTheTimesOfTheClosedForms) {
  for (const Move& move : kMoves) {
    for (const char* axis : {"X", "Y", "Z", "U"}) {
      OneRsm rsm;
      const std::string name(axis);
      const bool is_s = move.mode == 1 || move.mode == 3;
      rsm.send("RSM_NORMAL_SPEED " + name + " " + number(move.mode));
      rsm.send("RSM_SET_SV " + name + " " + number(move.sv));
      rsm.send("RSM_SET_V " + name + " " + number(move.v));
      rsm.send((is_s ? "RSM_SET_K " : "RSM_SET_A ") + name + " " + number(move.a));
      if (move.d > 0) rsm.send((is_s ? "RSM_SET_L " : "RSM_SET_D ") + name + " " + number(move.d));
      rsm.send("RSM_SET_AO " + name + " " + number(move.ao));
      rsm.run(1);
      rsm.send("RSM_FIXED_MOVE " + name + " " + number(move.distance));
      const double d = move.d > 0 ? move.d : move.a;
      const double seconds = is_s ? s_curve_s(move.distance, move.sv, move.v, move.a, d, move.ao)
                                  : trapezoid_s(move.distance, move.sv, move.v, move.a, d, move.ao);
      EXPECT_EQ(rsm.run_to_rest(), ticks_of(seconds))
          << move.mode << " " << move.distance << " AO " << move.ao;
      EXPECT_EQ(rsm.get("LP_" + name), move.distance);
      EXPECT_EQ(rsm.get("EP_" + name), move.distance);
      EXPECT_EQ(rsm.get("ABS_" + name), move.distance);
    }
  }
}

TEST(RsM8194hAxis, TheManualsFirstExampleRunsAtItsConstantSpeed) {
  OneRsm rsm;
  rsm.send({"RSM_SET_MAX_V XYZU 20000", "RSM_NORMAL_SPEED XYZU 0", "RSM_SET_V XYZU 2000",
            "RSM_SET_A XYZU 1000", "RSM_SET_SV XYZU 2000", "RSM_SET_AO XYZU 9"});
  rsm.run(2);
  rsm.send("RSM_FIXED_MOVE XYZU 10000");
  rsm.run(1000);
  for (const char* axis : {"X", "Y", "Z", "U"}) EXPECT_EQ(rsm.get(std::string("CV_") + axis), 2000);
  EXPECT_EQ(rsm.run_to_rest(), 4001);
  EXPECT_EQ(rsm.positions(), (std::vector<Value>{10000, 10000, 10000, 10000}));
}

struct Quantised {
  int max_v;
  int asked;
  int runs_at;
};
/// In whole counts of MAX_V / 8000, at least one; MAX_V itself is 8000 to 4,000,000 (3.4).
constexpr Quantised kQuantised[] = {{8000, 1234, 1234},    {16000, 1235, 1234},   {200000, 1240, 1225},
                                    {200000, 3, 25},       {4000000, 1700, 1500}, {5000, 7999, 7999},
                                    {9000000, 4500, 4500}, {20000, 50000, 20000}, {8000, 0, 1}};

TEST(RsM8194hAxis, SpeedsAreWholeCountsOfTheLastMaxV) {
  for (const Quantised& row : kQuantised) {
    OneRsm rsm;
    // V first: it is stored as sent, and the range is applied when the drive starts.
    rsm.send("RSM_SET_V X " + std::to_string(row.asked));
    rsm.send("RSM_SET_SV X 4000000");
    rsm.send("RSM_SET_MAX_V X " + std::to_string(row.max_v));
    rsm.send("RSM_FIXED_MOVE X 2000000");
    rsm.run(50);
    EXPECT_EQ(rsm.get("CV_X"), row.runs_at) << row.max_v << " " << row.asked;
  }
}

TEST(RsM8194hAxis, CountersAreSetApart) {
  OneRsm rsm;
  rsm.send({"RSM_SET_V X 1000", "RSM_SET_SV X 1000", "RSM_FIXED_MOVE X 100"});
  rsm.run_to_rest();
  rsm.send({"RSM_SET_LP X -7"});
  EXPECT_EQ(rsm.get("LP_X"), -7);
  EXPECT_EQ(rsm.get("ABS_X"), 100);
  EXPECT_EQ(rsm.get("EP_X"), 100);
  rsm.send({"RSM_SET_EP X 2000000000", "RSM_ABS_SET_POSITION X 5000"});
  EXPECT_EQ(rsm.get("EP_X"), 2000000000);
  rsm.send("RSM_ABS_FIXED_MOVE X 4990");
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_X"), -17);
  EXPECT_EQ(rsm.get("ABS_X"), 4990);
}

TEST(RsM8194hAxis, RingsGoRoundAtTheirTop) {
  OneRsm rsm;
  rsm.send({"RSM_SET_V X 1000", "RSM_SET_SV X 1000", "RSM_VRING_ENABLE X 9999", "RSM_SET_LP X 9999",
            "RSM_SET_EP X 9999", "RSM_FIXED_MOVE X 1"});
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_X"), 0);
  EXPECT_EQ(rsm.get("EP_X"), 0);
  EXPECT_EQ(rsm.get("ABS_X"), 1);
  rsm.send("RSM_FIXED_MOVE X -1");
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_X"), 9999);
  EXPECT_EQ(rsm.get("EP_X"), 9999);
}

TEST(RsM8194hAxis, ARingEndsTheSoftLimitsForGood) {
  OneRsm rsm;
  rsm.send({"RSM_SET_V X 1000", "RSM_SET_SV X 1000", "RSM_SET_SLMT X 500 -300 0", "RSM_VRING_ENABLE X 9999",
            "RSM_FIXED_MOVE X 1000"});
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_X"), 1000);
  rsm.send({"RSM_VRING_DISABLE X", "RSM_FIXED_MOVE X 1000"});
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_X"), 2000);
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0);
}

TEST(RsM8194hAxis, SoftLimitsStopAndOnlyTheWayBackIsFree) {
  OneRsm rsm;
  rsm.send({"RSM_SET_V X 1000", "RSM_SET_SV X 1000", "RSM_SET_SLMT X 500 -300 0", "RSM_FIXED_MOVE X 2000"});
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_X"), 501);  // the pulse beyond it triggers
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 1);
  rsm.send("RSM_FIXED_MOVE X 10");
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_X"), 501);
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 1);
  rsm.send("RSM_FIXED_MOVE X -1000");
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_X"), -301);
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 2);
  rsm.send("RSM_CLEAR_STOP X");
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0);
  rsm.send({"RSM_CLEAR_SLMT X", "RSM_FIXED_MOVE X -1000"});
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_X"), -1301);
}

// Wherever the axis was before its counter was set.
TEST(RsM8194hAxis, SoftLimitsGoByTheCountThatIsSet) {
  struct Case {
    int travel;  // before
    int count;   // those that are set there
    int by_encoder;
  };
  std::vector<Case> cases;
  for (const int travel : {-20000, -1, 0, 1, 400, 20000}) {
    for (const int count : {-299, 0, 100, 499}) {
      for (const int by_encoder : {0, 1}) cases.push_back({travel, count, by_encoder});
    }
  }
  for (const Case& each : cases) {
    SCOPED_TRACE(std::to_string(each.travel) + " " + std::to_string(each.count));
    const std::string set = each.by_encoder == 1 ? "RSM_SET_EP X " : "RSM_SET_LP X ";
    const char* const counter = each.by_encoder == 1 ? "EP_X" : "LP_X";
    OneRsm rsm;
    rsm.send({"RSM_SET_V X 10000", "RSM_SET_SV X 10000", "RSM_FIXED_MOVE X " + std::to_string(each.travel)});
    rsm.run_to_rest();
    rsm.send({set + std::to_string(each.count), "RSM_SET_SLMT X 500 -300 " + std::to_string(each.by_encoder),
              "RSM_FIXED_MOVE X 2000"});
    rsm.run_to_rest();
    EXPECT_EQ(rsm.get(counter), 501);
    EXPECT_EQ(rsm.get("ERROR_CODE_X"), 1);
    rsm.send({set + std::to_string(each.count), "RSM_FIXED_MOVE X -2000"});  // with the limits in effect
    rsm.run_to_rest();
    EXPECT_EQ(rsm.get(counter), -301);
    EXPECT_EQ(rsm.get("ERROR_CODE_X"), 2);
  }
}

TEST(RsM8194hAxis, LimitSwitchesStopInTheWayThatIsSet) {
  for (const bool slows : {false, true}) {
    OneRsm rsm;
    rsm.send({"RSM_SET_SV X 1000", "RSM_SET_V X 10000", "RSM_SET_A X 20000", "RSM_CONTINUE_MOVE X 10000"});
    if (slows) rsm.send("RSM_LIMITSTOP_MODE X 1");
    rsm.run(1000);
    const Value before = rsm.get("LP_X");
    rsm.pin(0, Pin::limit_minus, true);  // behind it
    rsm.run(10);
    EXPECT_EQ(rsm.get("DRIVING_AXIS"), 1);
    rsm.pin(0, Pin::limit_plus, true);
    const Tick stopped = rsm.run_to_rest();
    // (10000^2 - 1000^2) / (2 * 20000) pulses in 450 ms.
    EXPECT_NEAR(static_cast<double>(rsm.get("LP_X") - before), 100 + (slows ? 2475 : 0), 12);
    EXPECT_NEAR(static_cast<double>(stopped), slows ? 451 : 1, 1);
    EXPECT_EQ(rsm.get("ERROR_CODE_X"), 4);
  }
}

TEST(RsM8194hAxis, NewTotalsAndSpeedsActOnTheWay) {
  OneRsm rsm;
  rsm.send({"RSM_SET_SV X 1000", "RSM_SET_V X 1000", "RSM_FIXED_MOVE X -5000"});
  rsm.run(1000);
  rsm.send("RSM_SET_PULSE X -2000");
  rsm.run_to_rest();
  EXPECT_EQ(rsm.get("LP_X"), -2000);
  rsm.send("RSM_FIXED_MOVE X 5000");
  rsm.run(1001);
  rsm.send("RSM_SET_PULSE X 500");  // already passed
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  EXPECT_EQ(rsm.get("LP_X"), -1000);
  rsm.send({"RSM_CONTINUE_MOVE X -2000", "RSM_SET_A X 10000"});
  rsm.run(2000);
  EXPECT_EQ(rsm.get("CV_X"), 2000);
  rsm.send("RSM_SET_V X 4000");
  rsm.run(1500);
  EXPECT_EQ(rsm.get("CV_X"), 4000);
}

TEST(RsM8194hAxis, SlowsDownByItsRampToASpeedBelowSv) {
  OneRsm rsm;
  rsm.send({"RSM_SET_SV X 5000", "RSM_SET_A X 10000", "RSM_CONTINUE_MOVE X 10000"});
  rsm.run(1000);
  EXPECT_EQ(rsm.get("CV_X"), 10000);
  rsm.send("RSM_SET_V X 1000");
  rsm.run(700);
  EXPECT_NEAR(static_cast<double>(rsm.get("CV_X")), 3000, 100);
  rsm.run(300);
  EXPECT_EQ(rsm.get("CV_X"), 1000);
}

TEST(RsM8194hAxis, ExternalDrivesFollowTheirEdges) {
  struct Case {
    const char* command;
    int plus_edges;
    int minus_edges;
    Value lp;
  };
  // MP: EXP- low; a rising edge of EXP+ is the contact opening. FP: falling edges.
  constexpr Case kCases[] = {{"RSM_EXD_FP X 5", 1, 0, 5},
                             {"RSM_EXD_FP X 5", 2, 0, 5},
                             {"RSM_EXD_FP X 7", 0, 1, -7},
                             {"RSM_EXD_MP X 3", 1, 1, -3},
                             {"RSM_EXD_MP X 3", 1, 0, 0}};
  for (const Case& row : kCases) {
    OneRsm rsm;
    rsm.send({"RSM_SET_V X 1000", "RSM_SET_SV X 1000", row.command});
    rsm.device().set_input(terminal(0, Pin::external_minus), row.minus_edges);
    rsm.run(20);
    rsm.device().set_input(terminal(0, Pin::external_plus), row.plus_edges);
    rsm.run(50);
    EXPECT_EQ(rsm.get("LP_X"), row.lp) << row.command << " " << row.plus_edges << " " << row.minus_edges;
  }
}

TEST(RsM8194hAxis, ExternalDrivesKnowTheLevelsThatTheyFind) {
  // EXP+ conducts already: it falls at its second edge from here.
  for (const bool is_reset : {false, true}) {
    OneRsm rsm;
    const auto turn = [&](int edges) {
      rsm.world().set_external_input(0, terminal(0, Pin::external_plus), edges);
      rsm.run(50);
    };
    turn(1);
    if (is_reset) {
      rsm.send("RSM_RESET_CARD");
    } else {
      rsm.world().switch_power(0, false);
      rsm.world().switch_power(0, true);
    }
    rsm.run(3);
    rsm.send({"RSM_SET_SV X 1000", "RSM_SET_V X 1000", "RSM_EXD_FP X 10"});
    turn(2);
    EXPECT_EQ(rsm.get("LP_X"), 0) << is_reset;
    turn(3);
    EXPECT_EQ(rsm.get("LP_X"), 10) << is_reset;
  }
}

TEST(RsM8194hAxis, AContinuousExternalDriveRunsWhileItsInputIsLow) {
  OneRsm rsm;
  rsm.send({"RSM_SET_SV X 100", "RSM_SET_A X 1000000", "RSM_SET_V X 500", "RSM_EXD_CP X 2000"});
  rsm.device().set_input(terminal(0, Pin::external_minus), 1);
  rsm.run(100);
  EXPECT_EQ(rsm.get("CV_X"), 2000);
  EXPECT_LT(rsm.get("LP_X"), -150);
  rsm.device().set_input(terminal(0, Pin::external_minus), 2);
  rsm.run(10);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
}

/// A motion of EXD_CP ends when its input opens, whatever has happened in between; the input ends nothing
/// else.
TEST(RsM8194hAxis, AContinuousExternalDriveIsItsInputsAlone) {
  const auto turn = [](OneRsm& rsm, int count) {
    rsm.device().set_input(terminal(0, Pin::external_plus), count);
    rsm.run(20);
  };
  struct Case {
    std::vector<const char*> between;
    Value speed;  // after that, the input is still closed
    bool moves;   // once it has opened
  };
  const Case kCases[] = {
      {{}, 1000, false},
      {{"RSM_EXD_CP X 2000"}, 2000, false},
      {{"RSM_EXD_CP X 500"}, 500, false},
      {{"RSM_EXD_FP X 10"}, 0, false},
      {{"RSM_EXD_MP X 10"}, 0, false},
      {{"RSM_EXD_DISABLE X"}, 0, false},
      {{"RSM_LOAD_INITIAL"}, 0, false},
      {{"RSM_STOP_SUDDENLY X", "RSM_CLEAR_STOP X"}, 0, false},
      {{"RSM_STOP_SUDDENLY X", "RSM_CLEAR_STOP X", "RSM_CONTINUE_MOVE X 300"}, 300, true},
  };
  for (const Case& each : kCases) {
    SCOPED_TRACE(each.between.empty() ? "" : each.between.back());
    OneRsm rsm;
    rsm.send({"RSM_SET_MAX_V X 8000", "RSM_SET_SV X 100", "RSM_SET_A X 1000000", "RSM_EXD_CP X 1000"});
    turn(rsm, 1);
    EXPECT_EQ(rsm.get("CV_X"), 1000);
    for (const char* const command : each.between) rsm.send(command);
    rsm.run(20);
    EXPECT_EQ(rsm.get("CV_X"), each.speed);
    turn(rsm, 2);
    EXPECT_EQ(rsm.get("DRIVING_AXIS") != 0, each.moves);
  }
}

TEST(RsM8194hAxis, AnExternalDriveThatWasVoidStopsNothing) {
  OneRsm rsm;
  rsm.send({"RSM_SET_MAX_V X 8000", "RSM_SET_SV X 100", "RSM_EXD_CP X 1000", "RSM_STOP_SUDDENLY X"});
  rsm.device().set_input(terminal(0, Pin::external_plus), 1);
  rsm.run(5);
  rsm.send({"RSM_CLEAR_STOP X", "RSM_CONTINUE_MOVE X 300"});
  rsm.run(5);
  rsm.device().set_input(terminal(0, Pin::external_plus), 2);
  rsm.run(20);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 1);
}

TEST(RsM8194hAxis, ANewSpeedOnTheWayMayBeBelowTheStartSpeed) {
  OneRsm rsm;
  rsm.send({"RSM_SET_MAX_V X 8000", "RSM_SET_SV X 1000", "RSM_SET_A X 10000", "RSM_CONTINUE_MOVE X 2000"});
  rsm.run(500);
  EXPECT_EQ(rsm.get("CV_X"), 2000);
  rsm.send("RSM_SET_V X 500");
  rsm.run(50);
  EXPECT_LT(rsm.get("CV_X"), 2000);
  EXPECT_GT(rsm.get("CV_X"), 1400);
  rsm.run(70);
  // Below its start speed, and still along its ramp.
  EXPECT_NEAR(static_cast<double>(rsm.get("CV_X")), 800, 30);
  rsm.run(200);
  EXPECT_EQ(rsm.get("CV_X"), 500);
  const Value at = rsm.get("LP_X");
  rsm.run(1000);
  EXPECT_EQ(rsm.get("LP_X") - at, 500);
}

/// It does not prevent the other input from starting one either.
TEST(RsM8194hAxis, AnExternalDriveThatALimitEndsIsNone) {
  OneRsm rsm;
  rsm.send({"RSM_SET_MAX_V X 8000", "RSM_SET_SV X 100", "RSM_SET_A X 1000000", "RSM_EXD_CP X 1000"});
  rsm.pin(0, Pin::limit_plus, true);
  rsm.run(5);
  // Both close in the same tick.
  rsm.device().set_input(terminal(0, Pin::external_plus), 1);
  rsm.device().set_input(terminal(0, Pin::external_minus), 1);
  rsm.run(20);
  EXPECT_EQ(rsm.get("CV_X"), 1000);
  EXPECT_LT(rsm.get("LP_X"), 0);
  rsm.device().set_input(terminal(0, Pin::external_plus), 2);
  rsm.run(20);
  EXPECT_EQ(rsm.get("CV_X"), 1000);
  rsm.device().set_input(terminal(0, Pin::external_minus), 2);
  rsm.run(20);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
}

TEST(RsM8194hAxis, InPositionIsPartOfADrive) {
  OneRsm rsm;
  rsm.send({"RSM_SET_V X 1000", "RSM_SET_SV X 1000", "RSM_SET_INPOS X 1 0", "RSM_FIXED_MOVE X 10"});
  rsm.run(200);
  EXPECT_EQ(rsm.get("LP_X"), 10);
  EXPECT_EQ(rsm.get("STOP_X"), 0);
  rsm.pin(0, Pin::in_position, true);
  rsm.run(2);
  EXPECT_EQ(rsm.get("STOP_X"), 1);
}

/// 3.13: 0 switches the input off, also for an axis that is already waiting for it.
TEST(RsM8194hAxis, StopsWaitingForAnInputThatIsSwitchedOff) {
  for (const char* const drive : {"RSM_FIXED_MOVE X 10", "RSM_LINE_2D 10 10"}) {
    OneRsm rsm;
    rsm.send({"RSM_SET_MAX_V XY 1000", "RSM_SET_V XY 1000", "RSM_SET_SV XY 1000", "RSM_SET_VSV 1000",
              "RSM_SET_VV 1000", "RSM_AXIS_ASSIGN X Y 0", "RSM_SET_INPOS XY 1 0", drive});
    rsm.run(200);
    EXPECT_EQ(rsm.get("LP_X"), 10) << drive;
    EXPECT_NE(rsm.get("DRIVING_AXIS"), 0) << drive;
    rsm.send("RSM_SET_INPOS XY 0 0");
    rsm.run(3);
    EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0) << drive;
  }
}

}  // namespace single_axis_test
}  // namespace understudy::emulator::models::rs_m8194h
