// The marks of a command on its axis, in every cell of transitions.h: the event clears what marks.h says for
// its outcome, and after a STOP an axis that moves equals one that has never moved.
#include "emulator/models/simple2_r3/marks.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/emulator/models/simple2_r3/reaction_rig.h"

namespace understudy::emulator::models::simple2_r3 {
namespace marks_test {

using IsOff = std::array<bool, kAxisMarks.size()>;
IsOff marks_of(const AxisState& axis) {
  IsOff off{};
  for (std::size_t i = 0; i < off.size(); ++i) off[i] = kAxisMarks[i].is_off(axis);
  return off;
}

/// Whether an outcome sets a mark again, of itself: a command's, or the speed of an axis that turns.
bool sets(std::string_view mark, Event event, Outcome outcome) {
  if (outcome == Outcome::turns) return mark == "speed_urpm" || mark == "velocity_phase";
  if (outcome != Outcome::begins) return false;
  switch (event) {
    case Event::move_towards:
    case Event::move_away:
    case Event::home: return mark == "command";
    case Event::velocity_towards:
    case Event::velocity_away:
      return mark == "mode" || mark == "target_urpm" || mark == "speed_urpm" || mark == "velocity_phase";
    case Event::velocity_zero:
    case Event::sync:
    case Event::pwm_zero: return mark == "mode";
    case Event::pwm: return mark == "mode" || mark == "pwm_percent";
    default: return false;
  }
}

/// An outcome that leaves an axis alone. A homing that turns keeps its command.
bool changes_nothing(Outcome outcome) { return outcome == Outcome::continues || outcome == Outcome::dropped; }

void expect_marks(Rig& rig, Event event, Outcome outcome, const IsOff& before) {
  for (std::size_t i = 0; i < kAxisMarks.size(); ++i) {
    const AxisMark& mark = kAxisMarks[i];
    const bool is_off = mark.is_off(rig.axis());
    if (sets(mark.name, event, outcome)) continue;
    if (has(mark.taken_off_by, outcome)) {
      EXPECT_TRUE(is_off) << mark.name;
    } else if (changes_nothing(outcome) && mark.name != "velocity_phase") {
      EXPECT_EQ(is_off, before[i]) << mark.name;
    }
  }
}

/// Ticks of a move from rest, and that it is one.
Tick ticks_of_a_move(Rig& rig) {
  const Value before = rig.coordinate('A');
  rig.move(kDistance);
  const Tick ticks = rig.run_while_moving('A');
  EXPECT_EQ(rig.coordinate('A'), before + kDistance);
  return ticks;
}

void expect_stopped(Rig& rig, Tick ticks_of_move) {
  rig.turns = 0;
  free(rig);
  rig.watch(5);
  rig.set("Aaxis_STOP", 1);
  rig.watch(2000);  // by its ramp, where that is chosen
  for (const AxisMark& mark : kAxisMarks) {
    const bool stays = mark.name == "mode" && rig.get("Aaxis_Mode") != 0;  // by choice
    EXPECT_TRUE(stays || mark.is_off(rig.axis())) << mark.name;
  }
  rig.set("Aaxis_SVON", 1);
  EXPECT_EQ(rig.watch(20), Pulses(20)) << "nothing waits";
  EXPECT_EQ(static_cast<const Simple2R3&>(rig.device()).state().kept[0], KeptCommand{});
  if (rig.get("Aaxis_Mode") == 0) {
    EXPECT_EQ(ticks_of_a_move(rig), ticks_of_move);
  }
}

void walk(Activity activity) {
  Rig fresh({});
  const Tick ticks_of_move = ticks_of_a_move(fresh);
  const int cells =
      for_each_cell(activity, [&](Phase phase, Event event, const Choices& choices, Outcome outcome) {
        Rig rig({.choices = choices});
        bring_into(rig, activity, phase);
        if (phase == Phase::in_alarm && event == Event::limit_gone) {
          rig.input(kUpperInput, true);
          rig.watch(5);
        }
        const IsOff before = marks_of(rig.axis());
        cause(rig, phase, event);
        rig.watch(2);
        expect_marks(rig, event, outcome, before);
        expect_stopped(rig, ticks_of_move);
      });
  EXPECT_GT(cells, 30);
}

TEST(Simple2Marks, OfPositionMode) { walk(Activity::position); }
TEST(Simple2Marks, OfHoming) { walk(Activity::homing); }
TEST(Simple2Marks, OfVelocityMode) { walk(Activity::velocity); }
TEST(Simple2Marks, OfPwmMode) { walk(Activity::pwm); }
TEST(Simple2Marks, OfSyncMode) { walk(Activity::sync); }

/// A row clears its own member and no other; which outcomes clear it is tried above.
TEST(Simple2Marks, ARowClearsItsOwnMemberAlone) {
  for (const AxisMark& mark : kAxisMarks) {
    AxisState axis;
    axis.mode = Mode::velocity;
    axis.command = Command::homing;
    axis.target_urpm = axis.speed_urpm = axis.velocity_phase = 7;
    axis.pwm_percent = 7;
    mark.take_off(axis);
    for (const AxisMark& each : kAxisMarks)
      EXPECT_EQ(each.is_off(axis), &each == &mark) << mark.name << ", " << each.name;
  }
}

// --- a command that waits for SVON -------------------------------------------------------------------------

struct Way {
  const char* name;
  void (*act)(Rig& rig);
  bool takes_off;
};
constexpr Way kWays[] = {
    {"nothing", [](Rig&) {}, false},
    {"a limit that is left",
     [](Rig& rig) {
       rig.input(kLowerInput, true);
       rig.watch(5);
       rig.input(kLowerInput, false);
     },
     false},
    {"an alarm that is over",
     [](Rig& rig) {
       rig.input(kAlarmInput, true);
       rig.watch(5);
       rig.input(kAlarmInput, false);
     },
     false},
    {"STOP", [](Rig& rig) { rig.set("Aaxis_STOP", 1); }, true},
    {"SVOFF", [](Rig& rig) { rig.set("Aaxis_SVON", 0); }, true},
    {"PWM at once", [](Rig& rig) { rig.set("Aaxis_DirectPWM", kDuty); }, true},
    {"PWM of 0 at once", [](Rig& rig) { rig.set("Aaxis_DirectPWM", 0); }, true},
    {"a move of nothing", [](Rig& rig) { rig.move(0); }, true},
    {"velocity 0", [](Rig& rig) { rig.set("Aaxis_DirectmRPM", 0); }, true},
    {"the factory's reset", [](Rig& rig) { rig.set("Factory_Reset", 1); }, true},
    {"power",
     [](Rig& rig) {
       rig.world().switch_power(0, false);
       rig.world().switch_power(0, true);
     },
     true},
};

TEST(Simple2Marks, ACommandThatWaitsForTheServoIsTakenOff) {
  for (const Event event :
       {Event::move_away, Event::home, Event::velocity_towards, Event::velocity_away, Event::sync}) {
    for (const Way& way : kWays) {
      SCOPED_TRACE(std::string(way.name) + ", event " + std::to_string(static_cast<int>(event)));
      Rig rig({.choices = {{"command_while_servo_off", "kept_until_servo_on"},
                           {"pwm_servo", "not_needed"},
                           {"mode_after_stop", "stays"}}});
      rig.set("Aaxis_SVON", 0);
      rig.watch(5);
      cause(rig, Phase::standing, event);
      rig.watch(5);
      way.act(rig);
      rig.watch(5);
      rig.set("Aaxis_SVON", 1);
      EXPECT_EQ(sum(rig.watch(300)) == 0, way.takes_off);
    }
  }
}

}  // namespace marks_test
}  // namespace understudy::emulator::models::simple2_r3
