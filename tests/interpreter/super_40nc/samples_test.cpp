// The manual's own listings compared with its text: ladders with all their inputs, step programs by their
// requests to the machine. The tests of the device test the motion itself.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/interpreter/super_40nc/running.h"

namespace understudy::interpreter::super_40nc {
namespace samples_test {

std::string text_of_sample(const std::string& name) {
  std::ifstream file(TEST_FACTS "/super_40nc/samples/" + name + ".lst");
  EXPECT_TRUE(file) << name;
  return {std::istreambuf_iterator<char>(file), {}};
}

Running ladder(const std::string& name) {
  Running running(text_of_sample(name));
  running.machine.registers[named::kOwnedAxes] = 0;
  running.run_plc();
  return running;
}

/// Started; C owns all axes, or none for an axis program.
Running steps(const std::string& name, Area area) {
  Running running(text_of_sample(name));
  running.machine.registers[named::kOwnedAxes] = area == Area::c ? 4 : 0;
  running.machine.registers[named::kDefaultFeed] = 10000;
  running.start(area);
  return running;
}

/// Its requests to the machine, including starts, ends and positions.
std::string asked(const Running& running) {
  std::string text;
  for (const std::string& line : running.machine.log) {
    if (line.ends_with(": starts") || line.ends_with(": ended")) continue;
    text += (text.empty() ? "" : "; ") + line;
  }
  return text;
}

std::string asked_by(const std::string& name, Area area, int ticks = 5000) {
  Running running = steps(name, area);
  running.tick(ticks);
  return asked(running);
}

/// All states of some contacts.
void all_states(const std::vector<Operand>& contacts, ScriptedMachine& machine, auto look) {
  for (unsigned states = 0; states < (1U << contacts.size()); ++states) {
    std::vector<bool> on;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      on.push_back(((states >> i) & 1) != 0);
      machine.set(contacts[i], on.back());
    }
    look(on);
  }
}

TEST(Super40ncSamples, LaddersOfContactsDoWhatTheySay) {
  Running l3 = ladder("L3");
  all_states({x(2), m(10), x(4), x(3)}, l3.machine, [&](const std::vector<bool>& on) {
    l3.scan();
    EXPECT_EQ(l3.machine.contact(y(5)), on[0] || on[1]);
    EXPECT_EQ(l3.machine.contact(m(50)), on[2] || !on[3]);
  });
  Running l5 = ladder("L5");
  all_states({x(2), x(3), x(4), t(0)}, l5.machine, [&](const std::vector<bool>& on) {
    l5.scan();
    EXPECT_EQ(l5.machine.contact(y(3)), on[0] && on[1] && !on[2]);
    EXPECT_EQ(l5.machine.contact(y(5)), on[0] && on[1] && !on[2] && on[3]);
  });
  Running l11 = ladder("L11");
  all_states({x(0)}, l11.machine, [&](const std::vector<bool>& on) {
    l11.scan();
    EXPECT_EQ(l11.machine.contact(y(1)), !on[0]);
  });
}

TEST(Super40ncSamples, TheFirstCountsASecond) {
  Running running = ladder("L1");
  running.machine.set(x(0), true);
  running.scan();
  EXPECT_TRUE(running.machine.contact(y(0)));
  EXPECT_FALSE(running.machine.contact(m(1)));
  running.machine.set(x(0), false);
  for (int ms = 0; ms <= 1000; ++ms) {
    EXPECT_FALSE(running.machine.contact(y(1))) << ms;
    running.scan();
  }
  EXPECT_TRUE(running.machine.contact(m(1)));
  EXPECT_TRUE(running.machine.contact(y(1)));
}

TEST(Super40ncSamples, EdgesLastOneScan) {
  for (const bool rises : {true, false}) {
    Running running = ladder(rises ? "L7a" : "L7b");
    running.machine.set(m(20), true);
    for (const int input : {1, 3, 5}) {
      running.machine.set(x(input), !rises);
      running.scan();
      running.scan();
      running.machine.set(x(input), rises);
      running.scan();
      const Operand output = input == 5 ? y(2) : m(10);
      EXPECT_TRUE(running.machine.contact(output)) << input;
      running.scan();
      EXPECT_FALSE(running.machine.contact(output)) << input;
    }
  }
}

TEST(Super40ncSamples, LaddersOfNumbersDoWhatTheySay) {
  Running d7 = ladder("D7");
  for (int i = 0; i < 4; ++i) d7.machine.set(x(i), true);
  const std::int32_t before[] = {5, 0, 3, 0, 6, 7, 0, -17, 5};
  for (int i = 0; i < 9; ++i) d7.machine.write(d(i), before[i]);
  d7.scan();
  const std::int32_t after[] = {5, 6, 3, 7, 6, 7, 42, -17, 5, -3, -2};
  for (int i = 0; i < 11; ++i) EXPECT_EQ(d7.machine.value(d(i)), after[i]) << i;

  Running d9 = ladder("D9");
  d9.machine.set(x(0), true);
  for (int i = 0; i < 6; ++i) d9.scan();
  d9.machine.set(m(100), true);
  for (int i = 0; i < 3; ++i) d9.scan();
  EXPECT_EQ(d9.machine.value(d(10)), 9);
  EXPECT_EQ(d9.machine.value(d(20)), -3);

  Running d3 = ladder("D3");
  for (int i = 0; i <= 11; ++i) d3.machine.set(m(i), true);
  d3.machine.set(x(0), true);
  d3.scan();
  for (int i = 0; i <= 11; ++i) EXPECT_EQ(d3.machine.contact(m(i)), i == 11) << i;

  Running d5 = ladder("D5");
  for (int i = 0; i <= 5; ++i) d5.machine.write(d(i), 9);
  d5.machine.set(x(0), true);
  d5.scan();
  for (int i = 0; i <= 5; ++i) EXPECT_EQ(d5.machine.value(d(i)), i == 5 ? 9 : 0) << i;

  Running d11 = ladder("D11a");
  d11.machine.write(d(10), -4);
  d11.machine.set(x(0), true);
  d11.scan();
  EXPECT_EQ(d11.machine.value(d(10)), 4);
}

TEST(Super40ncSamples, LaddersOfComparisonsDoWhatTheySay) {
  for (const std::int32_t value : {49, 50, 51}) {
    Running running = ladder("D12");
    running.machine.write(d(100), value);
    running.machine.write(c(0), value - 29);
    running.machine.write(d(150), value - 40);
    running.machine.write(c(1), value + 50);
    running.scan();
    EXPECT_EQ(running.machine.contact(y(0)), value == 50);
    EXPECT_EQ(running.machine.contact(y(1)), value - 29 >= 21);
    EXPECT_EQ(running.machine.contact(m(10)), value - 40 != 10);
    EXPECT_EQ(running.machine.contact(m(20)), value + 50 >= 100);
  }
  Running d15 = ladder("D15");
  all_states({x(1), x(3), m(5), m(10)}, d15.machine, [&](const std::vector<bool>& on) {
    for (const std::int32_t value : {9, 10}) {
      d15.machine.write(d(20), value);
      d15.machine.write(d(10), 10);
      d15.machine.write(c(0), value);
      d15.machine.write(c(5), value + 90);
      d15.scan();
      EXPECT_EQ(d15.machine.contact(y(0)), on[0] || value == 10);
      EXPECT_EQ(d15.machine.contact(m(100)), on[1] || value <= 9);
      EXPECT_EQ(d15.machine.contact(y(10)), (on[2] && on[3]) || value + 90 >= 100);
    }
  });
}

TEST(Super40ncSamples, LaddersOfMotionAskForIt) {
  Running m7b = ladder("M7b");
  m7b.machine.set(m(100), true);
  m7b.scan();
  m7b.scan();
  m7b.machine.set(m(101), true);
  m7b.scan();
  EXPECT_EQ(asked(m7b),
            "PLC: DRV 2200 1500 * * relative at 100,150; PLC: DRV 800 1500 * * relative at 100,150");
  Running m9 = ladder("M9");
  m9.machine.set(x(10), true);
  m9.scan();
  m9.machine.set(x(10), false);
  m9.machine.set(x(11), true);
  m9.scan();
  EXPECT_EQ(asked(m9), "PLC: DRV * 1500 3000 * at 200,300; PLC: DRV 4000 * * 6500 at 100,400");
  Running m14 = ladder("M14");
  m14.machine.set(x(12), true);
  m14.scan();
  m14.machine.set(x(13), true);
  m14.scan();
  EXPECT_EQ(asked(m14), "PLC: HOM 15; PLC: HOM 5");
  Running m20 = ladder("M20");
  m20.machine.set(x(0), true);
  m20.scan();
  m20.machine.set(x(1), true);
  m20.scan();
  EXPECT_EQ(asked(m20), "PLC: JOG 3 0; PLC: JOG 3 12");
  Running m16 = ladder("M16");
  for (const auto& [input, axis] : {std::pair{16, 1}, {17, 2}, {18, 3}, {19, 4}}) {
    m16.machine.set(x(input), true);
    m16.scan();
    EXPECT_EQ(m16.machine.registers[8020], axis);
  }
  m16.machine.set(x(17), false);
  m16.scan();
  EXPECT_EQ(m16.machine.registers[8020], 4);
  m16.machine.set(x(16), false);
  m16.scan();
  EXPECT_EQ(m16.machine.registers[8020], 0);
}

TEST(Super40ncSamples, BranchesOfStepProgramsGoWhereTheySay) {
  Running l4 = steps("L4", Area::x);
  l4.tick(5);
  EXPECT_TRUE(l4.machine.contact(y(12)));  // with all OFF
  EXPECT_FALSE(l4.machine.contact(y(10)));
  for (const bool on : {false, true}) {
    Running l9 = steps("L9", Area::x);
    l9.machine.set(m(0), on);
    l9.tick(5);
    EXPECT_EQ(l9.machine.contact(y(3)), !on);
    EXPECT_TRUE(l9.machine.contact(y(6)));
    Running s5 = steps("S5", Area::c);
    s5.machine.set(m(100), on);
    s5.tick(5);
    EXPECT_EQ(s5.machine.contact(m(20)), on);
    EXPECT_EQ(s5.machine.contact(m(30)), !on);
    Running s4 = steps("S4", Area::c);
    s4.machine.set(x(0), on);
    s4.tick(9);
    EXPECT_EQ(asked(s4), on ? "C: LIN 300 400 * * F20000" : "C: LIN 100 200 * * F10000");
    Running s1 = steps("S1", Area::c);
    s1.machine.set(x(12), on);
    s1.tick(2100);
    EXPECT_EQ(asked(s1), on ? "C: DRV 5000 * * * at 100; C: DRV 0 0 * * at 100,200"
                            : "C: DRV 10000 * * * at 200; C: DRV 0 0 * * at 200,200");
  }
  Running d13 = steps("D13", Area::c);
  d13.machine.write(d(0), 1);  // neither D0 = D1 nor the second group: D50 is 10
  d13.machine.write(d(50), 10);
  d13.machine.write(d(250), 1);
  d13.machine.write(d(300), 20);
  d13.tick(10);
  EXPECT_EQ(asked(d13), "C: LIN 0 0 0 0 F30000");
}

TEST(Super40ncSamples, StepProgramsAskForTheirMotions) {
  EXPECT_EQ(asked_by("D8", Area::c), "C: LIN 20 18 36 9 F50000");
  EXPECT_EQ(asked_by("D11", Area::c), "C: LIN 0 10000 * * F20000");
  EXPECT_EQ(
      asked_by("M2", Area::c),
      "C: LIN 12150 35500 1500 22300 F10000; C: LIN * * -12000 65000 F20000; C: LIN * 36000 * * F20000; "
      "C: LIN 0 0 0 0 F20000");
  EXPECT_EQ(asked_by("M3", Area::c),
            "C: LIN 20000 25000 * * F50000; C: CCW XY 48000 25000 around 14000 0 F50000; "
            "C: CW XY * * around 7000 7000 F50000");
  EXPECT_EQ(asked_by("M5", Area::c),
            "C: LIN 20000 15000 * * F50000; C: CWR XY 30000 23000 R-10000 F50000; "
            "C: CCWR XY 20000 15000 R10000 F50000");
  EXPECT_EQ(asked_by("M6", Area::c),
            "C: LIN 14000 18000 * * F10000; C: CCW XY 38000 * around 12000 0 F10000; "
            "C: CW XZ 62000 * around 12000 0 F10000");
  EXPECT_EQ(asked_by("M8b", Area::c),
            "C: LIN 22000 20000 * * relative F10000; C: LIN * -8000 * * relative F10000; "
            "C: LIN 20000 * * * relative F10000; C: LIN * 11000 * * relative F10000");
  EXPECT_EQ(asked_by("M10", Area::x), "X: DRV 2500 * * * at 200; X: DRV 1200 * * * at 200");
  EXPECT_EQ(asked_by("M12", Area::c),
            "C: DRV 2800 5500 4000 * at 200,350,500; C: DRV * 7200 * 8000 at 350,600; C: DRV 6400 * 8000 * "
            "at 100,500");
  EXPECT_EQ(asked_by("M13", Area::y), "Y: DRV * 15000 * * at 100; Y: DRV * 60000 * * at 100");
  EXPECT_EQ(asked_by("M15", Area::x), "X: DRV 1200 * * * at 100; X: HOM 1");
  EXPECT_EQ(asked_by("M18", Area::c),
            "C: MRK 5000 * * * relative at 50; C: MRK * 10000 * * relative at 100; "
            "C: MRK * -10000 * * relative at 100");
  EXPECT_EQ(asked_by("M19", Area::y, 12000),
            "Y: VDRV * 100 * *; Y: VDRV * 50 * *; Y: VDRV * 350 * *; Y: VDRV * 0 * *; Y: VDRV * -150 * *; "
            "Y: VDRV * 30 * *; Y: VDRV * 0 * *");
  EXPECT_EQ(asked_by("M27", Area::c), "PSET 0 0 * *; C: DRV 13000 24000 * * at 100,200");
}

TEST(Super40ncSamples, ASubroutineIsPassedSevenTimes) {
  Running running = steps("S2", Area::c);
  running.tick(7 * 520 + 200);
  EXPECT_EQ(running.phase(Area::c), Phase::idle);
  const std::string pass =
      "; C: LIN * * -10000 * F10000; C: LIN * * 0 * F10000; C: LIN 5000 * * * relative F10000";
  std::string expected = "C: LIN 25000 25000 * * F20000";
  for (int i = 0; i < 5; ++i) expected += pass;
  expected += "; C: LIN 50000 50000 * * F10000";  // F is unchanged
  for (int i = 0; i < 2; ++i) expected += pass;
  EXPECT_EQ(asked(running), expected);
  // C21 = 0: nothing moves, but the delays run.
  Running standing = steps("S2", Area::c);
  standing.machine.registers[named::kOwnedAxes] = 0;
  int ms = 0;
  for (; standing.phase(Area::c) != Phase::idle; ++ms) standing.tick();
  EXPECT_EQ(asked(standing), "");
  EXPECT_GE(ms, 3500);
  EXPECT_LE(ms, 3520);
}

TEST(Super40ncSamples, ALoopOfMovesNeverEnds) {
  Running running = steps("S3", Area::x);
  running.tick(5000);
  EXPECT_NE(running.phase(Area::x), Phase::idle);
  EXPECT_GT(running.machine.log.size(), 1000u);
  running.take(Event::stop, Area::x);
  EXPECT_EQ(running.phase(Area::x), Phase::idle);
}

TEST(Super40ncSamples, WaitsAndSignalsMeetTheirMotions) {
  Running l15 = steps("L15", Area::x);
  l15.tick(4);
  EXPECT_TRUE(l15.machine.contact(m(5)));
  int on = 0;
  for (; l15.machine.contact(m(5)); ++on) l15.tick();
  EXPECT_EQ(on, 1000);
  Running d2 = steps("D2", Area::x);
  d2.tick();
  EXPECT_TRUE(d2.machine.contact(m(10)));
  d2.tick(4);
  EXPECT_FALSE(d2.machine.contact(m(10)));
  Running s7 = steps("S7", Area::c);
  s7.machine.set(x(14), true);
  s7.tick(50);
  EXPECT_TRUE(s7.machine.contact(y(10)));
  EXPECT_EQ(asked(s7), "");
  s7.machine.set(x(14), false);
  s7.tick();
  EXPECT_FALSE(s7.machine.contact(y(10)));
  EXPECT_EQ(asked(s7), "C: LIN 0 0 * * F10000");
  Running m17 = steps("M17", Area::c);
  m17.machine.answers["MPG"] = Begun::done;
  m17.tick(20);
  EXPECT_EQ(asked(m17), "C: MPG 2 5 -10 *");
  m17.machine.registers[8317] = -5000;
  m17.tick(20);
  EXPECT_EQ(asked(m17), "C: MPG 2 5 -10 *; C: MPG * * 0 *");
  m17.machine.set(x(12), true);
  m17.tick(2);
  EXPECT_EQ(asked(m17), "C: MPG 2 5 -10 *; C: MPG * * 0 *; C: MPG 0 0 * *");
}

TEST(Super40ncSamples, ProgramsStartAndStopEachOther) {
  Running m25 = steps("M25", Area::c);
  m25.codes[4] = StepCode(*program_of("AREA U\nSET Y7\nEND\n").area(Area::u));
  m25.tick(10);
  EXPECT_EQ(m25.phase(Area::c), Phase::idle);
  EXPECT_TRUE(m25.machine.contact(y(7)));
  Running m23 = steps("M23", Area::x);
  m23.codes[2] = StepCode(*program_of("AREA Y\nLAB K1\nJMP K1\nEND\n").area(Area::y));
  m23.start(Area::y);
  m23.machine.set(m(20), true);
  m23.tick(5);
  EXPECT_EQ(m23.phase(Area::x), Phase::idle);
  EXPECT_EQ(m23.phase(Area::y), Phase::idle);
  EXPECT_EQ(asked(m23), "Y: stop");
}

}  // namespace samples_test
}  // namespace understudy::interpreter::super_40nc
