// What a scan does with command contacts, in this order: emergency, resets, STOP keys, M8008, ZERO SET, HOME,
// ZERO, jog, hand-wheel. Levels that stay ON after they were void, or after a stop, need to go OFF first.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include "emulator/models/super_40nc/axis_state.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/keys.h"
#include "emulator/models/super_40nc/manual_motions.h"
#include "emulator/models/super_40nc/marks.h"
#include "emulator/models/super_40nc/names.h"
#include "emulator/models/super_40nc/options.h"
#include "emulator/models/super_40nc/ownership.h"
#include "emulator/models/super_40nc/registers.h"
#include "emulator/models/super_40nc/row_words.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/events.h"

namespace understudy::emulator::models::super_40nc {

namespace language = interpreter::super_40nc;

namespace {

constexpr int kWheelContacts[] = {m8x::kMpg1, m8x::kMpg10, m8x::kMpg100};
constexpr WheelSource kWheelSources[] = {WheelSource::contact_1, WheelSource::contact_10,
                                         WheelSource::contact_100};

/// All contacts that a scan reads.
constexpr auto kCommandContacts = [] {
  constexpr int kGeneral[] = {m8::kStartOfC,          m8::kSingleStep,         m8::kEmergencyStop,
                              m8::kMotionInhibit,     m8::kMCodeFinished,      m8::kPause,
                              m8::kFactoryParameters, m85::kParameterPageLeft, m85::kEditPageLeft,
                              m85::kEditPageEntered};
  constexpr int kOfEachAxis = m8x::kMpg100 - m8x::kStart + 1;
  std::array<int, std::size(kGeneral) + kAxisCount * kOfEachAxis + kKeys.size()> all{};
  std::size_t next = 0;
  for (const int number : kGeneral) all[next++] = number;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    for (int i = 0; i < kOfEachAxis; ++i) all[next++] = of_axis(m8x::kStart + i, axis);
  }
  for (const Key& key : kKeys) all[next++] = key.contact;
  return all;
}();

}  // namespace

bool Super40nc::is_on(int contact_number) const {
  return state_.contacts.on(contact_number, contact(contact_number));
}
bool Super40nc::rises(int contact_number) const {
  return state_.contacts.rose(contact_number, contact(contact_number));
}

bool Super40nc::is_stopped_by_emergency() const {
  return is_on(m8::kEmergencyStop) || (state_.emergency && !chose(option("cemg_input", "only_shown")));
}

bool Super40nc::is_held_in_reset(int axis) const {
  return is_stopped_by_emergency() || is_on(of_axis(m8x::kReset, axis)) || is_pressed(KeyDoes::stop, axis);
}

bool Super40nc::is_inhibited(int axis) const { return is_held_in_reset(axis) || is_on(m8::kMotionInhibit); }

std::optional<ManualMotion> Super40nc::manual_motion(int axis_number) const {
  const AxisState& state = axis(axis_number);
  const bool is_by_order = state.order != 0;
  const bool is_behind_end = state.mover < Mover::plc && !state.awaited;
  if (state.mover < Mover::plc && state.awaited) return std::nullopt;
  switch (state.holder) {
    case Activity::nobody:
    case Activity::rest: return std::nullopt;
    case Activity::jog: return state.asked_by_plc ? ManualMotion::plc_jog : ManualMotion::jog;
    case Activity::home: return is_by_order ? ManualMotion::home_by_order : ManualMotion::home;
    case Activity::zero: return is_by_order ? ManualMotion::zero_by_order : ManualMotion::zero;
    case Activity::move:
    case Activity::vdrv:
    case Activity::wheel: break;
  }
  if (is_behind_end)
    return state.mover == Mover::c ? ManualMotion::behind_end_of_c : ManualMotion::behind_end;
  if (state.holder != Activity::wheel) return ManualMotion::plc_drive;
  return state.wheel == WheelSource::selector ? ManualMotion::selected_wheel : ManualMotion::wheel;
}

void Super40nc::handle(int axis, ManualEvent event, Code code) {
  const std::optional<ManualMotion> motion = manual_motion(axis);
  if (motion) handle(axis, *motion, event, code);
}

/// Applies the table of manual_motions.h.
void Super40nc::handle(int axis, ManualMotion motion, ManualEvent event, Code code) {
  switch (answer_of(motion, event)) {
    case ManualAnswer::goes_on: break;
    case ManualAnswer::slows:
      release_jog(axis,
                  motion == ManualMotion::plc_jog ? &AxisState::asked_by_plc : &AxisState::asked_by_contact);
      break;
    case ManualAnswer::ends: {
      const bool is_stopped =
          event == ManualEvent::stop || event == ManualEvent::stop_of_c || event == ManualEvent::main_stop;
      is_stopped ? stop_by_command(axis) : stop_axis(axis, code);
      break;
    }
  }
}

bool Super40nc::has_errors_for_a_scan() const {
  const bool has_one = std::any_of(state_.axes.begin(), state_.axes.end(),
                                   [](const AxisState& axis) { return axis.has_error; });
  return has_one && chose(option("serr_clears", "one_scan"));
}

/// While the emergency lasts, resets a program, or pauses an axis program at its line.
void Super40nc::stop_by_emergency(language::Area area, bool is_new) {
  const language::Phase phase = state_.steps.programs[language::index_of(area)].phase;
  const bool pauses =
      area != language::Area::c && chose(option("emergency_of_axis_programs", "they_pause_at_their_line"));
  if (!pauses || (is_new && phase == language::Phase::held)) return tell(language::Event::emergency, area);
  if (!is_new) return;
  tell(language::Event::limit_pauses, area);  // the motion of its line is over
  tell(language::Event::hold, area);          // its wait, or its lines
}

void Super40nc::obey_stops() {
  using language::Area;
  using language::Event;
  if (has_errors_for_a_scan()) {
    for (AxisState& each : state_.axes) each.has_error = false;  // the scan has seen it
  }
  if (is_stopped_by_emergency()) {
    const Code code = is_on(m8::kEmergencyStop) ? Code::emergency_stop : Code::emergency_input;
    const bool is_new = code == Code::emergency_stop ? rises(m8::kEmergencyStop) : !state_.emergency_obeyed;
    if (is_new) report(code);
    for (int number = 0; number < kAxisCount; ++number) {
      if (axis(number).holder == Activity::nobody) continue;
      manual_motion(number) ? handle(number, ManualEvent::emergency, code) : stop_axis(number, code);
      if (code == Code::emergency_input) axis(number).has_error = true;
      give_erc_behind(number, code);
    }
    give_up_orders();
    for (const language::AreaRow& row : language::kAreas) {
      if (row.area != Area::plc) stop_by_emergency(row.area, is_new);
    }
  }
  state_.emergency_obeyed = state_.emergency;
  for (int number = 0; number < kAxisCount; ++number) {
    const bool is_reset = is_on(of_axis(m8x::kReset, number));
    if (is_reset) take_off(axis(number), MarkEvent::reset);
    if (is_reset) tell(Event::reset, language::area_of_axis(number));
    if (!is_pressed(KeyDoes::stop, number)) continue;
    tell(Event::stop, language::area_of_axis(number));
    set_contact(of_axis(m8x::kStart, number), false);  // also cancels a start in the same scan
  }
  if (is_pressed(KeyDoes::stop_c, -1)) {
    for (int number = 0; number < kAxisCount; ++number) handle(number, ManualEvent::main_stop);
    give_up_orders();
    tell(Event::stop, Area::c);
    set_contact(m8::kStartOfC, false);
  }
  if (rises(m8::kPause)) {
    tell(Event::hold, Area::c);
    const bool ends = chose(option("manual_motion_events", "end_by_a_ramp"));
    for (int number = 0; number < kAxisCount && ends; ++number) slow_by_hand(number);
  }
  for (int number = 0; number < kAxisCount; ++number) {
    if (!is_pressed(KeyDoes::pause, number)) continue;
    tell(Event::hold, language::area_of_axis(number));
    const Activity holder = axis(number).holder;
    const bool is_manual = holder == Activity::jog || holder == Activity::home || holder == Activity::zero;
    if (is_manual && chose(option("pause_manual", "ends_it_by_a_ramp"))) slow_by_hand(number);
  }
}

/// PAUSE and M8006: slow down motion by hand, if that is chosen.
void Super40nc::slow_by_hand(int axis_number) {
  if (manual_motion(axis_number)) end_by_ramp(axis_number, Mover::hand);
}

/// Executes what the panel triggers when it turns its pages.
void Super40nc::obey_pages() {
  if (rises(m85::kParameterPageLeft)) {
    const bool renews_all = chose(option("parameter_moment", "when_m8500_rises"));
    if (renews_all) {
      take_parameters();
      apply_all_axis_parameters();
    }
    if (renews_all || chose(option("page_contacts", "m8500_renews_x14_and_c0"))) take_power_up_parameters();
  }
  const bool stops = chose(option("page_contacts", "m8507_stops_the_plc"));
  if (rises(m85::kEditPageEntered) && stops && state_.plc.runs) plc_to_stop();
  const bool runs = !chose(option("m8501_runs_plc", "nothing"));
  if (rises(m85::kEditPageLeft) && runs && state_.run_switch && !state_.plc.runs) plc_to_run();
}

bool Super40nc::acts_behind_reset(int axis) const {
  return state_.were_held[static_cast<std::size_t>(axis)] && chose(option("level_after_stop", "act_at_once"));
}

/// Returns true for a level that has stayed ON through a stop, if a choice makes it act.
bool Super40nc::is_level_again(int axis, int contact) const {
  return is_on(contact) && acts_behind_reset(axis);
}

void Super40nc::obey_jogs(int axis) {
  for (const int direction : {+1, -1}) {
    const int contact = of_axis(direction > 0 ? m8x::kJogPlus : m8x::kJogMinus, axis);
    const bool asks = rises(contact) || is_level_again(axis, contact);
    if (asks && !is_inhibited(axis)) start_jog(axis, direction, &AxisState::asked_by_contact);
  }
  const int contact = of_axis(chip(axis).last_direction > 0 ? m8x::kJogPlus : m8x::kJogMinus, axis);
  if (!is_on(contact)) handle(axis, ManualMotion::jog, ManualEvent::contact_off);
}

void Super40nc::obey_wheel() {
  for (int number = 0; number < kAxisCount; ++number) {
    for (std::size_t i = 0; i < std::size(kWheelContacts); ++i) {
      const int contact = of_axis(kWheelContacts[i], number);
      const bool asks = rises(contact) || is_level_again(number, contact);
      if (asks && !is_inhibited(number)) start_wheel(number, kWheelSources[i]);
      if (axis(number).wheel == kWheelSources[i] && !is_on(contact)) handle(number, ManualEvent::contact_off);
    }
  }
  if (!state_.wheel_selected) return;
  state_.wheel_selected = false;
  const std::int32_t selected = registers().raw(kept_d(d8::kUserCommand)) - 1;
  for (int number = 0; number < kAxisCount; ++number) {
    const bool is_left = number != selected && axis(number).wheel == WheelSource::selector;
    if (is_left) handle(number, ManualEvent::contact_off);
  }
  if (selected >= 0 && selected < kAxisCount && !is_inhibited(selected) && !is_wheel_locked(selected)) {
    start_wheel(selected, WheelSource::selector);
  }
}

void Super40nc::obey_contacts() {
  obey_stops();
  obey_pages();
  const bool needs_rest = chose(option("m8008_running", "void"));
  if (rises(m8::kFactoryParameters) && !(needs_rest && programs_are_busy())) reset_parameters();
  for (int number = 0; number < kAxisCount; ++number) {
    if (rises(of_axis(m8x::kZeroSet, number))) set_zero(number);
  }
  for (int number = 0; number < kAxisCount; ++number) {
    if (rises(of_axis(m8x::kHome, number)) && !is_inhibited(number)) start_home(number);
  }
  for (int number = 0; number < kAxisCount; ++number) {
    if (rises(of_axis(m8x::kZero, number)) && !is_inhibited(number)) start_zero(number);
  }
  obey_order_keys();
  for (int number = 0; number < kAxisCount; ++number) obey_jogs(number);
  obey_wheel();
  if (!chose(option("m8005_falls", "by_a_write_alone"))) set_contact(m8::kMCodeFinished, false);
  hold_while_inhibited();
  for (int number = 0; number < kAxisCount; ++number) {
    state_.were_held[static_cast<std::size_t>(number)] = is_held_in_reset(number);
  }
  if (!chose(option("edge_contacts_fall", "when_served"))) return;
  for (const int contact : {m8::kPause, m8::kFactoryParameters}) set_contact(contact, false);
  for (int number = 0; number < kAxisCount; ++number) {
    for (const int contact : {m8x::kHome, m8x::kZero, m8x::kZeroSet})
      set_contact(of_axis(contact, number), false);
  }
}

/// M8004: holds running motions of programs and the PLC like a pause, if that is chosen.
void Super40nc::hold_while_inhibited() {
  const bool is_inhibited_now = is_on(m8::kMotionInhibit);
  const bool has_changed = is_inhibited_now != state_.was_inhibited;
  state_.was_inhibited = is_inhibited_now;
  if (!has_changed || !chose(option("m8004_scope", "running_ones_are_held"))) return;
  if (is_inhibited_now) {
    hold_path();
    for (int number = 0; number < kAxisCount; ++number) {
      const Activity holder = axis(number).holder;
      if ((holder == Activity::move || holder == Activity::vdrv) && !is_on_path(number)) hold_axis(number);
    }
    return;
  }
  // Except those that a pause holds as well.
  const auto is_paused = [&](Mover mover) {
    return mover < Mover::plc && state_.steps.programs[static_cast<std::size_t>(mover)].machine_holds;
  };
  if (!is_paused(Mover::c)) go_on_path();
  for (int number = 0; number < kAxisCount; ++number) {
    if (!is_on_path(number) && !is_paused(axis(number).mover)) go_on_axis(number);
  }
}

void Super40nc::see_contacts() {
  state_.touched = false;
  for (const int number : kCommandContacts) {
    const bool level = contact(number);
    // A contact that was ON for this scan only falls in the next one.
    if (!level && is_on(number)) state_.touched = true;
    state_.contacts.see(number, level);
  }
}

}  // namespace understudy::emulator::models::super_40nc
