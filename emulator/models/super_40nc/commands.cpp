#include "emulator/models/super_40nc/commands.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/axis/marks.h"
#include "emulator/models/super_40nc/axis/ownership.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/panel/keys.h"
#include "emulator/models/super_40nc/path/manual_motions.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/events.h"

namespace understudy::emulator::models::super_40nc {

namespace language = interpreter::super_40nc;

namespace {

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

bool is_parameter(const RegisterRow& row) {
  return row.table == Table::holding && row.address >= data_address(d9::kStation);
}

}  // namespace

bool Commands::has_errors_for_a_scan() const {
  const bool has_one =
      std::any_of(axes_.axes.begin(), axes_.axes.end(), [](const AxisState& axis) { return axis.has_error; });
  return has_one && chose(option("serr_clears", "one_scan"));
}

/// During an emergency, resets a program, or pauses an axis program at its line.
void Commands::stop_by_emergency(language::Area area, bool is_new) {
  const language::Phase phase = program_state_.steps.programs[language::index_of(area)].phase;
  const bool pauses =
      area != language::Area::c && chose(option("emergency_of_axis_programs", "they_pause_at_their_line"));
  if (!pauses || (is_new && phase == language::Phase::held))
    return programs_.handle(language::Event::emergency, area);
  if (!is_new) return;
  programs_.handle(language::Event::limit_pauses, area);  // the motion of the program's line has ended
  programs_.handle(language::Event::hold, area);          // holds the program's wait or its lines
}

void Commands::apply_emergency() {
  const Code code = is_on(m8::kEmergencyStop) ? Code::emergency_stop : Code::emergency_input;
  const bool is_new = code == Code::emergency_stop ? rises(m8::kEmergencyStop) : !state_.emergency_obeyed;
  if (is_new) report(code);
  for (int number = 0; number < kAxisCount; ++number) {
    if (axis(number).holder == Activity::nobody) continue;
    moves_.manual_motion(number) ? moves_.handle(number, ManualEvent::emergency, code)
                                 : moves_.stop_axis(number, code);
    if (code == Code::emergency_input) axis(number).has_error = true;
    parts_.pins.give_erc_behind(number, code);
  }
  hands_.give_up_orders();
  for (const language::AreaRow& row : language::kAreas) {
    if (row.area != language::Area::plc) stop_by_emergency(row.area, is_new);
  }
}

void Commands::forget_errors_of_a_scan() {
  if (!has_errors_for_a_scan()) return;
  for (AxisState& each : axes_.axes) each.has_error = false;
}

void Commands::apply_stops() {
  using language::Area;
  using language::Event;
  if (keys_.is_stopped_by_emergency()) apply_emergency();
  state_.emergency_obeyed = ground_.state().emergency;
  for (int number = 0; number < kAxisCount; ++number) {
    const bool is_reset = is_on(of_axis(m8x::kReset, number));
    if (is_reset) take_off(axis(number), MarkEvent::reset);
    if (is_reset) programs_.handle(Event::reset, language::area_of_axis(number));
    if (!keys_.is_pressed(KeyDoes::stop, number)) continue;
    programs_.handle(Event::stop, language::area_of_axis(number));
    ground_.set_contact(of_axis(m8x::kStart, number), false);  // also cancels a start in the same scan
  }
  if (keys_.is_pressed(KeyDoes::stop_c, -1)) {
    for (int number = 0; number < kAxisCount; ++number) moves_.handle(number, ManualEvent::main_stop);
    hands_.give_up_orders();
    programs_.handle(Event::stop, Area::c);
    ground_.set_contact(m8::kStartOfC, false);
  }
  if (rises(m8::kPause)) {
    programs_.handle(Event::hold, Area::c);
    const bool ends = chose(option("manual_motion_events", "end_by_a_ramp"));
    for (int number = 0; number < kAxisCount && ends; ++number) hands_.slow_by_hand(number);
  }
  for (int number = 0; number < kAxisCount; ++number) {
    if (!keys_.is_pressed(KeyDoes::pause, number)) continue;
    programs_.handle(Event::hold, language::area_of_axis(number));
    const Activity holder = axis(number).holder;
    const bool is_manual = holder == Activity::jog || holder == Activity::home || holder == Activity::zero;
    if (is_manual && chose(option("pause_manual", "ends_it_by_a_ramp"))) hands_.slow_by_hand(number);
  }
}

/// Performs the actions of the panel when its pages are turned.
void Commands::apply_pages() {
  if (rises(m85::kParameterPageLeft)) {
    const bool renews_all = chose(option("parameter_moment", "when_m8500_rises"));
    if (renews_all) {
      ground_.take_parameters();
      parts_.parameters.apply_all_axis_parameters();
    }
    if (renews_all || chose(option("page_contacts", "m8500_renews_x14_and_c0")))
      ground_.take_power_up_parameters();
  }
  const bool stops = chose(option("page_contacts", "m8507_stops_the_plc"));
  if (rises(m85::kEditPageEntered) && stops && program_state_.plc.runs) programs_.plc_to_stop();
  const bool runs = !chose(option("m8501_runs_plc", "nothing"));
  if (rises(m85::kEditPageLeft) && runs && state_.run_switch && !program_state_.plc.runs)
    programs_.plc_to_run();
}

void Commands::apply_contacts() {
  apply_stops();
  apply_pages();
  const bool needs_rest = chose(option("m8008_running", "void"));
  if (rises(m8::kFactoryParameters) && !(needs_rest && programs_.are_busy())) reset_parameters();
  for (int number = 0; number < kAxisCount; ++number) {
    if (rises(of_axis(m8x::kZeroSet, number))) parts_.parameters.set_zero(number);
  }
  hands_.apply_contacts();
  if (!chose(option("m8005_falls", "by_a_write_alone"))) ground_.set_contact(m8::kMCodeFinished, false);
  hold_while_inhibited();
  keys_.see_held();
  if (chose(option("edge_contacts_fall", "when_served"))) drop_edges();
}

void Commands::drop_edges() {
  for (const int contact : {m8::kPause, m8::kFactoryParameters}) ground_.set_contact(contact, false);
  for (int number = 0; number < kAxisCount; ++number) {
    for (const int contact : {m8x::kHome, m8x::kZero, m8x::kZeroSet})
      ground_.set_contact(of_axis(contact, number), false);
  }
}

/// M8004: a choice makes it hold running motions of programs and the PLC, like a pause.
void Commands::hold_while_inhibited() {
  const bool is_inhibited_now = is_on(m8::kMotionInhibit);
  const bool has_changed = is_inhibited_now != state_.was_inhibited;
  state_.was_inhibited = is_inhibited_now;
  if (!has_changed || !chose(option("m8004_scope", "running_ones_are_held"))) return;
  if (is_inhibited_now) {
    paths_.hold_path();
    for (int number = 0; number < kAxisCount; ++number) {
      const Activity holder = axis(number).holder;
      if ((holder == Activity::move || holder == Activity::vdrv) && !is_on_path(number))
        moves_.hold_axis(number);
    }
    return;
  }
  // Motions that are also held by a pause stay held.
  const auto is_paused = [&](Mover mover) {
    return mover < Mover::plc && program_state_.steps.programs[static_cast<std::size_t>(mover)].machine_holds;
  };
  if (!is_paused(Mover::c)) paths_.resume_path();
  for (int number = 0; number < kAxisCount; ++number) {
    if (is_on_path(number) || is_paused(axis(number).mover)) continue;
    if (const auto broken = moves_.resume_axis(number)) programs_.broken(*broken);
  }
}

void Commands::see_contacts() {
  ground_.state().touched = false;
  for (const int number : kCommandContacts) {
    const bool level = ground_.contact(number);
    // A contact that was ON only for this scan goes OFF in the next one.
    if (!level && is_on(number)) ground_.touch();
    ground_.state().contacts.see(number, level);
  }
}

void Commands::check_contacts() {
  if (!ground_.state().touched) return;
  program_state_.shows_file_changed = program_state_.file_changed;
  keys_.read_keys();
  apply_contacts();
  see_contacts();
  // M8023 is ON for one scan.
  ground_.state().touched = ground_.state().touched || program_state_.shows_file_changed;
  program_state_.file_changed = false;
}

/// Executes M8008. The file and the recipe change as if their numbers had been written.
void Commands::reset_parameters() {
  const bool leaves_some = chose(option("m8008_scope", "but_for_d9000_and_d9026"));
  const auto stays = [&](const RegisterRow& row) {
    return leaves_some &&
           (row.address == data_address(d9::kStation) || row.address == data_address(d9::kPassword));
  };
  for_each_slot([&](std::size_t slot, const RegisterRow& row) {
    if (is_parameter(row) && !stays(row))
      ground_.put({.slot = slot}, static_cast<std::int32_t>(ground_.factory_bits(row)));
  });
  programs_.change_file(0);
  programs_.stored().change_recipe(0);
  programs_.stored().show_line_counts();
  parts_.parameters.apply_all_axis_parameters();
}

}  // namespace understudy::emulator::models::super_40nc
