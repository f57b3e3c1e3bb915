// SUPER-40NC: the options of the languages, as chosen.
#include "emulator/device/choices.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/options.h"
#include "interpreter/super_40nc/options.h"

namespace understudy::emulator::models::super_40nc {

namespace language = interpreter::super_40nc;

language::Options Super40nc::chosen_options() const {
  using Options = language::Options;
  Options made;
  const auto set = [&](const Option& chosen, auto& field, auto value) {
    if (chose(chosen)) field = value;
  };
  set(option("area_bases", "older"), made.bases, Options::Bases::older);
  set(option("stack_depth", "8"), made.stack_depth, 8);
  set(option("stack_depth", "11"), made.stack_depth, 11);
  set(option("cal_depth", "8"), made.call_depth, 8);
  set(option("counter_contact", "closed_by_the_last_count"), made.counter_contact,
      Options::CounterContact::is_latched);
  set(option("timer_unit", "10ms"), made.timer_unit_ms, 10);
  set(option("timer_unit", "1s"), made.timer_unit_ms, 1000);
  set(option("run_edges", "not_at_all"), made.outputs_fire_at_run, false);
  set(option("counter_past_preset", "counts_on"), made.counts_beyond_preset, true);
  set(option("fmv_end", "nothing"), made.fill_beyond, Options::FillBeyond::does_nothing);
  set(option("division_by_zero", "zero"), made.division_by_zero, Options::DivisionByZero::gives_zero);
  set(option("product_size", "saturates"), made.product, Options::Product::saturates);
  set(option("instruction_edges", "every_scan"), made.motions_need_edge, false);
  set(option("fresh_start", "every_start"), made.fresh_start, Options::FreshStart::every_start);
  set(option("slice_length", "1_line"), made.slice, 1);
  set(option("c21_zero", "stops_the_program"), made.not_owned, Options::NotOwned::stops_program);
  set(option("ret_without_cal", "ignored"), made.loose_return, Options::LooseReturn::is_ignored);
  set(option("cal_count", "endless"), made.no_passes, Options::NoPasses::mean_endless);
  set(option("empty_program", "is_an_error"), made.empty_program, Options::EmptyProgram::is_an_error);
  set(option("vdrv_zero_wait", "goes_on"), made.rotation_0_waits, false);
  set(option("continuous", "m8007_alone"), made.continuous_by_key, false);
  set(option("scan_time", "2_ms"), made.scan_ms, 2);
  set(option("scan_time", "5_ms"), made.scan_ms, 5);
  set(option("capacity_unit", "lines"), made.capacity, Options::Capacity::lines);
  set(option("reset_timers_counters", "refused_at_load"), made.timers_can_be_reset, false);
  set(option("double_coils", "refused_at_load"), made.double_coils, Options::DoubleCoils::are_refused);
  set(option("void_lines", "refused_at_load"), made.void_lines, Options::VoidLines::are_refused);
  set(option("duplicate_label", "refused_at_load"), made.double_labels, Options::DoubleLabels::are_refused);
  set(option("cj_without_group", "takes_the_last_result"), made.loose_groups,
      Options::LooseGroups::take_last_result);
  set(option("if_depth", "1"), made.if_depth, 1);
  set(option("continuous_path", "corners_are_run_through"), made.joins_paths, true);
  set(option("block_stack", "each_output_leaves_the_result_alone"), made.outputs_clear_blocks, true);
  set(option("timer_write", "ignored"), made.timers_ignore_writes, true);
  set(option("label_scope", "the_first_area_has_it"), made.labels_are_common, true);
  set(option("c3p_plane", "always_xy"), made.c3p_is_in_xy, true);
  set(option("sum_size", "saturates"), made.sums_saturate, true);
  set(option("division_rounding", "downwards"), made.quotient, Options::Quotient::downwards);
  set(option("rpm_not_positive", "keeps_the_speed"), made.rpm_0_keeps_speed, true);
  set(option("axis_contact_off", "stops_the_program"), made.contact_off_stops, true);
  set(option("str_running", "begins_anew"), made.start_begins_anew, true);
  set(option("mrk_speed", "by_x14_alone"), made.marks_by_rpm, false);
  set(option("mset", "refused_at_load"), made.knows_mset, false);
  set(option("plc_moves_axes_of_c", "whenever_they_are_free"), made.plc_moves, Options::PlcMoves::any_axis);
  set(option("plc_moves_axes_of_c", "never"), made.plc_moves, Options::PlcMoves::only_others);
  set(option("missing_label", "refused_at_load"), made.labels_must_exist, true);
  set(option("kept_timers", "keep_their_value"), made.kept_timers_hold, true);
  set(option("timer_first_scan", "counts"), made.timers_count_at_once, true);
  set(option("run_contact_edges", "those_that_are_on_rise"), made.contacts_rise_at_run, true);
  set(option("pointer_write_running", "goes_on_there"), made.pointer_moves_running, true);
  set(option("slice_end", "waits_and_the_64_lines_alone"), made.jumps_end_slice, false);
  set(option("area_bases", "each_from_0"), made.bases, Options::Bases::each_from_0);
  set(option("missing_end", "as_if_it_had_one"), made.end_may_be_missing, true);
  set(option("edge_memory", "the_bit_so_the_first_takes_the_edge"), made.bits_remember_edges, true);
  set(option("kept_timers", "all_timers_keep_it"), made.all_timers_hold, true);
  set(option("timer_past_preset", "counts_on"), made.timers_count_on, true);
  set(option("preset_not_positive", "never_closes"), made.empty_presets_close, false);
  set(option("preset_operand", "k_alone"), made.presets_may_be_registers, false);
  set(option("zrst_swapped", "the_first_alone"), made.swapped, Options::Swapped::clears_first);
  set(option("zrst_swapped", "all_between"), made.swapped, Options::Swapped::clears_all);
  set(option("div_at_the_end", "nothing_with_a_code"), made.remainder_needs_room, true);
  set(option("instruction_edges", "all_on_the_edge"), made.modes_need_edge, true);
  set(option("plc_modes", "stay"), made.modes_stay_at_run, true);
  set(option("mrk_fields", "of_its_own_axis"), made.mark_is_by_own_field, true);
  set(option("unset_fields", "line_is_skipped"), made.unset_lines_are_skipped, true);
  set(option("c3p_unset", "refused_at_load"), made.c3p_may_lack_fields, false);
  set(option("pointer_inside", "goes_on_with_the_next_line"), made.starts_inside_lines, true);
  set(option("tmr_of_d", "compared_in_each_scan"), made.waits_follow_registers, true);
  set(option("single_step_lines", "yes"), made.wheel_ends_single_step, true);
  set(option("tmr_under_m8004", "stands"), made.waits_stand_inhibited, true);
  return made;
}

}  // namespace understudy::emulator::models::super_40nc
