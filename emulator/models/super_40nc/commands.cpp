// What a scan does with command contacts, in this order: emergency, resets, STOP keys, M8008, ZERO SET, HOME,
// ZERO, jog, hand-wheel. Levels that stay ON after they were void, or after a stop, need to go OFF first.
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include "emulator/models/super_40nc/axis_state.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/keys.h"
#include "emulator/models/super_40nc/options.h"
#include "emulator/models/super_40nc/ownership.h"
#include "emulator/models/super_40nc/registers.h"
#include "emulator/models/super_40nc/row_words.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/events.h"

namespace understudy::emulator::models::super_40nc {

namespace language = interpreter::super_40nc;

namespace {

/// M8x00 + number.
constexpr int of_axis(int axis, int number) { return 8100 + 100 * axis + number; }

constexpr int kRun = 0;
constexpr int kReset = 2;
constexpr int kJogPlus = 3;
constexpr int kJogMinus = 4;
constexpr int kHome = 5;
constexpr int kZero = 6;
constexpr int kZeroSet = 7;
constexpr int kWheelContacts[] = {8, 9, 10};
constexpr WheelSource kWheelSources[] = {WheelSource::contact_1, WheelSource::contact_10,
                                         WheelSource::contact_100};

/// All that a scan looks at.
constexpr auto kCommandContacts = [] {
  constexpr int kGeneral[] = {8000, 8001, 8002, 8004, 8005, 8006, 8008, 8501};
  constexpr int kOfEachAxis = 11;
  std::array<int, std::size(kGeneral) + kAxisCount * kOfEachAxis + kKeys.size()> all{};
  std::size_t next = 0;
  for (const int number : kGeneral) all[next++] = number;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    for (int i = 0; i < kOfEachAxis; ++i) all[next++] = of_axis(axis, i);
  }
  for (const Key& key : kKeys) all[next++] = key.contact;
  return all;
}();

}  // namespace

bool Super40nc::is_on(int number) const { return state_.contacts.on(number, contact(number)); }
bool Super40nc::rises(int number) const { return state_.contacts.rose(number, contact(number)); }

bool Super40nc::is_stopped_by_emergency() const {
  return is_on(8002) || (state_.emergency && !chose(option("cemg_input", "only_shown")));
}

bool Super40nc::is_held_in_reset(int number) const {
  return is_stopped_by_emergency() || is_on(of_axis(number, kReset)) || is_pressed(KeyDoes::stop, number);
}

bool Super40nc::is_inhibited(int number) const { return is_held_in_reset(number) || is_on(8004); }

void Super40nc::obey_stops() {
  using language::Area;
  using language::Event;
  if (is_stopped_by_emergency()) {
    const Code code = is_on(8002) ? Code::emergency_stop : Code::emergency_input;
    const bool is_new = code == Code::emergency_stop ? rises(8002) : !state_.emergency_obeyed;
    if (is_new) report(code);
    for (int number = 0; number < kAxisCount; ++number) {
      if (axis(number).holder == Holder::nobody) continue;
      stop_axis(number, code);
      if (code == Code::emergency_input) axis(number).has_error = true;
    }
    state_.homing_by_key = state_.zeroing_by_key = {};
    for (const language::AreaRow& row : language::kAreas) {
      if (row.area != Area::plc) tell(Event::emergency, row.area);
    }
  }
  state_.emergency_obeyed = state_.emergency;
  for (int number = 0; number < kAxisCount; ++number) {
    const bool is_reset = is_on(of_axis(number, kReset));
    if (is_reset) axis(number).has_error = false;
    if (is_reset) tell(Event::reset, language::area_of_axis(number));
    if (!is_pressed(KeyDoes::stop, number)) continue;
    tell(Event::stop, language::area_of_axis(number));
    set_contact(of_axis(number, kRun), false);  // a start in the same scan, too
  }
  if (is_pressed(KeyDoes::stop_c, -1)) {
    for (int number = 0; number < kAxisCount; ++number) {
      if (axis(number).order != 0) stop_axis(number);
    }
    state_.homing_by_key = state_.zeroing_by_key = {};
    tell(Event::stop, Area::c);
    set_contact(8000, false);
  }
  if (rises(8006)) tell(Event::hold, Area::c);
  for (int number = 0; number < kAxisCount; ++number) {
    if (is_pressed(KeyDoes::pause, number)) tell(Event::hold, language::area_of_axis(number));
  }
}

void Super40nc::obey_jogs(int number) {
  for (const int way : {+1, -1}) {
    const int contact = of_axis(number, way > 0 ? kJogPlus : kJogMinus);
    if (rises(contact) && !is_inhibited(number)) start_jog(number, way, &AxisState::asked_by_contact);
  }
  const int contact = of_axis(number, chip(number).last_direction > 0 ? kJogPlus : kJogMinus);
  if (!is_on(contact)) release_jog(number, &AxisState::asked_by_contact);
}

void Super40nc::obey_wheel() {
  for (int number = 0; number < kAxisCount; ++number) {
    for (std::size_t i = 0; i < std::size(kWheelContacts); ++i) {
      const int contact = of_axis(number, kWheelContacts[i]);
      if (rises(contact) && !is_inhibited(number)) start_wheel(number, kWheelSources[i]);
      if (axis(number).wheel == kWheelSources[i] && !is_on(contact)) stop_axis(number);
    }
  }
  if (!state_.wheel_selected) return;
  state_.wheel_selected = false;
  const std::int32_t selected = registers().raw(kept_d(8020)) - 1;
  for (int number = 0; number < kAxisCount; ++number) {
    if (number != selected && axis(number).wheel == WheelSource::selector) stop_axis(number);
  }
  if (selected >= 0 && selected < kAxisCount && !is_inhibited(selected)) {
    start_wheel(selected, WheelSource::selector);
  }
}

void Super40nc::obey_contacts() {
  obey_stops();
  if (rises(8501) && state_.run_switch && !state_.plc.runs) plc_to_run();
  const bool needs_rest = chose(option("m8008_running", "void"));
  if (rises(8008) && !(needs_rest && programs_are_busy())) reset_parameters();
  for (int number = 0; number < kAxisCount; ++number) {
    if (rises(of_axis(number, kZeroSet))) set_zero(number);
  }
  for (int number = 0; number < kAxisCount; ++number) {
    if (rises(of_axis(number, kHome)) && !is_inhibited(number)) start_home(number);
  }
  for (int number = 0; number < kAxisCount; ++number) {
    if (rises(of_axis(number, kZero)) && !is_inhibited(number)) start_zero(number);
  }
  obey_order_keys();
  for (int number = 0; number < kAxisCount; ++number) obey_jogs(number);
  obey_wheel();
  set_contact(8005, false);
  if (!chose(option("edge_contacts_fall", "when_served"))) return;
  set_contact(8008, false);
  for (int number = 0; number < kAxisCount; ++number) {
    for (const int contact : {kHome, kZero, kZeroSet}) set_contact(of_axis(number, contact), false);
  }
}

void Super40nc::see_contacts() {
  state_.touched = false;
  for (const int number : kCommandContacts) {
    const bool level = contact(number);
    // What was ON for this scan only falls in the next one.
    if (!level && is_on(number)) state_.touched = true;
    state_.contacts.see(number, level);
  }
}

}  // namespace understudy::emulator::models::super_40nc
