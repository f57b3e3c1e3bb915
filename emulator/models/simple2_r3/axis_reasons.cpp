// Why a command to an axis has no effect, in words: the state of the axis, with the register or the choice
// that decides.
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "emulator/device/model.h"
#include "emulator/device/reasons.h"
#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/axis_view.h"
#include "emulator/models/simple2_r3/transition_tables.h"
#include "emulator/models/simple2_r3/transitions.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

/// The registers that decide whether an axis may move.
struct AxisNames {
  std::string_view axis, servo, mode, alarm, ready, upper_limit, lower_limit, home;
};
constexpr std::array<AxisNames, 2> kNames{
    {{"A", "Aaxis_SVON", "Aaxis_Mode", "DIN0_Aaxis_Alarm", "DIN1_Aaxis_Ready", "DIN2_Aaxis_UP_Limit",
      "DIN3_Aaxis_DN_Limit", "DIN4_Aaxis_Home"},
     {"B", "Baxis_SVON", "Baxis_Mode", "DIN5_Baxis_Alarm", "DIN6_Baxis_Ready", "DIN7_Baxis_UP_Limit",
      "DIN8_Baxis_DN_Limit", "DIN9_Baxis_Home"}}};

std::string_view command_word(Event event) {
  switch (event) {
    case Event::move_towards:
    case Event::move_away:
    case Event::move_nowhere: return "the move";
    case Event::home: return "the homing";
    case Event::velocity_towards:
    case Event::velocity_away:
    case Event::velocity_zero: return "the velocity";
    case Event::pwm:
    case Event::pwm_zero: return "the duty";
    case Event::sync: return "the following of the encoder";
    case Event::limit_ahead:
    case Event::limit_behind:
    case Event::limit_gone:
    case Event::alarm:
    case Event::alarm_gone:
    case Event::stop:
    case Event::servo_off: break;
  }
  return "the command";
}

/// Returns what an axis does with a command instead of executing it; empty if it executes it.
std::string effect_words(Outcome outcome, std::string_view command) {
  const std::string what(command);
  switch (outcome) {
    case Outcome::dropped: return "ignores " + what;
    case Outcome::ends: return "ends its motion and ignores " + what;
    case Outcome::slows: return "slows down and ignores " + what;
    case Outcome::kept: return "keeps " + what + " until its servo is on";
    case Outcome::waits:
    case Outcome::slows_and_waits: return "waits with " + what;
    case Outcome::continues:
    case Outcome::stops:
    case Outcome::leaves:
    case Outcome::turns:
    case Outcome::blocked:
    case Outcome::resumes:
    case Outcome::begins:
    case Outcome::changes: break;
  }
  return "";
}

std::string text_of(std::string_view text) { return std::string(text); }

}  // namespace

void AxisView::say(std::string_view effect, std::string_view why) const {
  setup_.reasons.say(now(),
                     "axis " + text_of(kNames[index()].axis) + " " + text_of(effect) + ": " + text_of(why));
}

std::string AxisView::phase_words(Phase phase) const {
  const AxisNames& names = kNames[index()];
  const auto limit = [&]() -> std::string {
    const bool is_upper = signals().upper_limit(number_);
    return "a limit switch is on (" + text_of(is_upper ? names.upper_limit : names.lower_limit) + ")";
  };
  switch (phase) {
    case Phase::servo_off: return "its servo is off (" + text_of(names.servo) + " = 0)";
    case Phase::in_alarm: return "its alarm is on (" + text_of(names.alarm) + ")";
    case Phase::leaving:
    case Phase::at_limit: return limit();
    case Phase::moving:
    case Phase::slowing:
    case Phase::turning: return "it is moving";
    case Phase::standing: break;
  }
  return "it is in mode " + std::to_string(static_cast<int>(state().mode)) + " (" + text_of(names.mode) + ")";
}

/// Returns the choice that decides a cell: the one whose option applies there, or the cell's source. It is
/// none if the source is a section of the manual.
std::optional<std::size_t> AxisView::deciding_choice(const Transition& row) const {
  for (const OtherOutcome& other : {row.other, row.another})
    if (other.exists && chose(other.chosen)) return other.chosen.choice;
  const auto& choices = setup_.device.model().choices;
  for (std::size_t i = 0; i < choices.size(); ++i)
    if (choices[i].id == row.source) return i;
  return std::nullopt;
}

void AxisView::tell(Event event, Outcome outcome) const {
  const std::string effect = effect_words(outcome, command_word(event));
  if (effect.empty()) return;
  const Phase phase = phase_met(event);
  std::string why = phase_words(phase);
  const Transition* const row = reaction_row(activity(state()), phase, event);
  if (const auto choice = row == nullptr ? std::nullopt : deciding_choice(*row))
    why += "; " + choice_words(setup_, *choice);
  say(effect, why);
}

void AxisView::tell_not_ready(Event event) const {
  say(effect_words(Outcome::dropped, command_word(event)),
      "its Ready input is off (" + text_of(kNames[index()].ready) + "; " +
          choice_words(setup_, option("ready_gates", "yes").choice) + ")");
}

void AxisView::tell_too_fast(Event event) const {
  say(effect_words(Outcome::dropped, command_word(event)),
      "its speed exceeds 100 kHz (" +
          choice_words(setup_, option("pulse_rate_cap", "command_dropped").choice) + ")");
}

void AxisView::tell_no_home() const {
  say(effect_words(Outcome::dropped, command_word(Event::home)),
      "no input is its home (" + text_of(kNames[index()].home) + " = 0; " +
          choice_words(setup_, option("home_unassigned", "dropped").choice) + ")");
}

void AxisView::tell_clears_already() const {
  say("ignores the alarm clear", "the output is still on from the last one (" +
                                     choice_words(setup_, option("aclr_again", "ignored").choice) + ")");
}

void AxisView::tell_refused(Event event) const {
  say(effect_words(Outcome::dropped, command_word(event)), phase_words(phase_met(event)));
}

}  // namespace understudy::emulator::models::simple2_r3
