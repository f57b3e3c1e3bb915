// Every cell of transitions.h on the running device: an axis is brought into the phase, the event occurs, and
// the result is what the cell says; also with each choice that changes the cell.
#include "emulator/models/simple2_r3/transitions.h"

#include <algorithm>

#include "tests/emulator/models/simple2_r3/reaction_rig.h"

namespace understudy::emulator::models::simple2_r3 {
namespace transitions_test {

// --- outcomes ----------------------------------------------------------------------------------------

class Cell {
 public:
  Cell(Activity activity, Phase phase, Event event, const std::map<std::string, std::string>& choices)
      : doing_(activity), phase_(phase), event_(event), rig_(given(choices)), twin_(given(choices)) {
    for (Rig* rig : {&rig_, &twin_}) {
      bring_into(*rig, activity, phase);
      if (phase == Phase::in_alarm && event == Event::limit_gone) {
        rig->input(kUpperInput, true);
        rig->watch(5);
      }
    }
    EXPECT_EQ(static_cast<int>(simple2_r3::activity(rig_.axis())), static_cast<int>(activity))
        << "the initial state of the test";
    // The device tells the slope's end from its middle by nothing: it is moving to it, and reacts alike.
    const bool runs_down = activity == Activity::sync && phase == Phase::slowing;
    if (phase != Phase::servo_off) {
      EXPECT_EQ(static_cast<int>(phase_of(rig_.axis(), rig_.now())),
                static_cast<int>(runs_down ? Phase::moving : phase))
          << "the initial state of the test";
    }
    way_ = heading(rig_.axis());
    cause(rig_, phase, event);
  }

  void expect(Outcome outcome) {
    switch (outcome) {
      case Outcome::continues:
      case Outcome::dropped: return expect_no_difference();
      case Outcome::stops:
      case Outcome::leaves:
      case Outcome::ends:
        expect_nothing();
        EXPECT_EQ(rig_.get("Aaxis_Mode"), outcome == Outcome::stops ? twin_.get("Aaxis_Mode") : 0);
        free(rig_);
        return expect_nothing();
      case Outcome::waits:
        expect_nothing();
        EXPECT_EQ(rig_.get("Aaxis_Mode"), twin_.get("Aaxis_Mode"));
        free(rig_);
        return expect_output();
      case Outcome::turns: return expect_turn();
      case Outcome::slows:
        expect_slowing();
        free(rig_);
        return expect_nothing();
      case Outcome::slows_and_waits:
        expect_slowing();
        free(rig_);
        return expect_output();
      case Outcome::blocked: return expect_blocked();
      case Outcome::resumes: return expect_output();
      case Outcome::kept:
        expect_nothing();
        rig_.set("Aaxis_SVON", 1);
        return expect_beginning();
      case Outcome::begins: return expect_beginning();
      case Outcome::changes: return expect_change();
    }
  }

 private:
  static Given given(const std::map<std::string, std::string>& choices) { return {.choices = choices}; }

  void expect_no_difference() {
    EXPECT_EQ(rig_.watch(200), twin_.watch(200));
    EXPECT_EQ(rig_.get("Aaxis_Mode"), twin_.get("Aaxis_Mode"));
    EXPECT_EQ(pwm_duty(rig_.axis()), pwm_duty(twin_.axis()));
  }

  void expect_nothing() {
    EXPECT_EQ(rig_.watch(300), Pulses(300));
    EXPECT_EQ(pwm_duty(rig_.axis()), 0);
    EXPECT_FALSE(rig_.moving('A'));
  }

  void expect_output() {
    const std::int64_t pulses = sum(rig_.watch(500));
    if (doing_ == Activity::pwm) {
      EXPECT_EQ(pwm_duty(rig_.axis()), event_ == Event::pwm ? kOtherDuty : kDuty);
    } else if (doing_ == Activity::sync) {
      EXPECT_EQ(pulses < 0, rig_.turns < 0);
      EXPECT_EQ(pulses != 0, rig_.turns != 0);
    } else {
      EXPECT_EQ(pulses < 0, wants_down());
      EXPECT_NE(pulses, 0);
    }
  }
  bool wants_down() const {
    if (event_ == Event::velocity_towards) return false;
    return event_ == Event::velocity_away || phase_ == Phase::leaving || phase_ == Phase::turning;
  }

  void expect_turn() {
    const Pulses pulses = rig_.watch(1500);
    for (const std::int64_t now : pulses) ASSERT_LE(now * way_, 0);
    EXPECT_LT(sum(pulses) * way_, 0);
  }

  void expect_slowing() {
    const Pulses pulses = rig_.watch(1500);
    for (const std::int64_t now : pulses) ASSERT_GE(now * way_, 0);
    if (way_ != 0) {
      EXPECT_GT(sum(pulses) * way_, 0);
    }
    EXPECT_EQ(pulses.back(), 0);
    EXPECT_FALSE(rig_.moving('A'));
  }

  /// Nothing that way, whatever the encoder does; the other way it goes, where that is free.
  void expect_blocked() {
    rig_.turns = phase_ == Phase::leaving ? -1 : +1;
    EXPECT_EQ(rig_.watch(200), Pulses(200));
    EXPECT_EQ(rig_.get("Aaxis_Mode"), 3);
    const bool both = phase_ == Phase::leaving || phase_ == Phase::at_limit;
    rig_.turns = -rig_.turns;
    EXPECT_EQ(sum(rig_.watch(200)) == 0, both);
    free(rig_);
    EXPECT_NE(sum(rig_.watch(200)), 0) << "and again";
  }

  void expect_beginning() {
    if (event_ != Event::sync) {
      EXPECT_EQ(rig_.watch(3), Pulses(3)) << "from standstill";
    }
    switch (event_) {
      case Event::move_towards:
      case Event::move_away:
        EXPECT_EQ(rig_.get("Aaxis_Mode"), 0);
        EXPECT_EQ(sum(rig_.watch(400)), event_ == Event::move_towards ? kDistance : -kDistance);
        return;
      case Event::move_nowhere: EXPECT_EQ(rig_.get("Aaxis_Mode"), 0); return expect_nothing();
      case Event::home:
        EXPECT_TRUE(rig_.bit("STATUS.6"));
        EXPECT_NE(sum(rig_.watch(200)), 0);
        return;
      case Event::velocity_towards:
      case Event::velocity_away:
      case Event::velocity_zero: {
        EXPECT_EQ(rig_.get("Aaxis_Mode"), 1);
        const std::int64_t pulses = sum(rig_.watch(500));
        EXPECT_EQ(pulses < 0   ? Event::velocity_away
                  : pulses > 0 ? Event::velocity_towards
                               : Event::velocity_zero,
                  event_);
        return;
      }
      case Event::pwm:
      case Event::pwm_zero:
        EXPECT_EQ(rig_.get("Aaxis_Mode"), 2);
        EXPECT_EQ(pwm_duty(rig_.axis()), event_ == Event::pwm ? kOtherDuty : 0);
        EXPECT_EQ(sum(rig_.watch(200)), 0);
        return;
      default:
        EXPECT_EQ(rig_.get("Aaxis_Mode"), 3);
        // Against a limit that is on it turns in vain.
        EXPECT_EQ(sum(rig_.watch(200)) != 0, phase_ != Phase::at_limit || rig_.turns < 0);
    }
  }

  void expect_change() {
    if (doing_ == Activity::pwm) return expect_beginning();
    if (event_ == Event::move_towards || event_ == Event::move_away) return expect_move_on();
    EXPECT_EQ(sum(rig_.watch(5)) * way_ >= 4, way_ != 0) << "from the present speed";
    rig_.watch(1500);
    const std::int64_t pulses = sum(rig_.watch(100));
    const std::int64_t wanted = event_ == Event::velocity_zero   ? 0
                                : event_ == Event::velocity_away ? -50
                                                                 : 50;
    EXPECT_NEAR(static_cast<double>(pulses), static_cast<double>(wanted), 1);
  }

  /// On by the speed that there is, and to the target: 200 pulses from where the command came.
  void expect_move_on() {
    EXPECT_EQ(rig_.get("Aaxis_Mode"), 0);
    // A pulse a millisecond, or what is left of it where a slope runs down, for 10 ms of ramp.
    const std::int64_t first = sum(rig_.watch(4)) * way_;
    const bool stands = way_ == 0 || phase_ == Phase::at_limit;
    EXPECT_EQ(first, stands ? 0 : std::abs(first));
    EXPECT_EQ(first == 0, stands);
    const std::int64_t target = event_ == Event::move_towards ? kDistance : -kDistance;
    EXPECT_EQ(first * way_ + sum(rig_.watch(600)), target);
    EXPECT_FALSE(rig_.moving('A'));
  }

  Activity doing_;
  Phase phase_;
  Event event_;
  Rig rig_;
  Rig twin_;  // what would have been without the event
  int way_ = 0;
};

void walk(Activity activity) {
  const int cells =
      for_each_cell(activity, [&](Phase phase, Event event, const Choices& choices, Outcome outcome) {
        Cell(activity, phase, event, choices).expect(outcome);
      });
  EXPECT_GT(cells, 30);
}

TEST(Reactions, OfPositionMode) { walk(Activity::position); }
TEST(Reactions, OfHoming) { walk(Activity::homing); }
TEST(Reactions, OfVelocityMode) { walk(Activity::velocity); }
TEST(Reactions, OfPwmMode) { walk(Activity::pwm); }
TEST(Reactions, OfSyncMode) { walk(Activity::sync); }

TEST(Reactions, NameTheirChoicesOrTheManualsSections) {
  for (const Transition& row : transitions::kRows) {
    const bool is_choice = std::any_of(std::begin(kChoices), std::end(kChoices),
                                       [&](const ChoiceRow& choice) { return choice.id == row.source; });
    const std::string_view section = row.source.substr(0, row.source.find(':'));
    const bool is_section = std::any_of(kRegisters.begin(), kRegisters.end(),
                                        [&](const RegisterRow& reg) { return reg.section == section; });
    EXPECT_TRUE(is_choice || is_section || section == "附錄 A" || section == "程式指令列表") << row.source;
    if (row.other.exists) {
      EXPECT_TRUE(is_choice) << row.source << ": a bench with another option must find the row";
    }
  }
}

// --- as it was found ------------------------------------------------------------------------------------

TEST(Reactions, AVelocityIntoALimitNeverRunsTheOther) {
  for (const char* how : {"register", "set", "program"}) {
    Rig rig({});
    rig.input(kUpperInput, true);
    rig.watch(5);
    rig.set("Aaxis_DirectmRPM", -kVelocity_mrpm);
    rig.watch(1000);
    const std::string_view by = how;
    if (by == "register") rig.set("Aaxis_DirectmRPM", kVelocity_mrpm);
    if (by == "set") {
      rig.set("Parms_mRPM1", kVelocity_mrpm);
      rig.set("Aaxis_ParmsDirectmRPM", 1);
    }
    if (by == "program") {
      rig.set("PROG_VAR0", kVelocity_mrpm);
      rig.set("MAIN_LINE0_CMD", 0x84);  // VelmRPM_A VAR0
      rig.set("MAIN_LINE0_DATA1", 32);
      rig.set("PROG_MAIN_RunTime_START", 0);
    }
    rig.watch(1000);
    EXPECT_EQ(rig.watch(100), Pulses(100)) << how;
    rig.input(kUpperInput, false);
    EXPECT_EQ(rig.watch(100), Pulses(100)) << how;
  }
}

TEST(Reactions, ANewPolarityCountsNothing) {
  Rig rig({});
  rig.turns = 10;
  rig.watch(400);
  rig.turns = 0;
  rig.set("ENCA", 100);
  const Value rpm = rig.get("ENCA_RPM");
  rig.set("Axis_ENC_Polarity", 1);
  rig.watch(1);
  EXPECT_EQ(rig.get("ENCA"), 100);
  EXPECT_EQ(rig.get("ENCA_RPM") > 0, rpm > 0);
  rig.turns = 10;
  rig.watch(10);
  EXPECT_EQ(rig.get("ENCA"), 0) << "and edges count in the other direction from now on";
  rig.turns = 0;
  rig.set("Axis_ENC_Polarity", 0);
  rig.watch(1);
  EXPECT_EQ(rig.get("ENCA"), 0);
}

}  // namespace transitions_test
}  // namespace understudy::emulator::models::simple2_r3
