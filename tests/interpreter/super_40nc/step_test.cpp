// Step programs on a scripted machine: flow, waits, slices, the requests of each motion line, and who owns
// the axes.
#include <gtest/gtest.h>

#include "interpreter/super_40nc/step_programs.h"
#include "tests/interpreter/super_40nc/running.h"

namespace understudy::interpreter::super_40nc {
namespace step_test {

/// Lines of an area, split at semicolons, started.
Running started(std::string lines, Area area = Area::c, const Options& options = {}) {
  for (char& letter : lines) {
    if (letter == ';') letter = '\n';
  }
  Running running("AREA " + std::string(row_of(area).name) + "\n" + lines + "\nEND\n", options);
  running.machine.registers[named::kOwnedAxes] = area == Area::c ? 4 : 0;
  running.machine.registers[named::kDefaultFeed] = 10000;
  running.machine.registers[named::kDefaultPlane] = 2;
  running.start(area);
  return running;
}

/// Its requests to the machine, without starts and ends.
std::string asked(const Running& running) {
  std::string text;
  for (const std::string& line : running.machine.log) {
    if (line.ends_with(": starts") || line.ends_with(": ended")) continue;
    text += (text.empty() ? "" : "; ") +
            line.substr(line.find(": ") == std::string::npos ? 0 : line.find(": ") + 2);
  }
  return text;
}

std::string asked_by(const std::string& lines, Area area = Area::c, int ticks = 200) {
  Running running = started(lines, area);
  running.tick(ticks);
  EXPECT_EQ(running.phase(area), Phase::idle) << lines;
  return asked(running);
}

// --- flow -------------------------------------------------------------------------------------------

TEST(Super40ncStep, CallsRunAsOftenAsTheySay) {
  Running running =
      started("CAL K1 K3;CAL K2;CAL K1 D9;INC D1;END;LAB K1;INC D0;CAL K2 K2;RET;LAB K2;INC D5;RET");
  running.tick(100);
  EXPECT_EQ(running.machine.value(d(0)), 3);
  EXPECT_EQ(running.machine.value(d(5)), 7);
  EXPECT_EQ(running.machine.value(d(1)), 1);
  EXPECT_TRUE(running.machine.codes.empty());
}

TEST(Super40ncStep, IfGoesEitherWayAndNests) {
  for (unsigned inputs = 0; inputs < 4; ++inputs) {
    Running running = started(
        "LD X0;IF;LD X1;IF;MOV K3 D0;ELSE;MOV K2 D0;ENDI;ELSE;LDI X1;IF;MOV K1 D0;ENDI;ENDI;MOV D0 D1");
    for (int i = 0; i < 2; ++i) running.machine.set(x(i), ((inputs >> i) & 1) != 0);
    running.tick();
    const std::int32_t expected[] = {1, 2, 0, 3};
    EXPECT_EQ(running.machine.value(d(1)), expected[inputs]) << inputs;
  }
}

TEST(Super40ncStep, JumpsByItsContacts) {
  for (unsigned inputs = 0; inputs < 2; ++inputs) {
    Running running = started("LD X0;CJ K1;CJN K2;MOV K9 D0;END;LAB K1;MOV K1 D0;END;LAB K2;MOV K2 D0");
    running.machine.set(x(0), inputs != 0);
    running.tick(3);
    EXPECT_EQ(running.machine.value(d(0)), inputs != 0 ? 1 : 2);
  }
}

struct Stop {
  const char* lines;
  int code;
  int step;
};

TEST(Super40ncStep, StopsWithACodeWhereItCannotContinue) {
  constexpr Stop kStops[] = {
      {"NOP;JMP K5", 3, 1},
      {"LD M8003;CJ K5", 3, 1},
      {"LD X0;CJN K5", 3, 1},
      {"CAL K5", 3, 0},
      {"NOP;RET", 5, 1},
      {"LAB K1;CAL K1", 5, 1},
      {"LAB K1;LD M8003;CJ K2;END;LAB K2;CAL K1", 5, 6},
  };
  for (const Stop& stop : kStops) {
    Running running = started(stop.lines, Area::x);
    running.tick(100);
    EXPECT_EQ(running.phase(Area::x), Phase::idle) << stop.lines;
    EXPECT_FALSE(running.machine.special_contact(8100));
    ASSERT_EQ(running.machine.codes.size(), 1u) << stop.lines;
    EXPECT_EQ(running.machine.codes[0], (std::array<int, 3>{stop.code, 1500 + stop.step, 0})) << stop.lines;
    EXPECT_EQ(std::count(running.machine.log.begin(), running.machine.log.end(), "X: ended"), 0);
  }
}

TEST(Super40ncStep, RunsOffItsEndWithACode) {
  Running running = started("JMP K1;END;LAB K1;END", Area::x);
  running.codes[1] = StepCode(AreaProgram{0, {{Op::nop, {}}}});
  running.tick();
  EXPECT_EQ(running.machine.codes.at(0), (std::array<int, 3>{1, 1501, 0}));
}

TEST(Super40ncStep, AnErrorOfNumbersDoesNotStopIt) {
  Running running = started("DIV K1 K0 D0;SET Y0", Area::x);
  running.tick();
  EXPECT_TRUE(running.machine.contact(y(0)));
  EXPECT_EQ(running.machine.codes.at(0), (std::array<int, 3>{8, 1500, 0}));
}

TEST(Super40ncStep, WaitsForContactsAndTimes) {
  Running running = started("WAT M50;WTN M50;SET Y0;TMR K0;TMR D3;SET Y1");
  running.machine.write(d(3), 4);
  running.tick(5);
  EXPECT_EQ(running.programs().awaited(Area::c), m(50));
  running.machine.set(m(50), true);
  running.tick(5);
  EXPECT_FALSE(running.machine.contact(y(0)));
  running.machine.set(m(50), false);
  running.tick();
  EXPECT_TRUE(running.machine.contact(y(0)));
  running.machine.write(d(3), 1);  // is read once
  running.tick(3);
  EXPECT_FALSE(running.machine.contact(y(1)));
  running.tick();
  EXPECT_TRUE(running.machine.contact(y(1)));
}

// --- slices -----------------------------------------------------------------------------------------

TEST(Super40ncStep, ASliceIsSixtyFourLines) {
  std::string lines;
  for (int i = 0; i < 150; ++i) lines += "INC D0;";
  Running running = started(lines);
  for (const int done : {64, 128, 150}) {
    running.tick();
    EXPECT_EQ(running.machine.value(d(0)), done);
  }
}

TEST(Super40ncStep, ASliceDoesNotPartContacts) {
  std::string lines;
  for (int i = 0; i < 63; ++i) lines += "INC D0;";
  Running running = started(lines + "LD X0;ANI X1;CJ K1;SET Y0;LAB K1");
  running.machine.set(x(0), true);
  running.tick();
  EXPECT_EQ(running.state(Area::c).step, 63 + 5);  // has jumped
}

TEST(Super40ncStep, ATakenJumpEndsTheSlice) {
  Running running = started("LAB K1;INC D0;JMP K1");
  running.tick(7);
  EXPECT_EQ(running.machine.value(d(0)), 7);
  EXPECT_EQ(running.machine.log.size(), 1u);
}

TEST(Super40ncStep, MotionsEndTheSliceEvenWhenNothingMoves) {
  for (const char* line : {"LIN K0", "CW K1 K1 K1 K1", "DRV K0", "HOM K1", "MRK K0", "VDRV K0"}) {
    Running running = started(std::string(line) + ";SET Y0");
    for (const char* word : {"LIN", "CW", "DRV", "HOM", "MRK", "VDRV"})
      running.machine.answers[word] = Begun::done;
    running.tick();
    EXPECT_FALSE(running.machine.contact(y(0))) << line;
    running.tick();
    EXPECT_TRUE(running.machine.contact(y(0))) << line;
  }
  for (const char* line : {"VDRV K5", "MPG K5", "PSET K0", "ABSC", "STR K0"}) {
    Running running = started(std::string(line) + ";SET Y0");
    running.tick();
    EXPECT_TRUE(running.machine.contact(y(0))) << line;
  }
}

TEST(Super40ncStep, ALaterProgramThatIsStartedRunsInTheSameTick) {
  Running running("AREA C\nSTR K1\nEND\nAREA X\nINC D0\nSTR *\nEND\n");
  running.start(Area::c);
  running.tick();
  EXPECT_EQ(running.machine.value(d(0)), 1);
  EXPECT_EQ(running.phase(Area::c), Phase::executing);  // an earlier one at the next tick
}

TEST(Super40ncStep, StartsDoNothingToWhatRuns) {
  Running running = started("STR *;LAB K1;INC D0;JMP K1");
  running.tick(3);
  EXPECT_EQ(running.machine.value(d(0)), 3);
  EXPECT_EQ(std::count(running.machine.log.begin(), running.machine.log.end(), "C: starts"), 1);
}

TEST(Super40ncStep, AStopOfItselfEndsIt) {
  Running running = started("STP K1;SET Y0", Area::x);
  running.tick(2);
  EXPECT_EQ(running.phase(Area::x), Phase::idle);
  EXPECT_FALSE(running.machine.contact(y(0)));
  EXPECT_EQ(running.state(Area::x).step, 0);
}

// --- requests of motion lines -----------------------------------------------------------------------

struct Asked {
  const char* lines;
  const char* asked;
  Area area = Area::c;
};

TEST(Super40ncStep, MotionLinesAskForWhatTheirFieldsSay) {
  constexpr Asked kAsked[] = {
      // unset fields
      {"LIN K1 * K-3", "LIN 1 * -3 * F10000"},
      {"LIN * * * *", ""},
      {"F K500;LIN * * * D0", "LIN * * * 0 F500"},
      {"INCC;LIN K5;ABSC;LIN K6", "LIN 5 * * * relative F10000; LIN 6 * * * F10000"},
      {"CW * * K7 K8", "CW YZ * * around 7 8 F10000"},
      {"XYP;CCW K1 * K12", "CCW XY 1 * around 12 0 F10000"},
      {"XZP;CW K1 K2", "CW XZ 1 2 around 0 0 F10000"},
      {"YZP;CW * * * K9;", "CW YZ * * around 0 9 F10000"},
      {"CW * * * *", ""},
      {"XYP;C3P K1 K2 K3 K4", "C3P XY 1 2 to 3 4 F10000"},
      {"C3P K1 * * K4", "C3P YZ 1 * to * 4 F10000"},
      {"C3P *", ""},
      {"CWR K1 K2 K-3", "CWR YZ 1 2 R-3 F10000"},
      {"INCC;CCWR * K2 D0", "CCWR YZ * 2 R0 relative F10000"},
      {"DRV K1 * K3", "DRV 1 * 3 * at 100,300"},
      {"RPM K7 * K9;DRV K1 K2 K3", "DRV 1 2 3 * at 7,200,9"},
      {"CHK K0;DRV K1", "DRV 1 * * * at 100"},  // void in C
      {"DRV *", ""},
      {"HOM K1 * K1 K0", "HOM 5"},
      {"HOM K0 K0", ""},
      {"MPG K2 * K-10 K0", "MPG 2 * -10 0"},
      {"MRK * K5", "MRK * 5 * * at 200"},
      {"INCC;MRK K-5", "MRK -5 * * * relative at 100"},
      {"VDRV K100 K-5", "VDRV 100 -5 * *"},
      {"PSET K1 * D0", "PSET 1 * 0 *"},
      {"MSET * K4", "MSET * 4 * *"},
      {"PSET *", ""},
      {"PJG K1;MJG K1", ""},
      // axis programs: the first field, their own axis
      {"DRV K5", "DRV 5 * * * at 100", Area::x},
      {"DRV K5 K6", "DRV * 5 * * at 200", Area::y},
      {"DRV * K5", "", Area::y},
      {"RPM * K500;DRV K1", "DRV * * 1 * at 300", Area::z},
      {"RPM K500;DRV K1", "DRV * * 1 * at 500", Area::z},
      {"CHK K0;DRV K1;CHK K1;DRV K2", "DRV * * * 1 at 400 unwaited; DRV * * * 2 at 400", Area::u},
      {"HOM K1", "HOM 8", Area::u},
      {"HOM K0 K1", "", Area::u},
      {"MPG K-3", "MPG -3 * * *", Area::x},
      {"MRK K3", "MRK * 3 * * at 200", Area::y},
      {"VDRV K-9", "VDRV * * -9 *", Area::z},
      {"PSET K1 K2 K3 K4", "PSET 1 2 3 4", Area::x},
  };
  for (const Asked& row : kAsked) EXPECT_EQ(asked_by(row.lines, row.area), row.asked) << row.lines;
}

TEST(Super40ncStep, VoidLinesSaySo) {
  Running running = started("PJG K1;CHK K0;MJG K1");
  running.tick();
  EXPECT_EQ(running.machine.codes, (std::vector<std::array<int, 3>>{{2, 0, 0}, {2, 4, 0}, {2, 5, 0}}));
}

TEST(Super40ncStep, FreshStartsLoadModesAndOthersKeepThem) {
  Running running = started("INCC;F K7;XZP;RPM K5;CHK K0;WAT X0;DRV K1;LAB K9;WAT X1", Area::c);
  running.tick();
  EXPECT_EQ(running.machine.registers[8006], 7);
  EXPECT_EQ(running.machine.registers[8007], 1);
  running.take(Event::contact_off, Area::c);
  running.start(Area::c);
  running.machine.set(x(0), true);
  running.tick();
  EXPECT_EQ(asked(running), "DRV 1 * * * relative at 5");
  running.take(Event::stop, Area::c);
  running.machine.registers[named::kTargetsOfC] = 1;
  running.start(Area::c);
  EXPECT_EQ(running.state(Area::c).targets, Targets::relative);
  EXPECT_EQ(running.state(Area::c).rpm[0], 100);
  EXPECT_EQ(running.machine.registers[8006], 10000);
  EXPECT_EQ(running.machine.registers[8007], 2);
}

TEST(Super40ncStep, AxisProgramsHaveTheirOwnModes) {
  Running running("AREA X\nWAT X0\nEND\nAREA Y\nWAT X0\nEND\n");
  running.machine.registers[9273] = 1;
  running.start(Area::x);
  running.start(Area::y);
  EXPECT_EQ(running.state(Area::x).targets, Targets::absolute);
  EXPECT_EQ(running.state(Area::y).targets, Targets::relative);
}

// --- whose axes -------------------------------------------------------------------------------------

TEST(Super40ncStep, C21SaysWhoseAxesAre) {
  for (int owned = 0; owned <= 4; ++owned) {
    Running running = started("LIN K1 K1 K1 K1;XZP;CW K1 K1 K1 K1;DRV K2 * K2");
    running.machine.registers[named::kOwnedAxes] = owned;
    running.tick(50);
    std::string expected;
    if (owned > 0) {
      expected = "LIN";
      for (int i = 0; i < 4; ++i) expected += i < owned ? " 1" : " *";
      expected += " F10000; ";
      if (owned >= 3) expected += "CW XZ 1 1 around 1 1 F10000; ";
      expected += owned >= 3 ? "DRV 2 * 2 * at 100,300" : "DRV 2 * * * at 100";
    }
    EXPECT_EQ(asked(running), expected) << owned;
    EXPECT_EQ(running.phase(Area::c), Phase::idle);
    const std::size_t voids = owned == 4 ? 0 : owned == 3 ? 1 : 3;
    EXPECT_EQ(running.machine.codes.size(), voids) << owned;
    for (const auto& code : running.machine.codes) EXPECT_EQ(code[0], 16);
    for (const Area area : {Area::x, Area::y, Area::z, Area::u}) {
      Running axis = started("DRV K1", area);
      axis.machine.registers[named::kOwnedAxes] = owned;
      axis.tick(20);
      EXPECT_EQ(asked(axis).empty(), axis_of(area) < owned);
    }
  }
}

TEST(Super40ncStep, AProgramMayBeStoppedForWhatIsNotItsOwn) {
  Options options;
  options.choose(option("c21_zero", "stops_the_program"));
  Running running = started("DRV K1;SET Y0", Area::c, options);
  running.machine.registers[named::kOwnedAxes] = 0;
  running.tick(5);
  EXPECT_EQ(running.phase(Area::c), Phase::idle);
  EXPECT_FALSE(running.machine.contact(y(0)));
}

TEST(Super40ncStep, WaitsForAnAxisThatIsTaken) {
  Running running = started("DRV K1;SET Y0");
  running.machine.answers["DRV"] = Begun::taken;
  running.tick(5);
  EXPECT_EQ(running.phase(Area::c), Phase::waiting);
  EXPECT_EQ(running.programs().quiet_ms(Area::c), 0);
  running.machine.answers.clear();
  running.tick();
  EXPECT_EQ(running.phase(Area::c), Phase::moving);
}

TEST(Super40ncStep, ContinuesBehindAVoidMotionAndEndsAtARefusedOne) {
  Running running = started("DRV K1;SET Y0;LIN K1;SET Y1");
  running.machine.answers = {{"DRV", Begun::ignored}, {"LIN", Begun::refused}};
  running.tick(3);
  EXPECT_TRUE(running.machine.contact(y(0)));
  EXPECT_FALSE(running.machine.contact(y(1)));
  EXPECT_EQ(running.phase(Area::c), Phase::idle);
  EXPECT_FALSE(running.machine.special_contact(8000));
}

TEST(Super40ncStep, DecidesByTheContactBeforeEveryLine) {
  Running running = started("SET Y0;RST M8000;SET Y1");
  running.tick(3);
  EXPECT_TRUE(running.machine.contact(y(0)));
  EXPECT_FALSE(running.machine.contact(y(1)));
  EXPECT_EQ(running.phase(Area::c), Phase::paused);
  EXPECT_EQ(running.state(Area::c).step, 2);
}

/// Held motion is dropped when the step is written, and a start has nothing to continue.
TEST(Super40ncStep, AWrittenStepDropsWhatIsHeld) {
  Running running = started("LIN K1000;SET Y0;TMR K500");
  running.machine.motion_ticks = 50;
  running.tick(2);
  running.take(Event::hold, Area::c);
  EXPECT_EQ(running.phase(Area::c), Phase::held);
  running.programs().set_step(Area::c, 4);
  EXPECT_EQ(running.phase(Area::c), Phase::paused);
  EXPECT_EQ(running.machine.log.back(), "C: drop");
  running.start(Area::c);
  running.tick();
  const auto& log = running.machine.log;
  EXPECT_EQ(std::count(log.begin(), log.end(), "C: go on"), 0);
  EXPECT_TRUE(running.machine.contact(y(0)));
}

TEST(Super40ncStep, AnEmptyProgramEndsAtOnce) {
  Running running("AREA C\n");
  running.machine.special.insert(8000);
  running.tick();
  EXPECT_FALSE(running.machine.special_contact(8000));
  EXPECT_TRUE(running.machine.log.empty());
  EXPECT_TRUE(running.machine.codes.empty());
}

// --- quiet ticks ------------------------------------------------------------------------------------

TEST(Super40ncStep, SkipsTicksAsIfItHadRunThem) {
  const std::string lines = "LAB K1;TMR K37;INC D0;WAT M0;DRV K1;JMP K1";
  Running one = started(lines, Area::x);
  Running other = started(lines, Area::x);
  int skipped = 0;
  for (int ms = 0; ms < 3000;) {
    if (ms % 100 == 0) {
      for (Running* running : {&one, &other}) running->machine.set(m(0), ms % 200 == 0);
    }
    one.tick();
    other.tick();
    ++ms;
    ASSERT_EQ(one.steps, other.steps) << ms;
    const bool moves = other.machine.left.at(1) > 0;
    const std::int64_t room = moves ? 0 : (ms + 99) / 100 * 100 - ms;
    const std::int64_t quiet = std::min(other.programs().quiet_ms(Area::x), room);
    if (quiet <= 0) continue;
    other.programs().fast_forward(Area::x, quiet);
    one.tick(static_cast<int>(quiet));
    ms += static_cast<int>(quiet);
    skipped += static_cast<int>(quiet);
    ASSERT_EQ(one.steps, other.steps) << ms;
    ASSERT_EQ(one.machine.memory, other.machine.memory) << ms;
  }
  EXPECT_GT(skipped, 2000);
}

}  // namespace step_test
}  // namespace understudy::interpreter::super_40nc
