// Derives the options of the languages from the choices.
#include "emulator/models/super_40nc/ground/language_choices.h"

#include "base/choices.h"
#include "emulator/device/device.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "interpreter/super_40nc/options.h"

namespace understudy::emulator::models::super_40nc {

namespace {

using Options = interpreter::super_40nc::Options;

struct LanguageChoice {
  Option option;
  void (*set)(Options& made);
};
constexpr LanguageChoice kLanguageChoices[] = {
    {option("area_bases", "older"), [](Options& made) { made.bases = Options::Bases::older; }},
    {option("stack_depth", "8"), [](Options& made) { made.stack_depth = 8; }},
    {option("stack_depth", "11"), [](Options& made) { made.stack_depth = 11; }},
    {option("cal_depth", "8"), [](Options& made) { made.call_depth = 8; }},
    {option("counter_contact", "closed_by_the_last_count"),
     [](Options& made) { made.counter_contact = Options::CounterContact::is_latched; }},
    {option("timer_unit", "10ms"), [](Options& made) { made.timer_unit_ms = 10; }},
    {option("timer_unit", "1s"), [](Options& made) { made.timer_unit_ms = 1000; }},
    {option("run_edges", "not_at_all"), [](Options& made) { made.outputs_fire_at_run = false; }},
    {option("counter_past_preset", "counts_on"), [](Options& made) { made.counts_beyond_preset = true; }},
    {option("fmv_end", "nothing"),
     [](Options& made) { made.fill_beyond = Options::FillBeyond::does_nothing; }},
    {option("division_by_zero", "zero"),
     [](Options& made) { made.division_by_zero = Options::DivisionByZero::gives_zero; }},
    {option("product_size", "saturates"), [](Options& made) { made.product = Options::Product::saturates; }},
    {option("instruction_edges", "every_scan"), [](Options& made) { made.motions_need_edge = false; }},
    {option("fresh_start", "every_start"),
     [](Options& made) { made.fresh_start = Options::FreshStart::every_start; }},
    {option("slice_length", "1_line"), [](Options& made) { made.slice = 1; }},
    {option("c21_zero", "stops_the_program"),
     [](Options& made) { made.not_owned = Options::NotOwned::stops_program; }},
    {option("ret_without_cal", "ignored"),
     [](Options& made) { made.loose_return = Options::LooseReturn::is_ignored; }},
    {option("cal_count", "endless"), [](Options& made) { made.no_passes = Options::NoPasses::mean_endless; }},
    {option("empty_program", "is_an_error"),
     [](Options& made) { made.empty_program = Options::EmptyProgram::is_an_error; }},
    {option("vdrv_zero_wait", "goes_on"), [](Options& made) { made.rotation_0_waits = false; }},
    {option("continuous", "m8007_alone"), [](Options& made) { made.continuous_by_key = false; }},
    {option("scan_time", "2_ms"), [](Options& made) { made.scan_ms = 2; }},
    {option("scan_time", "5_ms"), [](Options& made) { made.scan_ms = 5; }},
    {option("capacity_unit", "lines"), [](Options& made) { made.capacity = Options::Capacity::lines; }},
    {option("reset_timers_counters", "refused_at_load"),
     [](Options& made) { made.timers_can_be_reset = false; }},
    {option("double_coils", "refused_at_load"),
     [](Options& made) { made.double_coils = Options::DoubleCoils::are_refused; }},
    {option("void_lines", "refused_at_load"),
     [](Options& made) { made.void_lines = Options::VoidLines::are_refused; }},
    {option("duplicate_label", "refused_at_load"),
     [](Options& made) { made.double_labels = Options::DoubleLabels::are_refused; }},
    {option("cj_without_group", "takes_the_last_result"),
     [](Options& made) { made.loose_groups = Options::LooseGroups::take_last_result; }},
    {option("if_depth", "1"), [](Options& made) { made.if_depth = 1; }},
    {option("continuous_path", "corners_are_run_through"), [](Options& made) { made.joins_paths = true; }},
    {option("block_stack", "each_output_leaves_the_result_alone"),
     [](Options& made) { made.outputs_clear_blocks = true; }},
    {option("timer_write", "ignored"), [](Options& made) { made.timers_ignore_writes = true; }},
    {option("label_scope", "the_first_area_has_it"), [](Options& made) { made.labels_are_common = true; }},
    {option("c3p_plane", "always_xy"), [](Options& made) { made.c3p_is_in_xy = true; }},
    {option("sum_size", "saturates"), [](Options& made) { made.sums_saturate = true; }},
    {option("division_rounding", "downwards"),
     [](Options& made) { made.quotient = Options::Quotient::downwards; }},
    {option("rpm_not_positive", "keeps_the_speed"), [](Options& made) { made.rpm_0_keeps_speed = true; }},
    {option("axis_contact_off", "stops_the_program"), [](Options& made) { made.contact_off_stops = true; }},
    {option("str_running", "begins_anew"), [](Options& made) { made.start_begins_again = true; }},
    {option("mrk_speed", "by_x14_alone"), [](Options& made) { made.marks_by_rpm = false; }},
    {option("mset", "refused_at_load"), [](Options& made) { made.knows_mset = false; }},
    {option("plc_moves_axes_of_c", "whenever_they_are_free"),
     [](Options& made) { made.plc_moves = Options::PlcMoves::any_axis; }},
    {option("plc_moves_axes_of_c", "never"),
     [](Options& made) { made.plc_moves = Options::PlcMoves::only_others; }},
    {option("missing_label", "refused_at_load"), [](Options& made) { made.labels_must_exist = true; }},
    {option("kept_timers", "keep_their_value"), [](Options& made) { made.retentive_timers_hold = true; }},
    {option("timer_first_scan", "counts"), [](Options& made) { made.timers_count_at_once = true; }},
    {option("run_contact_edges", "those_that_are_on_rise"),
     [](Options& made) { made.contacts_rise_at_run = true; }},
    {option("pointer_write_running", "goes_on_there"),
     [](Options& made) { made.pointer_moves_running = true; }},
    {option("slice_end", "waits_and_the_64_lines_alone"),
     [](Options& made) { made.jumps_end_slice = false; }},
    {option("area_bases", "each_from_0"), [](Options& made) { made.bases = Options::Bases::each_from_0; }},
    {option("missing_end", "as_if_it_had_one"), [](Options& made) { made.end_may_be_missing = true; }},
    {option("edge_memory", "the_bit_so_the_first_takes_the_edge"),
     [](Options& made) { made.bits_remember_edges = true; }},
    {option("kept_timers", "all_timers_keep_it"), [](Options& made) { made.all_timers_hold = true; }},
    {option("timer_past_preset", "counts_on"), [](Options& made) { made.timers_count_on = true; }},
    {option("preset_not_positive", "never_closes"), [](Options& made) { made.empty_presets_close = false; }},
    {option("preset_operand", "k_alone"), [](Options& made) { made.presets_may_be_registers = false; }},
    {option("zrst_swapped", "the_first_alone"),
     [](Options& made) { made.swapped = Options::Swapped::clears_first; }},
    {option("zrst_swapped", "all_between"),
     [](Options& made) { made.swapped = Options::Swapped::clears_all; }},
    {option("div_at_the_end", "nothing_with_a_code"),
     [](Options& made) { made.remainder_needs_room = true; }},
    {option("instruction_edges", "all_on_the_edge"), [](Options& made) { made.modes_need_edge = true; }},
    {option("plc_modes", "stay"), [](Options& made) { made.modes_stay_at_run = true; }},
    {option("mrk_fields", "of_its_own_axis"), [](Options& made) { made.mark_is_by_own_field = true; }},
    {option("unset_fields", "line_is_skipped"), [](Options& made) { made.unset_lines_are_skipped = true; }},
    {option("c3p_unset", "refused_at_load"), [](Options& made) { made.c3p_may_lack_fields = false; }},
    {option("pointer_inside", "goes_on_with_the_next_line"),
     [](Options& made) { made.starts_inside_lines = true; }},
    {option("tmr_of_d", "compared_in_each_scan"), [](Options& made) { made.waits_follow_registers = true; }},
    {option("single_step_lines", "yes"), [](Options& made) { made.wheel_ends_single_step = true; }},
    {option("tmr_under_m8004", "stands"), [](Options& made) { made.waits_stand_inhibited = true; }},
};

}  // namespace

Options chosen_options(const Device& device) {
  Options made;
  for (const LanguageChoice& row : kLanguageChoices) {
    if (device.chose(row.option)) row.set(made);
  }
  return made;
}

}  // namespace understudy::emulator::models::super_40nc
