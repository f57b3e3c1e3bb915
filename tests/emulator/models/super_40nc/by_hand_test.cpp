// A SUPER-40NC moved by hand: jog, ZERO, the hand wheel, the panel's keys, and what stops them. Positions and
// times are closed forms of the manual's ramps: 4000 pulses per revolution, 0 to 5000 rpm in 500 ms.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/emulator/models/super_40nc/one_super40nc.h"

namespace understudy::emulator::models::super_40nc {
namespace by_hand_test {

constexpr double kPulsesPerRevolution = 4000;
constexpr double kSlope = 5000 * kPulsesPerRevolution / 60 / 0.5;  // pps in a second
double pps(double rpm) { return rpm * kPulsesPerRevolution / 60; }

/// From rest at 1 rpm, where ramps begin.
double ramp_distance(double rpm) { return (pps(rpm) * pps(rpm) - pps(1) * pps(1)) / (2 * kSlope); }
double ramp_s(double rpm) { return (pps(rpm) - pps(1)) / kSlope; }

TEST(Super40ncJog, RunsAsLongAsItsContactIsOn) {
  struct Case {
    int selected;
    double rpm;
  };
  for (const auto& [selected, rpm] : {Case{0, 50}, Case{1, 100}, Case{2, 250}, Case{7, 250}, Case{-1, 50}}) {
    for (const int direction : {+1, -1}) {
      OneSuper40nc one;
      one.set("D8022", selected);
      const std::string contact = direction > 0 ? "M8203" : "M8204";
      one.set(contact, 1);
      one.run(1000);
      EXPECT_TRUE(one.on("M8221"));
      EXPECT_TRUE(one.on("M8238"));
      EXPECT_EQ(one.on("M8244"), direction < 0);
      EXPECT_EQ(one.get("D8264"), 12);
      one.set(contact, 0);
      one.run(1);
      const Tick ramp = one.run_while("M8220");
      EXPECT_NEAR(static_cast<double>(ramp + 1), ramp_s(rpm) * 1000, 2) << rpm;
      const double expected = ramp_distance(rpm) * 2 + pps(rpm) * (1.0 - ramp_s(rpm));
      EXPECT_NEAR(static_cast<double>(one.get("D8217")), direction * expected, 3) << rpm;
      EXPECT_TRUE(one.on("M8223"));
      EXPECT_TRUE(one.on("M8222"));
      EXPECT_EQ(one.get("D8117"), 0);
    }
  }
}

TEST(Super40ncJog, APulseBetweenScansJogsForOne) {
  OneSuper40nc one;
  one.set("D9176", 50);  // reaches its speed at once
  one.set("M8103", 1);
  one.set("M8103", 0);
  EXPECT_FALSE(one.on("M8120"));
  one.run(1);
  EXPECT_TRUE(one.on("M8120"));
  one.run(2);
  EXPECT_FALSE(one.on("M8120"));
  EXPECT_EQ(one.get("D8117"), 3);  // 3333 pps
}

TEST(Super40ncJog, TheOtherDirectionIsVoid) {
  OneSuper40nc one;
  one.set("M8103", 1);
  one.run(100);
  one.set("M8104", 1);
  one.run(1);
  EXPECT_EQ(one.get("D8094"), 21);
  EXPECT_FALSE(one.on("M8144"));
  one.set("M8103", 0);
  one.run(200);
  EXPECT_FALSE(one.on("M8120"));  // M8104 needs a new edge
  one.set("M8104", 0);
  one.run(1);
  one.set("M8104", 1);
  one.run(2);
  EXPECT_TRUE(one.on("M8144"));
  EXPECT_EQ(one.get("D8094"), 0);
}

TEST(Super40ncJog, StopsAtOnceForResetAndEmergency) {
  for (const char* contact : {"M8102", "M8002", "M8584"}) {
    OneSuper40nc one;
    one.set("M8103", 1);
    one.run(500);
    const Value before = one.get("D8117");
    one.set(contact, 1);
    one.run(1);
    EXPECT_EQ(one.get("D8117"), before) << contact;
    EXPECT_FALSE(one.on("M8120")) << contact;
    one.set(contact, 0);
    one.run(100);
    EXPECT_EQ(one.get("D8117"), before) << contact;  // M8103 is still ON: it needs an edge
    EXPECT_EQ(one.get("D8094"), std::string(contact) == "M8002" ? 19 : 0);
  }
}

TEST(Super40ncJog, CemgStopsAllAxes) {
  OneSuper40nc one;
  one.set("M8103", 1);
  one.set("M8403", 1);
  one.run(500);
  one.input("CEMG", 1);
  one.run(1);
  EXPECT_FALSE(one.on("M8120"));
  EXPECT_FALSE(one.on("M8420"));
  EXPECT_TRUE(one.on("M8147"));
  EXPECT_TRUE(one.on("M8347"));
  EXPECT_TRUE(one.on("M8124"));
  EXPECT_EQ(one.get("D8094"), 22);
}

TEST(Super40ncJog, IsVoidWhileMotionIsInhibited) {
  OneSuper40nc one;
  one.set("M8004", 1);
  one.set("M8103", 1);
  one.run(10);
  EXPECT_FALSE(one.on("M8120"));
  EXPECT_EQ(one.get("D8094"), 0);
  one.set("M8004", 0);
  one.run(10);
  EXPECT_FALSE(one.on("M8120"));
}

TEST(Super40ncJog, TheHighestSpeedIsNotPassed) {
  OneSuper40nc one;
  one.set("D9194", 9999);
  one.set("D9175", 200);
  one.set("M8103", 1);
  one.run(1000);
  // 200 rpm is 13333 pps, and the chip's step is 300 / floor(300 * 65535 / 13333) pps.
  EXPECT_EQ(one.get("D8170"), std::lround(pps(200) / (300.0 / std::floor(300.0 * 65535 / pps(200)))));
}

TEST(Super40ncLimits, SoftLimitStopsAPulseBeyond) {
  for (const int direction : {+1, -1}) {
    OneSuper40nc one;
    one.set(direction > 0 ? "D9185" : "D9186", direction * 1234);
    one.set(direction > 0 ? "M8103" : "M8104", 1);
    one.run(2000);
    EXPECT_EQ(one.get("D8140"), direction * 1235);
    EXPECT_TRUE(one.on(direction > 0 ? "M8128" : "M8129"));
    EXPECT_TRUE(one.on("M8124"));
    EXPECT_EQ(one.get("D8094"), direction > 0 ? 13 : 14);
    one.set("M8103", 0);
    one.set("M8104", 0);
    one.run(1);
    one.set(direction > 0 ? "M8104" : "M8103", 1);  // back is free
    one.run(100);
    EXPECT_TRUE(one.on("M8120"));
    EXPECT_FALSE(one.on("M8124"));
    EXPECT_EQ(one.get("D8094"), 0);
  }
}

TEST(Super40ncLimits, ComparatorsStopAtTheirPulse) {
  struct Case {
    int method;
    int action;
    Value value;
    Value end;
  };
  for (const auto& [method, action, value, end] :
       {Case{1, 1, 500, 500}, Case{5, 1, 500, 501}, Case{1, 0, 500, 0}, Case{1, 3, 500, 0},
        Case{0, 1, 500, 0}}) {
    OneSuper40nc one;
    one.set("D9140", method);
    one.set("D9141", action);
    one.set("D8146", value);
    one.set("M8103", 1);
    one.run(1000);
    EXPECT_EQ(one.on("M8120"), end == 0);
    EXPECT_EQ(one.get("D8094"), end == 0 ? 0 : 23);
    if (end != 0) {
      EXPECT_EQ(one.get("D8140"), end);
      EXPECT_TRUE(one.on("M8130") && one.on("M8124"));
    }
    one.press("M8102");
    one.press("M8107");  // COUNTER1 is 0 again
    one.set("M8103", 0);
    one.run(1);
    one.set("M8103", 1);
    one.run(1000);
    EXPECT_EQ(one.on("M8120"), end == 0);
    EXPECT_EQ(one.get("D8140") == end, end != 0);
  }
}

TEST(Super40ncLimits, SwitchesStopAtOnceOrByARamp) {
  for (const int ramp : {0, 1}) {
    Given given;
    given.plant[0].upper_limit = 3000;
    OneSuper40nc one(given);
    one.set("D9101", ramp);
    one.set("M8103", 1);
    one.run(3000);
    EXPECT_NEAR(static_cast<double>(one.get("D8140")), 3000 + ramp * ramp_distance(50), 1.5);
    EXPECT_EQ(one.get("D8140") == 3000, ramp == 0);
    EXPECT_TRUE(one.on("M8140"));
    EXPECT_TRUE(one.on("M8124"));
    EXPECT_EQ(one.get("D8094"), 11);
    one.press("M8103");
    EXPECT_FALSE(one.on("M8120"));
    one.set("M8104", 1);
    one.run(1000);
    EXPECT_FALSE(one.on("M8140"));
    EXPECT_LT(one.get("D8140"), 3000);
  }
}

TEST(Super40ncLimits, AlarmStopsAndForbidsMotion) {
  OneSuper40nc one;
  one.set("M8103", 1);
  one.run(500);
  one.input("ALM_X", 1);
  one.run(1);
  EXPECT_FALSE(one.on("M8120"));
  EXPECT_TRUE(one.on("M8139"));
  EXPECT_EQ(one.get("D8094"), 18);
  one.press("M8103");
  EXPECT_FALSE(one.on("M8120"));
  EXPECT_TRUE(one.on("M8124"));
}

TEST(Super40ncZero, GoesToTheWorkZero) {
  OneSuper40nc one;
  one.set("D8117", 5000);
  EXPECT_EQ(one.get("D8140"), 0);
  one.set("M8106", 1);
  one.run(1);
  EXPECT_TRUE(one.on("M8198"));
  EXPECT_EQ(one.get("D8169"), 5000 + one.get("D8140"));
  const Tick took = 1 + one.run_while("M8198");
  // 500 rpm: distance / v + v / a.
  EXPECT_NEAR(static_cast<double>(took), (5000 / pps(500) + pps(500) / kSlope) * 1000, 3);
  EXPECT_EQ(one.get("D8117"), 0);
  EXPECT_EQ(one.get("D8140"), -5000);
  EXPECT_TRUE(one.on("M8196"));
  one.set("M8106", 0);
  one.run(1);
  one.press("M8106");  // it is there
  EXPECT_TRUE(one.on("M8196"));
  EXPECT_FALSE(one.on("M8120"));
}

TEST(Super40ncZero, IsGivenUpByAReset) {
  OneSuper40nc one;
  one.set("D8117", 50000);
  one.press("M8106");
  one.run(50);
  one.press("M8102");
  EXPECT_FALSE(one.on("M8198"));
  EXPECT_FALSE(one.on("M8196"));
  EXPECT_EQ(one.get("D8094"), 0);
}

TEST(Super40ncCoordinates, FollowTheirModel) {
  OneSuper40nc one;
  one.set("D9171", 8);
  one.set("D9172", 5);
  one.set("D8140", 1600);
  EXPECT_EQ(one.get("D8117"), 1000);
  one.set("D8117", 250);
  EXPECT_EQ(one.get("D8140"), 1600);
  one.set("D8140", 0);
  EXPECT_EQ(one.get("D8117"), -750);
  one.set("D8141", 9);
  one.press("M8107");
  for (const char* name : {"D8117", "D8140", "D8141"}) EXPECT_EQ(one.get(name), 0) << name;
  one.set("M8103", 1);
  one.run(100);
  one.press("M8107");
  EXPECT_EQ(one.get("D8094"), 21);
  EXPECT_GT(one.get("D8140"), 0);
}

TEST(Super40ncWheel, FollowsByRatioAndDecoding) {
  struct Case {
    const char* contact;
    int decoding;
    int edges;
    Value expected;
  };
  for (const auto& [contact, decoding, edges, expected] :
       {Case{"M8108", 2, 40, 40}, Case{"M8109", 2, 4, 40}, Case{"M8110", 2, 2, 200}, Case{"M8108", 1, 41, 20},
        Case{"M8108", 0, 43, 10}, Case{"M8108", 3, 7, 7}}) {
    for (const int sense : {+1, -1}) {
      OneSuper40nc one;
      one.set("D9115", decoding);
      one.set("D9116", sense < 0 ? 1 : 0);
      one.set(contact, 1);
      one.run(2);
      EXPECT_TRUE(one.on("M8199"));
      EXPECT_EQ(one.get("D8164"), 8);
      one.input("MPG", edges);
      one.run(10);
      EXPECT_EQ(one.get("D8117"), sense * expected) << contact << " " << decoding;
      one.set(contact, 0);
      one.run(2);
      EXPECT_FALSE(one.on("M8199"));
      one.input("MPG", 0);
      one.run(10);
      EXPECT_EQ(one.get("D8117"), sense * expected);
    }
  }
}

TEST(Super40ncWheel, IsSelectedByD8020AndD8021) {
  OneSuper40nc one;
  one.set("D8021", 1);
  one.set("D8020", 2);
  one.run(1);
  EXPECT_TRUE(one.on("M8299"));
  one.input("MPG", 5);
  one.run(2);
  EXPECT_EQ(one.get("D8217"), 50);
  one.set("D8021", 2);
  one.run(1);
  one.input("MPG", 6);
  one.run(2);
  EXPECT_EQ(one.get("D8217"), 150);
  one.set("D8020", 0);
  one.run(1);
  EXPECT_FALSE(one.on("M8299"));
}

TEST(Super40ncWheel, CountsBeyondTheHighestSpeedAreLost) {
  OneSuper40nc one;
  one.set("D9175", 15);  // 1000 pps: one pulse per tick
  one.set("M8108", 1);
  one.run(2);
  one.input("MPG", 500);
  one.run(50);
  EXPECT_EQ(one.get("D8117"), 1);
}

TEST(Super40ncWheel, TurnsInVainAtALimitAndBack) {
  OneSuper40nc one;
  one.set("D9185", 10);
  one.set("M8108", 1);
  one.run(2);
  one.input("MPG", 50);
  one.run(10);
  EXPECT_EQ(one.get("D8117"), 11);  // the first pulse beyond
  EXPECT_TRUE(one.on("M8124"));
  EXPECT_EQ(one.get("D8094"), 13);
  EXPECT_TRUE(one.on("M8199"));
  one.input("MPG", 30);
  one.run(10);
  EXPECT_EQ(one.get("D8117"), -9);
}

TEST(Super40ncKeys, JogKeysWriteTheirContacts) {
  for (const auto& [key, contact] :
       {std::pair{"M8560", "M8103"}, std::pair{"M8561", "M8104"}, std::pair{"M8567", "M8404"},
        std::pair{"M8519", "M8103"}, std::pair{"M8524", "M8304"}}) {
    OneSuper40nc one;
    one.set(key, 1);
    one.run(5);
    EXPECT_TRUE(one.on(contact)) << key;
    one.set(key, 0);
    one.run(1);
    EXPECT_FALSE(one.on(contact)) << key;
  }
}

TEST(Super40ncKeys, X52SwapsTheJogKeys) {
  OneSuper40nc one;
  one.set("D9197", 1);
  one.set("M8560", 1);
  one.run(100);
  EXPECT_LT(one.get("D8117"), 0);
}

TEST(Super40ncKeys, LockedOnesAreStorage) {
  OneSuper40nc one;
  one.set("D9198", 10000000);  // + jog
  one.set("M8560", 1);
  one.run(5);
  EXPECT_FALSE(one.on("M8103"));
  EXPECT_TRUE(one.on("M8560"));
  one.set("M8561", 1);
  one.run(5);
  EXPECT_TRUE(one.on("M8104"));
  one.set("M8561", 0);
  one.run(100);
  one.set("D9198", 1);  // STOP
  one.set("M8103", 1);
  one.run(100);
  one.press("M8584");
  EXPECT_TRUE(one.on("M8120"));
}

TEST(Super40ncKeys, ZeroComesInItsOrder) {
  OneSuper40nc one;
  const char* const positions[] = {"D8117", "D8217", "D8317", "D8417"};
  for (const char* position : positions) one.set(position, 10000);
  one.set("D9184", 3);
  one.set("D9284", 1);
  one.set("D9384", 1);  // U never does
  one.press("M8593");
  EXPECT_TRUE(one.on("M8298") && one.on("M8398"));
  EXPECT_FALSE(one.on("M8198"));
  one.run_while("M8298");
  one.run(2);
  EXPECT_TRUE(one.on("M8198"));
  one.run_while("M8198");
  one.run(10);
  EXPECT_EQ(one.get("D8117"), 0);
  EXPECT_EQ(one.get("D8217"), 0);
  EXPECT_EQ(one.get("D8317"), 0);
  EXPECT_EQ(one.get("D8417"), 10000);
}

TEST(Super40ncKeys, SetZeroActsWhereX60Allows) {
  OneSuper40nc one;
  one.set("D8117", 10);
  one.set("D8217", 10);
  one.set("D9274", 1);
  one.press("M8514");
  one.run(2);
  EXPECT_EQ(one.get("D8117"), 10);
  EXPECT_EQ(one.get("D8217"), 0);
}

TEST(Super40ncLogo, IsOverAfterItsTime) {
  OneSuper40nc one;
  one.run(5999);
  EXPECT_FALSE(one.on("M8502"));
  one.run(1);
  EXPECT_TRUE(one.on("M8502"));
  one.set("M8502", 0);
  one.run(10000);
  EXPECT_FALSE(one.on("M8502"));
}

}  // namespace by_hand_test
}  // namespace understudy::emulator::models::super_40nc
