// The choices of the languages (choices.h) as their library asks for them.
#pragma once

#include <limits>
#include <string_view>

#include "emulator/models/super_40nc/choices.h"
#include "interpreter/super_40nc/options.h"

namespace understudy::emulator::models::super_40nc {

/// An unknown row or option is a compile error.
consteval Option option(std::string_view id, std::string_view name) { return option_of(kChoices, id, name); }

/// `chose`: whether an option is in force.
template <class Chose>
interpreter::super_40nc::Options language_options(Chose chose) {
  using interpreter::super_40nc::Options;
  Options options;
  if (chose(option("area_bases", "older_chapters"))) options.bases = Options::Bases::older;
  if (chose(option("stack_depth", "8"))) options.stack_depth = 8;
  if (chose(option("stack_depth", "11"))) options.stack_depth = 11;
  if (chose(option("run_edges", "none_at_all"))) options.outputs_fire_at_run = false;
  if (chose(option("timer_unit", "1_s"))) options.timer_unit_ms = 1000;
  if (chose(option("timer_unit", "10_ms"))) options.timer_unit_ms = 10;
  if (chose(option("counter_past_preset", "counts_on"))) options.counts_beyond_preset = true;
  if (chose(option("counter_contact", "closed_by_the_last_count"))) {
    options.counter_contact = Options::CounterContact::is_latched;
  }
  if (chose(option("fmv_end", "nothing_copied"))) options.fill_beyond = Options::FillBeyond::does_nothing;
  if (chose(option("division_by_zero", "zero"))) {
    options.division_by_zero = Options::DivisionByZero::gives_zero;
  }
  if (chose(option("product_size", "saturates"))) options.product = Options::Product::saturates;
  if (chose(option("instruction_edges", "all_in_every_scan"))) options.motions_need_edge = false;
  if (chose(option("empty_program", "code_6"))) options.empty_program = Options::EmptyProgram::is_an_error;
  if (chose(option("fresh_start", "every_start"))) options.fresh_start = Options::FreshStart::every_start;
  if (chose(option("slice_length", "1_line"))) options.slice = 1;
  if (chose(option("slice_length", "until_it_waits"))) options.slice = std::numeric_limits<int>::max();
  if (chose(option("c21_zero", "program_stops"))) options.not_owned = Options::NotOwned::stops_program;
  if (chose(option("cal_depth", "8"))) options.call_depth = 8;
  if (chose(option("ret_without_cal", "ignored"))) options.loose_return = Options::LooseReturn::is_ignored;
  if (chose(option("cal_count", "below_1_endless"))) options.no_passes = Options::NoPasses::mean_endless;
  if (chose(option("vdrv_zero_wait", "no"))) options.rotation_0_waits = false;
  return options;
}

}  // namespace understudy::emulator::models::super_40nc
