#include "emulator/models/rs_m8194h/options.h"

#include <cstdint>
#include <vector>

#include "emulator/device/choices.h"
#include "emulator/device/model.h"
#include "emulator/models/rs_m8194h/choices.h"
#include "interpreter/rs_m8194h/download.h"
#include "motion/axis.h"

namespace understudy::emulator::models::rs_m8194h {

LanguageOptions language_options(const DeviceSettings& settings) {
  using Download = interpreter::rs_m8194h::DownloadOptions;
  const std::vector<std::uint8_t> chosen = resolve_choices(kChoices, settings.choices);
  const auto chose = [&chosen](const Option& option) { return chosen[option.choice] == option.number; };
  LanguageOptions options;
  options.command.rectangle_corners_must_fit = chose(option("rectangle_radius", "exception_3"));
  options.download = {.close_takes_line = chose(option("close_line", "one_line")),
                      .shown_code = chose(option("download_command", "as_sent"))
                                        ? Download::ShownCode::as_sent
                                        : Download::ShownCode::real_time,
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
                 .call_too_deep_ends_macro = chose(option("call_too_deep", "ends_the_macro")),
                 .frnet_wait_needs_edge = chose(option("frnet_wait_level", "waits_for_the_change"))};
  if (chose(option("steps_a_tick", "1"))) options.steps_a_tick = 1;
  if (chose(option("steps_a_tick", "32"))) options.steps_a_tick = 32;
  if (chose(option("isr_delay", "same_tick"))) options.isr_delay_ticks = 0;
  options.isr_requests_are_counted = chose(option("isr_requests", "counted"));
  options.isrs_are_bound_at_the_event = chose(option("isr_binding", "at_the_event"));
  return options;
}

MachineOptions machine_options(const DeviceSettings& settings) {
  const std::vector<std::uint8_t> chosen = resolve_choices(kChoices, settings.choices);
  const auto chose = [&chosen](const Option& option) { return chosen[option.choice] == option.number; };
  MachineOptions options;
  if (chose(option("soft_limit_stop", "at_once"))) {
    options.axis.at_soft_limit = motion::Reaction::stop_at_once;
  }
  if (chose(option("alarm_stop", "slows_down"))) options.axis.at_alarm = motion::Reaction::slow_down;
  options.axis.drives_wait_for_in_position = !chose(option("inpos", "is_only_read"));
  options.emergency_while_off = chose(option("emg_level", "while_off"));
  options.in3_rises_when_it_closes = chose(option("in3_edges", "the_contact_closes"));
  options.filters_delay = !chose(option("filter_delay", "none"));
  options.frnet_every_tick = chose(option("frnet_scan", "every_ms"));
  options.drives_need_servo = chose(option("drives_need_servo", "are_void"));
  options.fifo_waits_for_download = chose(option("fifo_during_download", "held"));
  options.one_block_each = chose(option("fifo_cost", "one_each"));
  options.stops_wait = chose(option("stops_bypass_fifo", "wait_like_others"));
  options.pitch_is_distance = chose(option("scan_positive_pitch", "pitch"));
  return options;
}

}  // namespace understudy::emulator::models::rs_m8194h
