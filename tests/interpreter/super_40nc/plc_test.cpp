// The PLC on a scripted machine: the manual's ladders, edges, timers, counters, numbers, motion by level and
// edge.
#include "interpreter/super_40nc/plc.h"

#include <gtest/gtest.h>

#include "tests/interpreter/super_40nc/running.h"

namespace understudy::interpreter::super_40nc {
namespace plc_test {

/// "LD X0; OUT Y0" as a program of the PLC, at RUN.
Running ladder_of(std::string text, const Options& options = {}) {
  for (char& letter : text) {
    if (letter == ';') letter = '\n';
  }
  Running running("AREA PLC\n" + text + "\nEND\n", options);
  running.run_plc();
  return running;
}

TEST(Super40ncPlc, FollowsTheManualsBlocks) {
  for (unsigned inputs = 0; inputs < 128; ++inputs) {
    Running plc = ladder_of("LD X0;AND X1;LD X2;ANI X3;ORB;LDI X4;AND X5;OR X6;ANB;OUT Y5");
    bool x_[7];
    for (int i = 0; i < 7; ++i) {
      x_[i] = ((inputs >> i) & 1) != 0;
      plc.machine.set(x(i), x_[i]);
    }
    plc.scan();
    EXPECT_EQ(plc.machine.contact(y(5)),
              ((x_[0] && x_[1]) || (x_[2] && !x_[3])) && ((!x_[4] && x_[5]) || x_[6]))
        << inputs;
  }
}

TEST(Super40ncPlc, BranchesByTheStack) {
  for (unsigned inputs = 0; inputs < 16; ++inputs) {
    Running plc = ladder_of("LD X0;MPS;AND X1;OUT Y0;MRD;ANI X2;OUT Y1;MPP;AND X3;OUT Y2");
    bool x_[4];
    for (int i = 0; i < 4; ++i) plc.machine.set(x(i), x_[i] = ((inputs >> i) & 1) != 0);
    plc.scan();
    EXPECT_EQ(plc.machine.contact(y(0)), x_[0] && x_[1]);
    EXPECT_EQ(plc.machine.contact(y(1)), x_[0] && !x_[2]);
    EXPECT_EQ(plc.machine.contact(y(2)), x_[0] && x_[3]);
  }
}

TEST(Super40ncPlc, ContinuesBehindAnOutput) {
  Running plc = ladder_of("LD M10;ANI X4;OUT Y3;AND T0;OUT Y5;LD X10;OR X11;ANB;OUT Y6;INV;OUT Y7");
  plc.machine.set(m(10), true);
  plc.machine.set(x(11), true);
  plc.scan();
  EXPECT_TRUE(plc.machine.contact(y(3)));
  EXPECT_FALSE(plc.machine.contact(y(5)));
  EXPECT_FALSE(plc.machine.contact(y(6)));
  EXPECT_TRUE(plc.machine.contact(y(7)));
}

TEST(Super40ncPlc, SeesEdgesOfContactsForOneScan) {
  Running plc = ladder_of("LDP X1;ORF X3;OUT M10;LD M20;ANP X5;OUT Y2");
  plc.machine.set(x(3), true);
  plc.machine.set(m(20), true);
  plc.run_plc();  // X3 is ON at RUN: no edge
  plc.scan();
  EXPECT_FALSE(plc.machine.contact(m(10)));
  plc.machine.set(x(1), true);
  plc.machine.set(x(5), true);
  plc.scan();
  EXPECT_TRUE(plc.machine.contact(m(10)));
  EXPECT_TRUE(plc.machine.contact(y(2)));
  plc.scan();
  EXPECT_FALSE(plc.machine.contact(m(10)));
  EXPECT_FALSE(plc.machine.contact(y(2)));
  plc.machine.set(x(3), false);
  plc.scan();
  EXPECT_TRUE(plc.machine.contact(m(10)));
  plc.scan();
  EXPECT_FALSE(plc.machine.contact(m(10)));
}

TEST(Super40ncPlc, PulsesAndTogglesByItsCondition) {
  Running plc = ladder_of("LD X0;PLS M0;PLF M1;ALT Y6");
  plc.machine.set(x(0), true);  // ON at RUN: fires once
  plc.scan();
  EXPECT_TRUE(plc.machine.contact(m(0)));
  EXPECT_TRUE(plc.machine.contact(y(6)));
  plc.scan();
  EXPECT_FALSE(plc.machine.contact(m(0)));
  EXPECT_TRUE(plc.machine.contact(y(6)));
  plc.machine.set(x(0), false);
  plc.scan();
  EXPECT_TRUE(plc.machine.contact(m(1)));
  plc.scan();
  EXPECT_FALSE(plc.machine.contact(m(1)));
  plc.machine.set(x(0), true);
  plc.scan();
  EXPECT_FALSE(plc.machine.contact(y(6)));
}

TEST(Super40ncPlc, NoEdgesAtRunIfChosen) {
  Options options;
  options.choose(option("run_edges", "not_at_all"));
  Running plc = ladder_of("LD X0;PLS M0;ALT Y6", options);
  plc.machine.set(x(0), true);
  plc.scan();
  EXPECT_FALSE(plc.machine.contact(m(0)));
  EXPECT_FALSE(plc.machine.contact(y(6)));
}

TEST(Super40ncPlc, LatchesAndTheLaterWins) {
  Running plc = ladder_of("LD X0;SET Y0;LD X1;RST Y0;LD X2;OUT Y1;LD X3;OUT Y1");
  plc.machine.set(x(0), true);
  plc.machine.set(x(2), true);
  plc.scan();
  EXPECT_TRUE(plc.machine.contact(y(0)));
  EXPECT_FALSE(plc.machine.contact(y(1)));  // the last OUT
  plc.machine.set(x(0), false);
  plc.scan();
  EXPECT_TRUE(plc.machine.contact(y(0)));
  plc.machine.set(x(0), true);
  plc.machine.set(x(1), true);
  plc.scan();
  EXPECT_FALSE(plc.machine.contact(y(0)));
}

TEST(Super40ncPlc, ATimerClosesItsPresetAfterItsCondition) {
  Running plc = ladder_of("LD X0;OUT T0 K1000;LD T0;OUT Y1");
  plc.scan();
  plc.machine.set(x(0), true);
  for (int ms = 0; ms < 1000; ++ms) {
    plc.scan();
    ASSERT_EQ(plc.machine.value(t(0)), ms);
    ASSERT_FALSE(plc.machine.contact(t(0))) << ms;
  }
  plc.scan();
  EXPECT_TRUE(plc.machine.contact(t(0)));
  EXPECT_TRUE(plc.machine.contact(y(1)));
  plc.scan();
  EXPECT_EQ(plc.machine.value(t(0)), 1000);
  plc.machine.set(x(0), false);
  plc.scan();
  EXPECT_FALSE(plc.machine.contact(t(0)));
  EXPECT_EQ(plc.machine.value(t(0)), 0);
}

TEST(Super40ncPlc, ATimerTakesWritesWhileItRunsOnly) {
  Running plc = ladder_of("LD X0;OUT T1 D5;LD X1;OUT T2 K0");
  plc.machine.write(d(5), 50);
  plc.machine.write(t(1), 30);  // OFF: cleared
  plc.scan();
  EXPECT_EQ(plc.machine.value(t(1)), 0);
  plc.machine.write(t(1), 30);  // the scan that turns it ON begins at 0
  plc.machine.set(x(0), true);
  plc.scan();
  EXPECT_EQ(plc.machine.value(t(1)), 0);
  plc.machine.write(t(1), 30);
  plc.scan();
  EXPECT_EQ(plc.machine.value(t(1)), 31);
  plc.machine.write(d(5), 31);
  plc.machine.set(x(1), true);
  plc.scan();
  EXPECT_TRUE(plc.machine.contact(t(1)));
  EXPECT_TRUE(plc.machine.contact(t(2)));  // at once
}

TEST(Super40ncPlc, ATimerContinuesBehindAStop) {
  Running plc = ladder_of("LD X0;OUT T0 K10");
  plc.machine.set(x(0), true);
  for (int i = 0; i < 5; ++i) plc.scan();
  EXPECT_EQ(plc.machine.value(t(0)), 4);
  stop(plc.plc, plc.machine);
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(plc.scan().has_changed);
  EXPECT_EQ(plc.machine.value(t(0)), 4);
  plc.run_plc();
  plc.scan();
  EXPECT_EQ(plc.machine.value(t(0)), 5);
}

TEST(Super40ncPlc, ACounterCountsEdgesUpToItsPreset) {
  Running plc = ladder_of("LD X0;OUT C3 K2;LD X1;RST C3");
  plc.machine.set(x(0), true);
  plc.scan();  // ON at RUN: not counted
  EXPECT_EQ(plc.machine.value(c(3)), 0);
  const auto pulse = [&] {
    plc.machine.set(x(0), false);
    plc.scan();
    plc.machine.set(x(0), true);
    plc.scan();
  };
  pulse();
  EXPECT_EQ(plc.machine.value(c(3)), 1);
  EXPECT_FALSE(plc.machine.contact(c(3)));
  pulse();
  EXPECT_TRUE(plc.machine.contact(c(3)));
  pulse();
  EXPECT_EQ(plc.machine.value(c(3)), 2);
  plc.machine.write(c(3), 0);  // a host
  plc.scan();
  EXPECT_FALSE(plc.machine.contact(c(3)));
  pulse();
  plc.machine.set(x(1), true);
  plc.scan();
  EXPECT_EQ(plc.machine.value(c(3)), 0);
}

TEST(Super40ncPlc, ACounterCountsOnIfChosen) {
  Options options;
  options.choose(option("counter_past_preset", "counts_on"));
  Running plc = ladder_of("LD X0;OUT C0 K1", options);
  for (int i = 0; i < 3; ++i) {
    plc.machine.set(x(0), false);
    plc.scan();
    plc.machine.set(x(0), true);
    plc.scan();
  }
  EXPECT_EQ(plc.machine.value(c(0)), 3);
}

TEST(Super40ncPlc, ACountersContactIsLatchedIfChosen) {
  Options options;
  options.choose(option("counter_contact", "closed_by_the_last_count"));
  Running plc = ladder_of("LD X0;OUT C0 K1;LD X1;RST C0", options);
  plc.scan();
  plc.machine.write(c(0), 5);  // a host: does not close it
  plc.scan();
  EXPECT_FALSE(plc.machine.contact(c(0)));
  plc.machine.write(c(0), 0);
  plc.machine.set(x(0), true);
  plc.scan();
  EXPECT_TRUE(plc.machine.contact(c(0)));
  plc.machine.write(c(0), 0);
  plc.scan();
  EXPECT_TRUE(plc.machine.contact(c(0)));
  plc.machine.set(x(1), true);
  plc.scan();
  EXPECT_FALSE(plc.machine.contact(c(0)));
}

struct Sum {
  const char* line;
  std::int32_t d0;
  std::int32_t d1;
  std::int32_t d2;
  std::int32_t d3 = 77;  // before: 77
};

TEST(Super40ncPlc, CalculatesInThirtyTwoBits) {
  constexpr std::int32_t kMax = INT32_MAX;
  constexpr std::int32_t kMin = INT32_MIN;
  constexpr Sum kSums[] = {
      {"ADD D0 D1 D2", 5, -7, -2},
      {"ADD D0 D1 D2", kMax, 1, kMin},
      {"SUB D0 D1 D2", kMin, 1, kMax},
      {"SUB K10 D1 D2", 0, 3, 7},
      {"MUL D0 D1 D2", -3, 4, -12},
      {"MUL D0 D1 D2", 65536, 65536, 0},
      {"MUL D0 D1 D2", kMin, kMin, 0},
      {"DIV D0 D1 D2", 7, 2, 3, 1},
      {"DIV D0 D1 D2", -7, 2, -3, -1},
      {"DIV D0 D1 D2", 7, -2, -3, 1},
      {"DIV D0 D1 D2", kMin, -1, kMin, 0},
      {"DIV D0 D1 D2", 7, 0, 77},
      {"MOV D0 D2", 9, 0, 9},
      {"FMV D0 D2 D1", 4, 2, 4, 4},
      {"FMV D0 D2 K1", 4, 2, 4},
      {"FMV D0 D2 K0", 4, 2, 77},
      {"FMV D0 D2 D1", 4, -1, 77},
      {"ZRST D2 D3", 4, -1, 0, 0},
      {"INC D2", 0, 0, 78},
      {"DEC D2", 0, 0, 76},
  };
  for (const Sum& sum : kSums) {
    Running plc = ladder_of("LD M8003;" + std::string(sum.line));
    plc.machine.write(d(0), sum.d0);
    plc.machine.write(d(1), sum.d1);
    plc.machine.write(d(2), 77);
    plc.machine.write(d(3), 77);
    plc.scan();
    EXPECT_EQ(plc.machine.value(d(2)), sum.d2) << sum.line << ' ' << sum.d0 << ' ' << sum.d1;
    EXPECT_EQ(plc.machine.value(d(3)), sum.d3) << sum.line << ' ' << sum.d0 << ' ' << sum.d1;
    // By registers that act, the same.
    std::string special = sum.line;
    for (std::size_t at = 0; (at = special.find(" D", at)) != std::string::npos; at += 2)
      special.insert(at + 2, "810");
    Running other = ladder_of("LD X0;" + special);
    other.machine.set(x(0), true);
    other.machine.registers = {{8100, sum.d0}, {8101, sum.d1}, {8102, 77}, {8103, 77}};
    other.scan();
    EXPECT_EQ(other.machine.registers[8102], sum.d2) << special;
    EXPECT_EQ(other.machine.registers[8103], sum.d3) << special;
  }
}

TEST(Super40ncPlc, TakesTheAbsoluteValue) {
  for (const auto& [before, after] :
       {std::pair{-5, 5}, {5, 5}, {INT32_MIN, INT32_MIN}, {-INT32_MAX, INT32_MAX}}) {
    Running plc = ladder_of("LD M8003;ABS D0");
    plc.machine.write(d(0), before);
    plc.scan();
    EXPECT_EQ(plc.machine.value(d(0)), after);
  }
}

TEST(Super40ncPlc, ComparesWithASign) {
  constexpr std::int32_t kValues[] = {INT32_MIN, -1, 0, 1, INT32_MAX};
  const std::pair<const char*, bool (*)(std::int32_t, std::int32_t)> kComparisons[] = {
      {"=", [](std::int32_t a, std::int32_t b) { return a == b; }},
      {">", [](std::int32_t a, std::int32_t b) { return a > b; }},
      {"<", [](std::int32_t a, std::int32_t b) { return a < b; }},
      {"<>", [](std::int32_t a, std::int32_t b) { return a != b; }},
      {"<=", [](std::int32_t a, std::int32_t b) { return a <= b; }},
      {">=", [](std::int32_t a, std::int32_t b) { return a >= b; }}};
  for (const auto& [sign, holds] : kComparisons) {
    const std::string with = sign;
    Running plc = ladder_of("LD" + with + " D0 D1;OUT Y0;LD M8003;AD" + with +
                            " D0 D8020;OUT Y1;LDI M8003;OR" + with + " C0 D1;OUT Y2");
    for (const std::int32_t a : kValues) {
      for (const std::int32_t b : kValues) {
        plc.machine.write(d(0), a);
        plc.machine.write(c(0), a);
        plc.machine.write(d(1), b);
        plc.machine.registers[8020] = b;
        plc.scan();
        for (int i = 0; i < 3; ++i) EXPECT_EQ(plc.machine.contact(y(i)), holds(a, b)) << a << sign << b << i;
      }
    }
  }
}

TEST(Super40ncPlc, ReportsNumbersThatCannotBe) {
  Running plc = ladder_of("LD M8003;DIV K1 K0 D0;FMV K9 D998 K3");
  plc.scan();
  EXPECT_EQ(plc.machine.codes, (std::vector<std::array<int, 3>>{{8, 3501, 0}, {9, 3504, 0}}));
  EXPECT_EQ(plc.machine.value(d(999)), 9);
  plc = ladder_of("LD M8003;DIV K7 K2 D999;DIV K7 K2 D9499");  // no register for the remainder
  plc.scan();
  EXPECT_EQ(plc.machine.value(d(999)), 3);
  EXPECT_TRUE(plc.machine.codes.empty());
}

TEST(Super40ncPlc, ReportsKeptCells) {
  Running plc = ladder_of("LD M8003;OUT M399;OUT M400;MOV K1 D499;MOV K1 D500;OUT T56 K5;OUT C15 K5");
  plc.machine.kept.clear();
  plc.scan();
  plc.scan();
  const auto& layout = ScriptedMachine::kLayout;
  EXPECT_EQ(plc.machine.kept, (std::set<std::uint32_t>{layout.m + 400, layout.d + 500, layout.t_value + 56}));
}

TEST(Super40ncPlc, ActsOnSpecialOnes) {
  Running plc = ladder_of("LDP X0;SET M8000;LD M8022;OUT M8102;LD X1;MOV D8117 D8020");
  plc.machine.registers[8117] = 42;
  plc.machine.set(x(0), true);
  plc.machine.set(x(1), true);
  plc.machine.special.insert(8022);
  plc.scan();
  EXPECT_TRUE(plc.machine.special.contains(8000));
  EXPECT_TRUE(plc.machine.special.contains(8102));
  EXPECT_EQ(plc.machine.registers[8020], 42);
}

TEST(Super40ncPlc, MovesByEdgeAndSetsModesByLevel) {
  Running plc = ladder_of("LD M100;INCC;RPM K100 K150;DRV K2200 * D0;HOM K0 K1;PSET K5");
  plc.machine.registers[named::kOwnedAxes] = 0;
  plc.machine.write(d(0), -7);
  plc.machine.set(m(100), true);
  plc.scan();
  const std::vector<std::string> first = {"PLC: DRV 2200 * -7 * relative at 100,300", "PLC: HOM 2",
                                          "PSET 5 * * *"};
  EXPECT_EQ(plc.machine.log, first);
  plc.scan();
  EXPECT_EQ(plc.machine.log.size(), 4u);  // PSET again
  EXPECT_EQ(plc.machine.log.back(), "PSET 5 * * *");
}

TEST(Super40ncPlc, MovesAxesOfCOnlyWhileItRests) {
  Running plc = ladder_of("LD X0;DRV K1 K2 K3");
  plc.machine.registers[named::kOwnedAxes] = 2;
  plc.machine.special.insert(8000);
  plc.machine.set(x(0), true);
  plc.scan();
  EXPECT_EQ(plc.machine.log, std::vector<std::string>{"PLC: DRV * * 3 * at 300"});
  EXPECT_EQ(plc.machine.codes, (std::vector<std::array<int, 3>>{{16, 3501, 0}}));
  plc.machine.special.erase(8000);
  plc.machine.set(x(0), false);
  plc.scan();
  plc.machine.set(x(0), true);
  plc.scan();
  EXPECT_EQ(plc.machine.log.back(), "PLC: DRV 1 2 3 * at 100,200,300");
}

TEST(Super40ncPlc, JogsAsLongAsALineAsksForIt) {
  Running plc = ladder_of("LD X0;PJG K1 K1;LD X1;PJG * K1;MJG * * K1 K0");
  plc.scan();
  EXPECT_TRUE(plc.machine.log.empty());
  plc.machine.set(x(0), true);
  plc.machine.set(x(1), true);
  plc.scan();
  plc.machine.set(x(0), false);
  plc.scan();
  plc.machine.set(x(1), false);
  plc.scan();
  plc.scan();
  EXPECT_EQ(plc.machine.log, (std::vector<std::string>{"PLC: JOG 3 4", "PLC: JOG 2 4", "PLC: JOG 0 0"}));
  plc.machine.set(x(1), true);
  plc.scan();
  stop(plc.plc, plc.machine);
  EXPECT_EQ(plc.machine.log.back(), "PLC: JOG 0 0");
}

TEST(Super40ncPlc, ChkIsVoidAndSaysSo) {
  Running plc = ladder_of("LD X0;CHK K0");
  plc.scan();
  EXPECT_TRUE(plc.machine.codes.empty());
  plc.machine.set(x(0), true);
  plc.scan();
  EXPECT_EQ(plc.machine.codes, (std::vector<std::array<int, 3>>{{2, 3501, 0}}));
}

TEST(Super40ncPlc, StartsAndStopsPrograms) {
  Running running(
      "AREA C\nWAT X40\nEND\nAREA Y\nWAT X40\nEND\nAREA PLC\nLD X0\nSTR * * * *\nSTR * K1\nLD X1\nSTP *\nSTP "
      "* K1\nEND\n");
  running.run_plc();
  running.machine.set(x(0), true);
  running.scan();
  EXPECT_EQ(running.phase(Area::c), Phase::executing);
  running.tick();
  EXPECT_EQ(running.phase(Area::c), Phase::waiting);
  EXPECT_EQ(running.phase(Area::y), Phase::waiting);
  EXPECT_EQ(running.phase(Area::x), Phase::idle);
  running.scan();  // no edge
  running.machine.set(x(1), true);
  running.scan();
  EXPECT_EQ(running.phase(Area::c), Phase::idle);
  EXPECT_EQ(running.phase(Area::y), Phase::idle);
  EXPECT_FALSE(running.machine.special_contact(8000));
}

TEST(Super40ncPlc, LinesBehindEndAreNeverRun) {
  Running plc = ladder_of("LD M8003;OUT Y0;END;OUT Y1");
  plc.scan();
  EXPECT_TRUE(plc.machine.contact(y(0)));
  EXPECT_FALSE(plc.machine.contact(y(1)));
}

// --- quiet scans ------------------------------------------------------------------------------------

TEST(Super40ncPlc, SaysWhenItHasSettled) {
  Running plc = ladder_of("LD X0;OUT Y0;LDP X1;SET M5;LD X2;INC D0;LD X3;PLS M7");
  EXPECT_TRUE(plc.scan().has_changed);  // the first scan since RUN
  EXPECT_FALSE(plc.scan().has_changed);
  EXPECT_EQ(plc.scan().quiet_scans, INT64_MAX);
  plc.machine.set(x(0), true);
  EXPECT_TRUE(plc.scan().has_changed);
  EXPECT_FALSE(plc.scan().has_changed);
  plc.machine.set(x(1), true);
  EXPECT_TRUE(plc.scan().has_changed);
  EXPECT_FALSE(plc.scan().has_changed);
  plc.machine.set(x(3), true);
  EXPECT_TRUE(plc.scan().has_changed);
  EXPECT_TRUE(plc.scan().has_changed);  // the pulse falls
  EXPECT_FALSE(plc.scan().has_changed);
  plc.machine.set(x(2), true);
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(plc.scan().has_changed);
}

TEST(Super40ncPlc, SkipsScansOfTimersAsIfItHadRunThem) {
  const std::string text = "LD X0;OUT T0 K500;LD T0;OUT Y0;LDI T0;OUT T60 D7;LD T60;OUT Y1";
  Running one = ladder_of(text);
  Running other = ladder_of(text);
  for (Running* plc : {&one, &other}) {
    plc->machine.write(d(7), 120);
    plc->machine.set(x(0), true);
  }
  int skipped = 0;
  for (int ms = 0; ms < 2000;) {
    const Scanned scanned = other.scan();
    one.scan();
    ++ms;
    ASSERT_EQ(one.machine.memory, other.machine.memory) << ms;
    ASSERT_EQ(one.plc, other.plc) << ms;
    if (scanned.has_changed) continue;
    const std::int64_t quiet = std::min<std::int64_t>(scanned.quiet_scans, 2000 - ms);
    fast_forward(other.plc, other.ladder, other.machine, quiet, {});
    for (std::int64_t i = 0; i < quiet; ++i) one.scan();
    ms += static_cast<int>(quiet);
    skipped += static_cast<int>(quiet);
    ASSERT_EQ(one.machine.memory, other.machine.memory) << ms;
    ASSERT_EQ(one.plc, other.plc) << ms;
    ASSERT_EQ(one.machine.kept_writes, other.machine.kept_writes) << ms;
  }
  EXPECT_GT(skipped, 1900);
}

TEST(Super40ncPlc, ATimerThatIsReadIsNotQuiet) {
  Running plc = ladder_of("LD X0;OUT T0 K500;LD> T0 K100;OUT Y0");
  plc.machine.set(x(0), true);
  plc.scan();
  for (int i = 0; i < 10; ++i) {
    const Scanned scanned = plc.scan();
    EXPECT_TRUE(scanned.has_changed);
    EXPECT_EQ(scanned.quiet_scans, 0);
  }
}

}  // namespace plc_test
}  // namespace understudy::interpreter::super_40nc
