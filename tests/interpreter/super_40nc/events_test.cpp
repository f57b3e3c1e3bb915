// Each event in each phase of step programs: every cell, for C and for an axis program, compared with a table
// from the manual, not with ours.
#include "interpreter/super_40nc/events.h"

#include <gtest/gtest.h>

#include "tests/interpreter/super_40nc/running.h"

namespace understudy::interpreter::super_40nc {
namespace events_test {

constexpr Phase kPhases[] = {Phase::idle,    Phase::executing, Phase::moving, Phase::homing,
                             Phase::waiting, Phase::paused,    Phase::held};

/// A program of an area in a phase: it has a motion, a home search and a wait, and the right contact.
Running in_phase(Area area, Phase phase) {
  const char* line = phase == Phase::homing ? "HOM K1" : phase == Phase::waiting ? "WAT X40" : "DRV K100";
  Running running("AREA " + std::string(row_of(area).name) + "\n" + line + "\nSET Y9\nEND\n");
  running.machine.registers[named::kOwnedAxes] = area == Area::c ? 4 : 0;
  running.machine.motion_ticks = 1000000;
  if (phase != Phase::idle) running.start(area);
  if (phase == Phase::paused) running.take(Event::contact_off, area);
  if (phase != Phase::idle && phase != Phase::executing && phase != Phase::paused) running.tick();
  if (phase == Phase::held) running.take(Event::hold, area);
  EXPECT_EQ(running.phase(area), phase);
  running.machine.log.clear();
  return running;
}

/// The cell of the manual, or of the choice: the next phase, and the calls to the machine.
struct Cells {
  Event event;
  // I E M H W P Q; "-": nothing changes. A letter: the phase, followed by "stop", "hold", "go on", "starts"
  // or "drop".
  const char* cells[7];
};
constexpr Cells kCells[] = {
    {Event::start, {"E starts", "-", "-", "-", "-", "E starts", "M starts go on"}},
    {Event::contact_off, {"-", "P", "-", "-", "P", "-", "-"}},  // a motion ends first
    {Event::hold, {"-", "P hold", "Q hold", "Q hold", "Q hold", "P hold", "-"}},
    {Event::stop, {"I stop", "I stop", "I stop", "I stop", "I stop", "I stop", "I stop"}},
    {Event::reset, {"I stop", "I stop", "I stop", "I stop", "I stop", "I stop", "I stop"}},
    {Event::emergency, {"I stop", "I stop", "I stop", "I stop", "I stop", "I stop", "I stop"}},
    {Event::broken, {"-", "-", "I", "I", "-", "-", "I"}},
    {Event::plc_stop, {"-", "-", "-", "-", "-", "-", "-"}},
    {Event::plc_run, {"I", "-", "-", "-", "-", "I", "I drop"}},
    {Event::limit_pauses, {"-", "-", "P", "P", "-", "-", "-"}},  // and the same line again
};

Phase phase_of(char letter) { return kPhases[std::string("IEMHWPQ").find(letter)]; }

TEST(Super40ncEvents, AllCellsAreTheManuals) {
  for (const Area area : {Area::c, Area::x}) {
    for (const Cells& row : kCells) {
      for (std::size_t i = 0; i < std::size(kPhases); ++i) {
        Running running = in_phase(area, kPhases[i]);
        const StepState before = running.state(area);
        const bool was_on = running.machine.special_contact(row_of(area).run_contact);
        running.take(row.event, area);
        const std::string cell = row.cells[i];
        const std::string where = std::string(row_of(area).name) + " event " +
                                  std::to_string(static_cast<int>(row.event)) + " phase " + "IEMHWPQ"[i];
        std::string reported;
        for (const std::string& line : running.machine.log) reported += line.substr(line.find(':') + 1);
        const bool is_on = running.machine.special_contact(row_of(area).run_contact);
        if (cell == "-") {
          EXPECT_EQ(running.state(area), before) << where;
          EXPECT_EQ(is_on, was_on) << where;
          EXPECT_EQ(reported, "") << where;
          continue;
        }
        EXPECT_EQ(running.phase(area), phase_of(cell[0])) << where;
        EXPECT_EQ(reported, cell.substr(1)) << where;
        const bool runs = cell[0] == 'E' || cell[0] == 'M';
        EXPECT_EQ(is_on, runs) << where;
        StepState cleared;  // except for its modes
        cleared.has_modes = running.state(area).has_modes;
        cleared.rpm = running.state(area).rpm;
        EXPECT_EQ(running.state(area) == cleared, cell[0] == 'I') << where;
      }
    }
  }
}

/// M8000 := 0 while its line moves or searches home: the motion ends first.
TEST(Super40ncEvents, ContactOffLetsAMotionEnd) {
  for (const Phase phase : {Phase::moving, Phase::homing}) {
    Running running = in_phase(Area::c, phase);
    running.machine.special.erase(8000);
    running.tick(3);
    EXPECT_EQ(running.phase(Area::c), phase);
    running.machine.left = {};
    running.tick();
    EXPECT_EQ(running.phase(Area::c), Phase::paused);
    EXPECT_FALSE(running.programs().shows_pausing());
    running.tick(3);
    EXPECT_FALSE(running.machine.contact(y(9)));
    running.machine.special.insert(8000);
    running.tick(2);
    EXPECT_TRUE(running.machine.contact(y(9)));
  }
}

TEST(Super40ncEvents, AStartCallsOffAPauseThatIsDue) {
  Running running = in_phase(Area::c, Phase::moving);
  running.machine.special.erase(8000);
  running.tick();
  running.start(Area::c);  // STR
  running.machine.left = {};
  running.tick();
  EXPECT_TRUE(running.machine.contact(y(9)));
}

TEST(Super40ncEvents, APausedWaitStandsAndContinues) {
  for (const Event event : {Event::contact_off, Event::hold}) {
    Running running("AREA X\nTMR K10\nSET Y1\nEND\n");
    running.start(Area::x);
    running.tick(5);  // the first reaches it
    running.take(event, Area::x);
    running.tick(100);
    EXPECT_EQ(running.state(Area::x).left_ms, 6);
    running.start(Area::x);
    EXPECT_EQ(running.phase(Area::x), Phase::waiting);
    running.tick(5);
    EXPECT_FALSE(running.machine.contact(y(1)));
    running.tick();
    EXPECT_TRUE(running.machine.contact(y(1)));
  }
}

TEST(Super40ncEvents, M8022IsForPausesByKeyInC) {
  Running running = in_phase(Area::c, Phase::moving);
  EXPECT_FALSE(running.programs().shows_pausing());
  running.take(Event::hold, Area::c);
  EXPECT_TRUE(running.programs().shows_pausing());
  running.start(Area::c);
  EXPECT_FALSE(running.programs().shows_pausing());
  running.take(Event::hold, Area::c);
  running.take(Event::stop, Area::c);
  EXPECT_FALSE(running.programs().shows_pausing());
  Running axis = in_phase(Area::x, Phase::held);
  EXPECT_FALSE(axis.programs().shows_pausing());
}

TEST(Super40ncEvents, SingleStepEndsBehindEachMotion) {
  Running running("AREA C\nSET Y0\nDRV K1\nSET Y1\nRPM K5\nDRV K1\nDRV K0 K0\nEND\n");
  running.machine.registers[named::kOwnedAxes] = 1;
  running.machine.special = {8001};
  running.start(Area::c);
  running.tick(10);
  EXPECT_EQ(running.phase(Area::c), Phase::paused);
  EXPECT_EQ(running.state(Area::c).step, 5);
  EXPECT_FALSE(running.machine.special_contact(8000));
  EXPECT_FALSE(running.machine.contact(y(1)));
  running.start(Area::c);
  running.tick(10);
  EXPECT_EQ(running.state(Area::c).step, 14);
  running.machine.special.insert(8000);  // as a host
  running.machine.special.erase(8001);
  running.tick(10);
  EXPECT_EQ(running.phase(Area::c), Phase::idle);
}

TEST(Super40ncEvents, SingleStepPausesAtOnceBehindADrvThatIsNotWaitedFor) {
  Running running("AREA Y\nCHK K0\nDRV K1\nVDRV K5\nPSET K0\nEND\n");
  running.machine.registers[named::kOwnedAxes] = 0;
  running.machine.special = {8201};
  running.start(Area::y);
  running.tick();
  EXPECT_EQ(running.state(Area::y).step, 5);
  EXPECT_EQ(running.phase(Area::y), Phase::paused);
  EXPECT_GT(running.machine.left.at(2), 0);  // continues
  running.start(Area::y);
  running.tick();
  EXPECT_EQ(running.state(Area::y).step, 9);
}

TEST(Super40ncEvents, ContinuousStartsAfreshAtEnd) {
  for (const int contact : {8007, 8600}) {
    Running running("AREA C\nINC D0\nINCC\nEND\nAREA X\nINC D1\nEND\n");
    running.machine.special = {contact};
    running.start(Area::c);
    running.start(Area::x);
    running.tick(5);
    EXPECT_EQ(running.machine.value(d(0)), 5);
    EXPECT_EQ(running.machine.value(d(1)), 1);  // C only
    EXPECT_EQ(running.state(Area::c).targets, Targets::absolute);
    EXPECT_TRUE(running.machine.special_contact(8000));
    EXPECT_EQ(std::count(running.machine.log.begin(), running.machine.log.end(), "C: ended"), 5);
  }
}

TEST(Super40ncEvents, NothingStartsWhileHeldInReset) {
  Running running("AREA X\nSET Y0\nEND\n");
  running.machine.held_in_reset.insert(Area::x);
  running.machine.special.insert(8100);
  running.tick();
  EXPECT_FALSE(running.machine.special_contact(8100));
  EXPECT_EQ(running.phase(Area::x), Phase::idle);
  running.machine.held_in_reset.clear();
  running.tick(5);  // needs a new start
  EXPECT_FALSE(running.machine.contact(y(0)));
}

TEST(Super40ncEvents, AStopOfAnAxisResetsCThatMovesIt) {
  Running running = in_phase(Area::c, Phase::moving);
  running.machine.lost = one(Area::c);
  running.take(Event::stop, Area::x);
  EXPECT_EQ(running.phase(Area::c), Phase::idle);
  EXPECT_FALSE(running.machine.special_contact(8000));
}

TEST(Super40ncEvents, MotionInhibitLetsMotionsWait) {
  Running running("AREA X\nTMR K3\nVDRV K0\nMPG K2\nSET Y0\nDRV K1\nSET Y1\nEND\n");
  running.machine.registers[named::kOwnedAxes] = 0;
  running.machine.special.insert(8004);
  running.machine.answers["VDRV"] = Begun::done;
  running.machine.answers["MPG"] = Begun::done;
  running.start(Area::x);
  running.tick(10);
  EXPECT_TRUE(running.machine.contact(y(0)));  // neither the delay nor a stop waits
  EXPECT_EQ(running.phase(Area::x), Phase::waiting);
  running.machine.special.erase(8004);
  running.tick();
  EXPECT_EQ(running.phase(Area::x), Phase::moving);
  running.machine.special.insert(8004);  // running ones continue
  running.tick(4);
  EXPECT_TRUE(running.machine.contact(y(1)));
}

TEST(Super40ncEvents, AHeldRestWaitsForMotionInhibit) {
  Running running = in_phase(Area::c, Phase::held);
  running.machine.special.insert(8004);
  running.start(Area::c);
  EXPECT_EQ(running.phase(Area::c), Phase::waiting);
  running.tick(5);
  EXPECT_TRUE(running.machine.holds.contains(Area::c));
  running.take(Event::hold, Area::c);  // a pause meanwhile keeps the rest
  EXPECT_EQ(running.phase(Area::c), Phase::held);
  running.machine.special.erase(8004);
  running.start(Area::c);
  EXPECT_EQ(running.phase(Area::c), Phase::moving);
  EXPECT_FALSE(running.machine.holds.contains(Area::c));
}

TEST(Super40ncEvents, AnotherFileContinuesAtTheSameStep) {
  Running running("AREA C\nTMR K5\nSET Y0\nSET Y1\nEND\n");
  const Program other = program_of("AREA C\nTMR K90\nNOP\nSET Y2\nEND\n");
  running.start(Area::c);
  running.tick(3);
  running.codes[0] = StepCode(*other.area(Area::c));
  running.take(Event::file_changed, Area::c);
  running.tick(3);
  EXPECT_EQ(running.phase(Area::c), Phase::idle);
  EXPECT_TRUE(running.machine.contact(y(2)));
  EXPECT_FALSE(running.machine.contact(y(0)));
  // A step within an instruction of the new one.
  running.start(Area::c);
  running.tick(1);
  running.steps.programs[0].step = 1;
  running.steps.programs[0].phase = Phase::executing;
  running.codes[0] = StepCode(*program_of("AREA C\nMOV K0 D0\nEND\n").area(Area::c));
  running.take(Event::file_changed, Area::c);
  running.tick(1);
  EXPECT_EQ(running.machine.codes.back(), (std::array<int, 3>{1, 1, 0}));
  EXPECT_EQ(running.phase(Area::c), Phase::idle);
}

TEST(Super40ncEvents, AWriteOfTheStepDropsWhatIsHeld) {
  Running running = in_phase(Area::c, Phase::held);
  running.programs().set_step(Area::c, 4);
  EXPECT_EQ(running.machine.log.back(), "C: drop");
  running.start(Area::c);
  running.tick();
  EXPECT_TRUE(running.machine.contact(y(9)));
  Running moving = in_phase(Area::c, Phase::moving);
  moving.programs().set_step(Area::c, 4);
  EXPECT_EQ(moving.programs().step(Area::c), 0);  // ignored
  Running idle = in_phase(Area::x, Phase::idle);
  idle.programs().set_step(Area::x, 2);
  idle.start(Area::x);
  idle.tick();
  EXPECT_EQ(idle.machine.codes.back(), (std::array<int, 3>{1, 1502, 0}));
}

TEST(Super40ncEvents, PlcToRunForgetsAWrittenStep) {
  Running running = in_phase(Area::c, Phase::idle);
  running.programs().set_step(Area::c, 4);
  running.machine.special.insert(8000);  // a start that is due
  running.take(Event::plc_run, Area::c);
  EXPECT_EQ(running.programs().step(Area::c), 0);
  running.tick();
  EXPECT_EQ(running.phase(Area::c), Phase::moving);
}

TEST(Super40ncEvents, AStartElsewhereKeepsTheOldModes) {
  Running running("AREA C\nINCC\nRPM K7\nEND\nDRV K1\nEND\n");
  running.start(Area::c);
  running.tick();
  EXPECT_EQ(running.phase(Area::c), Phase::idle);
  running.programs().set_step(Area::c, 6);
  running.start(Area::c);
  running.tick();
  EXPECT_EQ(running.machine.log.back(), "C: DRV 1 * * * relative at 7");
  Running first("AREA C\nINCC\nRPM K7\nEND\nDRV K1\nEND\n");  // it has none yet
  first.programs().set_step(Area::c, 6);
  first.start(Area::c);
  first.tick();
  EXPECT_EQ(first.machine.log.back(), "C: DRV 1 * * * at 100");
}

/// The calls to the machine about a motion outside the lines, and about the wheel: they are the same.
TEST(Super40ncEvents, MotionsBesideTheLinesFollowTheirRow) {
  for (std::size_t i = 0; i < kOutsideEffects.size(); ++i) {
    const OutsideEffectRow& row = kOutsideEffects[i];
    EXPECT_EQ(static_cast<std::size_t>(row.event), i);
    Running running("AREA X\nCHK K0\nDRV K1\nMPG K1\nWAT X40\nEND\n");
    running.machine.registers[named::kOwnedAxes] = 0;
    running.machine.answers["MPG"] = Begun::done;
    running.start(Area::x);
    running.tick();
    ASSERT_EQ(running.phase(Area::x), Phase::waiting);
    running.machine.log.clear();
    running.take(row.event, Area::x);
    std::string reported;
    for (const std::string& line : running.machine.log) reported += line;
    const bool is_held = row.motion == OutsideEffect::is_held;
    const bool is_stopped = row.motion == OutsideEffect::is_stopped;
    EXPECT_EQ(reported, is_held ? "X: hold" : is_stopped ? "X: stop" : "") << i;
    EXPECT_EQ(row.wheel == OutsideEffect::is_stopped, is_stopped) << i;  // hold() does not affect the wheel
  }
}

}  // namespace events_test
}  // namespace understudy::interpreter::super_40nc
