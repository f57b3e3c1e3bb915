// The manual's listings of contacts, coils and edges on the whole controller, through all their inputs.
#include <gtest/gtest.h>

#include "tests/emulator/models/super_40nc/listings.h"

namespace understudy::emulator::models::super_40nc {
namespace listings_logic_test {

/// It comes ON from now on, for one scan.
void expect_one_scan(OneSuper40nc& one, const char* contact) {
  one.run(1);
  EXPECT_TRUE(one.on(contact)) << contact;
  for (int scan = 0; scan < 5; ++scan) {
    one.run(1);
    EXPECT_FALSE(one.on(contact)) << contact << " in scan " << scan + 2;
  }
}
void expect_no_scan(OneSuper40nc& one, const char* contact) {
  for (int scan = 0; scan < 5; ++scan) {
    one.run(1);
    EXPECT_FALSE(one.on(contact)) << contact << " in scan " << scan + 1;
  }
}

void l1(const std::string& program) {
  OneSuper40nc one({.program = program});
  for (int round = 0; round < 2; ++round) {
    one.input("X0", 1);
    one.run(2);
    EXPECT_TRUE(one.on("Y0"));
    EXPECT_FALSE(one.on("M1"));
    EXPECT_EQ(one.get("holding.T0"), 0);
    EXPECT_FALSE(one.on("Y1"));
    one.input("X0", 0);
    one.run(1);
    EXPECT_FALSE(one.on("Y0"));
    EXPECT_TRUE(one.on("M1"));
    EXPECT_EQ(one.get("holding.T0"), 0);
    one.run(999);
    EXPECT_EQ(one.get("holding.T0"), 999);
    EXPECT_FALSE(one.on("coil.T0") || one.on("Y1"));
    one.run(1);
    EXPECT_TRUE(one.on("coil.T0") && one.on("Y1"));
    one.run(500);
    EXPECT_EQ(one.get("holding.T0"), 1000);
  }
}

void l2(const std::string& program) {
  for (const bool x0 : {false, true}) {
    for (const bool x5 : {false, true}) {
      OneSuper40nc one({.program = program});
      put(one, "X0", x0);
      put(one, "X5", x5);
      if (x0) {
        expect_legs(one, 1, {{12, 0.160, {1000, 0, 0, 0}}});
      } else if (!x5) {
        expect_legs(one, 1, {{22, 0.170, {2000, 0, 0, 0}}});
      } else {
        run_through(one, "M8100");
        EXPECT_EQ(positions(one), Places{});
      }
      EXPECT_EQ(one.get("D8100"), 0);
    }
  }
}

void l3(const std::string& program) {
  OneSuper40nc one({.program = program});
  each_state(one, {"X2", "M10", "X4", "X3"}, [&](const std::vector<bool>& on) {
    one.run(1);
    EXPECT_EQ(one.on("Y5"), on[0] || on[1]);
    EXPECT_EQ(one.on("M50"), on[2] || !on[3]);
  });
}

void l4(const std::string& program) {
  OneSuper40nc one({.program = program});
  each_state(one, {"M10", "M11", "M120", "M130"}, [&](const std::vector<bool>& on) {
    one.set("Y10", 0);
    one.set("Y12", 0);
    run_through(one, "M8100");
    const bool first = on[0] || on[1];
    EXPECT_EQ(one.on("Y10"), first);
    EXPECT_EQ(one.on("Y12"), !first && (on[2] || !on[3]));
  });
}

void l5(const std::string& program) {
  OneSuper40nc one({.program = program});
  each_state(one, {"X2", "X3", "X4", "T0"}, [&](const std::vector<bool>& on) {
    one.run(1);
    EXPECT_EQ(one.on("M10"), on[0] && on[1]);
    EXPECT_EQ(one.on("Y3"), on[0] && on[1] && !on[2]);
    EXPECT_EQ(one.on("Y5"), on[0] && on[1] && !on[2] && on[3]);
  });
}

void l6(const std::string& program) {
  for (const bool x0 : {false, true}) {
    for (const bool x1 : {false, true}) {
      OneSuper40nc one({.set = Set{{"D9163", 0}}, .program = program});  // X1 is not a limit
      put(one, "X0", x0);
      put(one, "X1", x1);
      if (x0 && x1) {
        expect_legs(one, 1, {{14, drive_s(150, 100), {150, 0, 0, 0}}});
      } else if (x0) {
        expect_legs(one, 1, {{24, drive_s(300, 200), {300, 0, 0, 0}}});
      } else {
        run_through(one, "M8100");
        EXPECT_EQ(positions(one), Places{});
      }
    }
  }
}

void l7(const std::string& program, bool rises) {
  OneSuper40nc one({.program = program});
  one.run(1);  // a contact that is ON when the PLC starts is not an edge
  for (const char* input : {"X1", "X3"}) {
    put(one, input, true);
    rises ? expect_one_scan(one, "M10") : expect_no_scan(one, "M10");
    put(one, input, false);
    rises ? expect_no_scan(one, "M10") : expect_one_scan(one, "M10");
  }
  for (const bool m20 : {false, true}) {
    one.set("M20", m20 ? 1 : 0);
    put(one, "X5", true);
    rises&& m20 ? expect_one_scan(one, "Y2") : expect_no_scan(one, "Y2");
    put(one, "X5", false);
    !rises&& m20 ? expect_one_scan(one, "Y2") : expect_no_scan(one, "Y2");
  }
}
void l7a(const std::string& program) { l7(program, true); }
void l7b(const std::string& program) { l7(program, false); }

void l8(const std::string& program) {
  OneSuper40nc one({.program = program});
  each_state(one, {"X0", "X1", "X2", "X3", "X4", "X5", "X6"}, [&](const std::vector<bool>& on) {
    one.run(1);
    EXPECT_EQ(one.on("Y5"), ((on[0] && on[1]) || (on[2] && !on[3])) && ((!on[4] && on[5]) || on[6]));
  });
}

void l9(const std::string& program) {
  OneSuper40nc one({.program = program});
  each_state(one, {"M0", "M1", "M2", "M3", "M4", "M5"}, [&](const std::vector<bool>& on) {
    one.set("Y3", 0);
    one.set("Y6", 0);
    run_through(one, "M8100");
    EXPECT_EQ(one.on("Y3"), !(((on[0] && !on[1]) || (on[2] && !on[3])) && (!on[4] || !on[5])));
    EXPECT_TRUE(one.on("Y6"));
  });
}

void l10(const std::string& program) {
  OneSuper40nc one({.program = program});
  each_state(one, {"X0", "X1", "X2", "X3"}, [&](const std::vector<bool>& on) {
    one.run(1);
    EXPECT_EQ(one.on("Y0"), on[0] && on[1]);
    EXPECT_EQ(one.on("Y1"), on[0] && !on[2]);
    EXPECT_EQ(one.on("Y2"), on[0] && on[3]);
  });
}

void l11(const std::string& program) {
  OneSuper40nc one({.program = program});
  each_state(one, {"X0"}, [&](const std::vector<bool>& on) {
    one.run(1);
    EXPECT_EQ(one.on("Y1"), !on[0]);
  });
}

void l12(const std::string& program) {
  OneSuper40nc one({.program = program});
  for (int press = 1; press <= 4; ++press) {
    one.set("M0", 1);
    one.run(1);
    EXPECT_EQ(one.on("Y6"), press % 2 == 1);
    one.run(7);
    EXPECT_EQ(one.on("Y6"), press % 2 == 1);  // not in every scan
    one.set("M0", 0);
    one.run(3);
    EXPECT_EQ(one.on("Y6"), press % 2 == 1);
  }
}

void l13(const std::string& program) {
  OneSuper40nc one({.program = program});
  for (int round = 0; round < 2; ++round) {
    one.input("X0", 1);
    one.run(1);
    EXPECT_TRUE(one.on("M0"));
    EXPECT_FALSE(one.on("M1"));
    expect_no_scan(one, "M0");
    one.input("X0", 0);
    expect_one_scan(one, "M1");
    EXPECT_FALSE(one.on("M0"));
  }
}

void l14(const std::string& program) {
  OneSuper40nc one({.program = program});
  bool latched = false;
  for (const auto& [x0, x1] :
       {std::pair{true, false}, {false, false}, {false, true}, {false, false}, {true, true}, {true, false}}) {
    put(one, "X0", x0);
    put(one, "X1", x1);
    one.run(2);
    latched = (latched || x0) && !x1;  // RST is later, and wins
    EXPECT_EQ(one.on("Y0"), latched) << x0 << x1;
  }
}

void l15(const std::string& program) {
  OneSuper40nc one({.program = program});
  one.set("M8100", 1);
  const Pulse pulse = pulse_of(one, "M5");
  EXPECT_NEAR(static_cast<double>(pulse.before), 770, kTolerance_ms);
  EXPECT_EQ(pulse.lasts, 1000);
  EXPECT_EQ(positions(one), (Places{10000, 0, 0, 0}));
  EXPECT_FALSE(one.on("M8100"));
}

constexpr Listing kListings[] = {{"L1", l1},   {"L2", l2},   {"L3", l3},   {"L4", l4},
                                 {"L5", l5},   {"L6", l6},   {"L7a", l7a}, {"L7b", l7b},
                                 {"L8", l8},   {"L9", l9},   {"L10", l10}, {"L11", l11},
                                 {"L12", l12}, {"L13", l13}, {"L14", l14}, {"L15", l15}};

class LogicListing : public testing::TestWithParam<Listing> {};
TEST_P(LogicListing, DoesWhatTheManualSays) { GetParam().holds(sample(GetParam().name)); }
INSTANTIATE_TEST_SUITE_P(Of, LogicListing, testing::ValuesIn(kListings), name_of_listing);

TEST(LogicListings, AreAllHere) { expect_all_of('L', 1, 99, kListings); }

}  // namespace listings_logic_test
}  // namespace understudy::emulator::models::super_40nc
