// The marks of a motion, a search, a key or a program are gone when it ends, in any way: every motion with
// every way to end, followed by a DRV that must show its FSH for its time.
#include <gtest/gtest.h>

#include <algorithm>

#include "emulator/models/super_40nc/axis/marks.h"
#include "emulator/world/snapshot.h"
#include "tests/emulator/models/super_40nc/one_super40nc.h"

namespace understudy::emulator::models::super_40nc {
namespace marks_test {

constexpr Tick kFinishTicks = 20;

/// M10 to M12 move X through the PLC, M20 to M22 are STP of X and of C, and the DRV checks that everything
/// still works.
const std::string kPlc =
    "AREA PLC\nLD M10\nPJG K1\nLDP M11\nHOM K1\nLDP M12\nDRV K900000\nLD M20\nSTP K1\nLD M21\nSTP\nLDP M22\n"
    "INCC\nDRV K1000\nEND\n";
/// C ends what X does, if it has nothing else to do.
const std::string kEndsX = "AREA C\nVDRV K0\nEND\n";

struct Motion {
  const char* name;
  std::string program;  // besides the PLC's
  const char* contact;  // that starts it
  bool stays;           // ON as long as it should continue
  std::vector<std::pair<std::string, Value>> first{};
};

const std::vector<Motion>& motions() {
  static const std::vector<Motion> all{
      {"jog", kEndsX, "M8103", true},
      {"jog back", kEndsX, "M8104", true},
      {"jog key", kEndsX, "M8560", true},
      {"PJG", kEndsX, "M10", true},
      {"home", kEndsX, "M8105", false},
      {"home key", kEndsX, "M8568", false},
      {"home by order", kEndsX, "M8592", false, {{"D9199", 1}, {"D9299", 2}}},
      {"HOM of the PLC", kEndsX, "M11", false},
      {"HOM of X", kEndsX + "AREA X\nHOM K1\nEND\n", "M8100", true},
      {"HOM of C", "AREA C\nHOM K1 K1\nEND\n", "M8000", true},
      {"zero", kEndsX, "M8106", false, {{"D8117", 900000}}},
      {"zero by order", kEndsX, "M8593", false, {{"D8117", 900000}, {"D9184", 1}, {"D9284", 2}}},
      {"wheel", kEndsX, "M8108", true},
      {"MPG of X", kEndsX + "AREA X\nMPG K5\nTMR K30000\nEND\n", "M8100", true},
      {"DRV of the PLC", kEndsX, "M12", false},
      {"DRV of X", kEndsX + "AREA X\nDRV K900000\nEND\n", "M8100", true},
      {"DRV of C", "AREA C\nDRV K900000 K90000\nEND\n", "M8000", true},
      {"DRV beside the lines", kEndsX + "AREA X\nCHK K0\nDRV K900000\nTMR K30000\nEND\n", "M8100", true},
      {"VDRV of X", kEndsX + "AREA X\nVDRV K300\nTMR K30000\nEND\n", "M8100", true},
      {"VDRV of C", "AREA C\nVDRV K300\nTMR K30000\nEND\n", "M8000", true},
      {"MRK of X", kEndsX + "AREA X\nMRK K900000\nEND\n", "M8100", true, {{"D9190", 5000}}},
      {"MRK without its way", kEndsX + "AREA X\nMRK K900000\nEND\n", "M8100", true, {{"D9190", 0}}},
      {"LIN", "AREA C\nF K9000\nLIN K900000 K90000\nEND\n", "M8000", true},
      {"LIN with backlash",
       "AREA C\nF K9000\nLIN K-900000 K90000\nEND\n",
       "M8000",
       true,
       {{"D9156", 900}, {"D9157", 2}}},
      {"arc", "AREA C\nF K9000\nXYP\nCCW K0 K0 K90000 K0\nEND\n", "M8000", true}};
  return all;
}

using Act = void (*)(OneSuper40nc& one);
struct WayOut {
  const char* name;
  Act act;
};

void pulse(OneSuper40nc& one, std::string_view contact) { one.press(contact); }
void pulse_input(OneSuper40nc& one, std::string_view terminal) {
  one.input(terminal, 1);
  one.run(3);
  one.input(terminal, 0);
  one.run(3);
}
void pause(OneSuper40nc& one) {
  pulse(one, "M8588");
  pulse(one, "M8006");
  one.run(300);
}
void write(OneSuper40nc& one, std::string_view name, Value value) { one.set(name, value); }

const WayOut kWaysOut[] = {
    {"its end", [](OneSuper40nc& one) { one.run(20); }},
    {"M8102", [](OneSuper40nc& one) { pulse(one, "M8102"); }},
    {"M8002", [](OneSuper40nc& one) { pulse(one, "M8002"); }},
    {"CEMG", [](OneSuper40nc& one) { pulse_input(one, "CEMG"); }},
    {"STOP of X", [](OneSuper40nc& one) { pulse(one, "M8584"); }},
    {"STOP of C", [](OneSuper40nc& one) { pulse(one, "M8596"); }},
    {"STP of X", [](OneSuper40nc& one) { pulse(one, "M20"); }},
    {"STP of C", [](OneSuper40nc& one) { pulse(one, "M21"); }},
    {"VDRV 0 of C", [](OneSuper40nc& one) { pulse(one, "M8000"); }},
    {"paused and reset",
     [](OneSuper40nc& one) {
       pause(one);
       pulse(one, "M8102");
     }},
    {"paused and stopped by C",
     [](OneSuper40nc& one) {
       pause(one);
       pulse(one, "M8596");
     }},
    {"paused and on again",
     [](OneSuper40nc& one) {
       pause(one);
       one.set("M8000", 1);
       one.set("M8100", 1);
       one.run(20);
     }},
    {"paused, and its pointer moved",
     [](OneSuper40nc& one) {
       pause(one);
       write(one, "D8000", 0);
       write(one, "D8100", 0);
     }},
    {"paused, and power off",
     [](OneSuper40nc& one) {
       pause(one);
       one.world().switch_power(0, false);
       one.world().switch_power(0, true);
       one.run(2);
     }},
    {"+EL", [](OneSuper40nc& one) { pulse_input(one, "X1"); }},
    {"-EL", [](OneSuper40nc& one) { pulse_input(one, "X2"); }},
    {"paused on +EL, and on again",
     [](OneSuper40nc& one) {
       pause(one);
       one.input("X1", 1);
       one.set("M8000", 1);
       one.set("M8100", 1);
       one.run(3);
       one.input("X1", 0);
     }},
    {"a soft limit",
     [](OneSuper40nc& one) {
       write(one, "D8144", -900000);
       one.run(3);
       write(one, "D8144", 90000000);
     }},
    {"ALM", [](OneSuper40nc& one) { pulse_input(one, "ALM_X"); }},
    {"a comparator by its number",
     [](OneSuper40nc& one) {
       for (const auto& [name, value] :
            {std::pair{"D9139", 5}, std::pair{"D9140", 5}, std::pair{"D9141", 2}, std::pair{"D8146", 1}}) {
         write(one, name, value);
       }
       one.run(60);
       write(one, "D9141", 0);
     }},
    {"M8004 and M8102",
     [](OneSuper40nc& one) {
       write(one, "M8004", 1);
       one.run(20);
       pulse(one, "M8102");
       write(one, "M8004", 0);
     }},
    {"another program", [](OneSuper40nc& one) { one.it().load_program("AREA X\nEND\nAREA C\nEND\n"); }},
    {"another PLC", [](OneSuper40nc& one) { one.it().load_program(kPlc); }},
    {"another file",
     [](OneSuper40nc& one) {
       write(one, "D9001", 1);
       one.run(3);
     }},
    {"M8008", [](OneSuper40nc& one) { pulse(one, "M8008"); }},
    {"PLC_RUN off",
     [](OneSuper40nc& one) {
       one.input("PLC_RUN", 0);
       one.run(3);
       one.input("PLC_RUN", 1);
       one.run(3);
     }},
    {"power off",
     [](OneSuper40nc& one) {
       one.world().switch_power(0, false);
       one.world().switch_power(0, true);
       one.run(2);
     }},
    {"another order",
     [](OneSuper40nc& one) {
       for (const char* other : {"M8105", "M8106", "M8103", "M12", "M8592", "M8593"}) pulse(one, other);
     }},
    {"a state from a file", [](OneSuper40nc& one) {
       const world::WorldState state = world::save(one.world());
       one.run(5);
       world::restore(one.world(), state);
       pulse(one, "M8102");
     }}};

bool is_idle(const OneSuper40nc& one) {
  const auto& programs = one.it().state().steps.programs;
  const bool is_at_rest = std::all_of(programs.begin(), programs.end(), [](const auto& program) {
    return program.phase == interpreter::super_40nc::Phase::idle;
  });
  return is_at_rest && !one.on("M8120") && !one.on("M8220");
}

/// Contacts go OFF, and anything that did not end this way is stopped.
bool comes_to_rest(OneSuper40nc& one, const Motion& motion) {
  one.set(motion.contact, 0);
  write(one, "D8020", 0);
  one.run(400);
  for (const char* stop : {"M8102", "M8202", "M8596"}) {
    if (!is_idle(one)) pulse(one, stop);
  }
  one.run(400);
  return is_idle(one);
}

void expect_unmarked(OneSuper40nc& one) {
  const State& state = one.it().state();
  for (int number = 0; number < kAxisCount; ++number) {
    for (const AxisMark& mark : kAxisMarks) {
      const bool is_looked_at =
          is_taken_off_by(mark, MarkEvent::motion_ends) || is_taken_off_by(mark, MarkEvent::path_ends);
      if (!is_looked_at) continue;
      EXPECT_TRUE(mark.is_off(state.axes[static_cast<std::size_t>(number)])) << mark.name;
    }
  }
  EXPECT_FALSE(state.path.engaged);
  EXPECT_FALSE(state.path_is_held);
  EXPECT_EQ(state.homing_by_key, OrderKey{});
  EXPECT_EQ(state.zeroing_by_key, OrderKey{});
  EXPECT_EQ(state.plc.jogs, interpreter::super_40nc::Jogs{});
  for (const auto& program : state.steps.programs) {
    EXPECT_FALSE(program.machine_holds || program.waits_to_resume || program.is_paused_by_key);
    EXPECT_TRUE(program.calls.empty());
  }
}

/// Returns for how many ticks Y0 is ON, at the end of a DRV that nothing prevents.
Tick shown_finish(OneSuper40nc& one) {
  const Value before = one.get("D8140");
  one.set("M22", 1);
  Tick shown = 0;
  for (int tick = 0; tick < 600; ++tick) {
    one.run(1);
    if (one.on("Y0")) ++shown;
  }
  one.set("M22", 0);
  EXPECT_EQ(one.get("D8140"), before + 1000);
  return shown;
}

TEST(Super40ncMarks, EveryWayOutOfEveryMotionTakesThemOff) {
  for (const Motion& motion : motions()) {
    for (const WayOut& way : kWaysOut) {
      SCOPED_TRACE(std::string(motion.name) + ", " + way.name);
      const bool is_of_c = std::string(motion.contact) == "M8000";
      OneSuper40nc one(
          {.set = {{"D9003", is_of_c ? 4 : 0}, {"D9191", kFinishTicks}}, .program = kPlc + motion.program});
      for (const auto& [name, value] : motion.first) one.set(name, value);
      one.run(2);
      one.set(motion.contact, 1);
      one.run(1);
      if (!motion.stays) one.set(motion.contact, 0);
      one.run(60);
      EXPECT_TRUE(one.on("M8120")) << "it does not move";
      way.act(one);
      ASSERT_TRUE(comes_to_rest(one, motion));
      expect_unmarked(one);
      one.run(2 * kFinishTicks);
      one.set("D9191", kFinishTicks);  // M8008 has made it 0
      one.set("D9157", 0);
      EXPECT_EQ(shown_finish(one), kFinishTicks);
    }
  }
}

/// The marks of a start are cleared by the next one, and by nothing else.
TEST(Super40ncMarks, EachIsTakenOffByItsEventsAlone) {
  for (const AxisMark& mark : kAxisMarks) {
    for (int number = 0; number <= static_cast<int>(MarkEvent::plc_run); ++number) {
      const auto event = static_cast<MarkEvent>(number);
      AxisState axis;
      axis.holder = Activity::move;
      axis.asked_by_contact = axis.asked_by_plc = axis.awaited = axis.shows_finish = axis.is_held = true;
      axis.has_ended = axis.has_error = axis.stands_on_target = true;
      axis.mover = axis.stop_awaited_by = Mover::c;
      axis.rest.kind = RestKind::mark;
      axis.order = 2;
      axis.wheel = WheelSource::selector;
      axis.path_backlash = axis.arc_backlash = 7;
      EXPECT_FALSE(mark.is_off(axis)) << mark.name;
      take_off(axis, event);
      EXPECT_EQ(mark.is_off(axis), is_taken_off_by(mark, event)) << mark.name << ", event " << number;
    }
  }
}

/// A held motion that can no longer continue, because of a limit, resets its program as if it had reached the
/// limit.
TEST(Super40ncMarks, ALimitInAPauseResetsTheProgramThatContinues) {
  struct Case {
    const char* area;
    const char* line;
    const char* limit;
    int axis;
  };
  for (const Case& each : {Case{"X", "DRV K900000", "X1", 1}, Case{"U", "VDRV K300\nTMR K9000", "X10", 4},
                           Case{"X", "CHK K0\nDRV K900000\nTMR K9000", "X1", 1}}) {
    SCOPED_TRACE(each.line);
    OneSuper40nc one({.program = std::string("AREA ") + each.area + "\n" + each.line + "\nINC D5\nEND\n"});
    const std::string of_axis = std::to_string(each.axis);
    one.set("M8" + of_axis + "00", 1);
    one.run(60);
    one.press("M85" + std::to_string(87 + each.axis));
    one.run(600);
    one.input(each.limit, 1);
    one.run(2);
    one.set("M8" + of_axis + "00", 1);
    one.run(5);
    EXPECT_FALSE(one.on("M8" + of_axis + "00"));
    EXPECT_FALSE(one.on("M8" + of_axis + "20"));
    EXPECT_EQ(one.get("D8" + of_axis + "00"), 0);
    EXPECT_EQ(one.get("D8094"), 11);
    EXPECT_EQ(one.get("D5"), 0);
  }
}

}  // namespace marks_test
}  // namespace understudy::emulator::models::super_40nc
