#include "emulator/models/rs_m8194h/rows/options.h"

#include <cstdint>
#include <vector>

#include "base/choices.h"
#include "emulator/device/decisions.h"
#include "emulator/device/model.h"
#include "emulator/models/rs_m8194h/rows/choices.h"
#include "interpreter/rs_m8194h/check.h"
#include "interpreter/rs_m8194h/download.h"
#include "motion/axis.h"

namespace understudy::emulator::models::rs_m8194h {

namespace lang = interpreter::rs_m8194h;

lang::CommandOptions command_options(const AskedOptions& asked) {
  const auto chose = [&asked](const Option& option) { return asked.chose(option); };
  using Letters = lang::CommandOptions::Letters;
  return {.rectangle_corners_must_fit = chose(option("rectangle_radius", "exception_3")) &&
                                        chose(option("rectangle_sides", "outer_length_and_width")),
          .speeds_have_ends = chose(option("speed_ends", "exception_3")),
          .variables_have_ends = chose(option("variable_range", "exception_3")),
          .zero_moves_are_refused = chose(option("zero_move", "exception_3")),
          .helix_turns_forward_only = chose(option("helix_cycle", "exception_3")),
          .helix_has_turns = chose(option("helix_cycle_0", "exception_3")),
          .uneven_scans_start = chose(option("uneven_scan_start", "starts_all_the_same")),
          .one_trigger_axis = chose(option("several_trigger_axes", "exception_3")),
          .outputs_are_of_x_and_y = chose(option("set_out_of_z_and_u", "exception_3")),
          .letters = chose(option("if_operator", "as_in_the_frame"))   ? Letters::as_in_the_frame
                     : chose(option("if_operator", "as_in_the_table")) ? Letters::as_in_the_table
                                                                       : Letters::either,
          .single_signs_are_refused = chose(option("if_single_signs", "are_refused")),
          .addresses_are_variables = chose(option("frnet_out_data", "variable_by_its_address")),
          .codes_of_12_3 = chose(option("swapped_codes", "of_12_3")),
          .frnet_wait_may_have_7 = chose(option("frnet_wait_registers", "8_or_7_with_a_time_of_one")),
          .knows_0cb2 = chose(option("code_0cb2", "that_command")),
          .few_take_references = chose(option("references", "exception_3")),
          .rectangles_end_earlier = chose(option("rectangle_ends", "200000000")),
          .macros_store_initial = chose(option("initial_in_macros", "stored_when_the_line_runs")),
          .state_before_code = chose(option("check_order", "the_same_but_state_before_code"))};
}

LanguageOptions language_options(const DeviceSettings& settings) {
  const std::vector<std::uint8_t> chosen = resolve_choices(kChoices, settings.choices);
  return language_options(AskedOptions{.numbers = chosen});
}

LanguageOptions language_options(const AskedOptions& asked) {
  using Download = lang::DownloadOptions;
  const auto chose = [&asked](const Option& option) { return asked.chose(option); };
  LanguageOptions options;
  options.command = command_options(asked);
  options.download = {
      .close_takes_line = chose(option("close_line", "one_line")),
      .levels_are_of_both = chose(option("block_levels", "of_both_together")),
      .goto_stays_in_its_block = chose(option("goto_out_of_blocks", "is_refused_as_without_its_label")),
      .shown_code = chose(option("download_command", "as_sent")) ? Download::ShownCode::as_sent
                                                                 : Download::ShownCode::real_time,
      .good_status = chose(option("status_of_good_download", "of_its_close")) ? Download::GoodStatus::of_close
                     : chose(option("status_of_good_download", "as_before"))  ? Download::GoodStatus::stays
                                                                              : Download::GoodStatus::zero,
      .operators_share_error = chose(option("wrong_arithmetic", "06_as_of_an_operator")),
      .faults_show_at_close = chose(option("structure_faults", "at_close")),
      .last_error_counts = chose(option("kept_error", "the_last")),
      .refused_line = chose(option("refused_lines", "spoil_the_download"))
                          ? Download::RefusedLine::spoils
                          : Download::RefusedLine::is_left_out};
  options.run = {.command = options.command,
                 .mp_runs_beside_isr = chose(option("mp_during_isr", "goes_on_while_it_waits")),
                 .isr_interrupts_isr = chose(option("isr_nesting", "nested")),
                 .isr_never_waits = chose(option("isr_waits", "are_passed_over")),
                 .one_return_register = chose(option("return_registers", "one_for_both")),
                 .return_value_is_used_up = chose(option("return_register_keeps", "execution_error")),
                 .negative_time_is_error = chose(option("timer_negative", "execution_error")),
                 .calls_alone_have_levels = chose(option("call_levels", "of_calls_alone")),
                 .call_too_deep_ends_macro = chose(option("call_too_deep", "ends_the_macro")),
                 .missing_macro_is_error = chose(option("missing_macro", "execution_error")),
                 .exit_for_counts = chose(option("exit_for_counter", "counts_this_pass_too")),
                 .frnet_wait_needs_edge = chose(option("frnet_wait_level", "waits_for_the_change")),
                 .frnet_wait_timeout_is_error = chose(option("frnet_wait_timeout", "execution_error")),
                 .raw_signals_are_not_returned = chose(option("rvar_of_di_signal_all", "is_not_stored")),
                 .results_end_at_32_bits = chose(option("calculation_overflow", "stays_at_the_end")),
                 .division_by_zero_keeps = chose(option("division_by_zero", "stays_as_it_was")),
                 .for_runs_once_at_least = chose(option("for_below_1", "one_pass"))};
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
