// RS-M8194H: looks up the options of choices.h. Options that every tick or every macro line needs are looked
// up once, when the device is created.
#pragma once

#include <string_view>

#include "emulator/device/decisions.h"
#include "emulator/device/model.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/choices.h"
#include "interpreter/rs_m8194h/options.h"

namespace understudy::emulator::models::rs_m8194h {

consteval Option option(std::string_view id, std::string_view name) { return option_of(kChoices, id, name); }

/// The options for commands, downloads and macros.
struct LanguageOptions {
  interpreter::rs_m8194h::Options lines = {};  // of the language itself
  int steps_a_tick = 8;
  int isr_delay_ticks = 1;
  bool isrs_go_by_factor = false;
  bool isrs_go_by_number = false;
  bool isrs_go_by_enabling = false;
  bool room_before_parameters = false;
  bool isr_requests_are_counted = false;
  bool isrs_are_bound_at_the_event = false;
};
LanguageOptions language_options(const AskedOptions& asked);
LanguageOptions language_options(const DeviceSettings& settings);
interpreter::rs_m8194h::Options options_of_language(const AskedOptions& asked);

/// The options for inputs, axes and the FIFO.
struct MachineOptions {
  AxisOptions axis = {};
  SpeedRules speed = {};
  bool emergency_while_off = false;  // for the EMG input
  bool in3_rises_when_it_closes = false;
  bool filters_delay = true;
  bool frnet_every_tick = false;
  bool drives_need_servo = false;
  bool fifo_waits_for_download = false;
  bool one_block_each = false;
  bool stops_wait = false;
  bool holds_are_at_once = false;
  bool isr_calls_are_at_once = false;
  bool pitch_is_distance = false;
  bool fifo_goes_on_beside_macros = false;
  bool pause_holds_fifo = true;
  bool pause_slows_axes = false;
  bool helix_is_macro = false;
  bool d_end_after_stops = true;
  bool constant_drives_have_c_sta = true;
  bool paths_have_c_sta = false;  // for axis1
  bool each_pulse_is_an_event = false;
  bool all_factors_are_noted = false;
  bool a_segment_may_come_sets_rint = false;
  bool all_scan_triggers_are_given = false;
  bool last_ramp_is_in_last_segment = false;
  bool levels_repeat = false;
  bool finished_states_show = false;
  int edges_per_encoder_count = 1;
  bool short_filters_take_a_tick = false;
  bool table_writes_become_lines = false;
  bool constant_paths_slow_down = false;
  bool pause_holds_axes = false;
  bool factors_clear_by_reading = false;
  bool rint_clears_by_reading = false;
  bool isrs_raise_user_rint = false;
  bool zero_speeds_drive_nothing = false;
};
MachineOptions machine_options(const AskedOptions& asked);

}  // namespace understudy::emulator::models::rs_m8194h
