// Brings axis A into each phase of each mode, and triggers each event of transitions.h.
#pragma once

#include <numeric>

#include "emulator/device/axes.h"
#include "emulator/models/simple2_r3/device.h"
#include "emulator/models/simple2_r3/transitions.h"
#include "tests/emulator/models/simple2_r3/one_simple2.h"

namespace understudy::emulator::models::simple2_r3 {

inline constexpr int kAlarmInput = 0;
inline constexpr int kUpperInput = 2;
inline constexpr int kLowerInput = 3;
inline constexpr int kHomeInput = 4;
inline constexpr Value kVelocity_mrpm = 20'000;  // one pulse per millisecond
inline constexpr Value kOtherVelocity_mrpm = 10'000;
inline constexpr Value kDuty = 50;
inline constexpr Value kOtherDuty = 30;
inline constexpr Value kDistance = 200;

using Pulses = std::vector<std::int64_t>;

inline std::int64_t sum(const Pulses& pulses) {
  return std::accumulate(pulses.begin(), pulses.end(), std::int64_t{0});
}

/// Axis A, always at one pulse per millisecond, with an encoder that the test turns.
class Rig : public OneSimple2 {
 public:
  explicit Rig(const Given& given) : OneSimple2(given) {
    for (const char* name :
         {"DIN0_Aaxis_Alarm", "DIN2_Aaxis_UP_Limit", "DIN3_Aaxis_DN_Limit", "DIN4_Aaxis_Home"})
      set(name, 1);
    set("Aaxis_Resoultion", 3000);
    set("Axis_VelMode_ACC", 32768);
    set("Axis_GoHome_DIR", 1);
    set("Aaxis_Home_Speed", 20);
    set("Aaxis_SVON", 1);
    run_to(10);
  }

  const AxisState& axis() { return static_cast<const Simple2R3&>(device()).state().axes[0]; }

  /// Returns the pulses of each tick.
  Pulses watch(Tick ticks) {
    Pulses pulses;
    for (Tick i = 0; i < ticks; ++i) {
      turned_ += turns;
      device().axes()->set_encoder(0, turned_);
      const Value before = coordinate('A');
      OneSimple2::run(1);
      pulses.push_back(coordinate('A') - before);
    }
    return pulses;
  }

  void move(Value pulses, Value dec_10ms = 1) {
    set_move('A', pulses, 20, 1, dec_10ms);
    set("Aaxis_Move_INC", 1);
  }

  std::int64_t turns = 0;  // counts per tick

 private:
  std::int64_t turned_ = 0;
};

// --- phases ------------------------------------------------------------------------------------------

inline void begin_position(Rig& rig, Phase phase) {
  if (phase == Phase::leaving) rig.input(kUpperInput, true);
  rig.watch(5);
  switch (phase) {
    case Phase::moving:
    case Phase::at_limit: rig.move(100'000); break;
    case Phase::slowing: rig.move(1000, 100); break;
    case Phase::leaving: rig.move(-100'000); break;
    default: break;
  }
  rig.watch(phase == Phase::slowing ? 700 : 100);
}

inline void begin_homing(Rig& rig, Phase phase) {
  rig.set("Aaxis_Home_AccTime", phase == Phase::slowing ? 50 : 1);
  rig.set("Aaxis_GoHome", 1);
  rig.watch(600);
  if (phase == Phase::slowing) rig.input(kHomeInput, true);
  if (phase == Phase::leaving) rig.input(kUpperInput, true);
  rig.watch(50);
}

inline void begin_velocity(Rig& rig, Phase phase) {
  if (phase == Phase::leaving) rig.input(kUpperInput, true);
  rig.watch(5);
  rig.set("Aaxis_DirectmRPM", phase == Phase::leaving ? -kVelocity_mrpm : kVelocity_mrpm);
  rig.watch(500);
  if (phase == Phase::standing) rig.set("Aaxis_DirectmRPM", 0);
  if (phase == Phase::slowing) rig.set("Aaxis_DirectmRPM", 5000);
  if (phase == Phase::turning) rig.set("Aaxis_DirectmRPM", -kVelocity_mrpm);
  rig.watch(phase == Phase::standing ? 500 : 50);
}

inline void begin_sync(Rig& rig, Phase phase) {
  if (phase == Phase::slowing) rig.set("Axis_SyncSlope", 1);
  if (phase == Phase::leaving) rig.input(kUpperInput, true);
  rig.watch(5);
  rig.set("Aaxis_SyncMode", 1);
  rig.turns = phase == Phase::standing ? 0 : phase == Phase::leaving ? -1 : phase == Phase::slowing ? 10 : +1;
  rig.watch(300);
  if (phase == Phase::slowing) rig.turns = 0;
  rig.watch(20);
}

inline void bring_into(Rig& rig, Activity activity, Phase phase) {
  switch (activity) {
    case Activity::position: begin_position(rig, phase); break;
    case Activity::homing: begin_homing(rig, phase); break;
    case Activity::velocity: begin_velocity(rig, phase); break;
    case Activity::pwm:
      rig.set("Aaxis_DirectPWM", phase == Phase::standing ? 0 : kDuty);
      rig.watch(10);
      break;
    case Activity::sync: begin_sync(rig, phase); break;
  }
  if (phase == Phase::at_limit) rig.input(kUpperInput, true);
  if (phase == Phase::in_alarm) rig.input(kAlarmInput, true);
  if (phase == Phase::servo_off) rig.set("Aaxis_SVON", 0);
  rig.watch(5);
}

// --- events ------------------------------------------------------------------------------------------

/// Returns the input that an event changes.
inline int input_of(Phase phase, Event event) {
  if (event == Event::alarm || event == Event::alarm_gone) return kAlarmInput;
  if (event == Event::limit_gone) return kUpperInput;
  if (event == Event::limit_behind) return kLowerInput;
  return phase == Phase::leaving || phase == Phase::at_limit ? kLowerInput : kUpperInput;
}

inline void cause(Rig& rig, Phase phase, Event event) {
  switch (event) {
    case Event::limit_ahead:
    case Event::limit_behind:
    case Event::alarm: return rig.input(input_of(phase, event), true);
    case Event::limit_gone:
    case Event::alarm_gone: return rig.input(input_of(phase, event), false);
    case Event::stop: return rig.set("Aaxis_STOP", 1);
    case Event::servo_off: return rig.set("Aaxis_SVON", 0);
    case Event::move_towards: return rig.move(kDistance);
    case Event::move_away: return rig.move(-kDistance);
    case Event::move_nowhere: return rig.move(0);
    case Event::home: return rig.set("Aaxis_GoHome", 1);
    case Event::velocity_towards: return rig.set("Aaxis_DirectmRPM", kOtherVelocity_mrpm);
    case Event::velocity_away: return rig.set("Aaxis_DirectmRPM", -kOtherVelocity_mrpm);
    case Event::velocity_zero: return rig.set("Aaxis_DirectmRPM", 0);
    case Event::pwm: return rig.set("Aaxis_DirectPWM", kOtherDuty);
    case Event::pwm_zero: return rig.set("Aaxis_DirectPWM", 0);
    case Event::sync: rig.turns = rig.turns != 0 ? rig.turns : -1; return rig.set("Aaxis_SyncMode", 1);
  }
}

// --- cells -------------------------------------------------------------------------------------------

using Choices = std::map<std::string, std::string>;

/// Calls `visit` for each cell of a mode, with the default options and with each option that changes the
/// cell. Returns the number of cells.
template <class Visit>
int for_each_cell(Activity activity, Visit visit) {
  int cells = 0;
  for (int p = 0; p < kPhases; ++p) {
    for (int e = 0; e < kEvents; ++e) {
      const auto phase = static_cast<Phase>(p);
      const auto event = static_cast<Event>(e);
      if (!is_phase_of(activity, phase) || !can_come(phase, event)) continue;
      ++cells;
      SCOPED_TRACE("mode " + std::to_string(static_cast<int>(activity)) + ", phase " + std::to_string(p) +
                   ", event " + std::to_string(e));
      const Transition& row = *reaction_row(activity, phase, event);
      Choices choices;
      // With this option, the servo can be off in these modes.
      if (phase == Phase::servo_off && activity != Activity::position) choices["mode_after_stop"] = "stays";
      visit(phase, event, choices, row.outcome);
      for (const OtherOutcome& other : {row.other, row.another}) {
        if (!other.exists) continue;
        const ChoiceRow& choice = kChoices[other.chosen.choice];
        const std::string id(choice.id);
        const std::string name(options_of(choice)[other.chosen.number]);
        SCOPED_TRACE(id + ": " + name);
        Choices otherwise = choices;
        otherwise[id] = name;
        visit(phase, event, otherwise, other.outcome);
      }
    }
  }
  return cells;
}

/// Clears everything that inhibits motion.
inline void free(Rig& rig) {
  for (const int input : {kAlarmInput, kUpperInput, kLowerInput}) rig.input(input, false);
}

}  // namespace understudy::emulator::models::simple2_r3
