#include "emulator/models/rs_m8194h/rows/options.h"

#include <cstdint>
#include <vector>

#include "base/choices.h"
#include "emulator/device/decisions.h"
#include "emulator/device/model.h"
#include "emulator/models/rs_m8194h/rows/choices.h"
#include "interpreter/rs_m8194h/options.h"
#include "motion/axis.h"

namespace understudy::emulator::models::rs_m8194h {

namespace lang = interpreter::rs_m8194h;

lang::Options options_of_language(const AskedOptions& asked) {
  return {asked.numbers.subspan(kFirstOfLanguage),
          asked.decisions == nullptr ? nullptr : asked.decisions->asked(kFirstOfLanguage)};
}

LanguageOptions language_options(const DeviceSettings& settings) {
  const std::vector<std::uint8_t> chosen = resolve_choices(kChoices, settings.choices);
  return language_options(AskedOptions{.numbers = chosen});
}

LanguageOptions language_options(const AskedOptions& asked) {
  const auto chose = [&asked](const Option& option) { return asked.chose(option); };
  LanguageOptions options{.lines = options_of_language(asked)};
  if (chose(option("steps_a_tick", "1"))) options.steps_a_tick = 1;
  if (chose(option("steps_a_tick", "32"))) options.steps_a_tick = 32;
  if (chose(option("steps_a_tick", "1000"))) options.steps_a_tick = 1000;
  if (chose(option("isr_delay", "same_tick"))) options.isr_delay_ticks = 0;
  options.isrs_go_by_factor = chose(option("isr_order", "by_factor"));
  options.isrs_go_by_enabling = chose(option("isr_order", "by_order_of_enabling"));
  options.isrs_go_by_number = chose(option("isr_order", "by_isr_number"));
  options.room_before_parameters = chose(option("check_order", "the_same_but_room_before_parameters"));
  options.isr_requests_are_counted = chose(option("isr_requests", "counted"));
  options.isrs_are_bound_at_the_event = chose(option("isr_binding", "at_the_event"));
  return options;
}

MachineOptions machine_options(const AskedOptions& asked) {
  const auto chose = [&asked](const Option& option) { return asked.chose(option); };
  MachineOptions options;
  if (chose(option("soft_limit_stop", "at_once"))) {
    options.axis.at_soft_limit = motion::Reaction::stop_at_once;
  }
  if (chose(option("alarm_stop", "slows_down"))) options.axis.at_alarm = motion::Reaction::slow_down;
  options.axis.drives_wait_for_in_position = !chose(option("inpos", "is_only_read"));
  options.axis.in_position_waits_beside_limits = chose(option("limit_while_inpos", "lets_it_wait"));
  options.axis.ring_folds = chose(option("ring_overflow", "comes_round"));
  options.emergency_while_off = chose(option("emg_level", "while_off"));
  options.in3_rises_when_it_closes = chose(option("in3_edges", "the_contact_closes"));
  options.filters_delay = !chose(option("filter_delay", "none"));
  options.frnet_every_tick = chose(option("frnet_scan", "every_ms"));
  options.drives_need_servo = chose(option("drives_need_servo", "are_void"));
  options.fifo_waits_for_download = chose(option("fifo_during_download", "held"));
  options.one_block_each = chose(option("fifo_cost", "one_each"));
  options.holds_are_at_once = chose(option("holds_bypass_fifo", "at_once"));
  options.isr_calls_are_at_once = chose(option("isr_call_bypasses_fifo", "at_once"));
  options.stops_wait = chose(option("stops_bypass_fifo", "wait_like_others"));
  options.pitch_is_distance = chose(option("scan_positive_pitch", "pitch"));
  options.axis.ring_takes_absolute = chose(option("ring_and_absolute", "turns_round_too"));
  options.axis.homing_obeys_soft_limits = !chose(option("home_soft_limit", "is_ignored"));
  options.axis.comparisons_fire_when_armed = chose(option("factor_edges", "fires_at_once"));
  options.speed.rounds_to_nearest = chose(option("speed_quantum", "the_nearest_one"));
  options.speed.mode_3_is_symmetric = chose(option("normal_speed_3", "symmetric"));
  options.speed.has_offset = !chose(option("deceleration_offset", "nothing"));
  if (chose(option("least_jerk", "0.119211"))) options.speed.min_jerk_part *= 10;
  options.fifo_goes_on_beside_macros = chose(option("fifo_while_macro", "goes_on"));
  options.pause_holds_fifo = !chose(option("trigger_pause", "holds_macros"));
  options.pause_slows_axes = chose(option("trigger_pause", "and_slows_all_axes"));
  options.paths_have_c_sta = chose(option("c_sta_in_interpolation", "for_axis1"));
  options.each_pulse_is_an_event = chose(option("pulse_factor", "each_pulse"));
  options.all_factors_are_noted = chose(option("factors_noted", "all_that_come_about"));
  options.helix_is_macro = chose(option("helix_is_macro", "is_a_running_macro"));
  options.d_end_after_stops = !chose(option("d_end_after_stops", "no"));
  options.constant_drives_have_c_sta = !chose(option("constant_drive_c_sta", "none"));
  options.a_segment_may_come_sets_rint = chose(option("rint_stream", "a_segment_may_come"));
  options.all_scan_triggers_are_given = chose(option("scan_too_fast", "given_all_the_same"));
  options.last_ramp_is_in_last_segment = chose(option("last_ramp", "in_the_last_segment"));
  options.levels_repeat = chose(option("trigger_level_repeats", "again_when_it_has_ended"));
  options.finished_states_show = !chose(option("passing_states", "do_not_show"));
  if (chose(option("encoder_counts", "whole_cycles"))) options.edges_per_encoder_count = 4;
  options.short_filters_take_a_tick = chose(option("filter_delay", "a_tick_at_least"));
  options.table_writes_become_lines = chose(option("table_writes", "become_lines"));
  options.constant_paths_slow_down = chose(option("slow_stop_without_ramps", "slows_down_by_va"));
  options.pause_holds_axes = chose(option("trigger_pause", "and_holds_all_axes"));
  options.factors_clear_by_reading = chose(option("factors_clear", "by_reading_too"));
  options.rint_clears_by_reading = chose(option("rint_clears", "by_reading_too"));
  options.isrs_raise_user_rint = chose(option("rint_user", "an_isr_that_begins"));
  options.zero_speeds_drive_nothing = chose(option("power_on_values", "0_and_no_drive"));
  return options;
}

}  // namespace understudy::emulator::models::rs_m8194h
